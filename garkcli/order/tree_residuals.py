"""The residuals of all trees of an order, in balls."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import chain

from flint import arb, arb_mat, ctx

from garkcli.exact.enclosing import times
from garkcli.frozen import Frozen
from garkcli.ntrees.stage_vectors import StageVectors
from garkcli.ntrees.table import Column, Segment, TreeTable
from garkcli.order.admissible import coupling_graph, twin_roots
from garkcli.tableau.enclosure import Enclosure, Row
from garkcli.tableau.tableau import Tableau


class ResidualSizes(Frozen, eq=False):
    bound: arb
    reached: arb


class BallVectors(list[Row]):
    @cached_property
    def matrix(self) -> arb_mat:
        return arb_mat(self)


class TreeResiduals(StageVectors[BallVectors]):
    """The residuals b_lᵀ 𝒜^[u] − 1/γ(u) of every admissible tree in balls, order after order.

    Trees share branches: u = stem ∘ branch gives 𝒜^[u] = 𝒜^[stem] ⊙ A 𝒜^[branch], so

        b_lᵀ 𝒜^[u] = (b_l ⊙ 𝒜^[stem])ᵀ (A 𝒜^[branch]),

    and the weights of all trees of a segment are entries of one matrix product, without the vectors
    of the order itself.
    """

    def __init__(self, tableau: Tableau, enclosure: Enclosure) -> None:
        self.enclosure = enclosure
        self._roots = tuple(twin_roots(tableau))
        self._admissible = coupling_graph(tableau)
        super().__init__(self._admissible, [colour.space for colour in tableau.colours])

    def sizes(self, order: int) -> ResidualSizes:
        bound = reached = arb(0)
        for residual, _, _ in self.of_order(order):
            size = abs(residual)
            bound = bound.max(size)
            if size > reached:
                reached = size
        return ResidualSizes(bound.abs_upper(), reached)

    def table(self, order: int) -> TreeTable:
        return TreeTable.of(self._admissible, order)

    def of_order(self, order: int, share: int = 1) -> list[tuple[arb, arb, int]]:
        """The residual, share/γ(u) and id of each tree of an order, once for twin roots."""
        with ctx.workprec(self.enclosure.bits):
            return list(self._residuals(self.table(order), order, share))

    def _residuals(
        self, table: TreeTable, order: int, share: int
    ) -> Iterator[tuple[arb, arb, int]]:
        exact = table.is_exact
        for l in self._roots:
            kind = self._admissible.kinds[l]
            if order == kind.weight and kind.allows(0):
                (u,) = table.ids(order, l)
                due = arb(share * int(exact[u])) / kind.integrated(order)
                yield sum(self.enclosure.b[l].entries(), -due), due, u
        required: dict[int, arb] = {}
        for segment in table.segments:
            if segment.order != order or segment.root not in self._roots:
                continue
            ids = slice(segment.ids.start, segment.ids.stop)
            stems = table.stem[ids] - segment.stems.start
            branches = table.branch[ids] - segment.branches.start
            if len(segment.stems) < len(segment.branches):
                where = branches * len(segment.stems) + stems
            else:
                where = stems * len(segment.branches) + branches
            values = self._values(table, segment)
            # γ, or 0 of trees that the exact solution does not have
            gammas = (table.gamma[ids] * exact[ids]).tolist()
            for i, u, gamma in zip(where.tolist(), segment.ids, gammas, strict=True):
                if gamma not in required:
                    required[gamma] = share / arb(gamma) if gamma else arb(0)
                yield values[i] - required[gamma], required[gamma], u

    def _values(self, table: TreeTable, segment: Segment) -> Row:
        """b_lᵀ 𝒜^[u] for every stem with every branch, the longer list outside."""
        b = self.enclosure.b[segment.root].entries()
        stems = self.stems(table, segment)
        if len(stems) < len(segment.branches):  # the weights and A go where they are fewer
            few = arb_mat([times(row, b) for row in stems])
            few *= self.enclosure.A[self.rows[segment.root], segment.branch_root]
            many = self.of(table, segment.branch_order, segment.branch_root)
        else:
            few = arb_mat([times(row, b) for row in self.branches(table, segment)])
            many = stems
        return (many.matrix * few.transpose()).entries()

    def _part(self, vectors: BallVectors, places: Column) -> BallVectors:
        return BallVectors(vectors[i] for i in places.tolist())

    def _vertex(self, l: int) -> BallVectors:
        return BallVectors([[arb(1)] * self.enclosure.stages[self.rows[l]]])

    def _image(self, space: int, m: int, vectors: BallVectors) -> BallVectors:
        return BallVectors((vectors.matrix * self.enclosure.A[space, m].transpose()).tolist())

    def _product(self, space: int, stems: BallVectors, branches: BallVectors) -> BallVectors:  # noqa: ARG002
        return BallVectors(map(times, stems, branches))

    def _joined(self, parts: list[BallVectors]) -> BallVectors:
        return BallVectors(chain.from_iterable(parts))
