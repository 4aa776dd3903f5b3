"""B-series in coloured trees: the Lie algebra of vector fields and the group of their flows.

For a function c on trees B(c, y) = Σ_u h^ρ(u)/σ(u) c(u) F(u)(y). The derivative of B(c, y) along
the field B(b, y) is B(c ◁ b, y) with

    (c ◁ b)(u) = Σ c(u∖v) b(v),

a sum over the edges of u, with v the part below the edge. So the flow of B(b, y) over the time 1 is
B(a, y) with

    a(u) = Σ_{j ≥ 1} 1/j! (…((b ◁ b) ◁ b) … ◁ b)(u)         j factors,

which is solved for b tree by tree: terms with j ≥ 2 only have trees of lower order. Source: Hairer,
Lubich and Wanner, *Geometric Numerical Integration*, 2nd ed. (2006), lemma IX.9.1 and theorem
IX.9.2, there in one colour.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from math import factorial
from typing import TypeAlias

from garkcli.errors import UsageProblem
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector, apply, dot
from garkcli.frozen import Frozen, Mutable, field
from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import coupling_graph
from garkcli.tableau.tableau import Tableau

MAX_TREES = 40_000
"""Most trees of all orders together."""


class Cut(Frozen):
    """An edge of a tree: the parts above and below it, and the number of edges that are alike."""

    rest: int
    branch: int
    times: int


class Forest(Frozen):
    """The admissible trees of a coupling graph up to an order, by numbers; ``cuts`` has their
    edges.

    >>> forest = Forest.of(Admissible.of(1), 4)
    >>> [len(forest.of_order(n)) for n in range(1, 5)], forest.cuts[2]
    ([1, 1, 2, 4], (Cut(rest=1, branch=0, times=2),))
    """

    admissible: Admissible
    max_order: int
    trees: tuple[Tree, ...]
    cuts: tuple[tuple[Cut, ...], ...]
    # by root and the numbers of the branches
    _numbers: dict[tuple[int, tuple[int, ...]], int]
    _starts: tuple[int, ...]

    @classmethod
    def of(cls, admissible: Admissible, order: int) -> Forest:
        """Raises UsageProblem for more than ``MAX_TREES``."""
        from garkcli.ntrees.table import TreeTable  # numpy is paid for here

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
        starts = [table.ids(n).start for n in range(1, order + 1)]
        starts.append(len(trees))
        return cls(admissible, order, tuple(trees), tuple(cuts), numbers, tuple(starts))

    @classmethod
    def seen_by(cls, tableau: Tableau, order: int) -> Forest:
        """The trees with an order condition for ``tableau``; UsageProblem if there are too many."""
        return cls.of(coupling_graph(tableau), order)

    def of_order(self, order: int) -> range:
        return range(self._starts[order - 1], self._starts[order])

    def number(self, tree: Tree) -> int | None:
        """The number of a tree; None if it is not admissible or too large."""
        below = []
        for branch in tree.branches:
            number = self.number(branch)
            if number is None:
                return None
            below.append(number)
        below.sort()
        return self._numbers.get((tree.root, tuple(below)))

    def order(self, number: int) -> int:
        return self.trees[number].order

    def branches(self) -> Iterator[tuple[int, tuple[int, ...]]]:
        """For each tree its root colour and the numbers of its branches."""
        yield from self._numbers


class _Cutter(Mutable):
    roots: list[int]
    branches: list[tuple[int, ...]]
    numbers: dict[tuple[int, tuple[int, ...]], int]
    known: list[tuple[Cut, ...]] = field(default_factory=list)

    def cuts_of(self, number: int) -> tuple[Cut, ...]:
        """The edges of a tree; those of all smaller numbers are known."""
        root, below = self.roots[number], self.branches[number]
        found: Counter[tuple[int, int]] = Counter()
        for branch, alike in Counter(below).items():
            others = list(below)
            others.remove(branch)
            rest = self.numbers[root, tuple(others)]
            found[rest, branch] += alike
            for cut in self.known[branch]:
                rest = self.numbers[root, tuple(sorted((*others, cut.rest)))]
                found[rest, cut.branch] += alike * cut.times
        cuts = []
        for (rest, below_edge), times in found.items():
            cuts.append(Cut(rest, below_edge, times))
        self.known.append(tuple(cuts))
        return self.known[-1]


def possible_order(tableau: Tableau, order: int) -> int:
    too_many = _first_beyond_limit(coupling_graph(tableau), order)
    if too_many is None:
        return order
    first, _ = too_many
    return first - 1


def _check_size(admissible: Admissible, order: int) -> None:
    too_many = _first_beyond_limit(admissible, order)
    if too_many is None:
        return
    n, total = too_many
    message = f"{total} trees of order up to {n} (limit {MAX_TREES})"
    raise UsageProblem(message, f"ask for --order {n - 1} at most", code="too-many")


def _first_beyond_limit(admissible: Admissible, order: int) -> tuple[int, int] | None:
    """The first order with too many trees up to it, and their number, or None."""
    total = 0
    for n, counts in enumerate(counts_upto(admissible, order), start=1):
        total += sum(counts)
        if total > MAX_TREES:
            return n, total
    return None


Coefficients: TypeAlias = Sequence[Number]
"""A function on the trees of a forest, by their numbers."""


def elementary_weights(tableau: Tableau, forest: Forest) -> list[Number]:
    """a(u) = b_lᵀ 𝒜^[u], the B-series of the method."""
    vectors: list[Vector] = []
    weights: list[Number] = []
    for root, branches in forest.branches():
        space = tableau.space(root)
        vector = space.one
        for branch in branches:
            block = tableau.block(root, forest.trees[branch].root)
            assert block is not None  # the trees are those that the tableau admits
            vector = space.product(vector, apply(block, vectors[branch]))
        vectors.append(vector)
        weights.append(dot(tableau.colours[root].b, vector))
    return weights


def logarithm(forest: Forest, a: Coefficients) -> list[Number]:
    """The b with B(a, y) the flow of B(b, y): h times the modified vector field.

    >>> from flint import fmpq
    >>> from garkcli.ntrees.count import Admissible
    >>> forest = Forest.of(Admissible.of(1), 4)
    >>> logarithm(forest, [1, 0, 0, 0, 0, 0, 0, 0])  # the explicit Euler method
    [1, -1/2, 1/6, 1/3, 0, -1/12, -1/6, -1/4]
    """
    powers = _Powers(forest)
    for number, weight in enumerate(a):
        powers.add(number, weight - powers.sum_of_higher(number))
    return powers.field


class _Powers:
    """The products b, b ◁ b, (b ◁ b) ◁ b, … : j + 1 factors at u in ``products[u][j]``."""

    def __init__(self, forest: Forest) -> None:
        self.forest = forest
        self.field: list[Number] = []
        self.products: list[list[Number]] = []

    def sum_of_higher(self, number: int) -> Number:
        """Σ_{j ≥ 2} 1/j! of the products with j factors, which are stored."""
        order = self.forest.order(number)
        products: list[Number] = [ZERO] * order
        for cut in self.forest.cuts[number]:
            factor = self.field[cut.branch] * cut.times
            if not factor:
                continue
            for j, product in enumerate(self.products[cut.rest], start=1):
                if product:
                    products[j] = products[j] + product * factor
        self.products.append(products)
        total: Number = ZERO
        for j in range(1, order):
            total = total + products[j] / factorial(j + 1)
        return total

    def add(self, number: int, coefficient: Number) -> None:
        """Sets b(u) of the tree whose higher products have just been summed."""
        self.products[number][0] = coefficient
        self.field.append(coefficient)


def product(forest: Forest, c: Coefficients, b: Coefficients) -> list[Number]:
    """The product c ◁ b: the derivative of one vector field along another."""
    values: list[Number] = []
    for cuts in forest.cuts:
        total: Number = ZERO
        for cut in cuts:
            left, right = c[cut.rest], b[cut.branch]
            if left and right:
                total = total + left * right * cut.times
        values.append(total)
    return values


def bracket(forest: Forest, c: Coefficients, b: Coefficients) -> list[Number]:
    """[c, b] = c ◁ b − b ◁ c."""
    forth, back = product(forest, c, b), product(forest, b, c)
    return [x - y for x, y in zip(forth, back, strict=True)]


def transported(forest: Forest, b: Coefficients, c: Coefficients, lowest: int) -> list[Number]:
    """e^{ad c} b: the field B(b, y) in the coordinates z = χ(y), χ the flow of B(c, y) over time 1.
    For small c it is f(z) − f'(z) g + g' f = f + [g, f], with f of b and g of c. ``lowest`` ≥ 1 is
    the least order of a tree with c ≠ 0.
    """
    result = list(b)
    nested: list[Number] = list(b)
    # each bracket raises the order by the lowest one of c
    for j in range(1, (forest.max_order - 1) // lowest + 1):
        nested = bracket(forest, c, nested)
        for number, value in enumerate(nested):
            if value:
                result[number] = result[number] + value / factorial(j)
    return result
