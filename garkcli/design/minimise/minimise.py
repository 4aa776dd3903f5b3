"""The methods of a solution set with the least value of an objective.

The set is split into parts (``garkcli.design.parts``). Single points are all compared. On a part
with one coordinate the objective is a rational function of it: critical points, ends and limits are
compared. On a part of larger dimension the critical points are compared, but not the behaviour at
infinity.
"""

from __future__ import annotations

from collections.abc import Sequence
from time import monotonic

from garkcli.deadline import seconds_left, until, within
from garkcli.design.design import Design
from garkcli.design.minimise.comparison import Minimisation
from garkcli.design.minimise.highest import Highest
from garkcli.design.minimise.objective import Either, LevelObjective
from garkcli.design.minimise.objectives import OBJECTIVES
from garkcli.design.minimise.result import Minimum
from garkcli.design.minimise.smallest import Smallest
from garkcli.design.minimise.sums import Wanted, exactly, objective_of
from garkcli.design.parts import Part
from garkcli.design.steps import Decided, Solutions
from garkcli.errors import NotDecided, UsageProblem
from garkcli.frozen import replace

SHARE = 0.25
"""The part of the time for critical points by Gröbner bases."""


def step_to_minimise(design: Design) -> Decided:
    """The step of the highest order that may have methods; UsageProblem if none is decided."""
    for step in reversed(design.steps):
        if isinstance(step, Decided) and step.may_have_methods:
            return step
    message = "--minimise: gark knows no order that methods of the file have"
    cure = "give some unknowns values with --set: fewer are easier to decide"
    raise UsageProblem(message, cure, code="not-found")


def minimise(design: Design, objective: str | Wanted, seconds: float | None = None) -> Minimum:
    """The methods of the highest order with the least value of an objective. Raises UsageProblem if
    the objective or a wanted stability is not applicable, only a search minimises it, or no step is
    decided; NotDecided if a Gröbner basis or a trial takes too long.
    """
    step = step_to_minimise(design)
    if isinstance(objective, str):
        objective = objective_of(objective)
    if isinstance(objective, Either):
        objective = objective.meant(design.tableau)
    objective = exactly(objective)
    comparison: Minimisation
    compared, among = design, step
    if step.known.of_stable is not None:
        # all methods of this ideal have the wanted stability
        compared = replace(design, family=replace(design.family, stable=()))
        among = replace(step, ideal=step.known.of_stable.ideal)
    if isinstance(objective, LevelObjective):
        comparison = Highest(compared, among, objective)
    else:
        comparison = Smallest(compared, among, objective)
    with within(seconds):
        left = seconds_left()
        comparison.share = None if left is None else monotonic() + SHARE * left
        if isinstance(step, Solutions):
            comparison.selection()
        elif not (objective is OBJECTIVES["error"] and comparison.by_theorem()):
            with until(comparison.share):
                parts = compared.parts(among)
            _over(comparison, parts)
        return replace(comparison.result(), design=design, step=step)


def _over(comparison: Minimisation, parts: Sequence[Part]) -> None:
    """Compares all parts, those of the largest dimension first, each in its share of the time. If a
    part is too large or curved, the best of the others is only the best found. Raises NotDecided if
    no part gives a method to compare.
    """
    missed = 0
    for number, part in enumerate(sorted(parts, key=lambda x: -x.dimension)):
        left = seconds_left()
        try:
            with within(None if left is None else left / (len(parts) - number)):
                comparison.over_whole(part)
        except NotDecided:
            missed += 1
    if missed:
        comparison.extent, comparison.is_open = "found", True
        if not comparison.candidates:
            raise NotDecided
