"""Printed tableaus, lowered to one call that makes a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import PurePath
from typing import TypeAlias

from garkcli.sources import ir
from garkcli.sources.formulas import formula
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.reading import tables_in
from garkcli.sources.signatures import PRINTED

Nested: TypeAlias = "str | Sequence[Nested] | ir.Expr | None"
"""Numbers as texts, in lists; None for a missing block."""
Cells: TypeAlias = Sequence[Sequence[str]]
Values: TypeAlias = Mapping[str, Nested]
"""The parts of a tableau by their names: ``A``, ``b``, ``c``, ``embedded``, …"""


def printed(line: int, values: Values) -> ir.Statement:
    named = tuple((key, listed(x)) for key, x in values.items() if x)
    made = ir.Do(ir.Call(ir.Name(PRINTED), (), named), line)
    return ir.Scope("entry", "", (made,), line)


def listed(value: Nested) -> ir.Expr:
    match value:
        case None:
            return ir.Nothing()
        case str():
            return formula(value)
        case list() | tuple():
            return ir.Items(tuple(map(listed, value)))
    assert not isinstance(value, Sequence)
    return value


def grid(groups: Sequence[int], stages: Sequence[Cells], weights: Cells) -> Values:
    """``groups`` are columns of each vector field; empty if sizes do not fit; empty cells are 0."""
    if len(stages) == 1 and len(groups) > 1:
        # colours that share their stages, or a bar without meaning
        is_shared = len(set(groups)) == 1 and groups[0] == len(stages[0])
        groups = groups if is_shared else [sum(groups)]
    due = groups if len(stages) > 1 else groups[:1]
    if not weights or [len(rows) for rows in stages] != [*due]:
        return {}
    below = [list(map(filled, split(row, groups))) for row in weights]
    return {
        "A": [blocks(groups, rows) for rows in stages],
        "b": below[0],
        "c": list(map(nodes, stages)),
        "embedded": below[1] if len(below) == 2 else None,
    }


def split(row: Sequence[str], groups: Sequence[int]) -> list[Sequence[str]]:
    starts = [sum(groups[:m]) for m in range(len(groups))]
    return [row[start : start + count] for start, count in zip(starts, groups, strict=True)]


def filled(row: Sequence[str]) -> list[str]:
    return [x or "0" for x in row]


def nodes(rows: Cells) -> list[str]:
    return filled([row[0] for row in rows])


def blocks(groups: Sequence[int], rows: Cells) -> list[Nested]:
    """The blocks of a set of stages; None for an empty one among several."""
    columns = zip(*(split(row[1:], groups) for row in rows), strict=True)
    is_one = len(groups) == 1
    return [list(map(filled, x)) if is_one or any(map(any, x)) else None for x in columns]


def reader(
    name: str,
    summary: str,
    suffixes: tuple[str, ...],
    tableaus: Callable[[str], Iterable[tuple[int, Values]]],
    is_named_by_file: bool = False,
) -> Reader:
    """The reader of a format; ``tableaus`` gives those of a text with their lines."""

    def find(text: str, source: str) -> list[FoundTable]:
        # standard input, <stdin>, has no name
        is_named = is_named_by_file and not source.startswith("<")
        title: Values = {"title": ir.Text(PurePath(source).stem)} if is_named else {}

        def lowered(_: str) -> ir.Body:
            return tuple(printed(line, {**title, **values}) for line, values in tableaus(text))

        return tables_in("", source, name, lowered, base=1)

    return Reader(name, summary, suffixes, find)
