"""The order of a method by a program of its own: rooted trees as nested tuples, elementary weights
by their recursion, fractions of Python. It knows nothing of gark.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from math import prod
from typing import TypeAlias

Tree: TypeAlias = "tuple[int, tuple[Tree, ...]]"
"""The colour of the root, and its branches in order."""
Row: TypeAlias = "Sequence[Fraction]"
BITS = 1500
"""Elementary weights are cut off after so many binary places."""


@cache
def trees(order: int, colours: int) -> tuple[Tree, ...]:
    """All N-trees with so many vertices.

    >>> [len(trees(n, 1)) for n in range(1, 9)]
    [1, 1, 2, 4, 9, 20, 48, 115]
    >>> [len(trees(n, 2)) for n in range(1, 5)]
    [2, 4, 14, 52]
    """
    forests = _forests(order - 1, order - 1, colours)
    return tuple((root, forest) for root in range(colours) for forest in forests)


@cache
def _forests(size: int, largest: int, colours: int) -> tuple[tuple[Tree, ...], ...]:
    """Multisets of trees with so many vertices in all, none larger than ``largest``."""
    if not size:
        return ((),)
    found = {
        tuple(sorted((tree, *rest)))
        for n in range(1, min(size, largest) + 1)
        for tree in trees(n, colours)
        for rest in _forests(size - n, n, colours)
    }
    return tuple(sorted(found))


def vertices(tree: Tree) -> int:
    return 1 + sum(map(vertices, tree[1]))


def density(tree: Tree) -> int:
    """γ(u)."""
    return vertices(tree) * prod(map(density, tree[1]))


class Method:
    """A method with its stage vectors.

    Args:
        A: a block for each pair of colours.
        b: weights for each colour.
    """

    def __init__(self, A: dict[tuple[int, int], Sequence[Row]], b: Sequence[Row]) -> None:
        self.A = {key: [list(map(_whole, row)) for row in block] for key, block in A.items()}
        self.b = [list(map(_whole, row)) for row in b]
        self._images: dict[tuple[int, Tree], list[int]] = {}

    def _vector(self, tree: Tree) -> list[int]:
        root, branches = tree
        vector = [1 << BITS] * len(self.b[root])
        for branch in branches:
            image = self._image(root, branch)
            vector = [x * y >> BITS for x, y in zip(vector, image, strict=True)]
        return vector

    def _image(self, l: int, branch: Tree) -> list[int]:
        if (l, branch) not in self._images:
            v, block = self._vector(branch), self.A[l, branch[0]]
            self._images[l, branch] = [
                sum(a * x for a, x in zip(row, v, strict=True)) >> BITS for row in block
            ]
        return self._images[l, branch]

    def residual(self, tree: Tree, weights: Sequence[Row] | None = None, share: int = 1) -> float:
        """The elementary weight less share/γ; of other weights than b where they are given."""
        b = self.b if weights is None else [list(map(_whole, row)) for row in weights]
        found = sum(x * y for x, y in zip(b[tree[0]], self._vector(tree), strict=True)) >> BITS
        return (found * density(tree) - (share << BITS)) / (density(tree) << BITS)

    def largest(self, order: int, weights: Sequence[Row] | None = None, share: int = 1) -> float:
        """The largest |residual| of all trees of an order, γ-fold."""
        known = [u for u in trees(order, len(self.b)) if self._exists(u)]
        return max(abs(self.residual(u, weights, share)) * density(u) for u in known)

    def _exists(self, tree: Tree) -> bool:
        """Whether there is a block for each edge."""
        root, branches = tree
        return all((root, u[0]) in self.A and self._exists(u) for u in branches)


def _whole(x: Fraction) -> int:
    """In units of 2^−BITS, rounded down."""
    return (x.numerator << BITS) // x.denominator


def conjugated(A: Sequence[Row], b: Row) -> list[list[Fraction]]:
    """â_ij = b_j − b_j a_ji / b_i, of the symplectic conjugate."""
    stages = range(len(b))
    return [[b[j] - b[j] * A[j][i] / b[i] for j in stages] for i in stages]


def adjoint(A: Sequence[Row], b: Row) -> list[list[Fraction]]:
    """b_j − a_ij, of the adjoint, stages in their order."""
    return [[y - x for x, y in zip(row, b, strict=True)] for row in A]
