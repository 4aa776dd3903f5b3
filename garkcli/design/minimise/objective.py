"""Objectives: functions of a method, and their dependence on parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.design.minimise.squared_error import Quotient
from garkcli.errors import UsageProblem
from garkcli.exact.fibre import Holds
from garkcli.exact.parametric import Parameters
from garkcli.exact.roots import RealRoot, square_root
from garkcli.frozen import Frozen
from garkcli.tableau.embedded import NOTHING, Further, with_weights
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau

Formula: TypeAlias = Callable[["ObjectiveSubject", "Parameters | None"], Quotient]
"""A function of methods and the parameters of their coefficients, None for numbers."""
Size: TypeAlias = RealRoot | None
"""A number that is not negative; None for infinity."""

INSIDE = 1e-7
"""The part by which a search makes levels larger than the wanted bound."""
ORIGIN = RealRoot.rational(fmpq(0))


class Objective(Frozen):
    """A rational function to minimise; the numbers ``bounded`` are bounded where it is."""

    key: str
    summary: str
    formula: Formula
    bounded: Callable[[Tableau], Iterable[Any]] = lambda _: ()


def none_is_negative(signs: Sequence[int]) -> bool:
    return min(signs, default=0) >= 0


class LevelSigns(Frozen):
    """The condition on the signs of polynomials in y and t that defines a level.

    Attributes:
        holds: whether y is within the level, by the signs at y, if all smaller ones are.
        is_closed: whether a condition that holds for t near some number holds there too.
        common: the polynomials of a step; a common zero y of all for one t cancels in the step.
    """

    polynomials: Sequence[fmpq_mpoly]
    holds: Holds = none_is_negative
    is_closed: bool = True
    common: Sequence[fmpq_mpoly] = ()


class LevelObjective(Frozen):
    """The y to maximise up to which a condition on signs holds from 0 on; 0 and ∞ are possible.

    Attributes:
        key: its name, which begins with a minus sign.
        value: the level y of one method, by its own engine.
        signs: the condition for a tableau with one parameter; None if only a search maximises it.
        is_square: whether users read √y.
        claim: the key of claims about it in method files, if there is one.
    """

    key: str
    summary: str
    value: Callable[[Tableau], Size]
    signs: Callable[[Tableau, Parameters], LevelSigns] | None = None
    is_square: bool = False
    claim: str | None = None

    def shown(self, y: Size) -> Size:
        return square_root(y) if self.is_square and y is not None else y

    def measured(self, y: Size) -> Size | float:
        return self.shown(y)

    def inside(self, bound: float) -> float:
        # exact numbers near by reach a bound a little above the wanted one
        return bound * (1 + INSIDE)

    def reaches(self, y: Size, bound: fmpq) -> bool:
        shown = self.shown(y)
        return shown is None or not shown < RealRoot.rational(bound)


class ObjectiveSubject(Frozen):
    """Methods with their embedded weights, and the wanted orders of these and of dense output."""

    tableau: Tableau
    order: int
    further: Further = NOTHING
    embedded_order: int | None = None
    dense_order: int | None = None

    @classmethod
    def of(cls, family: Family, tableau: Tableau, order: int, further: Further) -> ObjectiveSubject:
        return cls(tableau, order, further, family.embedded_order, family.dense_order)

    @property
    def embedded(self) -> tuple[Tableau, int]:
        """The methods with the embedded weights as b, and their order; raises UsageProblem."""
        if self.further.embedded is None or self.embedded_order is None:
            message = "the objective needs embedded weights of some order, and the file wants none"
            cure = "write embedded: true under unknown, and embedded-order: 3 under design"
            raise UsageProblem(message, cure, code="wanted-without-meaning")
        return with_weights(self.tableau, self.further.embedded), self.embedded_order


class SearchMeasure(Frozen):
    """A number that only a search minimises; ``squared`` is for one method, rational."""

    key: str
    summary: str
    squared: Callable[[ObjectiveSubject], fmpq]


Single: TypeAlias = Objective | LevelObjective | SearchMeasure


class WeightedSum(Frozen):
    """A sum of objectives; weights are negative for levels, positive for others."""

    key: str
    terms: tuple[tuple[fmpq, Single], ...]

    @property
    def summary(self) -> str:
        return "; ".join(f"{x.key.removeprefix('-')}: {x.summary}" for _, x in self.terms)


class Either(Frozen):
    """A name that means different levels for different methods."""

    key: str
    meant: Callable[[Tableau], LevelObjective]
