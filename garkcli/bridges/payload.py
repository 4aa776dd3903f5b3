"""The input of writers: one method with all numbers exact, and its proved orders."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

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
    from garkcli.constructions.infinitesimal import Coupling
    from garkcli.constructions.rosenbrock import Rosenbrock
    from garkcli.tableau.embedded import Predictor

Kind: TypeAlias = Literal[
    "rk", "ark", "prk", "gark", "row", "nystrom", "nprk", "derivatives", "mri"
]
"""``ark``: shared stages; ``prk``: (q, p); ``row``: Rosenbrock; ``mri``: exact fast part."""
SCHEMA = "gark/export/1"

OwnArrays: TypeAlias = Mapping[str, tuple[Any, ...]]
"""Entries in nested tuples, one level per dimension."""
Part: TypeAlias = tuple[int, int | str, Sequence[Row]]
"""The colour and, for a block, the colour of its columns, from 1; the rows."""


class Payload(Frozen, eq=False, kw_only=True):
    """A method for writers. Colours and stages count from 0.

    Attributes:
        tableau: on point stages if the nodes have simple radicals.
        A: ``A[l][m]`` is a matrix, or None if the stages of colour l do not depend on colour m;
            entries are exact numbers, or enclosures fine enough for rounding.
        dense: ``dense[l][i]`` are the coefficients of θ, θ², … of b_i(θ) of colour l.
        tolerance: the rounding of A, b and c in the file; None if they are exact.
        structure: of the vector fields, such as ``general``, ``separable``.
        moved_within: a bound on the distance to the numbers of the file, if these have fewer
            digits.
        rosenbrock: a Rosenbrock method, with α, b and c in A, b and c.
        own: the arrays of kinds with their own arrays; then A, b and c are empty.
        coupling: between the slow stages of a multirate infinitesimal method.
        derivation: whether it is the conjugate or the pair of the method of the file.
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
        return self.tableau.size

    @property
    def stages(self) -> tuple[int, ...]:
        """The number of stages of each colour; with own arrays of the method."""
        if self.own is not None:
            return (len(self.own["c"]),)
        return tuple(map(len, self.b))

    @property
    def parts(self) -> Mapping[str, list[Part]]:
        """Each power of r of a predictor has a matrix ``predictor_old_r0`` and so on."""
        blocks: list[Part] = [
            (l, m, block)
            for l, of_colour in enumerate(self.A, start=1)
            for m, block in enumerate(of_colour, start=1)
            if block is not None
        ]
        rows = {"b": self.b, "c": self.c, "embedded": self.embedded or ()}
        arrays = {"A": blocks}
        for x, of_colours in rows.items():
            arrays[x] = [(l, "", (row,)) for l, row in enumerate(of_colours, start=1)]
        arrays["dense"] = [(l, "", weights) for l, weights in enumerate(self.dense or (), start=1)]
        if self.predictor is not None:
            for name, matrices in (("old", self.predictor.old), ("new", self.predictor.new)):
                for k, matrix in enumerate(matrices):
                    arrays[f"predictor_{name}_r{k}"] = [(1, "", matrix)]
        return arrays

    def arrays(self, before: str = "") -> list[tuple[str, Sequence[Row]]]:
        """``A``, ``b``; of several fields ``A1_2``, ``b2``, with ``before`` before the numbers."""
        parts = [(part, *x) for part, arrays in self.parts.items() for x in arrays]
        parts.sort(key=lambda x: (x[0] != "A", x[1]))
        if self.size == 1:
            return [(part, rows) for part, _, _, rows in parts]
        return [(f"{part}{before}{l}{m and f'_{m}'}", rows) for part, l, m, rows in parts]

    @cached_property
    def stem(self) -> str:
        return names.stem_of(self.name)

    def number(self, x: Cell, style: Style = EXACT) -> str:
        """CannotExport if an enclosure is too wide for rounding."""
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
        return [self.number(x, style) for x in row]
