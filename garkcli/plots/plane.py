"""Outlines of regions, traced on a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from garkcli.plots.scene import Axis, Point

if TYPE_CHECKING:
    from garkcli.arrays import Floats

_Edge: TypeAlias = tuple[int, int, bool]
"""The row and column of the start of an edge of the grid, and whether the edge is vertical."""
_FAR = 1.0
"""The value at the nodes around the grid."""
_NODES = 300
"""The number of nodes on a side of a grid; even, so that none is on the imaginary axis of a
symmetric one, where |R| may be 1.
"""
_FLAT = 3.0
"""The bound at which levels are cut, such as logarithms near zeros and poles."""
_THINNED = 0.06  # cells


def compared(
    small: Callable[[Any], Any], large: Callable[[Any], Any], x: Axis, y: Axis
) -> list[list[Point]]:
    """Returns the outlines of the region ``small(z)`` ≤ ``large(z)``, for functions of arrays."""
    across = np.linspace(x.low, x.high, _NODES)
    up = np.linspace(y.low, y.high, _NODES)
    z = across + 1j * up[:, np.newaxis]
    with np.errstate(all="ignore"):
        return outlined(across, up, np.log(small(z) / large(z)))


def outlined(x: Floats, y: Floats, level: Floats) -> list[list[Point]]:
    """Returns the outlines of the region ``level`` ≤ 0 on the grid of x and y, with the region on
    their left.

    Points whose level is NaN are outside.
    """
    across, up = float(x[1] - x[0]), float(y[1] - y[0])
    left, bottom = float(x[0]), float(y[0])
    loops = outlines(np.clip(np.nan_to_num(level, nan=_FLAT), -_FLAT, _FLAT), _THINNED)
    return [[(left + column * across, bottom + row * up) for column, row in loop] for loop in loops]


def outlines(level: Floats, tolerance: float) -> list[list[Point]]:
    """Returns the closed outlines of the region ``level`` ≤ 0, simplified.

    ``level`` has finite values at the nodes, rows first; points within ``tolerance`` of the line,
    in cells, are dropped.
    """
    padded = np.pad(level, 1, constant_values=_FAR)
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


def _pieces(padded: Floats) -> Iterator[tuple[_Edge, _Edge]]:
    """Yields the pieces of outlines in all cells, as start and end edges.

    Going around a cell, a piece starts where the region ends, and ends where the region starts: at
    the next such place if the middle is inside, otherwise at the previous one.
    """
    corners = padded[:-1, :-1], padded[:-1, 1:], padded[1:, 1:], padded[1:, :-1]
    inside = np.stack(corners, axis=-1) <= 0
    for i, j in np.argwhere(inside.any(axis=-1) & ~inside.all(axis=-1)).tolist():
        # the bottom, the right side, the top, the left side
        edges = (i, j, False), (i, j + 1, True), (i + 1, j, False), (i, j, True)
        here = inside[i, j].tolist()
        there = [*here[1:], here[0]]
        ends = [k for k in range(4) if here[k] and not there[k]]
        starts = [k for k in range(4) if there[k] and not here[k]]
        nearest = min if padded[i : i + 2, j : j + 2].mean() <= 0 else max
        for k in ends:
            yield edges[k], edges[(k + nearest((other - k) % 4 for other in starts)) % 4]


def _crossing(padded: Floats, edge: _Edge) -> complex:
    """Returns the point where the outline crosses an edge, in the grid without its border."""
    i, j, is_upward = edge
    here = float(padded[i, j])
    part = here / (here - float(padded[(i + 1, j) if is_upward else (i, j + 1)]))
    return complex(j - 1, i - 1) + part * (1j if is_upward else 1)


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
