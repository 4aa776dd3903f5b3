"""Where a method was published, and what else it is called: ``reference`` and ``aliases``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import fields

from yaml.nodes import MappingNode, Node, SequenceNode

from garkcli.errors import MAX_WORD
from garkcli.methodfile.source import Source
from garkcli.methodfile.words import one_line, shortened
from garkcli.reference import WORKS, Reference

_PEOPLE = ("authors", "editors")
_BETWEEN_PEOPLE = re.compile(r",\s+and\s+|,\s*|\s+and\s+|\s*&\s*")
_YEAR = re.compile(r"[0-9]{4}[a-z]?", re.ASCII)
_FORM = "write reference: {authors: ..., title: ..., year: ...}, or one text"


KEYS = tuple(field.name for field in fields(Reference))
"""The keys of a reference that is a mapping."""


def read_reference(source: Source, node: Node | None) -> tuple[str, Reference | None]:
    """A reference as text in one line, and its fields where it has them.

    Args:
        source: where faults are noted.
        node: what stands under ``reference``; None for nothing.
    """
    if node is None:
        return "", None
    if not isinstance(node, MappingNode):
        return source.scalar(node, "reference") or "", None
    entries = source.mapping(node, "reference", KEYS, form=_FORM)
    if "title" not in entries:
        source.fault(node, "reference: title missing", _FORM)
    found: dict[str, str] = {}
    people: dict[str, tuple[str, ...]] = {}
    for key, value in entries.items():
        if key in _PEOPLE:
            people[key] = _people(source, value, key)
        else:
            found[key] = _field(source, value, key)
    authors, editors = (people.get(key, ()) for key in _PEOPLE)
    reference = Reference(authors=authors, editors=editors, **found)
    return str(reference), reference


def _people(source: Source, node: Node, key: str) -> tuple[str, ...]:
    """Names in a list, or in one text with commas or ``and`` between them."""
    where = f"reference, {key}"
    if isinstance(node, SequenceNode):
        texts = [source.scalar(item, where) for item in node.value]
        return tuple(one_line(text) for text in texts if text)
    text = source.scalar(node, where) or ""
    names = _BETWEEN_PEOPLE.split(one_line(text))
    return tuple(name for name in names if name)


def _field(source: Source, node: Node, key: str) -> str:
    """The text of one field."""
    where = f"reference, {key}"
    if key == "type":
        return source.choice(node, where, WORKS) or ""
    text = one_line(source.scalar(node, where) or "")
    if key == "year" and not _YEAR.fullmatch(text):
        message = f"{where}: a year is expected, not {shortened(text)}"
        source.fault(node, message, "for instance 1980")
    return text


def read_aliases(source: Source, node: Node | None) -> tuple[str, ...]:
    """Other names of a method: a list of texts, or one text."""
    if node is None:
        return ()
    is_list = isinstance(node, SequenceNode)
    items: Sequence[Node] = node.value if is_list else [node]
    aliases: list[str] = []
    for item in items:
        text = source.scalar(item, "aliases")
        if text is None:
            continue
        alias = one_line(text)
        fault = _what_is_wrong(alias, aliases)
        if fault:
            source.fault(item, *fault)
        else:
            aliases.append(alias)
    return tuple(aliases)


def _what_is_wrong(alias: str, before: Sequence[str]) -> tuple[str, str] | None:
    """Why a text is no alias, and the cure; None where it is one."""
    shown = shortened(alias)
    if not alias:
        return "aliases: an empty name", "leave it out"
    if len(alias) > MAX_WORD:
        message = f"aliases: {shown} has more than {MAX_WORD} characters"
        return message, "shorten it"
    if "/" in alias or "\\" in alias:
        message = f"aliases: {shown} has a separator of paths in it"
        return message, "a name with one would mean a file: write a hyphen"
    if alias in before:
        return f"aliases: {shown} stands here twice", "keep one of them"
    return None


def aliases_of(text: str, name: str) -> tuple[str, ...]:
    """The aliases that the text of a method file gives, of which nothing else is read.

    Args:
        text: of the file.
        name: what to call it.

    Raises:
        MethodFileError: it is no YAML, or far from a method file.

    >>> aliases_of("aliases: [DOPRI5, RK45]", "a file")
    ('DOPRI5', 'RK45')
    """
    source = Source(name, text)
    return read_aliases(source, _value_of(source, "aliases"))


def reference_of(text: str, name: str) -> tuple[str, Reference | None]:
    """The reference that the text of a method file gives, in one line and its fields; nothing else
    is read.

    Args:
        text: of the file.
        name: what to call it.

    Raises:
        MethodFileError: it is no YAML, or the reference has a fault.

    >>> reference_of("reference: Runge 1895", "a file")
    ('Runge 1895', None)
    """
    source = Source(name, text)
    found = read_reference(source, _value_of(source, "reference"))
    source.close()
    return found


def _value_of(source: Source, key: str) -> Node | None:
    """What stands under a key of the file; None where there is none."""
    root = source.compose()
    if root is None:
        raise source.error()
    for key_node, value in root.value:
        if key_node.value == key:
            found: Node = value
            return found
    return None
