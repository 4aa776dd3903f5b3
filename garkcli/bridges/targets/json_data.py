"""JSON: every number as exact text, nothing lost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from garkcli.bridges.comments import problem_class
from garkcli.bridges.numbers import EXACT, Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.exact.display import decimal
from garkcli.frozen import replace
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import (
    COUNT,
    DERIVATION,
    FLAG,
    NUMERAL,
    POSITION,
    TEXT,
    Schema,
    array,
    nullable,
    one_of,
    published,
)
from garkcli.tableau.pointwise import Block, Row
from garkcli.tableau.tableau import Colour

SCHEMA = "gark/export/1"
DIGITS = 40
"""Of entries that have no simple radicals."""
_EXACT = replace(EXACT, digits=DIGITS)
_PRINTED = replace(_EXACT, is_fraction_first=False)
"""Of methods with rounded coefficients: decimals stay decimals."""


def write(payload: Payload) -> str:
    """The method as one object."""
    return _REPORT.text(payload)


def export_schema() -> Schema:
    """The JSON Schema of what is written."""
    return published("method of gark export, with --to json", _REPORT.schema)


def style_of(payload: Payload) -> Style:
    """How the numbers of a method are written where nothing may be lost."""
    return _EXACT if payload.tolerance is None else _PRINTED


def _row(payload: Payload, cells: Row) -> list[str]:
    return payload.numbers(cells, style_of(payload))


def _rows(payload: Payload, found: Sequence[Row] | None) -> Any:
    """A row per colour; of one vector field the row itself."""
    if found is None:
        return None
    listed = [_row(payload, cells) for cells in found]
    return listed[0] if payload.kind == "rk" else listed


def _blocks(payload: Payload) -> Any:
    """``A[l][m]``; of one vector field the matrix itself."""

    def block(cells: Block) -> Any:
        return None if cells is None else [_row(payload, x) for x in cells]

    blocks = [[block(x) for x in of_colour] for of_colour in payload.A]
    return blocks[0][0] if payload.kind == "rk" else blocks


def _dense(payload: Payload) -> Any:
    if payload.dense is None:
        return None
    found = [[_row(payload, x) for x in rows] for rows in payload.dense]
    return found[0] if payload.kind == "rk" else found


def _tolerance(payload: Payload) -> str | None:
    tolerance = payload.tolerance
    return None if tolerance is None else decimal(tolerance)


_COLOUR: Record[Colour] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("term", POSITION, lambda x: x.term + 1),
    Field("drives", TEXT, lambda x: x.part),
    Field("linear", FLAG, lambda x: x.is_linear),
    Field("space", POSITION, lambda x: x.space + 1),
)
_NUMBERS = array(NUMERAL)
_MATRIX = array(_NUMBERS)
_ONE_ROW = one_of(_NUMBERS, _MATRIX)
_REPORT: Record[Payload] = Record(
    schema_named(SCHEMA),
    Field("written_by", TEXT, lambda x: f"gark {x.version}"),
    Field("name", TEXT, lambda x: x.name),
    Field("derivation", DERIVATION, lambda x: x.derivation),
    Field("kind", TEXT, lambda x: x.kind),
    Field("structure", TEXT, lambda x: x.structure),
    Field("problems", TEXT, problem_class),
    Field("order", COUNT, lambda x: x.orders.order),
    Field("embedded_order", nullable(COUNT), lambda x: x.orders.embedded),
    Field("nonautonomous_order", nullable(COUNT), lambda x: x.orders.nonautonomous),
    Field("tolerance", nullable(TEXT), _tolerance),
    Field("reference", nullable(TEXT), lambda x: x.reference or None),
    Field("exact", FLAG, lambda x: x.is_exact and x.digits is None),
    _COLOUR.every("colours", lambda x: x.tableau.colours),
    Field("c", _ONE_ROW, lambda x: _rows(x, x.c)),
    Field("A", one_of(_MATRIX, array(array(nullable(_MATRIX)))), _blocks),
    Field("b", _ONE_ROW, lambda x: _rows(x, x.b)),
    Field("embedded", _ONE_ROW, lambda x: _rows(x, x.embedded), is_optional=True),
    Field("dense", one_of(_MATRIX, array(_MATRIX)), _dense, is_optional=True),
)
BRIDGES = (
    Bridge(
        name="json",
        summary="JSON, every number as exact text",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".json",
        write=write,
        reads_back=True,
    ),
)
