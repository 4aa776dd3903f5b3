"""``gark energy``: conserved quantities over a long time, as text, JSON or CSV."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.courses import Course, LongRun
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.report.energy_text import Report, text_of
from garkcli.report.paint import Paint
from garkcli.report.plain import csv_cell


def render(report: Report, format: str, paint: Paint, is_long: bool = True) -> str:  # noqa: A002
    """The report as text, JSON or CSV; see ``text_of``."""
    if format == "json":
        return json.dumps(_data(report), indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    if format == "csv":
        return _csv(report.run)
    return "\n".join(text_of(report, paint, is_long)) + "\n"


def _csv(run: LongRun) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = [csv_cell(course.name.replace(" ", "_")) for course in run.courses]
    writer.writerow(["t", *(f"{name}_error" for name in names)])
    for t, *errors in zip(run.times, *(course.errors for course in run.courses), strict=True):
        writer.writerow([repr(t), *map(repr, errors)])
    return stream.getvalue()


def _data(report: Report) -> dict[str, Any]:
    run = report.run
    return {
        "schema": "gark/energy/1",
        **_problem(run),
        "name": report.name,
        "step": to_float(run.step),
        "step_exact": str(run.step),
        "t_end": to_float(run.t_end),
        "t_end_exact": str(run.t_end),
        "steps": run.steps,
        "digits": run.digits,
        "turns": None if run.digits is None else run.turns,
        "blew_up": run.blew_up,
        "drifts": run.drifts,
        "quantities": [_quantity(course, run) for course in run.courses],
        "symplectic": _symplectic_data(report),
        "claims": [{"claim": x.claim, "found": x.found, "holds": x.holds} for x in report.claims],
    }


def _problem(run: LongRun) -> dict[str, Any]:
    if isinstance(run.problem, Hamiltonian):
        return {
            "problem": run.problem.name,
            "hamiltonian": [str(term) for term in run.problem.terms],
        }
    shares = [[str(k), str(v)] for k, v in run.problem.shares]
    return {"problem": "oscillator", "omega": str(run.problem.omega), "split": shares}


def _quantity(course: Course, run: LongRun) -> dict[str, Any]:
    return {
        "name": course.name,
        "initial": course.initial,
        "max_error": course.max_error,
        "drift": course.drift,
        "drift_uncertainty": course.uncertainty,
        "drift_in_all": None if course.drift is None else course.drift * run.end,
        "oscillation": course.amplitude,
        "round_off": course.round_off,
        "verdict": course.verdict,
        "trend": course.shape,
    }


def _symplectic_data(report: Report) -> dict[str, Any]:
    found: dict[str, Any] = {"proved": report.symplecticity.is_proved}
    if report.run.stability is not None:
        found["determinant_minus_1"] = to_decimal(report.run.stability.determinant - 1, 4)
    found["defects"] = [
        {"t": to_float(x.time), "size": x.size, "good_to": x.error}
        for x in report.symplecticity.defects
    ]
    return found
