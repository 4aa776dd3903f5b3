"""The claims of a file held against what was found."""

from __future__ import annotations

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
        "B": [_capped(x, limit) for x in table.B],
        "C": [[_capped(x, limit) for x in row] for row in table.C],
        "D": [[_capped(x, limit) for x in row] for row in table.D],
        "symplectic": analysis.symplectic,
    }[key]


def _order(found: AnyOrder | None) -> object:
    """An order at which nothing is known to fail is at least that large, no more."""
    if found is None:
        return None
    return AtLeast(found.order) if found.is_lower_bound else found.order


def _capped(number: int | None, limit: int) -> object:
    """A number at which the search stopped is known to be at least that large, no more."""
    return AtLeast(number) if number is not None and number >= limit else number


def _verified(claim: ClaimText, found: object) -> Claim:
    mark = claim.node.start_mark
    return Claim(
        claim=claim.key,
        expected=_text(claim.value),
        found="none: a weight is zero" if found is None else _text(found),
        holds=_agrees(claim.value, found),
        line=mark.line + 1,
        column=mark.column + 1,
    )


def _agrees(wanted: object, found: object) -> bool:
    if isinstance(wanted, list):
        same = isinstance(found, list) and len(found) == len(wanted)
        return same and all(_agrees(x, y) for x, y in zip(wanted, found, strict=True))  # type: ignore[call-overload]
    if isinstance(wanted, AtLeast):
        known = found.least if isinstance(found, AtLeast) else found
        return isinstance(known, int) and known >= wanted.least
    return type(wanted) is type(found) and wanted == found


def _text(value: object) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_text(x) for x in value)}]"
    if value is None:
        return "null"
    return str(value).lower() if isinstance(value, bool) else str(value)
