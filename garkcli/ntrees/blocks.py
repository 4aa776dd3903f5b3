"""Streams the trees of one order in blocks of bounded size, or only those with given colours."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from garkcli import numpy_on_use as np
from garkcli.frozen import Frozen
from garkcli.ntrees.count import Admissible, Edges
from garkcli.ntrees.table import Column, Columns, Places, TreeTable, segments_of
from garkcli.ntrees.tree import Tree

BLOCK_SIZE = 1 << 18

MAX_USING = 62
"""Most colours that can be requested at once: one bit each."""


class Block(Frozen):
    """Some trees of one order; their parents' ids are those of ``lower``, the table below it."""

    columns: Columns
    lower: TreeTable

    def __len__(self) -> int:
        return len(self.columns)

    def notation(self, colours: bool = True) -> list[str]:
        return self.lower.texts(self.columns, colours)

    def trees(self) -> Iterator[Tree]:
        tree = self.lower.admissible.tree
        stems = self.columns.stem.tolist()
        branches = self.columns.branch.tolist()
        for stem, branch, root in zip(stems, branches, self.columns.root.tolist(), strict=True):
            if branch < 0:
                yield tree(root)
                continue
            yield tree(root, [*self.lower.tree(stem).branches, self.lower.tree(branch)])


def iter_blocks(
    colours: int,
    order: int,
    block_size: int = BLOCK_SIZE,
    edges: Edges | None = None,
    linear: Collection[int] = (),
    roots: Collection[int] | None = None,
) -> Iterator[Block]:
    """All trees of one order, in the order of the table, in blocks of at most ``block_size`` trees.

    Only lower orders are in memory. ``roots`` are root colours, from 0; ``edges`` and ``linear`` as
    in :class:`Admissible`. Raises :class:`TableTooLarge` if the lower orders are too many.

    >>> sum(len(block) for block in iter_blocks(2, 5))
    214
    """
    return blocks_of(Admissible.of(colours, edges, linear), order, block_size, roots)


def blocks_of(
    admissible: Admissible,
    order: int,
    block_size: int = BLOCK_SIZE,
    roots: Collection[int] | None = None,
) -> Iterator[Block]:
    if block_size < 1:
        raise ValueError(f"a block holds at least one tree, not {block_size}")
    wanted = [root for root in range(admissible.colours) if roots is None or root in roots]
    lower = TreeTable.of(admissible, max(order - 1, 1))
    places = Places.of(admissible, order)
    for root in wanted:
        kind = admissible.kinds[root]
        if order == kind.weight and kind.allows(0):
            yield Block(Columns.vertex(root, kind), lower)
        for _, growth in segments_of(admissible, places, order, lower.columns, root):
            size = len(growth)
            for start in range(0, size, block_size):
                yield Block(growth.make(start, min(start + block_size, size)), lower)


def select(
    colours: int,
    order: int,
    *,
    root: int | None = None,
    only: Collection[int] | None = None,
    using: Collection[int] = (),
    block_size: int = BLOCK_SIZE,
    edges: Edges | None = None,
    linear: Collection[int] = (),
) -> Iterator[Block]:
    """The trees of one order with a given root colour, or with given colours; colours count from 0.

    ``only``: no vertex has another colour; ``using``: each of these occurs. Blocks are never empty.
    Raises ``ValueError`` for a colour that does not exist, else as :func:`iter_blocks`.

    >>> [u for block in select(2, 3, root=0, using=[1]) for u in block.notation()]
    ['[[]_1,[]_2]_1', '[[]_2,[]_2]_1', '[[[]_2]_1]_1', '[[[]_1]_2]_1', '[[[]_2]_2]_1']
    """
    named = {*(only or ()), *using}
    if root is not None:
        named.add(root)
    for colour in named:
        if not 0 <= colour < colours:
            raise ValueError(f"there is no colour {colour} among the {colours} colours 0, 1, …")
    within = set(range(colours))
    if only is not None:
        within = set(only)
    roots = within
    if root is not None:
        roots = within & {root}
    narrowed = [[False] * colours for _ in range(colours)]
    for above in within:
        for m in within:
            if edges is None or edges[above][m]:
                narrowed[above][m] = True
    wanted = sorted(set(using))
    if len(wanted) > min(order, MAX_USING):
        return  # more colours than vertices, or than any tree that can be listed has
    bits = np.zeros(colours, np.int64)
    bits[wanted] = 1 << np.arange(len(wanted))
    # for every tree of the lower orders which of the colours occur
    used: Column | None = None
    for block in iter_blocks(colours, order, block_size, narrowed, linear, roots):
        if used is None:
            used = _used_by_all(block.lower, bits)
        keep = _used(block.columns, bits, used) == bits.sum()
        if keep.all():
            yield block
        elif keep.any():
            yield Block(block.columns.part(keep), block.lower)


def _used(trees: Columns, bits: Column, known: Column) -> Column:
    """A bit for each colour that occurs; ``known`` has the bits of the parents."""
    is_vertex = trees.branch < 0
    return np.where(is_vertex, bits[trees.root], known[trees.stem] | known[trees.branch])


def _used_by_all(table: TreeTable, bits: Column) -> Column:
    used = np.zeros(len(table), np.int64)
    for order in range(1, table.max_order + 1):
        ids = np.flatnonzero(table.order == order)
        used[ids] = _used(table.columns.part(ids), bits, used)
    return used
