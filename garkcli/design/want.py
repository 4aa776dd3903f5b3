"""What is wanted of the methods of a family: equations, and signs at solutions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.errors import MethodError
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.parametric import Parameters, fraction
from garkcli.frozen import Frozen
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.family import Radical, Stability
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Kind: TypeAlias = Literal["flag", "count", "number", "smoothness"]
"""How its value is written: true, a whole number, a coefficient, 0 or 1."""


class Asked(Frozen):
    """A family and what is asked of it.

    Attributes:
        tableau: entries are rational numbers and rational functions of the parameters.
        ring: the parameters.
        value: a count, a smoothness, or a number, which may have parameters; True for a flag.
        colours: of which colours it is wanted, counted from 0.
        further: its embedded weights and its dense output.
        radicals: the roots among the coefficients, the last unknowns of ``ring``.
    """

    tableau: Tableau
    ring: Parameters
    value: object
    colours: tuple[int, ...]
    further: Further = NOTHING
    radicals: tuple[Radical, ...] = ()

    def block(self, l: int, m: int, key: str) -> Matrix:
        """A^{l,m}.

        Raises:
            MethodError: there is no such block.
        """
        found = self.tableau.block(l, m)
        if found is None:
            message = f"design: {key} is for tableaus without empty blocks"
            cure = f"name the colour: {key}: {{2: …}}"
            raise MethodError(message, cure, code="wanted-without-meaning")
        return found

    def diagonal(self, colour: int, key: str) -> tuple[Matrix, Vector]:
        """A^{l,l} and b^l of a colour.

        Raises:
            MethodError: there is no such block, or it is not spelled out stage by stage.
        """
        own = self.tableau.colours[colour]
        block = self.tableau.blocks.get((own.space, colour))
        space = self.tableau.spaces[own.space]
        if block is None or not isinstance(space, PointSpace):
            message = f"design: {key} is for tableaus with a block of their own stages"
            cure = f"name the colour: {key}: {{2: …}}, or spell the tableau out"
            raise MethodError(message, cure, code="wanted-without-meaning")
        return block, own.b


class Meaning(Frozen):
    """What a want means for the parameters.

    Attributes:
        zeros: rational functions that are zero.
        nonzero: polynomials that are not.
        positive: rational functions that are positive at the solutions that are taken.
        not_negative: those that are at least 0.
        stable: the kinds of stability of the accepted solutions.
        claims: what files may claim of the methods, and its value.
        unsettled: keys of wishes whose meaning was not worked out in time.
        real: keys of wishes of which ``zeros`` have what real values satisfy, not complex ones.
        impossible: what is wanted and no value makes true, with the reason.
        levels: objectives to be made large, by their keys, with the least value of each.
    """

    zeros: tuple[object, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()
    positive: tuple[object, ...] = ()
    not_negative: tuple[object, ...] = ()
    stable: tuple[Stability, ...] = ()
    claims: tuple[tuple[str, str], ...] = ()
    unsettled: tuple[str, ...] = ()
    real: tuple[str, ...] = ()
    impossible: tuple[str, ...] = ()
    levels: tuple[tuple[str, fmpq], ...] = ()


class Want(Frozen):
    """Something that may be wanted.

    Attributes:
        key: in method files.
        kind: of its value.
        summary: what it says.
        meaning: what it asks of the parameters; it raises ``NotDecided`` where the time is over.
    """

    key: str
    kind: Kind
    summary: str
    meaning: Callable[[Asked], Meaning]


def stability(kind: str, asked: Asked, is_embedded: bool = False) -> Meaning:
    """A kind of stability, of the whole method or of one colour; decided at each solution."""
    colour = None
    if len(asked.colours) < asked.tableau.size:
        [colour] = asked.colours
        asked.diagonal(colour, kind)
    return Meaning(stable=(Stability(kind, colour, is_embedded),))


def numerators(functions: Iterable[object], ring: Parameters) -> list[fmpq_mpoly]:
    """Polynomials that are zero where rational functions are; without those that always are."""
    found = []
    for x in functions:
        numerator, _ = fraction(x, ring)
        if numerator:
            found.append(numerator)
    return found


def sign_polynomial(function: object, ring: Parameters) -> fmpq_mpoly:
    """A polynomial with the sign of a rational function, wherever that has no pole."""
    numerator, denominator = fraction(function, ring)
    return numerator * denominator
