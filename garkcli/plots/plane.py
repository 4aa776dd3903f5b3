"""Outlines of regions, traced on a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import inf, isnan, log
from typing import TypeAlias

from garkcli.plots.scene import Axis, Point

Row: TypeAlias = Sequence[float]
Sizes: TypeAlias = Callable[[Sequence[complex]], Row]
_Edge: TypeAlias = tuple[int, int, bool]
"""Row and column of the start of an edge, and whether it is vertical."""
_FAR = 1.0
_NODES = 300
"""Nodes on a side of a grid; even, so that none is on the imaginary axis."""
_FLAT = 3.0
"""The bound at which levels are cut, such as logarithms near zeros and poles."""
_THINNED = 0.06  # cells


def compared(small: Sizes, large: Sizes, x: Axis, y: Axis) -> list[list[Point]]:
    """Returns the outlines of ``small`` ≤ ``large``, symmetric in conjugates."""
    across, up = _nodes(x), _nodes(y)
    is_mirrored = y.low == -y.high
    level = []
    for b in up[_NODES // 2 :] if is_mirrored else up:
        row = [complex(a, b) for a in across]
        level.append(_logarithms(small(row), large(row)))
    return outlined(across, up, level[::-1] + level if is_mirrored else level)


def _nodes(axis: Axis) -> list[float]:
    step = (axis.high - axis.low) / (_NODES - 1)
    return [axis.low + step * k for k in range(_NODES - 1)] + [axis.high]


def _logarithms(small: Row, large: Row) -> list[float]:
    pairs = [*zip(small, large, strict=True)]
    try:
        return [log(over / under) for over, under in pairs]
    except (ValueError, ZeroDivisionError):
        return [_logarithm(over, under) for over, under in pairs]


def _logarithm(over: float, under: float) -> float:
    ratio = over / under if under else inf
    return log(ratio) if ratio else -inf


def outlined(x: Row, y: Row, level: Sequence[Row]) -> list[list[Point]]:
    """Returns outlines of ``level`` ≤ 0, the region on their left; NaN is outside."""
    across, up = x[1] - x[0], y[1] - y[0]
    left, bottom = x[0], y[0]
    loops = outlines(level, _THINNED)
    return [[(left + column * across, bottom + row * up) for column, row in loop] for loop in loops]


def outlines(level: Sequence[Row], tolerance: float) -> list[list[Point]]:
    """Returns closed outlines of ``level`` ≤ 0, rows first; simplified by ``tolerance`` cells."""
    border = [_FAR] * (len(level[0]) + 2)
    padded = [border, *([_FAR, *row, _FAR] for row in level), border]
    pieces = dict(_pieces(padded))
    found = []
    while pieces:
        start, edge = pieces.popitem()
        loop = [_crossing(padded, start)]
        while edge != start:
            loop.append(_crossing(padded, edge))
            edge = pieces.pop(edge)
        thin = _thinned([*loop, loop[0]], tolerance)[:-1]
        found.append([(z.real, z.imag) for z in thin])
    return [loop for loop in found if len(loop) > 2]


def _pieces(padded: Sequence[Row]) -> Iterator[tuple[_Edge, _Edge]]:
    """Yields the pieces of outlines in all cells, as start and end edges. Going around a cell, one
    starts where the region ends, and ends where it starts: at the next such place if the middle is
    inside, otherwise at the previous one.
    """
    inside = [[value <= 0 for value in row] for row in padded]
    for i, (below, above) in enumerate(pairwise(inside)):
        for j in _mixed(below, above):
            # the bottom, the right side, the top, the left side
            edges = (i, j, False), (i, j + 1, True), (i + 1, j, False), (i, j, True)
            here = below[j], below[j + 1], above[j + 1], above[j]
            there = (*here[1:], here[0])
            ends = [k for k in range(4) if here[k] and not there[k]]
            starts = [k for k in range(4) if there[k] and not here[k]]
            middle = sum(map(_cut, (*padded[i][j : j + 2], *padded[i + 1][j : j + 2])))
            nearest = min if middle <= 0 else max
            for k in ends:
                yield edges[k], edges[(k + nearest((other - k) % 4 for other in starts)) % 4]


def _mixed(below: Sequence[bool], above: Sequence[bool]) -> Iterator[int]:
    columns = [a + b for a, b in zip(below, above, strict=True)]
    for j, (left, right) in enumerate(pairwise(columns)):
        if 0 < left + right < 4:
            yield j


def _crossing(padded: Sequence[Row], edge: _Edge) -> complex:
    i, j, is_upward = edge
    here, there = _cut(padded[i][j]), _cut(padded[i + is_upward][j + (not is_upward)])
    part = here / (here - there)
    return complex(j - 1, i - 1) + part * (1j if is_upward else 1)


def _cut(value: float) -> float:
    return _FLAT if isnan(value) else max(-_FLAT, min(value, _FLAT))


def _thinned(points: list[complex], tolerance: float) -> list[complex]:
    """Simplifies a line by the algorithm of Ramer, Douglas and Peucker."""
    keeps = {0, len(points) - 1}
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        distances = [_distance(z, points[first], points[last]) for z in points[first + 1 : last]]
        largest = max(distances, default=0.0)
        if largest > tolerance:
            far = first + 1 + distances.index(largest)
            keeps.add(far)
            spans += [(first, far), (far, last)]
    return [points[k] for k in sorted(keeps)]


def _distance(z: complex, start: complex, end: complex) -> float:
    """Returns the distance from the line through both ends, or from the end if they are equal."""
    along = end - start
    return abs(((z - start) * along.conjugate()).imag) / abs(along) if along else abs(z - start)
