"""The JSON Schemas of reports with what each field holds."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from garkcli.glossary.fields import field_text
from garkcli.glossary.key import keys_of
from garkcli.page.schema import Schema

REFERENCES = (("publication",), ("reference",))
"""The fields whose parts are those of a reference in a method file."""


def told(schema: Schema, report: str) -> Schema:
    """The schema with a description of each field."""
    found: Schema = _walked(schema, (report,))
    return found


def _walked(node: Any, path: tuple[str, ...]) -> Any:
    if isinstance(node, list):
        return [_walked(part, path) for part in node]
    if not isinstance(node, dict):
        return node
    found = {}
    for word, part in node.items():
        if word == "properties":
            found[word] = {name: _field(value, (*path, name)) for name, value in part.items()}
        else:
            found[word] = _walked(part, path)
    return found


def _field(schema: Any, path: tuple[str, ...]) -> Any:
    """The schema of a field with its description; words on its numbers stay."""
    inner = _walked(schema, path)
    text = text_of(path)
    if not (text and isinstance(inner, dict)):
        return inner
    number = inner.get("description", "")
    return {**inner, "description": f"{text} {number}".rstrip()}


def text_of(path: tuple[str, ...]) -> str:
    """The description of a field: its own, or that of the claim, column or key it is."""
    name = path[-1]
    if path[-2:-1] in REFERENCES:
        return _elsewhere().get(name, "")
    return field_text(path) or _elsewhere().get(name, "")


@lru_cache(maxsize=1)
def _elsewhere() -> Mapping[str, str]:
    """Descriptions of claims, columns of sweeps and parts of references."""
    from garkcli.properties.definitions import every_definition

    found = {}
    for kind, above in (("method", "reference."), ("sweep", "where.")):
        for path, key in keys_of(kind).items():
            if path.startswith(above):
                name = path.removeprefix(above)
                found[name] = found[name.replace("-", "_")] = key.text
    for claim in every_definition():
        found[claim.key] = found[claim.key.replace("-", "_")] = claim.text
    return found
