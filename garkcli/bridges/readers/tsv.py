"""Files of RungeKutta.jl: a line ``# order stages Type``, then c and A, then b below."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.bridges.readers.printed import found_in, printed, stem_of
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader

NAME = "tsv"
_HEAD = re.compile(r"#[ \t]*([0-9]{1,3})[ \t]+([0-9]{1,3})[ \t]+([A-Za-z]\S*)")
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+|//[0-9]+)?")


def find(text: str, source: str) -> list[FoundTable]:
    """The table of a file; the third word of its head is a type, which is never evaluated."""
    return found_in(source, NAME, _tableaus(text.splitlines(), source))


def _tableaus(lines: list[str], source: str) -> Iterator[ir.Statement]:
    for number, line in enumerate(lines, start=1):
        head = _HEAD.fullmatch(line.strip())
        stages = int(head[2]) if head else 0
        rows = [x.split() for x in lines[number : number + stages + 1]]
        is_whole = len(rows) == stages + 1 and all(len(row) == stages + 1 for row in rows)
        if head is None or not 0 < stages <= MAX_STAGES or not is_whole:
            continue
        if all(_NUMBER.fullmatch(x) for row in rows for x in row):
            *above, below = [[x.replace("//", "/") for x in row] for row in rows]
            A, c = [row[1:] for row in above], [row[0] for row in above]
            title, order = stem_of(source), "" if head[1] == "0" else head[1]
            yield printed(number, A=A, b=below[1:], c=c, order=order, title=title)


READER = Reader(NAME, "tables of RungeKutta.jl: # order stages Type", (".tsv", ".txt"), find)
