"""Where lines that show a slope are drawn: beside the curves, not on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any

_GAPS = (0.05, 0.08, 0.12, 0.18, 0.26)
"""Distances from the curve that a line is for, in heights of the figure."""
_CLEAR = 0.035
"""The distance from all curves that is enough, in heights of the figure."""
_LABEL = ((0.02, 0.02), (0.06, 0.03), (0.11, 0.035))
"""Where a label is, from the middle of its line, in widths and heights of the figure."""
_SAMPLES = 8


@dataclass(frozen=True)
class Curve:
    """Points in decimal logarithms, and how to draw them."""

    xs: Sequence[float]
    ys: Sequence[float]
    label: str
    style: Mapping[str, Any]


@dataclass(frozen=True)
class Line:
    """A line of a slope.

    Attributes:
        xs, ys: its ends, in decimal logarithms.
        slope: decades a decade.
        is_below: whether it is below the curve that it is for; its label is on its far side.
    """

    xs: tuple[float, float]
    ys: tuple[float, float]
    slope: int
    is_below: bool

    @property
    def label(self) -> str:
        """Its slope in words."""
        return f"slope {self.slope}".replace("-", "−")

    @property
    def is_right(self) -> bool:
        """Whether its label is on the right of it: on its far side from the curve."""
        return (self.slope > 0) == self.is_below


def place_line(
    beside: Sequence[Curve], slope: int, curves: Sequence[Curve], is_whole: bool = False
) -> Line:
    """A line of this slope near one of the curves that it is for, where no other curve is.

    Args:
        beside: the curves that have this slope, each with at least one point.
        slope: of the line, in decades a decade.
        curves: all that is drawn.
        is_whole: the line is as long as the curve, and has no label; otherwise it is as long as
            three points of it, those of the smallest errors if there is space.

    The first place that is clear of all curves is taken; where none is, the clearest.
    """
    wide = _extent([x for curve in curves for x in curve.xs])
    high = _extent([y for curve in curves for y in curve.ys])
    scaled = []
    for curve in curves:
        points = sorted(zip(curve.xs, curve.ys, strict=True))
        scaled.append([(x / wide, y / high) for x, y in points])
    parts = [part for curve in beside for part in _parts(curve, is_whole)]
    sides = (not is_whole, is_whole)
    best, clearest = None, -1.0
    # the nearest places first
    for gap, part, is_below in product(_GAPS, parts, sides):
        line = _beside(part, slope, gap * high, is_below)
        clear = _clearance(line, scaled, wide, high, not is_whole)
        if clear > clearest:
            best, clearest = line, clear
        if clear >= _CLEAR:
            return line
    assert best is not None
    return best


def _extent(numbers: Sequence[float]) -> float:
    """From the least to the greatest; 1 where they are one."""
    return max(numbers) - min(numbers) or 1.0


def _parts(curve: Curve, is_whole: bool) -> list[list[tuple[float, float]]]:
    """The points beside which a line can be: those of the smallest errors, or of the largest."""
    points = list(zip(curve.xs, curve.ys, strict=True))
    if is_whole or len(points) <= 3:
        return [points]
    return [points[-3:], points[:3]]


def _beside(
    points: Sequence[tuple[float, float]], slope: int, gap: float, is_below: bool
) -> Line:
    """The line through no point, with this distance from the nearest."""
    left, right = points[0][0], points[-1][0]
    if len(points) == 1:
        left, right = left - 0.2, right + 0.2
    offsets = [b - slope * a for a, b in points]
    offset = min(offsets) - gap if is_below else max(offsets) + gap
    start, end = offset + slope * left, offset + slope * right
    return Line((left, right), (start, end), slope, is_below)


def _clearance(
    line: Line,
    scaled: Sequence[Sequence[tuple[float, float]]],
    wide: float,
    high: float,
    has_label: bool,
) -> float:
    """The least vertical distance of the line and its label from the curves, in heights of the
    figure.
    """
    (left, right), (start, end) = line.xs, line.ys
    points = []
    for k in range(_SAMPLES + 1):
        part = k / _SAMPLES
        x = left + (right - left) * part
        y = start + (end - start) * part
        points.append((x / wide, y / high))
    if has_label:
        x = (left + right) / 2 / wide
        y = (start + end) / 2 / high
        away = 1 if line.is_right else -1
        up = -1 if line.is_below else 1
        points += [(x + away * u, y + up * v) for u, v in _LABEL]
    distances = [abs(y - height) for x, y in points for height in _heights(scaled, x)]
    return min(distances, default=1.0)


def _heights(scaled: Sequence[Sequence[tuple[float, float]]], x: float) -> list[float]:
    """Of the curves that pass x, at x."""
    found = []
    for points in scaled:
        for (a, c), (b, d) in pairwise(points):
            if a <= x <= b:
                width = (b - a) or 1.0
                found.append(c + (d - c) * (x - a) / width)
    return found
