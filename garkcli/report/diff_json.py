"""``gark diff --format json``, with its schema."""

from __future__ import annotations

from typing import Any, NamedTuple

from flint import arb

from garkcli.comparison.comparison import Comparison, OrderPair, PropertyPair
from garkcli.comparison.differences import BlockGap, EntryGap
from garkcli.comparison.met import Met
from garkcli.comparison.sameness import Sameness
from garkcli.exact.display import to_text
from garkcli.order.conditions import Condition
from garkcli.order.deciding import AnyOrder
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import (
    COUNT,
    EXACT,
    FLAG,
    NUMERAL,
    POSITION,
    TEXT,
    Schema,
    array,
    nullable,
    published,
)
from garkcli.properties.keys import KEYS
from garkcli.report.diff_words import FORMS, verdict_name
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Cell
from garkcli.trees.notation import format_tree

SCHEMA = "gark/diff/1"
_DIGITS = 30


class _Shown(NamedTuple):
    """A comparison, and what the methods were asked for by."""

    found: Comparison
    files: tuple[str, str]


class _Method(NamedTuple):
    """One of the two methods."""

    method: GarkMethod
    file: str
    form: str


def render(found: Comparison, files: tuple[str, str]) -> str:
    """The comparison as JSON text."""
    return _REPORT.text(_Shown(found, files))


def diff_report_schema() -> Schema:
    """The JSON Schema of ``gark diff``."""
    return published("two methods, by gark diff", _REPORT.schema)


def _cell(cell: Cell) -> str:
    if isinstance(cell, arb):
        return str(cell.str(_DIGITS, radius=False))
    return to_text(cell)


def _place(number: int | None) -> int | None:
    """A number that counts from 1."""
    return None if number is None else number + 1


_ENTRY: Record[EntryGap] = Record(
    Field("row", nullable(POSITION), lambda x: _place(x.row)),
    Field("entry", POSITION, lambda x: x.entry + 1),
    Field("first", NUMERAL, lambda x: _cell(x.one)),
    Field("second", NUMERAL, lambda x: _cell(x.other)),
    Field("difference", NUMERAL, lambda x: _cell(x.gap)),
    Field("undecided", FLAG, lambda x: x.is_open),
)
_KIND: Schema = {"enum": ["A", "b", "c", "embedded", "dense"]}


def _shapes(gap: BlockGap) -> list[str] | None:
    return None if gap.shapes is None else list(gap.shapes)


_BLOCK: Record[BlockGap] = Record(
    Field("kind", _KIND, lambda x: x.kind),
    Field("colour", POSITION, lambda x: x.colour + 1),
    Field("seen", nullable(POSITION), lambda x: _place(x.seen)),
    Field("power", nullable(POSITION), lambda x: x.power or None),
    Field("shapes", nullable(array(TEXT)), _shapes),
    Field("of_entries", COUNT, lambda x: x.entries),
    _ENTRY.or_null("largest", lambda x: x.largest),
    _ENTRY.every("entries", lambda x: x.gaps),
)


def _images(same: Sameness) -> list[list[int]]:
    return [[i + 1 for i in row] for row in same.stages]


def _within(same: Sameness) -> str | None:
    return to_text(same.allowed) if same.allowed else None


_SAME: Record[Sameness] = Record(
    Field("colours", array(POSITION), lambda x: [l + 1 for l in x.colours]),
    Field("stages", array(array(POSITION)), _images),
    Field("reduced", FLAG, lambda x: x.is_reduced),
    Field("step_only", FLAG, lambda x: x.step_only),
    Field("within", nullable(EXACT), _within),
)


def _order(order: AnyOrder | None) -> int | None:
    return None if order is None else order.order


_ORDER: Record[OrderPair] = Record(
    Field("of", TEXT, lambda x: x.name),
    Field("first", nullable(COUNT), lambda x: _order(x.one)),
    Field("second", nullable(COUNT), lambda x: _order(x.other)),
)
_CONDITION: Record[tuple[Condition, Condition]] = Record(
    Field("tree", TEXT, lambda x: format_tree(x[0].tree)),
    Field("order", POSITION, lambda x: x[0].tree.order),
    Field("required", EXACT, lambda x: to_text(x[0].required)),
    Field("first", EXACT, lambda x: to_text(x[0].value)),
    Field("second", EXACT, lambda x: to_text(x[1].value)),
)
_MET: Record[Met] = Record(
    Field("order", COUNT, lambda x: x.order),
    _CONDITION.every("first_only", lambda x: x.first_only),
    _CONDITION.every("second_only", lambda x: x.second_only),
)
_PROPERTY: Record[PropertyPair] = Record(
    Field("property", {"enum": [*KEYS, "symplectic"]}, lambda x: x.key),
    Field("first", TEXT, lambda x: verdict_name(x.one)),
    Field("second", TEXT, lambda x: verdict_name(x.other)),
)


def _tolerance(method: GarkMethod) -> str | None:
    return None if method.tolerance is None else to_text(method.tolerance)


_METHOD: Record[_Method] = Record(
    Field("file", TEXT, lambda x: x.file),
    Field("name", TEXT, lambda x: x.method.name),
    Field("form", {"enum": list(FORMS)}, lambda x: x.form),
    Field("stages", array(POSITION), lambda x: list(x.method.stages)),
    Field("tolerance", nullable(EXACT), lambda x: _tolerance(x.method)),
)
_RELATION: Schema = {"enum": ["identical", "same", "within-rounding", "different", "undecided"]}


def _first(shown: _Shown) -> _Method:
    return _Method(shown.found.one, shown.files[0], shown.found.forms[0])


def _second(shown: _Shown) -> _Method:
    return _Method(shown.found.other, shown.files[1], shown.found.forms[1])


def _obstacle(shown: _Shown) -> Any:
    return shown.found.obstacle or None


_REPORT: Record[_Shown] = Record(
    schema_named(SCHEMA),
    _METHOD.whole("first", _first),
    _METHOD.whole("second", _second),
    Field("relation", _RELATION, lambda x: x.found.relation),
    Field("obstacle", nullable(TEXT), _obstacle),
    Field("remark", nullable(TEXT), lambda x: x.found.remark or None),
    _SAME.or_null("same", lambda x: x.found.sameness),
    _BLOCK.every("differences", lambda x: x.found.gaps),
    _ORDER.every("orders", lambda x: x.found.orders),
    _MET.or_null("conditions", lambda x: x.found.met),
    _PROPERTY.every("properties", lambda x: x.found.properties),
)
