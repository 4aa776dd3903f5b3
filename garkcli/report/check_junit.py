"""``gark check --format junit``: one suite a file, one case a claim."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from garkcli.check.outcome import Outcome
from garkcli.report.plain import printable

_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def render(outcomes: Sequence[Outcome]) -> str:
    """The report as XML text; a file that cannot be read is one case in error."""
    root = ET.Element("testsuites", name="gark check")
    for outcome in outcomes:
        root.append(_suite(outcome))
    for count in ("tests", "failures", "errors"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in root)))
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _suite(outcome: Outcome) -> ET.Element:
    name = _clean(outcome.file)
    suite = ET.Element("testsuite", name=name)
    readable = ET.SubElement(suite, "testcase", classname=name, name="is a method")
    if outcome.faults:
        text = "\n".join(
            f"{x.line}:{x.column}: {x.message}; {x.help}".rstrip("; ") for x in outcome.faults
        )
        error = ET.SubElement(readable, "error", message=_clean(outcome.faults[0].message))
        error.text = _clean(text)
    for claim in outcome.claims:
        title = _clean(f"{claim.claim}: {claim.expected}")
        case = ET.SubElement(suite, "testcase", classname=name, name=title, line=str(claim.line))
        if not claim.holds:
            message = f"expected {claim.expected}, found {claim.found}"
            ET.SubElement(case, "failure", message=_clean(message), type="claim")
    suite.set("tests", str(1 + len(outcome.claims)))
    suite.set("failures", str(len(outcome.failed_claims)))
    suite.set("errors", str(int(bool(outcome.faults))))
    return suite


def _clean(text: str) -> str:
    """``text`` without the characters that XML has no way to write; signs that turn text by name."""
    lines = _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text).split("\n")
    return "\n".join(printable(line) for line in lines)
