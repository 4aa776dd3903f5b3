"""Scenes of results with one curve or area: energy, sweeps, optima, stable values of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, log10
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.design.stable_values import End, StableValues, Strip, StripPart
from garkcli.errors import MethodError
from garkcli.exact.cells import between
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.longtime.history import WORDS, InvariantHistory, LongRun
from garkcli.page.figures import measured
from garkcli.plots import scene
from garkcli.plots.scene import Axis, Curve, Panel, Point, Scene, Shape, polygons
from garkcli.sweep.plan import number
from garkcli.sweep.report import SweepReport, kept, pareto_front
from garkcli.sweep.row import Row

if TYPE_CHECKING:
    from garkcli.design.search.curve import OptimaCurve as Optima

FACTOR = 20.0
"""An axis is logarithmic if its largest number is more than this times the smallest."""

NOTHING = 1e-6
"""An axis with a smaller ratio is linear: its smallest number is a rounded zero."""


def curve_scene(optima: Optima, title: str) -> Scene:
    """The knots, and lines between them. Raises MethodError if there is none."""
    knots = optima.knots
    if not knots:
        raise MethodError("there is nothing to draw", "try more starts", code="arrays")
    across, is_log_across = _coordinates([x.across for x in knots])
    up, is_log_up = _coordinates([x.up for x in knots])
    points = list(zip(across, up, strict=True))
    what = f"{optima.up} against {optima.across}"
    panel = Panel(
        "Pareto front" if optima.is_front else "Optima",
        f"{what}: the best of {optima.starts} starts, in floats.",
        Axis.around(optima.across, across, is_log_across),
        Axis.around(optima.up, up, is_log_up),
        [Curve(0, points, what, has_dots=True)],
        height=240,
        has_grid=True,
    )
    return Scene(title, [panel])


def _coordinates(numbers: list[float]) -> tuple[list[float], bool]:
    least, greatest = min(numbers), max(numbers)
    is_logarithmic = greatest > FACTOR * least and least > NOTHING * greatest
    return [log10(x) for x in numbers] if is_logarithmic else numbers, is_logarithmic


_TITLE = "Energy error over a long time"
_HEIGHT, _LOWER = 200, 110


def energy_scene(run: LongRun, name: str = "") -> scene.Scene:
    """Returns the energy error against time, and a panel for each other invariant."""
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


def drawn(report: SweepReport) -> list[Row]:
    return [x for x in kept(report.done) if all(_is_finite(x, y) for y in report.plan.pareto[:2])]


def sweep_scene(report: SweepReport) -> Scene:
    x, y = report.plan.pareto[:2]
    rows = drawn(report)
    if not rows:
        raise MethodError("there is nothing to draw", "choose other columns", code="arrays")
    front = pareto_front(rows, [x, y])
    # errors spread over powers of ten
    logarithmic = {
        name: "error" in name and min(_value(row, name) for row in rows) > 0 for name in (x, y)
    }

    def coordinate(row: Row, name: str) -> float:
        value = _value(row, name)
        return log10(value) if logarithmic[name] else value

    all_points = [(coordinate(row, x), coordinate(row, y)) for row in rows]
    best = [(coordinate(row, x), coordinate(row, y)) for row in front]
    panel = Panel(
        "Sweep",
        f"{len(rows)} methods by {x} and {y}; {len(front)} of them are on the Pareto front.",
        Axis.around(x, [a for a, _ in all_points], logarithmic[x]),
        Axis.around(y, [b for _, b in all_points], logarithmic[y]),
        [
            Curve(0, all_points, "methods", has_dots=True, has_line=False),
            Curve(1, best, "Pareto front", has_dots=True, has_line=False),
        ],
        height=240,
        has_grid=True,
    )
    return Scene(report.plan.name, [panel])


def _value(row: Row, name: str) -> float:
    value = row[name]
    assert not isinstance(value, dict)
    return number(value)


def _is_finite(row: Row, name: str) -> bool:
    return row.get(name) is not None and isfinite(_value(row, name))


_COLUMNS = 120
"""The values of the first parameter at which a strip is drawn."""


def stable_plane_scene(values: StableValues, title: str) -> Scene:
    x_name, y_name = values.names
    wanted = str(values.stability)
    ends = [x for strip in values.strips for x in (strip.start, strip.end)]
    x = Axis.around(x_name, _widened([float(end) for end in ends if end is not None]))
    heights = [
        float(end)
        for strip in values.strips
        if not strip.is_point
        for part in strip.parts
        for over in [part.over(RealRoot.rational(between(strip.start, strip.end)))]
        if over is not None
        for end in (over.start, over.end)
        if end is not None
    ]
    y = Axis.around(y_name, _widened(heights))
    shapes = [_shape(strip, part, x, y) for strip in values.strips for part in strip.parts]
    panel = Panel(
        wanted.replace("stable", "stability"),
        f"The values of {x_name} and {y_name} for which the method is {wanted}.",
        x,
        y,
        shapes,
        height=260,
        has_grid=True,
    )
    return Scene(f"{wanted} methods of {title}", [panel])


def _widened(numbers: Sequence[float]) -> list[float]:
    found = [*numbers] or [0.0]
    return [min(found) - 1, max(found) + 1]


def _shape(strip: Strip, part: StripPart, x: Axis, y: Axis) -> Shape:
    """Returns a part over a strip: a region, or a line over a single value."""
    if strip.is_point:
        assert strip.start is not None
        at = float(strip.start)
        low, high = (_within(end, y, k) for k, end in enumerate((part.start, part.end)))
        return Curve(0, [(at, low), (at, high)])
    left = x.low if strip.start is None else max(x.low, float(strip.start))
    right = x.high if strip.end is None else min(x.high, float(strip.end))
    # beside the ends, where branches may leave
    places = [left + (right - left) * (k + 0.5) / _COLUMNS for k in range(_COLUMNS)]
    lower: list[Point] = []
    upper: list[Point] = []
    for place in places:
        over = part.over(RealRoot.rational(fmpq(round(place * 2**30), 2**30)))
        if over is not None:
            lower.append((place, _within(over.start, y, 0)))
            upper.append((place, _within(over.end, y, 1)))
    if part.start is not None and part.start == part.end:
        return Curve(0, lower)
    return polygons(0, [[*lower, *reversed(upper)]], 0.25, has_outline=False)


def _within(end: End, y: Axis, which: int) -> float:
    if not isinstance(end, RealRoot):
        return (y.low, y.high)[which]
    return min(max(float(end), y.low), y.high)
