"""Lists the trees of one order: few of them one by one, many from blocks of the tree table."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cache

from garkcli.ntrees.count import Admissible, Colours, counts_of
from garkcli.ntrees.kind import SEVERAL
from garkcli.ntrees.tree import Tree

FEW = 20_000
"""The largest number of trees that are made one by one: before that numpy is not yet imported."""
BLOCK_SIZE = 1 << 14


def trees_of(
    admissible: Admissible, order: int, roots: Collection[int] | None = None
) -> Iterator[Tree]:
    """The trees of an order as in the tree table; ``roots`` are root colours, from 0.

    >>> [u.density for u in trees_of(Admissible.of(1), 4)]
    [4, 8, 12, 24]
    """
    chosen = [l for l in range(admissible.colours) if roots is None or l in roots]
    counts = counts_of(admissible, order)
    if sum(counts) <= FEW:
        yield from listed(admissible, order, chosen)
        return
    from garkcli.ntrees.blocks import blocks_of  # numpy is paid for here

    for block in blocks_of(admissible, order, BLOCK_SIZE, chosen):
        yield from block.trees()


def listed(admissible: Admissible, order: int, roots: Collection[int]) -> Iterator[Tree]:
    @cache
    def trees(root: int, n: int) -> list[Tree]:
        kind = admissible.kinds[root]
        branches = admissible.branches[root]
        if SEVERAL in kind.arity:
            grown = forests(branches, n - kind.weight)
        else:
            grown = single(branches, n - kind.weight)
        found = [admissible.tree(root, some) for some in grown if kind.allows(len(some))]
        return sorted(found, key=Tree.sort_key)

    @cache
    def single(branches: Colours, total: int) -> list[tuple[Tree, ...]]:
        if total < 1:
            return [()] if total == 0 else []
        return [(u,) for root in branches for u in trees(root, total)]

    @cache
    def forests(branches: Colours, total: int) -> list[tuple[Tree, ...]]:
        """Forests by their last tree, the largest one."""
        if total == 0:
            return [()]
        return [
            (*rest, *last)
            for n in range(1, total + 1)
            for last in single(branches, n)
            for rest in forests(branches, total - n)
            if not rest or rest[-1].sort_key() <= last[0].sort_key()
        ]

    for root in roots:
        yield from trees(root, order)
