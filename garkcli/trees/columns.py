"""The columns of the tree table and how they grow: all N-trees of an order from two smaller ones
each.

Every tree with two vertices or more is uniquely u = stem ∘ branch: the branch is the last one of
the root, the one with the largest id. For a given stem the admissible branches of one order and
root colour are a contiguous range of ids, so that a whole order is made with ``repeat`` and
``arange``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

Column: TypeAlias = "np.ndarray[tuple[int], np.dtype[Any]]"

LAST_INT64_ORDER = 20
"""γ ≤ n! and σ ≤ (n - 1)!, and 20! < 2⁶³ < 21!; beyond, the columns σ and γ hold Python
integers.
"""


def exact_dtype(order: int) -> DTypeLike:
    """The type of the columns σ and γ of trees up to an order: one that cannot overflow."""
    return np.int64 if order <= LAST_INT64_ORDER else np.dtype(object)


@dataclass(frozen=True, slots=True)
class Columns:
    """Trees as columns of equal length, one entry a tree.

    ``stem``, ``branch``: the ids of the two parents, -1 for a single vertex; ``root``: the root
    colour, from 0; ``order``: ρ(u); ``multiplicity``: how often the last branch occurs at the root
    (0 for a single vertex); ``sigma``: the symmetry σ(u); ``gamma``: the density γ(u). σ and γ are
    exact: int64 up to order 20, Python integers beyond.
    """

    stem: Column
    branch: Column
    root: Column
    order: Column
    multiplicity: Column
    sigma: Column
    gamma: Column

    @classmethod
    def empty(cls, length: int, exact: DTypeLike) -> Columns:
        """Columns to be filled; ``exact`` is the type of σ and γ."""
        ids = [np.empty(length, np.int64) for _ in range(2)]
        small = [np.empty(length, np.int16) for _ in range(3)]
        return cls(*ids, *small, *[np.empty(length, exact) for _ in range(2)])

    @classmethod
    def vertices(cls, roots: range) -> Columns:
        """The trees of order 1 with these root colours."""
        made = cls.empty(len(roots), np.int64)
        made.stem[:] = -1
        made.branch[:] = -1
        made.root[:] = roots
        made.multiplicity[:] = 0
        made.order[:] = 1
        made.sigma[:] = 1
        made.gamma[:] = 1
        return made

    def __len__(self) -> int:
        return len(self.stem)

    def all(self) -> tuple[Column, ...]:
        """The seven columns, in the order of the fields."""
        return (
            self.stem,
            self.branch,
            self.root,
            self.order,
            self.multiplicity,
            self.sigma,
            self.gamma,
        )

    def part(self, which: slice | Column) -> Columns:
        """The trees of a slice, a mask or an array of positions."""
        return Columns(*[column[which] for column in self.all()])

    def write(self, start: int, trees: Columns) -> None:
        """Put trees at position ``start`` and following."""
        stop = start + len(trees)
        for column, values in zip(self.all(), trees.all(), strict=True):
            column[start:stop] = values

    def freeze(self) -> Columns:
        """Make the columns read-only."""
        for column in self.all():
            column.flags.writeable = False
        return self


@dataclass(frozen=True, slots=True)
class Segment:
    """The trees of one order and root colour whose last branch has one order and root colour.

    They follow each other in the table at ``ids``; ``stems`` and ``branches`` are the ranges of ids
    that the parents come from.
    """

    order: int
    root: int
    branch_order: int
    branch_root: int
    ids: range
    stems: range
    branches: range


class Growth:
    """The trees of one segment to be, counted at once and made in pieces as large as asked for.

    ``lower``: the columns of all trees of lower order, at least; ``stems``, ``branches``: the ids
    of the possible parents, of one order and root colour each.
    """

    def __init__(self, lower: Columns, order: int, stems: range, branches: range) -> None:
        self.lower = lower
        self.order = order
        self.stems = stems
        self._last = lower.branch[stems.start : stems.stop]
        self._begin = np.maximum(self._last, branches.start)
        self._count = np.maximum(branches.stop - self._begin, 0)
        self._end = np.cumsum(self._count)

    def __len__(self) -> int:
        if not len(self._end):
            return 0
        return int(self._end[-1])

    def make(self, start: int, stop: int) -> Columns:
        """The trees at positions start, …, stop - 1 of the segment, with 0 ≤ start < stop ≤ len."""
        lower = self.lower
        order = self.order
        length = stop - start
        first = np.searchsorted(self._end, start, side="right")
        last = np.searchsorted(self._end, stop, side="left")
        i = int(first)
        j = int(last) + 1
        begin = self._begin[i:j].copy()
        count = self._count[i:j].copy()
        # the first and the last stem may have trees outside of the piece
        first_end = int(self._end[i] - self._count[i])
        skipped = start - first_end
        left_over = int(self._end[j - 1]) - stop
        begin[0] += skipped
        count[0] -= skipped
        count[-1] -= left_over
        heads = np.cumsum(count) - count

        first_stem = self.stems.start
        stems = slice(first_stem + i, first_stem + j)
        branch = np.repeat(begin - heads, count)
        branch += np.arange(length)
        # where the branch is the stem's last one once more
        is_again = begin == self._last[i:j]
        again = np.flatnonzero(is_again & (count > 0))
        repeated = heads[again]
        exact = exact_dtype(order)
        multiplicity = np.ones(length, np.int16)
        multiplicity[repeated] += lower.multiplicity[stems][again]
        sigma = np.repeat(lower.sigma[stems].astype(exact, copy=False), count) * lower.sigma[branch]
        sigma[repeated] *= multiplicity[repeated]
        # γ of the stem with the order of the new tree in the place of its own
        stem_order = int(lower.order[stems.start])
        with_order = lower.gamma[stems].astype(exact, copy=False) // stem_order * order
        gamma = np.repeat(with_order, count) * lower.gamma[branch]
        stem_ids = np.arange(stems.start, stems.stop)
        root = lower.root[stems.start]
        return Columns(
            stem=np.repeat(stem_ids, count),
            branch=branch,
            root=np.full(length, root, np.int16),
            order=np.full(length, order, np.int16),
            multiplicity=multiplicity,
            sigma=sigma,
            gamma=gamma,
        )
