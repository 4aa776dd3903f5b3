"""``gark check`` of multirate infinitesimal methods with the exact fast solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, maybe
from garkcli.tell.parts import part, picture

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
    return c.with_arithmetic(text, a)


ANALYSIS = [
    Row("exact_to", kinds.POSITION, "tableau.exact_to", DATA),
    c.viewed_order("order", HEADLINE),
    c.viewed_order("slow_order", label="slow method"),
    c.viewed_order("nonautonomous_order", label="order for f(t, y)"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    maybe("error_estimate", part(c.ESTIMATE, c.estimate_phrase), "embedded.estimator"),
    Row("trees_that_fail", picture(c.drawn), c.failing("order", "embedded-order"), DETAIL),
]
INFINITESIMAL = c.of_other_kind("infinitesimal", "multirate", _method_words, ANALYSIS)
