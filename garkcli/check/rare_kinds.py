"""The analyses of multirate infinitesimal, nonlinearly partitioned and multiderivative methods."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from flint import fmpq

from garkcli.check.order_facts import EmbeddedFacts, LinearSubject, OrderFacts, estimate
from garkcli.constructions.infinitesimal import slow_part
from garkcli.constructions.multirate import SLOW
from garkcli.constructions.same_stability import with_same_function
from garkcli.frozen import replace
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, as_embedded, meant, printed
from garkcli.properties.registry import OF_TEST_EQUATION
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau


class InfinitesimalAnalysis(OrderFacts, kw_only=True):
    """The fast part is solved exactly, by collocation in the tableau; 0 for ``slow_order``."""

    slow_order: AnyOrder

    form = "infinitesimal"
    kind = "a multirate method with the exact fast part"
    no_property = Reason("a property of Runge–Kutta methods, and the fast part is solved exactly")

    @classmethod
    def besides(cls, method: AnyTableau, limit: int) -> dict[str, Any]:
        return {"slow_order": _among_all(order_of(slow_part(method), limit), printed(method))}

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        return (self.slow_order, self.tableau) if claim == "slow-order" else super().view(claim)

    def __repr__(self) -> str:
        return f"<InfinitesimalAnalysis order {self.order.order}, slow {self.slow_order.order}>"


def _among_all(order: AnyOrder, tableau: Tableau) -> AnyOrder:
    def moved(tree: Tree) -> Tree:
        return tableau.tree(tree.root + SLOW, map(moved, tree.branches))

    witness = order.witness
    if witness is None:
        return order
    return replace(order, witness=replace(witness, tree=moved(witness.tree)))


class NprkAnalysis(OrderFacts):
    """A method whose colours are arguments of F, its stages the pairs at which F is taken."""

    form = "nprk"
    kind = "a nonlinearly partitioned method"
    no_property = Reason(
        "a property of Runge–Kutta methods of vector fields, not of their arguments"
    )


def analyse_nprk(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> NprkAnalysis:
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if further and method is tableau else None
    order = order_of(method, limit, spans)
    embedded = None
    if further.embedded is not None:
        changed = as_embedded(method, further.embedded)
        other = order_of(changed, limit, spans)
        error = estimate(method, further.embedded, (order, other), limit, spans)
        embedded = EmbeddedFacts(printed(changed), other, None, error)
    return NprkAnalysis(tableau, order, limit, tolerance, embedded, further)


class DerivativesAnalysis(OrderFacts):
    """Orders of a multiderivative method, with stages along exact solutions for its derivatives."""

    form = "derivatives"
    kind = "a multiderivative method"
    no_property = Reason("a property of Runge–Kutta methods, and derivatives of f are used")

    @cached_property
    def subject(self) -> LinearSubject:
        """The method whose properties are decided: all of them follow from R(z)."""
        method = with_same_function(meant(self.tableau, self.tolerance))
        assert method is not None
        order = self.order.order
        return LinearSubject.of(method, order, self.limit, OF_TEST_EQUATION, self.no_property)
