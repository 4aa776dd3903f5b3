"""Polynomials whose coefficients are balls: what is the same for all numbers in them.

A coefficient list starts with that of 1. None means that the balls are too wide to tell.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from flint import arb


def root_count(coefficients: Sequence[arb]) -> int | None:
    """The number of distinct real roots, by Sturm's chain; None too where roots are multiple.

    >>> root_count([arb(-2), arb(0), arb(1)]), root_count([arb(2), arb(0), arb(1)])
    (2, 0)
    """
    return cauchy_index(coefficients, derivative(coefficients))


def cauchy_index(f: Sequence[arb], g: Sequence[arb]) -> int | None:
    """The Cauchy index of g/f over the real line, by the chain f, g, −rem, …"""
    chain = [list(f), list(g)]
    while len(chain[-1]) > 1:
        rest = _negative_remainder(chain[-2], chain[-1])
        if rest is None:
            return None
        chain.append(rest)
    if not chain[-1]:
        return None
    leading = [p[-1] for p in chain]
    if any(a.contains(0) for a in leading):
        return None
    at_minus = _variations(chain, at_plus=False)
    at_plus = _variations(chain, at_plus=True)
    return at_minus - at_plus


def derivative(coefficients: Sequence[arb]) -> list[arb]:
    """The derivative."""
    return [k * a for k, a in enumerate(coefficients) if k]


def value(coefficients: Sequence[arb], x: arb) -> arb:
    """The value at x, by Horner's rule."""
    total = arb(0)
    for a in reversed(coefficients):
        total = total * x + a
    return total


def _negative_remainder(f: Sequence[arb], g: Sequence[arb]) -> list[arb] | None:
    """−(f mod g), with a leading coefficient that is not zero."""
    *lower, leading = g
    if leading.contains(0):
        return None
    rest = list(f)
    while len(rest) >= len(g):
        factor = rest.pop() / leading
        shift = len(rest) - len(lower)
        for k, a in enumerate(lower, start=shift):
            rest[k] = rest[k] - factor * a
    while rest and rest[-1].is_zero():
        rest.pop()
    if not rest or rest[-1].contains(0):
        return None
    return [-a for a in rest]


def _variations(chain: Sequence[Sequence[arb]], at_plus: bool) -> int:
    """Changes of sign along the chain at ∞ or −∞."""
    signs = []
    for p in chain:
        is_positive = bool(p[-1] > 0)
        has_odd_degree = len(p) % 2 == 0
        if has_odd_degree and not at_plus:
            is_positive = not is_positive
        signs.append(is_positive)
    return sum(1 for a, b in pairwise(signs) if a != b)
