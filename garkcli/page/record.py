"""JSON objects declared field by field: a document and its JSON Schema from one place."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Generic, TypeVar

from garkcli.frozen import Frozen
from garkcli.page.json_text import to_json
from garkcli.page.schema import Schema, array

Whole = TypeVar("Whole")
Owner = TypeVar("Owner")


class Field(Frozen, Generic[Whole]):
    """A field of a JSON object; a ``value`` None is left out if optional, null otherwise."""

    name: str
    schema: Schema
    value: Callable[[Whole], object]
    is_optional: bool = False


def schema_named(name: str) -> Field[Any]:
    return Field("schema", {"const": name}, lambda _: name)


class Record(Generic[Whole]):
    """A JSON object that describes a ``Whole``: its fields in order.

    >>> real: Record[complex] = Record(Field("re", {"type": "number"}, lambda z: z.real))
    >>> real.data(2 + 1j), real.schema["required"]
    ({'re': 2.0}, ['re'])
    """

    def __init__(self, *fields: Field[Whole], is_open: bool = False) -> None:
        self.fields = fields
        self.is_open = is_open

    def data(self, whole: Whole) -> dict[str, Any]:
        found = {}
        for field in self.fields:
            value = field.value(whole)
            if value is not None or not field.is_optional:
                found[field.name] = value
        return found

    def text(self, whole: Whole) -> str:
        return f"{to_json(self.data(whole))}\n"

    @property
    def schema(self) -> Schema:
        schema: Schema = {
            "type": "object",
            "required": [field.name for field in self.fields if not field.is_optional],
            "properties": {field.name: field.schema for field in self.fields},
        }
        if not self.is_open:
            schema["additionalProperties"] = False
        return schema

    def every(self, name: str, parts: Callable[[Owner], Iterable[Whole]]) -> Field[Owner]:
        return Field(name, array(self.schema), lambda owner: [self.data(x) for x in parts(owner)])
