"""Polynomials in free parameters: which products are too long to be computed."""

from __future__ import annotations

import pytest

from garkcli.errors import TooManyTerms
from garkcli.exact.parametric import Parameters, times

X, Y = Parameters(["x", "y"]).context.gens()


def test_products_are_refused_by_their_own_terms() -> None:
    """800 terms times 800: 1599 powers of x, whose coefficients count the ways to write a sum, or
    640 000 products of a power of x and one of y.
    """
    p, q = (sum((v**k for k in range(1, 800)), v**0) for v in (X, Y))
    product = times(p, p)
    assert len(product) == 1599
    assert all(product[k, 0] == min(k + 1, 1599 - k) for k in range(1599))
    with pytest.raises(TooManyTerms):
        times(p, q)
