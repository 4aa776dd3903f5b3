"""A good point by trial, where nothing exact is known: compass search with exact values.

From the best points of a grid one goes to the best neighbour as long as that is better, then with
half the step. Points are rational and values are compared exactly, so that the same point is found
on every machine, and its value is right. That no other point is better is not proved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.deadline import check_time, checked

Point: TypeAlias = tuple[fmpq, ...]
Rank: TypeAlias = Callable[[Point], Any]
"""A value that is the larger, the better a point is; None where there is no method."""

GRID = {
    1: ("-1", "0", "1/8", "1/4", "1/3", "1/2", "2/3", "3/4", "1", "2"),
    2: ("0", "1/4", "1/3", "1/2", "2/3", "3/4", "1"),
    3: ("1/4", "1/2", "3/4", "1"),
    4: ("1/4", "1/2", "1"),
}
"""Coordinates of the first points, by their number."""
BEST = 3
"""From so many of them it goes on."""
DENOMINATORS = range(1, 31)
"""What short numbers have."""
NEAR = fmpq(1, 100)
"""How far they may be."""
HALVINGS = 12
"""Steps are 1/8, 1/16, …, so many."""
MOVES = 64
"""With one step: a value that is still better then may get better for ever, and it ends there."""


def climbed(rank: Rank, coordinates: int) -> Point | None:
    """A point that none of its neighbours is better than, or that ``MOVES`` moves led to; None
    where the grid has no method.

    Args:
        rank: of a point.
        coordinates: up to 4.

    Raises:
        NotDecided: it takes too long.
    """

    @cache
    def known(point: Point) -> Any:
        check_time()
        return rank(point)

    values = [_rational(x) for x in GRID[coordinates]]
    starts = [x for x in checked(product(values, repeat=coordinates)) if known(x)]
    starts.sort(key=known, reverse=True)
    best = max((_climbed(known, x) for x in starts[:BEST]), key=known, default=None)
    return None if best is None else _shortened(known, best)


def _shortened(known: Rank, point: Point) -> Point:
    """With short numbers near by in place of others, where that makes it no worse."""
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
    """Whether there is a method at another point that is not worse."""
    rank = known(other)
    return rank is not None and bool(rank >= known(point))


def _near(x: fmpq, q: int) -> fmpq:
    """The nearest number with a denominator, if it is near."""
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
    """The points around a point, with one or two coordinates changed."""
    size = len(point)
    for signs in checked(product((-1, 0, 1), repeat=size)):
        if size - signs.count(0) in {1, 2}:
            yield tuple(x + k * step for x, k in zip(point, signs, strict=True))


def _rational(text: str) -> fmpq:
    p, _, q = text.partition("/")
    return fmpq(int(p), int(q or 1))
