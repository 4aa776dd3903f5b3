"""``gark check`` of nonlinearly partitioned methods."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell.facts import Level, Row, Rows
from garkcli.tell.parts import SAID

if TYPE_CHECKING:
    from garkcli.check.nprk import NprkAnalysis
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level
IN_THE_TREES = "1 and 2 are the arguments of F that branches are in"


def _method_words(a: NprkAnalysis, _: Plain) -> str:
    pairs = counted(a.tableau.spaces[0].stages, "pair")
    return c.with_arithmetic(f"nonlinearly partitioned, {pairs} of stages", a)


ANALYSIS: Rows[NprkAnalysis] = [
    c.viewed_order("order", HEADLINE),
    c.viewed_order("embedded_order"),
    c.ERROR_ESTIMATE,
    Row("in the trees", SAID, lambda _: IN_THE_TREES),
    c.failing("order", "embedded-order"),
]
NPRK = c.of_other_kind(lambda o: o.nprk, "nprk", _method_words, ANALYSIS)
