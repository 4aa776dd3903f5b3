"""What a writer gets: one method with every number of it exact, and what gark proved about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import fmpq

from garkcli.bridges import names
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import EXACT, Style
from garkcli.bridges.rounding import TooWide
from garkcli.frozen import Frozen
from garkcli.tableau.garkmethod import Derivation
from garkcli.tableau.pointwise import Block, Cell, Row
from garkcli.tableau.tableau import Tableau
from garkcli.version import __version__

if TYPE_CHECKING:
    from garkcli.bridges.orders import Orders
    from garkcli.bridges.own_arrays import OwnArrays
    from garkcli.constructions.infinitesimal import Coupling
    from garkcli.constructions.rosenbrock import Rosenbrock
    from garkcli.tableau.embedded import Predictor

Kind: TypeAlias = Literal[
    "rk", "ark", "prk", "gark", "row", "nystrom", "nprk", "derivatives", "mri"
]
"""One vector field; several that share all stages; the pair (q, p); any other GARK method; a
Rosenbrock method; the kinds with arrays of their own; a multirate method with the exact fast part.
"""
SCHEMA = "gark/export/1"
"""The format of JSON documents."""

Part: TypeAlias = tuple[int, int | str, Sequence[Row]]
"""An array: its colour and, of a block, the colour that it sees, from 1; its rows."""


class Payload(Frozen, eq=False, kw_only=True):
    """A method as writers see it. Colours and stages count from 0.

    Attributes:
        name: one line, whatever signs are in it.
        kind: which form it has.
        tableau: with one coordinate a stage where the nodes have simple radicals.
        A: ``A[l][m]`` is a matrix, or None where the stages of colour l do not see colour m;
            entries are exact numbers, or enclosures fine enough to be rounded.
        b: the weights, a row per colour.
        c: the nodes, a row per colour.
        embedded: the embedded weights, a row per colour.
        dense: ``dense[l][i]`` are the coefficients of θ, θ², … of b_i(θ) of colour l.
        predictor: the weights that predict stages.
        orders: what was proved.
        is_exact: whether every entry is an exact number.
        tolerance: the rounding that A, b and c of the file admit; None where they are exact.
        embedded_tolerance: that of its embedded weights.
        dense_tolerance: that of its dense output.
        structure: which vector fields the method is for, such as ``general``, ``separable``.
        reference: where it was published, in one line.
        digits: of every number, where they were requested.
        moved_within: how far they are from those of the file at most, where these have fewer
            digits; None where they are the same.
        rosenbrock: of a Rosenbrock method, whose α, b and c are A, b and c; else None.
        own: of a method whose kind has arrays of its own, these; A, b and c are empty then.
        coupling: between the slow stages of a multirate infinitesimal method.
        derivation: whether it is the conjugate or the pair of what a file gives.
        version: of gark.
    """

    name: str
    kind: Kind
    tableau: Tableau
    A: tuple[tuple[Block, ...], ...]
    b: tuple[Row, ...]
    c: tuple[Row, ...]
    orders: Orders
    is_exact: bool = True
    embedded: tuple[Row, ...] | None = None
    dense: tuple[tuple[Row, ...], ...] | None = None
    predictor: Predictor | None = None
    tolerance: fmpq | None = None
    embedded_tolerance: fmpq | None = None
    dense_tolerance: fmpq | None = None
    structure: str = "general"
    reference: str = ""
    digits: int | None = None
    moved_within: fmpq | None = None
    rosenbrock: Rosenbrock | None = None
    own: OwnArrays | None = None
    coupling: Coupling | None = None
    derivation: Derivation = ""
    version: str = __version__

    @property
    def size(self) -> int:
        """N, the number of colours."""
        return self.tableau.size

    @property
    def stages(self) -> tuple[int, ...]:
        """The number of stages of each colour; those of the method where these are no GARK
        stages.
        """
        if self.own is not None:
            return (len(self.own["c"]),)
        return tuple(map(len, self.b))

    @property
    def parts(self) -> Mapping[str, list[Part]]:
        """The arrays by ``A``, ``b``, ``c``, ``embedded`` and ``dense``, colour by colour; of a
        predictor ``predictor_old_r0`` and so on, a matrix for each power of r.
        """
        blocks: list[Part] = [
            (l, m, block)
            for l, of_colour in enumerate(self.A, start=1)
            for m, block in enumerate(of_colour, start=1)
            if block is not None
        ]
        rows = {"b": self.b, "c": self.c, "embedded": self.embedded or ()}
        found = {"A": blocks}
        for x, of_colours in rows.items():
            found[x] = [(l, "", (row,)) for l, row in enumerate(of_colours, start=1)]
        found["dense"] = [(l, "", weights) for l, weights in enumerate(self.dense or (), start=1)]
        if self.predictor is not None:
            for name, matrices in (("old", self.predictor.old), ("new", self.predictor.new)):
                for k, matrix in enumerate(matrices):
                    found[f"predictor_{name}_r{k}"] = [(1, "", matrix)]
        return found

    def arrays(self, before: str = "") -> list[tuple[str, Sequence[Row]]]:
        """The arrays, each with a name for programs: ``A``, ``b``; ``A1_2``, ``b2`` of several
        vector fields, with ``before`` between the letter and its numbers.
        """
        found = [(part, *x) for part, arrays in self.parts.items() for x in arrays]
        found.sort(key=lambda x: (x[0] != "A", x[1]))
        if self.size == 1:
            return [(part, rows) for part, _, _, rows in found]
        return [(f"{part}{before}{l}{m and f'_{m}'}", rows) for part, l, m, rows in found]

    @cached_property
    def stem(self) -> str:
        """The name as ASCII letters, digits and underscores, for what is put behind ``gark_``."""
        return names.stem_of(self.name)

    def number(self, x: Cell, style: Style = EXACT) -> str:
        """An entry in the style of a language, with the digits that were requested.

        Raises:
            CannotExport: an enclosure does not tell how it is rounded.
        """
        try:
            return style.text(x, self.digits)
        except TooWide:
            message = f"the rounding of an entry of {self.name} is not decided"
            raise CannotExport(message, "ask for other --digits") from None
        except OverflowError:
            message = f"an entry of {self.name} is beyond the numbers of the target"
            cure = "ask for --digits 17, which are written with an exponent"
            raise CannotExport(message, cure) from None

    def numbers(self, row: Row, style: Style = EXACT) -> list[str]:
        """A row of entries in the style of a language."""
        return [self.number(x, style) for x in row]
