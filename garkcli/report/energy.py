"""``gark energy``: conserved quantities over a long time, as text, JSON or CSV."""

from __future__ import annotations

import csv
import io
from typing import Any

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.problems.oscillator import Oscillator
from garkcli.report.convergence_data import terms_data
from garkcli.report.energy_text import Report, text_of
from garkcli.report.json_text import to_json
from garkcli.report.paint import Paint
from garkcli.report.plain import csv_cell


def render(report: Report, format: str, paint: Paint, is_long: bool = True) -> str:
    """The report as text, JSON or CSV; see ``text_of``."""
    if format == "json":
        return to_json(_data(report)) + "\n"
    if format == "csv":
        return _csv(report.run)
    return "\n".join(text_of(report, paint, is_long)) + "\n"


def _csv(run: LongRun) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = [csv_cell(history.name.replace(" ", "_")) for history in run.invariants]
    writer.writerow(["t", *(f"{name}_error" for name in names)])
    columns = [history.errors for history in run.invariants]
    for t, *errors in zip(run.times, *columns, strict=True):
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
        "blew_up": run.is_unstable and run.escaped is None,
        "escaped_at": None if run.escaped is None else to_float(run.escaped),
        "drifts": run.drifts,
        "quantities": [_quantity(history, run) for history in run.invariants],
        "symplectic": _symplectic_data(report),
        "claims": [
            {"claim": x.claim, "found": x.found, "holds": x.holds}
            for x in report.claims
        ],
    }


def _problem(run: LongRun) -> dict[str, Any]:
    if not isinstance(run.problem, Oscillator):
        return {"problem": run.problem.name, **terms_data(run.problem)}
    shares = [[str(k), str(v)] for k, v in run.problem.shares]
    return {"problem": "oscillator", "omega": str(run.problem.omega), "split": shares}


def _quantity(history: InvariantHistory, run: LongRun) -> dict[str, Any]:
    drift = history.drift
    return {
        "name": history.name,
        "initial": history.initial,
        "max_error": history.max_error,
        "drift": drift,
        "drift_uncertainty": history.uncertainty,
        "drift_in_all": None if drift is None else drift * run.end,
        "oscillation": history.amplitude,
        "round_off": history.round_off,
        "rounded_coefficients": history.coefficients,
        "verdict": history.verdict,
        "trend": history.shape,
        "t_end_to_decide": None if history.longer is None else to_float(history.longer),
    }


def _symplectic_data(report: Report) -> dict[str, Any] | None:
    if report.symplecticity is None:
        return None
    found: dict[str, Any] = {"proved": report.symplecticity.is_proved}
    if report.run.stability is not None:
        found["determinant_minus_1"] = to_decimal(
            report.run.stability.determinant - 1, 4
        )
    found["defects"] = [
        {"t": to_float(x.time), "size": x.size, "good_to": x.error}
        for x in report.symplecticity.defects
    ]
    return found
