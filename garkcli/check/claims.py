"""The claims of a file held against what was found."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.analysis import Analysis, AnyOrder
from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast
from garkcli.order.simplifying import Simplifying


def verify(claims: tuple[ClaimText, ...], analysis: Analysis) -> tuple[Claim, ...]:
    """Hold each claim against the truth."""
    return tuple(_verified(claim, _found(claim.key, analysis)) for claim in claims)


def _found(key: str, analysis: Analysis) -> object:
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


def _verified(claim: ClaimText, found: object) -> Claim:
    mark = claim.node.start_mark
    shown = "none: a weight is zero" if found is None else _text(found)
    return Claim(
        claim=claim.key,
        expected=_text(claim.value),
        found=shown,
        holds=_agrees(claim.value, found),
        line=mark.line + 1,
        column=mark.column + 1,
    )


def _agrees(wanted: object, found: object) -> bool:
    """Whether a value of a file, a number or a list of numbers or lists, is what was found."""
    if isinstance(wanted, list):
        if not isinstance(found, list) or len(found) != len(wanted):
            return False
        return all(_agrees(x, y) for x, y in zip(wanted, found, strict=True))
    if isinstance(wanted, AtLeast):
        known = found.least if isinstance(found, AtLeast) else found
        return isinstance(known, int) and known >= wanted.least
    return type(wanted) is type(found) and wanted == found


def _text(value: object) -> str:
    """A value as it is written in YAML."""
    if isinstance(value, list):
        inside = ", ".join(_text(x) for x in value)
        return f"[{inside}]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    return str(value)
