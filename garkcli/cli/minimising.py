"""``gark design --minimise``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.streams import say_problem
from garkcli.design.choices import values_text
from garkcli.design.design import CLAIMS
from garkcli.design.minimise.minimise import minimise
from garkcli.design.minimise.objective import Level
from garkcli.errors import NotDecided, UsageProblem
from garkcli.exact.polynomial_text import root_decimal, root_text
from garkcli.methodfile.family import with_values
from garkcli.page.writing import write_whole

if TYPE_CHECKING:
    from garkcli.design.design import Design
    from garkcli.design.minimise.result import Minimum
    from garkcli.methodfile.family import FamilyFile

DIGITS = 15
"""Of claims without simple radicals."""


def least(design: Design, name: str) -> Minimum | None:
    """The minimum of the objective of that name; None, and it is said why, where it is open."""
    try:
        return minimise(design, name)
    except NotDecided:
        problem = UsageProblem(
            f"--minimise {name}: not decided, the solution set is too large or curved",
            "choose values for some unknowns with --choose",
            code="not-found",
        )
        say_problem(problem)
        return None


def emit(family: FamilyFile, minimum: Minimum, path: str) -> None:
    """Write the first method with the least value."""
    name = minimum.objective.key
    if not minimum.minimisers:
        raise UsageProblem(
            f"--emit: no method has the infimum of {name}",
            "a range for the parameter, closed at its ends, has a minimum",
            code="not-found",
        )
    candidate = minimum.minimisers[0]
    found = candidate.found
    root = found.solution.real[candidate.index]
    values = {x: found.solution.values[x] for x in family.parameters}
    order = minimum.step.order
    if found.order is not None:
        order = found.order.order
    claim = f"{CLAIMS[minimum.design.whose]}: {order}"
    whose = minimum.design.whose
    options = "" if whose == "method" else f" --{whose}"
    options += f" --order {minimum.step.order} --minimise {name}"
    head = f"found by gark design {family.source}{options}: {claim}"
    if whose == "method":
        claim += _claim(minimum)
    text = with_values(family, values_text(values, root), head, claim)
    write_whole(path, [text])


def _claim(minimum: Minimum) -> str:
    """What a method file may claim of the greatest level."""
    objective = minimum.objective
    if not isinstance(objective, Level) or objective.claim is None:
        return ""
    if minimum.is_infinite:
        return f", {objective.claim}: infinity"
    if minimum.value is None:
        return ""
    exact = root_text(minimum.value)
    decimals = root_decimal(minimum.value, DIGITS)
    return f", {objective.claim}: {exact or decimals}"
