"""The keys of files: each is declared once, for readers, schemas, pages and editors."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib import import_module
from typing import Any, TypeAlias

from msgspec import json
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.frozen import Frozen
from garkcli.glossary.key import KeyMeaning
from garkcli.grammar.source import Cures, Entries, Home, Source

Schema: TypeAlias = dict[str, Any]
Read: TypeAlias = Callable[[Any, Node, str], Any]
"""Makes a value of the reader of the file, a node and its name in messages; None after a fault."""
FILE = "the file"
NOTHING: Mapping[str, Any] = {}


def as_it_is(_: Any, node: Node, __: str) -> Node:
    return node


class ValueKind(Frozen):
    schema: Callable[[], Schema]
    read: Read = as_it_is
    inside: Callable[[], Iterable[Key]] = tuple

    def then(self, make: Callable[[Any, ReadMapping, str], Any]) -> ValueKind:
        """A value made from the values of the keys."""

        def read(at: Any, node: Node, where: str) -> Any:
            values: ReadMapping | None = self.read(at, node, where)
            return make(at, values, where) if values is not None and values.is_right else None

        return ValueKind(self.schema, read, self.inside)


class Key(Frozen):
    """``line`` is an example; ``page`` is empty for the page about such files; ``gark explain``
    knows the name if ``is_word``; ``also`` are other spellings.
    """

    line: str
    kind: ValueKind
    text: str
    default: object = None
    is_needed: bool = False
    page: str = ""
    is_word: bool = True
    is_listed: bool = True
    also: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        return self.line.partition(":")[0]

    def schema(self) -> Schema:
        import yaml  # only who asks for a schema reads examples

        schema = self.kind.schema()
        if "$ref" in schema:  # what is beside a reference is not read
            schema = {"allOf": [schema]}
        value = yaml.safe_load(self.line)[self.name]
        as_json = json.decode(json.encode(value))  # keys are texts in JSON
        told = {**schema, "description": self.text, "examples": [as_json]}
        return told if self.default is None else {**told, "default": self.default}

    def entries(self, above: str, page: str) -> Iterator[KeyMeaning]:
        """The entries of the glossary for the key and the keys within it."""
        path, own = above + self.name, self.page or page
        if self.is_listed:
            yield KeyMeaning(path, self.text, self.line, self.default, own, self.is_word)
        inside = own.partition("#")[0]
        for key in self.kind.inside():
            yield from key.entries(f"{path}.", inside)


class ReadMapping(dict[str, Any]):
    """Values without faulty ones; ``nodes`` has the nodes of all given keys."""

    def __init__(self, node: Node, nodes: Entries) -> None:
        self.node = node
        self.nodes = nodes
        self.is_right = True


def required(*keys: str) -> Schema:
    return {"required": list(keys)}


def _any_given(keys: Sequence[str]) -> Schema:
    each = [required(key) for key in keys]
    return each[0] if len(each) == 1 else {"anyOf": each}


class Together(Frozen):
    needed: tuple[str, ...]
    perhaps: tuple[str, ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        return self.needed + self.perhaps

    def refuse(self, source: Source, where: str, entries: Entries) -> None:
        missing = [key for key in self.needed if key not in entries]
        there = [key for key in self.keys if key in entries]
        if missing and there:
            message = f"{' and '.join(missing)} missing beside {', '.join(there)}"
            cure = f"write {' and '.join(self.needed)}"
            if self.perhaps:
                cure += f"; {' and '.join(self.perhaps)} can be left out"
            source.fault(entries[there[0]], placed(where, message), cure, code="missing-key")


class Ways(Frozen):
    """``what`` has a verb: ``the substeps are``; without ``none`` no alternative is required."""

    what: str
    ways: tuple[str | Together, ...]
    none: str = ""
    cure: str = ""
    is_one: bool = True

    def given(self, entries: Entries) -> list[str]:
        """The first key of each alternative that a mapping has."""
        present = []
        for way in self.ways:
            keys = (way,) if isinstance(way, str) else way.keys
            present += [key for key in keys if key in entries][:1]
        return present

    def schema(self) -> Schema:
        each = [required(x) if isinstance(x, str) else _any_given(x.keys) for x in self.ways]
        if not self.is_one:
            return {"anyOf": each}
        choice = {"oneOf": each if self.none else [*each, {"not": {"anyOf": each}}]}
        several = [way for way in self.ways if isinstance(way, Together)]
        whole = [{"if": _any_given(x.keys), "then": required(*x.needed)} for x in several]
        return {"allOf": [choice, *whole]}

    def refuse(self, source: Source, node: Node, where: str, entries: Entries, _: str = "") -> None:
        given = self.given(entries)
        cure = f"keep one of {', '.join(given)}"
        for key in given[1:] if self.is_one else ():
            message = f"{key if where == FILE else where}: {self.what} given by {given[0]} already"
            source.fault(entries[key], message, cure, code="given-twice")
        if self.none and not given:
            source.fault(node, placed(where, self.none), self.cure, code="missing-key")
        for way in self.ways:
            if not given[1:] and isinstance(way, Together):
                way.refuse(source, where, entries)


class KeyValues(Frozen):
    schema: Schema
    has: Callable[[Node], bool]


class KeyRelation(Frozen):
    """With the key one of ``needs`` is required and all of ``bars`` are excluded.

    It is about ``values`` of the key, None for all. The message has ``{way}`` for the alternative
    in use, by which cures may differ, with ``""`` for others.
    """

    key: str
    message: str
    cure: str | Mapping[str, str] = "leave it out"
    needs: tuple[str, ...] = ()
    bars: tuple[str, ...] = ()
    code: str = "not-together"
    values: KeyValues | None = None

    def schema(self) -> Schema:
        about = required(self.key)
        if self.values is not None:
            about["properties"] = {self.key: self.values.schema}
        then = _any_given(self.needs) if self.needs else {"not": _any_given(self.bars)}
        return {"if": about, "then": then}

    def refuse(self, source: Source, _: Node, where: str, entries: Entries, way: str = "") -> None:
        node = entries.get(self.key)
        if node is None or (self.values is not None and not self.values.has(node)):
            return
        if self.needs and not entries.keys().isdisjoint(self.needs):
            return
        if self.needs or not entries.keys().isdisjoint(self.bars):
            cure = self.cure
            if not isinstance(cure, str):
                cure = cure.get(way, cure[""])
            message, cure = (x.replace("{way}", way) for x in (self.message, cure))
            source.fault(node, placed(where, message), cure, code=self.code)


class OfSchema(Frozen):
    """The reader checks such a rule elsewhere."""

    rule: Schema

    def schema(self) -> Schema:
        return self.rule

    def refuse(self, *_: object) -> None: ...


Rule: TypeAlias = Ways | KeyRelation | OfSchema
"""Keys that require or exclude each other."""


def placed(where: str, message: str) -> str:
    return message if where == FILE else f"{where}: {message}"


def homes(keys: Iterable[Key]) -> dict[str, Home]:
    """The first places of keys within others, without names that keys at the top have."""
    places: dict[str, Home] = {}
    known = list(keys)
    taken = {word.lower() for key in known for word in (key.name, *key.also)}
    for key in known:
        for inner in key.kind.inside():
            if inner.name.lower() not in taken:
                places.setdefault(inner.name, Home(key.name, inner.line))
    return places


def entries_in(
    source: Source,
    node: Node,
    where: str,
    keys: Mapping[str, Key],
    cures: Cures = dict,
    form: str = "",
) -> Entries:
    """``cures`` are for keys that belong elsewhere, ``form`` is for other values than mappings."""
    words = {word: name for name, key in keys.items() for word in key.also}
    return source.mapping(node, where, keys, cures, form, words)


def mapping(
    *keys: Key,
    more: Callable[[], Iterable[Key]] = tuple,
    form: str = "",
    cures: Cures = dict,
    rules: Iterable[Rule] = (),
) -> ValueKind:
    """``more`` keys are for schemas and files with them; ``cures`` for keys of other places."""

    @cache
    def every() -> dict[str, Key]:
        return {key.name: key for key in (*keys, *more())}

    def schema() -> Schema:
        needed = [key.name for key in every().values() if key.is_needed]
        inside = {name: key.schema() for name, key in every().items()}
        together = {"allOf": [rule.schema() for rule in rules]} if rules else {}
        return {**closed(inside, *needed), **together}

    def read(at: Any, node: Node, where: str) -> ReadMapping | None:
        source: Source = at.source
        before = len(source.faults)
        values = ReadMapping(node, entries_in(source, node, where, every(), cures, form))
        if not isinstance(node, MappingNode):
            return None
        for name, value in values.nodes.items():
            place = name if where == FILE else f"{where}, {name}"
            one = every()[name].kind.read(at, value, place)
            if one is not None:
                values[name] = one
        missing = [x.name for x in every().values() if x.is_needed and x.name not in values.nodes]
        if missing:
            message = placed(where, f"{' and '.join(missing)} missing")
            source.fault(node, message, form, code="missing-key")
        way = ""
        for rule in rules:
            rule.refuse(source, node, where, values.nodes, way)
            if isinstance(rule, Ways):
                way = next(iter(rule.given(values.nodes)), "")
        values.is_right = len(source.faults) == before
        return values

    return ValueKind(schema, read, lambda: every().values())


def closed(properties: Schema, *needed: str) -> Schema:
    return {
        "type": "object",
        "properties": properties,
        "required": list(needed),
        "additionalProperties": False,
    }


def by_name(kind: ValueKind, **rules: Any) -> ValueKind:
    """Names from the file; values are read later."""
    schema = {"type": "object", **rules}
    return ValueKind(lambda: {**schema, "additionalProperties": kind.schema()}, inside=kind.inside)


def count(least: int = 0, most: int | None = None) -> ValueKind:
    schema: Schema = {"type": "integer", "minimum": least}
    if most is not None:
        schema["maximum"] = most
    return ValueKind(
        lambda: schema, lambda at, node, where: at.source.whole(node, where, least, most)
    )


def word(words: Callable[[], Iterable[str]]) -> ValueKind:
    def schema() -> Schema:
        known = words()
        if isinstance(known, Mapping):
            return {"oneOf": [{"const": x, "description": text} for x, text in known.items()]}
        return {"enum": list(known)}

    return ValueKind(schema, lambda at, node, where: at.source.choice(node, where, words()))


YES_AND_NO = {"yes": True, "no": False, "true": True, "false": False}
"""Spellings of truth values besides ``true`` and ``false``."""


def _flag(at: Any, node: Node, where: str) -> bool | None:
    if isinstance(node, ScalarNode) and node.value.lower() in YES_AND_NO:
        return YES_AND_NO[node.value.lower()]
    choice = at.source.choice(node, where, ("true", "false"))
    return None if choice is None else choice == "true"


FLAG = ValueKind(lambda: {"type": "boolean"}, _flag)
TEXT = ValueKind(
    lambda: {"type": ["string", "number", "boolean", "null"]},
    lambda at, node, where: at.source.scalar(node, where),
)
VERSION = ValueKind(lambda: {"enum": [1, "1"]}, lambda at, node, _: at.source.check_version(node))


def list_of(
    item: ValueKind,
    noun: str,
    most: int | None = None,
    each: str = "",
    form: str = "",
    rules: Mapping[str, Any] = NOTHING,
) -> ValueKind:
    """Messages have ``noun`` for items, ``each`` with ``{}`` for one; ``form`` is a cure."""
    schema = {"minItems": 1, **({} if most is None else {"maxItems": most}), **rules}

    def read(at: Any, node: Node, where: str) -> list[Any] | None:
        items: list[Node] = at.source.items(node, where, form)
        if most is not None and len(items) > most:
            message = f"{len(items)} {noun} (limit {most})"
            at.source.fault(node, message, "use fewer", code="too-many")
            return None
        if not items and isinstance(node, SequenceNode):
            at.source.fault(node, f"{where} is empty", form, code="empty")
            return None
        places = [each.format(i) or where for i in range(1, len(items) + 1)]
        values = [item.read(at, x, place) for x, place in zip(items, places, strict=True)]
        return [x for x in values if x is not None]

    return ValueKind(lambda: {"type": "array", "items": item.schema(), **schema}, read, item.inside)


def either(
    single: ValueKind, at_list: ValueKind | None = None, at_mapping: ValueKind | None = None
) -> ValueKind:
    """The value may be a scalar, a list or a mapping."""
    every = [x for x in (single, at_list, at_mapping) if x is not None]

    def read(at: Any, node: Node, where: str) -> Any:
        kind = single
        if isinstance(node, SequenceNode) and at_list is not None:
            kind = at_list
        elif not isinstance(node, ScalarNode) and at_mapping is not None:
            kind = at_mapping
        return kind.read(at, node, where)

    return ValueKind(
        lambda: {"anyOf": [x.schema() for x in every]},
        read,
        lambda: [key for kind in every for key in kind.inside()],
    )


def one_or_more(
    item: ValueKind,
    noun: str = "",
    most: int | None = None,
    is_plain: bool = False,
    rules: Mapping[str, Any] = NOTHING,
) -> ValueKind:
    """One value or a list, read as a list; if ``is_plain`` one value is a scalar."""
    several = list_of(item, noun, most, form="name one", rules=rules)

    def read(at: Any, node: Node, where: str) -> list[Any] | None:
        if isinstance(node, SequenceNode) or (is_plain and isinstance(node, MappingNode)):
            values: list[Any] | None = several.read(at, node, where)
            return values
        one = item.read(at, node, where)
        return None if one is None else [one]

    return ValueKind(lambda: {"anyOf": [item.schema(), several.schema()]}, read, item.inside)


def defined(name: str, read: Read = as_it_is) -> ValueKind:
    return ValueKind(lambda: {"$ref": f"#/definitions/{name}"}, read)


def declared(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


def later(module: str, name: str) -> ValueKind:
    """Imports the module when the kind is needed."""

    def kind() -> ValueKind:
        declaration: ValueKind = declared(module, name)
        return declaration

    return ValueKind(
        lambda: kind().schema(),
        lambda at, node, where: kind().read(at, node, where),
        lambda: kind().inside(),
    )


def file_schema(title: str, text: str, kind: ValueKind, **more: Any) -> Schema:
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": title}
    return {**head, "description": text, **kind.schema(), **more}


def told(keys: Iterable[Key], page: str) -> Iterator[KeyMeaning]:
    for key in keys:
        yield from key.entries("", page)
