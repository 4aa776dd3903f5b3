"""The JSON Schema (draft-07) of problem files, for editors; made from the same lists that the
loader checks by.

It says what can be said about one value at a time: which names formulas may have is for the loader.
"""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.exact.formula import RESERVED
from garkcli.methodfile.problem import KEYS, MAX_INVARIANTS, MAX_TERMS, MAX_VARIABLES
from garkcli.methodfile.schema import Schema

_CLASHING = {name.removeprefix("p") for name in RESERVED if name.startswith("p")}


def _name_but(names: Iterable[str]) -> str:
    """The pattern of a name that is none of ``names``."""
    return f"^(?!({'|'.join(sorted(names))})$)[A-Za-z_][A-Za-z_0-9]{{0,29}}$"


_NAME = _name_but(RESERVED)
_VARIABLE = _name_but({*RESERVED, *_CLASHING})
_TEXT: Schema = {"type": ["string", "number", "boolean", "null"]}
_CONSTANT: Schema = {
    "description": "A number: 2, 0.1, 2/5, sqrt(2), pi/3, with parameters.",
    "type": ["number", "string"],
    "pattern": r"^[-+*/^().,\sA-Za-z0-9_]+$",
}
_FORMULA: Schema = {
    "description": "A formula such as px**2/2 - cos(x).",
    "type": ["number", "string"],
    "pattern": r"^[-+*/^().,\sA-Za-z0-9_]+$",
}


def problem_file_schema() -> Schema:
    """The schema as plain data."""
    properties = _properties()
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "gark problem file",
        "description": "A Hamiltonian or Lagrangian problem with its initial values.",
        "type": "object",
        "additionalProperties": False,
        "required": ["variables", "initial"],
        "oneOf": [{"required": ["hamiltonian"]}, {"required": ["lagrangian"]}],
        "properties": {key: properties[key] for key in KEYS},
        "definitions": {"formula": _FORMULA, "constant": _CONSTANT},
    }


def _properties() -> Schema:
    """What each key of the file may have."""
    formula: Schema = {"$ref": "#/definitions/formula"}
    terms = _one_or_list(formula, MAX_TERMS)
    constants: Schema = {
        "type": "object",
        "additionalProperties": {"$ref": "#/definitions/constant"},
    }
    name: Schema = {"type": "string", "pattern": _VARIABLE}
    variables = _one_or_list(name, MAX_VARIABLES)
    _, several = variables["anyOf"]
    several["uniqueItems"] = True
    return {
        "gark": {"description": "Version of the format.", "enum": [1, "1"]},
        "name": {**_TEXT, "description": "What people call the problem."},
        "description": {**_TEXT, "description": "What it is."},
        "reference": {**_TEXT, "description": "Where it was published."},
        "variables": {"description": "Names of the positions.", **variables},
        "parameters": {
            **constants,
            "propertyNames": {"pattern": _NAME},
            "description": "Named constants.",
        },
        "hamiltonian": {
            **terms,
            "description": "H in positions x and momenta px; a list: one term a colour.",
        },
        "lagrangian": {
            **terms,
            "description": "L in positions x and velocities vx; a list: one term a colour.",
        },
        "initial": {
            **constants,
            "description": "Initial positions, and momenta (or velocities of a Lagrangian).",
        },
        "t_end": {"$ref": "#/definitions/constant"},
        "invariants": {
            "description": "First integrals besides H, in positions and momenta.",
            "type": "object",
            "additionalProperties": formula,
            "maxProperties": MAX_INVARIANTS,
        },
    }


def _one_or_list(item: Schema, most: int) -> Schema:
    """One value, or a list of up to ``most``."""
    several = {"type": "array", "items": item, "minItems": 1, "maxItems": most}
    return {"anyOf": [item, several]}
