"""The JSON Schema of ``reference`` and ``aliases``."""

from __future__ import annotations

from garkcli.errors import MAX_WORD
from garkcli.methodfile.bibliography import KEYS
from garkcli.methodfile.coefficient_schema import TEXT, Schema, closed
from garkcli.reference import WORKS

_PEOPLE: Schema = {"anyOf": [TEXT, {"type": "array", "items": TEXT}]}


def aliases() -> Schema:
    """Other names, in a list or one alone."""
    alias: Schema = {
        "type": ["string", "number"],
        "pattern": r"^[^/\\]*$",
        "minLength": 1,
        "maxLength": MAX_WORD,
    }
    several = {"type": "array", "items": alias, "uniqueItems": True}
    return {"description": "What else the method is called.", "anyOf": [several, alias]}


def reference() -> Schema:
    """A text, or the fields of a publication."""
    properties: Schema = dict.fromkeys(KEYS, TEXT)
    properties |= {"authors": _PEOPLE, "editors": _PEOPLE}
    properties["type"] = {"enum": list(WORKS)}
    properties["year"] = {"type": ["integer", "string"], "pattern": "^[0-9]{4}[a-z]?$"}
    return {"description": "Where it was published.", "anyOf": [TEXT, closed(properties, "title")]}
