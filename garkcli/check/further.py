"""The orders of embedded weights and dense output, and the error estimate."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.frozen import Frozen
from garkcli.order.certificate import StageSpans
from garkcli.order.deciding import AnyOrder, nonautonomous, order_of
from garkcli.order.dense import DenseOrder, Slopes, dense_order, ends_at_step, slopes
from garkcli.order.functionals import Estimator, KnownOrders, estimator
from garkcli.order.meant import AnyTableau, as_dense, as_embedded, printed, with_further
from garkcli.tableau.embedded import DenseOutput, Further, Weights
from garkcli.tableau.tableau import Tableau


class EmbeddedFacts(Frozen):
    """The orders of embedded weights, and their error estimate.

    ``tableau`` is the method with them in place of b; ``nonautonomous_order``, on problems ẏ = f(t,
    y) with the nodes as printed, is None if not applicable.
    """

    tableau: Tableau
    order: AnyOrder
    nonautonomous_order: AnyOrder | None
    estimator: Estimator


class DenseFacts(Frozen):
    """The order, for all θ, and the continuity of dense output.

    ``ends_at_step`` says that b(1) = b.
    """

    order: DenseOrder
    degree: int
    ends_at_step: bool
    slopes: Slopes

    @property
    def is_smooth(self) -> bool | None:
        """Whether the output and its slope are continuous from step to step; None if undecided."""
        return self.ends_at_step and self.slopes.are_continuous


def further_facts(
    method: AnyTableau,
    further: Further,
    order: AnyOrder,
    inconsistent: Sequence[tuple[int, int]],
    limit: int,
    spans: StageSpans | None = None,
) -> tuple[EmbeddedFacts | None, DenseFacts | None]:
    """Returns the facts about embedded weights and about dense output, each None if the method has
    none.

    ``order`` is that of the method, ``inconsistent`` the blocks whose row sums are not the nodes,
    ``spans`` the stage vectors known already.
    """
    embedded, facts = None, None
    weights, dense = further.embedded, further.dense
    if weights is not None:
        changed = as_embedded(method, weights)
        other = order_of(changed, limit, spans)
        timed_order = nonautonomous(changed, other, inconsistent, limit)
        error = estimate(method, weights, (order, other), limit, spans)
        embedded = EmbeddedFacts(printed(changed), other, timed_order, error)
    if dense is not None:
        facts = dense_facts(method, dense, limit, spans)
    return embedded, facts


def estimate(
    method: AnyTableau,
    weights: Weights,
    orders: tuple[AnyOrder, AnyOrder],
    limit: int,
    spans: StageSpans | None = None,
) -> Estimator:
    """Returns the error estimate of embedded weights.

    ``orders`` are those of the method and with these weights.
    """
    order, other = orders
    smaller = other if other.order < order.order else order
    differ = other.order != order.order and not smaller.is_lower_bound
    sought = KnownOrders(smaller.order, differ, limit)
    return estimator(with_further(method) or method, weights, sought, spans)


def dense_facts(
    method: AnyTableau, dense: DenseOutput, limit: int, spans: StageSpans | None = None
) -> DenseFacts:
    """Returns the facts about dense output."""
    whole = with_further(method) or method
    return DenseFacts(
        order=dense_order(as_dense(method), dense, limit, spans),
        degree=dense.degree,
        ends_at_step=ends_at_step(whole, dense),
        slopes=slopes(whole, dense),
    )
