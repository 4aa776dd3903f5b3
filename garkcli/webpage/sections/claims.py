"""The claims of the file, and whether they hold."""

from __future__ import annotations

import re

from markupsafe import Markup

from garkcli.check.claims import Claim
from garkcli.check.findings import claim_hint, claim_witness
from garkcli.check.outcome import Outcome
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.reported import Content, Reported

_FORMULA = re.compile(r"sqrt|/")


def content(method: Reported) -> Content | None:
    outcome = method.outcome
    return None if not outcome.is_read else {"claims": [_shown(outcome, x) for x in outcome.claims]}


def _shown(outcome: Outcome, claim: Claim) -> Content:
    """Returns a claim; a failing one with the reason and a repair."""
    told = (
        []
        if claim.holds
        else [claim_witness(outcome, claim.claim), claim_hint(outcome, claim.claim)]
    )
    d = Typeset()
    return {
        "claim": claim,
        "verdict": {True: "holds", None: "undecided", False: "fails"}[claim.holds],
        "sign": {True: "holds", None: "open", False: "fails"}[claim.holds],
        "why": Markup("; ".join(d.reason(x) for x in told if x)),
        "expected": Markup(_value(claim.expected, d)),
        "found": Markup(_value(claim.found, d)),
    }


def _value(text: str, d: Typeset) -> str:
    """Returns a claimed value; one with a root or a fraction is a formula."""
    return d.expression(text) if _FORMULA.search(text) else d.prose(text)
