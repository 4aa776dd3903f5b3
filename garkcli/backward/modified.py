"""The modified equation of a method, in trees.

A method with elementary weights a(u) = b_lᵀ 𝒜^[u] is, as a power series in h, the exact flow of

    ẏ = Σ_u h^(ρ(u)−1)/σ(u) b(u) F(u)(y) = f(y) + h f₂(y) + h² f₃(y) + …

with b(u) = 1 for single vertices if the method is consistent, and b(u) = 0 for 2 ≤ ρ(u) ≤ p if and
only if it has order p.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from garkcli.backward.series import Forest, elementary_weights, logarithm
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.tableau.tableau import Tableau


class ModifiedEquation(Frozen):
    """The coefficients b(u) of a method up to an order, by the indices of ``forest``."""

    tableau: Tableau
    forest: Forest
    coefficients: tuple[Number, ...]

    @property
    def max_order(self) -> int:
        return self.forest.max_order

    def __getitem__(self, tree: Tree) -> Number:
        """b(u); 0 for a tree that the method does not see, KeyError beyond ``max_order``."""
        if tree.order > self.max_order:
            raise KeyError(tree)
        number = self.forest.number(tree)
        return ZERO if number is None else self.coefficients[number]

    def terms(self, order: int) -> Iterator[tuple[Tree, Number]]:
        for number in self.forest.of_order(order):
            if self.coefficients[number]:
                yield self.forest.trees[number], self.coefficients[number]

    def residuals(self, order: int) -> Iterator[tuple[Tree, Number]]:
        """The trees of this order at which the modified equation differs, with the differences."""
        if order > 1:
            yield from self.terms(order)
            return
        for number in self.forest.of_order(1):
            difference = self.coefficients[number] - ONE
            if difference:
                yield self.forest.trees[number], difference

    @cached_property
    def order(self) -> int:
        for n in range(1, self.max_order + 1):
            if any(True for _ in self.residuals(n)):
                return n - 1
        return self.max_order

    def __repr__(self) -> str:
        return f"<ModifiedEquation of trees up to order {self.max_order}>"


def modified_equation(tableau: Tableau, order: int) -> ModifiedEquation:
    """Raises UsageProblem for too many trees, and MethodError if the tableau is no GARK method."""
    tableau.demand_fields("the modified equation")
    forest = Forest.seen_by(tableau, order)
    weights = elementary_weights(tableau, forest)
    return ModifiedEquation(tableau, forest, tuple(logarithm(forest, weights)))
