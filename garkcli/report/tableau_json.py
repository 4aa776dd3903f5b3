"""``gark tableau``, ``gark conjugate`` and ``gark reduce`` as JSON: exact strings, with floats of
the same shape beside them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from flint import arb

from garkcli.exact.display import to_float
from garkcli.exact.parametric import Parametric
from garkcli.page.cells import cell_text
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import (
    DERIVATION,
    FLAG,
    NUMBER,
    NUMERAL,
    TEXT,
    Schema,
    array,
    nullable,
    published,
)
from garkcli.report.check import COLOURS, colours_of
from garkcli.tableau.garkmethod import Derivation
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain

SCHEMA = "gark/tableau/1"


def render(tableau: Tableau, entries: Entries, name: str, derivation: Derivation = "") -> str:
    """The tableau as JSON text."""
    return REPORT.text(_Shown(tableau, entries, name, derivation))


def as_data(tableau: Tableau, entries: Entries, name: str) -> dict[str, Any]:
    """The tableau as plain data."""
    return REPORT.data(_Shown(tableau, entries, name))


def tableau_report_schema() -> Schema:
    """The JSON Schema of tableaus, of all commands that print one."""
    return published("tableau of gark tableau, conjugate, convert and reduce", REPORT.schema)


class _Shown(NamedTuple):
    """A tableau with the entries that are shown of it."""

    tableau: Tableau
    entries: Entries
    name: str
    derivation: Derivation = ""


def _float(cell: Cell | Parametric) -> float | None:
    if isinstance(cell, Parametric):
        return None
    return float(cell) if isinstance(cell, arb) else to_float(cell)


def _entry_fields(
    entry: Schema, change: Callable[[Entries, Cell], object]
) -> tuple[Field[Entries], ...]:
    """c, A, b and further weights with their entries changed into what ``entry`` describes."""

    def rows(entries: Entries, found: Sequence[Sequence[Cell]]) -> list[list[Any]]:
        return [[change(entries, x) for x in row] for row in found]

    def blocks(entries: Entries) -> list[list[Any]]:
        return [
            [None if block is None else rows(entries, block) for block in row] for row in entries.A
        ]

    def embedded(entries: Entries) -> list[list[Any]] | None:
        if entries.embedded is None:
            return None
        return rows(entries, entries.embedded)

    def dense(entries: Entries) -> list[list[Any]] | None:
        if entries.dense is None:
            return None
        return [rows(entries, of_colour) for of_colour in entries.dense]

    matrix = array(array(entry))
    return (
        Field("c", matrix, lambda x: rows(x, x.c)),
        Field("A", array(array(nullable(matrix))), blocks),
        Field("b", matrix, lambda x: rows(x, x.b)),
        Field("embedded", matrix, embedded, is_optional=True),
        Field("dense", array(matrix), dense, is_optional=True),
    )


_EXACT = _entry_fields(NUMERAL, lambda entries, x: cell_text(x, entries.digits))
_FLOATS: Record[Entries] = Record(*_entry_fields(NUMBER, lambda _, x: _float(x)))
REPORT: Record[_Shown] = Record(
    schema_named(SCHEMA),
    Field("name", TEXT, lambda x: x.name),
    Field("derivation", DERIVATION, lambda x: x.derivation),
    Field("exact", FLAG, lambda x: x.entries.is_exact),
    Field(
        "colours",
        array(COLOURS.schema),
        lambda x: [COLOURS.data(x, Plain()) for x in colours_of(x.tableau)],
    ),
    *inside(lambda x: x.entries, _EXACT),
    Field("float", _FLOATS.schema, lambda x: _FLOATS.data(x.entries)),
)
