"""Entries and rows of families at irrational nodes; imported only for such methods."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from flint import fmpq, fmpq_poly

from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector, apply, apply_left
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.exact.roots import RealRoot, real_roots, roots_below, vanishes_at
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau


def is_nonzero_at(tableau: Tableau, place: tuple[int, int], i: int, j: int) -> bool | None:
    """Whether an entry between stages of families is nonzero; None unless one node is rational.
    With M the node polynomial of the columns, L_j is a multiple of M/(x − x_j); the entry is the
    value of A L_j at x_i. For a rational x_i that is a polynomial in x_j.
    """
    k, m = place
    here = tableau.spaces[k]
    there = tableau.space(m)
    if not isinstance(here, PolynomialSpace):
        return None
    if not isinstance(there, PolynomialSpace):
        return None
    row_node = nodes_of(here)[i]
    column_node = nodes_of(there)[j]
    block = tableau.blocks[place]
    if column_node.exact is not None:
        others = there.modulus // fmpq_poly([-column_node.exact, 1])
        entry = Polynomial(apply(block, [others[n] for n in range(there.stages)]))
        return not vanishes_at(entry, row_node)
    if row_node.exact is not None:
        powers = [row_node.exact**n for n in range(here.stages)]
        entry = divided(there.modulus, apply_left(powers, block))
        return not vanishes_at(entry, column_node)
    return None


@lru_cache(maxsize=32)
def nodes_of(space: PolynomialSpace) -> list[RealRoot]:
    return [node for node, _ in real_roots(Polynomial.from_flint(space.modulus))]


def divided(M: fmpq_poly, values: Sequence[Number]) -> Polynomial:
    """The polynomial in y that a functional makes of (M(x) − M(y))/(x − y)."""
    s = M.degree()
    product = Polynomial(values[::-1]) * Polynomial.from_flint(M)
    return Polynomial([product[s + n] for n in range(s)])


def is_family_stage(tableau: Tableau, k: int, i: int, wanted: Sequence[Vector]) -> bool:
    """Whether stage i of a family, nodes ascending, has the rows ``wanted``."""
    space = tableau.spaces[k]
    assert isinstance(space, PolynomialSpace)
    common = common_nodes(tableau, k, wanted)
    if common.degree == 0:
        return False
    node = -common[0] / common[1]
    if common.degree == 1 and isinstance(node, fmpq):
        return roots_below(space.modulus, node) == i
    return vanishes_at(common, nodes_of(space)[i])


def common_nodes(tableau: Tableau, k: int, wanted: Sequence[Vector]) -> Polynomial:
    """The polynomial whose roots are the nodes of a family at which a stage has the rows
    ``wanted``: in the stage algebra ℚ[x]/(M) the rows at a node ξ are the functionals f ↦ (A f)(ξ).
    They equal ``wanted`` at the common roots of M and all A e − wanted(e)·𝟙, e in a basis.
    """
    space = tableau.spaces[k]
    assert isinstance(space, PolynomialSpace)
    found = Polynomial.from_flint(space.modulus)
    for m, row in enumerate(wanted):
        block = tableau.blocks.get((k, m))
        for j, value in enumerate(row):
            column: list[Number] = []
            if block is not None:
                column = [entries[j] for entries in block]
            found = gcd(found, Polynomial(column) - value)
            if found.degree == 0:
                return found
    return found
