"""Lobatto methods: order 2s − 2, nodes 0 and 1 among them.

Jay, "Lobatto methods", *Encyclopedia of Applied and Computational Mathematics* (2015). They need s
≥ 2.
"""

from garkcli.families.polynomials import (
    X,
    average,
    collocation_method,
    conjugate_method,
    legendre,
    with_first_column,
)
from garkcli.tableau.method import Method


def lobatto_iiia(s: int) -> Method:
    """Lobatto IIIA: collocation, C(s)."""
    inner_nodes = legendre(s - 1).derivative()
    return collocation_method(f"Lobatto IIIA {s}", X * (X - 1) * inner_nodes)


def lobatto_iiib(s: int) -> Method:
    """Lobatto IIIB: the symplectic conjugate of IIIA, D(s)."""
    return conjugate_method(f"Lobatto IIIB {s}", lobatto_iiia(s))


def lobatto_iiic(s: int) -> Method:
    """Lobatto IIIC: a_{i1} = b_1 and C(s − 1)."""
    return with_first_column(f"Lobatto IIIC {s}", lobatto_iiia(s))


def lobatto_iiic_star(s: int) -> Method:
    """Lobatto IIIC*, also called Lobatto III: the symplectic conjugate of IIIC."""
    return conjugate_method(f"Lobatto IIIC* {s}", lobatto_iiic(s))


def lobatto_iiid(s: int) -> Method:
    """Lobatto IIID: the mean of IIIC and IIIC*, symplectic."""
    return average(f"Lobatto IIID {s}", lobatto_iiic(s), lobatto_iiic_star(s))
