"""Where lines that show a slope are drawn: beside the curves, not on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product
from typing import TypeAlias

from garkcli.plots.scene import Curve, Point, Rule

_GAPS = (0.05, 0.08, 0.12, 0.18, 0.26)
"""Distances from the curve that a line is for, in heights of the figure."""
_CLEAR = 0.035
"""The distance from all curves that is enough, in heights of the figure."""
_LABEL = ((0.02, 0.02), (0.06, 0.03), (0.11, 0.035))
"""Where a label is, from the middle of its line, in widths and heights of the figure."""
_SAMPLES = 8
_Points: TypeAlias = Sequence[Point]


def place_line(
    beside: Sequence[Curve], slope: int, curves: Sequence[Curve], is_whole: bool = False
) -> Rule:
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
    for curve in beside:
        parts += _parts(curve, is_whole)
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


@dataclass(frozen=True)
class _Figure:
    """All curves, in widths and heights of the figure.

    Attributes:
        wide, high: the figure's own, in decades.
        curves: the points of each, from left to right.
    """

    wide: float
    high: float
    curves: Sequence[_Points]

    @staticmethod
    def of(curves: Sequence[Curve]) -> _Figure:
        """The figure that holds some curves."""
        points = [point for curve in curves for point in curve.points]
        wide = _extent([x for x, _ in points])
        high = _extent([y for _, y in points])
        empty = _Figure(wide, high, [])
        scaled = [[empty.place(x, y) for x, y in sorted(curve.points)] for curve in curves]
        return _Figure(wide, high, scaled)

    def place(self, x: float, y: float) -> Point:
        """Where a point in decades is."""
        return x / self.wide, y / self.high

    def heights(self, x: float) -> list[float]:
        """Of the curves that pass x, at x."""
        found = []
        for points in self.curves:
            for (a, c), (b, d) in pairwise(points):
                if a <= x <= b:
                    width = (b - a) or 1.0
                    part = (x - a) / width
                    found.append(c + (d - c) * part)
        return found


def _extent(numbers: Sequence[float]) -> float:
    """From the least to the greatest; 1 where they are one."""
    return max(numbers) - min(numbers) or 1.0


def _parts(curve: Curve, is_whole: bool) -> list[_Points]:
    """The points beside which a line can be: those of the smallest errors, or of the largest."""
    points = curve.points
    if is_whole or len(points) <= 3:
        return [points]
    return [points[-3:], points[:3]]


def _beside(points: _Points, slope: int, gap: float, is_below: bool) -> Rule:
    """The line through no point, with this distance from the nearest."""
    left, _ = points[0]
    right, _ = points[-1]
    if len(points) == 1:
        left -= 0.2
        right += 0.2
    offsets = [b - slope * a for a, b in points]
    offset = max(offsets) + gap
    if is_below:
        offset = min(offsets) - gap
    start, end = ((x, offset + slope * x) for x in (left, right))
    label = f"slope {slope}".replace("-", "−")
    return Rule(start, end, label, is_right=(slope > 0) == is_below, is_below=is_below)


def _clearance(line: Rule, figure: _Figure) -> float:
    """The least vertical distance of the line and its label from the curves, in heights of the
    figure.
    """
    (left, start), (right, end) = line.start, line.end
    points: list[Point] = []
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
        heights = figure.heights(x)
        distances += [abs(y - height) for height in heights]
    return min(distances, default=1.0)
