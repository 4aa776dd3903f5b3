"""All trees of ẏ = f(y, z), 0 = g(y, z), with fractions alone: the orders in y and z by the
definition of Hairer and Wanner, *Solving Ordinary Differential Equations II*, section VI.4.

A tree is ("y", branches) or ("z", branches). A vertex y counts one order and has any branches; a
vertex z counts none, and has branches other than one z alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from math import prod
from typing import Any, TypeAlias

Tree: TypeAlias = tuple[str, tuple[Any, ...]]
Row: TypeAlias = list[Fraction]
Rows: TypeAlias = Sequence[Sequence[Fraction]]


@cache
def trees(root: str, order: int) -> tuple[Tree, ...]:
    """All of an order with a root."""
    return tuple((root, x) for x in _forests(root, order - (root == "y")))


def _forests(root: str, order: int) -> Iterator[tuple[Tree, ...]]:
    if root == "y":
        yield from _multisets(order, order)
        return
    yield from ((u,) for u in trees("y", order))
    yield from _multisets(order, order - 1)


def _multisets(order: int, largest: int, last: int = 0) -> Iterator[tuple[Tree, ...]]:
    """Trees of orders that sum to ``order``, each no larger than ``largest``; of those of that
    order the ones from number ``last`` on.
    """
    if order == 0:
        yield ()
        return
    for n in range(min(order, largest), 0, -1):
        some = [*trees("y", n), *trees("z", n)]
        for i in range(last if n == largest else 0, len(some)):
            for rest in _multisets(order - n, n, i):
                yield (some[i], *rest)


def order_of(u: Tree) -> int:
    return (u[0] == "y") + sum(map(order_of, u[1]))


def density(u: Tree) -> int:
    return (order_of(u) if u[0] == "y" else 1) * prod(map(density, u[1]))


def weights(alpha: Rows, gamma: Rows) -> Any:
    """Φ of a tree, a row of stages."""
    stages = range(len(alpha))
    beta = [[x + y for x, y in zip(*rows, strict=True)] for rows in zip(alpha, gamma, strict=True)]

    def times(A: Rows, v: Row) -> Row:
        return [sum((a * x for a, x in zip(row, v, strict=True)), Fraction(0)) for row in A]

    def solved(v: Row) -> Row:
        """β⁻¹ v; β is lower triangular."""
        found: Row = []
        for i in stages:
            known = sum((beta[i][j] * found[j] for j in range(i)), Fraction(0))
            found.append((v[i] - known) / beta[i][i])
        return found

    @cache
    def phi(u: Tree) -> Row:
        root, branches = u
        if root == "z" and len(branches) == 1:
            return phi(branches[0])
        seen = beta if len(branches) == 1 else alpha
        rows = [times(seen, phi(v)) for v in branches]
        found = [prod((row[i] for row in rows), start=Fraction(1)) for i in stages]
        return solved(found) if root == "z" else found

    return phi


def orders(alpha: Rows, gamma: Rows, b: Sequence[Fraction], limit: int) -> tuple[int, int]:
    """In y and in z."""
    phi = weights(alpha, gamma)

    def holds(root: str, order: int) -> bool:
        return all(
            sum(w * x for w, x in zip(b, phi(u), strict=True)) == Fraction(1, density(u))
            for u in trees(root, order)
        )

    y, z = (
        next((n for n in range(1, limit + 1) if not holds(root, n)), limit + 1) - 1 for root in "yz"
    )
    return y, z
