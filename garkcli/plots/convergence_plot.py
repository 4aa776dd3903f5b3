"""The figures of the convergence test.

Everything is told apart by marks and dashes as well as by colour, so that the figures can be
printed in grey.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import floor
from textwrap import wrap
from typing import Any, TypeAlias

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from garkcli.convergence.result import Convergence
from garkcli.page.asciiplot import log10
from garkcli.plots.slopes import Curve, Decades, Line, place_line
from garkcli.problems.righthandside import RightHandSide
from garkcli.report.convergence import order_text
from garkcli.report.convergence_data import problem_name
from garkcli.report.costs import curve

Style: TypeAlias = Mapping[str, Any]
"""How matplotlib draws a line."""
_Points: TypeAlias = Iterable[tuple[Any, Any]]
_Place: TypeAlias = Callable[[float], float]
"""From decades to where they are on an axis."""
_BLUE, _RED = "#1f4e9e", "#c0392b"  # of clearly different lightness in grey
_STYLES: Sequence[Style] = (
    {"marker": "o", "linestyle": "-", "color": "black"},
    {"marker": "s", "linestyle": "--", "color": "#c0392b", "markerfacecolor": "white"},
    {"marker": "^", "linestyle": "-.", "color": "#1f4e9e"},
    {"marker": "D", "linestyle": ":", "color": "#e08214", "markerfacecolor": "white"},
    {"marker": "v", "linestyle": (0, (5, 1, 1, 1, 1, 1)), "color": "#4d8f4d"},
    {"marker": "X", "linestyle": (0, (8, 2)), "color": "0.55"},
    {"marker": "P", "linestyle": (0, (1, 3)), "color": "#7b3f9e", "markerfacecolor": "white"},
    {"marker": "*", "linestyle": (0, (3, 1, 3, 3)), "color": "#2aa0a8"},
)
_THIN: Style = {"color": "0.3", "linewidth": 0.8, "zorder": 1.5}
"""Of lines that are below all curves."""
_AXES = {
    "h": "step size h",
    "evaluations": "evaluations of vector fields",
    "seconds": "seconds of processor time",
}
_ERROR: Style = {"marker": "o", "color": _BLUE, "linewidth": 1.6}
_ENERGY_ERROR: Style = {
    "marker": "s",
    "color": "0.45",
    "linewidth": 1.0,
    "markerfacecolor": "white",
}
_REFERENCE: Style = {"color": _RED, "linestyle": "--", "linewidth": 1.4}
_LONGEST = 72  # characters of a name in a legend
_TITLE_WIDTH = 60  # characters of a line of a title
_FLOATS = 290  # decades: beyond, logarithms are drawn on a linear axis


def convergence_figure(result: Convergence, name: str) -> Figure:
    """Error and energy error of the method called ``name`` against h, log–log, with a line whose
    slope is the visible order.
    """
    order = result.visible_order
    points = curve(result, "h")
    errors = _curve(points, "error", _ERROR)
    energies = [(row.h, row.energy_error) for row in result.rows]
    kept = [(h, error) for h, error in energies if error is not None and error > 0]
    energy_errors = _curve(kept, "energy error", _ENERGY_ERROR)
    curves = [found for found in (errors, energy_errors) if found is not None]
    if errors is not None:
        line = place_line([errors], order, curves, is_whole=True)
        label = f"reference, slope {order}"
        reference = Curve(line.xs, line.ys, label, _REFERENCE)
        curves.append(reference)
    heading = wrap(_shortened(name), _TITLE_WIDTH)
    observed = order_text(result.observed_order)
    last = f"{_title(result)}: observed order {observed}"
    title = "\n".join([*heading, last])
    figure = _log_log(curves, [], title, "step size h", 4.8)
    if curves:
        figure.axes[0].legend(frameon=False)
    return figure


def comparison_figure(named: Sequence[tuple[str, Convergence]], against: str = "h") -> Figure:
    """Errors of several methods, log–log, with a line for each visible order.

    Args:
        named: names and results of methods, at least one.
        against: h, evaluations or seconds; the latter two need rows with costs.
    """
    curves: list[Curve] = []
    of_order: dict[int, list[Curve]] = {}
    for k, (name, result) in enumerate(named):
        points = curve(result, against)
        errors = _curve(points, _shortened(name), _style(k))
        if errors is None:
            continue
        curves.append(errors)
        order = result.visible_order
        if order > 0:
            beside = of_order.setdefault(order, [])
            beside.append(errors)
    lines = []
    for order, beside in of_order.items():
        # errors rise with h, and fall with what they cost
        slope = order if against == "h" else -order
        line = place_line(beside, slope, curves)
        lines.append(line)
    size = 4.6 + 0.23 * len(curves)
    _, first = named[0]
    label = _AXES[against]
    figure = _log_log(curves, lines, _title(first), label, size)
    _add_legend_below(figure, curves)
    return figure


def _curve(points: _Points, label: str, style: Style) -> Curve | None:
    """The curve through positive points; None where there are none."""
    xs: list[float] = []
    ys: list[float] = []
    for x, y in points:
        xs.append(log10(x))
        ys.append(log10(y))
    if not xs:
        return None
    return Curve(xs, ys, label, style)


def _add_legend_below(figure: Figure, curves: Sequence[Curve]) -> None:
    """The names of all curves below the axes, where no curve can be."""
    lines = figure.axes[0].get_lines()
    drawn = lines[: len(curves)]
    placeholders = ["method"] * len(drawn)
    legend = figure.legend(
        drawn, placeholders, loc="outside lower left", frameon=False, handlelength=3.5
    )
    # names are no formulas, and may begin with _, which would hide them
    texts = legend.get_texts()
    for text, named in zip(texts, curves, strict=True):
        text.set_parse_math(False)
        text.set_text(named.label)


def _title(result: Convergence) -> str:
    name = problem_name(result)
    initial = name[:1].upper()
    capitalized = initial + name[1:]
    problem = result.problem
    if isinstance(problem, RightHandSide) and problem.stiffness is not None:
        capitalized += f", stiffness {problem.stiffness},"
    return f"{capitalized} to t = {result.t_end}"


def _style(k: int) -> dict[str, Any]:
    """Of the k-th curve: marks and dashes are combined anew once all have been used."""
    count = len(_STYLES)
    rounds, place = divmod(k, count)
    marks = _STYLES[place]
    dashes = _STYLES[(k + rounds) % count]
    style = {**marks, "linestyle": dashes["linestyle"]}
    style["linewidth"] = 1.4
    style["markersize"] = 5.5
    return style


def _log_log(
    curves: Sequence[Curve], lines: Sequence[Line], title: str, label: str, size: float
) -> Figure:
    """A figure of the curves; where they leave the range of floats, of their logarithms.

    Args:
        curves: with an entry in the legend each.
        lines: thin, below the curves, with their label beside their middle.
        title: of the figure.
        label: of the horizontal axis.
        size: inches from top to bottom.
    """
    figure = Figure(figsize=(6.4, size), layout="constrained")
    axes = figure.add_subplot()
    largest = _largest([*curves, *lines])
    has_floats = largest < _FLOATS
    place = _power if has_floats else _itself
    draw = axes.loglog if has_floats else axes.plot
    for drawn in curves:
        xs = _placed(drawn.xs, place)
        ys = _placed(drawn.ys, place)
        draw(xs, ys, label=drawn.label, **drawn.style)
    for line in lines:
        xs = _placed(line.xs, place)
        ys = _placed(line.ys, place)
        draw(xs, ys, label=line.label, **_THIN)
        _annotate(axes, line, place)
    if not has_floats:
        _label_powers(axes)
    elif curves:
        decades: list[float] = []
        for drawn in curves:
            decades += drawn.xs
        _label_decades(axes, decades)
    axes.set_title(title, fontsize=11, parse_math=False)
    axes.set_xlabel(label)
    axes.set_ylabel("error")
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    return figure


def _largest(drawn: Sequence[Curve | Line]) -> float:
    """The decades that are farthest from 1."""
    decades = [0.0]
    for x in drawn:
        decades += map(abs, x.xs)
        decades += map(abs, x.ys)
    return max(decades)


def _power(decades: float) -> float:
    """Where a number is on a logarithmic axis."""
    return float(10**decades)


def _itself(decades: float) -> float:
    """Where it is on a linear axis of logarithms."""
    return decades


def _placed(decades: Decades, place: _Place) -> list[float]:
    return [place(z) for z in decades]


def _annotate(axes: Axes, line: Line, place: _Place) -> None:
    """The label of a line beside its middle, on its far side from the curve."""
    x = place(sum(line.xs) / 2)
    y = place(sum(line.ys) / 2)
    right, horizontal = 3, "left"
    up, vertical = 3, "bottom"
    if not line.is_right:
        right, horizontal = -3, "right"
    if line.is_below:
        up, vertical = -3, "top"
    axes.annotate(
        line.label,
        (x, y),
        (right, up),
        textcoords="offset points",
        ha=horizontal,
        va=vertical,
        zorder=1.6,
        fontsize=9,
        color="0.3",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
    )


def _label_powers(axes: Axes) -> None:
    """Powers of ten on linear axes of logarithms."""

    def text(exponent: float, _: object) -> str:
        return f"$10^{{{exponent:g}}}$"

    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(text))
        axis.set_major_locator(MaxNLocator(8))


def _label_decades(axes: Axes, decades: Decades) -> None:
    """Numbers below a logarithmic axis, between the powers of ten too: as many as there is space
    for.
    """
    span = max(decades) - min(decades)
    digits = _digits_between(span)

    def text(x: float, _: object) -> str:
        # powers of ten that rounding has made a little smaller are meant too
        power = floor(log10(x) + 1e-9)
        digit = round(x / 10.0**power)
        is_labelled = digit == 1 or digit in digits
        if not digits or not is_labelled:
            return ""
        if -3 <= power <= 3:
            return f"{x:g}"
        if digit == 1:
            return f"$10^{{{power}}}$"
        return f"${digit}\\times10^{{{power}}}$"

    if digits:
        axes.xaxis.set_major_formatter(FuncFormatter(text))
    axes.xaxis.set_minor_formatter(FuncFormatter(text))


def _digits_between(span: float) -> tuple[int, ...]:
    """Which multiples of the powers of ten are labelled on an axis of so many decades."""
    if span < 1:
        return (2, 3, 5, 7)
    if span < 2:
        return (2, 5)
    return ()


def _shortened(name: str) -> str:
    if len(name) <= _LONGEST:
        return name
    start = name[: _LONGEST - 1]
    return f"{start}…"
