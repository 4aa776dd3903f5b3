"""Files of RungeKutta.jl: a line ``# order stages Type``, then c and A, then b below."""

from __future__ import annotations

import re
from pathlib import PurePath

from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader

NAME = "tsv"
_HEAD = re.compile(r"#[ \t]*([0-9]{1,3})[ \t]+([0-9]{1,3})[ \t]+([A-Za-z]\S*)")
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_FRACTION = re.compile(r"([-+]?[0-9]+)//([0-9]+)")


def find(text: str, source: str) -> list[FoundTable]:
    """The table of a file; the third word of its head is a type, which is never evaluated."""
    allowance = Allowance()
    found = []
    lines = text.splitlines()
    for number, line in enumerate(lines):
        head = _HEAD.fullmatch(line.strip())
        if head is None:
            continue
        order, stages = int(head[1]), int(head[2])
        if not 0 < stages <= MAX_STAGES:
            continue
        rows = _rows(lines[number + 1 : number + 2 + stages], stages)
        if rows is None:
            continue
        table = FoundTable(
            source,
            number + 1,
            NAME,
            _name(source),
            ((tuple(row[1:] for row in rows[:-1]),),),
            (rows[-1][1:],),
            (tuple(row[0] for row in rows[:-1]),),
            order=order or None,
        )
        found.append(allowance.table(table))
    return found


def _name(source: str) -> str:
    """The name of the file; standard input, ``<stdin>``, has none."""
    return "" if source.startswith("<") else PurePath(source).stem


def _rows(lines: list[str], stages: int) -> list[tuple[str, ...]] | None:
    """The numbers of s + 1 lines; None where they are none."""
    rows = []
    for line in lines:
        words = [_number(word) for word in line.split()]
        if len(words) != stages + 1 or not all(words):
            return None
        rows.append(tuple(words))
    return rows if len(rows) == stages + 1 else None


def _number(word: str) -> str:
    """A number as text; empty where it is none."""
    fraction = _FRACTION.fullmatch(word)
    if fraction:
        return f"{fraction[1]}/{fraction[2]}"
    return word if _NUMBER.fullmatch(word) else ""


READER = Reader(NAME, "tables of RungeKutta.jl: # order stages Type", (".tsv", ".txt"), find)
