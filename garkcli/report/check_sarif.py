"""``gark check --format sarif``: SARIF 2.1.0, for code scanning."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from garkcli import __version__
from garkcli.check.findings import KINDS, Finding, findings
from garkcli.check.outcome import Outcome
from garkcli.page.json_text import to_json
from garkcli.page.plain import printable


def render(outcomes: Sequence[Outcome]) -> str:
    """One run with a result for each finding."""
    rules = [
        {"id": x, "shortDescription": {"text": kind.text}}
        for x, kind in KINDS.items()
    ]
    log = {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [
            {
                "tool": {
                    "driver": {
                        "name": "gark",
                        "version": __version__,
                        "rules": rules,
                    }
                },
                "columnKind": "unicodeCodePoints",
                "results": [
                    _result(x)
                    for outcome in outcomes
                    for x in findings(outcome)
                ],
            }
        ],
    }
    return to_json(log) + "\n"


def _result(finding: Finding) -> dict[str, Any]:
    text = (
        f"{finding.message}; {finding.help}"
        if finding.help
        else finding.message
    )
    region = {"startLine": finding.line, "startColumn": finding.column}
    return {
        "ruleId": finding.rule,
        "ruleIndex": list(KINDS).index(finding.rule),
        "level": "error",
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
    }


def _uri(path: str) -> str:
    from urllib.parse import quote

    return quote(path, safe="/", errors="replace")
