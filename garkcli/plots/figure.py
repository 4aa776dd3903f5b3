"""Scenes as figures of matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from garkcli.plots import scene as scenes

_MARKS = "os^DvXP*"
"""Every second one is open."""
_INCH = scenes.WIDTH / 6.4
_BESIDE, _ABOVE, _LEGEND_ROW = 0.95, 0.35, 0.21
"""Space around the axes of a panel, above all panels, and for a line below, in inches."""
_TITLE_WIDTH = 60  # characters of a line of a title
_LONGEST = 72  # characters of a name
_MOST_ACROSS, _MOST_UP = 8, 8
"""Most marks on the axes."""
_BELOW_AXES, _BELOW_LABEL = 0.5, 4.2
"""The distance of a legend from the axes, in letters."""
_TEXT = "0.15"


def figure(scene: scenes.Scene) -> Figure:
    panels = scene.panels
    heights = [_BESIDE + x.height / _INCH + _LEGEND_ROW * len(x.legend) for x in panels]
    title = [line for text in scene.title.splitlines() for line in wrap(text, _TITLE_WIDTH)]
    rows, columns = (1, len(panels)) if scene.is_row else (len(panels), 1)
    high = max(heights) if scene.is_row else sum(heights)
    size = (scenes.WIDTH / _INCH * columns, high + _ABOVE * len(title))
    made = Figure(figsize=size, layout="constrained")
    grid = made.subplots(
        rows,
        columns,
        squeeze=False,
        sharex=not scene.is_row,
        height_ratios=None if scene.is_row else heights,
    )
    made.suptitle("\n".join(title), fontsize=11, parse_math=False)
    for panel, axes in zip(panels, grid.flat, strict=True):
        draw(axes, panel, has_label=scene.is_row or panel is panels[-1])
    return made


def draw(axes: Axes, panel: scenes.Panel, has_label: bool = True) -> None:
    _set_axis(axes.xaxis, panel.x, _MOST_ACROSS)
    _set_axis(axes.yaxis, panel.y, _MOST_UP)
    axes.set_xlim(panel.x.low, panel.x.high)
    axes.set_ylim(panel.y.low, panel.y.high)
    if panel.is_plane:
        axes.set_aspect("equal")
    if panel.has_grid:
        axes.grid(True, color="0.88", linewidth=0.6)
    note = "\n".join(wrap(panel.note, _TITLE_WIDTH + 10))
    axes.set_title(note, fontsize=10, loc="left", parse_math=False)
    for shape in panel.shapes:
        if isinstance(shape, scenes.Curve):
            xs = [x for x, _ in shape.points]
            axes.plot(xs, [y for _, y in shape.points], **_line(shape))
        elif isinstance(shape, scenes.Area):
            _fill(axes, shape, shape.outlines(panel.x, panel.y))
        else:
            _rule(axes, shape)
    _add_legend(axes, panel.legend, _BELOW_LABEL if has_label else _BELOW_AXES)
    if not has_label:
        axes.set_xlabel("")


def _set_axis(drawn: Any, axis: scenes.Axis, most: int) -> None:
    marks = axis.marks(most)
    drawn.set_ticks([x.at for x in marks], [x.label for x in marks], parse_math=False)
    drawn.set_label_text(axis.label, parse_math=False)


def _line(shape: scenes.Curve | scenes.Area) -> dict[str, Any]:
    style = shape.style or 0
    rounds, place = divmod(style, len(scenes.COLOURS))
    dashes = scenes.DASHES[(style + rounds) % len(scenes.DASHES)]
    width = 0.9 * (shape.width if isinstance(shape, scenes.Curve) else 1.6)
    drawn = {
        "color": scenes.COLOURS[place],
        "linewidth": width,
        "linestyle": (0, tuple(x / 1.6 for x in dashes)) if dashes else "-",
    }
    if isinstance(shape, scenes.Curve) and shape.is_dense:
        drawn["alpha"] = 0.6
    if isinstance(shape, scenes.Curve) and shape.has_dots:
        drawn |= {"marker": _MARKS[place], "markersize": 5.5}
        if place % 2:
            drawn["markerfacecolor"] = "white"
    if isinstance(shape, scenes.Curve) and not shape.has_line:
        drawn["linestyle"] = "none"
    return drawn


def _fill(axes: Axes, area: scenes.Area, loops: scenes.Loops) -> None:
    """Fills an area as one patch, to avoid seams; outlines of holes turn the other way."""
    if not loops:
        return
    whole = Path.make_compound_path(*(Path([*loop, loop[0]], closed=True) for loop in loops))
    colour = _TEXT if area.style is None else scenes.COLOURS[area.style % len(scenes.COLOURS)]
    axes.add_patch(PathPatch(whole, facecolor=colour, alpha=area.opacity, linewidth=0))
    if area.has_outline:
        line = _line(area)
        line["edgecolor"] = line.pop("color")
        axes.add_patch(PathPatch(whole, fill=False, **line))


def _rule(axes: Axes, rule: scenes.RuledLine) -> None:
    xs, ys = zip(rule.start, rule.end, strict=True)
    axes.plot(xs, ys, color=_TEXT, linewidth=0.8)
    if not rule.label:
        return
    axes.annotate(
        rule.label,
        (sum(xs) / 2, sum(ys) / 2),
        (3 if rule.is_right else -3, -3 if rule.is_below else 3),
        textcoords="offset points",
        ha="left" if rule.is_right else "right",
        va="top" if rule.is_below else "bottom",
        fontsize=9,
        color=_TEXT,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
    )


def _add_legend(axes: Axes, named: Sequence[scenes.Curve | scenes.Area], distance: float) -> None:
    if not named:
        return
    handles = [
        Patch(facecolor=_line(shape)["color"], alpha=shape.opacity, linewidth=0)
        if isinstance(shape, scenes.Area) and not shape.has_outline
        else Line2D([], [], **_line(shape))
        for shape in named
    ]
    legend = axes.legend(
        handles,
        ["name"] * len(named),
        loc="upper left",
        bbox_to_anchor=(0, 0),
        borderaxespad=distance,
        frameon=False,
        handlelength=3.5,
        fontsize=9,
    )
    # names are no formulas, and may begin with _, which would hide them
    for text, shape in zip(legend.get_texts(), named, strict=True):
        text.set_parse_math(False)
        text.set_text(scenes.shortened(shape.label, _LONGEST))
