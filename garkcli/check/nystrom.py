"""The analysis of a Nyström method."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

from flint import fmpq

from garkcli.check.further import DenseFacts, estimate
from garkcli.check.order_facts import LinearSubject
from garkcli.constructions.nystrom import POSITIONS, VELOCITIES, Which, seen
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.dense import (
    DenseOrder,
    Ends,
    dense_order,
    ends_at_step,
    slope_at_one,
    slopes_where,
)
from garkcli.order.functionals import Estimator
from garkcli.order.meant import AnyTableau, as_dense, as_embedded, meant, printed, with_further
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, DenseOutput, Further
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

VIEWS: dict[str, Which] = {"position-order": "in_positions", "velocity-order": "in_velocities"}
"""The orders of the two components, by their claims."""
OF_OSCILLATOR = frozenset({"p-stable", "i-stable"})
"""Properties of the partitioned method with the same steps."""
_NO_PROPERTY = Reason("a property of Runge–Kutta methods, which this Nyström method is not")


class NystromOrders(Frozen):
    """The orders of weights at the stages of a Nyström method; ``order`` is the smaller one of both
    components.
    """

    tableau: Tableau
    order: AnyOrder
    position_order: AnyOrder
    velocity_order: AnyOrder

    @classmethod
    def of(cls, method: AnyTableau, limit: int, spans: StageSpans | None = None) -> NystromOrders:
        order = order_of(method, limit, spans)
        q, v = (order_of(seen(method, which), limit, spans) for which in VIEWS.values())
        return cls(printed(method), order, q, v)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau]:
        """Returns the order that a claim is about and its tableau."""
        found: AnyOrder = getattr(self, claim.replace("-", "_"))
        if claim == "order":
            return found, self.tableau
        return found, printed(seen(self.tableau, VIEWS[claim]))


class NystromDense(DenseFacts):
    """The orders of dense output in q and q′, for all θ. The slope of q should be q′ at both
    ends.
    """

    position_order: DenseOrder
    velocity_order: DenseOrder

    @classmethod
    def of(
        cls, method: AnyTableau, dense: DenseOutput, limit: int, spans: StageSpans | None
    ) -> NystromDense:
        whole, known = with_further(method) or method, as_dense(method)
        return cls(
            order=dense_order(known, dense, limit, spans),
            degree=dense.degree,
            ends_at_step=ends_at_step(whole, dense),
            slopes=slopes_where(whole, dense, _ends_of_slope),
            position_order=dense_order(seen(known, "in_positions"), dense, limit, spans),
            velocity_order=dense_order(seen(known, "in_velocities"), dense, limit, spans),
        )


def _ends_of_slope(dense: DenseOutput, tableau: Tableau) -> Ends:
    """Returns the slope at the ends; it is q′ + h Σ b̄_i'(θ) g_i, so b̄'(0) = 0 and b̄'(1) = b."""
    b = tableau.colours[VELOCITIES].b
    zeros = (ZERO,) * len(b)
    first = dense.coefficients(1)[POSITIONS]
    last = slope_at_one(dense.weights)[POSITIONS]
    off = tuple(x - y for x, y in zip(last, b, strict=True))
    return (zeros, first, (ZERO,)), (zeros, off, (ZERO,))


class EmbeddedNystrom(Frozen):
    """The orders of embedded weights in place of b̄ and b, and their error estimate."""

    orders: NystromOrders
    estimator: Estimator


class NystromAnalysis(Shown, Frozen):
    """The orders of a Nyström method.

    Attributes:
        tableau: the tableau of the method.
        orders: its orders.
        limit: where the search for orders stopped.
        tolerance: the rounding within which all of this holds; None for exact coefficients.
        embedded: the facts about its embedded weights, or None.
        dense: the facts about its dense output, or None.
        further: its embedded and dense weights.
    """

    tableau: Tableau
    orders: NystromOrders
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedNystrom | None = None
    dense: NystromDense | None = None
    further: Further = NOTHING

    kind: ClassVar[str] = "a Nyström method"

    @property
    def order(self) -> AnyOrder:
        """The order in both components, the smaller one."""
        return self.orders.order

    @cached_property
    def subject(self) -> LinearSubject:
        method = seen(meant(self.tableau, self.tolerance), "partitioned")
        return LinearSubject.of(method, self.order.order, self.limit, OF_OSCILLATOR, _NO_PROPERTY)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """Returns the order that a claim is about and its tableau; None for other claims."""
        whose: NystromOrders | None = self.orders
        if claim.startswith("embedded-"):
            whose = None if self.embedded is None else self.embedded.orders
            claim = claim.removeprefix("embedded-")
        return whose.view(claim) if whose and claim in {"order", *VIEWS} else None

    def __repr__(self) -> str:
        found = self.orders
        q, v = found.position_order.order, found.velocity_order.order
        return f"<NystromAnalysis order {found.order.order}, q {q}, q′ {v}>"


def analyse_nystrom(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> NystromAnalysis:
    """Decides all that ``gark check`` reports of a Nyström method, with orders up to ``limit``."""
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if method is tableau else None
    orders = NystromOrders.of(method, limit, spans)
    embedded = None
    if further.embedded is not None:
        other = NystromOrders.of(as_embedded(method, further.embedded), limit, spans)
        found = estimate(method, further.embedded, (orders.order, other.order), limit, spans)
        embedded = EmbeddedNystrom(other, found)
    dense = None
    if further.dense is not None:
        dense = NystromDense.of(method, further.dense, limit, spans)
    return NystromAnalysis(tableau, orders, limit, tolerance, embedded, dense, further)
