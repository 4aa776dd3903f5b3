"""``gark check`` of methods that use derivatives of f along the solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.constructions.derivatives import words_of
from garkcli.report import check as c
from garkcli.report.decided_by_stability import STABILITY
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, Rows

if TYPE_CHECKING:
    from garkcli.check.derivatives import DerivativesAnalysis
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _method_words(a: DerivativesAnalysis, _: Plain) -> str:
    return c.with_arithmetic(words_of(a.tableau), a)


ANALYSIS: Rows[DerivativesAnalysis] = [
    Row("exact_to", kinds.POSITION, lambda a: a.tableau.exact_to, DATA),
    c.viewed_order("order", HEADLINE),
    c.viewed_order("nonautonomous_order", label="order for f(t, y)"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    c.ERROR_ESTIMATE,
    *STABILITY,
    c.failing("order", "embedded-order"),
]
DERIVATIVES = c.of_other_kind(lambda o: o.derivatives, "derivatives", _method_words, ANALYSIS)
