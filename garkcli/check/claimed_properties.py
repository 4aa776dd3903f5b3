"""Claims on properties held against what was found; loaded for files that make such claims."""

from __future__ import annotations

from garkcli.check.agreement import agrees, claim_of, claimed_text
from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast, Measure
from garkcli.properties.property import Size, Verdict
from garkcli.properties.subject import Subject


def verify_property(claim: ClaimText, subject: Subject) -> Claim:
    """Hold a claim on a property against the truth."""
    verdict = subject.verdict(claim.key)
    return claim_of(claim, _found(verdict), _holds(claim, verdict, subject), verdict.reason)


def _found(verdict: Verdict) -> str:
    if verdict.value is None:
        return "not decided" if verdict.is_undecided else "no meaning"
    if verdict.is_at_least:
        return f">= {verdict.value}"
    return claimed_text(verdict.value)


def _holds(claim: ClaimText, verdict: Verdict, subject: Subject) -> bool:
    value, wanted = verdict.value, claim.value
    if isinstance(value, Size):
        return isinstance(wanted, Measure) and wanted.agrees(value.root, subject.tolerance)
    if verdict.is_at_least and isinstance(value, int):
        return agrees(wanted, AtLeast(value))
    return agrees(wanted, value)
