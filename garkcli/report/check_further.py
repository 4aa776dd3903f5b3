"""The lines of ``gark check`` on embedded weights and dense output."""

from __future__ import annotations

from garkcli.check.analysis import Analysis
from garkcli.check.explained import dense_witness_text
from garkcli.check.further import DenseFacts, EmbeddedFacts
from garkcli.exact.display import decimal, to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.order.constants import Norms
from garkcli.order.estimator import Estimator
from garkcli.page.paint import Paint, folded, indented
from garkcli.report.check_conditions import labelled
from garkcli.report.check_orders import LABEL, Shown, one_order, with_time_lines
from garkcli.trees.notation import format_tree

_WIDTH = 80
_INSIDE = " " * 6
_LONGEST = 12
"""Longer sums are shown in decimals."""


def further_lines(analysis: Analysis, paint: Paint, shown: Shown) -> list[str]:
    """Their orders with witnesses, the estimate of the error, how dense output fits together."""
    lines = []
    embedded, dense = analysis.embedded, analysis.dense
    if embedded is not None:
        lines += _embedded(analysis, embedded, paint, shown)
    if dense is not None:
        lines += _dense(dense, analysis.tableau.size > 1, paint)
    names = []
    if embedded is not None:
        names.append("embedded weights")
    if dense is not None:
        names.append("dense output")
    left_out = " and ".join(names)
    if analysis.conjugate is not None or analysis.pair is not None:
        lines.append(f"{_INSIDE}the conjugate and the pair are without {left_out}")
    return lines


def _embedded(analysis: Analysis, found: EmbeddedFacts, paint: Paint, shown: Shown) -> list[str]:
    label = "embedded order"
    lines = one_order(label, found.order, found.tableau, paint, shown)
    timed = found.nonautonomous_order
    if timed is not None and analysis.inconsistent:
        label = "embedded, time"
        lines += with_time_lines(label, timed, found.tableau, paint, shown)
    return lines + _estimate(found.estimator, analysis.tableau.size > 1)


def _estimate(found: Estimator, has_colours: bool) -> list[str]:
    """The estimate of the error, and how large its leading term is."""
    lines = labelled("error estimate", [estimate_text(found)])
    if not found.is_zero and found.constants is not None:
        lines += _norms(found.constants.all, has_colours)
    return lines


def estimate_text(found: Estimator) -> str:
    """The estimate of the error: its leading term, the sums of b less the embedded weights."""
    if found.is_zero:
        return "zero: the embedded weights are b"
    what = "leading term not found"
    if found.order is not None:
        what = f"of order h^{found.order}"
    sums = ", ".join(map(_short, found.sums))
    return f"{what}, sum of b - embedded {sums}"


def _short(number: Number) -> str:
    text = to_text(number)
    if len(text) <= _LONGEST:
        return text
    return to_decimal(number, 4)


def _norms(norms: Norms, has_colours: bool) -> list[str]:
    """How large the leading term is."""
    text = f"principal norm {norms.two:.6g}, largest {norms.largest:.6g}"
    if norms.worst is not None:
        tree = format_tree(norms.worst, has_colours)
        text += f" at {tree}"
    room = _WIDTH - 2 - LABEL
    lines = folded(text, room, "")
    return labelled("", lines)


def _dense(found: DenseFacts, has_colours: bool, paint: Paint) -> list[str]:
    order = found.order
    number = str(order.order)
    if order.is_lower_bound:
        number = f"at least {number}"
    strong = paint("strong", number)
    label = "dense order"
    what = f"for every θ, of degree {found.degree}"
    head = f"  {label:{LABEL}}{strong}   {what}"
    if order.tolerance is not None:
        tolerance = decimal(order.tolerance)
        head += f", within {tolerance}"
    lines = [head]
    if order.undecided:
        next_order = order.order + 1
        lines.append(f"{_INSIDE}order {next_order} is too much to decide")
    if order.witness is not None:
        text = dense_witness_text(order.witness, has_colours)
        room = _WIDTH - len(_INSIDE)
        folds = folded(text, room, "  ")
        lines += indented(folds, _INSIDE)
    fit = fit_text(found)
    return lines + labelled("dense output", [fit])


def fit_text(found: DenseFacts) -> str:
    """How the pieces of single steps fit together."""
    if not found.ends_at_step:
        return "does not end where the step does: b(1) is not b"
    slope = {True: "its slope too", False: "its slope is not", None: "its slope is not decided"}
    answer = slope[found.slopes.are_continuous]
    return f"continuous, b(1) = b; {answer}"
