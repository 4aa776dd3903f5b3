"""Findings about method files for CI: Markdown, GitHub, JUnit, SARIF; regressions."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from garkcli.check.baseline import Regression
from garkcli.check.findings import asides, claim_hint, claim_witness, findings
from garkcli.check.outcome import Outcome
from garkcli.errors import counted, printable
from garkcli.page.look import PLAIN
from garkcli.page.safety import inert
from garkcli.report import check_text
from garkcli.report.check_text import no_claims
from garkcli.report.remarks import annotation, commands_off, items, log_of, remark_rows
from garkcli.tell.dialect import Plain

ABOUT_CLAIMS = ("claim", "undecided", "no-claim")


def markdown_findings(outcomes: Sequence[Outcome]) -> str:
    found = [x for outcome in outcomes for x in findings(outcome)]
    if len(outcomes) == 1:
        found = [x for x in found if x.rule in ABOUT_CLAIMS]
    lines = [line for x in found for line in items(x)]
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    if silent:
        lines += [*([""] if lines else []), f"{no_claims(silent)}."]
    return "".join(f"{line}\n" for line in lines)


def github(outcomes: Sequence[Outcome]) -> str:
    """A workflow command for each finding, and the text for the log."""
    found = "".join(f"{annotation(x)}\n" for outcome in outcomes for x in findings(outcome))
    text = check_text.render(outcomes, PLAIN, 0 if len(outcomes) > 1 else -1)
    if text:
        found += commands_off(text)
    return found


_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def junit(outcomes: Sequence[Outcome]) -> str:
    """Returns JUnit XML: a suite for each file, a case for each claim, skipped if undecided."""
    root = ET.Element("testsuites", name="gark check")
    for outcome in outcomes:
        _add_suite(root, outcome)
    for count in ("tests", "failures", "errors", "skipped"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in root)))
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _add_suite(root: ET.Element, outcome: Outcome) -> None:
    name = _clean(outcome.file)
    suite = ET.SubElement(root, "testsuite", name=name)

    def case(title: str) -> ET.Element:
        return ET.SubElement(suite, "testcase", classname=name, name=_clean(title))

    readable = case("is a method")
    if outcome.faults:
        message = _clean(outcome.faults[0].message)
        lines = [f"{x.line}:{x.column}: {x.message}; {x.help}".rstrip("; ") for x in outcome.faults]
        ET.SubElement(readable, "error", message=message).text = _clean("\n".join(lines))
    if found := asides(outcome):
        text = "\n".join(f"{label}: {text}" for label, text in remark_rows(found, Plain()))
        ET.SubElement(readable, "system-out").text = _clean(text)
    for claim in outcome.claims:
        judged = case(f"{claim.claim}: {claim.expected}")
        judged.set("line", str(claim.line))
        if not claim.holds:
            message = _clean(f"expected {claim.expected}, found {claim.found}")
            tag, rule = ("failure", "claim") if claim.holds is False else ("skipped", "undecided")
            unmet = ET.SubElement(judged, tag, message=message, type=rule)
            why = claim_witness(outcome, claim.claim), claim_hint(outcome, claim.claim)
            unmet.text = _clean("\n".join(str(x) for x in why if x)) or None
    for message in outcome.lacks:
        missing = case("makes the claims that are required")
        ET.SubElement(missing, "failure", message=message, type="no-claim")
    suite.set("tests", str(len(suite)))
    suite.set("failures", str(len(outcome.failed_claims) + len(outcome.lacks)))
    suite.set("errors", "1" if outcome.faults else "0")
    suite.set("skipped", str(len(outcome.undecided_claims)))


def _clean(text: str) -> str:
    """Returns a text without characters that XML cannot write; signs that turn text are named."""
    return "\n".join(map(printable, _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text).split("\n")))


def sarif(outcomes: Sequence[Outcome]) -> str:
    found = [x for outcome in outcomes for x in findings(outcome)]
    return log_of(found, "check")


def baseline_text(found: Sequence[Regression], files: int) -> str:
    lines = [printable(f"{x.file}: {x.what} got worse: {x.before} -> {x.now}") for x in found]
    lines.append(f"{counted(files, 'file')}: {len(found) or 'nothing'} got worse")
    return inert("\n".join(lines)) + "\n"
