"""``gark check --format junit``: one suite a file, one case a claim."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from garkcli.check.explained import claim_hint, claim_witness
from garkcli.check.outcome import Outcome
from garkcli.page.plain import printable

_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def render(outcomes: Sequence[Outcome]) -> str:
    """The report as XML text; a file that cannot be read is one case in error."""
    root = ET.Element("testsuites", name="gark check")
    for outcome in outcomes:
        root.append(_suite(outcome))
    for count in ("tests", "failures", "errors"):
        total = sum(int(suite.get(count, "0")) for suite in root)
        root.set(count, str(total))
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _suite(outcome: Outcome) -> ET.Element:
    name = _clean(outcome.file)
    suite = ET.Element("testsuite", name=name)
    readable = ET.SubElement(suite, "testcase", classname=name, name="is a method")
    if outcome.faults:
        text = "\n".join(
            f"{x.line}:{x.column}: {x.message}; {x.help}".rstrip("; ")
            for x in outcome.faults
        )
        error = ET.SubElement(
            readable, "error", message=_clean(outcome.faults[0].message)
        )
        error.text = _clean(text)
    for claim in outcome.claims:
        title = _clean(f"{claim.claim}: {claim.expected}")
        case = ET.SubElement(
            suite, "testcase", classname=name, name=title, line=str(claim.line)
        )
        if not claim.holds:
            message = f"expected {claim.expected}, found {claim.found}"
            failure = ET.SubElement(
                case, "failure", message=_clean(message), type="claim"
            )
            witness = claim_witness(outcome, claim.claim)
            hint = claim_hint(outcome, claim.claim)
            details = "\n".join(text for text in (witness, hint) if text)
            failure.text = _clean(details) or None
    missing = outcome.needs_claims and outcome.makes_no_claim
    if missing:
        case = ET.SubElement(suite, "testcase", classname=name, name="makes a claim")
        ET.SubElement(
            case, "failure", message="the file makes no claim", type="no-claim"
        )
    suite.set("tests", str(1 + len(outcome.claims) + missing))
    suite.set("failures", str(len(outcome.failed_claims) + missing))
    suite.set("errors", str(int(bool(outcome.faults))))
    return suite


def _clean(text: str) -> str:
    """``text`` without characters that XML has no way to write; signs that turn text by name."""
    lines = _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text).split("\n")
    return "\n".join(printable(line) for line in lines)
