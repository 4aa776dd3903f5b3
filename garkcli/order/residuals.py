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
from typing import TypeAlias

from flint import arb, arb_mat, ctx

from garkcli.order.conditions import coupling_graph, twin_roots
from garkcli.order.entries import times
from garkcli.tableau.enclosing import Enclosure
from garkcli.tableau.tableau import Tableau
from garkcli.trees.columns import Segment
from garkcli.trees.count import Admissible
from garkcli.trees.table import TreeTable

Row: TypeAlias = list[arb]
_Nature: TypeAlias = tuple[int, bool]
"""Stage space of a colour, and whether it is linear."""


@dataclass(frozen=True, eq=False)
class Sizes:
    """How large the residuals of one order are.

    Attributes:
        bound: no |residual| of the order is larger.
        reached: the largest |residual| that is known of a tree.
    """

    bound: arb
    reached: arb


class TreeResiduals:
    """The residuals of every admissible tree, order after order; what orders share is kept.

    ``_vectors[n, nature]``: 𝒜^[u], one row a tree, of the trees of order n in the order of the
    table; colours of one nature share their stages and their trees. ``_applied[space, n, m]``: A
    𝒜^[u] as columns, for the trees with root colour m.
    """

    def __init__(self, tableau: Tableau, enclosure: Enclosure) -> None:
        self.enclosure = enclosure
        self._rows = [colour.space for colour in tableau.colours]
        self._natures: list[_Nature] = []
        for colour in tableau.colours:
            nature = colour.space, colour.is_linear
            self._natures.append(nature)
        self._roots = tuple(twin_roots(tableau))
        edges, linear = coupling_graph(tableau)
        self._admissible = Admissible.of(tableau.size, edges, linear)
        self._vectors: dict[tuple[int, _Nature], list[Row]] = {}
        for nature in self._natures:
            space, _ = nature
            one = [arb(1)] * enclosure.stages[space]
            self._vectors[1, nature] = [one]
        self._applied: dict[tuple[int, int, int], arb_mat] = {}

    def sizes(self, order: int) -> Sizes:
        """Bounds on all |residuals| of an order."""
        bound = reached = arb(0)
        for residual, _, _ in self.of(order):
            size = abs(residual)
            bound = bound.max(size)
            if size > reached:
                reached = size
        return Sizes(bound.abs_upper(), reached)

    def table(self, order: int) -> TreeTable:
        """The table whose ids ``of`` gives."""
        return TreeTable.of(self._admissible, order)

    def of(self, order: int, share: int = 1) -> list[tuple[arb, arb, int]]:
        """The residual b_lᵀ 𝒜^[u] − share/γ(u), share/γ(u) and the id of each tree of an order, for
        the roots that differ in more than their colour.
        """
        with ctx.workprec(self.enclosure.bits):
            return list(self._residuals(self.table(order), order, share))

    def _residuals(
        self, table: TreeTable, order: int, share: int
    ) -> Iterator[tuple[arb, arb, int]]:
        if order == 1:
            for l in self._roots:
                weights = self.enclosure.b[l].entries()
                yield sum(weights, arb(-share)), arb(share), l
            return
        required: dict[int, arb] = {}
        for segment in table.segments:
            if segment.order != order or segment.root not in self._roots:
                continue
            values = self._values(table, segment)
            ids = slice(segment.ids.start, segment.ids.stop)
            stems = table.stem[ids] - segment.stems.start
            branches = table.branch[ids] - segment.branches.start
            where = stems * len(segment.branches) + branches
            densities = table.gamma[ids].tolist()
            trees = zip(where.tolist(), segment.ids, densities, strict=True)
            for i, u, gamma in trees:
                if gamma not in required:
                    required[gamma] = share / arb(gamma)
                yield values[i] - required[gamma], required[gamma], u

    def _values(self, table: TreeTable, segment: Segment) -> Row:
        """b_lᵀ 𝒜^[u] for every stem with every branch, stem by stem."""
        l = segment.root
        b = self.enclosure.b[l].entries()
        stem_order = segment.order - segment.branch_order
        stems = self._stage_vectors(table, stem_order, l)
        weighted = arb_mat([times(row, b) for row in stems])
        branches = self._branches(table, segment)
        return (weighted * branches).entries()

    def _branches(self, table: TreeTable, segment: Segment) -> arb_mat:
        """A 𝒜^[branch] of all branches that a segment chooses from, one column each."""
        space = self._rows[segment.root]
        order = segment.branch_order
        m = segment.branch_root
        key = space, order, m
        if key not in self._applied:
            vectors = self._stage_vectors(table, order, m)
            columns = arb_mat(vectors).transpose()
            A = self.enclosure.A[space, m]
            self._applied[key] = A * columns
        return self._applied[key]

    def _stage_vectors(self, table: TreeTable, order: int, l: int) -> list[Row]:
        """𝒜^[u] of the trees with root colour l, in the order of the table; there is one at
        least.
        """
        key = order, self._natures[l]
        if key not in self._vectors:
            vectors: list[Row] = []
            for segment in table.segments:
                if segment.order == order and segment.root == l:
                    vectors += self._products(table, segment)
            self._vectors[key] = vectors
        return self._vectors[key]

    def _products(self, table: TreeTable, segment: Segment) -> Iterator[Row]:
        """𝒜^[stem] ⊙ A 𝒜^[branch] for the trees of a segment, in their order."""
        stem_order = segment.order - segment.branch_order
        stems = self._stage_vectors(table, stem_order, segment.root)
        branches = self._branches(table, segment).transpose().tolist()
        ids = slice(segment.ids.start, segment.ids.stop)
        of_stem = table.stem[ids] - segment.stems.start
        of_branch = table.branch[ids] - segment.branches.start
        rows = of_stem.tolist()
        columns = of_branch.tolist()
        for i, j in zip(rows, columns, strict=True):
            yield times(stems[i], branches[j])
