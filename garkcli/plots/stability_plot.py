"""Pictures of stability: regions in the complex plane; traces and springs in ``oscillator_plot``.

They illustrate what was decided exactly and decide nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from flint import fmpq
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from garkcli.plots.oscillator_plot import springs_figure, trace_figure
from garkcli.plots.plane import (
    ABOVE_ALL,
    COLOURS,
    Style,
    draw_axes,
    finite,
    line_style,
    modulus,
    title_of,
    window_of,
    write_literally,
)
from garkcli.report.stability_data import StabilityReport
from garkcli.stability.damping import ImexPair
from garkcli.stability.linear import StabilityFunction

Named: TypeAlias = tuple[str, StabilityFunction]
"""A stability function and what the legend calls it."""
SQUARES = 121
"""Squares a side of a region whose squares are decided one by one, odd so that one row is real."""


def stability_figure(reports: Sequence[StabilityReport], order_star: bool = False) -> Figure:
    """What there is to draw of one or several methods.

    Args:
        reports: all with a linear part, or all with an oscillator.
        order_star: draw |R(z)| > |e^z| instead of |R(z)| ≤ 1.
    """
    planes = [report.plane for report in reports if report.plane is not None]
    if planes:
        return springs_figure(planes[0], reports[0].name)
    if all(report.found.linear for report in reports):
        return region_figure(reports, order_star)
    return trace_figure(reports)


def region_figure(reports: Sequence[StabilityReport], order_star: bool) -> Figure:
    """The regions |R(z)| ≤ 1, a panel a direction where there is one method of several colours."""
    pair = None
    first = reports[0]
    if len(reports) == 1 and not order_star:
        colours = first.found.colours
        pair = None if colours is None else colours.pair
    columns = 1 if pair is None else 2
    width = 6.4 * columns
    figure = Figure(figsize=(width, 5.6), layout="constrained")
    grid = figure.subplots(1, columns, squeeze=False)
    panels = grid[0]
    named: list[Named] = []
    for report in reports:
        linear = report.found.linear
        if len(reports) == 1 and len(linear) > 1:
            named += [(_direction(one.name), one.R) for one in linear]
        else:
            whole = linear[0]
            named.append((report.name, whole.R))
    title = title_of([report.name for report in reports])
    figure.suptitle(title, fontsize=11, parse_math=False)
    _draw_regions(panels[0], named, order_star)
    if pair is not None:
        of_direction = dict(named)
        explicit = of_direction[_direction_of(first, pair)]
        _draw_damped(panels[1], pair, explicit)
    return figure


def _direction_of(report: StabilityReport, pair: ImexPair) -> str:
    """The label of the explicit colour."""
    colours = report.found.tableau.colours
    explicit = colours[pair.explicit]
    return _direction(explicit.name)


def _draw_damped(axes: Axes, pair: ImexPair, explicit: StabilityFunction) -> None:
    """The z_E with all z_I damped, each square decided at its centre, and the outline without."""
    window = window_of([explicit], is_symmetric=False)
    x = np.linspace(window.left, window.right, SQUARES)
    rows = SQUARES // 2 + 1
    y = np.linspace(0.0, window.top, rows)
    upper = []
    for b in map(_exact, y):
        row = [pair.is_damped(_exact(a), b) for a in x]
        upper.append(row)
    # the picture is its own mirror image: all but the row on the axis once more, upside down
    lower = upper[:0:-1]
    below = -y[:0:-1]
    both = np.concatenate([below, y])
    shades = ListedColormap(["#ffffff", COLOURS[0]])
    axes.pcolormesh(x, both, lower + upper, cmap=shades, alpha=0.35, shading="nearest")
    u, v, z = window.grid()
    level = finite(modulus(explicit, z))
    colour, dashes = line_style(1)
    edge: Style = {"colors": [colour], "linestyles": [dashes]}
    axes.contour(u, v, level, levels=[1.0], **edge)
    draw_axes(axes)
    e = pair.explicit + 1
    i = pair.implicit + 1
    axes.set_xlabel(f"Re z{e}")
    axes.set_ylabel(f"Im z{e}")
    title = f"filled: z{e} with every z{i} damped; dashed: with z{i} = 0"
    axes.set_title(title, fontsize=10, loc="left")


def _exact(x: float) -> fmpq:
    return fmpq(*float(x).as_integer_ratio())


def _direction(name: str) -> str:
    return "all colours alike" if name == "all" else f"colour {name} alone"


def _draw_regions(axes: Axes, named: Sequence[Named], order_star: bool) -> None:
    functions = [R for _, R in named]
    window = window_of(functions, order_star)
    x, y, z = window.grid()
    handles = []
    for k, (name, R) in enumerate(named):
        colour, dashes = line_style(k)
        level = modulus(R, z)
        bounds = [0.0, 1.0]
        if order_star:
            level = level / np.exp(z.real)
            bounds = [1.0, ABOVE_ALL]
        drawn = finite(level)
        inside: Style = {"colors": [colour], "alpha": 0.18}
        axes.contourf(x, y, drawn, levels=bounds, **inside)
        edge: Style = {"colors": [colour], "linestyles": [dashes]}
        axes.contour(x, y, drawn, levels=[1.0], linewidths=1.4, **edge)
        handle = Line2D([], [], color=colour, linestyle=dashes, label=name)
        handles.append(handle)
    draw_axes(axes)
    axes.set_xlabel("Re z")
    axes.set_ylabel("Im z")
    what = "filled: |R(z)| ≤ 1"
    if order_star:
        what = "order star: |R(z)| > |exp z|"
    axes.set_title(what, fontsize=10, loc="left")
    if len(named) > 1:
        legend = axes.legend(handles=handles, fontsize=9, loc="upper left")
        write_literally(legend)
