"""All trees that a tableau sees up to an order, numbered, with what is left when one edge is cut.

A tree is a number here, and a function on trees a list: the recursions of this room visit each edge
of each tree, and looking trees up by their shape would take most of the time.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from garkcli.errors import UsageProblem
from garkcli.order.conditions import coupling_graph
from garkcli.tableau.tableau import Tableau
from garkcli.trees.count import Admissible, counts_upto
from garkcli.trees.tree import Tree

MAX_TREES = 40_000
"""The most trees that are held at once, all orders together."""


@dataclass(frozen=True)
class Cut:
    """An edge of a tree: what stays on the root, what hangs below the edge, and how many edges of
    the tree are alike.
    """

    rest: int
    branch: int
    times: int


@dataclass(frozen=True)
class Forest:
    """The admissible trees of a coupling graph up to an order, in the order of :class:`Tree`.

    Attributes:
        admissible: which trees are meant.
        max_order: ρ of the largest of them.
        trees: all of them; a tree's number is its position.
        cuts: for each tree its edges.

    >>> forest = Forest.of(Admissible.of(1), 4)
    >>> [len(forest.of_order(n)) for n in range(1, 5)]
    [1, 1, 2, 4]
    >>> forest.cuts[2]
    (Cut(rest=1, branch=0, times=2),)
    """

    admissible: Admissible
    max_order: int
    trees: tuple[Tree, ...]
    cuts: tuple[tuple[Cut, ...], ...]
    # by root and the numbers of the branches
    _numbers: dict[tuple[int, tuple[int, ...]], int] = field(repr=False, compare=False)
    _starts: tuple[int, ...] = field(repr=False, compare=False)

    @classmethod
    def of(cls, admissible: Admissible, order: int) -> Forest:
        """Generate the trees.

        Raises:
            UsageProblem: there are more than ``MAX_TREES`` of them.
        """
        from garkcli.trees.table import TreeTable  # numpy is paid for here

        _check_size(admissible, order)
        table = TreeTable.of(admissible, order)
        roots = table.root.tolist()
        stems = table.stem.tolist()
        lasts = table.branch.tolist()
        branches: list[tuple[int, ...]] = []
        trees: list[Tree] = []
        numbers: dict[tuple[int, tuple[int, ...]], int] = {}
        for number, root in enumerate(roots):
            below: tuple[int, ...] = ()
            if lasts[number] >= 0:
                # a tree is its stem with one branch more
                with_last = [*branches[stems[number]], lasts[number]]
                below = tuple(sorted(with_last))
            branches.append(below)
            numbers[root, below] = number
            trees.append(Tree(root, [trees[k] for k in below]))
        cutter = _Cutter(roots, branches, numbers)
        cuts = [cutter.cuts_of(number) for number in range(len(trees))]
        starts = [row[0] for row in table.starts]
        starts.append(len(trees))
        return cls(admissible, order, tuple(trees), tuple(cuts), numbers, tuple(starts))

    @classmethod
    def seen_by(cls, tableau: Tableau, order: int) -> Forest:
        """The trees that have an order condition for ``tableau``.

        Raises:
            UsageProblem: there are too many of them.
        """
        admissible = Admissible.of(tableau.size, *coupling_graph(tableau))
        return cls.of(admissible, order)

    def of_order(self, order: int) -> range:
        """The numbers of the trees with ``order`` vertices."""
        return range(self._starts[order - 1], self._starts[order])

    def number(self, tree: Tree) -> int | None:
        """The number of a tree; None where it is not admissible or too large."""
        below = []
        for branch in tree.branches:
            number = self.number(branch)
            if number is None:
                return None
            below.append(number)
        below.sort()
        return self._numbers.get((tree.root, tuple(below)))

    def order(self, number: int) -> int:
        """ρ of the tree of this number."""
        return self.trees[number].order

    def branches(self) -> Iterator[tuple[int, tuple[int, ...]]]:
        """For each tree its root colour and the numbers of its branches."""
        yield from self._numbers


@dataclass
class _Cutter:
    """Finds the edges of trees, smaller trees first."""

    roots: list[int]
    branches: list[tuple[int, ...]]
    numbers: dict[tuple[int, tuple[int, ...]], int]
    known: list[tuple[Cut, ...]] = field(default_factory=list)

    def cuts_of(self, number: int) -> tuple[Cut, ...]:
        """The edges of a tree; those of all trees before it have been found."""
        root, below = self.roots[number], self.branches[number]
        found: Counter[tuple[int, int]] = Counter()
        for branch, alike in Counter(below).items():
            others = list(below)
            others.remove(branch)
            rest = self.numbers[root, tuple(others)]
            found[rest, branch] += alike
            for cut in self.known[branch]:
                kept = tuple(sorted((*others, cut.rest)))
                rest = self.numbers[root, kept]
                found[rest, cut.branch] += alike * cut.times
        cuts = []
        for (rest, below_edge), times in found.items():
            cuts.append(Cut(rest, below_edge, times))
        self.known.append(tuple(cuts))
        return self.known[-1]


def possible_order(tableau: Tableau, order: int) -> int:
    """The largest order up to ``order`` with few enough trees."""
    admissible = Admissible.of(tableau.size, *coupling_graph(tableau))
    too_many = _first_beyond_limit(admissible, order)
    if too_many is None:
        return order
    first, _ = too_many
    return first - 1


def _check_size(admissible: Admissible, order: int) -> None:
    """Refuse a number of trees that would take too long."""
    too_many = _first_beyond_limit(admissible, order)
    if too_many is None:
        return
    n, total = too_many
    message = f"{total} trees of order up to {n} (limit {MAX_TREES})"
    raise UsageProblem(message, f"ask for --order {n - 1} at most", code="too-many")


def _first_beyond_limit(admissible: Admissible, order: int) -> tuple[int, int] | None:
    """The first order with too many trees up to it, and how many; None where all are few enough."""
    total = 0
    for n, counts in enumerate(counts_upto(admissible, order), start=1):
        total += sum(counts)
        if total > MAX_TREES:
            return n, total
    return None
