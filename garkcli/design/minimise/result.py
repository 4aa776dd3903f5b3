"""What a minimisation has found."""

from __future__ import annotations

from typing import Literal, TypeAlias

from garkcli.design.design import Design
from garkcli.design.minimise.line import Toward
from garkcli.design.minimise.objective import Level, Objective
from garkcli.design.steps import Decided, Found
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen
from garkcli.upward import Shown

Extent: TypeAlias = Literal["all", "nearly", "critical-points", "found"]
"""Among what a minimum is the least: all methods; all critical points, and no method is less by
more than 10⁻⁹ of it; all critical points, while what happens at infinity and at values that are
left out is open; or some methods.
"""

Proof: TypeAlias = Literal["exact", "exists", "numerical"]
"""What is known of a method as a best one: that it is critical, or else compared with all; that a
critical point is proved to exist beside it; or that it is better than what was tried around it. As
a method it is exact in any case.
"""


class Candidate(Frozen):
    """A method with its objective.

    Attributes:
        value: of the objective; None where it is infinite.
        found: the method and its conjugates over ℚ.
        index: which of the real roots of ``found`` it is.
        is_constant: whether the objective is the same at all methods near it.
        proof: what is known of it.
    """

    value: RealRoot | None
    found: Found
    index: int
    is_constant: bool = False
    proof: Proof = "exact"


class Limit(Frozen):
    """What the objective comes near to without reaching it there.

    Attributes:
        value: the limit; None where it is infinite.
        parameter: which tends to the end.
        toward: the end.
    """

    value: RealRoot | None
    parameter: str
    toward: Toward


class Minimum(Shown, Frozen):
    """The methods with the least value of an objective.

    Attributes:
        objective: what was minimised.
        design: of the family.
        step: whose methods were compared.
        extent: among what it is the least.
        value: the least value, or the infimum, of a level the greatest or the supremum; None where
            no method was found, or where it is infinite.
        is_infinite: whether it is.
        minimisers: the methods with it; none where it is not attained.
        limits: where it is approached, if it is not attained.
        candidates: how many values were compared.
        gradient: the numerator of the derivative by the one parameter; None where there are
            several, or no derivative.
        parameter: that one.
    """

    objective: Objective | Level
    design: Design
    step: Decided
    extent: Extent
    value: RealRoot | None
    minimisers: tuple[Candidate, ...]
    limits: tuple[Limit, ...]
    candidates: int
    gradient: Polynomial | None = None
    parameter: str | None = None
    is_infinite: bool = False

    def __repr__(self) -> str:
        return f"<Minimum of {self.objective.key}>"
