"""CSV: gark's export, a row an entry; or a tableau as it is printed, nodes in the first column."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from pathlib import PurePath

from garkcli.bridges.readers.cells import Cells
from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import MAX_COLOURS
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader, Row, TooLarge
from garkcli.sources.scalars import Scalar, Value

NAME = "csv"
COLUMNS = ["part", "l", "m", "i", "j", "value"]
_INDEX = re.compile(r"[1-9][0-9]{0,2}")
_TITLE = re.compile(r"#[ \t]*Method:[ \t]*(\S.{0,200})")
_PARTS = frozenset({"A", "b", "c", "embedded", "dense"})
MAX_ROWS = 200_000
"""Most lines of a source."""
csv.field_size_limit(131_072)


def find(text: str, source: str) -> list[FoundTable]:
    """The table of a CSV file, or of each part of it between blank lines."""
    lines = text.splitlines()
    if len(lines) > MAX_ROWS:
        raise TooLarge(f"the source has more than {MAX_ROWS} lines", MAX_ROWS + 1)
    title = next((x[1] for x in map(_TITLE.match, lines) if x), "")
    name = title.strip() or PurePath(source).stem.removeprefix("<stdin>")
    rows = []
    for number, line in enumerate(lines, start=1):
        is_blank = not line.strip() or line.lstrip().startswith("#")
        rows.append((number, [] if is_blank else _cells(line)))
    allowance = Allowance()
    found: list[FoundTable] = []
    part: list[tuple[int, list[str]]] = []
    for row in [*rows, (0, [])]:
        if row[1]:
            part.append(row)
            continue
        table = _table(part, source, name, allowance) if part else None
        if table is not None:
            found.append(table)
        part = []
    return found


def _cells(line: str) -> list[str]:
    try:
        for row in csv.reader([line]):
            return [cell.strip() for cell in row]
    except csv.Error:
        return []
    return []


def _table(
    rows: Sequence[tuple[int, list[str]]], source: str, name: str, allowance: Allowance
) -> FoundTable | None:
    first, head = rows[0]
    if [x.lower() for x in head] == COLUMNS:
        return _of_entries(rows, source, name, allowance)
    table = _printed([row for _, row in rows], source, name, first)
    return None if table is None else allowance.table(table)


def _of_entries(
    rows: Sequence[tuple[int, list[str]]], source: str, name: str, allowance: Allowance
) -> FoundTable | None:
    """``part,l,m,i,j,value``: an entry a row; colours and stages count from 1."""
    arrays: dict[tuple[str, str, str], dict[tuple[int, ...], Value]] = {}
    for _, row in rows[1:]:
        if len(row) != len(COLUMNS) or row[0] not in _PARTS:
            return None
        part, l, m, *place, value = row
        indices = tuple(int(x) for x in place if _INDEX.fullmatch(x))
        if not indices or max(indices) > MAX_STAGES:
            return None
        arrays.setdefault((part, l, m), {})[indices] = Scalar(value, 0)
    cells = Cells(rows[0][0])
    colours = {l for part, l, _ in arrays if part == "b"}
    if not 0 < len(colours) <= MAX_COLOURS:
        return None
    for (part, l, m), entries in arrays.items():
        array = _array(entries)
        numbers = tuple(int(x) for x in (l, m) if _INDEX.fullmatch(x))
        if array is None or not numbers:
            return None
        cells.put(part, numbers, array)
    return cells.table(source, NAME, name, allowance)


def _array(entries: dict[tuple[int, ...], Value]) -> Value:
    """A row or a matrix; None where an entry is missing."""
    rows = max(index[0] for index in entries)
    if all(len(index) == 1 for index in entries):
        row = [entries.get((i,)) for i in range(1, rows + 1)]
        return None if None in row else row
    columns = max(index[-1] for index in entries)
    if len(entries) != rows * columns:
        return None
    numbers = range(1, columns + 1)
    return [[entries.get((i, j)) for j in numbers] for i in range(1, rows + 1)]


def _printed(
    rows: Sequence[Row | list[str]], source: str, name: str, line: int
) -> FoundTable | None:
    """Rows ``c_i, a_i1, …``; below them the weights, whose first cell is empty."""
    stages = len(rows[0]) - 1
    weights = [row[1:] for row in rows if not row[0]]
    above = [row for row in rows if row[0]]
    is_square = 0 < stages <= MAX_STAGES and len(above) == stages
    if not is_square or not 1 <= len(weights) <= 2:
        return None
    if any(len(row) > stages + 1 for row in rows):
        return None
    full = [_full(row, stages + 1) for row in above]
    below = [_full(row, stages) for row in weights]
    return FoundTable(
        source,
        line,
        NAME,
        name,
        ((tuple(row[1:] for row in full),),),
        (below[0],),
        (tuple(row[0] for row in full),),
        embedded=(below[1],) if len(below) == 2 else None,
    )


def _full(row: Row | list[str], length: int) -> Row:
    missing = length - len(row)
    return tuple(x or "0" for x in row) + ("0",) * missing


READER = Reader(NAME, "CSV: gark's export, or a tableau as it is printed", (".csv",), find)
