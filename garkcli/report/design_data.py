"""``gark design --format json``: the verdict, the ideal and the solutions, numbers as text."""

from __future__ import annotations

from typing import Any

from garkcli.design.design import Design, Found, Step
from garkcli.design.solutions import value_at
from garkcli.report.exactly import root_data
from garkcli.report.json_text import to_json
from garkcli.trees.notation import format_tree

SCHEMA = "gark/design/1"


def render(source: str, design: Design, digits: int) -> str:
    """The design as JSON text."""
    last = design.last
    data = {
        "schema": SCHEMA,
        "file": source,
        "name": design.family.name,
        "of": design.whose,
        "unknowns": list(design.family.parameters),
        **_step_data(design, last, digits),
        "orders": [_step_data(design, step, digits) for step in design.steps],
    }
    return to_json(data) + "\n"


def _step_data(design: Design, step: Step, digits: int) -> dict[str, Any]:
    data: dict[str, Any] = {"order": step.order, "verdict": step.kind}
    if step.ideal is not None:
        data["ideal"] = [str(p) for p in step.ideal.polynomials]
        data["dimension"] = step.ideal.dimension
    data["solutions"] = [
        x for found in step.found for x in _solutions(design, found, digits)
    ]
    data["witness"] = None if step.witness is None else format_tree(step.witness)
    return data


def _solutions(design: Design, found: Found, digits: int) -> list[dict[str, Any]]:
    """Each real root as a solution, then the others as one."""
    solution = found.solution
    order = None if found.order is None else found.order.order
    common = {"multiplicity": solution.multiplicity, "order": order}
    data: list[dict[str, Any]] = []
    for index, root in enumerate(solution.real):
        values = {}
        for name in design.family.parameters:
            value = value_at(solution.values[name], root)
            values[name] = root_data(value, digits)
        is_within = index in found.accepted
        data.append({"values": values, "real": True, "admissible": is_within, **common})
    others = solution.degree - len(solution.real)
    if others:
        data.append({"values": None, "real": False, "count": others, **common})
    return data
