"""Numbers in rows: CSV, files of RungeKutta.jl, the output of ``ARKodeButcherTable_Write``."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping, Sequence

from garkcli.bridges.readers.printed import Nested, Values, grid, reader
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, TooLarge

COLUMNS = ["part", "l", "m", "i", "j", "value"]
_INDEX = re.compile(r"[1-9][0-9]{0,2}")
_TITLE = re.compile(r"^#[ \t]*Method:[ \t]*(\S.{0,200})", re.MULTILINE)
_PARTS = frozenset({"A", "b", "c", "embedded", "dense"})
MAX_ROWS = 200_000
_HEAD = re.compile(r"#[ \t]*([0-9]{1,3})[ \t]+([0-9]{1,3})[ \t]+([A-Za-z]\S*)")
"""``# order stages Type``; the type is never evaluated."""
_NUMBER = re.compile(r"[-+]?(?:[0-9]{1,400}\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,4}|//[0-9]+)?")
_PART = re.compile(r"[ \t]*([Acbd])[ \t]*=[ \t]*([-+0-9.eE \t,]*)")
MAX_LINE = 20_000
csv.field_size_limit(131_072)


def _csv(text: str) -> Iterator[tuple[int, Values]]:
    """The table of a CSV file, or of each part between blank lines."""
    lines = text.splitlines()
    if len(lines) > MAX_ROWS:
        raise TooLarge(f"the source has more than {MAX_ROWS} lines", MAX_ROWS + 1)
    title_line = _TITLE.search(text)
    title: Values = {"title": ir.Text(title_line[1].strip())} if title_line else {}
    rows: list[list[str]] = []
    for number, line in enumerate([*lines, ""], start=1):
        cells = [] if line.lstrip().startswith("#") else _cells(line)
        if cells:
            rows.append(cells)
            continue
        is_export = bool(rows) and [x.lower() for x in rows[0]] == COLUMNS
        values = _entries(rows[1:]) if is_export else _tableau(rows)
        if values:
            yield number - len(rows), {**title, **values}
        rows = []


def _cells(line: str) -> list[str]:
    try:
        return [cell.strip() for row in csv.reader([line]) for cell in row]
    except csv.Error:
        return []


def _entries(rows: Sequence[Sequence[str]]) -> Values:
    """``part,l,m,i,j,value``: one row for each entry; colours and stages count from 1."""
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
    if () in entries:
        return entries[()]
    inner: dict[int, dict[tuple[int, ...], str]] = {}
    for (first, *others), x in entries.items():
        inner.setdefault(first, {})[tuple(others)] = x
    numbers = range(1, max(*inner, *widths[:1], 0) + 1)
    return [_nested(inner[i], widths[1:]) if i in inner else None for i in numbers]


def _tableau(rows: Sequence[list[str]]) -> Values:
    """Rows ``c_i, a_i1, …``; below them the weights, with an empty first cell."""
    width = len(rows[0]) if rows else 0
    if not 1 < width <= MAX_STAGES + 1 or any(len(row) > width for row in rows):
        return {}
    padded = [row + [""] * (width - len(row)) for row in rows]
    below = [row[1:] for row in padded if not row[0]]
    above = [row for row in padded if row[0]]
    return grid([width - 1], [above], below) if len(below) < 3 else {}


def _tsv(text: str) -> Iterator[tuple[int, Values]]:
    """A line ``# order stages Type``, then c and A, then b below."""
    lines = text.splitlines()
    for number, line in enumerate(lines, start=1):
        head = _HEAD.fullmatch(line.strip())
        width = int(head[2]) + 1 if head else 0
        rows = [_numbers(x) for x in lines[number : number + width]]
        if head and width > 1 and [len(row) for row in rows] == [width] * width:
            *above, below = [[x.replace("//", "/") for x in row] for row in rows]
            values = grid([width - 1], [above], [below[1:]])
            yield number, {**values, "order": "" if head[1] == "0" else head[1]}


def _numbers(text: str) -> list[str]:
    words = text.replace(",", " ").split()[: MAX_STAGES + 1]
    return words if all(map(_NUMBER.fullmatch, words)) else []


def _arkode(text: str) -> Iterator[tuple[int, Values]]:
    """``A =`` and its rows, ``c =``, ``b =``, ``d =``."""
    line = 0
    parts: dict[str, list[list[str]]] = {}
    for number, content in enumerate([*text.splitlines(), "A ="], start=1):
        short = content[:MAX_LINE].rstrip()
        begun = _PART.fullmatch(short)
        if begun and begun[1] == "A":
            A, (b,), (c,), (d,) = (parts.get(x, [[]]) for x in "Abcd")
            if b and [len(x) for x in (*A, c)] == [len(b)] * (len(b) + 1):
                embedded = d if len(d) == len(b) else None
                yield line, {"A": A, "b": b, "c": c, "embedded": embedded}
            parts, line = {"A": []}, number
        elif begun and line:
            parts[begun[1]] = [_numbers(begun[2])]
        elif len(parts) == 1 and (row := _numbers(short)):
            parts["A"].append(row)


CSV = reader("csv", "CSV: gark's export, or a tableau as it is printed", (".csv",), _csv, True)
TSV = reader("tsv", "tables of RungeKutta.jl: # order stages Type", (".tsv", ".txt"), _tsv, True)
ARKODE = reader(
    "arkode-text", "what ARKodeButcherTable_Write prints", (".txt", ".log", ".out"), _arkode
)
