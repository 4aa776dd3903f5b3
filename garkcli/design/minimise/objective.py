"""What may be minimised: a function of a method, and how it depends on parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.design.minimise.squared_error import Quotient
from garkcli.exact.parametric import Parameters
from garkcli.exact.root_number import square_root
from garkcli.exact.roots import RealRoot
from garkcli.tableau.tableau import Tableau

Formula: TypeAlias = Callable[[Tableau, int, "Parameters | None"], Quotient]
"""From a tableau, the order of its methods and the parameters in it (None where its entries are
numbers) to the objective, numerator and denominator.
"""
Size: TypeAlias = RealRoot | None
"""A number that is not negative; None for infinity."""

ORIGIN = RealRoot.rational(fmpq(0))
"""0."""


@dataclass(frozen=True)
class Objective:
    """Something that is made as small as possible, a rational function of the coefficients.

    Attributes:
        key: its name.
        summary: what it is, in words.
        formula: a rational function of the coefficients.
    """

    key: str
    summary: str
    formula: Formula


@dataclass(frozen=True)
class Level:
    """Something that is made as large as possible: the first root y > 0 of some polynomials at
    which a sign changes, or 0 or infinity.

    Attributes:
        key: its name, which begins with a minus sign.
        summary: what it is, in words.
        value: the level y of one method, by the ordinary engine.
        curves: of a tableau of one parameter t: the polynomials in y and t, in ``PLANE``.
        is_square: whether what people mean is √y.
        claim: the name by which method files claim it, if they can.
    """

    key: str
    summary: str
    value: Callable[[Tableau], Size]
    curves: Callable[[Tableau, Parameters], Sequence[fmpq_mpoly]]
    is_square: bool = False
    claim: str | None = None

    def shown(self, y: Size) -> Size:
        """What people mean by a level."""
        return square_root(y) if self.is_square and y is not None else y


@dataclass(frozen=True)
class Either:
    """A name that means one thing for some methods and another one for others.

    Attributes:
        key: the name.
        meant: what it means.
    """

    key: str
    meant: Callable[[Tableau], Level]
