"""What embedded weights and dense output are good for: their orders, the estimate of the error."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.analysis import nonautonomous
from garkcli.frozen import Frozen
from garkcli.order.certificate import StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.dense import DenseOrder, Slopes, dense_order, ends_at_step, slopes
from garkcli.order.functionals import Estimator, Orders, estimator
from garkcli.tableau.embedded import DenseOutput, Further, Weights, with_weights
from garkcli.tableau.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau


class EmbeddedFacts(Frozen):
    """The truth about embedded weights.

    Attributes:
        tableau: the method with them for b.
        order: its order.
        nonautonomous_order: that on problems ẏ = f(t, y) with the nodes as printed; None where that
            has no meaning.
        estimator: the estimate of the error that they give.
    """

    tableau: Tableau
    order: AnyOrder
    nonautonomous_order: AnyOrder | None
    estimator: Estimator


class DenseFacts(Frozen):
    """The truth about dense output.

    Attributes:
        order: for all θ.
        degree: of its polynomials.
        ends_at_step: whether b(1) = b.
        slopes: whether its slope is continuous from step to step.
    """

    order: DenseOrder
    degree: int
    ends_at_step: bool
    slopes: Slopes

    @property
    def is_smooth(self) -> bool | None:
        """Whether the output and its slope are continuous from step to step; None where that is
        not decided.
        """
        return self.ends_at_step and self.slopes.are_continuous


class FurtherFacts(Frozen):
    """The truth about the further weights of a method, each None where it has none."""

    embedded: EmbeddedFacts | None = None
    dense: DenseFacts | None = None


class _Method(Frozen):
    """A method whose own orders are known."""

    method: AnyTableau
    order: AnyOrder
    inconsistent: Sequence[tuple[int, int]]
    limit: int
    spans: StageSpans | None


def further_facts(
    method: AnyTableau,
    further: Further,
    order: AnyOrder,
    inconsistent: Sequence[tuple[int, int]],
    limit: int,
    spans: StageSpans | None = None,
) -> FurtherFacts:
    """Decide all that ``gark check`` reports of embedded weights and dense output.

    Args:
        method: the tableau, with its rounding where it is rounded.
        further: its further weights.
        order: its own order.
        inconsistent: the blocks whose row sums are not the nodes.
        limit: where the search for orders stops.
        spans: of the stage vectors, where some are known.
    """
    known = _Method(method, order, inconsistent, limit, spans)
    embedded, dense = None, None
    if further.embedded is not None:
        embedded = _embedded(known, further.embedded)
    if further.dense is not None:
        dense = _dense(known, further.dense)
    return FurtherFacts(embedded, dense)


def _embedded(known: _Method, weights: Weights) -> EmbeddedFacts:
    method = known.method
    if isinstance(method, Tableau):
        changed: AnyTableau = with_weights(method, weights)
    else:
        changed = method.with_weights(weights)
    order = order_of(changed, known.limit, known.spans)
    timed_order = nonautonomous(changed, order, known.inconsistent, known.limit)
    found = estimator(method, weights, _orders(order, known.order, known.limit), known.spans)
    return EmbeddedFacts(printed(changed), order, timed_order, found)


def _orders(one: AnyOrder, other: AnyOrder, limit: int) -> Orders:
    """What two orders tell of the difference of the two rows of weights."""
    smaller = one if one.order < other.order else other
    return Orders(smaller.order, one.order != other.order and not smaller.is_lower_bound, limit)


def _dense(known: _Method, dense: DenseOutput) -> DenseFacts:
    method = known.method
    return DenseFacts(
        order=dense_order(method, dense, known.limit, known.spans),
        degree=dense.degree,
        ends_at_step=ends_at_step(method, dense),
        slopes=slopes(method, dense),
    )
