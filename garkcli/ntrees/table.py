"""The tree table: all N-trees up to an order as integer columns; an N-tree is the ids of two
others.

Every tree with two vertices or more is uniquely u = stem ∘ branch: the branch is the last one of
the root, the one with the largest id. For a given stem the admissible branches of one order and
root colour are a contiguous range of ids, so that a whole order is made with ``repeat`` and
``arange``. If a kind of vertex may have more branches but not none or one, the table also has the
vertex with none or one, as a *bare stem*.

>>> table = TreeTable.upto(1, 4)
>>> table.notation(range(len(table)), colours=False)
['[]', '[[]]', '[[],[]]', '[[[]]]', '[[],[],[]]', '[[[]],[]]', '[[[],[]]]', '[[[[]]]]']
>>> table.gamma.tolist(), table.sigma.tolist()
([1, 2, 3, 6, 4, 8, 12, 24], [1, 1, 2, 1, 6, 1, 2, 1])
"""

from __future__ import annotations

from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING, Any, TypeAlias

from garkcli import numpy_on_use as np
from garkcli.errors import UsageProblem, counted
from garkcli.frozen import Frozen
from garkcli.ntrees.count import Admissible, Counts, Edges, counts_upto
from garkcli.ntrees.kind import SEVERAL, Arity, VertexKind
from garkcli.ntrees.tree import Tree

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from numpy.typing import DTypeLike


Column: TypeAlias = "np.ndarray[tuple[int], np.dtype[Any]]"

LAST_INT64_ORDER = 20
"""γ ≤ n! and σ ≤ (n - 1)!, and 20! < 2⁶³ < 21!: higher orders have Python integers."""


def exact_dtype(order: int) -> DTypeLike:
    return np.int64 if order <= LAST_INT64_ORDER else np.dtype(object)


class Columns(Frozen):
    """Trees as columns of equal length. ``stem`` and ``branch`` are the ids of the two parents, -1
    for a single vertex; ``root`` the root colour, from 0; ``order`` ρ(u); ``multiplicity`` that of
    the last branch at the root, 0 for a single vertex; ``sigma`` σ(u) and ``gamma`` γ(u), exact.
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
        ids = [np.empty(length, np.int64) for _ in range(2)]
        small = [np.empty(length, np.int16) for _ in range(3)]
        return cls(*ids, *small, *[np.empty(length, exact) for _ in range(2)])

    @classmethod
    def vertex(cls, root: int, kind: VertexKind) -> Columns:
        made = cls.empty(1, np.int64)
        made.stem[:] = -1
        made.branch[:] = -1
        made.root[:] = root
        made.multiplicity[:] = 0
        made.order[:] = kind.weight
        made.sigma[:] = 1
        made.gamma[:] = kind.integrated(kind.weight)
        return made

    def __len__(self) -> int:
        return len(self.stem)

    def all(self) -> tuple[Column, ...]:
        return tuple(getattr(self, name) for name in self.__struct_fields__)

    def part(self, which: slice | Column) -> Columns:
        return Columns(*[column[which] for column in self.all()])

    def write(self, start: int, trees: Columns) -> None:
        stop = start + len(trees)
        for column, values in zip(self.all(), trees.all(), strict=True):
            column[start:stop] = values

    def freeze(self) -> Columns:
        for column in self.all():
            column.flags.writeable = False
        return self


class Segment(Frozen):
    """Trees of one order and root colour whose last branches have one order and root colour too.
    They have consecutive ``ids``; ``stems`` and ``branches`` are the ids of their parents.
    """

    order: int
    root: int
    branch_order: int
    branch_root: int
    ids: range
    stems: range
    branches: range


class Growth:
    """The future trees of a segment; ``lower`` has all trees of lower order."""

    def __init__(
        self, lower: Columns, order: int, kind: VertexKind, stems: range, branches: range
    ) -> None:
        self.lower = lower
        self.order = order
        self.kind = kind
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
        """The trees at positions start, …, stop - 1 of the segment, 0 ≤ start < stop ≤ len."""
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
        skipped = start - int(self._end[i] - self._count[i])
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
        of_stem = self.kind.integrated(int(lower.order[stems.start]))
        with_order = lower.gamma[stems].astype(exact, copy=False) // of_stem
        with_order *= self.kind.integrated(order)
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


Inside = tuple[str, int, int]
"""The text inside a root, the end of its largest branches, and their order."""
_VERTEX: Inside = ("", 0, 0)


class Texts:
    """Writes trees as text and caches the text of every parent in ``columns``, the table."""

    def __init__(self, columns: Columns, colours: bool) -> None:
        self.columns = columns
        self.colours = colours
        self._insides: dict[int, Inside] = {}

    def of(self, trees: Columns) -> list[str]:
        """The text of trees whose parents are in the table, as by ``format_tree``."""
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
        # smaller ones first
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
            made.append(_inserted(insides[stem], text, int(order[branch])))
        return made

    def _closed(self, inside: str, root: int) -> str:
        if not self.colours:
            return f"[{inside}]"
        return f"[{inside}]_{root + 1}"


def _inserted(stem: Inside, text: str, order: int) -> Inside:
    """Inserts a last branch, which is never smaller than the others: so there are two cases."""
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
"""Most trees of a table: some 35 bytes each."""
MOST_KEPT = 10_000
"""Most branches that a table keeps as :class:`Tree`."""


class TableTooLarge(UsageProblem):
    code = "too-many"


class TreeTable(Frozen):
    """All admissible N-trees of order 1, …, ``max_order``, by order, root colour and last branch. A
    tree's id is its position, in the order of :class:`Tree`; those of one order and root colour are
    contiguous. The bare stems of an order follow its trees. Columns are read-only.
    """

    admissible: Admissible
    max_order: int
    columns: Columns
    places: Places
    segments: tuple[Segment, ...]
    # of the bare stems
    bare: tuple[Segment, ...]

    @cached_property
    def _texts(self) -> dict[bool, Texts]:
        return {}

    @cached_property
    def _branches(self) -> dict[int, Tree]:
        return {}

    @classmethod
    def upto(
        cls, colours: int, order: int, edges: Edges | None = None, linear: Collection[int] = ()
    ) -> TreeTable:
        """The table; TableTooLarge beyond ``MAX_TREES`` trees: :func:`iter_blocks` streams one
        order more.
        """
        return cls.of(Admissible.of(colours, edges, linear), order)

    @classmethod
    def of(cls, admissible: Admissible, order: int) -> TreeTable:
        places = Places.of(admissible, order)
        size = places.size
        if size > MAX_TREES:
            raise _too_large(size, admissible.colours, order)
        columns = Columns.empty(size, exact_dtype(order))
        segments: list[Segment] = []
        bare: list[Segment] = []
        for n in range(1, order + 1):
            for root in range(admissible.colours):
                kind = admissible.kinds[root]
                of_root = _Root(admissible, places, columns, n, root)
                segments += of_root.fill(places.trees(n, root), kind.arity)
                if kind.stems:
                    bare += of_root.fill(places.bare(n, root), kind.stems)
        return cls(admissible, order, columns.freeze(), places, tuple(segments), tuple(bare))

    def __len__(self) -> int:
        return len(self.columns)

    @property
    def colours(self) -> int:
        return self.admissible.colours

    @cached_property
    def is_exact(self) -> Column:
        kinds = self.admissible.kinds
        exact = np.array([kind.is_exact for kind in kinds])[self.root]
        if all(kind.is_exact for kind in kinds):
            return exact
        for order in range(1, self.max_order + 1):
            ids = np.flatnonzero((self.order == order) & (self.stem >= 0))
            exact[ids] &= exact[self.stem[ids]] & exact[self.branch[ids]]
        return exact

    @cached_property
    def is_mixed(self) -> Column:
        mixed: Column = np.zeros(len(self), dtype=bool)
        for order in range(2, self.max_order + 1):
            ids = np.flatnonzero((self.order == order) & (self.stem >= 0))
            stem, branch = self.stem[ids], self.branch[ids]
            mixed[ids] = mixed[stem] | mixed[branch] | (self.root[stem] != self.root[branch])
        return mixed

    @property
    def stem(self) -> Column:
        """The id of the tree without its last branch; -1 for a single vertex."""
        return self.columns.stem

    @property
    def branch(self) -> Column:
        return self.columns.branch

    @property
    def root(self) -> Column:
        return self.columns.root

    @property
    def order(self) -> Column:
        return self.columns.order

    @property
    def multiplicity(self) -> Column:
        return self.columns.multiplicity

    @property
    def sigma(self) -> Column:
        return self.columns.sigma

    @property
    def gamma(self) -> Column:
        return self.columns.gamma

    def ids(self, order: int, root: int | None = None) -> range:
        return self.places.trees(order, root)

    def tree(self, tree_id: int) -> Tree:
        if not 0 <= tree_id < len(self):
            raise IndexError(f"no tree {tree_id} in a table of {len(self)} trees")
        stem = self.columns.stem
        branch = self.columns.branch
        branches = []
        u = tree_id
        while (last := int(branch[u])) >= 0:
            known = self._branches.get(last)
            if known is None:
                known = self.tree(last)
                if len(self._branches) < MOST_KEPT:
                    self._branches[last] = known
            branches.append(known)
            u = int(stem[u])
        return self.admissible.tree(int(self.columns.root[u]), branches)

    def notation(self, ids: Iterable[int] | Column, colours: bool = True) -> list[str]:
        which = ids
        if not isinstance(which, np.ndarray):
            which = np.fromiter(which, np.int64)
        return self.texts(self.columns.part(which), colours)

    def texts(self, trees: Columns, colours: bool = True) -> list[str]:
        """Bracket text of trees whose parents are in this table, as those of a block."""
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


class Places(Frozen):
    # [order - 1][root]: the first id of the trees, then of the bare stems; one more entry for the
    # end
    starts: tuple[tuple[int, ...], ...]

    @classmethod
    def of(cls, admissible: Admissible, order: int) -> Places:
        starts: list[tuple[int, ...]] = []
        first = 0
        counts = counts_upto(admissible, order)
        for n, trees in enumerate(counts, start=1):
            bare = [0] * len(trees)
            for root, kind in enumerate(admissible.kinds):
                if kind.stems:
                    bare[root] = _count_bare(admissible, counts, n, root)
            starts.append(tuple(accumulate([*trees, *bare], initial=first)))
            first = starts[-1][-1]
        return cls(tuple(starts))

    @property
    def size(self) -> int:
        return self.starts[-1][-1]

    def trees(self, order: int, root: int | None = None) -> range:
        starts = self.starts[order - 1]
        if root is None:
            return range(starts[0], starts[len(starts) // 2])
        return range(starts[root], starts[root + 1])

    def bare(self, order: int, root: int) -> range:
        starts = self.starts[order - 1]
        place = len(starts) // 2 + root
        return range(starts[place], starts[place + 1])


def _count_bare(admissible: Admissible, counts: Sequence[Counts], order: int, root: int) -> int:
    kind = admissible.kinds[root]
    rest = order - kind.weight
    if rest <= 0:
        return int(rest == 0 and 0 in kind.stems)
    if 1 not in kind.stems:
        return 0
    return sum(counts[rest - 1][m] for m in admissible.branches[root])


class _Root(Frozen):
    admissible: Admissible
    places: Places
    lower: Columns
    order: int
    root: int

    def growths(self, ids: range, arity: Arity) -> Iterator[tuple[Segment, Growth]]:
        """The nonempty segments of ``ids``, without single vertices, and their growths."""
        kind = self.admissible.kinds[self.root]
        start = ids.start
        for branch_order in range(1, self.order - kind.weight + 1):
            rest = self.order - branch_order
            if (1 if rest == kind.weight else SEVERAL) not in arity:
                continue
            of_rest = self.places.trees(rest, self.root), self.places.bare(rest, self.root)
            for colour in self.admissible.branches[self.root]:
                branches = self.places.trees(branch_order, colour)
                for stems in filter(None, of_rest):
                    growth = Growth(self.lower, self.order, kind, stems, branches)
                    if not len(growth):
                        continue
                    here = range(start, start + len(growth))
                    start = here.stop
                    made = self.order, self.root, branch_order, colour, here, stems, branches
                    yield Segment(*made), growth

    def fill(self, ids: range, arity: Arity) -> Iterator[Segment]:
        kind = self.admissible.kinds[self.root]
        if ids and self.order == kind.weight:
            self.lower.write(ids.start, Columns.vertex(self.root, kind))
        for segment, growth in self.growths(ids, arity):
            self.lower.write(segment.ids.start, growth.make(0, len(growth)))
            yield segment


def segments_of(
    admissible: Admissible, places: Places, order: int, lower: Columns, root: int
) -> Iterator[tuple[Segment, Growth]]:
    of_root = _Root(admissible, places, lower, order, root)
    return of_root.growths(places.trees(order, root), admissible.kinds[root].arity)
