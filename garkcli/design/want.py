"""Wants of the methods of a family: equations, and signs at solutions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.errors import MethodError
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.parametric import Parameters, fraction
from garkcli.frozen import Frozen
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.family import Radical, RequiredStability
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Kind: TypeAlias = Literal["flag", "count", "number", "smoothness"]
"""The form of its value: true, an integer, a coefficient, 0 or 1."""


class Asked(Frozen):
    """A family of rational functions and a want of it.

    Attributes:
        value: a count, a smoothness, or a number, which may have parameters; True for a flag.
        colours: the colours with the want, counted from 0.
    """

    tableau: Tableau
    ring: Parameters
    value: object
    colours: tuple[int, ...]
    further: Further = NOTHING
    radicals: tuple[Radical, ...] = ()

    def block(self, l: int, m: int, key: str) -> Matrix:
        block = self.tableau.block(l, m)
        if block is None:
            message = f"design: {key} is for tableaus without empty blocks"
            cure = f"name the colour: {key}: {{2: …}}"
            raise MethodError(message, cure, code="wanted-without-meaning")
        return block

    def diagonal(self, colour: int, key: str) -> tuple[Matrix, Vector]:
        """A^{l,l} and b^l; MethodError if the block is empty, or not given stage by stage."""
        own = self.tableau.colours[colour]
        block = self.tableau.blocks.get((own.space, colour))
        space = self.tableau.spaces[own.space]
        if block is None or not isinstance(space, PointSpace):
            message = (
                f"design: {key} needs the block of each colour with itself, given stage by stage"
            )
            cure = f"name the colour: {key}: {{2: …}}, or spell the tableau out"
            raise MethodError(message, cure, code="wanted-without-meaning")
        return block, own.b


class WantConditions(Frozen):
    """The conditions of a want on the parameters.

    Attributes:
        zeros: rational functions that vanish.
        nonzero: polynomials that do not vanish.
        positive, not_negative: rational functions with these signs at accepted solutions.
        stable: the kinds of stability of the accepted solutions.
        claims: keys of claims that the methods satisfy, with their values.
        unsettled: keys of wants whose conditions were not known in time.
        real: keys of wants whose ``zeros`` hold for real values only.
        impossible: reasons why no value satisfies the want.
        levels: keys of objectives to maximise, with their lower bounds.
    """

    zeros: tuple[object, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()
    positive: tuple[object, ...] = ()
    not_negative: tuple[object, ...] = ()
    stable: tuple[RequiredStability, ...] = ()
    claims: tuple[tuple[str, str], ...] = ()
    unsettled: tuple[str, ...] = ()
    real: tuple[str, ...] = ()
    impossible: tuple[str, ...] = ()
    levels: tuple[tuple[str, fmpq], ...] = ()


class Want(Frozen):
    """A property that files may want; ``meaning`` makes the conditions."""

    key: str
    kind: Kind
    summary: str
    meaning: Callable[[Asked], WantConditions]


def stability(kind: str, asked: Asked, is_embedded: bool = False) -> WantConditions:
    colour = None
    if len(asked.colours) < asked.tableau.size:
        [colour] = asked.colours
        asked.diagonal(colour, kind)
    return WantConditions(stable=(RequiredStability(kind, colour, is_embedded),))


def numerators(functions: Iterable[object], ring: Parameters) -> list[fmpq_mpoly]:
    nonzero = []
    for x in functions:
        numerator, _ = fraction(x, ring)
        if numerator:
            nonzero.append(numerator)
    return nonzero


def sign_polynomial(function: object, ring: Parameters) -> fmpq_mpoly:
    numerator, denominator = fraction(function, ring)
    return numerator * denominator
