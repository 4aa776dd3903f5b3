"""Exact numbers rounded correctly: to decimals of any number of digits, and to floats.

A rational number is rounded by integers alone. Of an irrational number an enclosure is made finer
until both of its ends round to the same text; it never lies half way between two decimals.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number

Cell: TypeAlias = Number | arb
"""An exact number, or an enclosure of one that is irrational."""
MOST_DIGITS = 20_000
"""Irrational numbers whose rounding is not told by so many digits are given up: 10 000 nines."""
_GUARD = 20


class TooWide(ArithmeticError):
    """An enclosure does not tell how its number is rounded."""


def ends(ball: arb) -> tuple[fmpq, fmpq]:
    """The ends of a ball, which are rational."""
    middle = _exact(ball.mid())
    radius = _exact(ball.rad())
    return middle - radius, middle + radius


def _exact(point: arb) -> fmpq:
    """A ball of radius 0 as a fraction."""
    mantissa, exponent = point.man_exp()
    power = int(exponent)
    if power >= 0:
        return fmpq(mantissa * 2**power)
    return fmpq(mantissa, 2**-power)


def significant(x: fmpq, digits: int) -> tuple[int, int]:
    """The integer m and the exponent e with x ≈ m · 10^e, m of ``digits`` digits.

    Half goes to even.

    >>> significant(fmpq(2, 3), 3), significant(fmpq(-9999, 10), 3)
    ((667, -3), (-100, 1))
    """
    if not x:
        return 0, 0
    p, q = abs(int(x.p)), int(x.q)
    # the logarithm is off by one at most, which the loop mends
    exponent = len(str(p)) - len(str(q)) - digits
    while True:
        m = _half_even(p, q, exponent)
        if m < 10 ** (digits - 1):
            exponent -= 1
        elif m >= 10**digits:
            exponent += 1
        else:
            return (m if x > 0 else -m), exponent


def _half_even(p: int, q: int, exponent: int) -> int:
    """The fraction p/q over 10^exponent, rounded to an integer."""
    if exponent >= 0:
        q *= 10**exponent
    else:
        p *= 10**-exponent
    whole, rest = divmod(p, q)
    is_odd = whole % 2
    if 2 * rest > q or (2 * rest == q and is_odd):
        return whole + 1
    return whole


def rounded(x: Cell, digits: int) -> tuple[int, int]:
    """The same for any number.

    Raises:
        TooWide: an enclosure that is given does not tell.
    """
    if isinstance(x, fmpq):
        return significant(x, digits)
    for ball in _finer(x, digits):
        low, high = ends(ball)
        found = significant(low, digits)
        if found == significant(high, digits):
            return found
    raise TooWide


def nearest_float(x: Cell) -> float:
    """The nearest binary64 number, ties to even.

    Raises:
        TooWide: an enclosure that is given does not tell.
        OverflowError: there is none.
    """
    if isinstance(x, fmpq):
        return _nearest(x)
    for ball in _finer(x, 17):
        low, high = ends(ball)
        found = _nearest(low)
        if found == _nearest(high):
            return found
    raise TooWide


def _nearest(x: fmpq) -> float:
    # the quotient of two integers of Python is rounded once
    return int(x.p) / int(x.q)


def _finer(x: Cell, digits: int) -> Iterator[arb]:
    """Enclosures of a number, each finer than the one before; that of an arb is all there is."""
    if isinstance(x, arb):
        yield x
        return
    more = digits + _GUARD
    while more < MOST_DIGITS:
        yield to_ball(x, more)
        more *= 2
