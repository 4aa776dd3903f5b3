"""The JSON Schema (draft-07) of method files, for editors; made from the same lists that the loader
checks by.

It says what can be said about one value at a time. Sizes that have to fit each other, names of
parameters and everything mathematical are for ``gark check``.
"""

from __future__ import annotations

from garkcli.families.family import Family, Option
from garkcli.families.registry import FAMILIES, MAX_STAGES
from garkcli.methodfile.bibliography_schema import aliases, reference
from garkcli.methodfile.coefficient_schema import (
    DENSE,
    MATRIX,
    NUMBER,
    ROW,
    TEXT,
    Schema,
    ark,
    beside,
    butcher,
    closed,
    prk,
    tableau,
    tableau_keys,
)
from garkcli.methodfile.constructed.registry import construction
from garkcli.methodfile.content import KEYS_OF_METHOD
from garkcli.methodfile.described import described
from garkcli.methodfile.description import BESIDE, CONSTRUCTIONS, FORMS, STRUCTURES
from garkcli.methodfile.expectations import NUMBERS, TABLES, TRUTHS
from garkcli.methodfile.family_schema import design, parameters, unknown
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.properties.property import Kind
from garkcli.properties.registry import every_property
from garkcli.transfer import RULES, SUMMARIES

_MEASURE: Schema = {
    "description": "A number that is claimed: exact, a decimal, infinity, or >= a number.",
    "type": ["number", "string"],
    "pattern": r"^(>=\s*)?[-+*/^(),.\sA-Za-z0-9_]+$",
}


def method_file_schema() -> Schema:
    """The JSON Schema of method files, as plain data, with what each key means.

    >>> method_file_schema()["title"]
    'gark method file'
    """
    return described(_of_keys(), "method")


def _of_keys() -> Schema:
    """What each key may have, and which go together."""
    forms = [{"required": [form]} for form in (*FORMS, "unknown")]
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "gark method file",
        "description": "One Runge-Kutta method: GARK, ARK, PRK, or built from diagonal methods.",
        "type": "object",
        "additionalProperties": False,
        "oneOf": [*forms, {"required": ["A", "b"]}],
        "allOf": _what_goes_together(),
        "properties": _properties(),
        "definitions": _definitions(),
    }


def _definitions() -> Schema:
    """What the properties refer to."""
    method = {"oneOf": [_family(), {"$ref": "#/definitions/butcher"}]}
    return {
        "number": NUMBER,
        "row": ROW,
        "matrix": MATRIX,
        "dense": DENSE,
        "butcher": butcher(),
        "method": method,
        "part": _part(),
        "rule": _rule(),
    }


def _part() -> Schema:
    """A method inside of a construction."""
    forms = [{"required": [form]} for form in (*FORMS, "A")]
    name: Schema = {
        "type": "string",
        "description": "A single method of a family, or a name of the catalogue.",
    }
    known = _properties()
    written: Schema = {
        "type": "object",
        "additionalProperties": False,
        "oneOf": forms,
        "allOf": _what_goes_together(),
        "properties": {key: known[key] for key in KEYS_OF_METHOD},
    }
    return {"anyOf": [name, _family(), written]}


def _what_goes_together() -> list[Schema]:
    """Keys that need or exclude another, and values that do."""
    several = {"methods": {"type": "array", "minItems": 2}}
    not_general = {"structure": {"not": {"const": "general"}}}
    of_two_parts = [{"required": [form]} for form in ("methods", "prk", "unknown", "splitting")]
    one_hamiltonian = {"structure": {"not": {"const": "semi-separable"}}}
    return [
        _goes_with("transfer", {"required": ["methods"]}),
        _goes_with("linear", {"anyOf": [{"required": ["tableau"]}, {"required": ["A"]}]}),
        _goes_with("unknown", {"not": {"required": ["parameters"]}}),
        *(_goes_with(key, {"required": ["A"]}) for key in ("c", *BESIDE)),
        {
            "if": {"required": ["methods"], "properties": several},
            "then": {"required": ["transfer"]},
        },
        {
            "if": {"required": ["structure"], "properties": not_general},
            "then": {"anyOf": of_two_parts},
        },
        _goes_with("prk", {"properties": one_hamiltonian}),
    ]


def _goes_with(key: str, form: Schema) -> Schema:
    return {"if": {"required": [key]}, "then": form}


def _properties() -> Schema:
    """The keys of a file."""
    method = {"$ref": "#/definitions/method"}
    methods = {"type": "array", "minItems": 1, "items": method}
    return {
        "gark": {"enum": [1, "1"]},
        "name": TEXT,
        "aliases": aliases(),
        "description": TEXT,
        "reference": reference(),
        "methods": {"anyOf": [methods, method]},
        **tableau_keys(),
        "transfer": _transfer(),
        "tableau": tableau(),
        "ark": ark(),
        "prk": prk(),
        **{key: construction(key).schema() for key in CONSTRUCTIONS},
        "structure": {"enum": list(STRUCTURES)},
        "conjugate": {"type": "boolean"},
        "linear": {"type": "array", "items": {"type": "integer", "minimum": 1}},
        "unknown": unknown(),
        "design": design(),
        "parameters": parameters(),
        "tolerance": NUMBER,
        "expect": _expect(),
    }


def _family() -> Schema:
    """A family with what its members are chosen by; most by their stages alone."""
    names = {"enum": list(FAMILIES)}
    keys: Schema = {"family": names, "name": TEXT, **beside()}
    for family in FAMILIES.values():
        keys[family.size] = {"type": "integer", "minimum": 1}
        keys |= {option.name: _option(option) for option in family.options}
    keys["stages"] = {**keys["stages"], "maximum": MAX_STAGES}
    return {**closed(keys, "family"), "allOf": [_member(family) for family in FAMILIES.values()]}


def _option(option: Option) -> Schema:
    """What an option may be set to."""
    if option.words:
        return {"enum": list(option.words)}
    if option.smallest is not None:
        return {"type": "integer", "minimum": option.smallest}
    return {"$ref": "#/definitions/number"}


def _member(family: Family) -> Schema:
    """What a member of one family needs, and what it does not have."""
    others: set[str] = set()
    for other in FAMILIES.values():
        others |= set(other.keys) - set(family.keys)
    needed = [] if family.is_single else [family.size]
    needed += [option.name for option in family.options if not option.default]
    barred = dict.fromkeys(sorted(others), False)
    then: Schema = {"required": needed, "properties": barred}
    return {"if": {"properties": {"family": {"const": family.name}}}, "then": then}


def _rule() -> Schema:
    words = [{"const": rule, "description": SUMMARIES[rule]} for rule in ALL_RULES]
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
        "propertyNames": {"pattern": r"^\s*[1-9][0-9]{0,3}\s*,\s*[1-9][0-9]{0,3}\s*$"},
        "additionalProperties": block,
    }
    split = {
        "type": "object",
        "properties": {"default": rule, "blocks": blocks},
        "additionalProperties": False,
        "minProperties": 1,
    }
    return {"anyOf": [rule, split]}


def _expect() -> Schema:
    number = {
        "anyOf": [
            {"type": "integer", "minimum": 0},
            {"type": "string", "pattern": "^(>=\\s*)?[0-9]{1,4}$"},
        ]
    }
    entry = {"anyOf": [*number["anyOf"], {"type": "null"}]}
    row = {"type": "array", "items": entry}
    table = {"type": "array", "items": row}
    properties: Schema = dict.fromkeys(NUMBERS, number)
    for key in TABLES:
        properties[key] = row if key == "B" else table
    truth: Schema = {"type": "boolean"}
    properties |= dict.fromkeys(TRUTHS, truth)
    by_kind: dict[Kind, Schema] = {"truth": truth, "count": number, "number": _MEASURE}
    properties |= {x.key: by_kind[x.kind] for x in every_property()}
    return {"type": "object", "properties": properties, "additionalProperties": False}
