"""Convergence tests for programs: CSV, and what it has in common with JSON."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass

from garkcli.convergence.result import Convergence, Cost, Row
from garkcli.errors import Fault
from garkcli.exact.display import to_float
from garkcli.page.figures import for_programs
from garkcli.page.plain import csv_cell
from garkcli.problems.oscillator import Oscillator

DIGITS = 6
"""Of errors."""
SLOPE_DIGITS = 4
"""Decimal places of slopes and of observed orders."""
_WORK = ("steps", "evaluations", "newton_iterations", "jacobians", "seconds")


@dataclass(frozen=True)
class Entry:
    """One method of a comparison.

    Attributes:
        file: its path.
        name: of the method, or the path again.
        result: None where there is none.
        faults: why there is none.
        exit_code: 0 no disagreement, 1 it disagrees or a step fails, 2 it cannot be tested, 3 it is
            undecided.
    """

    file: str
    name: str
    result: Convergence | None
    faults: tuple[Fault, ...]
    exit_code: int


def invariant_names(result: Convergence) -> list[str]:
    """Of the first integrals besides the energy."""
    problem = result.problem
    if isinstance(problem, Oscillator):
        return []
    return [name for name, _ in problem.invariants]


def csv_of(result: Convergence, with_work: bool) -> str:
    """One test as CSV, a row a step size."""
    return _written([([], result)], [], with_work)


def csv_of_several(entries: Sequence[Entry], with_work: bool) -> str:
    """Several tests as CSV, a row a method and step size; methods without a result have none."""
    tests = [([x.file, x.name], x.result) for x in entries if x.result is not None]
    return _written(tests, ["file", "method"], with_work)


def _written(
    tests: Sequence[tuple[list[str], Convergence]], first: list[str], with_work: bool
) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns = _columns(None)
    if tests:
        _, example = tests[0]
        columns = _columns(example)
    heads = [csv_cell(head) for head in (*first, *columns)]
    if with_work:
        heads += _WORK
    writer.writerow(heads)
    for cells, result in tests:
        # names are of strangers, numbers are ours
        names = [csv_cell(cell) for cell in cells]
        for row in result.rows:
            found = names + _cells(row)
            if with_work:
                found += _work_cells(row.cost)
            writer.writerow(found)
    return text.getvalue()


def _columns(result: Convergence | None) -> list[str]:
    columns = ["h", "h_exact", "error", "slope"]
    if result is None or _has_energy(result):
        columns.append("energy_error")
    if result is not None:
        for name in invariant_names(result):
            word = name.replace(" ", "_")
            columns.append(f"{word}_error")
        if any(row.digits is not None for row in result.rows):
            columns.append("digits")
    return columns


def _has_energy(result: Convergence) -> bool:
    return all(row.energy_error is not None for row in result.rows)


def _cells(row: Row) -> list[str]:
    slope = ""
    if row.slope is not None:
        slope = f"{row.slope:.{SLOPE_DIGITS}f}"
    h = to_float(row.h)
    cells = [repr(h), str(row.h)]
    cells.append(for_programs(row.error, DIGITS))
    cells.append(slope)
    cells.append(for_programs(row.energy_error, DIGITS))
    cells += [for_programs(x, DIGITS) for x in row.invariant_errors]
    if row.digits is not None:
        cells.append(str(row.digits))
    return cells


def _work_cells(cost: Cost | None) -> list[str]:
    if cost is None:
        return [""] * len(_WORK)
    counts = (cost.steps, cost.evaluations, cost.iterations, cost.jacobians)
    cells = [str(count) for count in counts]
    seconds = ""
    if cost.seconds is not None:
        seconds = f"{cost.seconds:.4g}"
    cells.append(seconds)
    return cells
