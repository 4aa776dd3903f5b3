"""``gark converge``: the table of errors and the energy over a long time."""

from __future__ import annotations

from flint import arb

from garkcli.convergence.convergence import CLOSE, MAX_ORDER, Row
from garkcli.convergence.nonlinear import Observation
from garkcli.convergence.work import Cost
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.report.asciiplot import terminal_curves, terminal_plot
from garkcli.report.convergence_data import Result, csv_of, json_of, note
from garkcli.report.figures import rounded, scientific
from garkcli.report.paint import Paint, aligned

WIDTH = 80
"""Columns of a terminal."""
_LONGEST = 80  # characters of a Hamiltonian that are still shown
NO_TIME = "no seconds where floats do not reach the error: the counts are for more digits"


def render(result: Result, name: str, format: str, paint: Paint, with_work: bool = False) -> str:  # noqa: A002
    """The convergence test as text, JSON or CSV; ``with_work`` what its steps have cost."""
    if format == "json":
        return json_of(result, name, with_work)
    if format == "csv":
        return csv_of(result, with_work)
    return "\n".join(_text(result, name, paint, with_work)) + "\n"


def _slope(row: Row) -> str:
    return "" if row.slope is None else f"{row.slope:.3f}"


def describe(problem: Oscillator | Hamiltonian) -> str:
    """A problem and its split in one line."""
    if isinstance(problem, Hamiltonian):
        return _described(problem)
    shares = ", ".join(
        f"H{{{l}}}: {_energy(k, v)}" for l, (k, v) in enumerate(problem.shares, start=1)
    )
    return f"q̈ = −ω²q, ω = {problem.omega}; {shares}"


def _energy(k: object, v: object) -> str:
    terms = [
        f"{'' if share == 1 else f'{share}·'}{energy}"
        for share, energy in ((k, "½p²"), (v, "½ω²q²"))
        if share != 0
    ]
    return " + ".join(terms) or "0"


def _described(problem: Hamiltonian) -> str:
    texts = [str(term).replace("**", "^") for term in problem.terms]
    if sum(map(len, texts)) > _LONGEST:
        terms = f"{len(texts)} terms" if len(texts) > 1 else "one term"
        return f"{problem.name}, H in {terms} of {', '.join(problem.variables)} and their momenta"
    return f"{problem.name}; " + ", ".join(
        f"H{{{l}}}: {text}" for l, text in enumerate(texts, start=1)
    )


def _table(result: Result) -> list[list[str]]:
    rows = [["h", "error", "slope", "energy error"]]
    rows += [
        [str(row.h), rounded(row.error), _slope(row), rounded(row.energy_error)]
        for row in result.rows
    ]
    if isinstance(result, Observation):
        names = [name for name, _ in result.problem.invariants]
        rows[0] += [*(f"{name} error" for name in names), "digits"]
        for cells, row in zip(rows[1:], result.rows, strict=True):
            digits = "float" if row.digits <= FLOAT_DIGITS else str(row.digits)
            cells += [*map(rounded, row.invariant_errors), digits]
    return rows


def exactly(result: Result) -> str:
    """The order to be observed, and whether a larger one would do."""
    is_bound = isinstance(result, Observation) and not result.problem.is_generic
    return f"{result.visible_order} {'or more' if is_bound else 'exactly'}"


def predicted(result: Result) -> str:
    """The order of the method."""
    return f"{result.predicted_order}{' or more' if result.predicted_order >= MAX_ORDER else ''}"


def verdict(result: Result, paint: Paint) -> str:
    """The last word: "they agree", or not."""
    if result.verdict == "undecided":
        return paint("note", "undecided")
    return paint.verdict(result.verdict == "agree", "they agree", "THEY DISAGREE")


def _of_short_time(result: Observation) -> str:
    order = "none" if result.short_order is None else f"{result.short_order:.2f}"
    tiny = f"with tiny steps, to t = {result.short_time}, it is {order}"
    observed, short = result.observed_order, result.short_order
    if observed is not None and short is not None and abs(observed - short) <= CLOSE:
        return f"the problem hides the trees that fail, or their errors cancel: {tiny}"
    return f"at these step sizes the order has not settled; {tiny}"


def remarks(result: Result) -> list[str]:
    """What there is to say about the verdict."""
    said = []
    if isinstance(result, Observation):
        if result.plateau:
            said.append(
                f"the last {result.plateau} rows show the rounding of the coefficients and are not fitted"
            )
        if result.is_exact:
            said.append("the method makes no error on this problem")
        elif result.short_time is not None:
            said.append(_of_short_time(result))
        elif not result.has_settled:
            said.append("the rounding of the coefficients comes before the slopes have settled")
    if len(result.rows) == 1 and result.verdict == "undecided":
        said.append("one step size shows no order")
    return said


def _text(result: Result, name: str, paint: Paint, with_work: bool) -> list[str]:
    about = f"{describe(result.problem)}; to t = {result.t_end}"
    lines = [paint("strong", name), *(f"  {line}" for line in wrapped(about)), ""]
    lines += [f"  {line}" for line in aligned(_table(result), gap="   ")]
    observed = "none" if result.observed_order is None else f"{result.observed_order:.2f}"
    head = f"  order   observed {observed}, on this problem {exactly(result)}, "
    tail = f"of the method {predicted(result)}: "
    if len(head + tail + verdict(result, Paint())) > WIDTH:
        tail = f"\n          {tail}"
    lines += [
        "",
        f"{head}{tail}{verdict(result, paint)}".replace(" \n", "\n"),
        *(f"  {line}" for text in (*remarks(result), note(result)) for line in wrapped(text)),
    ]
    if with_work:
        return [*lines, *_work(result)]
    positive = [row for row in result.rows if not row.error.contains(0)]
    if len(positive) > 1:
        hs, errors = [row.h for row in positive], [row.error for row in positive]
        lines += ["", *(f"  {line}" for line in terminal_plot(hs, errors).splitlines())]
    return lines


def work_cells(cost: Cost | None) -> list[str]:
    """The cells below ``WORK``."""
    if cost is None:
        return [""] * len(WORK)
    counts = (cost.steps, cost.evaluations, cost.iterations, cost.jacobians)
    return [*map(str, counts), "" if cost.seconds is None else scientific(arb(cost.seconds))]


WORK = ("steps", "evaluations", "iterations", "Jacobians", "seconds")
"""What is counted, as column heads."""


def _work(result: Result) -> list[str]:
    """What the steps have cost, and a plot of it."""
    rows = [["h", "error", *WORK]]
    rows += [[str(row.h), rounded(row.error), *work_cells(row.cost)] for row in result.rows]
    lines = ["", "  work", *(f"  {line}" for line in aligned(rows))]
    costs = [(row.cost, row.error) for row in result.rows if row.cost is not None]
    if len(costs) < len(result.rows) or any(cost.seconds is None for cost, _ in costs):
        lines.append(f"  {NO_TIME}")
    points = [(float(cost.evaluations), error) for cost, error in costs]
    return [
        *lines,
        "",
        *(f"  {line}" for line in terminal_curves({"•": points}, "evaluations").splitlines()),
    ]


def wrapped(text: str, width: int = 76) -> list[str]:
    """The lines of a paragraph."""
    from textwrap import wrap

    return wrap(text, width)
