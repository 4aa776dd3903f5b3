"""The JSON Schemas of files with what each key means, from the entries of the glossary."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from garkcli.design.wants.registry import WANTS, find_want
from garkcli.glossary.key import Key, keys_of
from garkcli.methodfile.coefficient_schema import Schema

_NO_KEYS = ("if", "then", "not", "patternProperties")
"""What stands below says how keys go together, not what they are."""
_BELOW = {"butcher": "methods.", "method": "methods.", "dense": "dense.", "rule": "transfer."}
"""Of the definitions, below which key they are explained; others are whole files."""


def described(schema: Schema, kind: str) -> Schema:
    """A schema in which each key has its description, an example and its default.

    Args:
        schema: of the files of a kind.
        kind: ``method``, ``problem`` or ``sweep``.
    """
    keys = dict(keys_of(kind))
    if kind == "method":
        keys |= claimed_keys() | wanted_keys()
    if kind == "sweep":
        keys |= column_keys()
    found: Schema = _walked(schema, "", keys)
    return found


def claimed_keys() -> dict[str, Key]:
    """The keys below ``expect``: what each claim means."""
    from garkcli.properties.definitions import every_definition

    found = {}
    for claim in every_definition():
        path = f"expect.{claim.key}"
        example = f"{claim.key}: {_EXAMPLES.get(claim.key, 'true')}"
        values = claim.values.replace("`", "")
        text = f"{claim.text} It is claimed as {values}."
        found[path] = Key(path, text, example, None, "docs/properties.md")
    return found


_COUNTS = (
    *("order", "conjugate-order", "pair-order", "bound", "pair-bound"),
    *("sharp-bound", "pair-sharp-bound", "nonautonomous-order"),
    *("embedded-order", "embedded-nonautonomous-order", "dense-order"),
    *("stage-order", "implicit-stages"),
)
_REALS = ("gamma", "ssp-coefficient", "real-stability", "imaginary-stability")
_EXAMPLES = {
    **dict.fromkeys(_COUNTS, "4"),
    "B": "[4, 4]",
    "C": "[[2, 3], [3, 3]]",
    "D": "[[2, 1], [1, 1]]",
    "gamma": "1 - sqrt(2)/2",
    "ssp-coefficient": '">= 1"',
    "real-stability": "infinity",
    "imaginary-stability": "2*sqrt(2)",
}
"""How claims that are no truths are written."""


def column_keys() -> dict[str, Key]:
    """The keys below ``where`` that are claims of method files too."""
    found = {}
    for claim in claimed_keys().values():
        _, name = claim.path.split(".")
        _, example = claim.example.split(": ", 1)
        if example.isdigit() or name in _REALS:
            example = '">= 1"'
        path = f"where.{name}"
        text, _, _ = claim.text.partition(" It is claimed as ")
        found[path] = Key(path, text, f"{name}: {example}", None, claim.page)
    return found


def wanted_keys() -> dict[str, Key]:
    """The keys below ``design`` that are wants: what each asks for."""
    values = {"flag": "true", "count": "3", "number": "0"}
    found = {}
    for name in WANTS:
        want = find_want(name)
        path = f"design.{name}"
        text = f"Wanted of the methods that are looked for: {want.summary}."
        example = f"{name}: {values[want.kind]}"
        found[path] = Key(path, text, example, None, "docs/design.md")
    return found


def _walked(node: Any, path: str, keys: Mapping[str, Key]) -> Any:
    """A part of a schema anew: the keys in it stand below ``path``."""
    if isinstance(node, list):
        return [_walked(part, path, keys) for part in node]
    if not isinstance(node, dict):
        return node
    found = {}
    for word, part in node.items():
        if word == "properties":
            found[word] = _properties(part, path, keys)
        elif word == "definitions":
            found[word] = {name: _walked(x, _BELOW.get(name, ""), keys) for name, x in part.items()}
        elif word in _NO_KEYS:
            found[word] = part
        else:
            found[word] = _walked(part, path, keys)
    return found


def _properties(node: Schema, path: str, keys: Mapping[str, Key]) -> Schema:
    """The keys of a mapping; a family inside of a construction is explained below methods."""
    if "family" in node and not path:
        path = "methods."
    found = {}
    for name, part in node.items():
        inner = _walked(part, f"{path}{name}.", keys)
        key = keys.get(f"{path}{name}")
        found[name] = inner if key is None else _told(inner, key)
    return found


def _told(schema: Any, key: Key) -> Any:
    """What a key may have, with what it means."""
    if not isinstance(schema, dict):  # it is barred here
        return schema
    if "$ref" in schema:  # what stands beside a reference is not read
        schema = {"allOf": [{"$ref": schema["$ref"]}]}
    told = {**schema, "description": key.text, "examples": [_value(key)]}
    if key.default is not None:
        told["default"] = key.default
    return told


def _value(key: Key) -> object:
    """The value in the example of a key, as an editor offers it."""
    import yaml  # only who asks for a schema reads examples

    _, name = f".{key.path}".rsplit(".", 1)
    value = yaml.safe_load(key.example)[name]
    as_json: object = json.loads(json.dumps(value))  # keys are texts in JSON
    return as_json
