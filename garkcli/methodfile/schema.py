"""The JSON Schema (draft-07) of method files, for editors; made from the same lists that the loader
checks by.

It says what can be said about one value at a time. Sizes that have to fit each other, names of
parameters and everything mathematical are for ``gark check``.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from garkcli.design.wants.registry import WANTS, find_want
from garkcli.families.registry import FAMILIES, MAX_STAGES
from garkcli.methodfile.description import FORMS, STRUCTURES
from garkcli.methodfile.expectations import NUMBERS, TABLES
from garkcli.methodfile.shaped import MAX_STAGES as MOST_UNKNOWN_STAGES
from garkcli.methodfile.shapes.registry import SHAPES, find_shape
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.methodfile.unknowns import UNKNOWN
from garkcli.properties.property import Kind
from garkcli.properties.registry import every_property
from garkcli.transfer import RULES, SUMMARIES

Schema: TypeAlias = dict[str, Any]

_NUMBER: Schema = {
    "description": "A coefficient: a number, or text such as 1/2 - sqrt(3)/6,"
    " read exactly as written.",
    "type": ["number", "string"],
    "pattern": r"^[-+*/^(),.\sA-Za-z0-9_]+$",
}
_MEASURE: Schema = {
    "description": "A number that is claimed: exact, a decimal, infinity, or >= a number.",
    "type": ["number", "string"],
    "pattern": r"^(>=\s*)?[-+*/^(),.\sA-Za-z0-9_]+$",
}
_ENTRY: Schema = {
    "anyOf": [
        _NUMBER,
        {
            "const": UNKNOWN,
            "description": "Unknown: gark design finds values.",
        },
    ]
}
_ROW: Schema = {
    "anyOf": [{"type": "array", "items": _ENTRY, "minItems": 1}, _ENTRY]
}
_MATRIX: Schema = {
    "description": "Row by row; the rows of a triangle may end at the diagonal or before it.",
    "type": "array",
    "items": {
        "anyOf": [
            {"$ref": "#/definitions/row"},
            {"type": "array", "maxItems": 0},
        ]
    },
    "minItems": 1,
}
_RANGE: Schema = {
    "type": "array",
    "items": _NUMBER,
    "minItems": 2,
    "maxItems": 2,
}
_TEXT: Schema = {"type": ["string", "number", "boolean", "null"]}


def method_file_schema() -> Schema:
    """The schema as plain data."""
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "gark method file",
        "description": "One Runge-Kutta method: GARK, ARK, PRK, or built from diagonal methods.",
        "type": "object",
        "additionalProperties": False,
        "oneOf": [
            *({"required": [form]} for form in (*FORMS, "unknown")),
            {"required": ["A", "b"]},
        ],
        "allOf": [
            _goes_with("transfer", {"required": ["methods"]}),
            _goes_with(
                "linear",
                {"anyOf": [{"required": ["tableau"]}, {"required": ["A"]}]},
            ),
            _goes_with("unknown", {"not": {"required": ["parameters"]}}),
            _goes_with("c", {"anyOf": [{"required": ["A"]}]}),
            {
                "if": {
                    "required": ["methods"],
                    "properties": {
                        "methods": {"type": "array", "minItems": 2}
                    },
                },
                "then": {"required": ["transfer"]},
            },
            {
                "if": {
                    "required": ["structure"],
                    "properties": {"structure": {"not": {"const": "general"}}},
                },
                "then": {
                    "anyOf": [
                        {"required": [form]}
                        for form in ("methods", "prk", "unknown")
                    ]
                },
            },
            {
                "if": {"required": ["prk"]},
                "then": {
                    "properties": {
                        "structure": {"not": {"const": "semi-separable"}}
                    }
                },
            },
        ],
        "properties": _properties(),
        "definitions": {
            "number": _NUMBER,
            "row": _ROW,
            "matrix": _MATRIX,
            "butcher": _butcher(),
            "method": {
                "oneOf": [_family(), {"$ref": "#/definitions/butcher"}]
            },
            "rule": _rule(),
        },
    }


def _goes_with(key: str, form: Schema) -> Schema:
    return {"if": {"required": [key]}, "then": form}


def _properties() -> Schema:
    return {
        "gark": {"description": "Version of the format.", "enum": [1, "1"]},
        "name": {**_TEXT, "description": "What people call the method."},
        "description": {**_TEXT, "description": "What it is for."},
        "reference": {**_TEXT, "description": "Where it was published."},
        "methods": {
            "description": "The diagonal methods, one a colour; one on its own needs no list.",
            "anyOf": [
                {
                    "type": "array",
                    "minItems": 1,
                    "items": {"$ref": "#/definitions/method"},
                },
                {"$ref": "#/definitions/method"},
            ],
        },
        **_tableau_keys(),
        "transfer": _transfer(),
        "tableau": _tableau(),
        "ark": _ark(),
        "prk": _closed(
            {
                "q": {"$ref": "#/definitions/butcher"},
                "p": {"$ref": "#/definitions/butcher"},
            },
            "q",
            "p",
        ),
        "structure": {
            "description": "Which vector fields the problem has.",
            "enum": list(STRUCTURES),
        },
        "conjugate": {
            "description": "The method is the symplectic conjugate of all this.",
            "type": "boolean",
        },
        "linear": {
            "description": "Colours whose vector field is linear.",
            "type": "array",
            "items": {"type": "integer", "minimum": 1},
        },
        "unknown": _unknown(),
        "design": _design(),
        "parameters": _parameters(),
        "tolerance": {
            **_NUMBER,
            "description": "The rounding of the coefficients, for instance 1e-13.",
        },
        "expect": _expect(),
    }


def _unknown() -> Schema:
    summaries = [
        {"const": x, "description": find_shape(x).summary} for x in SHAPES
    ]
    shape: Schema = {"oneOf": summaries}
    shapes = {"type": "array", "items": shape, "minItems": 1}
    stages = {"type": "integer", "minimum": 1, "maximum": MOST_UNKNOWN_STAGES}
    return {
        **_closed(
            {"stages": stages, "shape": {"anyOf": [shape, shapes]}},
            "stages",
            "shape",
        ),
        "description": "A tableau of unknowns with a shape, for gark design.",
    }


def _design() -> Schema:
    """What is wanted, for all colours or for those that are named."""
    number: Schema = {"$ref": "#/definitions/number"}
    count: Schema = {"type": "integer", "minimum": 1}
    by_kind: dict[str, Schema] = {
        "flag": {"type": "boolean"},
        "count": count,
        "number": number,
    }
    properties: Schema = {
        "order": count,
        "fix": {"type": "object", "additionalProperties": number},
        "range": {"type": "object", "additionalProperties": _RANGE},
    }
    for key in WANTS:
        want = find_want(key)
        value = by_kind[want.kind]
        colours = {
            "type": "object",
            "propertyNames": {"pattern": "^[1-9][0-9]*$"},
            "additionalProperties": value,
        }
        properties[key] = {
            "description": want.summary,
            "anyOf": [value, colours],
        }
    return {
        **_closed(properties),
        "description": "What gark design looks for, with the order of --order.",
    }


def _parameters() -> Schema:
    number = {"$ref": "#/definitions/number"}
    free = _closed({"free": {"const": True}, "range": _RANGE}, "free")
    return {
        "description": "Names used in coefficients, each with a value, or free.",
        "type": "object",
        "additionalProperties": {"anyOf": [number, free]},
    }


def _closed(properties: Schema, *required: str) -> Schema:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _family() -> Schema:
    names = {
        "enum": list(FAMILIES),
        "description": "A family of methods, see gark list.",
    }
    stages = {"type": "integer", "minimum": 1, "maximum": MAX_STAGES}
    family = _closed(
        {"family": names, "stages": stages, "name": _TEXT}, "family"
    )
    single = [name for name, x in FAMILIES.items() if x.smallest == x.largest]
    return {
        **family,
        "if": {"properties": {"family": {"enum": single}}},
        "else": {"required": ["stages"]},
    }


def _butcher() -> Schema:
    properties = {
        "name": _TEXT,
        "A": {"$ref": "#/definitions/matrix"},
        "b": {"$ref": "#/definitions/row"},
        "c": {"$ref": "#/definitions/row"},
    }
    return _closed(properties, "A", "b")


def _rule() -> Schema:
    words = [
        {"const": rule, "description": SUMMARIES[rule]} for rule in ALL_RULES
    ]
    weights = {rule: {"$ref": "#/definitions/number"} for rule in RULES}
    combination = {
        "type": "object",
        "properties": weights,
        "additionalProperties": False,
        "minProperties": 1,
    }
    return {"oneOf": [*words, combination]}


def _transfer() -> Schema:
    rule: Schema = {"$ref": "#/definitions/rule"}
    block = {"anyOf": [rule, {"$ref": "#/definitions/matrix"}]}
    blocks = {
        "type": "object",
        "propertyNames": {
            "pattern": r"^\s*[1-9][0-9]{0,3}\s*,\s*[1-9][0-9]{0,3}\s*$"
        },
        "additionalProperties": block,
    }
    split = {
        "type": "object",
        "properties": {"default": rule, "blocks": blocks},
        "additionalProperties": False,
        "minProperties": 1,
    }
    return {
        "description": "How the off-diagonal blocks are made.",
        "anyOf": [rule, split],
    }


def _tableau_keys() -> Schema:
    """A, b and c: of one colour a matrix and rows, of several a block or a row for each."""
    matrix: Schema = {"$ref": "#/definitions/matrix"}
    row: Schema = {"$ref": "#/definitions/row"}
    blocks = {
        "type": "array",
        "minItems": 1,
        "items": {"anyOf": [matrix, {"type": "null"}]},
    }
    rows_of_blocks = {"type": "array", "minItems": 1, "items": blocks}
    rows = {"type": "array", "minItems": 1, "items": row}
    nodes = {
        "type": "array",
        "minItems": 1,
        "items": {"anyOf": [row, {"type": "null"}]},
    }
    return {
        "A": {
            "description": "The matrix, or for several colours rows of blocks A^{l,m}, null where "
            "there is none.",
            "anyOf": [matrix, rows_of_blocks],
        },
        "b": {
            "description": "The weights; of several colours a row each.",
            "anyOf": [row, rows],
        },
        "c": {
            "description": "The nodes; where they are left out, the row sums of A.",
            "anyOf": [row, nodes],
        },
    }


def _tableau() -> Schema:
    return {
        **_closed(_tableau_keys(), "A", "b"),
        "description": "One Butcher tableau, or every block A^{l,m} of several colours.",
    }


def _ark() -> Schema:
    rows = {
        "anyOf": [
            {"$ref": "#/definitions/row"},
            {"type": "array", "items": {"$ref": "#/definitions/row"}},
        ]
    }
    properties = {
        "A": {
            "type": "array",
            "minItems": 1,
            "items": {"$ref": "#/definitions/matrix"},
        },
        "b": rows,
        "c": {"$ref": "#/definitions/row"},
    }
    return {
        **_closed(properties, "A", "b"),
        "description": "An additive method with shared stages.",
    }


def _expect() -> Schema:
    number = {
        "anyOf": [
            {"type": "integer", "minimum": 0},
            {"type": "string", "pattern": "^(>=\\s*)?[0-9]{1,4}$"},
        ]
    }
    entry = {"anyOf": [*number["anyOf"], {"type": "null"}]}
    row = {"type": "array", "items": entry}
    properties: Schema = dict.fromkeys(NUMBERS, number)
    properties |= {
        key: row if key == "B" else {"type": "array", "items": row}
        for key in TABLES
    }
    truth: Schema = {"type": "boolean"}
    properties["symplectic"] = truth
    by_kind: dict[Kind, Schema] = {
        "truth": truth,
        "count": number,
        "number": _MEASURE,
    }
    properties |= {x.key: by_kind[x.kind] for x in every_property()}
    return {
        "description": "Claims that gark check confirms.",
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
    }
