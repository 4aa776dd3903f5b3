"""What rounding can do to one condition: how far the elementary weight of a tree moves at most.

By the mean value theorem b_lᵀ 𝒜^[u] changes by no more than Σ ρ_p |∂_p|, over all coefficients p
with their radii ρ_p, where each derivative is enclosed for all tableaus of the box. The derivative
to the entries of a block is Σ y 𝒜^[v]ᵀ over the edges of u that the block belongs to: v is what the
edge carries, and yᵀ A 𝒜^[v] the whole weight. Derivatives keep their signs, so large
coefficients that cancel do not make the bound large.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from flint import arb, arb_mat, ctx, fmpq

from garkcli.exact.enclosing import midpoint, scalar_product
from garkcli.exact.matrix import Vector
from garkcli.ntrees.tree import Tree
from garkcli.order.tree_vectors import TreeVectors
from garkcli.tableau.rounded import RoundedTableau, Row
from garkcli.tableau.tableau import Edge

BITS = 128
"""Precision of the bounds; they are wanted to a digit or two."""


class Effects:
    """Bounds on what rounding does to the weights of trees; what their branches share is kept.

    Args:
        rounded: the tableau with its radii.
    """

    def __init__(self, rounded: RoundedTableau) -> None:
        self.rounded = rounded
        self._balls = rounded.in_balls
        self._radii = {key: [x for row in rows for x in row] for key, rows in rounded.A.items()}
        self._vectors = TreeVectors(self._balls)

    def effect(self, tree: Tree) -> arb:
        """No method of the box has another weight b_lᵀ 𝒜^[u] by more."""
        l = tree.root
        with ctx.workprec(BITS):
            total = _largest(self.rounded.b[l], self._vectors.of(tree))
            slopes: dict[Edge, arb_mat] = {}
            self._add_slopes(tree, self._balls.colours[l].b, slopes)
            for key, slope in slopes.items():
                total += _largest(self._radii[key], slope.entries())
            return total.abs_upper()

    def bound(self, tree: Tree) -> fmpq:
        """The same as a rational number."""
        return midpoint(self.effect(tree))

    def _add_slopes(self, tree: Tree, y: Vector, slopes: dict[Edge, arb_mat]) -> None:
        """Add the derivatives to the blocks on the edges of a tree, whose weight is yᵀ 𝒜^[u]."""
        l = tree.root
        space = self._balls.space(l)
        for number, branch in enumerate(tree.branches):
            rest = y
            for other in tree.branches[:number] + tree.branches[number + 1 :]:
                rest = space.product(rest, self._vectors.image(l, other))
            key = self._balls.colours[l].space, branch.root
            row = _row(rest)
            slope = row.transpose() * _row(self._vectors.of(branch))
            slopes[key] = slopes[key] + slope if key in slopes else slope
            if branch.branches:
                below: Any = (row * self.rounded.balls.A[key]).entries()
                self._add_slopes(branch, below, slopes)


def _row(vector: Iterable[Any]) -> arb_mat:
    return arb_mat([list(map(arb, vector))])


def _largest(radii: Row, slopes: Iterable[Any]) -> arb:
    """Σ ρ |∂| over some entries."""
    return scalar_product(radii, [abs(arb(x)) for x in slopes])
