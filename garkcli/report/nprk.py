"""``gark check`` of nonlinearly partitioned methods."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell.facts import Level, Row, maybe
from garkcli.tell.parts import SAID, part, picture

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level
IN_THE_TREES = "1 and 2 are the arguments of F that branches are in"


def _method_words(outcome: Any, _: Plain) -> str:
    a = outcome.nprk
    pairs = counted(a.tableau.spaces[0].stages, "pair")
    return c.with_arithmetic(f"nonlinearly partitioned, {pairs} of stages", a)


ANALYSIS = [
    c.viewed_order("order", HEADLINE),
    c.viewed_order("embedded_order"),
    maybe("error_estimate", part(c.ESTIMATE, c.estimate_phrase), "embedded.estimator"),
    Row("in the trees", SAID, lambda _: IN_THE_TREES),
    Row("trees_that_fail", picture(c.drawn), c.failing("order", "embedded-order"), DETAIL),
]
NPRK = c.of_other_kind("nprk", "nprk", _method_words, ANALYSIS)
