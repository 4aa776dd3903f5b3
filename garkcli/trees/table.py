"""The tree table: all N-trees up to an order as integer columns; an N-tree is the ids of two
smaller ones.

>>> table = TreeTable.upto(1, 4)
>>> table.notation(range(len(table)), colours=False)
['[]', '[[]]', '[[],[]]', '[[[]]]', '[[],[],[]]', '[[[]],[]]', '[[[],[]]]', '[[[[]]]]']
>>> table.gamma.tolist(), table.sigma.tolist()
([1, 2, 3, 6, 4, 8, 12, 24], [1, 1, 2, 1, 6, 1, 2, 1])
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from garkcli.errors import UsageProblem, counted
from garkcli.trees.columns import Columns, Growth, Segment, exact_dtype
from garkcli.trees.count import Admissible, Edges, counts_upto
from garkcli.trees.tree import Tree

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from garkcli.trees.columns import Column


Inside = tuple[str, int, int]
"""The text between a root's brackets, the offset where its largest branches end, and their
order.
"""
_VERTEX: Inside = ("", 0, 0)


class Texts:
    """Makes text of trees and remembers the text of every tree that was a parent.

    ``columns`` are the trees of the table, ``colours`` whether colours are written.
    """

    def __init__(self, columns: Columns, colours: bool) -> None:
        self.columns = columns
        self.colours = colours
        self._insides: dict[int, Inside] = {}

    def of(self, trees: Columns) -> list[str]:
        """The text of trees whose parents are in the table, as ``format_tree`` writes it."""
        parents = np.concatenate([trees.stem, trees.branch])
        self._remember(parents[parents >= 0])
        insides = self._of_children(trees)
        roots = trees.root.tolist()
        texts = []
        for made, root in zip(insides, roots, strict=True):
            inside, _, _ = made
            texts.append(self._closed(inside, root))
        return texts

    def _remember(self, ids: Column) -> None:
        """Make the insides of these trees and of all their ancestors, the smaller first."""
        columns = self.columns
        wanted = generation = np.unique(ids)
        while len(generation):
            parents = np.concatenate([columns.stem[generation], columns.branch[generation]])
            generation = np.unique(parents[parents >= 0])
            wanted = np.union1d(wanted, generation)
        known = self._insides
        missing = np.array([u for u in wanted.tolist() if u not in known], np.int64)
        orders = columns.order[missing]
        for order in np.unique(orders):
            ids = missing[orders == order]
            named = zip(ids.tolist(), self._of_children(columns.part(ids)), strict=True)
            self._insides.update(named)

    def _of_children(self, trees: Columns) -> list[Inside]:
        """The insides of trees whose parents' insides are known."""
        insides = self._insides
        root = self.columns.root
        order = self.columns.order
        stems = trees.stem.tolist()
        branches = trees.branch.tolist()
        made = []
        for stem, branch in zip(stems, branches, strict=True):
            if branch < 0:
                made.append(_VERTEX)
                continue
            inside, _, _ = insides[branch]
            text = self._closed(inside, int(root[branch]))
            size = int(order[branch])
            made.append(_inserted(insides[stem], text, size))
        return made

    def _closed(self, inside: str, root: int) -> str:
        if not self.colours:
            return f"[{inside}]"
        return f"[{inside}]_{root + 1}"


def _inserted(stem: Inside, text: str, order: int) -> Inside:
    """Put a branch where it is written: before all smaller ones, after those of its own order.

    A last branch is never smaller than the others, so that there are these two cases only.
    """
    inside, end, largest = stem
    length = len(text)
    if not inside:
        return text, length, order
    if order > largest:
        return f"{text},{inside}", length, order
    larger = inside[:end]
    smaller = inside[end:]
    return f"{larger},{text}{smaller}", end + 1 + length, largest


MAX_TREES = 40_000_000
"""The largest table that is made, in trees: some 35 bytes each."""
MOST_KEPT = 10_000
"""Most branches of a table that are kept as :class:`Tree`."""


class TableTooLarge(UsageProblem):
    """More trees were asked for than are ever held in memory at once."""

    code = "too-many"


@dataclass(frozen=True)
class TreeTable:
    """All admissible N-trees of order 1, …, ``max_order``, sorted by order, root colour and last
    branch.

    A tree's id is its position. The ids of one order and root colour are contiguous: :meth:`ids`.
    The order of ids is the order of :class:`Tree`. The columns are read-only arrays; see
    :class:`Columns`.
    """

    admissible: Admissible
    max_order: int
    columns: Columns
    # [order - 1][root]: the first id; one more entry for the end
    starts: tuple[tuple[int, ...], ...]
    segments: tuple[Segment, ...]
    _texts: dict[bool, Texts] = field(default_factory=dict, repr=False, compare=False)

    # those that are branches of trees asked for, up to MOST_KEPT
    _branches: dict[int, Tree] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def upto(
        cls, colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()
    ) -> TreeTable:
        """Generate the table; ``edges`` and ``linear`` as in :class:`Admissible`.

        Raises :class:`TableTooLarge` beyond ``MAX_TREES`` trees: :func:`iter_blocks` goes one order
        further in bounded memory, and :mod:`garkcli.trees.count` counts any order.
        """
        return cls.of(Admissible.of(colours, edges, linear), order)

    @classmethod
    def of(cls, admissible: Admissible, order: int) -> TreeTable:
        """Generate the table of the trees meant by ``admissible``."""
        starts = first_ids(admissible, order)
        size = starts[-1][-1]
        if size > MAX_TREES:
            raise _too_large(size, admissible.colours, order)
        columns = Columns.empty(size, exact_dtype(order))
        columns.write(0, Columns.vertices(range(admissible.colours)))
        segments: list[Segment] = []
        for n in range(2, order + 1):
            segments += _fill(columns, admissible, starts, n)
        return cls(admissible, order, columns.freeze(), starts, tuple(segments))

    def __len__(self) -> int:
        return len(self.columns)

    @property
    def colours(self) -> int:
        """The number N of colours."""
        return self.admissible.colours

    @property
    def stem(self) -> Column:
        """The id of the tree without its last branch; -1 for a single vertex."""
        return self.columns.stem

    @property
    def branch(self) -> Column:
        """The id of the last branch; -1 for a single vertex."""
        return self.columns.branch

    @property
    def root(self) -> Column:
        """The root colour, from 0."""
        return self.columns.root

    @property
    def order(self) -> Column:
        """ρ(u), the number of vertices."""
        return self.columns.order

    @property
    def multiplicity(self) -> Column:
        """How often the last branch occurs at the root."""
        return self.columns.multiplicity

    @property
    def sigma(self) -> Column:
        """The symmetry σ(u), exact."""
        return self.columns.sigma

    @property
    def gamma(self) -> Column:
        """The density γ(u), exact."""
        return self.columns.gamma

    def ids(self, order: int, root: int | None = None) -> range:
        """The ids of the trees of one order, all of them or those with one root colour (from 0)."""
        starts = self.starts[order - 1]
        if root is None:
            return range(starts[0], starts[-1])
        return range(starts[root], starts[root + 1])

    def tree(self, tree_id: int) -> Tree:
        """The tree with an id; raises ``IndexError`` when there is none."""
        if not 0 <= tree_id < len(self):
            raise IndexError(f"no tree {tree_id} in a table of {len(self)} trees")
        stem = self.columns.stem
        branch = self.columns.branch
        branches = []
        u = tree_id
        while (last := int(branch[u])) >= 0:
            branches.append(self._branch_tree(last))
            u = int(stem[u])
        return Tree(int(self.columns.root[u]), branches)

    def _branch_tree(self, tree_id: int) -> Tree:
        """The tree with an id; one that many trees have as a branch is made once."""
        known = self._branches.get(tree_id)
        if known is None:
            known = self.tree(tree_id)
            if len(self._branches) < MOST_KEPT:
                self._branches[tree_id] = known
        return known

    def notation(self, ids: Iterable[int] | Column, colours: bool = True) -> list[str]:
        """Bracket text of many trees, the same as ``format_tree``, built from the texts of their
        parents.
        """
        which = ids
        if not isinstance(which, np.ndarray):
            which = np.fromiter(which, np.int64)
        return self.texts(self.columns.part(which), colours)

    def texts(self, trees: Columns, colours: bool = True) -> list[str]:
        """Bracket text of trees whose parents are in this table, such as those of a block."""
        if colours not in self._texts:
            self._texts[colours] = Texts(self.columns, colours)
        return self._texts[colours].of(trees)


def _too_large(size: int, colours: int, order: int) -> TableTooLarge:
    about = str(size)
    if size >= 10**15:
        # log10(2) = 0.30103 rounded down: "more than" stays true
        decades = (size.bit_length() - 1) * 0.30102
        about = f"more than 10^{int(decades)}"
    which = f"of order up to {order} with {counted(colours, 'colour')}"
    return TableTooLarge(
        f"{about} trees {which} (limit {MAX_TREES})",
        "ask for a lower order, or count them without generating",
    )


def first_ids(admissible: Admissible, order: int) -> tuple[tuple[int, ...], ...]:
    """The first id of each order and root colour, as in ``TreeTable.starts``."""
    starts: list[tuple[int, ...]] = []
    first = 0
    for counts in counts_upto(admissible, order):
        starts.append(tuple(accumulate(counts, initial=first)))
        first = starts[-1][-1]
    return tuple(starts)


def segments_of(
    admissible: Admissible, starts: Sequence[Sequence[int]], order: int, lower: Columns, root: int
) -> list[tuple[Segment, Growth]]:
    """The segments of one order and root colour that are not empty, with what makes their trees."""
    made = []
    start = starts[order - 1][root]
    for branch_order in range(1, order):
        rest = order - branch_order
        if rest > 1 and admissible.is_linear(root):
            continue
        of_rest = starts[rest - 1]
        stems = range(of_rest[root], of_rest[root + 1])
        firsts = starts[branch_order - 1]
        for colour in admissible.branches[root]:
            branches = range(firsts[colour], firsts[colour + 1])
            growth = Growth(lower, order, stems, branches)
            if not len(growth):
                continue
            ids = range(start, start + len(growth))
            made.append((Segment(order, root, branch_order, colour, ids, stems, branches), growth))
            start = ids.stop
    return made


def _fill(
    columns: Columns, admissible: Admissible, starts: Sequence[Sequence[int]], order: int
) -> list[Segment]:
    """Write the trees of one order into the table; the lower orders are there already."""
    segments = []
    for root in range(admissible.colours):
        for segment, growth in segments_of(admissible, starts, order, columns, root):
            columns.write(segment.ids.start, growth.make(0, len(growth)))
            segments.append(segment)
    return segments
