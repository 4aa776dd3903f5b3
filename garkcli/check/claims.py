"""The claims of a file held against what was found."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.agreement import agrees, claim_of, claimed_text
from garkcli.check.analysis import Analysis, AnyOrder
from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast
from garkcli.order.simplifying import Simplifying
from garkcli.properties.keys import KEYS


def verify(
    claims: tuple[ClaimText, ...], analysis: Analysis
) -> tuple[Claim, ...]:
    """Hold each claim against the truth."""
    return tuple(_held_against(claim, analysis) for claim in claims)


def _held_against(claim: ClaimText, analysis: Analysis) -> Claim:
    if claim.key in KEYS:
        from garkcli.check.claimed_properties import verify_property

        return verify_property(claim, analysis.subject)
    found = found_value(claim.key, analysis)
    shown = "none: a weight is zero" if found is None else claimed_text(found)
    return claim_of(claim, shown, agrees(claim.value, found))


def found_value(key: str, analysis: Analysis) -> object:
    """What is true of an order, a table, or symplecticity; None where it has no meaning."""
    table: Simplifying = analysis.simplifying
    limit = analysis.limit
    return {
        "order": _order(analysis.order),
        "conjugate-order": _order(analysis.conjugate_order),
        "pair-order": _order(analysis.pair_order),
        "bound": analysis.bound,
        "pair-bound": analysis.pair_bound,
        "sharp-bound": analysis.sharp_bound,
        "pair-sharp-bound": analysis.pair_sharp_bound,
        "B": _capped_row(table.B, limit),
        "C": [_capped_row(row, limit) for row in table.C],
        "D": [_capped_row(row, limit) for row in table.D],
        "symplectic": analysis.symplectic,
    }[key]


def _order(found: AnyOrder | None) -> object:
    """An order at which nothing is known to fail is at least that large, no more."""
    if found is None:
        return None
    return AtLeast(found.order) if found.is_lower_bound else found.order


def _capped_row(numbers: Sequence[int | None], limit: int) -> list[object]:
    return [_capped(number, limit) for number in numbers]


def _capped(number: int | None, limit: int) -> object:
    """A number at which the search stopped is known to be at least that large, no more."""
    if number is None or number < limit:
        return number
    return AtLeast(number)
