"""``gark conditions --format json``: pieces of text, a row each, with their JSON Schema."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, TypeAlias

from garkcli.exact.display import decimal
from garkcli.order.conditions import Condition
from garkcli.page.json_text import to_json
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import (
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
from garkcli.report.conditions_data import ConditionRow, Valued, shown
from garkcli.report.symplectic_subject import SUBJECT, Subject
from garkcli.trees.notation import format_tree, vertex_letters

SCHEMA = "gark/conditions/1"


def json_of(
    rows: Iterable[ConditionRow], subject: Subject | None, valued: Valued | None
) -> Iterator[str]:
    """The table as pieces of text.

    Args:
        rows: its rows.
        subject: where the rows are the independent conditions alone, what they are independent for.
        valued: where the rows have values, of what.
    """
    head = _HEADS[valued is not None]
    about = ""
    for key, value in head.data(_Scope(subject, valued)).items():
        text = to_json(value, indent=None, ascii_only=True)
        about += f'"{key}": {text}, '
    yield f'{{{about}"conditions": ['
    separator = "\n"
    for row in rows:
        line = to_json(row_data(row), indent=None)
        yield separator + line
        separator = ",\n"
    yield "\n]}\n"


def row_data(row: ConditionRow) -> dict[str, Any]:
    """One row as plain data."""
    return _ROWS[row.condition is not None].data(row)


def conditions_report_schema() -> Schema:
    """The JSON Schema of these reports: of all methods, or with the values of one."""
    forms = [head.with_rows("conditions", _ROWS[has_values]) for has_values, head in _HEADS.items()]
    return published("report of gark conditions", one_of(*forms))


class _Scope(NamedTuple):
    """What the table is about."""

    subject: Subject | None
    valued: Valued | None


_Value: TypeAlias = Callable[[ConditionRow, Condition], object]


def _of_condition(name: str, schema: Schema, value: _Value) -> Field[ConditionRow]:
    """A field of rows that have values."""

    def found(row: ConditionRow) -> object:
        assert row.condition is not None
        return value(row, row.condition)

    return Field(name, schema, found)


def _tolerance(scope: _Scope) -> str | None:
    if scope.valued is None or scope.valued.tolerance is None:
        return None
    return decimal(scope.valued.tolerance)


def _derivation(scope: _Scope) -> str:
    return "" if scope.valued is None else scope.valued.derivation


def _names(scope: _Scope) -> list[str]:
    return [] if scope.valued is None else scope.valued.names


def _multiplicity(row: ConditionRow) -> int | None:
    """How many identical conditions the row is; None where equivalent ones are counted."""
    if row.condition is None or row.stands_for:
        return None
    return len(row.condition.trees)


def _letters(row: ConditionRow) -> list[str] | None:
    return list(vertex_letters(row.tree)) if row.is_shape else None


def _members(row: ConditionRow) -> list[str] | None:
    return [format_tree(u) for u in row.members] or None


_ABOUT: Field[_Scope] = schema_named(SCHEMA)
_OF_METHOD: tuple[Field[_Scope], ...] = (
    Field("derivation", DERIVATION, _derivation),
    Field("colours", array(TEXT), _names),
    Field("tolerance", nullable(TEXT), _tolerance),
)
_INDEPENDENT: Field[_Scope] = SUBJECT.optional("symplectic", lambda x: x.subject)
_TREE: tuple[Field[ConditionRow], ...] = (
    Field("tree", TEXT, lambda x: format_tree(x.tree, not x.is_shape)),
    Field("root", nullable(POSITION), lambda x: None if x.is_shape else x.tree.root + 1),
    Field("order", POSITION, lambda x: x.tree.order),
    Field("sigma", POSITION, lambda x: x.tree.symmetry),
    Field("gamma", POSITION, lambda x: x.tree.density),
    Field("condition", TEXT, lambda x: x.formula),
    Field("for_all", array(TEXT), _letters, is_optional=True),
)
_KIND: Schema = {"enum": ["coupling", "diagonal"]}
_VALUES: tuple[Field[ConditionRow], ...] = (
    _of_condition("value", NUMERAL, lambda row, x: shown(x.value, row.digits)),
    _of_condition("required", NUMERAL, lambda row, x: shown(x.required, row.digits)),
    _of_condition("residual", NUMERAL, lambda row, x: shown(x.residual, row.digits)),
    _of_condition("holds", FLAG, lambda _, x: x.holds),
    _of_condition("kind", _KIND, lambda _, x: "coupling" if x.is_coupling else "diagonal"),
    Field("multiplicity", POSITION, _multiplicity, is_optional=True),
)
_CLASS: tuple[Field[ConditionRow], ...] = (
    Field("stands_for", POSITION, lambda x: x.stands_for or None, is_optional=True),
    Field("members", array(TEXT), _members, is_optional=True),
)
_HEADS: dict[bool, Record[_Scope]] = {
    False: Record(_ABOUT, _INDEPENDENT),
    True: Record(_ABOUT, *_OF_METHOD, _INDEPENDENT),
}
_ROWS: dict[bool, Record[ConditionRow]] = {
    False: Record(*_TREE, *_CLASS),
    True: Record(*_TREE, *_VALUES, *_CLASS),
}
"""Both by whether there are values."""
