"""``gark converge``: the table of errors and the energy over a long time."""

from __future__ import annotations

import json
from typing import Any, TypeAlias

from garkcli.dynamics.convergence import LINEAR_ONLY, Convergence, Row
from garkcli.dynamics.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.dynamics.nonlinear import Observation, PathRow
from garkcli.dynamics.problems import Oscillator
from garkcli.exact.display import to_float
from garkcli.report.asciiplot import terminal_plot
from garkcli.report.paint import Paint, aligned

Result: TypeAlias = Convergence | Observation
"""A convergence test, on the oscillator or on a nonlinear problem."""
_LONGEST = 80  # characters of a Hamiltonian that are still shown


def render(result: Result, name: str, format: str, paint: Paint) -> str:  # noqa: A002
    """The convergence test as text, JSON or CSV."""
    if format == "json":
        return json.dumps(_data(result, name), indent=2, ensure_ascii=False) + "\n"
    if format == "csv":
        rows = ((row.h, _short(row.error), _slope(row), _short(row.energy_error)) for row in result.rows)
        return "h,error,slope,energy_error\n" + "".join(f"{h},{e},{s},{d}\n" for h, e, s, d in rows)
    return "\n".join(_text(result, name, paint)) + "\n"


def _short(ball: Any) -> str:
    return "0" if ball.is_zero() else str(ball.str(4, radius=False))


def _slope(row: Row) -> str:
    return "" if row.slope is None else f"{row.slope:.3f}"


def _data(result: Result, name: str) -> dict[str, Any]:
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
        "steps": [
            {
                "h": to_float(row.h),
                "h_exact": str(row.h),
                "error": float(row.error),
                "slope": row.slope,
                "energy_error": float(row.energy_error),
                **_path(result, row),
            }
            for row in result.rows
        ],
        "note": _note(result),
    }


def problem_name(result: Result) -> str:
    """What --problem calls it."""
    return result.problem.name if isinstance(result, Observation) else "oscillator"


def _split(result: Result) -> dict[str, Any]:
    if isinstance(result, Observation):
        return {"hamiltonian": [str(term) for term in result.problem.terms], "plateau": result.plateau}
    return {"omega": str(result.problem.omega), "split": [[str(k), str(v)] for k, v in result.problem.shares]}


def _path(result: Result, row: Row) -> dict[str, Any]:
    if not (isinstance(result, Observation) and isinstance(row, PathRow)):
        return {}
    names = (name for name, _ in result.problem.invariants)
    errors = {name: float(error) for name, error in zip(names, row.invariant_errors, strict=True)}
    return {"digits": row.digits, "invariant_errors": errors}


def _note(result: Result) -> str:
    return result.sees if isinstance(result, Observation) else LINEAR_ONLY


def describe(problem: Oscillator | Hamiltonian) -> str:
    """A problem and its split in one line."""
    if isinstance(problem, Hamiltonian):
        return _described(problem)
    shares = ", ".join(f"H{{{l}}}: {_energy(k, v)}" for l, (k, v) in enumerate(problem.shares, start=1))
    return f"q̈ = −ω²q, ω = {problem.omega}; {shares}"


def _energy(k: object, v: object) -> str:
    terms = [
        f"{'' if share == 1 else f'{share}·'}{energy}" for share, energy in ((k, "½p²"), (v, "½ω²q²")) if share != 0
    ]
    return " + ".join(terms) or "0"


def _described(problem: Hamiltonian) -> str:
    texts = [str(term).replace("**", "^") for term in problem.terms]
    if sum(map(len, texts)) > _LONGEST:
        terms = f"{len(texts)} terms" if len(texts) > 1 else "one term"
        return f"{problem.name}, H in {terms} of {', '.join(problem.variables)} and their momenta"
    return f"{problem.name}; " + ", ".join(f"H{{{l}}}: {text}" for l, text in enumerate(texts, start=1))


def _table(result: Result) -> list[list[str]]:
    rows = [["h", "error", "slope", "energy error"]]
    rows += [[str(row.h), _short(row.error), _slope(row), _short(row.energy_error)] for row in result.rows]
    if isinstance(result, Observation):
        names = [name for name, _ in result.problem.invariants]
        rows[0] += [*(f"{name} error" for name in names), "digits"]
        for cells, row in zip(rows[1:], result.rows, strict=True):
            digits = "float" if row.digits <= FLOAT_DIGITS else str(row.digits)
            cells += [*map(_short, row.invariant_errors), digits]
    return rows


def _exactly(result: Result) -> str:
    cancels = isinstance(result, Observation) and result.problem.has_equal_parts
    return f"{result.visible_order} {'or more' if cancels else 'exactly'}"


def _text(result: Result, name: str, paint: Paint) -> list[str]:
    about = f"{describe(result.problem)}; to t = {result.t_end}"
    lines = [paint("strong", name), *(f"  {line}" for line in _wrapped(about)), ""]
    lines += [f"  {line}" for line in aligned(_table(result), gap="   ")]
    observed = "none" if result.observed_order is None else f"{result.observed_order:.2f}"
    verdict = paint.verdict(result.agrees, "they agree", "THEY DISAGREE")
    lines += [
        "",
        f"  order   observed {observed}, on this problem {_exactly(result)}, "
        f"of the method {result.predicted_order}: {verdict}",
        *(f"  {line}" for line in _wrapped(_note(result))),
    ]
    if isinstance(result, Observation) and result.plateau:
        lines.append(f"  the last {result.plateau} rows show the rounding of the coefficients and are not fitted")
    positive = [row for row in result.rows if not row.error.contains(0)]
    if len(positive) > 1:
        hs, errors = [row.h for row in positive], [row.error for row in positive]
        lines += ["", *(f"  {line}" for line in terminal_plot(hs, errors).splitlines())]
    return lines


def _wrapped(text: str, width: int = 76) -> list[str]:
    from textwrap import wrap

    return wrap(text, width)
