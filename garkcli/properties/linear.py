"""What stands in the way of linear stability, in words: a pole, or a point of the axis."""

from __future__ import annotations

from collections.abc import Sequence

from flint import acb, acb_poly, arb, ctx

from garkcli.exact.cells import Interval, between
from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    ball_decimal,
    integral,
    polynomial_text,
    root_decimal,
    root_text,
)
from garkcli.exact.roots import RealRoot
from garkcli.properties.property import Verdict
from garkcli.properties.subject import MISSING_BLOCKS
from garkcli.stability.linear import StabilityFunction, e_polynomial, imaginary_set, poles_are_right

_BITS = 128
_DIGITS = 6
_LONG = 60
"""Longer polynomials are not shown."""


def no_meaning() -> Verdict:
    """The linear test equation has no meaning for a method."""
    return Verdict.meaningless(MISSING_BLOCKS)


def decide_within(found: bool | None) -> Verdict:
    """A verdict on all methods within a tolerance."""
    if found is None:
        return Verdict.undecided("methods within the tolerance differ, or seem to")
    return Verdict.unless("" if found else "no method within the tolerance is")


def obstacle_to_a_stability(R: StabilityFunction) -> str:
    """Where |R| > 1 in the left half plane; empty for an A-stable method."""
    P, Q = R.numerator, R.denominator
    if P.degree > Q.degree:
        return "R(z) is not bounded: its numerator has the larger degree"
    if not poles_are_right(Q):
        return f"R has a pole at z = {_left_pole(Q)}"
    gap = first_gap(imaginary_set(R))
    if gap is None:
        return ""
    x = between(gap.start, gap.end)
    (E,) = integral([e_polynomial(R)])
    text = polynomial_text(E, "x")
    shown = f": there {text} < 0" if len(text) <= _LONG else ""
    return f"|R(iy)| > 1 at x = y² = {x}{shown}"


def _left_pole(Q: Polynomial) -> str:
    """The root of Q with the smallest real part, to some digits; of several the first above ℝ."""
    before = ctx.prec
    try:
        # roots of higher multiplicity cannot be enclosed
        upper = [z for z in _roots(Q.square_free()) if not z.imag < 0]
        least = min(upper, key=lambda z: z.real.mid())
        as_far = [z for z in upper if z.real.overlaps(least.real)]
        pole = min(as_far, key=lambda z: z.imag.mid())
        real = ball_decimal(pole.real, _DIGITS)
        if pole.imag.contains(0):
            return real
        return f"{real} ± {ball_decimal(pole.imag, _DIGITS)}i"
    finally:
        ctx.prec = before


def _roots(Q: Polynomial) -> list[acb]:
    """Enclosures of the roots, which are simple: with more bits until they are told apart."""
    bits = _BITS
    while True:
        ctx.prec = bits
        digits = bits * 3 // 10
        balls = [acb(to_ball(a, digits)) for a in Q.coefficients]
        try:
            roots: list[acb] = acb_poly(balls).roots(tol=arb(2) ** -60, maxprec=4 * bits)
        except ValueError:
            bits *= 2
        else:
            return roots


def first_gap(intervals: Sequence[Interval]) -> Interval | None:
    """The first part of [0, ∞) that a set of intervals leaves out; None where there is none."""
    origin = RealRoot.rational(ZERO)
    end, is_left_out = origin, True
    for found in intervals:
        if found.start is not None and (end < found.start or not found.has_start):
            return Interval(end, found.start, is_left_out, not found.has_start)
        if found.end is None:
            return None
        end, is_left_out = found.end, not found.has_end
    return Interval(end, None, is_left_out)


def ends_text(gap: Interval | None, variable: str) -> str:
    """A gap as an inequality."""
    if gap is None:
        return ""
    if gap.is_point:
        return f"{variable} = {_number(gap.start)}"
    low, high = "≤" if gap.has_start else "<", "≤" if gap.has_end else "<"
    right = "" if gap.end is None else f" {high} {_number(gap.end)}"
    return f"{_number(gap.start)} {low} {variable}{right}"


def _number(root: RealRoot | None) -> str:
    assert root is not None
    return root_text(root) or root_decimal(root, 12)
