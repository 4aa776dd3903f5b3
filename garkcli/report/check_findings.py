"""The findings of ``gark check --format markdown``."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.findings import findings
from garkcli.check.outcome import Outcome
from garkcli.page.plain import printable
from garkcli.report.check_text import no_claims


def markdown_findings(outcomes: Sequence[Outcome]) -> str:
    """What fails, with places and cures."""
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
    """A text that stays in its cell of a table."""
    text = printable(text.replace("\n", " "))
    return text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")


def _code(text: str) -> str:
    text = printable(text.replace("\n", " "))
    return text.replace("`", "'").replace("|", "\\|")
