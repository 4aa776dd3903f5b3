"""``gark check --format github``: annotations on the lines of a pull request, then the summary."""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import sha256

from garkcli.check.findings import Finding, findings
from garkcli.check.outcome import Outcome
from garkcli.page.paint import Paint
from garkcli.page.plain import printable
from garkcli.report import check_text


def render(outcomes: Sequence[Outcome]) -> str:
    """A workflow command for each finding, and what every file has for the log."""
    found = ""
    for outcome in outcomes:
        for finding in findings(outcome):
            found += f"{annotation(finding)}\n"
    verbosity = 0 if len(outcomes) > 1 else -1
    text = check_text.render(outcomes, Paint(False), verbosity)
    if text:
        found += inert(text)
    return found


def inert(text: str) -> str:
    """The text with workflow commands switched off: names of files come from strangers."""
    encoded = text.encode("utf-8", "surrogatepass")
    token = sha256(encoded).hexdigest()
    return f"::stop-commands::{token}\n{text}::{token}::\n"


def annotation(finding: Finding) -> str:
    """The workflow command of a finding."""
    file = _property(finding.file)
    place = f"file={file},line={finding.line},col={finding.column}"
    title = _property(f"gark: {finding.rule}")
    text = finding.message
    if finding.help:
        text += f"; {finding.help}"
    return f"::{_COMMANDS[finding.level]} {place},title={title}::{_data(text)}"


_COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}


def _data(text: str) -> str:
    """The text of a command: what ends a line is written by its number, other signs by name."""
    escaped = text.replace("%", "%25")
    escaped = escaped.replace("\r", "%0D")
    escaped = escaped.replace("\n", "%0A")
    return printable(escaped)


def _property(text: str) -> str:
    """A property of a command: colons and commas end it."""
    escaped = _data(text).replace(":", "%3A")
    return escaped.replace(",", "%2C")
