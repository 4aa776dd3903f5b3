"""``gark check`` of Rosenbrock and W-methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.report.decided_by_stability import STABILITY
from garkcli.tell import kinds
from garkcli.tell.facts import Level, Row, maybe
from garkcli.tell.parts import SAID, part, picture

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def words_of(tableau: Any) -> str:
    """How many colours and stages it has."""
    colours = tableau.size // 2
    stages = [space.stages for space in tableau.spaces[:colours]]
    if colours == 1:
        return f"Rosenbrock, {counted(stages[0], 'stage')}"
    return f"Rosenbrock, {counted(colours, 'colour')}, stages {', '.join(map(str, stages))}"


def _method_words(outcome: Any, d: Plain) -> str:
    a = outcome.rosenbrock
    text = words_of(a.tableau)
    diagonal = set(Rosenbrock.of(a.tableau).diagonal)
    if len(diagonal) == 1:
        text += f", {d.prose('γ')} = {d.number(diagonal.pop())}"
    return c.with_arithmetic(text, a)


def _dense(get: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda a: None if a.dense is None else get(a)


IN_THE_TREES = (
    "f' is f with one branch; W the matrix, with one; E the error of the Jacobian, with one, which "
    "counts two orders; t time; g with several branches, which counts none"
)


def _names(a: Any) -> list[str]:
    return [colour.name for colour in a.tableau.colours]


ANALYSIS = [
    c.viewed_order("order", HEADLINE),
    c.viewed_order("w_order", label="with any matrix W"),
    c.viewed_order("old_jacobian_order", label="old Jacobian f' + hE"),
    c.viewed_order("nonautonomous_order", label="order for f(t, y)"),
    c.viewed_order("index_1_order", label="index 1, 0 = g(y, z)"),
    c.viewed_order("index_1_y_order", DETAIL, "index 1, error in y"),
    c.viewed_order("index_1_z_order", DETAIL, "index 1, error in z"),
    c.viewed_order("embedded_order"),
    c.viewed_order("embedded_w_order", DETAIL, "embedded, any W"),
    c.viewed_order("embedded_old_jacobian_order", DETAIL, "embedded, f' + hE"),
    c.viewed_order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    c.viewed_order("embedded_index_1_order", DETAIL, "embedded, index 1"),
    maybe("error_estimate", part(c.ESTIMATE, c.estimate_phrase), "embedded.estimator"),
    maybe("dense_order", kinds.COUNT, _dense(lambda a: c.dense_answer(a.dense.order, _names(a)))),
    maybe("dense", part(c.DENSE, c.dense_words), label="dense output"),
    *STABILITY,
    Row(
        "trees_that_fail",
        picture(c.drawn),
        c.failing("order", "w-order", "index-1-order", "embedded-order"),
        DETAIL,
    ),
    Row("in the trees", SAID, lambda _: IN_THE_TREES, DETAIL),
]
ROSENBROCK = c.of_other_kind("rosenbrock", "rosenbrock", _method_words, ANALYSIS)
