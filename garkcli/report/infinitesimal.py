"""``gark check`` of multirate infinitesimal methods with the exact fast solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Section, maybe, optional
from garkcli.tell.parts import part, parts, picture, told

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _method_words(outcome: Any, d: Plain) -> str:
    a = outcome.infinitesimal
    slow = a.tableau.size - 1
    text = f"multirate, {counted(a.tableau.spaces[-1].stages, 'slow stage')}"
    if slow > 1:
        text += f" of {slow} slow parts"
    text += ", fast part exact"
    if a.tolerance is not None:
        return f"{text}; coefficients rounded"
    degree = a.tableau.degree
    field = "rational arithmetic" if degree == 1 else f"a number field of degree {degree}"
    return f"{text}; decided in {field}"


def _order(key: str, level: Any = USUAL, label: str = "") -> Row:
    """An order of the method."""
    claim = key.replace("_", "-")

    def get(a: Any) -> Answer:
        view = a.view(claim)
        return kinds.order_answer(None if view is None else view[0])

    return Row(key, kinds.ORDER, get, level, has_null=key != "order", label=label or None)


def _witnesses(a: Any) -> list[tuple[Any, Any]]:
    views = (a.view(claim) for claim in ("order", "embedded-order"))
    return [(order.witness, tableau) for order, tableau in filter(None, views) if order.witness]


def _estimate_words(e: Any, d: Plain) -> str:
    if e.is_zero:
        return "zero: the embedded weights are b"
    return "leading term not found" if e.order is None else f"of order {e.order}"


ANALYSIS = [
    Row("exact", kinds.TRUTH, lambda a: a.tolerance is None, DATA),
    maybe("tolerance", kinds.TOLERANCE, level=DATA),
    Row("colours", parts(c.COLOURS), lambda a: c.colours_of(a.tableau), DATA),
    Row("exact_to", kinds.POSITION, "tableau.exact_to", DATA),
    _order("order", HEADLINE),
    _order("slow_order", label="slow method"),
    _order("nonautonomous_order", label="order for f(t, y)"),
    _order("embedded_order"),
    _order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    maybe("error_estimate", part(c.ESTIMATE, _estimate_words), "embedded.estimator"),
    Row("trees_that_fail", picture(c.drawn), _witnesses, DETAIL),
]
INFINITESIMAL = Section(
    *kinds.FILE_AND_NAME,
    Row("ok", kinds.TRUTH, level=DATA),
    Row("multirate", kinds.TRUE, lambda _: True, DATA),
    Row("method", told(_method_words), "."),
    *(row.of(lambda o: o.infinitesimal) for row in ANALYSIS),
    c.LEFT_BEHIND,
    optional("error_constants", part(c.CONSTANTS), "constants"),
    *c.CLAIMS,
    title=c.title,
    columns=c.COLUMNS,
)
