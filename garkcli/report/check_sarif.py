"""``gark check --format sarif``: SARIF 2.1.0, for code scanning."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from garkcli.check.findings import KINDS, Finding, findings
from garkcli.check.outcome import Outcome
from garkcli.page.json_text import to_json
from garkcli.page.plain import printable
from garkcli.version import __version__


def render(outcomes: Sequence[Outcome]) -> str:
    """One run with a result for each finding."""
    found = [x for outcome in outcomes for x in findings(outcome)]
    kinds = {key: kind.text for key, kind in KINDS.items()}
    return log_of(found, kinds)


def log_of(found: Sequence[Finding], kinds: Mapping[str, str]) -> str:
    """A log with one run.

    Args:
        found: its results.
        kinds: every rule, in words.
    """
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
