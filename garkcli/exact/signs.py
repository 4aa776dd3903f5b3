"""Signs of exact numbers, and roots that are counted by signs."""

from __future__ import annotations

from itertools import pairwise

from flint import fmpq, fmpq_poly

from garkcli.deadline import check_time
from garkcli.exact.display import to_ball
from garkcli.exact.field import Algebraic, Number

FIRST_BITS = 64
"""The precision at which signs are tried first; it doubles until they are decided."""


def sign(number: Number) -> int:
    """The sign of an exact number, −1, 0 or 1: zero is known exactly, the rest by enclosures."""
    if not isinstance(number, Algebraic):
        return (number > 0) - (number < 0)
    digits = FIRST_BITS * 3 // 10
    while True:
        check_time()
        ball = to_ball(number, digits)
        if ball > 0 or ball < 0:
            return 1 if ball > 0 else -1
        digits *= 2


def roots_below(M: fmpq_poly, x: fmpq) -> int:
    """How many roots of a polynomial with real roots only are smaller than x, by Descartes' rule,
    which is exact for these.

    >>> roots_below(fmpq_poly([0, 2, -3, 1]), fmpq(2))  # the roots 0, 1, 2
    2
    """
    mirrored = M(fmpq_poly([x, -1]))
    signs = [a > 0 for a in mirrored.coeffs() if a]
    return sum(1 for a, b in pairwise(signs) if a != b)
