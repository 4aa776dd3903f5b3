"""Rational numbers as decimals of a given number of places."""

from __future__ import annotations

from flint import fmpq


def in_decimals(number: fmpq, digits: int) -> str:
    """The nearest decimal with ``digits`` decimals; ``0`` if that is zero.

    >>> in_decimals(fmpq(-1, 3), 4), in_decimals(fmpq(0), 4)
    ('-0.3333', '0')
    """
    rounded = int((abs(number) * fmpq(10) ** digits + fmpq(1, 2)).floor())
    if not rounded:
        return "0"
    text = str(rounded).zfill(digits + 1)
    return f"{'-' if number < 0 else ''}{text[:-digits]}.{text[-digits:]}"
