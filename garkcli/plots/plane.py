"""Outlines of areas, traced on a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import hypot
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from garkcli.plots.scene import Axis, Point

if TYPE_CHECKING:
    from garkcli.arrays import Floats, Integers


_Edge: TypeAlias = tuple[int, int, bool]
"""Row and column of the node where an edge of the grid begins, and whether it goes upward."""
_FAR = 1.0
"""The value of the nodes around the grid."""
_PIECES = {
    # which corners are inside (bottom left 1, bottom right 2, top right 4, top left 8): from
    # which side to which
    1: ("bl",),
    2: ("rb",),
    3: ("rl",),
    4: ("tr",),
    6: ("tb",),
    7: ("tl",),
    8: ("lt",),
    9: ("bt",),
    11: ("rt",),
    12: ("lr",),
    13: ("br",),
    14: ("lb",),
}
_APART = {5: ("bl", "tr"), 10: ("rb", "lt")}
"""Two opposite corners inside, and the middle outside."""
_JOINED = {5: ("br", "tl"), 10: ("rt", "lb")}
"""The same with the middle inside."""


def outlines(level: Floats, tolerance: float) -> list[list[Point]]:
    """The closed outlines of where ``level`` ≤ 0, with points left out that lie on the line.

    Args:
        level: values at the nodes, shape (rows, columns), finite.
        tolerance: how far from the line a point may be that is left out, in cells.
    """
    padded = np.pad(level, 1, constant_values=_FAR)
    pieces = dict(_all_pieces(padded))
    found = []
    while pieces:
        start, edge = pieces.popitem()
        loop = [_crossing(padded, start)]
        while edge != start:
            loop.append(_crossing(padded, edge))
            edge = pieces.pop(edge)
        found.append(_thinned([*loop, loop[0]], tolerance)[:-1])
    return [loop for loop in found if len(loop) > 2]


def _all_pieces(padded: Floats) -> Iterator[tuple[_Edge, _Edge]]:
    """The pieces in all cells, from the edge where each begins to that where it ends."""
    kinds = _kinds(padded)
    is_passed = (kinds > 0) & (kinds < 15)
    for i, j in np.argwhere(is_passed).tolist():
        kind = int(kinds[i, j])
        for piece in _pieces_of(kind, padded[i : i + 2, j : j + 2]):
            yield _edge(i, j, piece[0]), _edge(i, j, piece[1])


def _kinds(padded: Floats) -> Integers:
    """Which corners of each cell are inside, as the keys of ``_PIECES``."""
    inside = (padded <= 0).astype(int)
    below = inside[:-1]
    above = inside[1:]
    left = below[:, :-1] + 8 * above[:, :-1]
    right = 2 * below[:, 1:] + 4 * above[:, 1:]
    kinds: Integers = left + right
    return kinds


def _pieces_of(kind: int, corners: Floats) -> tuple[str, ...]:
    if kind in _PIECES:
        return _PIECES[kind]
    is_joined = float(corners.mean()) <= 0
    return _JOINED[kind] if is_joined else _APART[kind]


def _edge(i: int, j: int, side: str) -> _Edge:
    if side == "b":
        return i, j, False
    if side == "t":
        return i + 1, j, False
    if side == "l":
        return i, j, True
    return i, j + 1, True


def _crossing(padded: Floats, edge: _Edge) -> Point:
    """Where the outline crosses an edge, in the grid without its surroundings."""
    i, j, is_upward = edge
    next_node = (i + 1, j) if is_upward else (i, j + 1)
    here = float(padded[i, j])
    part = here / (here - float(padded[next_node]))
    x = j - 1.0
    y = i - 1.0
    if is_upward:
        return x, y + part
    return x + part, y


def _thinned(points: list[Point], tolerance: float) -> list[Point]:
    """Ramer, Douglas, Peucker: the points without which a line would be too far off."""
    end = len(points) - 1
    keeps = {0, end}
    spans = [(0, end)]
    while spans:
        first, last = spans.pop()
        start = points[first]
        stop = points[last]
        distances = [_distance(x, start, stop) for x in points[first + 1 : last]]
        largest = max(distances, default=0.0)
        if largest <= tolerance:
            continue
        far = first + 1 + distances.index(largest)
        keeps.add(far)
        spans.append((first, far))
        spans.append((far, last))
    return [points[k] for k in sorted(keeps)]


def _distance(point: Point, start: Point, end: Point) -> float:
    """From the line through both ends; from the end where they are one."""
    left, bottom = start
    x = point[0] - left
    y = point[1] - bottom
    u = end[0] - left
    v = end[1] - bottom
    length = hypot(u, v)
    if length == 0:
        return hypot(x, y)
    area = x * v - y * u
    return abs(area) / length


_NODES = 300
"""Nodes a side of a grid; even, so that none is on the imaginary axis of a symmetric one, where |R|
may be 1.
"""
_FLAT = 3.0
"""What levels are cut off at, such as logarithms near zeros and poles."""
_THINNED = 0.06  # cells


def compared(
    small: Callable[[Any], Any], large: Callable[[Any], Any], x: Axis, y: Axis
) -> list[list[Point]]:
    """The outlines of where ``small(z)`` ≤ ``large(z)`` for functions of arrays of z."""
    across = np.linspace(x.low, x.high, _NODES)
    up = np.linspace(y.low, y.high, _NODES)
    z = across + 1j * up[:, np.newaxis]
    with np.errstate(all="ignore"):
        return outlined(across, up, np.log(small(z) / large(z)))


def outlined(x: Floats, y: Floats, level: Floats) -> list[list[Point]]:
    """The outlines of where ``level`` ≤ 0 on the grid of x and y, with the area on their left.

    A point without a number is outside.
    """
    across, up = float(x[1] - x[0]), float(y[1] - y[0])
    left, bottom = float(x[0]), float(y[0])
    loops = outlines(np.clip(np.nan_to_num(level, nan=_FLAT), -_FLAT, _FLAT), _THINNED)
    return [[(left + column * across, bottom + row * up) for column, row in loop] for loop in loops]
