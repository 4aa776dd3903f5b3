"""The elementary weights b_l^T 𝒜^[u] of all trees of a table, in floating point."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from garkcli.trees.stage_vectors import StageVectors

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from garkcli.arrays import Floats
    from garkcli.trees.table import TreeTable

Blocks: TypeAlias = "Mapping[tuple[int, int], Floats]"
"""Matrices by stage space and colour."""


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
    vectors = _FloatVectors(table, rows, blocks, weights)
    values = np.empty(len(table), vectors.dtype)
    for l, ids, some in vectors.everything(table):
        values[ids] = some @ weights[l]
    return values


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


class _FloatVectors(StageVectors["Floats"]):
    """One row a tree."""

    def __init__(
        self, table: TreeTable, rows: Sequence[int], blocks: Blocks, weights: Sequence[Floats]
    ) -> None:
        super().__init__(table.admissible, rows)
        self.blocks = blocks
        self.weights = weights
        self.dtype = np.result_type(float, *weights, *blocks.values())

    def _vertex(self, l: int) -> Floats:
        return np.ones((1, len(self.weights[l])), self.dtype)

    def _image(self, space: int, m: int, vectors: Floats) -> Floats:
        return vectors @ self.blocks[space, m].T

    def _product(self, space: int, stems: Floats, branches: Floats) -> Floats:  # noqa: ARG002
        stems *= branches
        return stems

    def _joined(self, parts: list[Floats]) -> Floats:
        return np.concatenate(parts)
