"""Strategies that draw what many properties are tried on."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st


def fractions(low: int, high: int, most: int) -> st.SearchStrategy[Fraction]:
    """All fractions between two bounds with denominators up to ``most``, the simplest first.

    One draw makes one of them; ``st.fractions`` takes several, which for matrices cost more than
    what is tested.
    """
    found = {Fraction(p, q) for q in range(1, most + 1) for p in range(low * q, high * q + 1)}
    return st.sampled_from(sorted(found, key=lambda x: (x.denominator, abs(x), x)))
