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
    lines = [_annotation(x) for outcome in outcomes for x in findings(outcome)]
    text = check_text.render(outcomes, Paint(False), 0 if len(outcomes) > 1 else -1)
    return "".join(f"{line}\n" for line in lines) + (_inert(text) if text else "")


def _inert(text: str) -> str:
    """The text with workflow commands switched off: names of files come from strangers."""
    token = sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
    return f"::stop-commands::{token}\n{text}::{token}::\n"


def _annotation(finding: Finding) -> str:
    place = f"file={_property(finding.file)},line={finding.line},col={finding.column}"
    text = f"{finding.message}; {finding.help}" if finding.help else finding.message
    return f"::error {place},title={_property('gark: ' + finding.rule)}::{_data(text)}"


def _data(text: str) -> str:
    """The text of a command: what ends a line is written by its number, other signs by name."""
    escaped = text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    return printable(escaped)


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
