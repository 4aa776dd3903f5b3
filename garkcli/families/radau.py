"""Radau methods: order 2s − 1. Hairer & Wanner, *Solving Ordinary Differential Equations II*,
IV.5.
"""

from garkcli.families.polynomials import (
    collocation_method,
    conjugate_method,
    legendre,
)
from garkcli.tableau.method import Method


def radau_ia(s: int) -> Method:
    """Radau IA: the first node is 0 and D(s) holds."""
    collocation = collocation_method("", legendre(s) + legendre(s - 1))
    return conjugate_method(f"Radau IA {s}", collocation)


def radau_iia(s: int) -> Method:
    """Radau IIA: collocation, the last node is 1."""
    return collocation_method(f"Radau IIA {s}", legendre(s) - legendre(s - 1))
