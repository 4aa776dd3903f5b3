"""Gauss methods: order 2s."""

from garkcli.families.family import of_stages
from garkcli.families.polynomials import collocation_method, legendre
from garkcli.tableau.tableau import Method


def gauss(s: int) -> Method:
    """The s-stage Gauss method; Hairer, Lubich & Wanner, *Geometric Numerical Integration*,
    II.1.3.
    """
    return collocation_method(f"Gauss {s}", legendre(s))


FAMILIES = (of_stages("gauss", gauss, 1, "2s", "collocation at the Gauss nodes; symplectic"),)
