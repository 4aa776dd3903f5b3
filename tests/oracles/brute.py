"""Every admissible tree, one after the other: the order by its definition, Theorem (Order of GARK
methods).

A tree is a pair ``(root, branches)`` with the branches in a fixed order, so that each tree occurs
once. Where vertices count several orders, or the exact solution has none of them, the definition
goes on: ``required`` integrates a vertex as often as it counts.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector
from garkcli.ntrees.tree import Tree
from garkcli.tableau.tableau import Tableau
from tests.oracles.stages import image, one, pairing, product

Plain: TypeAlias = tuple[int, tuple["Plain", ...]]


class Trees:
    """The admissible trees of a tableau, order by order: parents see their branches, and have as
    many as their kind allows.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> trees = Trees(gark([diagonal_method("gauss", 1)], {}))
    >>> [len(trees.of_order(n)) for n in range(1, 8)]
    [1, 1, 2, 4, 9, 20, 48]
    """

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._levels: list[list[Plain]] = []

    def of_order(self, order: int) -> list[Plain]:
        """All of them of an order: with as many vertices, where each counts one."""
        while len(self._levels) < order:
            level: list[Plain] = []
            for l, colour in enumerate(self.tableau.colours):
                left = len(self._levels) + 1 - colour.kind.weight
                if left >= 0:
                    level += [(l, forest) for forest in self._forests(l, left)]
            self._levels.append(level)
        return self._levels[order - 1]

    def _forests(self, l: int, size: int) -> list[tuple[Plain, ...]]:
        seen = {m for m in range(self.tableau.size) if self.tableau.block(l, m) is not None}
        arity = self.tableau.colours[l].kind.arity
        # a vertex that counts no order has several branches: each is of a smaller order
        largest = size if arity & {0, 1} else size - 1
        choices = [(n, u) for n in range(1, largest + 1) for u in self.of_order(n) if u[0] in seen]
        most = size if 2 in arity else 1
        return [x for x in _multisets(choices, size, most) if min(len(x), 2) in arity]


def _multisets(
    choices: list[tuple[int, Plain]], size: int, most: int, first: int = 0
) -> Iterator[tuple[Plain, ...]]:
    """Multisets of at most ``most`` of the choices from ``first`` on, with ``size`` vertices in
    all.
    """
    if size == 0:
        yield ()
        return
    if most == 0:
        return
    for k in range(first, len(choices)):
        n, u = choices[k]
        if n > size:
            return
        for rest in _multisets(choices, size - n, most - 1, k):
            yield (u, *rest)


def order_of(u: Plain) -> int:
    """ρ(u)."""
    return 1 + sum(order_of(v) for v in u[1])


def density(u: Plain) -> int:
    """γ(u)."""
    result = order_of(u)
    for v in u[1]:
        result *= density(v)
    return result


def required(tableau: Tableau, u: Plain) -> fmpq:
    """What the elementary weight of a tree should be: the coefficient of the exact solution, in
    which a forest of order n at a vertex is the integral of t^n, as often as the vertex counts.
    """
    return _integral(tableau, u)[1]


def _integral(tableau: Tableau, u: Plain) -> tuple[int, fmpq]:
    kind = tableau.colours[u[0]].kind
    power, coefficient = 0, fmpq(1 if kind.is_exact else 0)
    for v in u[1]:
        order, factor = _integral(tableau, v)
        power += order
        coefficient *= factor
    for _ in range(kind.weight):
        power += 1
        coefficient /= power
    return power, coefficient


def plain(tree: Tree) -> Plain:
    """A tree of the engine as a pair."""
    return tree.root, tuple(plain(u) for u in tree.branches)


def same_tree(u: Plain, v: Plain) -> bool:
    """Whether two pairs are the same tree, in whatever order their branches are."""
    return _sorted(u) == _sorted(v)


def _sorted(u: Plain) -> Plain:
    return u[0], tuple(sorted(_sorted(v) for v in u[1]))


class Weights:
    """Elementary weights by eqs. (Ataul), (Au) and (bA), each stage vector computed once."""

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._products = [product(space) for space in tableau.spaces]
        self._images: dict[tuple[int, Plain], Vector] = {}

    def stage_vector(self, u: Plain) -> Vector:
        """𝒜^[u]."""
        rows = self.tableau.colours[u[0]].space
        result = one(self.tableau.spaces[rows])
        for v in u[1]:
            result = self._products[rows](result, self._branch(rows, v))
        return result

    def _branch(self, rows: int, v: Plain) -> Vector:
        key = (rows, v)
        if key not in self._images:
            self._images[key] = image(self.tableau.blocks[rows, v[0]], self.stage_vector(v))
        return self._images[key]

    def weight(self, u: Plain) -> Number:
        """bᵀ 𝒜^[u]."""
        return pairing(self.tableau.colours[u[0]].b, self.stage_vector(u))


def failing(tableau: Tableau, order: int) -> list[Plain]:
    """The trees of one order whose condition fails."""
    weights = Weights(tableau)
    trees = Trees(tableau).of_order(order)
    return [u for u in trees if weights.weight(u) != required(tableau, u)]


def brute_order(tableau: Tableau, limit: int) -> int:
    """The largest r ≤ ``limit`` for which the conditions of all admissible trees of order ≤ r
    hold.
    """
    trees, weights = Trees(tableau), Weights(tableau)
    for order in range(1, limit + 1):
        if any(weights.weight(u) != required(tableau, u) for u in trees.of_order(order)):
            return order - 1
    return limit
