"""The part of a grid where a function is at most 0, as closed polygons: marching squares.

The grid is surrounded by nodes outside of the part, so that every outline is closed. Each cell
that the outline passes has directed pieces of it, with the part on their left; a piece ends where
the piece of a neighbour begins.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from garkcli.arrays import Floats

Point: TypeAlias = tuple[float, float]
"""Column and row in a grid, between its nodes."""
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
        thinned = _thinned([*loop, loop[0]], tolerance)
        found.append(thinned[:-1])
    return [loop for loop in found if len(loop) > 2]


def _all_pieces(padded: Floats) -> Iterator[tuple[_Edge, _Edge]]:
    inside = (padded <= 0).astype(int)
    below, above = inside[:-1], inside[1:]
    kinds = below[:, :-1] + 2 * below[:, 1:]
    kinds += 4 * above[:, 1:] + 8 * above[:, :-1]
    passed = np.argwhere((kinds > 0) & (kinds < 15))
    for i, j in passed.tolist():
        kind = int(kinds[i, j])
        corners = padded[i : i + 2, j : j + 2]
        for piece in _pieces_of(kind, corners):
            yield _edge(i, j, piece[0]), _edge(i, j, piece[1])


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
    here = float(padded[i, j])
    there = float(padded[i + 1, j] if is_upward else padded[i, j + 1])
    part = here / (here - there)
    x, y = j - 1.0, i - 1.0
    return (x, y + part) if is_upward else (x + part, y)


def _thinned(points: list[Point], tolerance: float) -> list[Point]:
    """Ramer, Douglas, Peucker: the points without which a line would be too far off."""
    keeps = {0, len(points) - 1}
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        between = range(first + 1, last)
        if not between:
            continue
        line = points[first], points[last]
        far = max(between, key=lambda k: _distance(points[k], *line))
        if _distance(points[far], *line) > tolerance:
            keeps.add(far)
            spans += [(first, far), (far, last)]
    return [points[k] for k in sorted(keeps)]


def _distance(point: Point, start: Point, end: Point) -> float:
    """From the line through both ends; from the end where they are one."""
    x, y = point[0] - start[0], point[1] - start[1]
    u, v = end[0] - start[0], end[1] - start[1]
    length = hypot(u, v)
    if length == 0:
        return hypot(x, y)
    return abs(x * v - y * u) / length
