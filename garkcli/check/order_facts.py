"""The facts about further weights, and common parts of the analyses of other kinds of methods."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any, ClassVar, Generic, Self, TypeVar

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.order.certificate import StageSpans
from garkcli.order.deciding import AnyOrder, nonautonomous, order_of
from garkcli.order.dense import DenseOrder, Slopes, dense_order, ends_at_step, slopes
from garkcli.order.functionals import Estimator, KnownOrders, estimator
from garkcli.order.meant import AnyTableau, as_dense, as_embedded, meant, printed, with_further
from garkcli.order.simplifying import inconsistent_blocks, simplifying
from garkcli.properties.subject import Subject
from garkcli.properties.verdict import NoProperties, Verdict
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, DenseOutput, Further, Weights
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown


class EmbeddedFacts(Frozen):
    """Embedded weights in place of b; ``nonautonomous_order`` is None if not applicable."""

    tableau: Tableau
    order: AnyOrder
    nonautonomous_order: AnyOrder | None
    estimator: Estimator


class DenseFacts(Frozen):
    """The order, for all θ, and the continuity of dense output; ``ends_at_step`` says b(1) = b."""

    order: DenseOrder
    degree: int
    ends_at_step: bool
    slopes: Slopes

    @property
    def is_smooth(self) -> bool | None:
        return self.ends_at_step and self.slopes.are_continuous


def further_facts(
    method: AnyTableau,
    further: Further,
    order: AnyOrder,
    inconsistent: Sequence[tuple[int, int]],
    limit: int,
    spans: StageSpans | None = None,
) -> tuple[EmbeddedFacts | None, DenseFacts | None]:
    """Returns the facts about embedded weights and dense output, each None without."""
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
    """Returns the error estimate; ``orders`` are those of the method and with these weights."""
    order, other = orders
    smaller = other if other.order < order.order else order
    differ = other.order != order.order and not smaller.is_lower_bound
    sought = KnownOrders(smaller.order, differ, limit)
    return estimator(with_further(method) or method, weights, sought, spans)


def dense_facts(
    method: AnyTableau, dense: DenseOutput, limit: int, spans: StageSpans | None = None
) -> DenseFacts:
    whole = with_further(method) or method
    return DenseFacts(
        order=dense_order(as_dense(method), dense, limit, spans),
        degree=dense.degree,
        ends_at_step=ends_at_step(whole, dense),
        slopes=slopes(whole, dense),
    )


class LinearSubject(Frozen):
    """The properties that linear problems decide, from a method with the same steps there."""

    on_linear_problems: Subject
    keys: frozenset[str]
    reason: Reason

    @staticmethod
    def of(
        method: AnyTableau, order: int, limit: int, keys: frozenset[str], reason: Reason
    ) -> LinearSubject:
        conditions = simplifying(method, limit)
        return LinearSubject(Subject.read(method, order, conditions, limit, NOTHING), keys, reason)

    @property
    def rounding(self) -> fmpq:
        return self.on_linear_problems.rounding

    @cached_property
    def at_infinity(self) -> Number | None:
        """R(∞); None if R is unbounded or the rounding leaves it open."""
        inner = self.on_linear_problems
        return None if inner.tolerance else inner.linear.at_infinity()

    def verdict(self, key: str) -> Verdict:
        if key not in self.keys:
            return Verdict.meaningless(self.reason)
        return self.on_linear_problems.verdict(key)


class ClaimedOrders(Frozen):
    """The orders of weights at the stages of a method; ``order`` is that of the method."""

    order: AnyOrder

    @classmethod
    @abstractmethod
    def of(cls, method: AnyTableau, limit: int, spans: StageSpans | None = None) -> Self:
        """Returns the orders up to ``limit``; ``spans`` are stage vectors that are known."""

    @abstractmethod
    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """Returns the order that a claim is about and its tableau; None if there is none."""


O = TypeVar("O", bound=ClaimedOrders)
D = TypeVar("D", bound=DenseFacts)


class EmbeddedOrders(Frozen, Generic[O]):
    orders: O
    estimator: Estimator

    @property
    def order(self) -> AnyOrder:
        return self.orders.order


class SeveralOrders(Shown, Frozen, Generic[O, D]):
    tableau: Tableau
    orders: O
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedOrders[O] | None = None
    dense: D | None = None
    further: Further = NOTHING

    form: ClassVar[str]
    kind: ClassVar[str]
    claims: ClassVar[frozenset[str]]

    @classmethod
    def analysed(
        cls,
        orders_of: type[O],
        dense_of: Callable[[AnyTableau, DenseOutput, int, StageSpans | None], D],
        tableau: Tableau,
        limit: int,
        tolerance: fmpq | None,
        further: Further,
    ) -> Self:
        method = meant(tableau, tolerance, further)
        spans = StageSpans(tableau) if method is tableau else None
        orders = orders_of.of(method, limit, spans)
        embedded = None
        if further.embedded is not None:
            other = orders_of.of(as_embedded(method, further.embedded), limit, spans)
            error = estimate(method, further.embedded, (orders.order, other.order), limit, spans)
            embedded = EmbeddedOrders(other, error)
        dense = None
        if further.dense is not None:
            dense = dense_of(method, further.dense, limit, spans)
        return cls(tableau, orders, limit, tolerance, embedded, dense, further)

    @property
    def order(self) -> AnyOrder:
        return self.orders.order

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        whose: O | None = self.orders
        if claim.startswith("embedded-"):
            whose = None if self.embedded is None else self.embedded.orders
            claim = claim.removeprefix("embedded-")
        return whose.view(claim) if whose is not None and claim in self.claims else None


class OrderFacts(Shown, Frozen):
    tableau: Tableau
    order: AnyOrder
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedFacts | None = None
    further: Further = NOTHING
    nonautonomous_order: AnyOrder | None = None

    form: ClassVar[str]
    kind: ClassVar[str]
    no_property: ClassVar[Reason]

    @classmethod
    def with_flow(
        cls, tableau: Tableau, limit: int, tolerance: fmpq | None, further: Further
    ) -> Self:
        """Returns the analysis of a tableau with exact solutions among its stages."""
        limit = min(limit, tableau.exact_to or limit)
        method = meant(tableau, tolerance, further)
        spans = StageSpans(tableau) if further and method is tableau else None
        order = order_of(method, limit, spans)
        besides = cls.besides(method, limit)
        inconsistent = inconsistent_blocks(method)
        timed = nonautonomous(method, order, inconsistent, limit)
        embedded, _ = further_facts(method, further, order, inconsistent, limit, spans)
        values = tableau, order, limit, tolerance, embedded, further, timed
        return cls(*values, **besides)

    @classmethod
    def besides(cls, method: AnyTableau, limit: int) -> dict[str, Any]:  # noqa: ARG003
        return {}

    @property
    def dense(self) -> None:
        """None, as such methods have no dense output."""

    @cached_property
    def subject(self) -> NoProperties | LinearSubject:
        """The verdict on every property: not defined for such methods, unless overridden."""
        return NoProperties(self.tolerance or fmpq(0), self.no_property)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        whose: OrderFacts | EmbeddedFacts | None = self
        if claim.startswith("embedded-"):
            whose, claim = self.embedded, claim.removeprefix("embedded-")
        if whose is None:
            return None
        if claim == "order":
            return whose.order, whose.tableau
        order = whose.nonautonomous_order if claim == "nonautonomous-order" else None
        timed = with_time(whose.tableau) if order else None
        return None if order is None or timed is None else (order, timed)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} order {self.order.order}>"
