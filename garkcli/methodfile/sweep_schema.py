"""The JSON Schema (draft-07) of spec files of sweeps, for editors; made from the same lists that
the loader checks by.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from garkcli.families.registry import BY_STAGES
from garkcli.methodfile.coefficient_schema import Schema
from garkcli.methodfile.described import described
from garkcli.methodfile.sweep_file import KEYS
from garkcli.methodfile.sweep_search import FREE
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.transfer import RULES

_RATIONAL: Schema = {
    "description": "A rational number: 2, 0.1, 1/3.",
    "type": ["number", "string"],
    "pattern": r"^[-+*/^().,\sA-Za-z0-9_]+$",
}


def sweep_file_schema(kinds: Mapping[str, str]) -> Schema:
    """The schema as plain data.

    Args:
        kinds: the columns there are, and whether each is a ``truth``, ``count`` or ``number``.
    """
    columns = _one_or_more({"enum": list(kinds)})
    properties = {
        "name": {"type": "string"},
        "methods": {"type": "array", "minItems": 1, "items": _method()},
        "transfer": _one_or_more(_rule()),
        "files": _one_or_more({"type": "string"}),
        "parameters": {"type": "object", "additionalProperties": _grid()},
        "search": _search(),
        "columns": columns,
        "where": _conditions(kinds),
        "best": columns,
        "pareto": columns,
    }
    schema: Schema = {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "gark sweep file",
        "description": "Which methods are swept, and what is told of each.",
        "type": "object",
        "additionalProperties": False,
        "required": ["columns"],
        "anyOf": [{"required": ["methods"]}, {"required": ["files"]}],
        "properties": {key: properties[key] for key in KEYS},
    }
    return described(schema, "sweep")


def _one_or_more(item: Schema) -> Schema:
    return {"anyOf": [item, {"type": "array", "items": item, "minItems": 1}]}


def _words(words: Iterable[str]) -> Schema:
    return {"enum": list(words)}


def _method() -> Schema:
    span = {"type": "string", "pattern": r"^[0-9]{1,3}\.\.[0-9]{1,3}$"}
    stages = {"anyOf": [{"type": "integer", "minimum": 1}, span]}
    return {
        "type": "object",
        "additionalProperties": False,
        "required": ["family"],
        "properties": {"family": _one_or_more(_words(BY_STAGES)), "stages": _one_or_more(stages)},
    }


def _rule() -> Schema:
    weights = {
        "type": "object",
        "minProperties": 1,
        "propertyNames": _words(RULES),
        "additionalProperties": _RATIONAL,
    }
    return {"anyOf": [_words(ALL_RULES), weights]}


def _grid() -> Schema:
    steps = {
        "type": "object",
        "additionalProperties": False,
        "required": ["from", "to", "steps"],
        "properties": {
            "from": _RATIONAL,
            "to": _RATIONAL,
            "steps": {"type": "integer", "minimum": 1},
        },
    }
    choices = [{"const": FREE}, steps, *_one_or_more(_RATIONAL)["anyOf"]]
    return {"anyOf": choices}


def _search() -> Schema:
    seeds = {"type": "string", "pattern": r"^[0-9]{1,9}\.\.[0-9]{1,9}$"}
    number = {"type": "integer", "minimum": 1}
    return {
        "type": "object",
        "additionalProperties": False,
        "required": ["seeds"],
        "properties": {
            "seeds": {"anyOf": [{"type": "integer", "minimum": 0}, seeds]},
            "starts": number,
            "order": number,
        },
    }


def _conditions(kinds: Mapping[str, str]) -> Schema:
    bound: Schema = {"type": ["number", "string"], "pattern": r"^(>=|<=|>|<|=)?\s*[-+0-9./eE]+$"}
    truth: Schema = {"type": "boolean"}
    properties = {name: truth if kind == "truth" else bound for name, kind in kinds.items()}
    return {"type": "object", "additionalProperties": False, "properties": properties}
