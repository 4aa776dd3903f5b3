"""Everything known about one Nyström method, as one value."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

from flint import fmpq

from garkcli.check.further import estimate
from garkcli.constructions.nystrom import Which, seen
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.functionals import Estimator
from garkcli.order.meant import AnyTableau, as_embedded, meant, printed
from garkcli.order.simplifying import simplifying
from garkcli.properties.property import Verdict
from garkcli.properties.subject import Subject
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

VIEWS: dict[str, Which] = {"position-order": "in_positions", "velocity-order": "in_velocities"}
"""The orders of the two steps, by their claims."""
OF_OSCILLATOR = frozenset({"p-stable", "i-stable"})
"""Properties of the partitioned method with the same steps."""
_NO_PROPERTY = Reason("a property of Runge–Kutta methods, which this Nyström method is not")


class NystromOrders(Frozen):
    """The orders of some weights at the stages of a Nyström method.

    Attributes:
        tableau: of the method.
        order: of both steps, the smaller one.
        position_order: of the step in q.
        velocity_order: of the step in q′.
    """

    tableau: Tableau
    order: AnyOrder
    position_order: AnyOrder
    velocity_order: AnyOrder

    @classmethod
    def of(cls, method: AnyTableau, limit: int, spans: StageSpans | None = None) -> NystromOrders:
        """The orders up to a limit."""
        order = order_of(method, limit, spans)
        q, v = (order_of(seen(method, which), limit, spans) for which in VIEWS.values())
        return cls(printed(method), order, q, v)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau]:
        """The order that a claim is on, with the tableau that has it."""
        found: AnyOrder = getattr(self, claim.replace("-", "_"))
        if claim == "order":
            return found, self.tableau
        return found, printed(seen(self.tableau, VIEWS[claim]))


class EmbeddedOrders(Frozen):
    """The truth about embedded weights.

    Attributes:
        orders: of the method with them for b̄ and b.
        estimator: the estimate of the error that they give.
    """

    orders: NystromOrders
    estimator: Estimator


class NystromSubject(Frozen):
    """The properties of a Nyström method: those on the oscillator.

    Attributes:
        on_oscillator: the partitioned method for q̇ = p, ṗ = g(q).
    """

    on_oscillator: Subject

    @property
    def rounding(self) -> fmpq:
        """By how much the printed coefficients may be off."""
        return self.on_oscillator.rounding

    def verdict(self, key: str) -> Verdict:
        """What is true of a property."""
        if key not in OF_OSCILLATOR:
            return Verdict.meaningless(_NO_PROPERTY)
        return self.on_oscillator.verdict(key)


class NystromAnalysis(Shown, Frozen):
    """The truth about a Nyström method.

    Attributes:
        tableau: of the method.
        orders: its orders.
        limit: where the search for orders stopped.
        tolerance: the rounding within which all of this holds; None where it holds exactly.
        embedded: the truth about its embedded weights; None where it has none.
        further: these weights.
    """

    tableau: Tableau
    orders: NystromOrders
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedOrders | None = None
    further: Further = NOTHING

    kind: ClassVar[str] = "a Nyström method"

    @property
    def order(self) -> AnyOrder:
        """The order of both steps: the smaller one."""
        return self.orders.order

    @property
    def dense(self) -> None:
        """It has no dense output."""

    @cached_property
    def subject(self) -> NystromSubject:
        """The method whose properties are decided on demand."""
        method = seen(meant(self.tableau, self.tolerance), "partitioned")
        conditions = simplifying(method, self.limit)
        order = self.order.order
        return NystromSubject(Subject.read(method, order, conditions, self.limit, NOTHING))

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """The order that a claim is on, with the tableau that has it; None for other claims."""
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
    """Decide everything that ``gark check`` reports of a Nyström method.

    Args:
        tableau: of the method.
        limit: where the search for orders stops.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
        further: its embedded weights.
    """
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if method is tableau else None
    orders = NystromOrders.of(method, limit, spans)
    embedded = None
    if further.embedded is not None:
        other = NystromOrders.of(as_embedded(method, further.embedded), limit, spans)
        found = estimate(method, further.embedded, (orders.order, other.order), limit, spans)
        embedded = EmbeddedOrders(other, found)
    return NystromAnalysis(tableau, orders, limit, tolerance, embedded, further)
