"""Figures of conserved quantities over a long time.

Lines differ in dashes as well as in colour, so that the figures can be printed in grey.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.problems.oscillator import Oscillator

_PALE, _RED = "#7fa1d6", "#a02417"  # of clearly different lightness in grey
_ERRORS: Mapping[str, Any] = {"color": _PALE, "linewidth": 1.1, "solid_joinstyle": "round"}
_POWERS: Mapping[str, Any] = {"style": "sci", "scilimits": (-2, 3), "useMathText": True}


def energy_figure(run: LongRun) -> Figure:
    """The energy error against time, and below it a panel for the error of each other invariant."""
    histories = run.invariants
    rows = len(histories)
    heights = [2.0] * rows
    heights[0] = 3.0  # the energy
    height = 0.9 + sum(heights)
    figure = Figure(figsize=(7.2, height), layout="constrained")
    grid = figure.subplots(rows, 1, sharex=True, squeeze=False, height_ratios=heights)
    panels = grid[:, 0]
    problem = run.problem
    name = "oscillator" if isinstance(problem, Oscillator) else problem.name
    initial = name[:1].upper()
    capitalized = initial + name[1:]
    steps = f"h = {run.step}, {run.steps} steps"
    title = f"{capitalized}, {steps}"
    # names of files are no formulas
    figure.suptitle(title, fontsize=11, parse_math=False)
    for axes, history in zip(panels, histories, strict=True):
        draw_history(axes, run, history)
    panels[-1].set_xlabel("time t")
    return figure


def draw_history(axes: Axes, run: LongRun, history: InvariantHistory) -> None:
    """One quantity against time on ``axes``, with the line of its drift where it has one."""
    axes.plot(run.times, history.errors, **_ERRORS)
    axes.axhline(0.0, color="0.1", linewidth=0.9)
    if history.verdict == "drifts" and history.shape == "line":
        _draw_drift(axes, run, history)
    largest = f"largest error {history.max_error:.2e}"
    title = f"{history.name}: {largest}, {_words(history)}"
    axes.set_title(title, fontsize=10, loc="left", parse_math=False)
    is_energy = history.name == "energy"
    label = "H(t) − H(0)" if is_energy else "error"
    axes.set_ylabel(label)
    axes.ticklabel_format(axis="y", **_POWERS)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.margins(x=0)


def _draw_drift(axes: Axes, run: LongRun, history: InvariantHistory) -> None:
    """The line of the drift, in the middle of what the errors do besides."""
    drift = history.drift
    if drift is None:
        return
    points = zip(run.times, history.errors, strict=True)
    left = [error - drift * t for t, error in points]
    extent = max(left) + min(left)
    middle = extent / 2
    start = run.times[0]
    end = run.times[-1]
    ends = [start, end]
    heights = [middle + drift * t for t in ends]
    axes.plot(
        ends,
        heights,
        color=_RED,
        linestyle=(0, (5, 4)),  # the errors show between the dashes
        linewidth=1.4,
        label=f"drift {drift:.2e} per unit of time",
    )
    axes.legend(frameon=False, fontsize=9)


def _words(history: InvariantHistory) -> str:
    words = {
        "exact": "conserved exactly",
        "round-off": "not above round-off",
        "unstable": "blown up",
        "undecided": "not decided",
    }
    return words.get(history.verdict, history.verdict)
