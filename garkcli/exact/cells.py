"""Subsets of the real line, described by signs of polynomials.

The roots of all polynomials that matter cut the line into points and open intervals. On each of
these cells every sign is constant, so one point of each cell decides for all of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import TypeAlias, TypeVar

from flint import ctx, fmpq

from garkcli.deadline import check_time
from garkcli.exact.enclosing import midpoint
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import FIRST_BITS, RealRoot, real_roots, sign, sign_at
from garkcli.frozen import Frozen

T = TypeVar("T")
Point: TypeAlias = fmpq | RealRoot


class Interval(Frozen):
    """An interval of real numbers, bounded or not.

    Attributes:
        start: its left end; None for −∞.
        end: its right end; None for ∞.
        has_start: whether the left end belongs to it.
        has_end: whether the right end belongs to it.
    """

    start: RealRoot | None
    end: RealRoot | None
    has_start: bool = False
    has_end: bool = False

    @property
    def is_point(self) -> bool:
        """Whether the interval is a single number."""
        return self.start is not None and self.start == self.end


def contains(interval: Interval, left: RealRoot, right: RealRoot) -> bool:
    start, end = interval.start, interval.end
    if start is not None and left < start:
        return False
    if end is not None and end < right:
        return False
    if start == left and not interval.has_start:
        return False
    return interval.has_end or end != right


def has(intervals: Iterable[Interval], point: Point) -> bool:
    x = point if isinstance(point, RealRoot) else RealRoot.rational(point)
    return any(contains(interval, x, x) for interval in intervals)


def ends_of(intervals: Iterable[Interval]) -> list[Polynomial]:
    ends = (end for x in intervals for end in (x.start, x.end) if end is not None)
    return [Polynomial.from_flint(end.polynomial) for end in dict.fromkeys(ends)]


def sign_of(p: Polynomial, point: Point) -> int:
    if isinstance(point, RealRoot):
        return sign_at(p, point)
    return sign(p(point))


def where(
    holds: Callable[[Point], bool], polynomials: Iterable[Polynomial], start: fmpq | None = None
) -> tuple[Interval, ...]:
    """Returns the x ≥ ``start`` with ``holds(x)``, which the signs of ``polynomials`` decide. The
    intervals ascend; ``start`` is None for −∞.
    """
    roots = roots_of(polynomials)
    left = None if start is None else RealRoot.rational(start)
    if left is not None:
        roots = [left, *(root for root in roots if root > left)]
    found = pieces(holds, lambda t, *_: holds(t), roots, left is not None)
    return tuple(cell for cell, is_in in found if is_in)


def pieces(
    inside: Callable[[fmpq], T],
    at: Callable[[RealRoot, T | None, T], T],
    roots: Sequence[RealRoot],
    is_bounded: bool = False,
) -> list[tuple[Interval, T]]:
    """Returns the intervals of equal values of a function that is constant between ``roots``.

    ``inside`` is its value at a rational number between two roots; ``at`` that at a root, given
    those to the left (None if there is nothing) and right. If ``is_bounded`` it begins at a root.
    """
    opened: list[Interval] = [
        Interval(left, right) for left, right in pairwise([None, *roots, None])
    ]
    values: list[T | None] = []
    for k, cell in enumerate(opened):
        check_time()
        is_outside = is_bounded and not k
        values.append(None if is_outside else inside(between(cell.start, cell.end)))
    joined: list[tuple[Interval, T]] = []

    def add(cell: Interval, value: T) -> None:
        if joined and joined[-1][1] == value:  # the cell is next to it
            grown = joined.pop()[0]
            cell = Interval(grown.start, cell.end, grown.has_start, cell.has_end)
        joined.append((cell, value))

    for k, (cell, value) in enumerate(zip(opened, values, strict=True)):
        if value is None:
            continue
        if k:
            t = roots[k - 1]
            check_time()
            add(Interval(t, t, has_start=True, has_end=True), at(t, values[k - 1], value))
        add(cell, value)
    return joined


def roots_of(polynomials: Iterable[Polynomial]) -> list[RealRoot]:
    roots: set[RealRoot] = set()
    for p in polynomials:
        if p:
            roots.update(root for root, _ in real_roots(p))
    return sorted(roots)


def between(left: RealRoot | None, right: RealRoot | None) -> fmpq:
    """Returns a rational number strictly between two roots, of small denominator.

    >>> between(RealRoot.rational(fmpq(1, 3)), RealRoot.rational(fmpq(1, 2)))
    2/5
    """
    if left is None and right is None:
        return fmpq(0)
    bits = FIRST_BITS
    while True:
        check_time()
        low = high = None
        with ctx.workprec(bits):  # of the ends of balls too
            if left is not None:
                low = midpoint(left.ball(bits).upper())
            if right is not None:
                high = midpoint(right.ball(bits).lower())
        if low is None:
            assert high is not None
            return high.floor() - fmpq(1)
        if high is None:
            return low.floor() + fmpq(1)
        if low < high:
            return _simplest(low, high)
        bits *= 2


def between_roots(polynomials: Iterable[Polynomial]) -> Iterator[fmpq]:
    for left, right in pairwise([None, *roots_of(polynomials), None]):
        check_time()
        yield between(left, right)


def _simplest(low: fmpq, high: fmpq) -> fmpq:
    """The number of smallest denominator strictly between two, by continued fractions."""
    integer = low.floor()
    if integer + 1 < high:
        return fmpq(integer + 1)
    rest = high - integer
    if low == integer:
        return integer + fmpq(1) / ((1 / rest).floor() + 1)
    return integer + 1 / _simplest(1 / rest, 1 / (low - integer))


def where_not_negative(polynomials: Sequence[Polynomial]) -> tuple[Interval, ...]:
    """The numbers at which all polynomials are at least 0.

    >>> (found,) = where_not_negative([Polynomial([0, 1]), Polynomial([4, 0, -1])])
    >>> found.start, found.end, found.has_end
    (<RealRoot 0>, <RealRoot 2>, True)
    """
    return where(lambda t: all(sign_of(p, t) >= 0 for p in polynomials), polynomials)


def is_half_line(intervals: Sequence[Interval]) -> bool:
    return len(intervals) == 1 and intervals[0].has_start and intervals[0].end is None


def first_end(intervals: Sequence[Interval]) -> RealRoot | None:
    """The end of the interval that begins at 0: 0 if there is none, None for ∞.

    >>> first_end(where_not_negative([Polynomial([0, 4, -1])]))
    <RealRoot 4>
    """
    if not intervals or intervals[0].start != RealRoot.rational(fmpq(0)):
        return RealRoot.rational(fmpq(0))
    return intervals[0].end
