"""What the file claims, and whether it holds."""

from __future__ import annotations

import re

from markupsafe import Markup

from garkcli.check.findings import claim_hint, claim_witness
from garkcli.check.outcome import Claim, Outcome
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.reported import Content, Reported

_FORMULA = re.compile(r"sqrt|/")


def content(method: Reported) -> Content | None:
    """What the template is given; None where the section has nothing to say."""
    outcome = method.outcome
    return None if not outcome.is_read else {"claims": [_shown(outcome, x) for x in outcome.claims]}


def _shown(outcome: Outcome, claim: Claim) -> Content:
    """A claim; of one that fails, what speaks against it and what would mend it."""
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
    """A value as it is claimed; what has a root or a fraction is a formula."""
    return d.expression(text) if _FORMULA.search(text) else d.prose(text)
