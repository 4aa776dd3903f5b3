"""Findings in the formats of CI: Markdown, GitHub, JUnit, SARIF; regressions."""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from hashlib import sha256
from typing import Any

from garkcli.check.baseline import Regression
from garkcli.check.findings import KINDS, Finding, claim_hint, claim_witness, findings
from garkcli.check.outcome import Outcome
from garkcli.errors import counted, printable
from garkcli.page.json_text import to_json
from garkcli.page.paint import Paint
from garkcli.page.plain import inert
from garkcli.report import check_text
from garkcli.report.check_text import no_claims
from garkcli.version import __version__


def markdown_findings(outcomes: Sequence[Outcome]) -> str:
    """Findings as a list, with places and cures."""
    lines = []
    for finding in (x for outcome in outcomes for x in findings(outcome)):
        place = f"`{_code(finding.file)}:{finding.line}:{finding.column}`"
        lines.append(f"- {place}: {table_cell(finding.message)}")
        if finding.help:
            lines.append(f"  - {table_cell(finding.help)}")
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    if silent:
        lines += [*([""] if lines else []), f"{no_claims(silent)}."]
    return "".join(f"{line}\n" for line in lines)


def table_cell(text: str) -> str:
    """A text that does not end its cell of a table."""
    text = printable(text.replace("\n", " "))
    return text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")


def _code(text: str) -> str:
    text = printable(text.replace("\n", " "))
    return text.replace("`", "'").replace("|", "\\|")


def github(outcomes: Sequence[Outcome]) -> str:
    """A workflow command for each finding, and what every file has for the log."""
    found = "".join(f"{annotation(x)}\n" for outcome in outcomes for x in findings(outcome))
    text = check_text.render(outcomes, Paint(False), 0 if len(outcomes) > 1 else -1)
    if text:
        found += commands_off(text)
    return found


def commands_off(text: str) -> str:
    """The text with workflow commands switched off: names of files come from strangers."""
    token = sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
    return f"::stop-commands::{token}\n{text}::{token}::\n"


def annotation(finding: Finding) -> str:
    place = f"file={_property_of_command(finding.file)},line={finding.line},col={finding.column}"
    title = _property_of_command(f"gark: {finding.rule}")
    text = finding.message
    if finding.help:
        text += f"; {finding.help}"
    return f"::{_COMMANDS[finding.level]} {place},title={title}::{_text_of_command(text)}"


_COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}


def _text_of_command(text: str) -> str:
    """The text of a command: what ends a line is written by its number, other signs by name."""
    return printable(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _property_of_command(text: str) -> str:
    """A property of a command: colons and commas end it."""
    return _text_of_command(text).replace(":", "%3A").replace(",", "%2C")


_NOT_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def junit(outcomes: Sequence[Outcome]) -> str:
    """One suite a file, one case a claim, skipped if it is undecided; a file that cannot be read is
    one case in error.
    """
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
    """``text`` without characters that XML has no way to write; signs that turn text by name."""
    return "\n".join(map(printable, _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text).split("\n")))


def sarif(outcomes: Sequence[Outcome]) -> str:
    found = [x for outcome in outcomes for x in findings(outcome)]
    return log_of(found, {key: kind.text for key, kind in KINDS.items()})


def log_of(found: Sequence[Finding], kinds: Mapping[str, str]) -> str:
    """A SARIF log of findings, with every rule in words."""
    rules = [
        {
            "id": key,
            "shortDescription": {"text": text},
            "help": {"text": f"gark explain {key} says what it means."},
        }
        for key, text in kinds.items()
    ]
    places = list(kinds)
    log = {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [
            {
                "tool": {"driver": {"name": "gark", "version": __version__, "rules": rules}},
                "columnKind": "unicodeCodePoints",
                "results": [_result(x, places.index(x.rule)) for x in found],
            }
        ],
    }
    return to_json(log) + "\n"


def _result(finding: Finding, place: int) -> dict[str, Any]:
    text = f"{finding.message}; {finding.help}" if finding.help else finding.message
    region = {"startLine": finding.line, "startColumn": finding.column}
    code = {"properties": {"code": finding.code}} if finding.code else {}
    return {
        "ruleId": finding.rule,
        "ruleIndex": place,
        "level": finding.level,
        "message": {"text": printable(text)},
        "locations": [
            {
                "physicalLocation": {
                    "artifactLocation": {"uri": _uri(finding.file)},
                    "region": region,
                }
            }
        ],
        "partialFingerprints": {"gark/v1": finding.fingerprint},
        **code,
    }


def _uri(path: str, separator: str = os.sep) -> str:
    r"""A path as SARIF wants it, with slashes on every system.

    >>> _uri(r"tables\my rk.gark.yaml", "\\")
    'tables/my%20rk.gark.yaml'
    """
    from urllib.parse import quote

    return quote(path.replace(separator, "/"), safe="/", errors="replace")


def baseline_text(found: Sequence[Regression], files: int) -> str:
    """A line for each regression, then how many of how many files."""
    lines = [printable(f"{x.file}: {x.what} got worse: {x.before} -> {x.now}") for x in found]
    lines.append(f"{counted(files, 'file')}: {len(found) or 'nothing'} got worse")
    return inert("\n".join(lines)) + "\n"
