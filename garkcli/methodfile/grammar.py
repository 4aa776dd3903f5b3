"""The grammar of the files that people write: each key is declared once, with what may stand there.

A declaration reads the key, makes its JSON Schema, and is what pages, ``gark explain`` and editors
say of it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeAlias

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile.source import Entries, Source

if TYPE_CHECKING:
    from garkcli.glossary.key import Key as Entry

Schema: TypeAlias = dict[str, Any]
Read: TypeAlias = Callable[[Any, Node, str], Any]
"""From what reads the file, which has its ``source``, from a node, and from what messages call it,
to the value; None, with a fault noted, where it is none.
"""
FILE = "the file"
"""What messages call the mapping that is the whole file."""
NOTHING: Mapping[str, Any] = {}


def as_it_is(_: Any, node: Node, __: str) -> Node:
    """The node itself, for keys that are read where more is known."""
    return node


@dataclass(frozen=True)
class Kind:
    """What may stand under a key.

    Attributes:
        schema: its JSON Schema.
        read: its value.
        inside: the keys inside of it.
    """

    schema: Callable[[], Schema]
    read: Read = as_it_is
    inside: Callable[[], Iterable[Key]] = tuple


@dataclass(frozen=True)
class Key:
    """A key of a mapping.

    Attributes:
        line: an example, a line of a file with it: its name, a colon, a value.
        kind: what may stand there.
        text: what it is, in whole sentences.
        default: what holds where it is left out; None where nothing does.
        is_needed: whether it cannot be left out.
        page: where more is said; empty for the page about such files.
        is_word: whether it is found by its own name too.
        is_listed: whether the page lists it.
    """

    line: str
    kind: Kind
    text: str
    default: object = None
    is_needed: bool = False
    page: str = ""
    is_word: bool = True
    is_listed: bool = True

    @property
    def name(self) -> str:
        """The key itself."""
        return self.line.partition(":")[0]

    def schema(self) -> Schema:
        """What it may have, and what it means."""
        import yaml  # only who asks for a schema reads examples

        schema = self.kind.schema()
        if "$ref" in schema:  # what stands beside a reference is not read
            schema = {"allOf": [schema]}
        value = yaml.safe_load(self.line)[self.name]
        as_json = json.loads(json.dumps(value))  # keys are texts in JSON
        told = {**schema, "description": self.text, "examples": [as_json]}
        return told if self.default is None else {**told, "default": self.default}

    def entries(self, above: str, page: str) -> Iterator[Entry]:
        """What is told of it and of the keys inside of it, as those of a page."""
        from garkcli.glossary.key import Key as Entry  # only pages and explanations tell of keys

        path, own = above + self.name, self.page or page
        if self.is_listed:
            yield Entry(path, self.text, self.line, self.default, own, self.is_word)
        for key in self.kind.inside():
            yield from key.entries(f"{path}.", page)


class Found(dict[str, Any]):
    """What a mapping has: its values by key, without the faulty ones.

    Attributes:
        node: where it stands.
        nodes: what stands under each key that is given.
        is_right: whether no fault was noted in it.
    """

    def __init__(self, node: Node, nodes: Entries) -> None:
        self.node = node
        self.nodes = nodes
        self.is_right = True

    def way(self, source: Source, where: str, what: str, ways: Iterable[str]) -> str | None:
        """The one of several keys that is given; None, with a fault noted for two of them."""
        given = [key for key in ways if key in self.nodes]
        for key in given[1:2]:
            message = f"{where}: {what} given by {given[0]} already"
            source.fault(
                self.nodes[key], message, f"keep one of {', '.join(given)}", code="given-twice"
            )
        return given[0] if len(given) == 1 else None


def mapping(
    *keys: Key,
    more: Callable[[], Iterable[Key]] = tuple,
    form: str = "",
    cures: Mapping[str, str] = NOTHING,
    rules: Mapping[str, Any] = NOTHING,
) -> Kind:
    """Keys with their values, and no others.

    Args:
        keys: those there are.
        more: those that only a file with them, or a schema, has to know.
        form: the cure where there is no such mapping, or a key is missing.
        cures: what to do about keys that are expected elsewhere.
        rules: of the schema: which keys go together.
    """

    @cache
    def every() -> dict[str, Key]:
        return {key.name: key for key in (*keys, *more())}

    def schema() -> Schema:
        needed = [key.name for key in every().values() if key.is_needed]
        inside = {name: key.schema() for name, key in every().items()}
        return {**closed(inside, *needed), **rules}

    def read(at: Any, node: Node, where: str) -> Found | None:
        source: Source = at.source
        before = len(source.faults)
        found = Found(node, source.mapping(node, where, every(), cures, form))
        if not isinstance(node, MappingNode):
            return None
        for name, value in found.nodes.items():
            place = name if where == FILE else f"{where}, {name}"
            one = every()[name].kind.read(at, value, place)
            if one is not None:
                found[name] = one
        missing = [x.name for x in every().values() if x.is_needed and x.name not in found.nodes]
        if missing:
            place = "" if where == FILE else f"{where}: "
            source.fault(node, f"{place}{' and '.join(missing)} missing", form, code="missing-key")
        found.is_right = len(source.faults) == before
        return found

    return Kind(schema, read, lambda: every().values())


def closed(properties: Schema, *needed: str) -> Schema:
    """The schema of a mapping with these keys and no others."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(needed),
        "additionalProperties": False,
    }


def by_name(kind: Kind, **rules: Any) -> Kind:
    """Values of one kind by names that the file chooses; read where more is known."""
    schema = {"type": "object", **rules}
    return Kind(lambda: {**schema, "additionalProperties": kind.schema()}, inside=kind.inside)


def count(least: int = 0, most: int | None = None) -> Kind:
    """A whole number."""
    schema: Schema = {"type": "integer", "minimum": least}
    if most is not None:
        schema["maximum"] = most
    return Kind(lambda: schema, lambda at, node, where: at.source.whole(node, where, least, most))


def word(words: Callable[[], Iterable[str]]) -> Kind:
    """One of a few words; with a mapping from words to texts the schema has these."""

    def schema() -> Schema:
        known = words()
        if isinstance(known, Mapping):
            return {"oneOf": [{"const": x, "description": text} for x, text in known.items()]}
        return {"enum": list(known)}

    return Kind(schema, lambda at, node, where: at.source.choice(node, where, words()))


def _flag(at: Any, node: Node, where: str) -> bool | None:
    found = at.source.choice(node, where, ("true", "false"))
    return None if found is None else found == "true"


FLAG = Kind(lambda: {"type": "boolean"}, _flag)
"""True or false."""
TEXT = Kind(
    lambda: {"type": ["string", "number", "boolean", "null"]},
    lambda at, node, where: at.source.scalar(node, where),
)
"""A name or a text, as YAML may read it."""
VERSION = Kind(lambda: {"enum": [1, "1"]}, lambda at, node, _: at.source.check_version(node))
"""The version of the format."""


def list_of(
    item: Kind,
    noun: str,
    most: int | None = None,
    each: str = "",
    form: str = "",
    rules: Mapping[str, Any] = NOTHING,
) -> Kind:
    """A list that is not empty.

    Args:
        item: what stands in it.
        noun: what messages call several of them.
        most: how many there may be.
        each: what messages call one of them, with ``{}`` for its number.
        form: the cure where there is no list.
        rules: of the schema.
    """
    schema = {"minItems": 1, **({} if most is None else {"maxItems": most}), **rules}

    def read(at: Any, node: Node, where: str) -> list[Any] | None:
        items: list[Node] = at.source.items(node, where, form)
        if most is not None and len(items) > most:
            at.source.fault(
                node, f"{len(items)} {noun} (limit {most})", "use fewer", code="too-many"
            )
            return None
        if not items and isinstance(node, SequenceNode):
            at.source.fault(node, f"{where} is empty", form, code="empty")
            return None
        places = [each.format(i) or where for i in range(1, len(items) + 1)]
        values = [item.read(at, x, place) for x, place in zip(items, places, strict=True)]
        return [x for x in values if x is not None]

    return Kind(lambda: {"type": "array", "items": item.schema(), **schema}, read, item.inside)


def either(single: Kind, at_list: Kind | None = None, at_mapping: Kind | None = None) -> Kind:
    """What is of one kind where it is a single value, and of another as a list or as a mapping."""
    every = [x for x in (single, at_list, at_mapping) if x is not None]

    def read(at: Any, node: Node, where: str) -> Any:
        kind = single
        if isinstance(node, SequenceNode) and at_list is not None:
            kind = at_list
        elif not isinstance(node, ScalarNode) and at_mapping is not None:
            kind = at_mapping
        return kind.read(at, node, where)

    return Kind(
        lambda: {"anyOf": [x.schema() for x in every]},
        read,
        lambda: [key for kind in every for key in kind.inside()],
    )


def one_or_more(
    item: Kind,
    noun: str = "",
    most: int | None = None,
    is_plain: bool = False,
    rules: Mapping[str, Any] = NOTHING,
) -> Kind:
    """One value, or a list; read as a list.

    Args:
        item: what one is.
        noun: what messages call several of them.
        most: how many there may be.
        is_plain: whether one is a single value, no mapping.
        rules: of the schema of the list.
    """
    several = list_of(item, noun, most, form="name one", rules=rules)

    def read(at: Any, node: Node, where: str) -> list[Any] | None:
        if isinstance(node, SequenceNode) or (is_plain and isinstance(node, MappingNode)):
            found: list[Any] | None = several.read(at, node, where)
            return found
        one = item.read(at, node, where)
        return None if one is None else [one]

    return Kind(lambda: {"anyOf": [item.schema(), several.schema()]}, read, item.inside)


def defined(name: str, read: Read = as_it_is) -> Kind:
    """What the definitions of a schema have under a name."""
    return Kind(lambda: {"$ref": f"#/definitions/{name}"}, read)


def later(room: str, name: str) -> Kind:
    """What is declared in a room that is loaded when a file or a schema has it."""

    def kind() -> Kind:
        found: Kind = getattr(import_module(f"garkcli.methodfile.{room}"), name)
        return found

    return Kind(
        lambda: kind().schema(),
        lambda at, node, where: kind().read(at, node, where),
        lambda: kind().inside(),
    )


def told(keys: Iterable[Key], page: str) -> Iterator[Entry]:
    """What is told of keys at the top of a file, and of those inside of them."""
    for key in keys:
        yield from key.entries("", page)
