"""JSON: exports and output of gark, and any object with A and b."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from garkcli.bridges.exported import exported_table
from garkcli.bridges.readers.printed import Values, reader
from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.formulas import formula
from garkcli.sources.found import FoundTable
from garkcli.sources.naming import ROLES

MAX_DEPTH = 12
_KEYS = {
    **{key: key for key in ("tolerance", "structure")},
    **ROLES,
    "claimed_order": "order",
    "embedded-order": "embedded_order",
    "b_embedded": "embedded",
}
_HEAD = ("order", "claimed_order", "embedded_order", "tolerance")
_OBJECT = re.compile(r'"(?:[^"\\]|\\.)*"|\{')


def _tables_in(text: str) -> Iterator[tuple[int, Values]]:
    try:
        document = json.loads(text, parse_float=ir.Literal, parse_int=ir.Literal)
    except (ValueError, RecursionError):
        return
    yield from _tableaus(document, "", 0, _lines(text))


def _lines(text: str) -> Iterator[int]:
    place, line = 0, 1
    for match in _OBJECT.finditer(text):
        if match.group() == "{":
            line += text.count("\n", place, match.start())
            place = match.start()
            yield line


def _has_matrix(mapping: Mapping[str, Any]) -> bool:
    return any(isinstance(mapping.get(key), list | dict) for key in ("A", "a", "Amat"))


def _tableaus(
    document: object, title: str, depth: int, lines: Iterator[int]
) -> Iterator[tuple[int, Values]]:
    """The objects that may be tables, with their lines; ``lines`` has those of all objects."""
    line = next(lines, 1) if isinstance(document, dict) else 1
    if isinstance(document, list):
        for value in document:
            yield from _tableaus(value, title, depth + 1, lines)
    elif isinstance(document, dict) and depth <= MAX_DEPTH:
        name = document.get("name")
        title = name if isinstance(name, str) else title
        if _has_matrix(document):
            yield line, _tableau(document, title)
        for key, value in document.items():
            inner = key if depth or len(document) > 1 else title
            if key in {"blocks", "tableau", "methods", "tables"} and title:
                inner = title
            if isinstance(value, dict) and _has_matrix(value):
                value = {**{x: document[x] for x in _HEAD if x in document}, **value}
            yield from _tableaus(value, inner, depth + 1, lines)


def _tableau(mapping: Mapping[str, Any], title: str) -> Values:
    values: dict[str, ir.Expr] = {"title": ir.Text(title)}
    for key, content in mapping.items():
        if key in _KEYS:
            values.setdefault(_KEYS[key], _value(content))
    colour_objects = mapping.get("colours")
    colours = (
        [x for x in colour_objects if isinstance(x, dict)]
        if isinstance(colour_objects, list)
        else []
    )
    if [x.get("drives") for x in colours] == ["q", "p"]:
        values["parts"] = ir.Text("q p")
    linear = [str(l) for l, x in enumerate(colours) if x.get("linear")]
    return {**values, "linear": linear}


def _value(content: object, depth: int = 0) -> ir.Expr:
    match content:
        case ir.Literal():
            return content
        case str():
            return formula(content) if depth else ir.Text(content)
        case list() if depth < 5:
            return ir.Items(tuple(_value(x, depth + 1) for x in content))
        case {"root_of": str(polynomial), "decimal": str(near)}:
            return formula(f"root_of({polynomial}, {near})")
        case bool() | None:
            return ir.Name(str(content))
    return ir.Opaque("what is no number")


_OBJECTS = reader("json", "JSON: gark's export, or any object with A and b", (".json",), _tables_in)


def _find(text: str, source: str) -> list[FoundTable]:
    table = exported_table(text, source, _OBJECTS.name)
    return _OBJECTS.find(text, source) if table is None else [table]


READER = replace(_OBJECTS, find=_find)
