"""``gark check --format json``: exact numbers as strings, colours and stages from 1; see
docs/json.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from garkcli.check.analysis import Analysis, AnyOrder
from garkcli.check.outcome import Outcome
from garkcli.exact.display import decimal, to_text
from garkcli.order.certificate import Order
from garkcli.order.simplifying import Simplifying
from garkcli.report.hints import hints_data
from garkcli.report.json_text import to_json
from garkcli.tableau.tableau import Tableau
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.order.suggestion import Suggestion

SCHEMA = "gark/check/1"


def render(outcomes: Sequence[Outcome]) -> str:
    """The report as JSON text."""
    return to_json(as_data(outcomes)) + "\n"


def as_data(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """The report as plain data."""
    failed = sum(not outcome.ok for outcome in outcomes)
    return {
        "schema": SCHEMA,
        "files": [_outcome(outcome) for outcome in outcomes],
        "summary": {
            "files": len(outcomes),
            "failed": failed,
            "without_claims": sum(outcome.makes_no_claim for outcome in outcomes),
        },
    }


def colours_data(tableau: Tableau) -> list[dict[str, Any]]:
    """The colours with their stages."""
    return [
        {"name": x.name, "stages": tableau.spaces[x.space].stages}
        for x in tableau.colours
    ]


def _outcome(outcome: Outcome) -> dict[str, Any]:
    head: dict[str, Any] = {
        "file": outcome.file,
        "name": outcome.name,
        "ok": outcome.ok,
    }
    if outcome.analysis is None:
        errors = [
            {
                "line": x.line or None,
                "column": x.column or None,
                "message": x.message,
                "help": x.help,
            }
            for x in outcome.faults
        ]
        return {**head, "errors": errors}
    claims = [
        {
            "claim": x.claim,
            "expected": x.expected,
            "found": x.found,
            "holds": x.holds,
            "line": x.line,
        }
        for x in outcome.claims
    ]
    return {
        **head,
        "structure": outcome.structure,
        **_analysis(outcome, outcome.analysis),
        "claims": claims,
    }


def _analysis(outcome: Outcome, analysis: Analysis) -> dict[str, Any]:
    return {
        "exact": analysis.tolerance is None,
        "tolerance": None
        if analysis.tolerance is None
        else decimal(analysis.tolerance),
        "colours": colours_data(analysis.tableau),
        "consistent": not analysis.inconsistent,
        "inconsistent_blocks": [[l + 1, m + 1] for l, m in analysis.inconsistent],
        "conjugate_consistent": None
        if analysis.conjugate is None
        else not analysis.conjugate_inconsistent,
        "symplectic": analysis.symplectic,
        **_order("", analysis.order),
        **_order("conjugate_", analysis.conjugate_order),
        **_order("pair_", analysis.pair_order),
        **_order("nonautonomous_", analysis.nonautonomous_order),
        "simplifying": _simplifying(analysis.simplifying, analysis.bound),
        "pair_bound": analysis.pair_bound,
        **hints_data(outcome),
        **_suggested(analysis.suggestion),
    }


def _order(prefix: str, order: AnyOrder | None) -> dict[str, Any]:
    if order is None:
        return {f"{prefix}order": None, f"{prefix}witness": None}
    found: dict[str, Any] = {f"{prefix}order": order.order, f"{prefix}witness": None}
    if order.is_lower_bound:
        found[f"{prefix}order_is_lower_bound"] = True
    if not isinstance(order, Order):
        found[f"{prefix}order_largest_residual"] = float(order.largest_residual.upper())
        found[f"{prefix}order_tolerance"] = decimal(order.tolerance)
        if order.undecided:
            found[f"{prefix}order_undecided"] = True
    if order.witness is not None:
        found[f"{prefix}witness"] = {
            "order": order.witness.tree.order,
            "tree": format_tree(order.witness.tree),
            "value": to_text(order.witness.value),
            "required": to_text(order.witness.required),
            "residual": to_text(order.witness.residual),
        }
    return found


def _suggested(found: Suggestion | None) -> dict[str, Any]:
    if found is None:
        return {}
    sizes = {
        "rounding": float(found.rounding.upper()),
        "genuine": float(found.genuine.upper()),
    }
    return {"suggestion": {"line": found.line, "order": found.order, **sizes}}


def _simplifying(found: Simplifying, bound: int) -> dict[str, Any]:
    return {
        "B": list(found.B),
        "C": [list(row) for row in found.C],
        "D": [list(row) for row in found.D],
        "r": found.r,
        "eta": found.eta,
        "zeta": found.zeta,
        "xi": found.xi,
        "bound": bound,
    }
