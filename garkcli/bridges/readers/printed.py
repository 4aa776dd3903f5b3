"""Tableaus as programs print them, lowered to one call that makes a table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import PurePath
from typing import TypeAlias

from garkcli.sources import ir
from garkcli.sources.formulas import formula
from garkcli.sources.found import FoundTable
from garkcli.sources.reading import tables_in
from garkcli.sources.signatures import PRINTED

Nested: TypeAlias = "str | Sequence[Nested] | ir.Expr | None"
"""Numbers as texts, in lists; nothing where a block is missing."""


def printed(line: int, **values: Nested) -> ir.Statement:
    """A tableau that is in a line, by its parts: ``A``, ``b``, ``c``, ``embedded``, …"""
    named = tuple((key, listed(x)) for key, x in values.items() if x)
    made = ir.Do(ir.Call(ir.Name(PRINTED), (), named), line)
    return ir.Scope("entry", "", (made,), line)


def listed(value: Nested) -> ir.Expr:
    """Numbers in lists as expressions."""
    match value:
        case None:
            return ir.Nothing()
        case str():
            return formula(value)
        case list() | tuple():
            return ir.Items(tuple(map(listed, value)))
    assert not isinstance(value, Sequence)
    return value


def found_in(source: str, format: str, tableaus: Iterable[ir.Statement]) -> list[FoundTable]:
    """The tables of a source that are printed in it, stages from 1."""
    return tables_in("", source, format, lambda _: tuple(tableaus), base=1)


def stem_of(source: str) -> ir.Text | None:
    """The name of the file; standard input, ``<stdin>``, has none."""
    return None if source.startswith("<") else ir.Text(PurePath(source).stem)
