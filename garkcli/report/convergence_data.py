"""Convergence tests for programs: JSON and CSV, of one method and of several."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from garkcli.convergence.result import Convergence, Cost, Row
from garkcli.errors import Fault
from garkcli.exact.display import to_float
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem
from garkcli.report.figures import for_programs
from garkcli.report.json_text import to_json
from garkcli.report.plain import csv_cell

_DIGITS = 6  # of errors
_SLOPE_DIGITS = 4  # decimal places of slopes and of observed orders
_WORK = ("steps", "evaluations", "newton_iterations", "jacobians", "seconds")


@dataclass(frozen=True)
class Entry:
    """One method of a comparison.

    Attributes:
        file: its path.
        name: of the method, or the path again.
        result: None where there is none.
        faults: why there is none.
        exit_code: 0 no disagreement, 1 it disagrees or a step fails, 2 it cannot be tested.
    """

    file: str
    name: str
    result: Convergence | None
    faults: tuple[Fault, ...]
    exit_code: int


def problem_name(result: Convergence) -> str:
    """What --problem calls it."""
    problem = result.problem
    return "oscillator" if isinstance(problem, Oscillator) else problem.name


def invariant_names(result: Convergence) -> list[str]:
    """Of the first integrals besides the energy."""
    problem = result.problem
    return (
        []
        if isinstance(problem, Oscillator)
        else [name for name, _ in problem.invariants]
    )


def json_of(result: Convergence, name: str, with_work: bool) -> str:
    """One test as JSON."""
    return _dumped(_data(result, name, with_work))


def json_of_several(entries: Sequence[Entry], with_work: bool) -> str:
    """Several tests as JSON."""
    results = []
    for entry in entries:
        is_fine = entry.exit_code == 0
        found: dict[str, Any] = {"file": entry.file, "ok": is_fine}
        if entry.result is None:
            found["name"] = entry.name
            found["errors"] = [_error(fault) for fault in entry.faults]
        else:
            found |= _data(entry.result, entry.name, with_work)
        results.append(found)
    failed = sum(entry.exit_code != 0 for entry in entries)
    comparison = {
        "schema": "gark/converge-comparison/1",
        "results": results,
        "summary": {"files": len(entries), "failed": failed},
    }
    return _dumped(comparison)


def _dumped(data: dict[str, Any]) -> str:
    return to_json(data) + "\n"


def _error(fault: Fault) -> dict[str, Any]:
    return {
        "line": fault.line,
        "column": fault.column,
        "message": fault.message,
        "help": fault.help,
    }


def _data(result: Convergence, name: str, with_work: bool) -> dict[str, Any]:
    names = invariant_names(result)
    data: dict[str, Any] = {
        "schema": "gark/converge/1",
        "problem": problem_name(result),
        "name": name,
        **_split(result),
        "t_end": str(result.t_end),
        "predicted_order": result.predicted_order,
        "visible_order": result.visible_order,
        "visible_order_is_exact": result.visible.is_sharp,
        "observed_order": _place(result.observed_order),
        "agrees": result.agrees,
        "verdict": result.verdict,
        "plateau": result.plateau,
    }
    if result.short_time is not None:
        order = _place(result.short_order)
        data["short"] = {"t_end": str(result.short_time), "observed_order": order}
    if result.stiff is not None:
        data["stiff"] = {
            "least_h_times_norm": float(f"{result.stiff.resolution:.3g}"),
            "classical_order": result.predicted_order,
            "stage_order": result.stiff.stage_order,
            "slope": _place(result.observed_order),
        }
    data["steps"] = [_step(row, names, with_work) for row in result.rows]
    data["note"] = result.visible.trees
    return data


def _split(result: Convergence) -> dict[str, Any]:
    problem = result.problem
    if isinstance(problem, Oscillator):
        split = [[str(k), str(v)] for k, v in problem.shares]
        return {"omega": str(problem.omega), "split": split}
    return terms_data(problem)


def terms_data(problem: Problem) -> dict[str, Any]:
    """The terms of a problem: Hamiltonians, or right-hand sides with their stiffness."""
    if isinstance(problem, Hamiltonian):
        return {"hamiltonian": [str(term) for term in problem.terms]}
    sides = [[str(x) for x in term] for term in problem.terms]
    stiffness = None if problem.stiffness is None else str(problem.stiffness)
    return {"right_hand_sides": sides, "stiffness": stiffness}


def _place(order: float | None) -> float | None:
    """An order or slope in as many decimal places as say something; never −0."""
    if order is None:
        return None
    return round(order, _SLOPE_DIGITS) + 0.0


def _step(row: Row, names: Sequence[str], with_work: bool) -> dict[str, Any]:
    errors = dict(zip(names, row.invariant_errors, strict=True))
    in_numbers = {name: _number(error) for name, error in errors.items()}
    energy = row.energy_error
    step: dict[str, Any] = {
        "h": to_float(row.h),
        "h_exact": str(row.h),
        "error": _number(row.error),
        "slope": _place(row.slope),
        "energy_error": None if energy is None else _number(energy),
        "digits": row.digits,
        "invariant_errors": in_numbers,
    }
    measured = dict(errors)
    if energy is not None:
        measured = {"energy": energy, **errors}
    below = []
    for name, x in measured.items():
        if x.contains(0) and not x.is_zero():
            below.append(name)
    if below:
        step["below_round_off"] = below
    if with_work:
        step["work"] = _work(row.cost)
    return step


def _number(ball: Any) -> float:
    return float(for_programs(ball, _DIGITS))


def _work(cost: Cost | None) -> dict[str, Any] | None:
    if cost is None:
        return None
    values = (
        cost.steps,
        cost.evaluations,
        cost.iterations,
        cost.jacobians,
        cost.seconds,
    )
    return dict(zip(_WORK, values, strict=True))


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
        slope = f"{row.slope:.{_SLOPE_DIGITS}f}"
    h = to_float(row.h)
    cells = [repr(h), str(row.h)]
    cells.append(for_programs(row.error, _DIGITS))
    cells.append(slope)
    if row.energy_error is not None:
        cells.append(for_programs(row.energy_error, _DIGITS))
    cells += [for_programs(x, _DIGITS) for x in row.invariant_errors]
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
