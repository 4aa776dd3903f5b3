"""The elementary weights b_l^T 𝒜^[u] of all trees of a table, in floating point."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from garkcli.arrays import Floats
    from garkcli.trees.columns import Segment
    from garkcli.trees.table import TreeTable

Blocks: TypeAlias = "Mapping[tuple[int, int], Floats]"
"""Matrices by stage space and colour."""
CHUNK = 1 << 16
"""Trees whose stage vectors are gathered at once: bounds the memory of the highest order."""


def elementary_weights(
    table: TreeTable, rows: Sequence[int], blocks: Blocks, weights: Sequence[Floats]
) -> Floats:
    """b_l^T 𝒜^[u] for every tree u of the table, in the order of its ids (the paper's eqs. Au and
    bA).

    ``rows[l]`` is the stage space of colour l (two colours may share one), ``weights[l]`` the
    vector b_l of shape (s,) with s the dimension of that space, and ``blocks[space, m]`` the matrix
    A of shape (s_space, s_rows[m]) that a vertex whose colour has that space applies to a branch of
    colour m. The stage vectors of the highest order are never held together. Raises ``ValueError``
    when a block that the table's trees need is missing or has the wrong shape.

    >>> from garkcli.trees.table import TreeTable
    >>> midpoint = {(0, 0): np.array([[0.5]])}
    >>> elementary_weights(TreeTable.upto(1, 3), [0], midpoint, [np.array([1.0])])
    array([1.  , 0.5 , 0.25, 0.25])
    """
    _check(table, rows, blocks, weights)
    return _Evaluation(table, rows, blocks, weights).run()


def _check(
    table: TreeTable, rows: Sequence[int], blocks: Blocks, weights: Sequence[Floats]
) -> None:
    if not len(rows) == len(weights) == table.colours:
        raise ValueError(
            f"a table of {table.colours} colours needs as many stage spaces and weights"
        )
    for l, branches in enumerate(table.admissible.branches):
        b = weights[l]
        space = rows[l]
        first = weights[rows.index(space)]
        if b.shape != first.shape or b.ndim != 1:
            raise ValueError(f"the weights of colour {l} do not fit its stage space {space}")
        if table.max_order == 1:
            continue  # no branches, no blocks
        for m in branches:
            which = f"stage space {space} and colour {m}"
            block = blocks.get((space, m))
            if block is None:
                raise ValueError(f"no block for {which}; give the table edges without it")
            shape = len(b), len(weights[m])
            if block.shape != shape:
                found = f"has shape {block.shape}, not {shape}"
                raise ValueError(f"the block of {which} {found}")


class _Evaluation:
    """𝒜^[u] = 𝒜^[stem] ⊙ (A 𝒜^[branch]), one gathered product for each segment of the table.

    ``vectors[n, l]``: 𝒜^[u] of the trees of order n with root colour l, one row each, in the order
    of ids; ``applied[space, n, m]``: A 𝒜^[u] for those with root colour m, as a branch in that
    stage space.
    """

    def __init__(
        self, table: TreeTable, rows: Sequence[int], blocks: Blocks, weights: Sequence[Floats]
    ) -> None:
        self.table = table
        self.rows = rows
        self.blocks = blocks
        self.weights = weights
        self.vectors: dict[tuple[int, int], Floats] = {}
        self.applied: dict[tuple[int, int, int], Floats] = {}
        matrices = blocks.values()
        self.dtype = np.result_type(float, *weights, *matrices)
        self.values = np.empty(len(table), self.dtype)

    def run(self) -> Floats:
        for colour, b in enumerate(self.weights):
            ones = np.ones((1, len(b)), self.dtype)
            self.vectors[1, colour] = ones
            self.values[colour] = b.sum()
        for order in range(2, self.table.max_order + 1):
            self._apply(order - 1)
            last = order == self.table.max_order
            if not last:
                for colour, b in enumerate(self.weights):
                    ids = self.table.ids(order, colour)
                    shape = len(ids), len(b)
                    vectors = np.empty(shape, self.dtype)
                    self.vectors[order, colour] = vectors
            for segment in self.table.segments:
                if segment.order == order:
                    self._evaluate(segment, keep=not last)
        return self.values

    def _apply(self, order: int) -> None:
        """Apply every block that is needed to the vectors of the trees of one order."""
        for colour, branches in enumerate(self.table.admissible.branches):
            space = self.rows[colour]
            for m in branches:
                key = space, order, m
                if key not in self.applied:
                    A = self.blocks[space, m]
                    vectors = self.vectors[order, m]
                    self.applied[key] = vectors @ A.T

    def _evaluate(self, segment: Segment, keep: bool) -> None:
        """Values, and if wanted the vectors, of the trees of a segment."""
        table = self.table
        root = segment.root
        space = self.rows[root]
        b = self.weights[root]
        stem_order = segment.order - segment.branch_order
        stems = self.vectors[stem_order, root]
        branches = self.applied[space, segment.branch_order, segment.branch_root]
        first_stem = segment.stems.start
        first_branch = segment.branches.start
        ids = segment.ids
        first = table.ids(segment.order, root).start
        for start in range(ids.start, ids.stop, CHUNK):
            stop = min(start + CHUNK, ids.stop)
            here = slice(start, stop)
            product = stems[table.stem[here] - first_stem]
            product *= branches[table.branch[here] - first_branch]
            self.values[here] = product @ b
            if keep:
                vectors = self.vectors[segment.order, root]
                vectors[start - first : stop - first] = product
