"""Fragments of JSON Schema (draft-07) for the values of reports."""

from __future__ import annotations

from typing import Any, TypeAlias, get_args

from garkcli.tableau.garkmethod import Derivation

Schema: TypeAlias = dict[str, Any]

TEXT: Schema = {"type": "string"}
EXACT: Schema = {"type": "string", "description": "An exact number, such as 1/2 - sqrt(3)/6."}
INTEGER: Schema = {"type": "integer"}
FLAG: Schema = {"type": "boolean"}
NULL: Schema = {"type": "null"}
TRUE: Schema = {"const": True}
COUNT: Schema = {"type": "integer", "minimum": 0}
POSITION: Schema = {"type": "integer", "minimum": 1}
NUMERAL: Schema = {
    "type": "string",
    "description": "An exact number, or a decimal if the call asks for digits.",
}
NUMBER: Schema = {
    "type": ["number", "null"],
    "description": "A float; null beyond the range of floats, or where there is none.",
}
SIZE: Schema = {
    "type": ["number", "null"],
    "minimum": 0,
    "description": "A float; null beyond the range of floats.",
}

DERIVATION: Schema = {"enum": [*get_args(Derivation)]}
"""Whether a method is the conjugate or the pair of the one in the file; empty for itself."""


def nullable(schema: Schema) -> Schema:
    kind = schema.get("type")
    if isinstance(kind, list) and "null" in kind:
        return schema
    if kind in ("string", "boolean", "integer", "number"):
        return {**schema, "type": [kind, "null"]}
    return one_of(NULL, schema)


def array(items: Schema) -> Schema:
    return {"type": "array", "items": items}


def counts_of(what: str) -> Schema:
    return {
        "type": "object",
        "description": f"By {what}.",
        "patternProperties": {"^[1-9][0-9]*$": COUNT},
        "additionalProperties": False,
    }


def one_of(*schemas: Schema) -> Schema:
    """Returns a choice of schemas; of equal ones two would match."""
    return {"oneOf": [x for k, x in enumerate(schemas) if x not in schemas[:k]]}


def published(title: str, schema: Schema) -> Schema:
    """Returns the schema of a document; fields may be added, meanings never change."""
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": title}
    return {**head, **schema}
