"""The order within a tolerance, of tableaus whose coefficients are rounded.

A condition is met within t when its residual |b_lᵀ 𝒜^[u] − 1/γ(u)| is no larger than rounding every
coefficient by t can make it, ``order.effects``. It fails when it is larger: then every method
within t misses it. That is decided by proof, never by floats: exactly as far as the conditions hold
exactly, then tree by tree in ball arithmetic, or for all trees at once by bounds from approximate
spans where the trees are too many.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, arb_mat, ctx, fmpq

from garkcli.doing import doing
from garkcli.exact.display import decimal, to_ball
from garkcli.exact.enclosing import times
from garkcli.frozen import Frozen, FrozenBut
from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.ntrees.stage_vectors import StageVectors
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import DEFAULT_LIMIT, Order, Witness, find_order
from garkcli.order.conditions import coupling_graph, elementary_weight, is_admissible, twin_roots
from garkcli.order.effects import Effects
from garkcli.order.tolerance import within
from garkcli.tableau.rounded import Enclosure, RoundedTableau, Row, Rows, enclose_tableau
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.ntrees.table import Column, Segment


class Sizes(Frozen, eq=False):
    """How large the residuals of one order are.

    Attributes:
        bound: no |residual| of the order is larger.
        reached: the largest |residual| that is known of a tree.
    """

    bound: arb
    reached: arb


class TreeResiduals(StageVectors[Rows]):
    """The residuals b_lᵀ 𝒜^[u] − 1/γ(u) of every admissible tree in balls, order after order.

    A row per tree; what orders share is kept. Trees share their branches, as in the tree table: u =
    stem ∘ branch gives 𝒜^[u] = 𝒜^[stem] ⊙ A 𝒜^[branch], so

        b_lᵀ 𝒜^[u] = (b_l ⊙ 𝒜^[stem])ᵀ (A 𝒜^[branch]),

    and the weights of all trees of a segment are entries of one matrix product. The vectors of the
    order itself are not needed. All arithmetic is ball arithmetic: nothing here depends on the
    rounding of floats.
    """

    def __init__(self, tableau: Tableau, enclosure: Enclosure) -> None:
        self.enclosure = enclosure
        self._roots = tuple(twin_roots(tableau))
        edges, linear = coupling_graph(tableau)
        self._admissible = Admissible.of(tableau.size, edges, linear)
        super().__init__(self._admissible, [colour.space for colour in tableau.colours])

    def sizes(self, order: int) -> Sizes:
        """Bounds on all |residuals| of an order."""
        bound = reached = arb(0)
        for residual, _, _ in self.of_order(order):
            size = abs(residual)
            bound = bound.max(size)
            if size > reached:
                reached = size
        return Sizes(bound.abs_upper(), reached)

    def table(self, order: int) -> TreeTable:
        """The table whose ids ``of_order`` gives."""
        return TreeTable.of(self._admissible, order)

    def of_order(self, order: int, share: int = 1) -> list[tuple[arb, arb, int]]:
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
            where = stems * len(segment.branches) + table.branch[ids] - segment.branches.start
            trees = zip(where.tolist(), segment.ids, table.gamma[ids].tolist(), strict=True)
            for i, u, gamma in trees:
                if gamma not in required:
                    required[gamma] = share / arb(gamma)
                yield values[i] - required[gamma], required[gamma], u

    def _values(self, table: TreeTable, segment: Segment) -> Row:
        """b_lᵀ 𝒜^[u] for every stem with every branch, stem by stem."""
        b = self.enclosure.b[segment.root].entries()
        stems = self.stems(table, segment)
        if len(stems) < len(segment.branches):  # the weights and A go where they are fewer
            left = arb_mat([times(row, b) for row in stems])
            left *= self.enclosure.A[self.rows[segment.root], segment.branch_root]
            branches = self.of(table, segment.branch_order, segment.branch_root)
        else:
            left = arb_mat(stems)
            branches = [times(row, b) for row in self.branches(table, segment)]
        return (left * arb_mat(branches).transpose()).entries()

    def _part(self, vectors: Rows, places: Column) -> Rows:
        return [vectors[i] for i in places.tolist()]

    def _vertex(self, l: int) -> Rows:
        return [[arb(1)] * self.enclosure.stages[self.rows[l]]]

    def _image(self, space: int, m: int, vectors: Rows) -> Rows:
        return (arb_mat(vectors) * self.enclosure.A[space, m].transpose()).tolist()

    def _product(self, space: int, stems: Rows, branches: Rows) -> Rows:  # noqa: ARG002
        return list(map(times, stems, branches))

    def _joined(self, parts: list[Rows]) -> Rows:
        return list(chain.from_iterable(parts))


FEW_TREES = 50_000
"""Up to so many trees an order is decided by listing them; beyond, spans are tried first."""
MOST_TREES = 500_000
"""Beyond so many trees of an order they are not listed at all."""
FEW_WITNESSES = 2_000
"""Up to so many trees the one that fails by most is sought, after one that fails."""
FEW_DOUBTS = 200
"""So many residuals are held against what rounding can do one by one."""

TOO_MANY = "there are too many trees to decide"

Means: TypeAlias = Literal["exact", "trees", "spans"]
"""How an order was decided: conditions hold exactly; every tree was evaluated; by bounds on all
trees.
"""

_Doubt: TypeAlias = tuple[arb, arb, int]
"""The |residual| and the residual of a tree, and its id."""


class RoundedOrder(Shown, FrozenBut):
    """The outcome: every condition up to ``order`` is met within ``tolerance``.

    Attributes:
        order: the largest such order, a lower bound where there is no witness.
        tolerance: t > 0, the rounding of the coefficients.
        witness: a tree of the next order whose residual is larger than rounding can make it; its
            value is exact.
        undecided: why the next order is not decided; empty where it is, or where the search
            stopped at its limit.
        sizes: for each order 1, 2, … that was decided a bound on all |residuals|; for the order
            that fails, the |residual| of the witness.
        means: what decided each of these orders.
    """

    besides = frozenset({"sizes"})

    order: int
    tolerance: fmpq
    witness: Witness | None
    undecided: str = ""
    sizes: tuple[arb, ...] = ()
    means: tuple[Means, ...] = ()

    def __repr__(self) -> str:
        least = "at least " if self.is_lower_bound else ""
        return f"<RoundedOrder {least}{self.order} within {decimal(self.tolerance)}>"

    @property
    def is_lower_bound(self) -> bool:
        """Whether nothing is known to fail."""
        return self.witness is None

    @property
    def largest_residual(self) -> arb:
        """A bound on all |residuals| up to ``order``."""
        bound = arb(0)
        for size in self.sizes[: self.order]:
            bound = bound.max(size)
        return bound


@doing("order within the tolerance")
def find_order_within(
    rounded: RoundedTableau, limit: int = DEFAULT_LIMIT, exact: Order | None = None
) -> RoundedOrder:
    """The largest r ≤ ``limit`` for which all conditions of order ≤ r are met within the rounding.

    Args:
        rounded: a tableau with its radii; its coupling graph decides which trees count.
        limit: the order at which to stop.
        exact: what ``find_order`` gives for this tableau and limit, where that is known.
    """
    exact = exact or find_order(rounded.tableau, limit)
    verdicts = [Verdict(arb(0), "exact")] * exact.order
    if exact.witness is None or rounded.obstacle:
        return _outcome(rounded, verdicts, rounded.obstacle)
    search = Conditions(rounded)
    if search.fails(exact.witness):
        witness = search.largest(exact.witness)
        return _outcome(rounded, [*verdicts, Verdict(arb(0), "exact", witness)])
    while len(verdicts) < limit:
        verdict = search.of(len(verdicts) + 1)
        if verdict is None:
            return _outcome(rounded, verdicts, TOO_MANY)
        verdicts.append(verdict)
        if verdict.witness is not None:
            break
    return _outcome(rounded, verdicts)


def _outcome(
    rounded: RoundedTableau, verdicts: Sequence[Verdict], undecided: str = ""
) -> RoundedOrder:
    met = [x.size for x in verdicts if x.witness is None]
    failing = [x.witness for x in verdicts if x.witness is not None]
    return RoundedOrder(
        len(met),
        rounded.tolerance,
        failing[0] if failing else None,
        undecided,
        (*met, *(abs(to_ball(x.residual)) for x in failing)),
        tuple(x.means for x in verdicts),
    )


class Verdict(Frozen, eq=False):
    """What became of the conditions of an order: ``size`` bounds all |residuals| where they are
    met; otherwise there is a witness.
    """

    size: arb
    means: Means
    witness: Witness | None = None


class Conditions:
    """The conditions b_lᵀ 𝒜^[u] = share/γ(u) of one rounded tableau, an order at a time.

    Args:
        rounded: the tableau with its radii.
        most: beyond so many trees of an order they are not listed.
    """

    def __init__(self, rounded: RoundedTableau, most: int = MOST_TREES) -> None:
        self.rounded = rounded
        self.most = most
        self.admissible = Admissible.of(rounded.tableau.size, *coupling_graph(rounded.tableau))

    @cached_property
    def effects(self) -> Effects:
        return Effects(self.rounded)

    @cached_property
    def residuals(self) -> TreeResiduals:
        return TreeResiduals(self.rounded.tableau, self.rounded.enclosure)

    @cached_property
    def corner(self) -> TreeResiduals:
        return TreeResiduals(self.rounded.tableau, self.rounded.corner)

    @cached_property
    def spans(self) -> ApproximateSpans:
        # members as short as the tolerance cost bits
        enclosure = enclose_tableau(self.rounded.tableau, 6 * self.rounded.bits)
        return ApproximateSpans(self.rounded.tableau, enclosure, arb(self.rounded.tolerance))

    def fails(self, witness: Witness) -> bool:
        """Whether rounding does not explain the residual of a tree."""
        return not within(witness.residual, self.effects.bound(witness.tree))

    def largest(self, witness: Witness) -> Witness:
        """The condition that fails by most of the order of one that fails; this one where they are
        many.
        """
        order = witness.tree.order
        if sum(counts_upto(self.admissible, order)[-1]) > FEW_WITNESSES:
            return witness
        found = self._by_trees(order, 1).witness
        return found or witness

    def of(self, order: int, share: int = 1) -> Verdict | None:
        """All conditions of an order; None where there are too many trees to decide."""
        count = sum(counts_upto(self.admissible, order)[-1])
        if count > FEW_TREES and share:
            verdict = self._by_bushes(order) or self._by_spans(order)
            if verdict is not None:
                return verdict
        return None if count > self.most else self._by_trees(order, share)

    def _least_effect(self, order: int) -> arb:
        """For each tree of an order its weight |b_lᵀ 𝒜^[u]|, times this, changes by no less.

        The derivatives of the weight, each times its coefficient, sum to the weight over all
        weights b and to as much again for each edge of the tree over all blocks.
        """
        rounded = self.rounded
        weights = [
            (x.entries(), off) for x, off in zip(rounded.enclosure.b, rounded.b, strict=True)
        ]
        blocks = [
            (rounded.enclosure.A[key].entries(), [x for row in rows for x in row])
            for key, rows in rounded.A.items()
        ]
        return _least_ratio(weights) + (order - 1) * _least_ratio(blocks)

    def _by_trees(self, order: int, share: int) -> Verdict:
        bound = arb(0)
        with ctx.workprec(self.rounded.bits):
            least = self._least_effect(order)
            doubtful: list[_Doubt] = []
            for residual, required, tree_id in self.residuals.of_order(order, share):
                size = abs(residual)
                bound = bound.max(size)
                if not size <= least * (required - size):
                    doubtful.append((size, residual, tree_id))
            if len(doubtful) > FEW_DOUBTS:
                # those that one method of the box does not explain: that with the largest
                # coefficients, whose residuals differ by no more than rounding can make them
                moved = {u: residual for residual, _, u in self.corner.of_order(order, share)}
                doubtful = [x for x in doubtful if not x[0] <= abs(moved[x[2]] - x[1])]
        doubtful.sort(key=lambda x: float(x[0].mid()), reverse=True)
        table = self.residuals.table(order)
        witness = self._first_failing(((size, table.tree(u)) for size, _, u in doubtful), share)
        return Verdict(bound.abs_upper(), "trees", witness)

    def _by_bushes(self, order: int) -> Verdict | None:
        """That the order fails, where a quadrature condition does: a bush of leaves of one colour.

        It is examined before the many, as methods of high order seldom integrate better.
        """
        tableau = self.rounded.tableau
        for l in twin_roots(tableau):
            for m in range(tableau.size):
                bush = Tree(l, (Tree(m),) * (order - 1))
                if is_admissible(tableau, bush):
                    witness = Witness(bush, elementary_weight(tableau, bush), fmpq(1, bush.density))
                    if self.fails(witness):
                        return Verdict(arb(0), "trees", witness)
        return None

    def _by_spans(self, order: int) -> Verdict | None:
        """The conditions of an order where a bound on all decides, or one tree that fails."""
        hulls = self.spans.sizes(order)
        with ctx.workprec(self.rounded.bits):
            # no residual is a larger part of the weight that is required
            part = hulls.bound * order
            if part <= self._least_effect(order) * (1 - part):
                return Verdict(hulls.bound, "spans")
        witness = self._first_failing(hulls.members, 1)
        return None if witness is None else Verdict(hulls.bound, "spans", witness)

    def _first_failing(self, trees: Iterable[tuple[arb, Tree]], share: int) -> Witness | None:
        """The first tree whose |residual|, in a ball beside it, rounding does not explain."""
        for size, tree in trees:
            if size <= self.effects.effect(tree):
                continue
            weight = elementary_weight(self.rounded.tableau, tree)
            witness = Witness(tree, weight, fmpq(share, tree.density))
            if self.fails(witness):
                return witness
        return None


def _least_ratio(parts: Sequence[tuple[Row, Row]]) -> arb:
    """The least radius, each in units of its coefficient, of the nonzero ones."""
    least: arb | None = None
    for entries, radii in parts:
        for x, radius in zip(entries, radii, strict=True):
            if not x.is_zero():
                ratio = (radius / x.abs_upper()).abs_lower()
                least = ratio if least is None else least.min(ratio)
    return arb(0) if least is None else least
