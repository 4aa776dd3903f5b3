"""``gark check --format junit``: one suite a file, one case a claim."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from garkcli.check.explained import claim_hint, claim_witness
from garkcli.check.outcome import Claim, Outcome
from garkcli.errors import Fault
from garkcli.page.plain import printable

_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def render(outcomes: Sequence[Outcome]) -> str:
    """The report as XML text; a file that cannot be read is one case in error."""
    root = ET.Element("testsuites", name="gark check")
    for outcome in outcomes:
        root.append(_suite(outcome))
    for count in ("tests", "failures", "errors"):
        numbers = [suite.get(count, "0") for suite in root]
        total = sum(map(int, numbers))
        root.set(count, str(total))
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _suite(outcome: Outcome) -> ET.Element:
    name = _clean(outcome.file)
    suite = ET.Element("testsuite", name=name)
    readable = _case(suite, "is a method")
    if outcome.faults:
        _add_error(readable, outcome.faults)
    for claim in outcome.claims:
        title = _clean(f"{claim.claim}: {claim.expected}")
        line = str(claim.line)
        case = _case(suite, title)
        case.set("line", line)
        if not claim.holds:
            _add_failure(case, outcome, claim)
    tests = 1 + len(outcome.claims)
    failures = len(outcome.failed_claims)
    for message in outcome.lacks:
        tests += 1
        failures += 1
        case = _case(suite, "makes the claims that are required")
        ET.SubElement(case, "failure", message=message, type="no-claim")
    errors = 1 if outcome.faults else 0
    suite.set("tests", str(tests))
    suite.set("failures", str(failures))
    suite.set("errors", str(errors))
    return suite


def _case(suite: ET.Element, name: str) -> ET.Element:
    """A further case of a suite, whose name is that of the file."""
    file = suite.get("name", "")
    return ET.SubElement(suite, "testcase", classname=file, name=name)


def _add_error(case: ET.Element, faults: Sequence[Fault]) -> None:
    """All faults of a file, the first one as the message."""
    lines = []
    for fault in faults:
        place = f"{fault.line}:{fault.column}"
        line = f"{place}: {fault.message}; {fault.help}"
        lines.append(line.rstrip("; "))
    message = _clean(faults[0].message)
    error = ET.SubElement(case, "error", message=message)
    everything = "\n".join(lines)
    error.text = _clean(everything)


def _add_failure(case: ET.Element, outcome: Outcome, claim: Claim) -> None:
    """What was found in place of a claim, and why."""
    message = _clean(f"expected {claim.expected}, found {claim.found}")
    failure = ET.SubElement(case, "failure", message=message, type="claim")
    witness = claim_witness(outcome, claim.claim)
    hint = claim_hint(outcome, claim.claim)
    text = "\n".join(str(x) for x in (witness, hint) if x)
    failure.text = _clean(text) or None


def _clean(text: str) -> str:
    """``text`` without characters that XML has no way to write; signs that turn text by name."""
    writable = _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text)
    lines = [printable(line) for line in writable.split("\n")]
    return "\n".join(lines)
