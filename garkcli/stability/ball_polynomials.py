"""Polynomials with balls as coefficients, lowest first: signs, roots, common factors, first
negative point, decided for all polynomials in the balls at once, or None.

The first negative point is bracketed. Pieces of the line are taken from the left: one with a
positive enclosure of the polynomial is passed; others are halved until they are short. Beyond the
last passed piece a point is sought where the polynomial is negative for all numbers in the balls.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise, zip_longest

from flint import arb, arb_mat, arb_poly, fmpq

from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import Frozen

MOST_PIECES_OF_UNIT = 4000
"""Most pieces on which a sign is tried."""


def both(first: bool | None, second: bool | None) -> bool | None:
    if first is False or second is False:
        return False
    if first and second:
        return True
    return None


def mirrored(coefficients: Iterable[arb]) -> list[arb]:
    return [-a if k % 2 else a for k, a in enumerate(coefficients)]


def difference(a: Sequence[arb], b: Sequence[arb]) -> list[arb]:
    return [x - y for x, y in zip_longest(a, b, fillvalue=arb(0))]


def _padded(p: Sequence[arb], size: int) -> list[arb]:
    return [*p, *[arb(0)] * (size - len(p))]


def is_positive(coefficients: Sequence[arb]) -> bool | None:
    """Whether a polynomial is positive for all x > 0: on (0, 1], and reversed on (0, 1]."""
    near = _is_positive_on_unit_interval(coefficients)
    far = _is_positive_on_unit_interval(coefficients[::-1])
    return both(near, far)


def _is_positive_on_unit_interval(coefficients: Sequence[arb]) -> bool | None:
    """Whether a polynomial is positive on [0, 1], by halving until each enclosure has a sign."""
    p = arb_poly(coefficients)
    pieces = [(fmpq(0), fmpq(1))]
    tried = 0
    while pieces:
        low, high = pieces.pop()
        tried += 1
        if tried > MOST_PIECES_OF_UNIT:
            return None
        middle = (low + high) / 2
        if p(arb(middle, (high - low) / 2)) > 0:
            continue
        if p(arb(middle)) < 0:
            return False
        pieces += [(low, middle), (middle, high)]
    return True


def poles_are_right(Q: Sequence[arb]) -> bool | None:
    """Whether all roots of Q have positive real parts, by Routh's scheme for Q(−z)."""
    rest = mirrored(Q)[::-1]
    while rest and rest[0].is_zero():
        rest.pop(0)
    upper, lower = rest[0::2], rest[1::2]
    column = [upper[0]]
    while lower:
        if lower[0].contains(0):
            return None
        column.append(lower[0])
        factor = upper[0] / lower[0]
        below = _padded(lower[1:], len(upper) - 1)
        upper, lower = lower, [x - factor * y for x, y in zip(upper[1:], below, strict=True)]
    if all(x > 0 for x in column) or all(x < 0 for x in column):
        return True
    if any(x.contains(0) for x in column):
        return None
    return False


def are_coprime(P: list[arb], Q: list[arb]) -> bool:
    """Whether P and Q never have a common root, as the Sylvester matrix has determinant ≠ 0."""
    degree_p = len(P) - 1
    degree_q = len(Q) - 1
    size = degree_p + degree_q
    if size == 0:
        return True
    # rows with the coefficients, each a column further to the right
    rows = [_padded([arb(0)] * k + P, size) for k in range(degree_q)]
    rows += [_padded([arb(0)] * k + Q, size) for k in range(degree_p)]
    return not arb_mat(rows).det().contains(0)


FINEST = 80
"""Most halvings of a piece."""
FARTHEST = 20
"""Pieces reach to this power of 2; beyond it nothing is decided."""
MOST_PIECES = 6000
MOST_TRIES = 60
"""Most points that are tried beyond the last piece, each twice as far from it."""


class Bounds(Frozen):
    """A number between bounds, None for ∞; an upper bound may also be unknown."""

    low: fmpq | None
    high: fmpq | None


UNLIMITED = Bounds(None, None)
OPEN = Bounds(ZERO, None)


def first_failure(coefficients: Sequence[arb], upto: fmpq | None = None) -> Bounds:
    """Brackets the x ≥ 0 from which on a polynomial is negative; exact zeros stay zero. One that is
    positive up to ``upto`` counts as unlimited.

    >>> found = first_failure([arb(4), arb(0), arb(-1)])
    >>> bool(found.low <= 2 <= found.high and found.high - found.low < fmpq(1, 10**9))
    True
    """
    kept = list(coefficients)
    while kept and kept[-1].is_zero():
        kept.pop()
    first = next((k for k, a in enumerate(kept) if not a.is_zero()), None)
    if first is None:
        return UNLIMITED
    kept = kept[first:]
    if kept[0] < 0:
        return Bounds(ZERO, ZERO)
    if kept[0].contains(0):
        return OPEN
    p = arb_poly(kept)
    if upto is None:
        is_positive = len(kept) == 1 or _is_positive_everywhere(kept)
        return UNLIMITED if is_positive else _bounded_behind(p, _passed(p))
    passed = _passed(p, upto)
    return UNLIMITED if passed >= upto else _bounded_behind(p, passed)


def _is_positive_everywhere(coefficients: Sequence[arb]) -> bool:
    both_ways = (arb_poly(list(coefficients)), arb_poly(list(coefficients[::-1])))
    return all(_passed(p, ONE) == 1 for p in both_ways)


def _passed(p: arb_poly, upto: fmpq | None = None) -> fmpq:
    ends = [fmpq(0), *(fmpq(2) ** k for k in range(FARTHEST))]
    pieces = [(low, high, 0) for low, high in pairwise(ends)][::-1]
    tried = 0
    while pieces:
        low, high, depth = pieces.pop()
        if upto is not None and low >= upto:
            return low
        tried += 1
        middle = (low + high) / 2
        if p(arb(middle, (high - low) / 2)) > 0:
            continue
        if depth == FINEST or tried > MOST_PIECES:
            return low
        pieces.append((middle, high, depth + 1))
        pieces.append((low, middle, depth + 1))
    return ends[-1]


def _bounded_behind(p: arb_poly, low: fmpq) -> Bounds:
    distance = fmpq(1, 2**FINEST)
    for _ in range(MOST_TRIES):
        high = low + distance
        if p(arb(high)) < 0:
            return Bounds(low, high)
        distance *= 2
    return Bounds(low, None)


def least(bounds: Sequence[Bounds]) -> Bounds:
    lows = [one.low for one in bounds if one.low is not None]
    highs = [one.high for one in bounds if one.high is not None]
    if not lows:
        return UNLIMITED
    return Bounds(min(lows), min(highs, default=None))
