"""Figures of the energy error over a long time."""

from __future__ import annotations

from matplotlib.figure import Figure

from garkcli.dynamics.energy import Drift

_BLUE = "#1f4e9e"


def drift_figure(result: Drift) -> Figure:
    """The energy error against time."""
    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(result.times, result.energy_errors, color=_BLUE, linewidth=0.4)
    axes.axhline(0.0, color="0.3", linewidth=0.8)
    axes.set_title(
        f"Energy of the oscillator, h = {result.step}: largest error {result.max_energy_error:.2e}, "
        f"drift {result.drift:.1e} per unit of time",
        fontsize=10,
    )
    axes.set_xlabel("time t")
    axes.set_ylabel("H(t) − H(0)")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.margins(x=0)
    return figure
