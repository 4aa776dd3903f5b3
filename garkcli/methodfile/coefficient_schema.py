"""The JSON Schema of coefficients, and of the forms that spell them out."""

from __future__ import annotations

from typing import Any, TypeAlias

from garkcli.methodfile.further import MAX_DEGREE
from garkcli.methodfile.unknowns import UNKNOWN

Schema: TypeAlias = dict[str, Any]

NUMBER: Schema = {
    "description": "A coefficient: a number, or text such as 1/2 - sqrt(3)/6,"
    " read exactly as written.",
    "type": ["number", "string"],
    "pattern": r"^[-+*/^(),.\sA-Za-z0-9_]+$",
}
"""One coefficient."""
RANGE: Schema = {"type": "array", "items": NUMBER, "minItems": 2, "maxItems": 2}
"""Where a parameter lies, from and to."""
TEXT: Schema = {"type": ["string", "number", "boolean", "null"]}
"""A name or a text, as YAML may read it."""
_ENTRY: Schema = {
    "anyOf": [NUMBER, {"const": UNKNOWN, "description": "Unknown: gark design finds values."}]
}
ROW: Schema = {"anyOf": [{"type": "array", "items": _ENTRY, "minItems": 1}, _ENTRY]}
"""Weights or nodes; a single value is a row of one."""
MATRIX: Schema = {
    "description": "Row by row; the rows of a triangle may end at the diagonal or before it.",
    "type": "array",
    "items": {"anyOf": [{"$ref": "#/definitions/row"}, {"type": "array", "maxItems": 0}]},
    "minItems": 1,
}
"""A matrix."""


def closed(properties: Schema, *required: str) -> Schema:
    """A mapping with these keys and no others."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


DENSE: Schema = {
    "description": "Dense output: weights that are polynomials in θ.",
    **closed(
        {
            "degree": {
                "description": "Of the polynomials.",
                "type": "integer",
                "minimum": 1,
                "maximum": MAX_DEGREE,
            },
            "weights": {
                "description": "A row a stage, the coefficients of θ, θ², …; of several colours "
                "a block for each.",
                "type": "array",
                "minItems": 1,
            },
        },
        "degree",
        "weights",
    ),
}
"""Dense output, of one colour or of several."""


def beside() -> Schema:
    """What may stand beside the weights b of one colour."""
    embedded = {"description": "Embedded weights, one a stage.", "$ref": "#/definitions/row"}
    return {"embedded": embedded, "dense": {"$ref": "#/definitions/dense"}}


def butcher() -> Schema:
    """One diagonal method, or a part of a pair."""
    properties = {
        "name": TEXT,
        "A": {"$ref": "#/definitions/matrix"},
        "b": {"$ref": "#/definitions/row"},
        "c": {"$ref": "#/definitions/row"},
        **beside(),
    }
    return closed(properties, "A", "b")


def tableau_keys() -> Schema:
    """A, b and c: of one colour a matrix and rows, of several a block or a row for each."""
    matrix: Schema = {"$ref": "#/definitions/matrix"}
    row: Schema = {"$ref": "#/definitions/row"}
    blocks = {"type": "array", "minItems": 1, "items": {"anyOf": [matrix, {"type": "null"}]}}
    rows_of_blocks = {"type": "array", "minItems": 1, "items": blocks}
    rows = {"type": "array", "minItems": 1, "items": row}
    nodes = {"type": "array", "minItems": 1, "items": {"anyOf": [row, {"type": "null"}]}}
    return {
        "A": {
            "description": "The matrix, or for several colours rows of blocks A^{l,m}, null where "
            "there is none.",
            "anyOf": [matrix, rows_of_blocks],
        },
        "b": {"description": "The weights; of several colours a row each.", "anyOf": [row, rows]},
        "c": {
            "description": "The nodes; where they are left out, the row sums of A.",
            "anyOf": [row, nodes],
        },
        "embedded": {
            "description": "Embedded weights; of several colours a row each.",
            "anyOf": [row, rows],
        },
        "dense": {"$ref": "#/definitions/dense"},
    }


def tableau() -> Schema:
    """The form ``tableau``."""
    return {
        **closed(tableau_keys(), "A", "b"),
        "description": "One Butcher tableau, or every block A^{l,m} of several colours.",
    }


def ark() -> Schema:
    """The form ``ark``."""
    rows = {
        "anyOf": [
            {"$ref": "#/definitions/row"},
            {"type": "array", "items": {"$ref": "#/definitions/row"}},
        ]
    }
    properties = {
        "A": {"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/matrix"}},
        "b": rows,
        "c": {"$ref": "#/definitions/row"},
        "embedded": rows,
        "dense": {"$ref": "#/definitions/dense"},
    }
    return {**closed(properties, "A", "b"), "description": "An additive method with shared stages."}


def prk() -> Schema:
    """The form ``prk``."""
    part = {"$ref": "#/definitions/butcher"}
    return {
        **closed({"q": part, "p": part}, "q", "p"),
        "description": "A partitioned method: the tableaus of positions and momenta.",
    }
