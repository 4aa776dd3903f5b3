"""Whether what a file claims is what was found, and both as text."""

from __future__ import annotations

from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast
from garkcli.reason import NO_REASON, Reason


def claim_of(claim: ClaimText, found: str, holds: bool, reason: Reason = NO_REASON) -> Claim:
    """A claim with what was found."""
    mark = claim.node.start_mark
    return Claim(
        claim=claim.key,
        expected=claimed_text(claim.value),
        found=found,
        holds=holds,
        line=mark.line + 1,
        column=mark.column + 1,
        reason=NO_REASON if holds else reason,
    )


def agrees(wanted: object, found: object) -> bool:
    """Whether a value of a file, a number or a list of numbers or lists, is what was found."""
    if isinstance(wanted, list):
        if not isinstance(found, list) or len(found) != len(wanted):
            return False
        return all(agrees(x, y) for x, y in zip(wanted, found, strict=True))
    if isinstance(wanted, AtLeast):
        known = found.least if isinstance(found, AtLeast) else found
        return isinstance(known, int) and known >= wanted.least
    return type(wanted) is type(found) and wanted == found


def capped(value: object, limit: int) -> object:
    """A number at which the search stopped is known to be at least that large, no more."""
    if isinstance(value, (list, tuple)):
        return [capped(x, limit) for x in value]
    is_number = isinstance(value, int) and not isinstance(value, bool)
    return AtLeast(limit) if is_number and value == limit else value


def claimed_text(value: object) -> str:
    """A value as it is written in YAML."""
    if isinstance(value, list):
        inside = ", ".join(claimed_text(x) for x in value)
        return f"[{inside}]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    return str(value)
