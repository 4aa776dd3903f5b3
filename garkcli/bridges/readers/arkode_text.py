"""What ``ARKodeButcherTable_Write`` prints: ``A =`` and its rows, ``c =``, ``b =``, ``d =``."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.bridges.readers.printed import found_in, printed
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader

NAME = "arkode-text"
_PART = re.compile(r"[ \t]*([Acbd])[ \t]*=[ \t]*([-+0-9.eE \t,]*)")
_NUMBER = re.compile(r"[-+]?[0-9]{1,400}(?:\.[0-9]*)?(?:[eE][-+]?[0-9]{1,4})?")
MAX_LINE = 20_000


def find(text: str, source: str) -> list[FoundTable]:
    """The printed tables; 16 digits are left of each number."""
    return found_in(source, NAME, _tableaus(text))


def _tableaus(text: str) -> Iterator[ir.Statement]:
    line = 0
    parts: dict[str, list[list[str]]] = {}
    for number, content in enumerate([*text.splitlines(), "A ="], start=1):
        short = content[:MAX_LINE].rstrip()
        begun = _PART.fullmatch(short)
        if begun and begun[1] == "A":
            yield from _tableau(line, parts)
            parts, line = {"A": []}, number
        elif begun and line:
            parts[begun[1]] = [_numbers(begun[2])]
        elif len(parts) == 1 and (row := _numbers(short)):
            parts["A"].append(row)


def _numbers(text: str) -> list[str]:
    words = text.replace(",", " ").split()[: MAX_STAGES + 1]
    return words if all(map(_NUMBER.fullmatch, words)) else []


def _tableau(line: int, parts: dict[str, list[list[str]]]) -> Iterator[ir.Statement]:
    """A table that has ended, where it is a whole one."""
    A, (b,), (c,), (d,) = (parts.get(x, [[]]) for x in "Abcd")
    stages = len(b)
    if 0 < stages <= MAX_STAGES and len(c) == stages and [len(x) for x in A] == [stages] * stages:
        yield printed(line, A=A, b=b, c=c, embedded=d if len(d) == stages else None)


READER = Reader(NAME, "what ARKodeButcherTable_Write prints", (".txt", ".log", ".out"), find)
