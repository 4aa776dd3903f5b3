"""The figure of the convergence test, and how figures become files.

Everything is told apart by marks and dashes as well as by colour, so that the figures can be printed in grey.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from garkcli.errors import UsageProblem
from garkcli.report.asciiplot import log10
from garkcli.report.convergence import Result, problem_name

SUFFIXES = (".png", ".svg", ".pdf")
"""The kinds of file that figures can be saved as."""
_BLUE, _RED = "#1f4e9e", "#c0392b"  # of clearly different lightness in grey
_FLOATS = 290  # decades: beyond, logarithms are drawn on a linear axis


def convergence_figure(result: Result) -> Figure:
    """Error and energy error against h, log–log, with a line whose slope is the visible order."""
    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    axes = figure.add_subplot()
    h = [log10(row.h) for row in result.rows]
    error = [log10(row.error) for row in result.rows]
    kept = [(x, log10(row.energy_error)) for x, row in zip(h, result.rows, strict=True) if row.energy_error > 0]
    above = max(0.35, 0.03 * (max(error) - min(error)))  # beside the errors, not on them
    reference = [error[-1] + result.visible_order * (x - h[-1]) + above for x in h]
    has_floats = max(map(abs, [*error, *reference, *(y for _, y in kept)])) < _FLOATS

    def draw(xs: list[float], ys: list[float], label: str, **style: Any) -> None:
        if has_floats:
            axes.loglog([10**x for x in xs], [10**y for y in ys], label=label, **style)
        else:
            axes.plot(xs, ys, label=label, **style)

    draw(h, error, "error", marker="o", color=_BLUE, linewidth=1.6)
    if kept:
        xs, ys = [x for x, _ in kept], [y for _, y in kept]
        draw(xs, ys, "energy error", marker="s", color="0.45", linewidth=1.0, markerfacecolor="white")
    label = f"reference, slope {result.visible_order}"
    draw(h, reference, label, color=_RED, linestyle="--", linewidth=1.4)
    if not has_floats:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda x, _: f"$10^{{{x:g}}}$"))
            axis.set_major_locator(MaxNLocator(8))
    observed = "none" if result.observed_order is None else f"{result.observed_order:.2f}"
    title = problem_name(result).capitalize()
    axes.set_title(f"{title} to t = {result.t_end}: observed order {observed}", fontsize=11)
    axes.set_xlabel("step size h")
    axes.set_ylabel("error")
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.legend(frameon=False)
    return figure


def check_suffix(path: Path) -> None:
    """Refuse a file name that ``save`` has no format for.

    Raises:
        UsageProblem: the suffix is none of ``SUFFIXES``.
    """
    if path.suffix.lower() not in SUFFIXES:
        kind = f"of kind {path.suffix!r}" if path.suffix else "without a suffix"
        raise UsageProblem(f"no figure can be saved to {path.name!r}, {kind}", f"end it in {', '.join(SUFFIXES)}")


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
        with os.fdopen(handle, "wb") as file, rc_context({"svg.hashsalt": "gark"}):
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
