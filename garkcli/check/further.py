"""What embedded weights and dense output are good for: their orders, the estimate of the error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.order.certificate import StageSpans, find_order
from garkcli.order.dense import DenseOrder, Slopes, dense_order, ends_at_step, slopes
from garkcli.order.estimator import Estimator, Orders, estimator
from garkcli.order.nonautonomous import with_time
from garkcli.tableau.embedded import DenseOutput, Further, Weights, with_weights
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.check.analysis import AnyOrder


@dataclass(frozen=True)
class EmbeddedFacts:
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


@dataclass(frozen=True)
class DenseFacts:
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


@dataclass(frozen=True)
class FurtherFacts:
    """The truth about the further weights of a method, each None where it has none."""

    embedded: EmbeddedFacts | None = None
    dense: DenseFacts | None = None


@dataclass(frozen=True)
class _Method:
    """A method whose own orders are known, with how its coefficients are meant."""

    tableau: Tableau
    order: AnyOrder
    inconsistent: Sequence[tuple[int, int]]
    limit: int
    tolerance: fmpq | None
    spans: StageSpans | None

    def find(self, tableau: Tableau, spans: StageSpans | None = None) -> AnyOrder:
        """The order of another tableau with the same coefficients."""
        if self.tolerance is None:
            return find_order(tableau, self.limit, spans)
        from garkcli.order.rounded import find_order_within

        return find_order_within(tableau, self.tolerance, self.limit)


def further_facts(
    tableau: Tableau,
    further: Further,
    order: AnyOrder,
    inconsistent: Sequence[tuple[int, int]],
    limit: int,
    tolerance: fmpq | None = None,
    spans: StageSpans | None = None,
) -> FurtherFacts:
    """Decide all that ``gark check`` reports of embedded weights and dense output.

    Args:
        tableau: the method.
        further: its further weights.
        order: its own order.
        inconsistent: the blocks whose row sums are not the nodes.
        limit: where the search for orders stops.
        tolerance: the rounding of the coefficients; None for coefficients that are meant exactly.
        spans: of the stage vectors, where some are known.
    """
    method = _Method(tableau, order, inconsistent, limit, tolerance, spans)
    embedded, dense = None, None
    if further.embedded is not None:
        embedded = _embedded(method, further.embedded)
    if further.dense is not None:
        dense = _dense(method, further.dense)
    return FurtherFacts(embedded, dense)


def _embedded(method: _Method, weights: Weights) -> EmbeddedFacts:
    tableau = with_weights(method.tableau, weights)
    order = method.find(tableau, method.spans)
    timed_order: AnyOrder | None = order
    timed = with_time(tableau)
    if timed is None:
        timed_order = None
    elif method.inconsistent:
        timed_order = method.find(timed)
    orders = _orders(order, method.order, method.limit)
    found = estimator(method.tableau, weights, orders, method.tolerance, method.spans)
    return EmbeddedFacts(tableau, order, timed_order, found)


def _orders(one: AnyOrder, other: AnyOrder, limit: int) -> Orders:
    """What two orders tell of the difference of the two rows of weights."""
    smaller = one if one.order < other.order else other
    differ = one.order != other.order and not smaller.is_lower_bound
    return Orders(smaller.order, differ, limit)


def _dense(method: _Method, dense: DenseOutput) -> DenseFacts:
    tableau, tolerance = method.tableau, method.tolerance
    return DenseFacts(
        order=dense_order(tableau, dense, method.limit, tolerance, method.spans),
        degree=dense.degree,
        ends_at_step=ends_at_step(tableau, dense, tolerance or ZERO),
        slopes=slopes(tableau, dense, tolerance),
    )
