"""Conserved quantities over a long time."""

from __future__ import annotations

from math import isfinite

from garkcli.frozen import replace
from garkcli.longtime.history import WORDS, InvariantHistory, LongRun
from garkcli.page.figures import measured
from garkcli.plots import scene

_TITLE = "Energy error over a long time"
_HEIGHT, _LOWER = 200, 110
"""Heights of the panel of the energy and of the others."""


def energy_scene(run: LongRun, name: str = "") -> scene.Scene:
    """Returns the energy error against time, with a further panel for each other invariant.

    ``name`` may be empty.
    """
    about = f"{scene.capitalized(run.problem.name)}, h = {run.step}, {run.steps} steps"
    title = f"{name}\n{about}" if name else about
    return scene.Scene(title, [history_panel(run, history) for history in run.invariants])


def history_panel(run: LongRun, history: InvariantHistory) -> scene.Panel:
    """Returns one quantity against time, with the line of its drift if it has one."""
    pairs = zip(run.times, history.errors, strict=True)
    points = [(t, error) for t, error in pairs if isfinite(error)]
    exponent = scene.common_exponent([error for _, error in points] or [0.0])
    factor = 10.0**-exponent
    errors = scene.Curve(0, _scaled(points, factor), width=1.1, is_dense=True)
    start, end = 0.0, run.end
    shapes = [errors]
    if history.verdict == "drifts" and history.shape == "line" and history.drift is not None:
        drift = history.drift
        # in the middle of what the errors do besides
        left = [error - drift * t for t, error in points]
        middle = (max(left) + min(left)) / 2
        line = [(t, middle + drift * t) for t in (start, end)]
        label = f"its drift, {scene.in_words(f'{drift:.2e}')} per unit of time"
        shapes = [
            replace(errors, label=f"{history.name} error"),
            scene.Curve(1, _scaled(line, factor), label),
        ]
    is_first = history is run.invariants[0]
    label = f"error of {history.name}" if is_first else "error"
    if history.name == "energy":
        label = "H(t) − H(0)"
    if exponent:
        label += f" in {scene.power_of_ten(exponent)}"
    became = became_of(history)
    y = scene.Axis.around(label, [0.0, *(error for _, error in errors.points)])
    return scene.Panel(
        _TITLE,
        f"{scene.capitalized(history.name)} error against time, from 0 to {end:g}: {became}.",
        scene.Axis("time t", start, end),
        y,
        [*shapes, scene.RuledLine((start, 0.0), (end, 0.0))],
        f"{history.name}: {became}",
        _HEIGHT if is_first else _LOWER,
        has_grid=True,
    )


def became_of(history: InvariantHistory) -> str:
    """Returns the verdict and the largest error, to its certain digits."""
    _, word = WORDS[history.verdict]
    if history.verdict in ("exact", "round-off") or not isfinite(history.max_error):
        return word
    largest = scene.in_words(measured(history.max_error, history.round_off, 2))
    return f"{word}, largest error {largest}"


def _scaled(points: list[scene.Point], factor: float) -> list[scene.Point]:
    return [(t, error * factor) for t, error in points]
