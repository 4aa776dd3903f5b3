"""The claims of a file held against what was found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.check.agreement import agrees, capped, claim_of, claimed_text
from garkcli.check.analysis import Analysis
from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast
from garkcli.order.deciding import AnyOrder
from garkcli.order.simplifying import Simplifying
from garkcli.properties.registry import KEYS

if TYPE_CHECKING:
    from garkcli.order.dense import DenseOrder


def verify(claims: tuple[ClaimText, ...], analysis: Analysis) -> tuple[Claim, ...]:
    """Hold each claim against the truth."""
    return tuple(_held_against(claim, analysis) for claim in claims)


def _held_against(claim: ClaimText, analysis: Analysis) -> Claim:
    if claim.key in KEYS:
        from garkcli.check.claimed_properties import verify_property

        return verify_property(claim, analysis.subject)
    found = found_value(claim.key, analysis)
    shown = claimed_text(found)
    if found is None:
        shown = f"none: {_why_none(claim.key, analysis)}"
    return claim_of(claim, shown, agrees(claim.value, found))


def _why_none(key: str, analysis: Analysis) -> str:
    """Why there is nothing of which a claim speaks."""
    if key.startswith("embedded") and analysis.embedded is None:
        return "there are no embedded weights"
    if key.startswith("dense") and analysis.dense is None:
        return "there is no dense output"
    if key == "dense-smooth":
        return "not decided"
    if key.endswith("nonautonomous-order"):
        return "a vector field is linear, or nodes differ"
    return "a weight is zero"


def found_value(key: str, analysis: Analysis) -> object:
    """What is true of an order, a table, or symplecticity; None where it has no meaning."""
    table: Simplifying = analysis.simplifying
    limit = analysis.limit
    if key.startswith(("embedded", "dense")):
        return _of_further(key, analysis)
    return {
        "order": _order(analysis.order),
        "conjugate-order": _order(analysis.conjugate_order),
        "pair-order": _order(analysis.pair_order),
        "bound": capped(analysis.bound, limit),
        "pair-bound": capped(analysis.pair_bound, limit),
        "sharp-bound": capped(analysis.sharp_bound, limit),
        "pair-sharp-bound": capped(analysis.pair_sharp_bound, limit),
        "B": capped(table.B, limit),
        "C": capped(table.C, limit),
        "D": capped(table.D, limit),
        "symplectic": analysis.symplectic,
        "nonautonomous-order": _order(analysis.nonautonomous_order),
    }[key]


def _of_further(key: str, analysis: Analysis) -> object:
    """What is true of embedded weights and of dense output."""
    embedded, dense = analysis.embedded, analysis.dense
    if key.startswith("embedded"):
        if embedded is None:
            return None
        if key == "embedded-order":
            return _order(embedded.order)
        return _order(embedded.nonautonomous_order)
    if dense is None:
        return None
    return {
        "dense-order": _order(dense.order),
        "dense-continuous": dense.ends_at_step,
        "dense-smooth": dense.is_smooth,
    }[key]


def _order(found: AnyOrder | DenseOrder | None) -> object:
    """An order at which nothing is known to fail is at least that large, no more."""
    if found is None:
        return None
    return AtLeast(found.order) if found.is_lower_bound else found.order
