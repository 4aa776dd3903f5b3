"""JSON: what gark exports and prints, and any object with A and b."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from garkcli.frozen import replace
from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import table_of_blocks
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.naming import ROLES, Scope
from garkcli.sources.scalars import Scalar, Value, number

NAME = "json"
MAX_DEPTH = 12
"""Deepest nesting of objects that tables are looked for in."""
_KEYS = {
    **ROLES,
    "claimed_order": "order",
    "embedded-order": "embedded_order",
    "b_embedded": "embedded",
}
_HAS_MATRIX = re.compile(r'"(?:A|a|Amat)"[ \t\r\n]*:')


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a JSON document."""
    try:
        document = json.loads(text, parse_float=_float, parse_int=_int)
    except (ValueError, RecursionError):
        return []
    allowance = Allowance()
    lines = _lines(text)
    found: list[FoundTable] = []
    for title, mapping in _mappings(document, "", 0):
        line = next(lines, 1) if _has_matrix(mapping) else 1
        table = _table(mapping, source, title, line)
        if table is not None:
            found.append(allowance.table(table))
    return found


def _float(text: str) -> Scalar:
    return number(text)


def _int(text: str) -> Scalar:
    return number(text)


def _lines(text: str) -> Iterator[int]:
    """The lines in which matrices stand."""
    place = 0
    line = 1
    for match in _HAS_MATRIX.finditer(text):
        line += text.count("\n", place, match.start())
        place = match.start()
        yield line


def _has_matrix(mapping: Mapping[str, Any]) -> bool:
    return any(key in mapping for key in ("A", "a", "Amat"))


def _mappings(document: object, title: str, depth: int) -> Iterator[tuple[str, dict[str, Any]]]:
    """The objects that may be tables, each with its name."""
    if depth > MAX_DEPTH:
        return
    if isinstance(document, dict):
        name = document.get("name")
        title = name if isinstance(name, str) else title
        if _has_matrix(document):
            yield title, document
            return
        for key, value in document.items():
            inner = key if depth or len(document) > 1 else title
            blocks = key in {"blocks", "tableau", "methods", "tables"}
            yield from _mappings(
                _with_head(document, value), title if blocks and title else inner, depth + 1
            )
    elif isinstance(document, list):
        for value in document:
            if isinstance(value, (dict, list)):
                yield from _mappings(value, title, depth + 1)


def _with_head(document: Mapping[str, Any], value: object) -> object:
    """What a table inside an object needs of the rest of it: its declared orders."""
    if not isinstance(value, dict) or not _has_matrix(value):
        return value
    head = {
        key: document[key]
        for key in ("order", "claimed_order", "embedded_order", "tolerance")
        if key in document
    }
    return {**head, **value}


def _table(mapping: Mapping[str, Any], source: str, title: str, line: int) -> FoundTable | None:
    values: dict[str, Value] = {}
    for key, content in mapping.items():
        role = _KEYS.get(key, key)
        if role in {"A", "b", "c", "embedded", "dense", "order", "embedded_order"}:
            values.setdefault(role, _value(content, 0))
        if role == "error":
            values[role] = _value(content, 0)
    table = table_of_blocks(values, source, NAME, title, line)
    if table is None:
        scope = Scope(title)
        for role, value in values.items():
            scope.add(_SPELT[role], value, line)
        table = next(scope.tables(source, NAME), None)
    if table is None or table.trouble:
        return table
    return replace(table, is_sure=True, **_told(mapping))


_SPELT = {
    "A": "A",
    "b": "b",
    "c": "c",
    "embedded": "bhat",
    "dense": "dense",
    "error": "E",
    "order": "order",
    "embedded_order": "embedded_order",
}


def _value(content: object, depth: int) -> Value:
    """A number, its text, or lists of them."""
    if isinstance(content, Scalar):
        return content
    if isinstance(content, str):
        return Scalar(content, 0)
    if isinstance(content, list) and depth < 5:
        return [_value(x, depth + 1) for x in content]
    if isinstance(content, dict):
        return _root(content)
    return None


def _root(content: Mapping[str, Any]) -> Value:
    """``{"root_of": polynomial, "decimal": digits}``."""
    polynomial, decimal = content.get("root_of"), content.get("decimal")
    if isinstance(polynomial, str) and isinstance(decimal, str):
        return Scalar(f"root_of({polynomial}, {decimal})")
    return None


def _told(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """What gark's own export says besides: what colours drive, the rounding."""
    found: dict[str, Any] = {}
    tolerance = mapping.get("tolerance")
    if isinstance(tolerance, str):
        found["tolerance"] = tolerance
    structure = mapping.get("structure")
    if isinstance(structure, str) and structure in _STRUCTURES:
        found["structure"] = structure
    colours = mapping.get("colours")
    if not isinstance(colours, list):
        return found
    drives = [x.get("drives") for x in colours if isinstance(x, dict)]
    if drives == ["q", "p"]:
        found["parts"] = ("q", "p")
    numbered = enumerate(colours)
    found["linear"] = tuple(l for l, x in numbered if isinstance(x, dict) and x.get("linear"))
    return found


_STRUCTURES = {"separable", "semi-separable", "nystrom"}
READER = Reader(NAME, "JSON: gark's export, or any object with A and b", (".json",), find)
