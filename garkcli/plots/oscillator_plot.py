"""Pictures of the stability of oscillators: the trace over z, the plane of two springs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from garkcli.exact.roots import RealRoot
from garkcli.plots.plane import (
    ABOVE_ALL,
    Style,
    finite,
    line_style,
    title_of,
    values,
    write_literally,
)
from garkcli.report.stability_data import StabilityReport
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.springs_plane import SpringsPlane

if TYPE_CHECKING:
    from garkcli.arrays import Array


def trace_figure(reports: Sequence[StabilityReport]) -> Figure:
    """|tr M|/2 against z, with the stable step sizes shaded where there is one method."""
    figure = Figure(figsize=(7.2, 3.9), layout="constrained")
    axes = figure.subplots()
    found: list[tuple[str, OscillatorStability]] = []
    for report in reports:
        oscillator = report.found.oscillator
        if oscillator is not None:
            found.append((report.name, oscillator))
    last = max(_last_end(oscillator) for _, oscillator in found)
    end = last * 1.25
    z = np.linspace(0.0, end, 1200)
    for k, (name, oscillator) in enumerate(found):
        half = _half_trace(oscillator, z)
        colour, dashes = line_style(k)
        axes.plot(z, half, color=colour, linestyle=dashes, label=name)
    if len(found) == 1:
        _, only = found[0]
        _shade_stable(axes, only, end)
    axes.axhline(1.0, color="0.1", linewidth=0.9)
    axes.set_ylim(0.0, 2.0)
    axes.set_xlim(0.0, end)
    axes.set_xlabel("z = hω")
    axes.set_ylabel("|tr M(z)| / 2")
    title = title_of([name for name, _ in found])
    axes.set_title(title, fontsize=11, loc="left", parse_math=False)
    if len(found) > 1:
        legend = axes.legend(frameon=False, fontsize=9)
        write_literally(legend)
    return figure


def _half_trace(oscillator: OscillatorStability, z: Array) -> Array:
    """|tr M|/2 at many points."""
    x = z**2
    ratio = oscillator.trace
    with np.errstate(divide="ignore", invalid="ignore"):
        numerators = values(ratio.numerator, x)
        trace = numerators / values(ratio.denominator, x)
    half: Array = np.abs(trace) / 2
    return half


def _shade_stable(axes: Axes, oscillator: OscillatorStability, end: float) -> None:
    for interval in oscillator.stable:
        low = 0.0
        high = end
        if interval.start is not None:
            low = _root(interval.start)
        if interval.end is not None:
            high = min(_root(interval.end), end)
        axes.axvspan(low, high, color="0.9", linewidth=0)


def _root(x: RealRoot) -> float:
    """The z of x = z²."""
    square = float(x.ball(64))
    z: float = square**0.5
    return z


def _last_end(oscillator: OscillatorStability) -> float:
    ends = [i.end for i in oscillator.stable if i.end is not None]
    if not ends:
        return 8.0
    return _root(ends[-1])


def springs_figure(plane: SpringsPlane, name: str) -> Figure:
    """The plane of the two frequencies: where |tr M| > 2, the resonances, is filled."""
    figure = Figure(figsize=(6.4, 5.2), layout="constrained")
    axes = figure.subplots()
    fast, slow = plane.fast, plane.slow
    shown = finite(plane.half_trace)
    red = ["#a02417"]
    unstable = [1.0, ABOVE_ALL]
    inside: Style = {"colors": red, "alpha": 0.35}
    edge: Style = {"colors": red, "linewidths": 1.2}
    axes.contourf(fast, slow, shown, levels=unstable, **inside)
    axes.contour(fast, slow, shown, levels=[1.0], **edge)
    axes.set_xlabel("hω of the fast spring")
    axes.set_ylabel("hω of the slow spring")
    title = f"{name}: filled where unstable"
    axes.set_title(title, fontsize=11, loc="left", parse_math=False)
    return figure
