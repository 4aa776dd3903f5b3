"""Whether exact numbers are within a tolerance of zero; never decided by floats.

Elements of a stage space are measured by their values at the nodes, functionals and bilinear forms
by their coefficients there: the entries of a printed tableau.
"""

from __future__ import annotations

from math import factorial

from flint import arb, ctx, fmpq

from garkcli.exact.field import Algebraic, Number

TINY = fmpq(1, 10**6)
"""Largest residual that counts as rounding, at any order."""
UNNATURAL = fmpq(1, 1000)
"""Largest residual that counts as rounding, relative to quadrature errors."""
NOT_FOUND = "no method with it was found, and it is not proved that there is none"


def unnatural(order: int) -> fmpq:
    """The size below which a residual is too small for an exact method."""
    return min(TINY, small(order))


def small(order: int) -> fmpq:
    """Largest residual that a few digits may explain. A thousandth of the error of x^(n−1) in the
    best quadrature of s = ⌊n/2⌋ nodes, (s!)⁴ / ((2s+1) ((2s)!)²).
    """
    s = order // 2
    return UNNATURAL * fmpq(factorial(s) ** 4, (2 * s + 1) * factorial(2 * s) ** 2)


def rounded_up(size: arb) -> fmpq:
    """A bound with two digits: at least ``size``, less than a tenth more.

    >>> rounded_up(arb("3.14159e-9"))
    1/312500000
    """
    upper = size.abs_upper()
    if upper == 0:
        return fmpq(0)
    decades = upper.log() / arb(10).log()
    step = fmpq(10) ** (_integer(decades.mid().floor()) - 1)
    return _integer((upper / arb(step)).abs_upper().ceil()) * step


def _integer(number: arb) -> int:
    whole = number.unique_fmpz()
    assert whole is not None
    return int(whole)


def within(number: Number, tolerance: fmpq) -> bool:
    """Whether |number| ≤ tolerance.

    >>> within(fmpq(-1, 10), fmpq(1, 10)), within(fmpq(2, 19), fmpq(1, 10))
    (True, False)
    """
    if not tolerance:
        return not number
    if not isinstance(number, Algebraic):
        return bool(abs(number) <= tolerance)
    from garkcli.exact.display import to_ball

    digits = 17
    while True:  # an irrational number is never equal to a rational one
        ball = to_ball(number, digits)
        with ctx.workprec(4 * digits):
            size = abs(ball)
            if size < tolerance or size > tolerance:
                return bool(size < tolerance)
        digits *= 2
