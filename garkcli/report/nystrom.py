"""``gark check`` of Nyström methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from garkcli.constructions.nystrom import Nystrom
from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Rows, maybe
from garkcli.tell.parts import SAID, part

if TYPE_CHECKING:
    from garkcli.check.nystrom import NystromAnalysis, NystromDense
    from garkcli.order.dense import DenseOrder
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level
IN_THE_TREES = "q is g in the step of q, q' is g in that of q′, q'0 is q′ as it begins"


def _method_words(a: NystromAnalysis, d: Plain) -> str:
    force = "g(q)" if Nystrom.of(a.tableau).A is None else "g(q, q′)"
    text = d.prose(f"Nyström for q″ = {force}, {counted(a.tableau.spaces[0].stages, 'stage')}")
    return c.with_arithmetic(text, a)


def _dense(a: NystromAnalysis, get: Callable[[NystromDense], DenseOrder]) -> Answer[int] | None:
    """An order of dense output."""
    names = [colour.name for colour in a.tableau.colours]
    return None if a.dense is None else c.dense_answer(get(a.dense), names)


ANALYSIS: Rows[NystromAnalysis] = [
    c.viewed_order("order", HEADLINE),
    c.viewed_order("position_order", label="order of q"),
    c.viewed_order("velocity_order", label="order of q′"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_position_order", label="embedded, q"),
    c.viewed_order("embedded_velocity_order", label="embedded, q′"),
    c.ERROR_ESTIMATE,
    maybe("dense_order", kinds.COUNT, lambda a: _dense(a, lambda x: x.order), DETAIL),
    maybe(
        "dense_position_order",
        kinds.COUNT,
        lambda a: _dense(a, lambda x: x.position_order),
        label="dense, q",
    ),
    maybe(
        "dense_velocity_order",
        kinds.COUNT,
        lambda a: _dense(a, lambda x: x.velocity_order),
        label="dense, q′",
    ),
    maybe("dense", part(c.DENSE, c.dense_words), lambda a: a.dense, label="dense output"),
    Row("in the trees", SAID, lambda _: IN_THE_TREES, DETAIL),
    c.failing("order", "position-order", "velocity-order", "embedded-order"),
]
NYSTROM = c.of_other_kind(lambda o: o.nystrom, "nystrom", _method_words, ANALYSIS)
