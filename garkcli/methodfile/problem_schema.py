"""The JSON Schema (draft-07) of problem files, for editors; made from the same lists that the
loader checks by.

It says what can be said about one value at a time: which names formulas may have is for the loader.
"""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.exact.formula import RESERVED
from garkcli.methodfile.coefficient_schema import Schema
from garkcli.methodfile.described import described
from garkcli.methodfile.problem_text import KEYS, MAX_INVARIANTS, MAX_TERMS, MAX_VARIABLES
from garkcli.problems.vectorfield import TIME

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
    """The JSON Schema of problem files, as plain data, with what each key means.

    >>> problem_file_schema()["title"]
    'gark problem file'
    """
    return described(_of_keys(), "problem")


def _of_keys() -> Schema:
    """What each key may have, and which go together."""
    properties = _properties()
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "gark problem file",
        "description": "A Hamiltonian, a Lagrangian or right-hand sides, with initial values.",
        "type": "object",
        "additionalProperties": False,
        "required": ["variables"],
        "oneOf": [_of_momenta("hamiltonian"), _of_momenta("lagrangian"), _of_rhs()],
        "properties": {key: properties[key] for key in KEYS},
        "definitions": {"formula": _FORMULA, "constant": _CONSTANT},
    }


def _of_momenta(form: str) -> Schema:
    """What a file with a Hamiltonian or a Lagrangian has and has not."""
    return {
        "required": [form, "initial"],
        "properties": {"variables": _names(_VARIABLE), "exact": False},
    }


def _of_rhs() -> Schema:
    """What a file with right-hand sides has: a start, be it that of its solution."""
    without_time: Schema = {"propertyNames": {"not": {"const": TIME}}}
    return {
        "required": ["rhs"],
        "anyOf": [{"required": ["initial"]}, {"required": ["exact"]}],
        "properties": {
            "variables": _names(_name_but({*RESERVED, TIME})),
            "parameters": without_time,
        },
    }


def _names(pattern: str) -> Schema:
    """One name, or a list of different ones."""
    names = _one_or_list({"type": "string", "pattern": pattern}, MAX_VARIABLES)
    _, several = names["anyOf"]
    several["uniqueItems"] = True
    return names


def _properties() -> Schema:
    """What each key of the file may have."""
    formula: Schema = {"$ref": "#/definitions/formula"}
    terms = _one_or_list(formula, MAX_TERMS)
    constants: Schema = {
        "type": "object",
        "additionalProperties": {"$ref": "#/definitions/constant"},
    }
    by_name: Schema = {"type": "object", "additionalProperties": formula}
    sides = _one_or_list({"anyOf": [formula, by_name]}, MAX_TERMS)
    return {
        "gark": {"enum": [1, "1"]},
        "name": _TEXT,
        "description": _TEXT,
        "reference": _TEXT,
        "variables": _names(_NAME),
        "parameters": {**constants, "propertyNames": {"pattern": _NAME}},
        "hamiltonian": terms,
        "lagrangian": terms,
        "rhs": sides,
        "initial": constants,
        "exact": by_name,
        "t_end": {"$ref": "#/definitions/constant"},
        "invariants": {
            "type": "object",
            "additionalProperties": formula,
            "maxProperties": MAX_INVARIANTS,
        },
    }


def _one_or_list(item: Schema, most: int) -> Schema:
    """One value, or a list of up to ``most``."""
    several = {"type": "array", "items": item, "minItems": 1, "maxItems": most}
    return {"anyOf": [item, several]}
