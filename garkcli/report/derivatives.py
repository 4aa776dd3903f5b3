"""``gark check`` of methods that use derivatives of f along the solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.constructions.derivatives import words_of
from garkcli.report import check as c
from garkcli.report.decided_by_stability import STABILITY
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, maybe
from garkcli.tell.parts import part, picture

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _method_words(outcome: Any, _: Plain) -> str:
    a = outcome.derivatives
    return c.with_arithmetic(words_of(a.tableau), a)


ANALYSIS = [
    Row("exact_to", kinds.POSITION, "tableau.exact_to", DATA),
    c.viewed_order("order", HEADLINE),
    c.viewed_order("nonautonomous_order", label="order for f(t, y)"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    maybe("error_estimate", part(c.ESTIMATE, c.estimate_phrase), "embedded.estimator"),
    *STABILITY,
    Row("trees_that_fail", picture(c.drawn), c.failing("order", "embedded-order"), DETAIL),
]
DERIVATIVES = c.of_other_kind("derivatives", "derivatives", _method_words, ANALYSIS)
