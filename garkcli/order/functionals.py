"""Weights at the stages of a method besides b, held against what they should give, tree by tree.

A functional is a row of weights a colour. At one order, or at none, its elementary weights should
be those of the exact solution, 1/γ(u), and at all others they should vanish: of the difference of
two rows of weights, of the coefficients of one power of θ in dense output, of a slope. As with b
that is a condition on all trees of an order at once, decided on the spanning ones
(``order.certificate``), and of rounded coefficients on all trees (``order.rounded``).

The error estimate h Σ (b_i − b̂_i) k_i of a method and its embedded weights b̂ has the B-series
coefficients (b − b̂)_lᵀ 𝒜^[u] / σ(u); they vanish up to the smaller of the two orders, and the first
that do not are its leading term. Hairer, Nørsett & Wanner, *Solving Ordinary Differential
Equations I*, II.4.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from flint import ctx, fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector, dot
from garkcli.frozen import Frozen
from garkcli.order.certificate import StageSpans, Witness, required_of, witness_of
from garkcli.order.conditions import count_conditions, elementary_weight
from garkcli.order.constants import ErrorConstants, estimate_constants
from garkcli.order.meant import AnyTableau, printed
from garkcli.order.tolerance import within
from garkcli.tableau.embedded import Weights, with_weights
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded import Near

MOST_TREES = 50_000
"""Most trees of an order whose weights are enclosed one by one."""


class Functional(Frozen):
    """Weights at the stages, and what they should give.

    Attributes:
        weights: a row per colour.
        exact_at: the order at which their elementary weights should be 1/γ(u); at all others, and
            everywhere where it is None, they should be zero.
    """

    weights: Weights
    exact_at: int | None = None

    def share(self, order: int) -> int:
        """1 where the weights of an order should be those of the exact solution, else 0."""
        return int(order == self.exact_at)


class Failure(Frozen):
    """A functional that does not give what it should: which one in the sequence, and the tree."""

    number: int
    witness: Witness


class Undecided(Exception):
    """More trees of an order, its argument, than are examined one by one."""

    def __init__(self, order: int) -> None:
        super().__init__(f"{order}: more than {MOST_TREES} trees")
        self.order = order


def first_failure(
    method: AnyTableau | Near,
    functionals: Sequence[Functional],
    orders: Iterable[int],
    spans: StageSpans | None = None,
) -> Failure | None:
    """The first condition that is not met, exactly or as far as rounding explains, order by order;
    None where all are.

    Args:
        method: whose stages they are at.
        functionals: each is held against every tree; of a rounded method those of the method that
            it is taken to be.
        orders: of the trees.
        spans: of the stage vectors, where some are known.

    Raises:
        Undecided: of a rounded method an order has more than ``MOST_TREES`` trees.
    """
    if isinstance(method, Tableau):
        return _first_exact(method, functionals, orders, spans)
    from garkcli.order.rounded import tree_missed  # balls, which exact methods do without

    judges = [with_weights(method.near, functional.weights) for functional in functionals]
    for order in orders:
        if count_conditions(method.near, order) > MOST_TREES:
            raise Undecided(order)
        for number, (judge, functional) in enumerate(zip(judges, functionals, strict=True)):
            share = functional.share(order)
            tree = tree_missed(judge, order, share, method.grain)
            if tree is not None:
                value = elementary_weight(judge, tree)
                return Failure(number, Witness(tree, value, required_of(tree, share)))
    return None


def _first_exact(
    tableau: Tableau,
    functionals: Sequence[Functional],
    orders: Iterable[int],
    spans: StageSpans | None,
) -> Failure | None:
    spans = spans or StageSpans(tableau)
    for order in orders:
        for l, forest in spans.members(order, tableau.roots):
            for number, functional in enumerate(functionals):
                value = dot(functional.weights[l], forest.vector)
                share = functional.share(order)
                own = order - tableau.roots[l]
                if value != share * forest.required(tableau.colours[l].kind, own):
                    tree = tableau.tree(l, forest.branches)
                    return Failure(number, witness_of(tree, value, share))
    return None


class Estimator(Frozen):
    """The estimate of the error.

    Attributes:
        sums: Σ (b_i − b̂_i) of each colour, zero where both rows meet the condition of order 1.
        order: of the first trees at which the estimate is not zero, so that it is O(h^order); None
            where none was found.
        constants: the norms of its coefficients at that order; None where there are too many trees.
        is_zero: whether b̂ is b, and the estimate always zero.
    """

    sums: Vector
    order: int | None
    constants: ErrorConstants | None
    is_zero: bool


class Orders(Frozen):
    """What is known of the orders of b and b̂ when their difference is examined.

    Attributes:
        least: the smaller one; up to it the estimate vanishes.
        differ: whether one of them is known to be larger: then the next order shows in it.
        limit: the largest order of trees that are examined.
    """

    least: int
    differ: bool
    limit: int


def estimator(
    method: AnyTableau, embedded: Weights, orders: Orders, spans: StageSpans | None = None
) -> Estimator:
    """The estimate that embedded weights give.

    Args:
        method: the tableau, with its rounding where it is rounded, which the estimate has to
            exceed.
        embedded: a row of weights a colour.
        orders: of both rows of weights.
        spans: of the stage vectors, where some are known.
    """
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
    """B − b̂, a row per colour."""
    return [
        tuple(b - other for b, other in zip(colour.b, row, strict=True))
        for colour, row in zip(tableau.colours, embedded, strict=True)
    ]


def _leading(
    method: AnyTableau, difference: Functional, orders: range, spans: StageSpans | None
) -> int | None:
    """The first order of trees at which the estimate does not vanish."""
    try:
        failure = first_failure(method, [difference], orders, spans)
    except Undecided:
        return None
    return None if failure is None else failure.witness.tree.order
