"""What the file claims, and whether it holds."""

from __future__ import annotations

from garkcli.check.findings import claim_hint, claim_witness
from garkcli.check.outcome import Claim, Outcome
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section


def _content(method: Reported) -> Content | None:
    outcome = method.outcome
    return None if not outcome.is_read else {"claims": [_shown(outcome, x) for x in outcome.claims]}


def _shown(outcome: Outcome, claim: Claim) -> Content:
    """A claim; of one that fails, what speaks against it and what would mend it."""
    why = hint = ""
    if not claim.holds:
        why = str(claim_witness(outcome, claim.claim))
        hint = str(claim_hint(outcome, claim.claim))
    return {"claim": claim, "why": why, "hint": hint}


SECTION = Section("claims", "Claims", _content)
