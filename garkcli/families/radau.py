"""Radau methods: order 2s − 1.

Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.5; IB and IIB: G. Sun, *A simple
way constructing symplectic Runge–Kutta methods*, J. Comput. Math. 18 (2000).
"""

from garkcli.families.family import of_stages
from garkcli.families.polynomials import average, collocation_method, conjugate_method, legendre
from garkcli.tableau.tableau import Method


def radau_ia(s: int) -> Method:
    """Radau IA: the first node is 0 and D(s) holds."""
    collocation = collocation_method("", legendre(s) + legendre(s - 1))
    return conjugate_method(f"Radau IA {s}", collocation)


def radau_iia(s: int) -> Method:
    """Radau IIA: collocation, the last node is 1."""
    return collocation_method(f"Radau IIA {s}", legendre(s) - legendre(s - 1))


def radau_ib(s: int) -> Method:
    """Radau IB: the mean of IA and its symplectic conjugate, symplectic."""
    base = radau_ia(s)
    return average(f"Radau IB {s}", base, conjugate_method("", base))


def radau_iib(s: int) -> Method:
    """Radau IIB: the mean of IIA and its symplectic conjugate, symplectic."""
    base = radau_iia(s)
    return average(f"Radau IIB {s}", base, conjugate_method("", base))


FAMILIES = (
    of_stages("radau-ia", radau_ia, 1, "2s - 1", "first node 0, D(s)"),
    of_stages("radau-iia", radau_iia, 1, "2s - 1", "collocation, last node 1"),
    of_stages("radau-ib", radau_ib, 2, "2s - 1", "of IA; symplectic"),
    of_stages("radau-iib", radau_iib, 2, "2s - 1", "of IIA; symplectic"),
)
