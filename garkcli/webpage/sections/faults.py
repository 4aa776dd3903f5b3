"""Why a file is no method, and the cure."""

from __future__ import annotations

from garkcli.errors import Remark
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    """What the template is given; None where the section has nothing to say."""
    outcome = method.outcome
    if outcome.is_read:
        return None
    lines = outcome.text.splitlines()
    return {"faults": [_shown(fault, lines) for fault in outcome.faults]}


def _shown(fault: Remark, lines: list[str]) -> Content:
    """A fault with the line that it is in."""
    line = lines[fault.line - 1] if 0 < fault.line <= len(lines) else ""
    return {
        "line": fault.line,
        "column": fault.column,
        "text": line,
        "code": fault.code,
        "message": fault.message,
        "help": fault.help,
    }
