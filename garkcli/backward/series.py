"""B-series in coloured trees: the Lie algebra of vector fields and the group of their flows.

For a function c on trees B(c, y) = Σ_u h^ρ(u)/σ(u) c(u) F(u)(y). The derivative of B(c, y) along
the field B(b, y) is B(c ◁ b, y) with

    (c ◁ b)(u) = Σ c(u∖v) b(v),

a sum over the edges of u, v what hangs below the edge. So the flow of B(b, y) over the time 1 is
B(a, y) with

    a(u) = Σ_{j ≥ 1} 1/j! (…((b ◁ b) ◁ b) … ◁ b)(u)         j factors,

which is solved for b tree by tree: terms with j ≥ 2 have trees of lower order alone.

Source: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, 2nd ed. (2006), lemma IX.9.1
and theorem IX.9.2, there in one colour.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial
from typing import TypeAlias

from flint import fmpq

from garkcli.backward.forest import Forest
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector, apply, dot
from garkcli.tableau.tableau import Tableau

Coefficients: TypeAlias = Sequence[Number]
"""A function on the trees of a forest, by their numbers."""


def elementary_weights(tableau: Tableau, forest: Forest) -> list[Number]:
    """a(u) = b_lᵀ 𝒜^[u], the B-series of the method."""
    vectors: list[Vector] = []
    weights: list[Number] = []
    for root, branches in forest.branches():
        space = tableau.space(root)
        vector = space.one
        for branch in branches:
            below = forest.trees[branch].root
            block = tableau.block(root, below)
            assert block is not None  # the trees are those that the tableau admits
            vector = space.product(vector, apply(block, vectors[branch]))
        vectors.append(vector)
        weights.append(dot(tableau.colours[root].b, vector))
    return weights


def exact_weights(forest: Forest) -> list[Number]:
    """1/γ(u), the B-series of the exact flow."""
    return [fmpq(1, tree.density) for tree in forest.trees]


def logarithm(forest: Forest, a: Coefficients) -> list[Number]:
    """The b with B(a, y) the flow of B(b, y): the modified vector field of a method, times h.

    >>> from garkcli.trees.count import Admissible
    >>> forest = Forest.of(Admissible.of(1), 4)
    >>> logarithm(forest, exact_weights(forest))
    [1, 0, 0, 0, 0, 0, 0, 0]
    >>> logarithm(forest, [1, 0, 0, 0, 0, 0, 0, 0])  # the explicit Euler method
    [1, -1/2, 1/6, 1/3, 0, -1/12, -1/6, -1/4]
    """
    powers = _Powers(forest)
    for number, weight in enumerate(a):
        higher = powers.sum_of_higher(number)
        powers.add(number, weight - higher)
    return powers.field


def exponential(forest: Forest, b: Coefficients) -> list[Number]:
    """The a with B(a, y) the flow of B(b, y) over the time 1."""
    powers = _Powers(forest)
    weights: list[Number] = []
    for number, coefficient in enumerate(b):
        weights.append(coefficient + powers.sum_of_higher(number))
        powers.add(number, coefficient)
    return weights


class _Powers:
    """The products b, b ◁ b, (b ◁ b) ◁ b, … tree by tree.

    ``products[u][j]`` is the one of j + 1 factors at the tree u.
    """

    def __init__(self, forest: Forest) -> None:
        self.forest = forest
        self.field: list[Number] = []
        self.products: list[list[Number]] = []

    def sum_of_higher(self, number: int) -> Number:
        """Σ_{j ≥ 2} 1/j! of the products with j factors; keeps them."""
        order = self.forest.order(number)
        products: list[Number] = [ZERO] * order
        for cut in self.forest.cuts[number]:
            factor = self.field[cut.branch] * cut.times
            if not factor:
                continue
            for j, product in enumerate(self.products[cut.rest], start=1):
                if product:
                    products[j] = products[j] + product * factor
        self.products.append(products)
        total: Number = ZERO
        for j in range(1, order):
            total = total + products[j] / factorial(j + 1)
        return total

    def add(self, number: int, coefficient: Number) -> None:
        """Tell b(u) of the tree whose higher products have just been summed."""
        self.products[number][0] = coefficient
        self.field.append(coefficient)


def product(forest: Forest, c: Coefficients, b: Coefficients) -> list[Number]:
    """The product c ◁ b: the derivative of one vector field along another."""
    values: list[Number] = []
    for cuts in forest.cuts:
        total: Number = ZERO
        for cut in cuts:
            left, right = c[cut.rest], b[cut.branch]
            if left and right:
                total = total + left * right * cut.times
        values.append(total)
    return values


def bracket(forest: Forest, c: Coefficients, b: Coefficients) -> list[Number]:
    """[c, b] = c ◁ b − b ◁ c."""
    forth, back = product(forest, c, b), product(forest, b, c)
    return [x - y for x, y in zip(forth, back, strict=True)]


def transported(forest: Forest, b: Coefficients, c: Coefficients, lowest: int) -> list[Number]:
    """e^{ad c} b: the field B(b, y) in the coordinates z = χ(y), χ the flow of B(c, y) over the
    time 1.

    For small c the new field is f(z) − f'(z) g + g' f = f + [g, f], with f that of b,
    g that of c.

    Args:
        forest: the trees.
        b: the field.
        c: the field of the change of coordinates.
        lowest: the least order of a tree at which c is not zero; at least 1.
    """
    result = list(b)
    nested: list[Number] = list(b)
    # each bracket raises the order by the lowest one of c
    for j in range(1, (forest.max_order - 1) // lowest + 1):
        nested = bracket(forest, c, nested)
        for number, value in enumerate(nested):
            if value:
                result[number] = result[number] + value / factorial(j)
    return result
