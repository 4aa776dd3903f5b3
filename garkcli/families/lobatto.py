"""Lobatto methods: order 2s − 2, nodes 0 and 1 among them.

Jay, "Lobatto methods", *Encyclopedia of Applied and Computational Mathematics* (2015). They need s
≥ 2.
"""

from __future__ import annotations

from typing import cast

from garkcli.exact.field import ONE
from garkcli.exact.matrix import Vector, add, scale
from garkcli.exact.nodes import Expression
from garkcli.families.family import MAX_STAGES, Family, Option, Options, Recipe, of_stages
from garkcli.families.polynomials import (
    X,
    average,
    collocation_method,
    conjugate_method,
    legendre,
    with_first_column,
)
from garkcli.tableau.tableau import Method


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


def lobatto_iiie(s: int) -> Method:
    """Lobatto IIIE: the mean of IIIA and IIIB, symplectic."""
    return average(f"Lobatto IIIE {s}", lobatto_iiia(s), lobatto_iiib(s))


SIGMA = Option(
    "sigma", "The number σ that chooses a Lobatto IIIS method: 1/2 is IIIE, 1 is IIID.", shown="1/2"
)


def lobatto_iiis(s: int, options: Options) -> Recipe:
    """Lobatto IIIS: symplectic and symmetric for every σ; IIIE for σ = 1/2, IIID for σ = 1.

    R. P. K. Chan, *On symmetric Runge–Kutta methods of high order*, Computing 45 (1990).
    """

    def make(values: Vector) -> Method:
        (sigma,) = values
        one, other = lobatto_iiid(s), lobatto_iiie(s)
        of_one = 2 * sigma - ONE
        of_other = 2 * (ONE - sigma)
        A = add(scale(of_one, one.A), scale(of_other, other.A))
        return Method(f"Lobatto IIIS {s}", one.space, A, one.b)

    return Recipe(s, make, (cast("Expression", options["sigma"]),))


_ORDER = "2s - 2"
FAMILIES = (
    of_stages("lobatto-iiia", lobatto_iiia, 2, _ORDER, "collocation, nodes 0 and 1"),
    of_stages("lobatto-iiib", lobatto_iiib, 2, _ORDER, "symplectic conjugate of IIIA"),
    of_stages("lobatto-iiic", lobatto_iiic, 2, _ORDER, "a_i1 = b_1, stiffly accurate"),
    of_stages("lobatto-iiic*", lobatto_iiic_star, 2, _ORDER, "conjugate of IIIC"),
    of_stages("lobatto-iiid", lobatto_iiid, 2, _ORDER, "mean of IIIC and IIIC*; symplectic"),
    of_stages("lobatto-iiie", lobatto_iiie, 2, _ORDER, "mean of IIIA and IIIB; symplectic"),
    Family(
        "lobatto-iiis",
        lobatto_iiis,
        2,
        MAX_STAGES,
        _ORDER,
        "IIIE for sigma: 1/2, IIID for 1",
        options=(SIGMA,),
    ),
)
