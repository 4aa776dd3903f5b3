"""``gark energy``: conserved quantities over a long time, as text, JSON or CSV."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.courses import Course, LongRun
from garkcli.longtime.energy import Drift
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.report.convergence import describe
from garkcli.report.energy_text import Report, text_of
from garkcli.report.paint import Paint


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
    writer.writerow(["t", *(f"{course.name.replace(' ', '_')}_error" for course in run.courses)])
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


def render_drift(result: Drift, name: str, format: str, paint: Paint) -> str:  # noqa: A002
    """The energy over a long time as text, JSON or CSV."""
    if format == "json":
        data = {
            "schema": "gark/drift/1",
            "problem": "oscillator",
            "name": name,
            "step": to_float(result.step),
            "t_end": to_float(result.t_end),
            "steps": result.steps,
            "initial_energy": result.initial_energy,
            "max_energy_error": result.max_energy_error,
            "drift": result.drift,
            "blew_up": result.blew_up,
        }
        return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
    if format == "csv":
        rows = zip(result.times, result.energy_errors, strict=True)
        return "t,energy_error\n" + "".join(f"{t!r},{e!r}\n" for t, e in rows)
    total = result.drift * to_float(result.t_end)
    lines = [
        paint("strong", name),
        f"  {describe(result.problem)}",
        f"  step {result.step} to t = {result.t_end}: {result.steps} steps, energy {result.initial_energy:.6g}",
        "",
        f"  largest energy error  {result.max_energy_error:.4e}",
        f"  drift                 {result.drift:.2e} per unit of time, {total:.2e} in all",
    ]
    if result.blew_up:
        lines.append(f"  {paint('bad', 'unstable')}: the energy has blown up")
    return "\n".join(lines) + "\n"
