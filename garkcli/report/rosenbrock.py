"""``gark check`` of Rosenbrock and W-methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.errors import counted
from garkcli.report import check as c
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Status, maybe, optional
from garkcli.tell.parts import SAID, part, parts, picture, told

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _method_words(outcome: Any, d: Plain) -> str:
    a = outcome.rosenbrock
    text = f"Rosenbrock, {counted(a.tableau.spaces[0].stages, 'stage')}"
    diagonal = set(Rosenbrock.of(a.tableau).diagonal)
    if len(diagonal) == 1:
        text += f", {d.prose('γ')} = {d.number(diagonal.pop())}"
    return c.with_arithmetic(text, a)


def _truth(key: str) -> Row:
    """A property that R(z) decides."""

    def get(a: Any) -> Answer:
        v = a.subject.verdict(key)
        return Answer(v.value, Status(open=v.reason) if v.is_undecided else Status(), v.reason)

    return maybe(key.replace("-", "_"), kinds.TRUTH, get, DATA)


def _stability_words(a: Any, d: Plain) -> str:
    """``A-stable, R(∞) = 0``."""
    words = []
    for key, name in (("a-stable", "A-stable"), ("l-stable", "L-stable")):
        v = a.subject.verdict(key)
        if v.is_undecided:
            words.append(f"{name} not decided: {d.reason(v.reason)}")
        else:
            words.append(d.known(name if v.value else f"not {name}", Status(a.tolerance)))
            if not v.value and key == "a-stable":
                words[-1] += f": {d.reason(v.reason)}" if v.reason else ""
                break
    limit = a.at_infinity
    if limit is not None and limit:
        words.append(f"{d.prose('R(∞)')} = {d.number(limit)}")
    return ", ".join(words)


def _dense(get: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda a: None if a.dense is None else get(a)


IN_THE_TREES = (
    "f' is f with one branch; W the matrix, with one; E the error of the Jacobian, with one, which "
    "counts two orders; t time; g with several branches, which counts none"
)


def _names(a: Any) -> list[str]:
    return [colour.name for colour in a.tableau.colours]


R_OF_Z = kinds.ratio("z")
ANALYSIS = [
    Row("exact", kinds.TRUTH, lambda a: a.tolerance is None, DATA),
    maybe("tolerance", kinds.TOLERANCE, level=DATA),
    Row("colours", parts(c.COLOURS), lambda a: c.colours_of(a.tableau), DATA),
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
    Row("stability", told(_stability_words), "."),
    _truth("a-stable"),
    _truth("l-stable"),
    maybe("R_infinity", kinds.EXACT, "at_infinity", DATA),
    optional(
        "R",
        R_OF_Z,
        lambda a: None if a.tolerance else a.subject.on_test_equation.linear,
        DETAIL,
        label="R(z)",
    ),
    Row(
        "trees_that_fail",
        picture(c.drawn),
        c.failing("order", "w-order", "index-1-order", "embedded-order"),
        DETAIL,
    ),
    Row("in the trees", SAID, lambda _: IN_THE_TREES, DETAIL),
]
ROSENBROCK = c.of_other_kind("rosenbrock", "rosenbrock", _method_words, ANALYSIS)
