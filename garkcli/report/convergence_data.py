"""Convergence tests for programs: JSON and CSV, of one method and of several."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from garkcli.convergence.convergence import LINEAR_ONLY, Convergence, Row
from garkcli.convergence.nonlinear import Observation
from garkcli.convergence.trial import PathRow
from garkcli.convergence.work import Cost
from garkcli.errors import Fault
from garkcli.exact.display import to_float
from garkcli.report.figures import scientific

Result: TypeAlias = Convergence | Observation
"""A convergence test, on the oscillator or on a nonlinear problem."""
_DIGITS = 6  # of errors in CSV; they are good to as many


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
    result: Result | None
    faults: tuple[Fault, ...]
    exit_code: int


def json_of(result: Result, name: str, with_work: bool) -> str:
    """One test as JSON."""
    return _dumped(_data(result, name, with_work))


def json_of_several(entries: Sequence[Entry], with_work: bool) -> str:
    """Several tests as JSON."""
    results = []
    for entry in entries:
        head: dict[str, Any] = {"file": entry.file, "ok": entry.exit_code == 0}
        if entry.result is None:
            errors = [
                {"line": x.line, "column": x.column, "message": x.message, "help": x.help}
                for x in entry.faults
            ]
            results.append({**head, "name": entry.name, "errors": errors})
        else:
            results.append({**head, **_data(entry.result, entry.name, with_work)})
    failed = sum(entry.exit_code != 0 for entry in entries)
    return _dumped(
        {
            "schema": "gark/converge-comparison/1",
            "results": results,
            "summary": {"files": len(entries), "failed": failed},
        }
    )


def _dumped(data: dict[str, Any]) -> str:
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _data(result: Result, name: str, with_work: bool) -> dict[str, Any]:
    return {
        "schema": "gark/converge/1",
        "problem": problem_name(result),
        "name": name,
        **_split(result),
        "t_end": str(result.t_end),
        "predicted_order": result.predicted_order,
        "visible_order": result.visible_order,
        "observed_order": result.observed_order,
        "agrees": result.agrees,
        "verdict": result.verdict,
        **_short(result),
        "steps": [
            {
                "h": to_float(row.h),
                "h_exact": str(row.h),
                "error": float(row.error),
                "slope": row.slope,
                "energy_error": float(row.energy_error),
                **_path(result, row),
                **({"work": _work(row.cost)} if with_work else {}),
            }
            for row in result.rows
        ],
        "note": note(result),
    }


def problem_name(result: Result) -> str:
    """What --problem calls it."""
    return result.problem.name if isinstance(result, Observation) else "oscillator"


def note(result: Result) -> str:
    """Which trees the problem can see."""
    return result.sees if isinstance(result, Observation) else LINEAR_ONLY


def _split(result: Result) -> dict[str, Any]:
    if isinstance(result, Observation):
        return {
            "hamiltonian": [str(term) for term in result.problem.terms],
            "plateau": result.plateau,
        }
    return {
        "omega": str(result.problem.omega),
        "split": [[str(k), str(v)] for k, v in result.problem.shares],
    }


def _short(result: Result) -> dict[str, Any]:
    if not isinstance(result, Observation) or result.short_time is None:
        return {}
    return {"short": {"t_end": str(result.short_time), "observed_order": result.short_order}}


def _path(result: Result, row: Row) -> dict[str, Any]:
    if not (isinstance(result, Observation) and isinstance(row, PathRow)):
        return {}
    names = (name for name, _ in result.problem.invariants)
    errors = {name: float(error) for name, error in zip(names, row.invariant_errors, strict=True)}
    return {"digits": row.digits, "invariant_errors": errors}


def _work(cost: Cost | None) -> dict[str, Any] | None:
    if cost is None:
        return None
    return {
        "steps": cost.steps,
        "evaluations": cost.evaluations,
        "newton_iterations": cost.iterations,
        "jacobians": cost.jacobians,
        "seconds": cost.seconds,
    }


def csv_of(result: Result, with_work: bool) -> str:
    """One test as CSV, a row a step size."""
    return _written([([], result)], [], with_work)


def csv_of_several(entries: Sequence[Entry], with_work: bool) -> str:
    """Several tests as CSV, a row a method and step size; methods without a result have none."""
    tests = [
        ([entry.file, entry.name], entry.result) for entry in entries if entry.result is not None
    ]
    return _written(tests, ["file", "method"], with_work)


def _written(tests: Sequence[tuple[list[str], Result]], first: list[str], with_work: bool) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        [*first, *_columns(tests[0][1] if tests else None), *(_WORK if with_work else ())]
    )
    for cells, result in tests:
        for row in result.rows:
            writer.writerow([*cells, *_cells(row), *(_work_cells(row.cost) if with_work else ())])
    return text.getvalue()


_WORK = ("steps", "evaluations", "newton_iterations", "jacobians", "seconds")


def _columns(result: Result | None) -> list[str]:
    columns = ["h", "h_exact", "error", "slope", "energy_error"]
    if isinstance(result, Observation):
        columns += [f"{name.replace(' ', '_')}_error" for name, _ in result.problem.invariants]
        columns.append("digits")
    return columns


def _cells(row: Row) -> list[str]:
    slope = "" if row.slope is None else f"{row.slope:.4f}"
    cells = [repr(to_float(row.h)), str(row.h), scientific(row.error, _DIGITS), slope]
    cells.append(scientific(row.energy_error, _DIGITS))
    if isinstance(row, PathRow):
        cells += [*(scientific(x, _DIGITS) for x in row.invariant_errors), str(row.digits)]
    return cells


def _work_cells(cost: Cost | None) -> list[str]:
    values = (_work(cost) or {}).values()
    return [
        "" if x is None else f"{x:.4g}" if isinstance(x, float) else str(x) for x in values
    ] or [""] * len(_WORK)
