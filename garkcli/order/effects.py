"""What rounding can do to one condition: how far the elementary weight of a tree moves at most.

By the mean value theorem b_lᵀ 𝒜^[u] changes by no more than Σ ρ_p |∂_p|, over all coefficients p
with their radii ρ_p, where each derivative is enclosed for all tableaus of the box. The derivative
to the entries of a block is Σ y 𝒜^[v]ᵀ over the edges of u that the block belongs to: v is what
hangs on the edge, and yᵀ A 𝒜^[v] the whole weight. Derivatives keep their signs, so large
coefficients that cancel do not make the bound large.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, arb_mat, ctx, fmpq

from garkcli.order.entries import scalar_product, times
from garkcli.tableau.rounded import RoundedTableau, Row
from garkcli.tableau.tableau import Edge
from garkcli.trees.tree import Tree

BITS = 128
"""Precision of the bounds; they are wanted to a digit or two."""


class Effects:
    """Bounds on what rounding does to the weights of trees; what their branches share is kept.

    Args:
        rounded: the tableau with its radii.
    """

    def __init__(self, rounded: RoundedTableau) -> None:
        self.rounded = rounded
        self._spaces = [colour.space for colour in rounded.tableau.colours]
        self._A = rounded.balls.A
        self._back = {key: block.transpose() for key, block in self._A.items()}
        self._radii = {key: [x for row in rows for x in row] for key, rows in rounded.A.items()}
        self._vectors: dict[tuple[int, Tree], Row] = {}
        self._images: dict[tuple[int, Tree], Row] = {}

    def effect(self, tree: Tree) -> arb:
        """No method of the box has another weight b_lᵀ 𝒜^[u] by more."""
        l = tree.root
        with ctx.workprec(BITS):
            moved = [abs(x) for x in self._vector(tree)]
            total = scalar_product(self.rounded.b[l], moved)
            slopes: dict[Edge, arb_mat] = {}
            self._add_slopes(tree, self.rounded.balls.b[l].entries(), slopes)
            for key, slope in slopes.items():
                sizes = [abs(x) for x in slope.entries()]
                total += scalar_product(self._radii[key], sizes)
            return total.abs_upper()

    def bound(self, tree: Tree) -> fmpq:
        """The same as a rational number."""
        mantissa, exponent = self.effect(tree).man_exp()
        return fmpq(mantissa) * fmpq(2) ** int(exponent)

    def _vector(self, tree: Tree) -> Row:
        """𝒜^[u] of the tableaus of the box."""
        k = self._spaces[tree.root]
        key = k, tree
        if key not in self._vectors:
            vector = [arb(1)] * self.rounded.balls.stages[k]
            for branch in tree.branches:
                vector = times(vector, self._image(k, branch))
            self._vectors[key] = vector
        return self._vectors[key]

    def _image(self, k: int, branch: Tree) -> Row:
        """A 𝒜^[u], as the stages of space k see a branch u."""
        key = k, branch
        if key not in self._images:
            self._images[key] = _applied(self._A[k, branch.root], self._vector(branch))
        return self._images[key]

    def _add_slopes(self, tree: Tree, y: Sequence[arb], slopes: dict[Edge, arb_mat]) -> None:
        """Add the derivatives to the blocks on the edges of a tree, whose weight is yᵀ 𝒜^[u]."""
        k = self._spaces[tree.root]
        for number, branch in enumerate(tree.branches):
            others = tree.branches[:number] + tree.branches[number + 1 :]
            rest = list(y)
            for other in others:
                rest = times(rest, self._image(k, other))
            key = k, branch.root
            slope = arb_mat([[x] for x in rest]) * arb_mat([self._vector(branch)])
            slopes[key] = slopes[key] + slope if key in slopes else slope
            if branch.branches:
                self._add_slopes(branch, _applied(self._back[key], rest), slopes)


def _applied(matrix: arb_mat, vector: Sequence[arb]) -> Row:
    return (matrix * arb_mat([[x] for x in vector])).entries()
