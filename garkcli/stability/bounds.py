"""Where polynomials with balls as coefficients begin to be negative, between bounds.

Pieces of the line are taken from the left. A piece on which the enclosure of the polynomial is
positive is passed; others are halved, until they are short. Behind the last one that was passed a
point is looked for where the polynomial is negative for all numbers in the balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_poly, fmpq

from garkcli.exact.field import ZERO

FINEST = 80
"""A piece is halved at most so often."""
FARTHEST = 20
"""Pieces reach to 2 to this power; beyond it nothing is decided."""
MOST_PIECES = 6000
"""Pieces that are tried at most."""
MOST_TRIES = 60
"""Points that are tried at most behind the last piece, each twice as far from it."""


@dataclass(frozen=True)
class Bounds:
    """A number known between bounds.

    Attributes:
        low: no more than it, for all methods within the tolerance; None for ∞.
        high: no less; None for ∞, or where no such bound is known.
    """

    low: fmpq | None
    high: fmpq | None


UNLIMITED = Bounds(None, None)
"""Never negative."""
OPEN = Bounds(ZERO, None)
"""Nothing is known."""


def first_failure(coefficients: Sequence[arb]) -> Bounds:
    """The x ≥ 0 from which on a polynomial is negative, between bounds.

    Args:
        coefficients: the lowest first; exact zeros are structure.

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
    if len(kept) == 1 or _is_positive_everywhere(kept):
        return UNLIMITED
    p = arb_poly(kept)
    return _bounded_behind(p, _passed(p))


def _is_positive_everywhere(coefficients: Sequence[arb]) -> bool:
    """Whether it is positive on [0, 1], and reversed on [0, 1]; False if that is not seen."""
    near = arb_poly(list(coefficients))
    if _passed(near, up_to_one=True) < 1:
        return False
    far = arb_poly(list(coefficients[::-1]))
    return _passed(far, up_to_one=True) == 1


def _passed(p: arb_poly, up_to_one: bool = False) -> fmpq:
    """How far from 0 the polynomial is seen to be positive."""
    ends = [fmpq(0), fmpq(1)]
    if not up_to_one:
        ends += [fmpq(2) ** k for k in range(1, FARTHEST)]
    whole = list(zip(ends, ends[1:], [0] * len(ends), strict=False))
    pieces = whole[::-1]
    tried = 0
    while pieces:
        low, high, depth = pieces.pop()
        tried += 1
        middle = (low + high) / 2
        radius = (high - low) / 2
        if p(arb(middle, radius)) > 0:
            continue
        if depth == FINEST or tried > MOST_PIECES:
            return low
        pieces.append((middle, high, depth + 1))
        pieces.append((low, middle, depth + 1))
    return ends[-1]


def _bounded_behind(p: arb_poly, low: fmpq) -> Bounds:
    """The nearest point found behind ``low`` at which the polynomial is negative."""
    distance = fmpq(1, 2**FINEST)
    for _ in range(MOST_TRIES):
        high = low + distance
        if p(arb(high)) < 0:
            return Bounds(low, high)
        distance *= 2
    return Bounds(low, None)


def least(bounds: Sequence[Bounds]) -> Bounds:
    """The least of several numbers, between bounds."""
    lows = [one.low for one in bounds if one.low is not None]
    highs = [one.high for one in bounds if one.high is not None]
    if not lows:
        return UNLIMITED
    return Bounds(min(lows), min(highs, default=None))
