"""Rational numbers as decimals of a given number of places."""

from __future__ import annotations

from flint import fmpq


def in_decimals(number: fmpq, digits: int) -> str:
    rounded = int((abs(number) * fmpq(10) ** digits + fmpq(1, 2)).floor())
    if not rounded:
        return "0"
    text = str(rounded).zfill(digits + 1)
    return f"{'-' if number < 0 else ''}{text[:-digits]}.{text[-digits:]}"
