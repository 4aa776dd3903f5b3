"""``gark converge``: the table of errors, the order that they show, and the verdict."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from flint import arb

from garkcli.convergence.result import CLOSE, MAX_ORDER, Convergence, Cost, Row
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.report.asciiplot import terminal_curves, terminal_plot
from garkcli.report.convergence_data import csv_of, invariant_names, json_of
from garkcli.report.figures import rounded, scientific
from garkcli.report.paint import Paint, aligned

WIDTH = 80
"""Columns of a terminal."""
NO_TIME = (
    "no seconds where floats do not reach the error: the counts are for more digits"
)
WORK = ("steps", "evaluations", "iterations", "Jacobians", "seconds")
"""What is counted, as column heads."""
_LONGEST = 80  # characters of a Hamiltonian that are still shown
_LONGEST_HEAD = 40  # characters of the name of an invariant above a column
_INDENT = 2
_GAP = "   "


def render(
    result: Convergence,
    name: str,
    format: str,
    paint: Paint,
    with_work: bool = False,
) -> str:
    """The convergence test as text, JSON or CSV; ``with_work`` what its steps have cost."""
    if format == "json":
        return json_of(result, name, with_work)
    if format == "csv":
        return csv_of(result, with_work)
    return "\n".join(_text(result, name, paint, with_work)) + "\n"


def _text(result: Convergence, name: str, paint: Paint, with_work: bool) -> list[str]:
    about = f"{describe(result.problem)}; to t = {result.t_end}"
    lines = [paint("strong", line) for line in wrap(name, WIDTH)]
    lines += [f"  {line}" for line in wrapped(about)]
    for block in _tables(result):
        lines += ["", *(f"  {line}" for line in block)]
    lines += ["", *_orders(result, paint)]
    for text in (*remarks(result), result.visible.trees):
        lines += [f"  {line}" for line in wrapped(text)]
    if with_work:
        return [*lines, *_work(result)]
    positive = [row for row in result.rows if row.error > 0]
    if len(positive) > 1:
        plot = terminal_plot(
            [row.h for row in positive], [row.error for row in positive]
        )
        lines += ["", *(f"  {line}" for line in plot.splitlines())]
    return lines


def describe(problem: Oscillator | Hamiltonian) -> str:
    """A problem and its split in one line."""
    if isinstance(problem, Hamiltonian):
        return _described(problem)
    terms = [
        f"H{{{l}}}: {_energy(k, v)}" for l, (k, v) in enumerate(problem.shares, start=1)
    ]
    return f"q̈ = −ω²q, ω = {problem.omega}; {', '.join(terms)}"


def _energy(k: object, v: object) -> str:
    terms = []
    for share, energy in ((k, "½p²"), (v, "½ω²q²")):
        if share == 1:
            terms.append(energy)
        elif share != 0:
            terms.append(f"{share}·{energy}")
    return " + ".join(terms) or "0"


def _described(problem: Hamiltonian) -> str:
    texts = [str(term).replace("**", "^") for term in problem.terms]
    if sum(map(len, texts)) > _LONGEST:
        terms = f"{len(texts)} terms" if len(texts) > 1 else "one term"
        return f"{problem.name}, H in {terms} of {', '.join(problem.variables)} and their momenta"
    terms = ", ".join(f"H{{{l}}}: {text}" for l, text in enumerate(texts, start=1))
    return f"{problem.name}; {terms}"


def _tables(result: Convergence) -> list[list[str]]:
    """The columns side by side; those of invariants below each other where they are too wide."""
    steps = ["h", *(str(row.h) for row in result.rows)]
    columns = [
        ["error", *(rounded(row.error) for row in result.rows)],
        ["slope", *(_slope(row) for row in result.rows)],
        ["energy error", *(rounded(row.energy_error) for row in result.rows)],
    ]
    for k, name in enumerate(invariant_names(result)):
        cells = [rounded(row.invariant_errors[k]) for row in result.rows]
        columns.append([f"{_short_name(name)} error", *cells])
    if any(row.digits is not None for row in result.rows):
        columns.append(["digits", *(_digits(row) for row in result.rows)])

    tables = []
    while columns:
        count = len(columns)
        while count > 1 and _width([steps, *columns[:count]]) > WIDTH - _INDENT:
            count -= 1
        rows = list(zip(steps, *columns[:count], strict=True))
        tables.append(aligned(rows, gap=_GAP))
        columns = columns[count:]
    return tables


def _width(columns: Sequence[Sequence[str]]) -> int:
    return sum(max(map(len, column)) for column in columns) + len(_GAP) * (
        len(columns) - 1
    )


def _short_name(name: str) -> str:
    return name if len(name) <= _LONGEST_HEAD else f"{name[: _LONGEST_HEAD - 1]}…"


def _slope(row: Row) -> str:
    return "" if row.slope is None else f"{row.slope:.3f}"


def _digits(row: Row) -> str:
    if row.digits is None:
        return ""
    return "float" if row.digits <= FLOAT_DIGITS else str(row.digits)


def _orders(result: Convergence, paint: Paint) -> list[str]:
    """The observed order, the one to be observed, that of the method, and the verdict.

    Where the problem hides the trees that fail, observed and visible order agree on what is no
    order of the method: then that is said apart.
    """
    head = f"  order   observed {order_text(result.observed_order)}, "
    head += f"on this problem {exactly(result)}"
    last = verdict(result, paint)
    if result.hides_failure:
        return [f"{head}: {last}", f"          {hidden(result)}"]
    tail = f"of the method {predicted(result)}: "
    if len(f"{head}, {tail}{verdict(result, Paint())}") > WIDTH:
        return [f"{head},", f"          {tail}{last}"]
    return [f"{head}, {tail}{last}"]


def order_text(order: float | None) -> str:
    """An observed order; never −0.00."""
    return "none" if order is None else f"{round(order, 2) + 0.0:.2f}"


def exactly(result: Convergence) -> str:
    """The order to be observed, and whether a larger one would do."""
    return (
        f"{result.visible_order} {'exactly' if result.visible.is_sharp else 'or more'}"
    )


def predicted(result: Convergence) -> str:
    """The order of the method."""
    return f"{result.predicted_order}{' or more' if result.predicted_order >= MAX_ORDER else ''}"


def hidden(result: Convergence) -> str:
    """Whose order the visible one is not."""
    order = result.predicted_order
    return f"the method has order {order}: its failing trees of order {order + 1} are not seen here"


def verdict(result: Convergence, paint: Paint) -> str:
    """The last word: "they agree", or not."""
    if result.verdict == "undecided":
        return paint("note", "undecided")
    return paint.verdict(result.verdict == "agree", "they agree", "THEY DISAGREE")


def remarks(result: Convergence) -> list[str]:
    """What there is to say about the verdict."""
    said = []
    if result.plateau:
        said.append(
            f"the last {result.plateau} rows show the rounding of the coefficients "
            "and are not fitted"
        )
    if result.is_exact:
        said.append("the method makes no error on this problem")
    elif result.short_time is not None:
        said.append(_of_short_time(result))
    elif not result.has_settled:
        said.append(
            "the rounding of the coefficients comes before the slopes have settled"
        )
    if len(result.rows) == 1 and result.verdict == "undecided":
        said.append("one step size shows no order")
    return said


def _of_short_time(result: Convergence) -> str:
    observed, short = result.observed_order, result.short_order
    time = scientific(arb(result.short_time), 1)
    tiny = f"with tiny steps, to t = {time}, it is {order_text(short)}"
    if observed is None or short is None:
        return f"at these step sizes the order has not settled; {tiny}"
    if abs(observed - short) <= CLOSE:
        return f"the problem hides the trees that fail, or their errors cancel: {tiny}"
    if abs(observed - round(observed)) <= CLOSE and short < observed:
        missed = f"conditions of order {round(short) + 1} are missed by little"
        return f"{missed}, which these step sizes do not show; {tiny}"
    return f"at these step sizes the order has not settled; {tiny}"


def work_cells(cost: Cost | None) -> list[str]:
    """The cells below ``WORK``."""
    if cost is None:
        return [""] * len(WORK)
    counts = (cost.steps, cost.evaluations, cost.iterations, cost.jacobians)
    seconds = "" if cost.seconds is None else scientific(arb(cost.seconds))
    return [*map(str, counts), seconds]


def _work(result: Convergence) -> list[str]:
    """What the steps have cost, and a plot of it."""
    cells = [
        [str(row.h), rounded(row.error), *work_cells(row.cost)] for row in result.rows
    ]
    table = aligned([["h", "error", *WORK], *cells])
    lines = ["", "  work", *(f"  {line}" for line in table)]
    costs = [row.cost for row in result.rows]
    if any(cost is None or cost.seconds is None for cost in costs):
        lines.append(f"  {NO_TIME}")
    points = [
        (float(x.cost.evaluations), x.error) for x in result.rows if x.cost is not None
    ]
    plot = terminal_curves({"•": points}, "evaluations")
    return [*lines, "", *(f"  {line}" for line in plot.splitlines())]


def wrapped(text: str, width: int = 76) -> list[str]:
    """The lines of a paragraph."""
    return wrap(text, width)
