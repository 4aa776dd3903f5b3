"""What ``ARKodeButcherTable_Write`` prints: ``A =`` and its rows, ``c =``, ``b =``, ``d =``."""

from __future__ import annotations

import re

from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader, Row

NAME = "arkode-text"
_ROW = re.compile(r"[ \t]*([Acbd])[ \t]*=[ \t]*([-+0-9.eE \t,]*)")
MAX_LINE = 20_000


def find(text: str, source: str) -> list[FoundTable]:
    """The printed tables; 16 digits are left of each number."""
    found: list[FoundTable] = []
    parts: dict[str, Row] = {}
    rows: list[Row] = []
    line = 0
    for number, content in enumerate(text.splitlines(), start=1):
        short = content[:MAX_LINE].rstrip()
        begun = _ROW.fullmatch(short)
        if begun is None:
            numbers = _numbers(short)
            if numbers and line and not parts:
                rows.append(numbers)
            continue
        name = begun[1]
        if name == "A":
            _note(found, source, line, rows, parts)
            rows, parts, line = [], {}, number
        elif line:
            parts[name] = tuple(_numbers(begun[2]))
    _note(found, source, line, rows, parts)
    return Allowance().tables(found)


def _numbers(text: str) -> Row:
    words = text.replace(",", " ").split()
    for word in words:
        if not re.fullmatch(_ONE, word):
            return ()
    return tuple(words[: MAX_STAGES + 1])


_ONE = re.compile(r"[-+]?[0-9]{1,400}(?:\.[0-9]*)?(?:[eE][-+]?[0-9]{1,4})?")


def _note(
    found: list[FoundTable], source: str, line: int, rows: list[Row], parts: dict[str, Row]
) -> None:
    """A table that has ended, where it is a whole one."""
    b = parts.get("b", ())
    c = parts.get("c", ())
    stages = len(b)
    if not 0 < stages <= MAX_STAGES or len(c) != stages:
        return
    if len(rows) != stages or any(len(row) != stages for row in rows):
        return
    d = parts.get("d")
    found.append(
        FoundTable(
            source,
            line,
            NAME,
            "",
            ((tuple(rows),),),
            (b,),
            (c,),
            embedded=(d,) if d and len(d) == stages else None,
        )
    )


READER = Reader(NAME, "what ARKodeButcherTable_Write prints", (".txt", ".log", ".out"), find)
