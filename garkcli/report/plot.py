"""The figures of the convergence test, and how figures become files.

Everything is told apart by marks and dashes as well as by colour, so that the figures can be printed in grey.
"""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from garkcli.errors import UsageProblem
from garkcli.report.asciiplot import log10
from garkcli.report.comparison import curve
from garkcli.report.convergence_data import Result, problem_name

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
    {"marker": "P", "linestyle": (0, (1, 3)), "color": "#7b3f9e", "markerfacecolor": "white"},
    {"marker": "*", "linestyle": (0, (3, 1, 3, 3)), "color": "#2aa0a8"},
)
_AXES = {"h": "step size h", "evaluations": "evaluations of vector fields", "seconds": "seconds of processor time"}
_LONGEST = 72  # characters of a name in a legend
_FLOATS = 290  # decades: beyond, logarithms are drawn on a linear axis


def convergence_figure(result: Result) -> Figure:
    """Error and energy error against h, log–log, with a line whose slope is the visible order."""
    points = [(log10(x), log10(error)) for x, error in curve(result, "h")]
    kept = [(log10(row.h), log10(row.energy_error)) for row in result.rows if row.energy_error > 0]
    curves = []
    if points:
        h, error = [x for x, _ in points], [y for _, y in points]
        curves.append(Curve(h, error, "error", {"marker": "o", "color": _BLUE, "linewidth": 1.6}))
    if kept:
        style = {"marker": "s", "color": "0.45", "linewidth": 1.0, "markerfacecolor": "white"}
        curves.append(Curve([x for x, _ in kept], [y for _, y in kept], "energy error", style))
    if points:
        above = max(0.35, 0.03 * (max(error) - min(error)))  # beside the errors, not on them
        reference = [error[-1] + result.visible_order * (x - h[-1]) + above for x in h]
        label = f"reference, slope {result.visible_order}"
        curves.append(Curve(h, reference, label, {"color": _RED, "linestyle": "--", "linewidth": 1.4}))
    observed = "none" if result.observed_order is None else f"{result.observed_order:.2f}"
    title = f"{_title(result)}: observed order {observed}"
    figure = _log_log(curves, [], title, "step size h", 4.8)
    if curves:
        figure.axes[0].legend(frameon=False)
    return figure


def comparison_figure(named: Sequence[tuple[str, Result]], against: str = "h") -> Figure:
    """Errors of several methods, log–log, with a line for each visible order.

    Args:
        named: names and results of methods, at least one.
        against: h, evaluations or seconds; the latter two need rows with costs.
    """
    curves: list[Curve] = []
    lines: dict[int, Curve] = {}
    for k, (name, result) in enumerate(named):
        points = [(log10(x), log10(error)) for x, error in curve(result, against)]
        if not points:
            continue
        xs, ys = [x for x, _ in points], [y for _, y in points]
        curves.append(Curve(xs, ys, _shortened(name), _style(k)))
        order = result.visible_order
        if order > 0 and order not in lines:
            lines[order] = _slope_line(xs, ys, order if against == "h" else -order)
    size = 4.6 + 0.23 * len(curves)
    figure = _log_log(curves, list(lines.values()), _title(named[0][1]), _AXES[against], size)
    drawn = figure.axes[0].get_lines()[: len(curves)]
    # below the axes, where no curve can be
    legend = figure.legend(
        drawn, ["method"] * len(drawn), loc="outside lower left", frameon=False, handlelength=3.5
    )
    for text, x in zip(legend.get_texts(), curves, strict=True):  # names are no formulas, and may begin with _
        text.set_parse_math(False)
        text.set_text(x.label)
    return figure


def _title(result: Result) -> str:
    name = problem_name(result)
    return f"{name[:1].upper()}{name[1:]} to t = {result.t_end}"


@dataclass(frozen=True)
class Curve:
    """Points in decimal logarithms, and how to draw them."""

    xs: Sequence[float]
    ys: Sequence[float]
    label: str
    style: Mapping[str, Any]


def _style(k: int) -> dict[str, Any]:
    """Of the k-th curve: marks and dashes are combined anew once all have been used."""
    count = len(_STYLES)
    dashes = _STYLES[(k + k // count) % count]["linestyle"]
    return {**_STYLES[k % count], "linestyle": dashes, "linewidth": 1.4, "markersize": 5.5}


def _slope_line(xs: Sequence[float], ys: Sequence[float], slope: int) -> Curve:
    """A line of this slope below the small errors of a curve."""
    below = max(0.4, 0.05 * (max(ys) - min(ys)))
    count = min(3, len(xs))
    ends = [xs[-count], xs[-1]] if count > 1 else [xs[-1] - 0.2, xs[-1] + 0.2]
    line = [ys[-1] + slope * (x - xs[-1]) - below for x in ends]
    return Curve(ends, line, f"slope {slope}".replace("-", "−"), {"color": "0.3", "linewidth": 0.8})


def _log_log(curves: Sequence[Curve], lines: Sequence[Curve], title: str, label: str, size: float) -> Figure:
    """A figure of the curves; where they leave the range of floats, of their logarithms.

    Args:
        curves: with an entry in the legend each.
        lines: with their label beside their middle.
        title: of the figure.
        label: of the horizontal axis.
        size: inches from top to bottom.
    """
    figure = Figure(figsize=(6.4, size), layout="constrained")
    axes = figure.add_subplot()
    decades = [abs(z) for curve in (*curves, *lines) for z in (*curve.xs, *curve.ys)]
    has_floats = max(decades, default=0) < _FLOATS

    def place(z: float) -> float:
        return 10**z if has_floats else z

    for x in (*curves, *lines):
        draw = axes.loglog if has_floats else axes.plot
        style = x.style if x in curves else {**x.style, "zorder": 1.5}
        draw([place(z) for z in x.xs], [place(z) for z in x.ys], label=x.label, **style)
    for x in lines:
        middle = place(sum(x.xs) / 2), place(sum(x.ys) / 2)
        falls = (x.ys[-1] - x.ys[0]) * (x.xs[-1] - x.xs[0]) < 0
        axes.annotate(
            x.label,
            middle,
            (-3 if falls else 3, -3),
            textcoords="offset points",
            ha="right" if falls else "left",
            va="top",
            fontsize=9,
            color="0.3",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
        )
    if not has_floats:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda x, _: f"$10^{{{x:g}}}$"))
            axis.set_major_locator(MaxNLocator(8))
    axes.set_title(title, fontsize=11, parse_math=False)
    axes.set_xlabel(label)
    axes.set_ylabel("error")
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    return figure


def _shortened(name: str) -> str:
    return name if len(name) <= _LONGEST else f"{name[: _LONGEST - 1]}…"


def check_suffix(path: Path) -> None:
    """Refuse a file name that ``save`` has no format or no folder for, before the work is done.

    Raises:
        UsageProblem: the suffix is none of ``SUFFIXES``, or there is no such folder.
    """
    if path.suffix.lower() not in SUFFIXES:
        kind = f"of kind {path.suffix!r}" if path.suffix else "without a suffix"
        raise UsageProblem(f"no figure can be saved to {path.name!r}, {kind}", f"end it in {', '.join(SUFFIXES)}")
    if not path.parent.is_dir():
        raise UsageProblem(f"cannot write {path}: there is no such folder", "choose another place")


def save(figure: Figure, path: Path) -> None:
    """Write ``figure`` in the format of the suffix of ``path``: whole or not at all.

    Raises:
        UsageProblem: the suffix is none of ``SUFFIXES``.
        OSError: the file cannot be written.
    """
    check_suffix(path)
    kind = path.suffix.lower().removeprefix(".")
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    try:
        # no date, and no names drawn by lot: the same result gives the same file
        with os.fdopen(handle, "wb") as file, rc_context({"svg.hashsalt": "gark"}), warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Glyph .* missing")  # of a name in letters that the font has not
            figure.savefig(file, format=kind, dpi=150, metadata=_undated(kind))
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(name, 0o666 & ~umask)  # mkstemp makes it private; a figure is an ordinary file
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _undated(kind: str) -> dict[str, None]:
    return {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
