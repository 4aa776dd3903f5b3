"""Errors against step sizes and against costs, with lines of the slopes of the orders."""

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
"""Gaps from curve to line, in heights of the figure."""
_CLEAR = 0.035
"""The distance from all curves that suffices, in heights of the figure."""
_LABEL = ((0.02, 0.02), (0.06, 0.03), (0.11, 0.035))
"""Distances from a label to the middle of its line, in widths and heights of the figure."""
_SAMPLES = 8
_Points: TypeAlias = Sequence[scene.Point]


def place_line(
    beside: Sequence[scene.Curve], slope: int, curves: Sequence[scene.Curve], is_whole: bool = False
) -> scene.RuledLine:
    """Returns a line of given slope near one of its curves, away from all others, labelled on the
    far side. With ``is_whole`` it is as long as the curve, without label; otherwise it spans three
    points, those of the smallest errors if there is space.
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
    """The curves in widths and heights of the figure, which are given in decades."""

    wide: float
    high: float
    curves: Sequence[_Points]

    @staticmethod
    def of(curves: Sequence[scene.Curve]) -> _Figure:
        points = [point for curve in curves for point in curve.points]
        wide = _extent([x for x, _ in points])
        high = _extent([y for _, y in points])
        empty = _Figure(wide, high, [])
        scaled = [[empty.place(x, y) for x, y in sorted(curve.points)] for curve in curves]
        return _Figure(wide, high, scaled)

    def place(self, x: float, y: float) -> scene.Point:
        return x / self.wide, y / self.high

    def heights(self, x: float) -> list[float]:
        found = []
        for points in self.curves:
            for (a, c), (b, d) in pairwise(points):
                if a <= x <= b:
                    width = (b - a) or 1.0
                    found.append(c + (d - c) * ((x - a) / width))
        return found


def _extent(numbers: Sequence[float]) -> float:
    return max(numbers) - min(numbers) or 1.0


def _parts(curve: scene.Curve, is_whole: bool) -> list[_Points]:
    points = curve.points
    if is_whole or len(points) <= 3:
        return [points]
    return [points[-3:], points[:3]]


def _beside(points: _Points, slope: int, gap: float, is_below: bool) -> scene.RuledLine:
    left, _ = points[0]
    right, _ = points[-1]
    if len(points) == 1:
        left -= 0.2
        right += 0.2
    offsets = [b - slope * a for a, b in points]
    offset = min(offsets) - gap if is_below else max(offsets) + gap
    start, end = ((x, offset + slope * x) for x in (left, right))
    label = f"slope {slope}".replace("-", "−")
    return scene.RuledLine(start, end, label, is_right=(slope > 0) == is_below, is_below=is_below)


def _clearance(line: scene.RuledLine, figure: _Figure) -> float:
    """Returns the least vertical distance of a line and its label from the curves, in heights."""
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
    """Returns the errors; ``against`` is h, evaluations or seconds, if rows have these."""
    (name, first), *others = named
    about = _about(first)
    if others or against != "h":
        return scene.Scene(about, [comparison_panel(named, against)])
    observed = order_text(first.observed_order)
    return scene.Scene(f"{name}\n{about}: observed order {observed}", [errors_panel(first)])


def errors_panel(result: Convergence) -> scene.Panel:
    """Returns the error and the energy error against h, with a line for the observed order."""
    order = result.shown_order
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
    curves: list[scene.Curve] = []
    of_order: dict[int, list[scene.Curve]] = {}
    for style, (name, result) in enumerate(named):
        errors = scene.Curve(style, _decades(curve(result, against)), name, has_dots=True)
        if errors.points:
            curves.append(errors)
            of_order.setdefault(result.shown_order, []).append(errors)
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
    rules: Sequence[scene.RuledLine],
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
    """Returns decimal logarithms, to their certain digits."""
    return [(log10(x), log10(for_programs(y, 9))) for x, y in points if y > 0]


def step_marks(sizes: Sequence[fmpq]) -> list[scene.Mark]:
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
    problem = result.problem
    about = scene.capitalized(result.problem.name)
    if isinstance(problem, RightHandSide) and problem.stiffness is not None:
        about += f", stiffness {problem.stiffness},"
    return f"{about} to t = {result.t_end}"
