"""Exact numbers rounded correctly: to decimals of any number of digits, and to floats.

A rational number is rounded by integers alone. Of an irrational number an enclosure is made finer
until both of its ends round to the same text; it never lies half way between two decimals.
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
"""Irrational numbers whose rounding is not told by so many digits are given up: 10 000 nines."""
_GUARD = 20
_BITS = 1000
"""Of arithmetic with enclosures, far beyond what is written of them."""
_DIGITS = 300


class TooWide(ArithmeticError):
    """An enclosure does not tell how its number is rounded."""


def ends(ball: arb) -> tuple[fmpq, fmpq]:
    """The ends of a ball, which are rational."""
    middle, radius = midpoint(ball), midpoint(ball.rad())
    return middle - radius, middle + radius


def significant(x: fmpq, digits: int) -> Decimal:
    """The nearest decimal of so many digits; half goes to even.

    >>> significant(fmpq(2, 3), 3), significant(fmpq(-9999, 10), 3)
    (Decimal('0.667'), Decimal('-1.00E+3'))
    """
    return quotient(x, Context(digits, ROUND_HALF_EVEN))


def quotient(x: fmpq, context: Context) -> Decimal:
    """A fraction as a decimal, rounded once, whatever the size of its powers of ten."""
    context.Emax, context.Emin = MAX_EMAX, MIN_EMIN
    return context.divide(Decimal(int(x.p)), Decimal(int(x.q)))


def rounded(x: Cell, digits: int) -> Decimal:
    """The same for any number.

    Raises:
        TooWide: an enclosure that is given does not tell.
    """
    return _told(x, digits, lambda end: significant(end, digits))


def nearest_float(x: Cell) -> float:
    """The nearest binary64 number, ties to even.

    Raises:
        TooWide: an enclosure that is given does not tell.
        OverflowError: there is none.
    """
    # the quotient of two integers of Python is rounded once
    return _told(x, 17, lambda end: int(end.p) / int(end.q))


def _told(x: Cell, digits: int, nearest: Callable[[fmpq], T]) -> T:
    """What is nearest to a number, and to both ends of an enclosure that is fine enough."""
    if isinstance(x, fmpq):
        return nearest(x)
    for ball in _finer(x, digits):
        low, high = map(nearest, ends(ball))
        if low == high:
            return low
    raise TooWide


def _finer(x: Cell, digits: int) -> Iterator[arb]:
    """Enclosures of a number, each finer than the one before; that of an arb is all there is."""
    if isinstance(x, arb):
        yield x
        return
    more = digits + _GUARD
    while more < MOST_DIGITS:
        yield to_ball(x, more)
        more *= 2


def combined(*terms: tuple[fmpq | int, Cell]) -> Cell:
    """The sum of multiples k x of entries, given as pairs: exact where all entries are of one
    field, else an enclosure far finer than what is written.
    """
    if not any(isinstance(x, arb) for _, x in terms):
        try:
            return sum((k * x for k, x in terms), ZERO)
        except TypeError:
            pass  # of two number fields
    with ctx.workprec(_BITS):
        return sum((arb(k) * ball(x) for k, x in terms), arb(0))


def ball(x: Cell) -> arb:
    """An enclosure, far finer than what is written."""
    return x if isinstance(x, arb) else to_ball(x, _DIGITS)
