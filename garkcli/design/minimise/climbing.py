"""A good point by trial, if no exact way is known: compass search with exact values.

From the best points of a grid the search moves to the best neighbour as long as it is better, then
halves the step. Points are rational and comparisons exact, so every machine finds the same point.
Other points may be better.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.deadline import check_time, checked

Point: TypeAlias = tuple[fmpq, ...]
Rank: TypeAlias = Callable[[Point], Any]
"""A value that is larger for better points; None if there is no method."""

GRID = {
    1: ("-1", "0", "1/8", "1/4", "1/3", "1/2", "2/3", "3/4", "1", "2"),
    2: ("0", "1/4", "1/3", "1/2", "2/3", "3/4", "1"),
    3: ("1/4", "1/2", "3/4", "1"),
    4: ("1/4", "1/2", "1"),
}
BEST = 3
DENOMINATORS = range(1, 31)
NEAR = fmpq(1, 100)
"""The distance up to which a short number may replace a coordinate."""
HALVINGS = 12
"""Steps are 1/8, 1/16, …"""
MOVES = 64
"""Moves with one step, after which a value may grow without bound: the search stops there."""


def climbed(rank: Rank, coordinates: int) -> Point | None:
    """A point without better neighbours, or the last of ``MOVES`` moves; None without a method."""

    @cache
    def known(point: Point) -> Any:
        check_time()
        return rank(point)

    values = [fmpq(*Fraction(x).as_integer_ratio()) for x in GRID[coordinates]]
    starts = [x for x in checked(product(values, repeat=coordinates)) if known(x)]
    starts.sort(key=known, reverse=True)
    best = max((_climbed(known, x) for x in starts[:BEST]), key=known, default=None)
    return None if best is None else _shortened(known, best)


def _shortened(known: Rank, point: Point) -> Point:
    """The point with short numbers near by for its coordinates, if it is no worse."""
    for q in DENOMINATORS:
        others = tuple(_near(x, q) for x in point)
        if others != point and _is_as_good(known, others, point):
            return others
    for i, x in enumerate(point):
        for q in DENOMINATORS:
            other = (*point[:i], _near(x, q), *point[i + 1 :])
            if _is_as_good(known, other, point):
                point = other
                break
    return point


def _is_as_good(known: Rank, other: Point, point: Point) -> bool:
    rank = known(other)
    return rank is not None and bool(rank >= known(point))


def _near(x: fmpq, q: int) -> fmpq:
    near = fmpq((x * q + fmpq(1, 2)).floor(), q)
    return near if abs(near - x) < NEAR else x


def _climbed(known: Rank, point: Point) -> Point:
    step = fmpq(1, 8)
    for _ in range(HALVINGS):
        for _ in range(MOVES):
            best = max([x for x in _neighbours(point, step) if known(x)], key=known, default=point)
            if not known(best) > known(point):
                break
            point = best
        else:
            return point
        step /= 2
    return point


def _neighbours(point: Point, step: fmpq) -> Iterator[Point]:
    size = len(point)
    for signs in checked(product((-1, 0, 1), repeat=size)):
        if size - signs.count(0) in {1, 2}:
            yield tuple(x + k * step for x, k in zip(point, signs, strict=True))
