"""The residuals b_lᵀ 𝒜^[u] − 1/γ(u) of all trees of an order, each in a ball that holds it.

Trees share their branches, as in the tree table: u = stem ∘ branch gives 𝒜^[u] = 𝒜^[stem] ⊙ A
𝒜^[branch], so

    b_lᵀ 𝒜^[u] = (b_l ⊙ 𝒜^[stem])ᵀ (A 𝒜^[branch]),

and the weights of all trees of a segment are entries of one matrix product. The vectors of the
order itself are not needed. All arithmetic is ball arithmetic: nothing here depends on the rounding
of floats.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from flint import arb, arb_mat, ctx

from garkcli.order.conditions import coupling_graph, twin_roots
from garkcli.tableau.enclosing import Enclosure
from garkcli.tableau.tableau import Tableau
from garkcli.trees.columns import Segment
from garkcli.trees.count import Admissible
from garkcli.trees.table import TreeTable
from garkcli.trees.tree import Tree


@dataclass(frozen=True, eq=False)
class Sizes:
    """How large the residuals of one order are.

    Attributes:
        bound: no |residual| of the order is larger.
        reached: the |residual| of ``largest``.
        largest: a tree whose |residual| is the largest, or nearly so; one that surely exceeds the
            tolerance where there is one. None where no residual differs from zero by more than the
            enclosures do.
        doubtful: trees whose ball leaves open whether they are within the tolerance.
    """

    bound: arb
    reached: arb
    largest: Tree | None
    doubtful: tuple[Tree, ...] = ()


class TreeResiduals:
    """The residuals of every admissible tree, order after order; what orders share is kept.

    ``_vectors[n, nature]``: 𝒜^[u], one row a tree, of the trees of order n in the order of the
    table; colours of one nature share their stages and their trees. ``_applied[space, n, m]``: A
    𝒜^[u] as columns, for the trees with root colour m.
    """

    def __init__(self, tableau: Tableau, enclosure: Enclosure) -> None:
        self.enclosure = enclosure
        self._rows = [colour.space for colour in tableau.colours]
        self._natures = [(colour.space, colour.is_linear) for colour in tableau.colours]
        self._roots = tuple(twin_roots(tableau))
        edges, linear = coupling_graph(tableau)
        self._admissible = Admissible.of(tableau.size, edges, linear)
        self._vectors: dict[tuple[int, tuple[int, bool]], list[list[arb]]] = {}
        for space, is_linear in self._natures:
            one = [arb(1)] * enclosure.stages[space]
            self._vectors[1, (space, is_linear)] = [one]
        self._applied: dict[tuple[int, int, int], arb_mat] = {}

    def sizes(self, order: int, tolerance: arb | None = None) -> Sizes:
        """Bounds on all |residuals| of an order; ``tolerance`` tells which trees are doubtful."""
        bound = reached = arb(0)
        largest: int | None = None
        doubtful: list[int] = []
        failed = False
        with ctx.workprec(self.enclosure.bits):
            table = TreeTable.of(self._admissible, order)
            for size, tree_id in self._residuals(table, order):
                if not size < reached:
                    bound = bound.max(size)
                fails = tolerance is not None and size > tolerance
                if (fails and not failed) or (size > reached and fails == failed):
                    reached, largest, failed = size, tree_id, fails
                if tolerance is not None and not fails and not size <= tolerance:
                    doubtful.append(tree_id)
            worst = None if largest is None else table.tree(largest)
            trees = tuple(table.tree(u) for u in doubtful)
            return Sizes(bound.abs_upper(), reached, worst, trees)

    def _residuals(self, table: TreeTable, order: int) -> Iterator[tuple[arb, int]]:
        """|b_lᵀ 𝒜^[u] − 1/γ(u)| and the id, for the roots that differ in more than their colour."""
        if order == 1:
            for l in self._roots:
                yield abs(sum(self.enclosure.b[l].entries(), arb(-1))), l
            return
        required: dict[int, arb] = {}
        for segment in table.segments:
            if segment.order != order or segment.root not in self._roots:
                continue
            values = self._values(table, segment)
            ids = slice(segment.ids.start, segment.ids.stop)
            where = (table.stem[ids] - segment.stems.start) * len(segment.branches)
            where += table.branch[ids] - segment.branches.start
            densities = table.gamma[ids].tolist()
            rows = zip(where.tolist(), segment.ids, densities, strict=True)
            for i, u, gamma in rows:
                if gamma not in required:
                    required[gamma] = 1 / arb(gamma)
                yield abs(values[i] - required[gamma]), u

    def _values(self, table: TreeTable, segment: Segment) -> list[arb]:
        """b_lᵀ 𝒜^[u] for every stem with every branch, stem by stem."""
        l = segment.root
        b = self.enclosure.b[l].entries()
        stems = self._stage_vectors(table, segment.order - segment.branch_order, l)
        entries = [x * w for row in stems for x, w in zip(row, b, strict=True)]
        weighted = arb_mat(len(stems), len(b), entries)
        return (weighted * self._branches(table, segment)).entries()

    def _branches(self, table: TreeTable, segment: Segment) -> arb_mat:
        """A 𝒜^[branch] of all branches that a segment chooses from, one column each."""
        space = self._rows[segment.root]
        order, m = segment.branch_order, segment.branch_root
        key = space, order, m
        if key not in self._applied:
            vectors = arb_mat(self._stage_vectors(table, order, m))
            A = self.enclosure.A[space, m]
            self._applied[key] = A * vectors.transpose()
        return self._applied[key]

    def _stage_vectors(self, table: TreeTable, order: int, l: int) -> list[list[arb]]:
        """𝒜^[u] of the trees with root colour l, in the order of the table; there is one at
        least.
        """
        key = order, self._natures[l]
        if key not in self._vectors:
            vectors: list[list[arb]] = []
            for segment in table.segments:
                if (segment.order, segment.root) == (order, l):
                    vectors += self._products(table, segment)
            self._vectors[key] = vectors
        return self._vectors[key]

    def _products(self, table: TreeTable, segment: Segment) -> Iterator[list[arb]]:
        """𝒜^[stem] ⊙ A 𝒜^[branch] for the trees of a segment, in their order."""
        stem_order = segment.order - segment.branch_order
        stems = self._stage_vectors(table, stem_order, segment.root)
        branches = self._branches(table, segment).transpose().tolist()
        ids = slice(segment.ids.start, segment.ids.stop)
        of_stem = (table.stem[ids] - segment.stems.start).tolist()
        of_branch = (table.branch[ids] - segment.branches.start).tolist()
        for i, j in zip(of_stem, of_branch, strict=True):
            yield [x * y for x, y in zip(stems[i], branches[j], strict=True)]
