"""Correct rounding of exact numbers: to decimals of any number of digits, and to floats.

Rational numbers are rounded in integers. An enclosure of an irrational number is refined until both
of its ends round to the same decimal, as it never lies half way between two decimals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from decimal import MAX_EMAX, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal
from typing import TypeVar

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Cell

T = TypeVar("T", Decimal, float)
MOST_DIGITS = 20_000
"""Most digits to decide the rounding of an irrational number, enough for 10 000 nines."""
_GUARD = 20
_BITS = 1000
_DIGITS = 300


class TooWide(ArithmeticError):
    pass


def ends(ball: arb) -> tuple[fmpq, fmpq]:
    middle, radius = midpoint(ball), midpoint(ball.rad())
    return middle - radius, middle + radius


def significant(x: fmpq, digits: int) -> Decimal:
    """The nearest decimal of so many digits, ties to even.

    >>> significant(fmpq(2, 3), 3), significant(fmpq(-9999, 10), 3)
    (Decimal('0.667'), Decimal('-1.00E+3'))
    """
    return quotient(x, Context(digits, ROUND_HALF_EVEN))


def quotient(x: fmpq, context: Context) -> Decimal:
    """A fraction as a decimal, rounded once, for powers of ten of any size."""
    context.Emax, context.Emin = MAX_EMAX, MIN_EMIN
    return context.divide(Decimal(int(x.p)), Decimal(int(x.q)))


def rounded(x: Cell, digits: int) -> Decimal:
    """The nearest decimal, ties to even; TooWide if the enclosure leaves it open."""
    return _agreed(x, digits, lambda end: significant(end, digits))


def nearest_float(x: Cell) -> float:
    """Ties to even; TooWide if the enclosure leaves it open, OverflowError if it is too large."""
    # the quotient of two integers of Python is rounded once
    return _agreed(x, 17, lambda end: int(end.p) / int(end.q))


def _agreed(x: Cell, digits: int, nearest: Callable[[fmpq], T]) -> T:
    """The common value of ``nearest`` at both ends of a sufficiently fine enclosure."""
    if isinstance(x, fmpq):
        return nearest(x)
    for ball in _finer(x, digits):
        low, high = map(nearest, ends(ball))
        if low == high:
            return low
    raise TooWide


def _finer(x: Cell, digits: int) -> Iterator[arb]:
    """Ever finer enclosures of a number; for an arb only itself."""
    if isinstance(x, arb):
        yield x
        return
    more = digits + _GUARD
    while more < MOST_DIGITS:
        yield to_ball(x, more)
        more *= 2


def combined(*terms: tuple[fmpq | int, Cell]) -> Cell:
    """The sum of multiples k x of entries, exact if all are in one field, else a fine enclosure."""
    if not any(isinstance(x, arb) for _, x in terms):
        try:
            return sum((k * x for k, x in terms), ZERO)
        except TypeError:
            pass  # of two number fields
    with ctx.workprec(_BITS):
        return sum((arb(k) * ball(x) for k, x in terms), arb(0))


def ball(x: Cell) -> arb:
    return x if isinstance(x, arb) else to_ball(x, _DIGITS)
