"""Positive numbers of any size as short text.

A measured number is a ball whose radius is the effect of rounding. Digits within the radius depend
on the processor and are not shown; a ball around 0 shows a bound only.
"""

from __future__ import annotations

import math
from math import ceil, floor
from typing import Any

from flint import arb

_DIGITS_PER_BIT = math.log10(2)
_ALL = 15  # digits of a float
UNKNOWN = "unknown"
"""The text for a ball that is not finite."""


def log10(x: Any) -> float:
    """Returns the decimal logarithm of a positive number of any size."""
    return float(arb(x).log() / arb(10).log())


def order_text(order: float | None) -> str:
    """Returns an observed order as text, without −0.00."""
    return "none" if order is None else f"{round(order, 2) + 0.0:.2f}"


def _without_digits(ball: arb) -> str:
    if not ball.is_finite():
        return UNKNOWN
    if ball.is_zero():
        return "0"
    return f"< 1e{bound(ball)}" if ball.contains(0) else ""


def rounded(ball: Any, digits: int = 4) -> str:
    """Returns a few digits of an enclosed number; "0" for zero, a bound below round-off.

    >>> rounded(arb(1) / 3), rounded(arb(1, 0.004)), rounded(arb(0, 3e-15)), rounded(arb(0))
    ('0.3333', '1.00', '< 1e-14', '0')
    """
    ball = arb(ball)
    if said := _without_digits(ball):
        return said
    return str(ball.str(digits, radius=False))


def scientific(ball: Any, digits: int = 3) -> str:
    """Returns a few digits with an exponent, so that columns are compared by their ends.

    >>> scientific(arb(2) / 300), scientific(arb("9.999e-400")), scientific(arb(12, 0.5), 6)
    ('6.67e-3', '1.00e-399', '1e1')
    """
    ball = arb(ball)
    if said := _without_digits(ball):
        return said
    digits = min(digits, certain_digits(ball))
    middle = ball.mid()
    exponent = floor(log10(middle))
    scaled = float(middle / arb(10) ** exponent)
    decimals = digits - 1
    mantissa = f"{scaled:.{decimals}f}"
    if float(mantissa) >= 10:
        exponent += 1
        mantissa = f"{1:.{decimals}f}"
    return f"{mantissa}e{exponent}"


def for_programs(ball: Any, digits: int = 6) -> str:
    """Returns a few digits for programs: a bound is its power of ten, an infinite number is empty.

    >>> for_programs(arb(2) / 3), for_programs(arb(0, 3e-15)), for_programs(arb(-1).sqrt())
    ('6.66667e-1', '1e-14', '')
    """
    return scientific(ball, digits).removeprefix("< ") if arb(ball).is_finite() else ""


def bound(ball: Any) -> int:
    """Returns the smallest k for which a ball around 0 is below 10^k."""
    return ceil(log10(arb(ball).abs_upper()))


def certain_digits(ball: Any) -> int:
    bits = min(arb(ball).rel_accuracy_bits(), 10**6)
    digits = floor(bits * _DIGITS_PER_BIT)
    return min(max(digits, 1), _ALL)


def measured(value: float, good_to: float, most: int = 5) -> str:
    """Returns a measured number with the digits above its error, at most ``most``.

    >>> measured(0.0123456, 1e-12), measured(1.2345e-13, 1e-15, 3), measured(3e-16, 1e-15)
    ('1.2346e-02', '1.23e-13', 'below round-off')
    """
    if abs(value) <= good_to:
        return "below round-off"
    digits = min(most, max(1, floor(math.log10(abs(value) / good_to)) + 1)) if good_to else most
    return f"{value:.{digits - 1}e}"
