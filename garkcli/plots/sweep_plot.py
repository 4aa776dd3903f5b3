"""Scatter plots of sweeps: one criterion against another, with the Pareto front of both."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from matplotlib.figure import Figure

from garkcli.report.sweep import SweepReport
from garkcli.sweep.plan import number
from garkcli.sweep.ranking import kept, pareto_front
from garkcli.sweep.row import Row

_PALE, _RED = "#7fa1d6", "#a02417"  # of clearly different lightness in grey


def sweep_figure(report: SweepReport, x: str, y: str) -> Figure:
    """The kept methods in the plane of two columns; those without finite values are left out."""
    rows = [row for row in kept(report.done) if _is_finite(row, x) and _is_finite(row, y)]
    front = pareto_front(rows, [x, y])
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(*_values(rows, x, y), "o", color=_PALE, markersize=5, label="methods")
    axes.plot(*_values(front, x, y), "s", color=_RED, markersize=6, label="Pareto front")
    for name, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
        # errors spread over powers of ten
        sizes = [_value(row, name) for row in rows]
        if "error" in name and sizes and min(sizes) > 0:
            scale("log")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.legend()
    # names of sweeps are no formulas
    axes.set_title(report.plan.name, fontsize=11, parse_math=False)
    return figure


def _values(rows: Sequence[Row], x: str, y: str) -> tuple[list[float], list[float]]:
    return [_value(row, x) for row in rows], [_value(row, y) for row in rows]


def _value(row: Row, name: str) -> float:
    value = row[name]
    assert not isinstance(value, dict)
    return number(value)


def _is_finite(row: Row, name: str) -> bool:
    return row.get(name) is not None and isfinite(_value(row, name))
