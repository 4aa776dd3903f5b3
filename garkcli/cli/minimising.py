"""``gark design --minimise``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.design_options import CLAIMS
from garkcli.design.chosen import values_text
from garkcli.design.groebner import NotDecided
from garkcli.design.minimise.minimise import minimise
from garkcli.design.minimise.registry import find_objective
from garkcli.errors import UsageProblem
from garkcli.methodfile.family import with_values
from garkcli.page.writing import write_whole

if TYPE_CHECKING:
    from garkcli.design.design import Design
    from garkcli.design.minimise.result import Minimum
    from garkcli.methodfile.family import FamilyFile


def least(design: Design, name: str, seconds: float) -> Minimum:
    """The minimum of the objective of that name."""
    try:
        return minimise(design, find_objective(name), seconds)
    except NotDecided:
        raise UsageProblem(
            f"--minimise {name}: not decided in the time of --seconds",
            "choose values for some unknowns with --choose",
        ) from None


def emit(family: FamilyFile, minimum: Minimum, path: str) -> None:
    """Write the first method with the least value."""
    name = minimum.objective.key
    if not minimum.minimisers:
        raise UsageProblem(
            f"--emit: no method has the infimum of {name}",
            "a range for the parameter, closed at its ends, has a minimum",
        )
    candidate = minimum.minimisers[0]
    found = candidate.found
    root = found.solution.real[candidate.index]
    values = {x: found.solution.values[x] for x in family.parameters}
    order = minimum.step.order
    if found.order is not None:
        order = found.order.order
    claim = f"{CLAIMS[minimum.design.whose]}: {order}"
    head = f"found by gark design {family.source} --minimise {name}: {claim}"
    text = with_values(family, values_text(values, root), head, claim)
    write_whole(path, [text])
