"""Weights at the stages besides b, compared with the values they should give, tree by tree.

The elementary weights of a functional should be 1/γ(u) at one order at most, and vanish at all
others: b − b̂, the coefficients of one power of θ in dense output, a slope. As with b, spanning
trees (``order.certificate``) decide it, or all trees for rounded numbers (``order.rounded``).

The error estimate h Σ (b_i − b̂_i) k_i has the B-series coefficients (b − b̂)_lᵀ 𝒜^[u] / σ(u); they
vanish up to the smaller of the two orders, and the first that do not are its leading term. Hairer,
Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.4.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from flint import ctx, fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector, dot
from garkcli.frozen import Frozen
from garkcli.order.admissible import count_conditions, elementary_weight
from garkcli.order.certificate import StageSpans, Witness, required_of, witness_of
from garkcli.order.constants import ErrorConstants, estimate_constants
from garkcli.order.meant import AnyTableau, printed
from garkcli.order.tolerance import within
from garkcli.tableau.embedded import Weights, with_weights
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded import Near

MOST_TREES = 50_000


class Functional(Frozen):
    """Weights whose elementary weights should be 1/γ(u) at order ``exact_at``, and 0 elsewhere."""

    weights: Weights
    exact_at: int | None = None

    def share(self, order: int) -> int:
        return int(order == self.exact_at)


class FailedCondition(Frozen):
    number: int
    witness: Witness


class TooManyTrees(Exception):
    def __init__(self, order: int) -> None:
        super().__init__(f"{order}: more than {MOST_TREES} trees")
        self.order = order


def first_failure(
    method: AnyTableau | Near,
    functionals: Sequence[Functional],
    orders: Iterable[int],
    spans: StageSpans | None = None,
) -> FailedCondition | None:
    """Returns the first condition, by order, that is not met; None if all are. Raises TooManyTrees
    for a rounded method if an order has more than ``MOST_TREES``.
    """
    if isinstance(method, Tableau):
        return _first_exact(method, functionals, orders, spans)
    from garkcli.order.rounded import tree_missed  # balls, which exact methods do without

    judges = [with_weights(method.near, functional.weights) for functional in functionals]
    for order in orders:
        if count_conditions(method.near, order) > MOST_TREES:
            raise TooManyTrees(order)
        for number, (judge, functional) in enumerate(zip(judges, functionals, strict=True)):
            share = functional.share(order)
            tree = tree_missed(judge, order, share, method.grain)
            if tree is not None:
                value = elementary_weight(judge, tree)
                return FailedCondition(number, Witness(tree, value, required_of(tree, share)))
    return None


def _first_exact(
    tableau: Tableau,
    functionals: Sequence[Functional],
    orders: Iterable[int],
    spans: StageSpans | None,
) -> FailedCondition | None:
    spans = spans or StageSpans(tableau)
    for order in orders:
        for l, forest in spans.members(order, tableau.roots):
            for number, functional in enumerate(functionals):
                value = dot(functional.weights[l], forest.vector)
                share = functional.share(order)
                own = order - tableau.roots[l]
                if value != share * forest.required(tableau.colours[l].kind, own):
                    tree = tableau.tree(l, forest.branches)
                    return FailedCondition(number, witness_of(tree, value, share))
    return None


class Estimator(Frozen):
    """The error estimate of embedded weights.

    Attributes:
        sums: Σ (b_i − b̂_i) of each colour, zero if both satisfy the condition of order 1.
        order: the estimate is O(h^order), no better; None if undecided.
        constants: the norms of its coefficients at that order; None for too many trees.
    """

    sums: Vector
    order: int | None
    constants: ErrorConstants | None
    is_zero: bool


class KnownOrders(Frozen):
    """The known orders of b and b̂ before their difference is examined. The estimate vanishes up to
    ``least``; if they ``differ``, it has the next order. ``limit`` is the largest order of trees to
    examine.
    """

    least: int
    differ: bool
    limit: int


def estimator(
    method: AnyTableau, embedded: Weights, orders: KnownOrders, spans: StageSpans | None = None
) -> Estimator:
    tableau = printed(method)
    rows = _differences(tableau, embedded)
    known, grain, bits = rows, ZERO, ctx.prec
    if not isinstance(method, Tableau):
        grain, bits = method.grain, method.search.bits
        with ctx.workprec(bits):  # zeros are zeros to many bits alone
            known = _differences(method.near, method.further.embedded or ())
    with ctx.workprec(bits):
        sums = tuple(_unless_within(sum(row, start=ZERO), grain) for row in known)
    if not any(x for row in rows for x in row):
        return Estimator(sums, None, None, is_zero=True)
    difference = with_weights(tableau, tuple(rows))
    order: int | None = orders.least + 1
    if not orders.differ:
        larger = range(orders.least + 1, orders.limit + 1)
        order = _leading(method, Functional(tuple(known)), larger, spans)
    constants = None
    if order is not None:
        constants = estimate_constants(difference, order, is_rounded=method is not tableau)
    return Estimator(sums, order, constants, is_zero=False)


def _unless_within(number: Number, grain: fmpq) -> Number:
    return ZERO if within(number, grain) else number


def _differences(tableau: Tableau, embedded: Weights) -> list[Vector]:
    return [
        tuple(b - other for b, other in zip(colour.b, row, strict=True))
        for colour, row in zip(tableau.colours, embedded, strict=True)
    ]


def _leading(
    method: AnyTableau, difference: Functional, orders: range, spans: StageSpans | None
) -> int | None:
    try:
        failure = first_failure(method, [difference], orders, spans)
    except TooManyTrees:
        return None
    return None if failure is None else failure.witness.tree.order
