"""The analysis of a nonlinearly partitioned method."""

from __future__ import annotations

from flint import fmpq

from garkcli.check.further import EmbeddedFacts, estimate
from garkcli.check.order_facts import OrderFacts
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import order_of
from garkcli.order.meant import as_embedded, meant, printed
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau


class NprkAnalysis(OrderFacts):
    """The orders of a nonlinearly partitioned method.

    The colours of its tableau are the arguments of F, its stages the pairs at which F is evaluated.
    """

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
    """Decides all that ``gark check`` reports of a nonlinearly partitioned method, with orders up
    to ``limit``.
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
