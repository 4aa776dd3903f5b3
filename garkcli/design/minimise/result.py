"""The result of a minimisation."""

from __future__ import annotations

from typing import Literal, TypeAlias

from garkcli.design.design import Design
from garkcli.design.minimise.line import Toward
from garkcli.design.minimise.objective import LevelObjective, Objective
from garkcli.design.steps import Decided, Found
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen
from garkcli.upward import Shown

Extent: TypeAlias = Literal["all", "nearly", "critical-points", "found"]
"""A minimum is the least of all methods; of all up to 10⁻⁹ of its size; of all critical points,
with infinity and excluded values open; or of those found.
"""

Proof: TypeAlias = Literal["exact", "exists", "numerical"]
"""A best method is a critical point or was compared with all; a critical point is proved to
exist near it; or it is better than trials around it. The method itself is always exact.
"""


class Candidate(Frozen):
    """A method with its objective, None if infinite; it may be constant near the method. ``index``
    is the number of its real root of ``found``.
    """

    value: RealRoot | None
    found: Found
    index: int
    is_constant: bool = False
    proof: Proof = "exact"


class ObjectiveLimit(Frozen):
    """A limit of the objective at an end of a parameter that is not attained there."""

    value: RealRoot | None
    parameter: str
    toward: Toward


class Minimum(Shown, Frozen):
    """The methods with the least value of an objective.

    Attributes:
        objective: the objective.
        design: of the family.
        step: its methods were compared.
        extent: the methods among which it is the least.
        value: the least value or the infimum, for a level the greatest or the supremum; None if no
            method was found, or if it is infinite.
        is_infinite: whether it is infinite.
        minimisers: the methods with it; empty if it is not attained.
        limits: the limits that approach it, if it is not attained.
        candidates: the number of values compared.
        gradient: the numerator of the derivative in the one parameter; None if there are several,
            or no derivative.
        parameter: the one parameter.
    """

    objective: Objective | LevelObjective
    design: Design
    step: Decided
    extent: Extent
    value: RealRoot | None
    minimisers: tuple[Candidate, ...]
    limits: tuple[ObjectiveLimit, ...]
    candidates: int
    gradient: Polynomial | None = None
    parameter: str | None = None
    is_infinite: bool = False

    def __repr__(self) -> str:
        return f"<Minimum of {self.objective.key}>"
