"""What may be minimised: a function of a method, and how it depends on parameters."""

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

Formula: TypeAlias = Callable[["Subject", "Parameters | None"], Quotient]
"""From methods and the parameters in their coefficients (None where these are numbers) to the
objective, numerator and denominator.
"""
Size: TypeAlias = RealRoot | None
"""A number that is not negative; None for infinity."""

INSIDE = 1e-7
"""The part by which a search makes levels larger than the least value that is wanted."""
ORIGIN = RealRoot.rational(fmpq(0))
"""0."""


class Objective(Frozen):
    """Something that is made as small as possible, a rational function of the coefficients.

    Attributes:
        key: its name.
        summary: what it is, in words.
        formula: a rational function of the coefficients.
        bounded: numbers that are bounded wherever it is.
    """

    key: str
    summary: str
    formula: Formula
    bounded: Callable[[Tableau], Iterable[Any]] = lambda _: ()


def none_is_negative(signs: Sequence[int]) -> bool:
    """Whether no sign is −1."""
    return min(signs, default=0) >= 0


class Signs(Frozen):
    """What a level is decided by.

    Attributes:
        polynomials: in ``PLANE``, in y and the parameter t.
        holds: whether y is within the level, by the signs of the polynomials at it, if all smaller
            ones are.
        is_closed: whether what holds for t near some number holds there too.
        common: what a step is made of; where these have a zero y in common for one t, that is no
            zero of the step.
    """

    polynomials: Sequence[fmpq_mpoly]
    holds: Holds = none_is_negative
    is_closed: bool = True
    common: Sequence[fmpq_mpoly] = ()


class Level(Frozen):
    """Something that is made as large as possible: the y up to which something holds from 0 on,
    which the signs of polynomials decide; 0 or infinity among them.

    Attributes:
        key: its name, which begins with a minus sign.
        summary: what it is, in words.
        value: the level y of one method, by the ordinary engine.
        signs: of a tableau of one parameter: what decides it; None where a search alone does.
        is_square: whether what people mean is √y.
        claim: the name by which method files claim it, if they can.
    """

    key: str
    summary: str
    value: Callable[[Tableau], Size]
    signs: Callable[[Tableau, Parameters], Signs] | None = None
    is_square: bool = False
    claim: str | None = None

    def shown(self, y: Size) -> Size:
        """What people mean by a level."""
        return square_root(y) if self.is_square and y is not None else y

    def measured(self, y: Size) -> Size | float:
        """What a search prints of a level."""
        return self.shown(y)

    def inside(self, bound: float) -> float:
        """A number a little larger than a least value: exact numbers nearby must not have less."""
        return bound * (1 + INSIDE)

    def reaches(self, y: Size, bound: fmpq) -> bool:
        """Whether what people mean by a level is at least a number."""
        shown = self.shown(y)
        return shown is None or not shown < RealRoot.rational(bound)


class Subject(Frozen):
    """Methods with their embedded weights and orders.

    Attributes:
        tableau: of the methods.
        order: of them.
        further: their embedded weights.
        embedded_order: the order that the embedded weights are to have; None where none is wanted.
        dense_order: the order that the dense output is to have; None where none is wanted.
    """

    tableau: Tableau
    order: int
    further: Further = NOTHING
    embedded_order: int | None = None
    dense_order: int | None = None

    @classmethod
    def of(cls, family: Family, tableau: Tableau, order: int, further: Further) -> Subject:
        """Methods of a family, with its wants on further weights."""
        return cls(tableau, order, further, family.embedded_order, family.dense_order)

    @property
    def embedded(self) -> tuple[Tableau, int]:
        """The methods with the embedded weights in place of b, and their order.

        Raises:
            UsageProblem: they have none, or no order is wanted of them.
        """
        if self.further.embedded is None or self.embedded_order is None:
            message = "the objective is about embedded weights with an order: the file wants none"
            cure = "write embedded: true under unknown, and embedded-order: 3 under design"
            raise UsageProblem(message, cure, code="wanted-without-meaning")
        return with_weights(self.tableau, self.further.embedded), self.embedded_order


class Measure(Frozen):
    """A number that only a search minimises.

    Attributes:
        key: its name.
        summary: what it is, in words.
        squared: its square of one method with rational coefficients.
    """

    key: str
    summary: str
    squared: Callable[[Subject], fmpq]


Single: TypeAlias = Objective | Level | Measure
"""The meaning of one name."""


class Sum(Frozen):
    """Several of them, with weights.

    Attributes:
        key: as people write it.
        terms: each with its weight, which is negative for levels, positive for others.
    """

    key: str
    terms: tuple[tuple[fmpq, Single], ...]

    @property
    def summary(self) -> str:
        """The terms in words."""
        return "; ".join(f"{x.key.removeprefix('-')}: {x.summary}" for _, x in self.terms)


class Either(Frozen):
    """A name that means one thing for some methods and another one for others.

    Attributes:
        key: the name.
        meant: what it means.
    """

    key: str
    meant: Callable[[Tableau], Level]
