"""The analysis of a Rosenbrock or W-method."""

from __future__ import annotations

from functools import cached_property

from flint import fmpq

from garkcli.check import order_facts
from garkcli.constructions.rosenbrock import DAE_VIEWS, NO_PROPERTY, OF_BETA, VIEWS, Which, seen
from garkcli.exact.field import Number
from garkcli.exact.matrix import SingularMatrixError
from garkcli.frozen import replace
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, meant, printed
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau


class RosenbrockOrders(order_facts.ClaimedOrders):
    """The orders with the Jacobian, with any matrix, with one that differs from it by O(h), and on
    ẏ = f(t, y). A rounded ``method`` has a search of its own, refined by each order on DAEs, so
    that the results are consistent.
    """

    method: AnyTableau
    w_order: AnyOrder
    old_jacobian_order: AnyOrder
    nonautonomous_order: AnyOrder

    @classmethod
    def of(
        cls, method: AnyTableau, limit: int, spans: StageSpans | None = None
    ) -> RosenbrockOrders:
        order = order_of(method, limit, spans)
        w, old, timed = (order_of(seen(method, which), limit) for which in VIEWS.values())
        alone = method if isinstance(method, Tableau) else method.aside()
        return cls(order, alone, w, old, timed)

    @cached_property
    def index_1_order(self) -> AnyOrder | None:
        """The order on ẏ = f(y, z), 0 = g(y, z) of index 1: the largest p with an error O(h^(p+1))
        of a step in y and O(h^p) in z. None if α + γ is singular.
        """
        return self._on_dae("on_dae", self.order)

    @cached_property
    def index_1_y_order(self) -> AnyOrder | None:
        """The largest p with O(h^(p+1)) in y; between the index-1 order and the order."""
        both = self.index_1_order
        if both is None or both.order == self.order.order:
            return both
        return self._on_dae("on_dae_in_y", self.order)

    @cached_property
    def index_1_z_order(self) -> AnyOrder | None:
        """The largest p with O(h^(p+1)) in z: the index-1 order or one less."""
        both, _ = self.index_1_order, self.index_1_y_order  # a rounded method is moved in turn
        return both and self._on_dae("on_dae_in_z", both)

    def _on_dae(self, which: Which, most: AnyOrder) -> AnyOrder | None:
        """Returns an order on DAEs, at most ``most``: its trees without g are the method's."""
        if printed(self.method).size > 2:
            return None  # y and z would be of several colours
        try:
            method = seen(self.method, which)
        except SingularMatrixError:
            return None
        order = order_of(method, most.order)
        if order.order < most.order:
            return order
        told = (name for name in ("witness", "undecided") if hasattr(most, name))
        return replace(order, **{name: getattr(most, name) for name in told})

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        order: AnyOrder | None = getattr(self, claim.replace("-", "_"))
        if order is None:
            return None
        tableau = printed(self.method)
        if claim != "order":
            tableau = printed(seen(tableau, {**VIEWS, **DAE_VIEWS}[claim]))
        return order, tableau


class RosenbrockAnalysis(order_facts.SeveralOrders[RosenbrockOrders, order_facts.DenseFacts]):
    """The orders of a Rosenbrock or W-method; ``order`` and ``tableau`` are with the Jacobian."""

    form = "rosenbrock"
    kind = "a Rosenbrock method"
    claims = frozenset({"order", *VIEWS, *DAE_VIEWS})

    @property
    def w_order(self) -> AnyOrder:
        return self.orders.w_order

    @property
    def old_jacobian_order(self) -> AnyOrder:
        return self.orders.old_jacobian_order

    @property
    def nonautonomous_order(self) -> AnyOrder:
        return self.orders.nonautonomous_order

    @property
    def index_1_order(self) -> AnyOrder | None:
        return self.orders.index_1_order

    @property
    def index_1_y_order(self) -> AnyOrder | None:
        return self.orders.index_1_y_order

    @property
    def index_1_z_order(self) -> AnyOrder | None:
        return self.orders.index_1_z_order

    @cached_property
    def subject(self) -> order_facts.LinearSubject:
        method = seen(meant(self.tableau, self.tolerance), "on_test_equation")
        return order_facts.LinearSubject.of(
            method, self.order.order, self.limit, OF_BETA, NO_PROPERTY
        )

    @property
    def at_infinity(self) -> Number | None:
        return self.subject.at_infinity

    def __repr__(self) -> str:
        orders = self.orders
        return f"<RosenbrockAnalysis order {orders.order.order}, W-order {orders.w_order.order}>"


def analyse_rosenbrock(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> RosenbrockAnalysis:
    return RosenbrockAnalysis.analysed(
        RosenbrockOrders, order_facts.dense_facts, tableau, limit, tolerance, further
    )
