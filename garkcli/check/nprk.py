"""Everything known about one nonlinearly partitioned method, as one value."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

from flint import fmpq

from garkcli.check.further import EmbeddedFacts, estimate
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import as_embedded, meant, printed
from garkcli.properties.property import NoProperties
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

_NO_PROPERTY = Reason("a property of Runge–Kutta methods of vector fields, not of their arguments")


class NprkAnalysis(Shown, Frozen):
    """The truth about a nonlinearly partitioned method.

    Attributes:
        tableau: its colours are the arguments of F, its stages the pairs at which it is evaluated.
        order: its order.
        limit: where the search for orders stopped.
        tolerance: the rounding within which all of this holds; None where it holds exactly.
        embedded: the truth about its embedded weights; None where it has none.
        further: these weights.
    """

    tableau: Tableau
    order: AnyOrder
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedFacts | None = None
    further: Further = NOTHING

    kind: ClassVar[str] = "a nonlinearly partitioned method"

    @property
    def dense(self) -> None:
        """It has no dense output."""

    @cached_property
    def subject(self) -> NoProperties:
        """It has no properties."""
        return NoProperties(self.tolerance or ZERO, _NO_PROPERTY)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """The order that a claim is on, with the tableau that has it; None for other claims."""
        if claim == "order":
            return self.order, self.tableau
        if claim == "embedded-order" and self.embedded is not None:
            return self.embedded.order, self.embedded.tableau
        return None

    def __repr__(self) -> str:
        return f"<NprkAnalysis order {self.order.order}>"


def analyse_nprk(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> NprkAnalysis:
    """Decide everything that ``gark check`` reports of a nonlinearly partitioned method.

    Args:
        tableau: of the method.
        limit: where the search for orders stops.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
        further: its embedded weights.
    """
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if further and method is tableau else None
    order = order_of(method, limit, spans)
    embedded = None
    if further.embedded is not None:
        changed = as_embedded(method, further.embedded)
        other = order_of(changed, limit, spans)
        found = estimate(method, further.embedded, (order, other), limit, spans)
        embedded = EmbeddedFacts(printed(changed), other, None, found)
    return NprkAnalysis(tableau, order, limit, tolerance, embedded, further)
