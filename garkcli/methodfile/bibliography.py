"""The reference and the aliases of a method."""

from __future__ import annotations

import re
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

from garkcli.errors import MAX_WORD
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.keys import TEXT, Key, ReadMapping, Schema, ValueKind, mapping, word
from garkcli.grammar.nodes import MappingNode, Node, SequenceNode, one_line, shortened
from garkcli.grammar.source import Source
from garkcli.reference import WORKS, Reference

_BETWEEN_PEOPLE = r",\s+and\s+|,\s*|\s+and\s+|\s*&\s*"
_YEAR = r"[0-9]{4}[a-z]?"
_FORM = "write reference: {authors: ..., title: ..., year: ...}, or one text"


def _text(at: Any, node: Node, where: str) -> str:
    return one_line(at.source.scalar(node, where) or "")


def _year(at: Any, node: Node, where: str) -> str:
    text = _text(at, node, where)
    if not re.fullmatch(_YEAR, text, re.ASCII):
        message = f"{where}: a year is expected, not {shortened(text)}"
        at.source.fault(node, message, "for instance 1980", code="wrong-value")
    return text


def _people(at: Any, node: Node, where: str) -> tuple[str, ...]:
    """Names from a list, or from a text with commas or ``and`` between them."""
    if isinstance(node, SequenceNode):
        names = [_text(at, item, where) for item in node.value]
    else:
        names = re.split(_BETWEEN_PEOPLE, _text(at, node, where))
    return tuple(name for name in names if name)


_ONE = ValueKind(TEXT.schema, _text)
_NAMES = ValueKind(
    lambda: {"anyOf": [TEXT.schema(), {"type": "array", "items": TEXT.schema()}]}, _people
)
_REFERENCE = mapping(
    Key(
        "authors: [J. R. Dormand, P. J. Prince]",
        _NAMES,
        "The authors: one text, or a list with one name each.",
    ),
    Key(
        "title: A family of embedded Runge-Kutta formulae",
        _ONE,
        "The title of the publication; the one field that every reference needs.",
        is_needed=True,
    ),
    Key(
        "year: 1980",
        ValueKind(lambda: {"type": ["integer", "string"], "pattern": "^[0-9]{4}[a-z]?$"}, _year),
        "The year of publication, perhaps with a letter after it.",
    ),
    Key(
        "type: thesis",
        word(lambda: WORKS),
        "The kind of work, if the other fields do not determine it.",
    ),
    Key("journal: J. Comput. Appl. Math.", _ONE, "The journal of an article."),
    Key("volume: 6", _ONE, "The volume of the journal or of the book."),
    Key("number: 1", _ONE, "The issue of the journal."),
    Key("pages: 19-26", _ONE, "The first and the last page."),
    Key(
        "book: Numerical Analysis 1995",
        _ONE,
        "The title of the book or the proceedings of a chapter.",
    ),
    Key(
        "editors: [D. F. Griffiths, G. A. Watson]",
        _NAMES,
        "The editors of the book: one text, or a list with one name each.",
    ),
    Key("edition: second", _ONE, "The edition of the book."),
    Key("publisher: Springer", _ONE, "The publisher of the book."),
    Key(
        "institution: University of Auckland",
        _ONE,
        "The university of a thesis, or the institution of a report.",
    ),
    Key("where: table 2", _ONE, "The place of the method in the work."),
    Key(
        "doi: 10.1016/0771-050X(80)90013-3",
        _ONE,
        "The digital object identifier of the publication.",
    ),
    Key(
        "url: https://example.org/method",
        _ONE,
        "An address where the publication or the code is found.",
    ),
    Key("note: in Russian", _ONE, "Further information about the reference."),
    Key(
        "coefficients: as printed",
        _ONE,
        "Where the digits of the file come from, such as printed or computed anew.",
    ),
    form=_FORM,
)


def _reference(at: Any, node: Node, where: str) -> tuple[str, Reference | None]:
    if not isinstance(node, MappingNode):
        return at.source.scalar(node, where) or "", None
    fields: ReadMapping = _REFERENCE.read(at, node, where)
    reference = Reference(**fields)
    return str(reference), reference


REFERENCE = ValueKind(
    lambda: {"anyOf": [TEXT.schema(), _REFERENCE.schema()]}, _reference, _REFERENCE.inside
)


def _aliases(at: Any, node: Node, where: str) -> tuple[str, ...]:
    source: Source = at.source
    aliases: list[str] = []
    for item in node.value if isinstance(node, SequenceNode) else [node]:
        text = source.scalar(item, where)
        if text is None:
            continue
        alias = one_line(text)
        fault = _what_is_wrong(alias, aliases)
        if fault is None:
            aliases.append(alias)
        else:
            message, cure, code = fault
            source.fault(item, message, cure, code=code)
    return tuple(aliases)


_ALIAS: Schema = {
    "type": ["string", "number"],
    "pattern": r"^[^/\\]*$",
    "minLength": 1,
    "maxLength": MAX_WORD,
}
ALIASES = ValueKind(
    lambda: {"anyOf": [{"type": "array", "items": _ALIAS, "uniqueItems": True}, _ALIAS]}, _aliases
)


def _what_is_wrong(alias: str, before: Sequence[str]) -> tuple[str, str, str] | None:
    shown = shortened(alias)
    if not alias:
        return "aliases: an empty name", "leave it out", "name-taken"
    if len(alias) > MAX_WORD:
        message = f"aliases: {shown} has more than {MAX_WORD} characters"
        return message, "shorten it", "name-taken"
    if "/" in alias or "\\" in alias:
        message = f"aliases: {shown} has a separator of paths in it"
        return message, "a name with one would mean a file: write a hyphen", "name-taken"
    if alias in before:
        return f"aliases: {shown} appears twice", "keep one of them", "doubled"
    return None


def aliases_of(text: str, name: str) -> tuple[str, ...]:
    """The aliases in a text, without reading the rest; MethodFileError if it is far from a method
    file.

    >>> aliases_of("aliases: [DOPRI5, RK45]", "a file")
    ('DOPRI5', 'RK45')
    """
    aliases: tuple[str, ...] | None = _value_of(Source(name, text, METHOD_FILE), "aliases", ALIASES)
    return aliases or ()


def reference_of(text: str, name: str) -> tuple[str, Reference | None]:
    """The reference in a text, without reading the rest; MethodFileError if it has a fault.

    >>> reference_of("reference: Runge 1895", "a file")
    ('Runge 1895', None)
    """
    source = Source(name, text, METHOD_FILE)
    reference: tuple[str, Reference | None] | None = _value_of(source, "reference", REFERENCE)
    source.close()
    return reference or ("", None)


def _value_of(source: Source, name: str, kind: ValueKind) -> Any:
    root = source.compose()
    if root is None:
        raise source.error()
    for key, value in root.value:
        if key.value == name:
            return kind.read(SimpleNamespace(source=source), value, name)
    return None
