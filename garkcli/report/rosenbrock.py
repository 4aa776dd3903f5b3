"""``gark check`` of Rosenbrock and W-methods."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.report.decided_by_stability import STABILITY
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Rows, maybe
from garkcli.tell.parts import SAID, part

if TYPE_CHECKING:
    from garkcli.check.rosenbrock import RosenbrockAnalysis
    from garkcli.tableau.tableau import Tableau
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def words_of(tableau: Tableau) -> str:
    """How many colours and stages it has."""
    colours = tableau.size // 2
    stages = [space.stages for space in tableau.spaces[:colours]]
    if colours == 1:
        return f"Rosenbrock, {counted(stages[0], 'stage')}"
    return f"Rosenbrock, {counted(colours, 'colour')}, stages {', '.join(map(str, stages))}"


def _method_words(a: RosenbrockAnalysis, d: Plain) -> str:
    text = words_of(a.tableau)
    diagonal = set(Rosenbrock.of(a.tableau).diagonal)
    if len(diagonal) == 1:
        text += f", {d.prose('γ')} = {d.number(diagonal.pop())}"
    return c.with_arithmetic(text, a)


IN_THE_TREES = (
    "f' is f with one branch; W the matrix, with one; E the error of the Jacobian, with one, which "
    "counts two orders; t time; g with several branches, which counts none"
)


def _dense_order(a: RosenbrockAnalysis) -> Answer[int] | None:
    names = [colour.name for colour in a.tableau.colours]
    return None if a.dense is None else c.dense_answer(a.dense.order, names)


ANALYSIS: Rows[RosenbrockAnalysis] = [
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
    c.ERROR_ESTIMATE,
    maybe("dense_order", kinds.COUNT, _dense_order),
    maybe("dense", part(c.DENSE, c.dense_words), lambda a: a.dense, label="dense output"),
    *STABILITY,
    c.failing("order", "w-order", "index-1-order", "embedded-order"),
    Row("in the trees", SAID, lambda _: IN_THE_TREES, DETAIL),
]
ROSENBROCK = c.of_other_kind(lambda o: o.rosenbrock, "rosenbrock", _method_words, ANALYSIS)
