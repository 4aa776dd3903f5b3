"""The figure of the paper: the rectangular method on the harmonic oscillator.

Left the energy error in [0, 10⁴] with h = 1/2, right the error against the step size with a line of
slope four.

    python docs/figures/rectangular.py [FILE.png|svg|pdf]

writes ``rectangular.png`` beside this file, or FILE; ``make figures`` does the former.
"""

from __future__ import annotations

import sys
from pathlib import Path

from flint import fmpq
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from garkcli import converge, load, long_run
from garkcli.frozen import replace
from garkcli.longtime.history import LongRun
from garkcli.plots.curves import history_panel
from garkcli.plots.figure import draw
from garkcli.plots.saving import save
from garkcli.problems.oscillator import Oscillator

HERE = Path(__file__).resolve().parent
METHOD = HERE.parents[1] / "methods" / "rectangular.gark.yaml"
OSCILLATOR = Oscillator.default(2, fmpq(1))


def figure() -> Figure:
    """Both panels."""
    made = Figure(figsize=(10.0, 3.8), layout="constrained")
    left, right = made.subplots(1, 2, width_ratios=[65, 35])
    draw_energy(left)
    draw_order(right)
    return made


def draw_energy(axes: Axes) -> None:
    """The energy error against time; above it the first oscillations, which are too many to be seen
    in all.
    """
    run = energy(10_000)
    panel = history_panel(run, run.energy)
    low, high = panel.y.low, panel.y.high
    with_space = replace(panel.y, high=high + 0.85 * (high - low), given=panel.y.marks(4))
    draw(axes, replace(panel, y=with_space, note=""))
    axes.set_title("Error in the total energy, h = 1/2", fontsize=11)
    first = axes.inset_axes((0.03, 0.65, 0.94, 0.27))
    short = energy(60)
    first.plot(
        short.times, short.energy.errors, color="#1f4e9e", linewidth=0.8, marker=".", markersize=4
    )
    first.axhline(0.0, color="0.1", linewidth=0.7)
    first.set_yticks([])
    first.set_title("the first steps", fontsize=9, pad=2)
    first.tick_params(labelsize=8)
    first.margins(x=0)


def energy(t_end: int) -> LongRun:
    """The run to ``t_end``, every extreme of it."""
    tableau = load(str(METHOD)).tableau
    return long_run(tableau, OSCILLATOR, fmpq(t_end), fmpq(1, 2), points=10_000)


def draw_order(axes: Axes) -> None:
    """The error against the step size, and the reference line."""
    rows = converge(load(str(METHOD)).tableau, OSCILLATOR).rows
    h, errors = ([float(row.h) for row in rows], [float(row.error) for row in rows])
    axes.loglog(h, errors, marker="o", color="#1f4e9e", linewidth=1.6, label="error at t = 4")
    reference = [2.5 * errors[-1] * (x / h[-1]) ** 4 for x in h]
    axes.loglog(h, reference, color="#c0392b", linestyle="--", linewidth=1.6, label="order four")
    axes.set_title("Log-log order plot", fontsize=11)
    axes.set_xlabel("step size h")
    axes.set_ylabel("error")
    axes.set_xticks(h, [str(row.h) for row in rows])
    axes.set_xticks([], minor=True)
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.legend(frameon=False)


if __name__ == "__main__":
    save(figure(), Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "rectangular.png")
