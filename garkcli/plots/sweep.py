"""Sweeps: two criteria against each other, with their Pareto front."""

from __future__ import annotations

from math import isfinite, log10

from garkcli.errors import MethodError
from garkcli.plots.scene import Axis, Curve, Panel, Scene
from garkcli.sweep.plan import number
from garkcli.sweep.report import SweepReport, kept, pareto_front
from garkcli.sweep.row import Row


def drawn(report: SweepReport) -> list[Row]:
    """Returns the kept methods with finite values in the first two columns of the front."""
    return [x for x in kept(report.done) if all(_is_finite(x, y) for y in report.plan.pareto[:2])]


def sweep_scene(report: SweepReport) -> Scene:
    x, y = report.plan.pareto[:2]
    rows = drawn(report)
    if not rows:
        raise MethodError("there is nothing to draw", "choose other columns", code="arrays")
    front = pareto_front(rows, [x, y])
    # errors spread over powers of ten
    logarithmic = {
        name: "error" in name and min(_value(row, name) for row in rows) > 0 for name in (x, y)
    }

    def coordinate(row: Row, name: str) -> float:
        value = _value(row, name)
        return log10(value) if logarithmic[name] else value

    all_points = [(coordinate(row, x), coordinate(row, y)) for row in rows]
    best = [(coordinate(row, x), coordinate(row, y)) for row in front]
    panel = Panel(
        "Sweep",
        f"{len(rows)} methods by {x} and {y}; {len(front)} of them are on the Pareto front.",
        Axis.around(x, [a for a, _ in all_points], logarithmic[x]),
        Axis.around(y, [b for _, b in all_points], logarithmic[y]),
        [
            Curve(0, all_points, "methods", has_dots=True, has_line=False),
            Curve(1, best, "Pareto front", has_dots=True, has_line=False),
        ],
        height=240,
        has_grid=True,
    )
    return Scene(report.plan.name, [panel])


def _value(row: Row, name: str) -> float:
    value = row[name]
    assert not isinstance(value, dict)
    return number(value)


def _is_finite(row: Row, name: str) -> bool:
    return row.get(name) is not None and isfinite(_value(row, name))
