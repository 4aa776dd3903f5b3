"""The figures of the convergence test, and how figures become files.

Everything is told apart by marks and dashes as well as by colour, so that the figures can be
printed in grey.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from io import BytesIO
from math import floor
from pathlib import Path
from textwrap import wrap
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from garkcli.convergence.result import Convergence
from garkcli.errors import UsageProblem
from garkcli.plots.slopes import Curve, Line, place_line
from garkcli.report.asciiplot import log10
from garkcli.report.convergence import order_text
from garkcli.report.convergence_data import problem_name
from garkcli.report.costs import curve
from garkcli.report.writing import refuse_unwritable, write_whole

SUFFIXES = (".png", ".svg", ".pdf")
"""The kinds of file that figures can be saved as."""
_BLUE, _RED = "#1f4e9e", "#c0392b"  # of clearly different lightness in grey
_STYLES: Sequence[Mapping[str, Any]] = (
    {"marker": "o", "linestyle": "-", "color": "black"},
    {"marker": "s", "linestyle": "--", "color": "#c0392b", "markerfacecolor": "white"},
    {"marker": "^", "linestyle": "-.", "color": "#1f4e9e"},
    {"marker": "D", "linestyle": ":", "color": "#e08214", "markerfacecolor": "white"},
    {"marker": "v", "linestyle": (0, (5, 1, 1, 1, 1, 1)), "color": "#4d8f4d"},
    {"marker": "X", "linestyle": (0, (8, 2)), "color": "0.55"},
    {
        "marker": "P",
        "linestyle": (0, (1, 3)),
        "color": "#7b3f9e",
        "markerfacecolor": "white",
    },
    {"marker": "*", "linestyle": (0, (3, 1, 3, 3)), "color": "#2aa0a8"},
)
_THIN: Mapping[str, Any] = {"color": "0.3", "linewidth": 0.8, "zorder": 1.5}
"""Of lines that are below all curves."""
_AXES = {
    "h": "step size h",
    "evaluations": "evaluations of vector fields",
    "seconds": "seconds of processor time",
}
_ERROR: Mapping[str, Any] = {"marker": "o", "color": _BLUE, "linewidth": 1.6}
_ENERGY_ERROR: Mapping[str, Any] = {
    "marker": "s",
    "color": "0.45",
    "linewidth": 1.0,
    "markerfacecolor": "white",
}
_REFERENCE: Mapping[str, Any] = {"color": _RED, "linestyle": "--", "linewidth": 1.4}
_LONGEST = 72  # characters of a name in a legend
_TITLE_WIDTH = 60  # characters of a line of a title
_FLOATS = 290  # decades: beyond, logarithms are drawn on a linear axis


def convergence_figure(result: Convergence, name: str) -> Figure:
    """Error and energy error of the method called ``name`` against h, log–log, with a line whose
    slope is the visible order.
    """
    errors = _curve(curve(result, "h"), "error", _ERROR)
    kept = [(row.h, row.energy_error) for row in result.rows if row.energy_error > 0]
    energy_errors = _curve(kept, "energy error", _ENERGY_ERROR)
    curves = [found for found in (errors, energy_errors) if found is not None]
    if errors is not None:
        line = place_line([errors], result.visible_order, curves, is_whole=True)
        label = f"reference, slope {result.visible_order}"
        curves.append(Curve(line.xs, line.ys, label, _REFERENCE))
    heading = "\n".join(wrap(_shortened(name), _TITLE_WIDTH))
    observed = order_text(result.observed_order)
    title = f"{heading}\n{_title(result)}: observed order {observed}"
    figure = _log_log(curves, [], title, "step size h", 4.8)
    if curves:
        figure.axes[0].legend(frameon=False)
    return figure


def comparison_figure(
    named: Sequence[tuple[str, Convergence]], against: str = "h"
) -> Figure:
    """Errors of several methods, log–log, with a line for each visible order.

    Args:
        named: names and results of methods, at least one.
        against: h, evaluations or seconds; the latter two need rows with costs.
    """
    curves: list[Curve] = []
    of_order: dict[int, list[Curve]] = {}
    for k, (name, result) in enumerate(named):
        errors = _curve(curve(result, against), _shortened(name), _style(k))
        if errors is None:
            continue
        curves.append(errors)
        if result.visible_order > 0:
            of_order.setdefault(result.visible_order, []).append(errors)
    lines = []
    for order, beside in of_order.items():
        # errors rise with h, and fall with what they cost
        slope = order if against == "h" else -order
        lines.append(place_line(beside, slope, curves))
    size = 4.6 + 0.23 * len(curves)
    figure = _log_log(curves, lines, _title(named[0][1]), _AXES[against], size)
    _add_legend_below(figure, curves)
    return figure


def _curve(
    points: Iterable[tuple[Any, Any]], label: str, style: Mapping[str, Any]
) -> Curve | None:
    """The curve through positive points; None where there are none."""
    logarithms = [(log10(x), log10(y)) for x, y in points]
    if not logarithms:
        return None
    xs, ys = zip(*logarithms, strict=True)
    return Curve(xs, ys, label, style)


def _add_legend_below(figure: Figure, curves: Sequence[Curve]) -> None:
    """The names of all curves below the axes, where no curve can be."""
    drawn = figure.axes[0].get_lines()[: len(curves)]
    placeholders = ["method"] * len(drawn)
    legend = figure.legend(
        drawn,
        placeholders,
        loc="outside lower left",
        frameon=False,
        handlelength=3.5,
    )
    # names are no formulas, and may begin with _, which would hide them
    for text, named in zip(legend.get_texts(), curves, strict=True):
        text.set_parse_math(False)
        text.set_text(named.label)


def _title(result: Convergence) -> str:
    name = problem_name(result)
    return f"{name[:1].upper()}{name[1:]} to t = {result.t_end}"


def _style(k: int) -> dict[str, Any]:
    """Of the k-th curve: marks and dashes are combined anew once all have been used."""
    count = len(_STYLES)
    dashes = _STYLES[(k + k // count) % count]["linestyle"]
    sizes = {"linewidth": 1.4, "markersize": 5.5}
    return {**_STYLES[k % count], "linestyle": dashes, **sizes}


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
    has_floats = _largest([*curves, *lines]) < _FLOATS
    place = _power if has_floats else _itself
    draw = axes.loglog if has_floats else axes.plot
    for drawn in curves:
        xs, ys = _placed(drawn.xs, place), _placed(drawn.ys, place)
        draw(xs, ys, label=drawn.label, **drawn.style)
    for line in lines:
        xs, ys = _placed(line.xs, place), _placed(line.ys, place)
        draw(xs, ys, label=line.label, **_THIN)
        _annotate(axes, line, place)
    if not has_floats:
        _label_powers(axes)
    elif curves:
        decades = [z for drawn in curves for z in drawn.xs]
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
        decades += [abs(z) for z in (*x.xs, *x.ys)]
    return max(decades)


def _power(decades: float) -> float:
    """Where a number is on a logarithmic axis."""
    return float(10**decades)


def _itself(decades: float) -> float:
    """Where it is on a linear axis of logarithms."""
    return decades


def _placed(decades: Iterable[float], place: Callable[[float], float]) -> list[float]:
    return [place(z) for z in decades]


def _annotate(axes: Axes, line: Line, place: Callable[[float], float]) -> None:
    """The label of a line beside its middle, on its far side from the curve."""
    middle = place(sum(line.xs) / 2), place(sum(line.ys) / 2)
    right, horizontal = (3, "left") if line.is_right else (-3, "right")
    up, vertical = (-3, "top") if line.is_below else (3, "bottom")
    axes.annotate(
        line.label,
        middle,
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


def _label_decades(axes: Axes, decades: Sequence[float]) -> None:
    """Numbers below a logarithmic axis, between the powers of ten too: as many as there is space
    for.
    """
    digits = _digits_between(max(decades) - min(decades))

    def text(x: float, _: object) -> str:
        # powers of ten that rounding has made a little smaller are meant too
        power = floor(log10(x) + 1e-9)
        digit = round(x / 10.0**power)
        if not digits or digit not in (1, *digits):
            return ""
        if -3 <= power <= 3:
            return f"{x:g}"
        factor = "" if digit == 1 else f"{digit}\\times"
        return f"${factor}10^{{{power}}}$"

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
    return name if len(name) <= _LONGEST else f"{name[: _LONGEST - 1]}…"


def check_suffix(path: Path) -> None:
    """Refuse a file name that ``save`` has no format or no folder for, before the work is done.

    Raises:
        UsageProblem: the suffix is none of ``SUFFIXES``, or there is no such folder.
    """
    if path.suffix.lower() not in SUFFIXES:
        kind = f"of kind {path.suffix!r}" if path.suffix else "without a suffix"
        raise UsageProblem(
            f"no figure can be saved to {path.name!r}, {kind}",
            f"end it in {', '.join(SUFFIXES)}",
        )
    refuse_unwritable(str(path))


def save(figure: Figure, path: Path) -> None:
    """Write ``figure`` in the format of the suffix of ``path``: whole or not at all.

    Raises:
        UsageProblem: the suffix is none of ``SUFFIXES``, or the file cannot be written.
    """
    check_suffix(path)
    kind = path.suffix.lower().removeprefix(".")
    drawn = BytesIO()
    # no date, and no names drawn by lot: the same result gives the same file
    with rc_context({"svg.hashsalt": "gark"}), warnings.catch_warnings():
        # of a name in letters that the font has not
        warnings.filterwarnings("ignore", "Glyph .* missing")
        figure.savefig(drawn, format=kind, dpi=150, metadata=_undated(kind))
    write_whole(str(path), [drawn.getvalue()])


def _undated(kind: str) -> dict[str, None]:
    if kind == "svg":
        return {"Date": None}
    return {"CreationDate": None} if kind == "pdf" else {}
