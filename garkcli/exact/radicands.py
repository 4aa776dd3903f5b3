"""Roots of rational numbers: square classes, perfect powers."""

from __future__ import annotations

from flint import fmpq, fmpz

from garkcli.errors import UndefinedValue
from garkcli.exact.nodes import Root

TRIAL_LIMIT = 1000
"""Primes below are always found in radicands."""
MOST_BITS_FACTORED = 100
"""Numbers without smaller primes are factored up to so many bits, which takes milliseconds."""


def square_free(number: fmpq) -> fmpq:
    """An integer of the square class of ``number``, which is not 0, free of square factors.

    Squares of primes beyond ``TRIAL_LIMIT`` are only found where what is left without smaller
    primes has ``MOST_BITS_FACTORED`` bits at most, or is a square itself.

    >>> square_free(fmpq(4, 3)), square_free(fmpq(12)), square_free(fmpq(-3 * 27233**2))
    (3, 3, -3)
    """
    n = number.p * number.q
    factors = abs(n).factor(trial_limit=TRIAL_LIMIT)
    kept = fmpz(1 if n > 0 else -1)
    for factor, exponent in factors:
        if exponent % 2:
            kept *= _without_squares(factor)
    return fmpq(kept)


def _without_squares(factor: fmpz) -> fmpz:
    """A prime, or what is left without small primes."""
    if factor.bit_length() <= MOST_BITS_FACTORED:
        kept = fmpz(1)
        for prime, exponent in factor.factor():
            kept *= prime ** (exponent % 2)
        return kept
    root = factor.isqrt()
    if root * root == factor:
        return fmpz(1)
    return factor


def perfect_root(root: Root, radicand: fmpq) -> fmpq | None:
    """The value of a root of a perfect power; None where the radicand is none.

    Raises:
        UndefinedValue: an even root of a negative number.
    """
    if radicand < 0 and root.index % 2 == 0:
        raise even_root_fault(root)
    p = abs(radicand.p).root(root.index)
    q = radicand.q.root(root.index)
    if radicand < 0:
        p = -p
    candidate = fmpq(p, q)
    if candidate**root.index != radicand:
        return None
    return candidate


def even_root_fault(root: Root) -> UndefinedValue:
    """What is said of an even root of a negative number."""
    message = "an even root of a negative number"
    cure = "coefficients are real numbers"
    return UndefinedValue(message, cure, root.start, root.end, code="not-real")


def rational_square_root(number: fmpq) -> fmpq | None:
    """The square root of a number that is not negative; None where it is irrational."""
    root = fmpq(number.p.isqrt(), number.q.isqrt())
    if root**2 != number:
        return None
    return root
