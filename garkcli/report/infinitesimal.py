"""``gark check`` of multirate infinitesimal methods with the exact fast solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, Rows

if TYPE_CHECKING:
    from garkcli.check.infinitesimal import InfinitesimalAnalysis
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _method_words(a: InfinitesimalAnalysis, d: Plain) -> str:
    slow = a.tableau.size - 1
    text = f"multirate, {counted(a.tableau.spaces[-1].stages, 'slow stage')}"
    if slow > 1:
        text += f" of {slow} slow parts"
    text += ", fast part exact"
    return c.with_arithmetic(text, a)


ANALYSIS: Rows[InfinitesimalAnalysis] = [
    Row("exact_to", kinds.POSITION, lambda a: a.tableau.exact_to, DATA),
    c.viewed_order("order", HEADLINE),
    c.viewed_order("slow_order", label="slow method"),
    c.viewed_order("nonautonomous_order", label="order for f(t, y)"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    c.ERROR_ESTIMATE,
    c.failing("order", "embedded-order"),
]
INFINITESIMAL = c.of_other_kind(lambda o: o.infinitesimal, "multirate", _method_words, ANALYSIS)
