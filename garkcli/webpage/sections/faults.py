"""The faults of a file, with cures."""

from __future__ import annotations

from garkcli.errors import Remark
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    outcome = method.outcome
    if outcome.is_read:
        return None
    lines = outcome.text.splitlines()
    return {"faults": [_shown(fault, lines) for fault in outcome.faults]}


def _shown(fault: Remark, lines: list[str]) -> Content:
    line = lines[fault.line - 1] if 0 < fault.line <= len(lines) else ""
    return {
        "line": fault.line,
        "column": fault.column,
        "text": line,
        "code": fault.code,
        "message": fault.message,
        "help": fault.help,
    }
