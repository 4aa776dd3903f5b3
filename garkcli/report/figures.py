"""Positive numbers of any size as short text."""

from __future__ import annotations

from typing import Any

from flint import arb

from garkcli.report.asciiplot import log10


def rounded(ball: Any, digits: int = 4) -> str:
    """A few digits of an enclosed number; "0" for zero.

    >>> rounded(arb(1) / 3)
    '0.3333'
    """
    return "0" if ball.is_zero() else str(arb(ball).str(digits, radius=False))


def scientific(ball: Any, digits: int = 3) -> str:
    """The same with an exponent always, so that columns are read by their ends.

    >>> scientific(arb(2) / 300), scientific(arb("9.999e-400")), scientific(arb(12)), scientific(arb(0))
    ('6.67e-3', '1.00e-399', '1.20e1', '0')
    """
    if ball <= 0:
        return "0"
    exponent = int(log10(ball) // 1)
    mantissa = f"{float(arb(ball) / arb(10) ** exponent):.{digits - 1}f}"
    if float(mantissa) >= 10:
        exponent += 1
        mantissa = f"{1:.{digits - 1}f}"
    return f"{mantissa}e{exponent}"
