"""Stage vectors 𝒜^[u] of all trees of a table; elementary weights in floats."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from garkcli import numpy_on_use as np

if TYPE_CHECKING:
    from garkcli.arrays import Floats
    from garkcli.ntrees.count import Admissible
    from garkcli.ntrees.table import Column, Segment, TreeTable


Vectors = TypeVar("Vectors")
CHUNK = 1 << 16
"""Trees whose stage vectors are gathered at once, which bounds the memory."""


class StageVectors(ABC, Generic[Vectors]):
    """𝒜^[u] = 𝒜^[stem] ⊙ (A 𝒜^[branch]) of several trees by ids, one product a segment.
    Tables of different orders share vectors, and so do colours with the same stages and branches.
    """

    def __init__(self, admissible: Admissible, rows: Sequence[int]) -> None:
        self.rows = rows
        self._natures = [
            (space, admissible.branches[l], admissible.kinds[l]) for l, space in enumerate(rows)
        ]
        self._vectors: dict[tuple[int, object, bool], Vectors] = {}
        self._images: dict[tuple[int, int, int], Vectors] = {}

    def everything(self, table: TreeTable) -> Iterator[tuple[int, slice, Vectors]]:
        """Root colour, ids and stage vectors of all trees, the highest order in pieces."""
        highest = table.max_order
        kinds = table.admissible.kinds
        for order in range(1, highest + 1):
            for l in range(table.colours):
                ids = table.ids(order, l)
                if ids and (order < highest or order == kinds[l].weight):
                    yield l, slice(ids.start, ids.stop), self.of(table, order, l)
        for segment in table.segments:
            if segment.order == highest:
                for here, vectors in self._pieces(table, segment):
                    yield segment.root, here, vectors

    def of(self, table: TreeTable, order: int, l: int) -> Vectors:
        return self._some(table, order, l, is_bare=False)

    def _some(self, table: TreeTable, order: int, l: int, is_bare: bool) -> Vectors:
        key = order, self._natures[l], is_bare
        if key not in self._vectors:
            kind = table.admissible.kinds[l]
            arity = kind.stems if is_bare else kind.arity
            parts = [self._vertex(l)] if order == kind.weight and 0 in arity else []
            for segment in table.bare if is_bare else table.segments:
                if segment.order == order and segment.root == l:
                    parts += [vectors for _, vectors in self._pieces(table, segment)]
            self._vectors[key] = parts[0] if len(parts) == 1 else self._joined(parts)
        return self._vectors[key]

    def branches(self, table: TreeTable, segment: Segment) -> Vectors:
        space, m = self.rows[segment.root], segment.branch_root
        key = space, segment.branch_order, m
        if key not in self._images:
            self._images[key] = self._image(space, m, self.of(table, segment.branch_order, m))
        return self._images[key]

    def stems(self, table: TreeTable, segment: Segment) -> Vectors:
        order, root = segment.order - segment.branch_order, segment.root
        is_bare = segment.stems.start not in table.ids(order, root)
        return self._some(table, order, root, is_bare)

    def _pieces(self, table: TreeTable, segment: Segment) -> Iterator[tuple[slice, Vectors]]:
        space, ids = self.rows[segment.root], segment.ids
        stems, branches = self.stems(table, segment), self.branches(table, segment)
        for start in range(ids.start, ids.stop, CHUNK):
            here = slice(start, min(start + CHUNK, ids.stop))
            left = self._part(stems, table.stem[here] - segment.stems.start)
            right = self._part(branches, table.branch[here] - segment.branches.start)
            yield here, self._product(space, left, right)

    def _part(self, vectors: Any, places: Column) -> Vectors:
        part: Vectors = vectors[places]
        return part

    @abstractmethod
    def _vertex(self, l: int) -> Vectors:
        """𝟙, for the single vertex of colour l."""

    @abstractmethod
    def _image(self, space: int, m: int, vectors: Vectors) -> Vectors:
        """A 𝒜^[u], with the block A of a stage space and a colour."""

    @abstractmethod
    def _product(self, space: int, stems: Vectors, branches: Vectors) -> Vectors:
        """The products of two vectors each, in place if possible."""

    @abstractmethod
    def _joined(self, parts: list[Vectors]) -> Vectors:
        """The concatenation of some vectors."""


Blocks: TypeAlias = "Mapping[tuple[int, int], Floats]"


def elementary_weights(
    table: TreeTable, rows: Sequence[int], blocks: Blocks, weights: Sequence[Floats]
) -> Floats:
    """b_l^T 𝒜^[u] for every tree u of the table, in the order of its ids (the paper's eqs. Au, bA).

    ``rows[l]`` is the stage space of colour l, ``weights[l]`` of shape (s,) the vector b_l, and
    ``blocks[space, m]`` the matrix A of shape (s_space, s_rows[m]) for branches of colour m. Raises
    ``ValueError`` if a block that the trees need is missing or has the wrong shape.

    >>> from garkcli.ntrees.table import TreeTable
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
        message = f"a table of {table.colours} colours needs as many stage spaces and weights"
        raise ValueError(message)
    for l, branches in enumerate(table.admissible.branches):
        b = weights[l]
        space = rows[l]
        if b.shape != weights[rows.index(space)].shape or b.ndim != 1:
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
                fault = f"has shape {block.shape}, not {shape}"
                raise ValueError(f"the block of {which} {fault}")


class _FloatVectors(StageVectors["Floats"]):
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
