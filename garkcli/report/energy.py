"""The energy over a long time, as text, JSON or CSV."""

from __future__ import annotations

import json

from garkcli.dynamics.energy import Drift
from garkcli.exact.display import to_float
from garkcli.report.convergence import describe
from garkcli.report.paint import Paint


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
