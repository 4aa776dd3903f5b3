"""``gark converge``: the table of errors, the order that they show, and the verdict."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from flint import arb

from garkcli.convergence.result import CLOSE, MAX_ORDER, Convergence, Cost, Row, Stiffness
from garkcli.page.asciiplot import POINT, terminal_curves
from garkcli.page.figures import rounded, scientific
from garkcli.page.paint import Paint, aligned, indented
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.report.convergence_data import csv_of, invariant_names
from garkcli.report.fault_json import Failure
from garkcli.report.problem_text import describe, driving
from garkcli.tableau.garkmethod import word_for

WIDTH = 80
"""Columns of a terminal."""
NO_TIME = "no seconds where floats do not reach the error: the counts are for more digits"
WORK = ("steps", "evaluations", "iterations", "Jacobians", "seconds")
"""What is counted, as column heads."""
_LONGEST_HEAD = 40  # characters of the name of an invariant above a column
_INDENT = 2
_GAP = "   "


def render(
    result: Convergence,
    name: str,
    format: str,
    paint: Paint,
    with_work: bool = False,
    says_all: bool = True,
) -> str:
    """The convergence test as text, JSON or CSV.

    Args:
        result: the test.
        name: that of the method.
        format: text, json or csv.
        paint: of the text.
        with_work: whether to show what the steps have cost.
        says_all: whether the text ends with a plot.
    """
    if format == "json":
        from garkcli.report.convergence_json import json_of

        return json_of(result, name, with_work)
    if format == "csv":
        return csv_of(result, with_work)
    lines = _text(result, name, paint)
    if with_work:
        lines += _work(result)
    if says_all:
        lines += _work_plot(result) if with_work else _plot(result)
    return "\n".join(lines) + "\n"


def render_failure(failure: Failure, format: str) -> str:
    """A test that has no result, for programs: its errors, or a table without rows. People are told
    elsewhere.
    """
    if format == "json":
        from garkcli.report.convergence_json import json_of_failure

        return json_of_failure(failure)
    return "h,h_exact,error,slope\n" if format == "csv" else ""


def _text(result: Convergence, name: str, paint: Paint) -> list[str]:
    about = f"{describe(result.problem)}; to t = {result.t_end}"
    lines = [paint("strong", line) for line in wrap(name, WIDTH)]
    lines += indented(wrapped(about))
    lines += indented(driving(result.problem, result.method))
    for block in _tables(result):
        lines.append("")
        lines += indented(block)
    lines.append("")
    lines += _orders(result, paint)
    for text in (*remarks(result), result.visible.trees):
        lines += indented(wrapped(text))
    return lines


def _plot(result: Convergence) -> list[str]:
    """The errors over step sizes, after an empty line; none where there are no two."""
    positive = [row for row in result.rows if row.error > 0]
    if len(positive) < 2:
        return []
    plot = terminal_curves({POINT: [(row.h, row.error) for row in positive]}, "h")
    return ["", *indented(plot.splitlines())]


def _tables(result: Convergence) -> list[list[str]]:
    """The columns side by side; those of invariants below each other where they are too wide."""
    rows = result.rows
    steps = ["h"]
    steps += [str(row.h) for row in rows]
    errors = ["error"]
    errors += [rounded(row.error) for row in rows]
    slopes = ["slope"]
    slopes += [_slope(row) for row in rows]
    columns = [errors, slopes]
    energies = [row.energy_error for row in rows if row.energy_error is not None]
    if energies:
        columns.append(["energy error", *map(rounded, energies)])
    for k, name in enumerate(invariant_names(result)):
        column = [f"{_short_name(name)} error"]
        column += [rounded(row.invariant_errors[k]) for row in rows]
        columns.append(column)
    if any(row.digits is not None for row in rows):
        digits = ["digits"]
        digits += [_digits(row) for row in rows]
        columns.append(digits)
    return _fitting(steps, columns)


def _fitting(steps: Sequence[str], columns: list[list[str]]) -> list[list[str]]:
    """Tables with the step sizes on the left and as many of the columns as fit."""
    tables = []
    while columns:
        shown = [steps, *columns]
        while len(shown) > 2 and _width(shown) > WIDTH - _INDENT:
            shown.pop()
        table = list(zip(*shown, strict=True))
        tables.append(aligned(table, gap=_GAP))
        columns = columns[len(shown) - 1 :]
    return tables


def _width(columns: Sequence[Sequence[str]]) -> int:
    widths = [max(map(len, column)) for column in columns]
    gaps = len(_GAP) * (len(widths) - 1)
    return sum(widths) + gaps


def _short_name(name: str) -> str:
    if len(name) <= _LONGEST_HEAD:
        return name
    beginning = name[: _LONGEST_HEAD - 1]
    return f"{beginning}…"


def _slope(row: Row) -> str:
    if row.slope is None:
        return ""
    return f"{row.slope:.3f}"


def _digits(row: Row) -> str:
    if row.digits is None:
        return ""
    return "float" if row.digits <= FLOAT_DIGITS else str(row.digits)


def _orders(result: Convergence, paint: Paint) -> list[str]:
    """The observed order, the one to be observed, that of the method, and the verdict.

    Where the problem hides the trees that fail, observed and visible order agree on what is no
    order of the method: then that is said apart.
    """
    observed = order_text(result.observed_order)
    head = f"  order   observed {observed}, on this problem {exactly(result)}"
    last = verdict(result, paint)
    if result.hides_failure:
        return [f"{head}: {last}", f"          {hidden(result)}"]
    tail = f"of the {word_for(result.method)} {predicted(result)}: "
    unpainted = verdict(result, Paint())
    whole = f"{head}, {tail}{unpainted}"
    if len(whole) > WIDTH:
        return [f"{head},", f"          {tail}{last}"]
    return [f"{head}, {tail}{last}"]


def order_text(order: float | None) -> str:
    """An observed order; never −0.00."""
    if order is None:
        return "none"
    without_sign_of_zero = round(order, 2) + 0.0
    return f"{without_sign_of_zero:.2f}"


def exactly(result: Convergence) -> str:
    """The order to be observed, and whether a larger one would do."""
    how = "exactly" if result.visible.is_sharp else "or more"
    return f"{result.visible_order} {how}"


def predicted(result: Convergence) -> str:
    """The order of the method."""
    order = result.predicted_order
    return f"{order} or more" if order >= MAX_ORDER else str(order)


def hidden(result: Convergence) -> str:
    """Whose order the visible one is not."""
    order = result.predicted_order
    failing = f"its failing trees of order {order + 1}"
    return f"the {word_for(result.method)} has order {order}: {failing} are not seen here"


def verdict(result: Convergence, paint: Paint) -> str:
    """The last word: "they agree", or not."""
    if result.verdict == "undecided":
        return paint("note", "undecided")
    if result.verdict == "reduced":
        return paint("note", "reduced by stiffness")
    return paint.verdict(result.verdict == "agree", "they agree", "THEY DISAGREE")


def remarks(result: Convergence) -> list[str]:
    """What there is to say about the verdict."""
    said = []
    if result.plateau:
        said.append(
            f"the last {result.plateau} rows show the rounding of the coefficients "
            "and are not fitted"
        )
    if result.stiff is not None:
        said.append(_of_stiffness(result, result.stiff))
    if result.is_at_rest:
        said.append("the solution does not move, so that no method makes an error: start elsewhere")
    elif result.is_exact:
        word = word_for(result.method)
        said.append(
            f"the {word} makes no error on this problem, which shows no order: take another"
        )
    elif result.short_time is not None:
        said.append(_of_short_time(result))
    elif not result.has_settled:
        said.append("the rounding of the coefficients comes before the slopes have settled")
    if len(result.rows) == 1 and not result.is_exact:
        said.append("one step size shows no order")
    return said


def _of_stiffness(result: Convergence, stiff: Stiffness) -> str:
    """What the slopes of a stiff problem are to be held against."""
    size = scientific(arb(stiff.resolution), 1)
    if not stiff.is_stable:
        return f"h ‖∂f/∂y‖ is {size} or more, and the steps are not stable there"
    return (
        f"stiff: h ‖∂f/∂y‖ is {size} or more; classical order {predicted(result)}, "
        f"stage order {stiff.stage_order}"
    )


def _of_short_time(result: Convergence) -> str:
    observed, short = result.observed_order, result.short_order
    time = scientific(arb(result.short_time), 1)
    tiny = f"with tiny steps, to t = {time}, it is {order_text(short)}"
    if result.verdict == "reduced":
        return tiny
    if observed is None or short is None:
        return f"at these step sizes the order has not settled; {tiny}"
    if abs(observed - short) <= CLOSE:
        return f"the problem hides the trees that fail, or their errors cancel: {tiny}"
    is_whole = abs(observed - round(observed)) <= CLOSE
    if is_whole and short < observed:
        failing = round(short) + 1
        missed = f"conditions of order {failing} are missed by little"
        return f"{missed}, which these step sizes do not show; {tiny}"
    return f"at these step sizes the order has not settled; {tiny}"


def work_cells(cost: Cost | None) -> list[str]:
    """The cells below ``WORK``."""
    if cost is None:
        return [""] * len(WORK)
    counts = (cost.steps, cost.evaluations, cost.iterations, cost.jacobians)
    cells = [str(count) for count in counts]
    seconds = ""
    if cost.seconds is not None:
        seconds = scientific(arb(cost.seconds))
    cells.append(seconds)
    return cells


def _work(result: Convergence) -> list[str]:
    """What the steps have cost."""
    cells = [["h", "error", *WORK]]
    is_timed = True
    for row in result.rows:
        error = rounded(row.error)
        cells.append([str(row.h), error, *work_cells(row.cost)])
        is_timed &= row.cost is not None and row.cost.seconds is not None
    lines = ["work", *aligned(cells)]
    if not is_timed:
        lines.append(NO_TIME)
    return ["", *indented(lines)]


def _work_plot(result: Convergence) -> list[str]:
    """The errors over what they have cost, after an empty line."""
    points = [
        (float(row.cost.evaluations), row.error) for row in result.rows if row.cost is not None
    ]
    plot = terminal_curves({POINT: points}, "evaluations")
    return ["", *indented(plot.splitlines())]


def wrapped(text: str, width: int = 76) -> list[str]:
    """The lines of a paragraph."""
    return wrap(text, width)
