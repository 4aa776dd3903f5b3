"""Errors over step sizes and over what they cost, with lines of the slopes that orders ask for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise, product
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.convergence.result import Convergence, curve
from garkcli.frozen import Frozen, replace
from garkcli.page.figures import for_programs, log10, order_text, scientific
from garkcli.plots import scene
from garkcli.problems.righthandside import RightHandSide

_GAPS = (0.05, 0.08, 0.12, 0.18, 0.26)
"""Distances from the curve that a line is for, in heights of the figure."""
_CLEAR = 0.035
"""The distance from all curves that is enough, in heights of the figure."""
_LABEL = ((0.02, 0.02), (0.06, 0.03), (0.11, 0.035))
"""Where a label is, from the middle of its line, in widths and heights of the figure."""
_SAMPLES = 8
_Points: TypeAlias = Sequence[scene.Point]


def place_line(
    beside: Sequence[scene.Curve], slope: int, curves: Sequence[scene.Curve], is_whole: bool = False
) -> scene.Rule:
    """A line of this slope near one of the curves that it is for, where no other curve is; its
    label is on its far side.

    Args:
        beside: the curves that have this slope, each with at least one point.
        slope: of the line, in decades a decade.
        curves: all that is drawn.
        is_whole: the line is as long as the curve, and has no label; otherwise it is as long as
            three points of it, those of the smallest errors if there is space.

    The first place that is clear of all curves is taken; where none is, the clearest.
    """
    figure = _Figure.of(curves)
    parts: list[_Points] = []
    for one in beside:
        parts += _parts(one, is_whole)
    sides = (not is_whole, is_whole)
    best = None
    clearest = -1.0
    # the nearest places first
    for gap, part, is_below in product(_GAPS, parts, sides):
        line = _beside(part, slope, gap * figure.high, is_below)
        line = replace(line, label="") if is_whole else line
        clear = _clearance(line, figure)
        if clear > clearest:
            best, clearest = line, clear
        if clear >= _CLEAR:
            return line
    assert best is not None
    return best


class _Figure(Frozen):
    """All curves, in widths and heights of the figure.

    Attributes:
        wide, high: the figure's own, in decades.
        curves: the points of each, from left to right.
    """

    wide: float
    high: float
    curves: Sequence[_Points]

    @staticmethod
    def of(curves: Sequence[scene.Curve]) -> _Figure:
        """The figure that holds some curves."""
        points = [point for curve in curves for point in curve.points]
        wide = _extent([x for x, _ in points])
        high = _extent([y for _, y in points])
        empty = _Figure(wide, high, [])
        scaled = [[empty.place(x, y) for x, y in sorted(curve.points)] for curve in curves]
        return _Figure(wide, high, scaled)

    def place(self, x: float, y: float) -> scene.Point:
        """Where a point in decades is."""
        return x / self.wide, y / self.high

    def heights(self, x: float) -> list[float]:
        """Of the curves that pass x, at x."""
        found = []
        for points in self.curves:
            for (a, c), (b, d) in pairwise(points):
                if a <= x <= b:
                    width = (b - a) or 1.0
                    found.append(c + (d - c) * ((x - a) / width))
        return found


def _extent(numbers: Sequence[float]) -> float:
    """From the least to the greatest; 1 where they are one."""
    return max(numbers) - min(numbers) or 1.0


def _parts(curve: scene.Curve, is_whole: bool) -> list[_Points]:
    """The points beside which a line can be: those of the smallest errors, or of the largest."""
    points = curve.points
    if is_whole or len(points) <= 3:
        return [points]
    return [points[-3:], points[:3]]


def _beside(points: _Points, slope: int, gap: float, is_below: bool) -> scene.Rule:
    """The line through no point, with this distance from the nearest."""
    left, _ = points[0]
    right, _ = points[-1]
    if len(points) == 1:
        left -= 0.2
        right += 0.2
    offsets = [b - slope * a for a, b in points]
    offset = min(offsets) - gap if is_below else max(offsets) + gap
    start, end = ((x, offset + slope * x) for x in (left, right))
    label = f"slope {slope}".replace("-", "−")
    return scene.Rule(start, end, label, is_right=(slope > 0) == is_below, is_below=is_below)


def _clearance(line: scene.Rule, figure: _Figure) -> float:
    """The least vertical distance of the line and its label from the curves, in heights of the
    figure.
    """
    (left, start), (right, end) = line.start, line.end
    points: list[scene.Point] = []
    for k in range(_SAMPLES + 1):
        part = k / _SAMPLES
        points.append(figure.place(left + (right - left) * part, start + (end - start) * part))
    if line.label:
        x, y = figure.place((left + right) / 2, (start + end) / 2)
        away = 1 if line.is_right else -1
        up = -1 if line.is_below else 1
        points += [(x + away * u, y + up * v) for u, v in _LABEL]
    distances: list[float] = []
    for x, y in points:
        distances += [abs(y - height) for height in figure.heights(x)]
    return min(distances, default=1.0)


_TITLE = "Convergence"
_HEIGHT = 240
_AXES = {
    "h": "step size h",
    "evaluations": "evaluations of vector fields",
    "seconds": "seconds of processor time",
}
_MOST_STEPS = 6
_LONGEST_STEP = 6  # characters


def errors_scene(named: Sequence[tuple[str, Convergence]], against: str = "h") -> scene.Scene:
    """Errors of methods; of one over step sizes also the energy error.

    Args:
        named: names and results of methods, at least one.
        against: h, evaluations or seconds; the latter two need rows with costs.
    """
    (name, first), *others = named
    about = _about(first)
    if others or against != "h":
        return scene.Scene(about, [comparison_panel(named, against)])
    observed = order_text(first.observed_order)
    return scene.Scene(f"{name}\n{about}: observed order {observed}", [errors_panel(first)])


def errors_panel(result: Convergence) -> scene.Panel:
    """Error and energy error against h, log–log, with a line whose slope is the visible order."""
    order = result.visible_order
    energies = [(row.h, row.energy_error) for row in result.rows if row.energy_error is not None]
    errors = scene.Curve(0, _decades(curve(result, "h")), "error", has_dots=True)
    energy = scene.Curve(2, _decades(energies), "energy error", has_dots=True)
    curves = [x for x in (errors, energy) if x.points]
    if errors.points:
        line = place_line([errors], order, curves, is_whole=True)
        curves.insert(1, scene.Curve(1, [line.start, line.end], f"reference, slope {order}"))
    sizes = [row.h for row in result.rows]
    observed = order_text(result.observed_order)
    description = (
        f"Error at t = {result.t_end} over the step size, from h = {sizes[0]} to h = {sizes[-1]}, "
        f"both axes logarithmic: the observed order is {observed}, beside a line of slope {order}."
    )
    return _panel(description, curves, [], "h", [result])


def comparison_panel(named: Sequence[tuple[str, Convergence]], against: str = "h") -> scene.Panel:
    """Errors of several methods, log–log, with a line for each visible order."""
    curves: list[scene.Curve] = []
    of_order: dict[int, list[scene.Curve]] = {}
    for style, (name, result) in enumerate(named):
        errors = scene.Curve(style, _decades(curve(result, against)), name, has_dots=True)
        if errors.points:
            curves.append(errors)
            of_order.setdefault(result.visible_order, []).append(errors)
    # errors rise with h, and fall with what they cost
    sign = 1 if against == "h" else -1
    rules = [
        place_line(beside, sign * order, curves) for order, beside in of_order.items() if order > 0
    ]
    names = ", ".join(x.label for x in curves)
    description = f"Errors over the {_AXES[against]}, both axes logarithmic, of {names}."
    return _panel(description, curves, rules, against, [result for _, result in named])


def _panel(
    description: str,
    curves: Sequence[scene.Curve],
    rules: Sequence[scene.Rule],
    against: str,
    results: Sequence[Convergence],
) -> scene.Panel:
    shapes: list[scene.Shape] = [*rules, *curves]
    drawn = [point for x in curves for point in x.points]
    drawn += [end for rule in rules for end in (rule.start, rule.end)]
    given = step_marks([row.h for x in results for row in x.rows]) if against == "h" else []
    x = scene.Axis.around(_AXES[against], [a for a, _ in drawn], True, given)
    y = scene.Axis.around("error", [b for _, b in drawn], True)
    return scene.Panel(_TITLE, description, x, y, shapes, height=_HEIGHT, has_grid=True)


def _decades(points: Iterable[tuple[Any, Any]]) -> list[scene.Point]:
    """The decimal logarithms of points, of the digits that are certain; without those where there
    are none.
    """
    return [(log10(x), log10(for_programs(y, 9))) for x, y in points if y > 0]


def step_marks(sizes: Sequence[fmpq]) -> list[scene.Mark]:
    """The step sizes themselves, as many as there is space for."""
    places = {h: log10(h) for h in sorted(set(sizes), reverse=True)}
    least = (max(places.values()) - min(places.values())) / _MOST_STEPS
    found: list[scene.Mark] = []
    for h, at in places.items():
        if not found or found[-1].at - at >= least:
            exact = str(h)
            label = exact if len(exact) <= _LONGEST_STEP else scene.in_words(scientific(h, 2))
            found.append(scene.Mark(at, label))
    return found


def _about(result: Convergence) -> str:
    """The problem and the time, with a capital."""
    problem = result.problem
    about = scene.capitalized(result.problem.name)
    if isinstance(problem, RightHandSide) and problem.stiffness is not None:
        about += f", stiffness {problem.stiffness},"
    return f"{about} to t = {result.t_end}"
