"""CSV: gark's export, a row an entry; or a tableau as it is printed, nodes in the first column."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping, Sequence

from garkcli.bridges.readers.printed import Nested, found_in, printed, stem_of
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader, TooLarge

NAME = "csv"
COLUMNS = ["part", "l", "m", "i", "j", "value"]
_INDEX = re.compile(r"[1-9][0-9]{0,2}")
_TITLE = re.compile(r"^#[ \t]*Method:[ \t]*(\S.{0,200})", re.MULTILINE)
_PARTS = frozenset({"A", "b", "c", "embedded", "dense"})
MAX_ROWS = 200_000
"""Most lines of a source."""
csv.field_size_limit(131_072)


def find(text: str, source: str) -> list[FoundTable]:
    """The table of a CSV file, or of each part of it between blank lines."""
    lines = text.splitlines()
    if len(lines) > MAX_ROWS:
        raise TooLarge(f"the source has more than {MAX_ROWS} lines", MAX_ROWS + 1)
    told = _TITLE.search(text)
    title = ir.Text(told[1].strip()) if told else stem_of(source)
    return found_in(source, NAME, _tableaus(lines, title))


def _tableaus(lines: Sequence[str], title: ir.Text | None) -> Iterator[ir.Statement]:
    part: list[list[str]] = []
    for number, line in enumerate([*lines, ""], start=1):
        cells = [] if line.lstrip().startswith("#") else _cells(line)
        if cells:
            part.append(cells)
            continue
        if part:
            is_export = [x.lower() for x in part[0]] == COLUMNS
            values = _entries(part[1:]) if is_export else _rows(part)
            if values:
                yield printed(number - len(part), title=title, **values)
        part = []


def _cells(line: str) -> list[str]:
    try:
        return [cell.strip() for row in csv.reader([line]) for cell in row]
    except csv.Error:
        return []


def _entries(rows: Sequence[Sequence[str]]) -> Mapping[str, Nested]:
    """``part,l,m,i,j,value``: each entry in a row of its own; colours and stages count from 1."""
    entries: dict[str, dict[tuple[int, ...], str]] = {}
    for row in rows:
        if len(row) != len(COLUMNS) or row[0] not in _PARTS:
            return {}
        at = tuple(int(x) for x in row[1:-1] if _INDEX.fullmatch(x))
        if not at or max(at) > MAX_STAGES:
            return {}
        entries.setdefault(row[0], {})[at] = row[-1]
    if not {"A", "b"} <= set(entries):
        return {}
    colours = max(at[0] for at in entries["b"])
    widths = {"A": (colours, colours)}
    return {part: _nested(x, widths.get(part, ())) for part, x in entries.items()}


def _nested(entries: Mapping[tuple[int, ...], str], widths: Sequence[int] = ()) -> Nested:
    """Entries in lists, so many at least, with nothing where none is given."""
    if () in entries:
        return entries[()]
    inner: dict[int, dict[tuple[int, ...], str]] = {}
    for (first, *others), x in entries.items():
        inner.setdefault(first, {})[tuple(others)] = x
    numbers = range(1, max(*inner, *widths[:1], 0) + 1)
    return [_nested(inner[i], widths[1:]) if i in inner else None for i in numbers]


def _rows(rows: Sequence[list[str]]) -> Mapping[str, Nested]:
    """Rows ``c_i, a_i1, …``; below them the weights, whose first cell is empty."""
    stages = len(rows[0]) - 1
    below = [_full(row[1:], stages) for row in rows if not row[0]]
    above = [_full(row, stages + 1) for row in rows if row[0]]
    is_square = 0 < stages <= MAX_STAGES and len(above) == stages
    if not is_square or len(below) not in (1, 2) or any(len(row) > stages + 1 for row in rows):
        return {}
    A, c = [row[1:] for row in above], [row[0] for row in above]
    return {"A": A, "b": below[0], "c": c, "embedded": below[1] if len(below) == 2 else None}


def _full(row: list[str], length: int) -> list[str]:
    return [x or "0" for x in row] + ["0"] * (length - len(row))


READER = Reader(NAME, "CSV: gark's export, or a tableau as it is printed", (".csv",), find)
