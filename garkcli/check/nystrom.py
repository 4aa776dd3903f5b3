"""The analysis of a Nyström method."""

from __future__ import annotations

from functools import cached_property

from flint import fmpq

from garkcli.check.order_facts import ClaimedOrders, DenseFacts, LinearSubject, SeveralOrders
from garkcli.constructions.nystrom import POSITIONS, VELOCITIES, Which, seen
from garkcli.exact.field import ZERO
from garkcli.order import dense as dense_orders
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, as_dense, meant, printed, with_further
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, DenseOutput, Further
from garkcli.tableau.tableau import Tableau

VIEWS: dict[str, Which] = {"position-order": "in_positions", "velocity-order": "in_velocities"}
OF_OSCILLATOR = frozenset({"p-stable", "i-stable"})
_NO_PROPERTY = Reason("a property of Runge–Kutta methods, which this Nyström method is not")


class NystromOrders(ClaimedOrders):
    """The orders of weights at the stages; ``order`` is the smaller one."""

    tableau: Tableau
    position_order: AnyOrder
    velocity_order: AnyOrder

    @classmethod
    def of(cls, method: AnyTableau, limit: int, spans: StageSpans | None = None) -> NystromOrders:
        order = order_of(method, limit, spans)
        q, v = (order_of(seen(method, which), limit, spans) for which in VIEWS.values())
        return cls(order, printed(method), q, v)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau]:
        order: AnyOrder = getattr(self, claim.replace("-", "_"))
        if claim == "order":
            return order, self.tableau
        return order, printed(seen(self.tableau, VIEWS[claim]))


class NystromDense(DenseFacts):
    """The orders of dense output in q and q′, for all θ; the slope of q should be q′."""

    position_order: dense_orders.DenseOrder
    velocity_order: dense_orders.DenseOrder

    @classmethod
    def of(
        cls, method: AnyTableau, dense: DenseOutput, limit: int, spans: StageSpans | None
    ) -> NystromDense:
        whole, known = with_further(method) or method, as_dense(method)
        return cls(
            order=dense_orders.dense_order(known, dense, limit, spans),
            degree=dense.degree,
            ends_at_step=dense_orders.ends_at_step(whole, dense),
            slopes=dense_orders.slopes_where(whole, dense, _ends_of_slope),
            position_order=dense_orders.dense_order(
                seen(known, "in_positions"), dense, limit, spans
            ),
            velocity_order=dense_orders.dense_order(
                seen(known, "in_velocities"), dense, limit, spans
            ),
        )


def _ends_of_slope(dense: DenseOutput, tableau: Tableau) -> dense_orders.Ends:
    """Returns the slope at the ends; it is q′ + h Σ b̄_i'(θ) g_i, so b̄'(0) = 0 and b̄'(1) = b."""
    b = tableau.colours[VELOCITIES].b
    zeros = (ZERO,) * len(b)
    first = dense.coefficients(1)[POSITIONS]
    last = dense_orders.slope_at_one(dense.weights)[POSITIONS]
    off = tuple(x - y for x, y in zip(last, b, strict=True))
    return (zeros, first, (ZERO,)), (zeros, off, (ZERO,))


class NystromAnalysis(SeveralOrders[NystromOrders, NystromDense]):
    form = "nystrom"
    kind = "a Nyström method"
    claims = frozenset({"order", *VIEWS})

    @cached_property
    def subject(self) -> LinearSubject:
        method = seen(meant(self.tableau, self.tolerance), "partitioned")
        return LinearSubject.of(method, self.order.order, self.limit, OF_OSCILLATOR, _NO_PROPERTY)

    def __repr__(self) -> str:
        orders = self.orders
        q, v = orders.position_order.order, orders.velocity_order.order
        return f"<NystromAnalysis order {orders.order.order}, q {q}, q′ {v}>"


def analyse_nystrom(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> NystromAnalysis:
    return NystromAnalysis.analysed(
        NystromOrders, NystromDense.of, tableau, limit, tolerance, further
    )
