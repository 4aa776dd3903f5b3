"""The error estimate h Σ (b_i − b̂_i) k_i of a method and its embedded weights b̂.

Its B-series has the coefficients (b − b̂)_lᵀ 𝒜^[u] / σ(u); they vanish up to the smaller of the two
orders, and the first that do not are its leading term. Hairer, Nørsett & Wanner, *Solving Ordinary
Differential Equations I*, II.4.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.order.certificate import StageSpans
from garkcli.order.constants import ErrorConstants, estimate_constants
from garkcli.order.functionals import Functional, Undecided, first_failure
from garkcli.tableau.embedded import Weights, with_weights
from garkcli.tableau.meant import AnyTableau, printed


@dataclass(frozen=True)
class Estimator:
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


@dataclass(frozen=True)
class Orders:
    """What is known of the orders of b and b̂ when their difference is looked at.

    Attributes:
        least: the smaller one; up to it the estimate vanishes.
        differ: whether one of them is known to be larger: then the next order shows in it.
        limit: the largest order of trees that are looked at.
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
    rows, terms = [], []
    for colour, row in zip(tableau.colours, embedded, strict=True):
        pairs = list(zip(colour.b, row, strict=True))
        rows.append(tuple(b - other for b, other in pairs))
        terms.append(tuple(fmpq(bool(b) + bool(other)) for b, other in pairs))
    sums = tuple(_sum(row) for row in rows)
    if not any(x for row in rows for x in row):
        return Estimator(sums, None, None, is_zero=True)
    difference = with_weights(tableau, tuple(rows))
    order: int | None = orders.least + 1
    if not orders.differ:
        larger = range(orders.least + 1, orders.limit + 1)
        order = _leading(method, Functional(tuple(rows), terms=tuple(terms)), larger, spans)
    constants = None
    if order is not None:
        constants = estimate_constants(difference, order, is_rounded=method is not tableau)
    return Estimator(sums, order, constants, is_zero=False)


def _sum(row: Vector) -> Number:
    return sum(row, start=ZERO)


def _leading(
    method: AnyTableau, difference: Functional, orders: range, spans: StageSpans | None
) -> int | None:
    """The first order of trees at which the estimate does not vanish."""
    try:
        failure = first_failure(method, [difference], orders, spans)
    except Undecided:
        return None
    return None if failure is None else failure.witness.tree.order
