"""``gark check`` of Nyström methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from garkcli.constructions.nystrom import Nystrom
from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, maybe
from garkcli.tell.parts import SAID, part, picture

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level
IN_THE_TREES = "q is g in the step of q, q' is g in that of q′, q'0 is q′ as it begins"


def _method_words(outcome: Any, d: Plain) -> str:
    a = outcome.nystrom
    force = "g(q)" if Nystrom.of(a.tableau).A is None else "g(q, q′)"
    text = d.prose(f"Nyström for q″ = {force}, {counted(a.tableau.spaces[0].stages, 'stage')}")
    return c.with_arithmetic(text, a)


def _dense(name: str) -> Callable[[Any], Any]:
    """An order of dense output."""

    def answer(a: Any) -> Any:
        names = [colour.name for colour in a.tableau.colours]
        return None if a.dense is None else c.dense_answer(getattr(a.dense, name), names)

    return answer


ANALYSIS = [
    c.viewed_order("order", HEADLINE),
    c.viewed_order("position_order", label="order of q"),
    c.viewed_order("velocity_order", label="order of q′"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_position_order", label="embedded, q"),
    c.viewed_order("embedded_velocity_order", label="embedded, q′"),
    maybe("error_estimate", part(c.ESTIMATE, c.estimate_phrase), "embedded.estimator"),
    maybe("dense_order", kinds.COUNT, _dense("order"), level=DETAIL),
    maybe("dense_position_order", kinds.COUNT, _dense("position_order"), label="dense, q"),
    maybe("dense_velocity_order", kinds.COUNT, _dense("velocity_order"), label="dense, q′"),
    maybe("dense", part(c.DENSE, c.dense_words), label="dense output"),
    Row("in the trees", SAID, lambda _: IN_THE_TREES, DETAIL),
    Row(
        "trees_that_fail",
        picture(c.drawn),
        c.failing("order", "position-order", "velocity-order", "embedded-order"),
        DETAIL,
    ),
]
NYSTROM = c.of_other_kind("nystrom", "nystrom", _method_words, ANALYSIS)
