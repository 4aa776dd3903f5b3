"""``gark explain``: what words mean, for people and for programs; docs/glossary.md."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from garkcli.check.meanings import Meaning, term_meaning
from garkcli.glossary.registry import TOPICS, terms_of
from garkcli.glossary.term import Term
from garkcli.page.paint import Paint, folded, indented
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, array, published

SCHEMA = "gark/explain/1"
_WIDTH = 80
_MARGIN = 12


class _Word(NamedTuple):
    """A word with its meanings."""

    word: str
    meanings: Sequence[Meaning]


_MEANING: Record[Meaning] = Record(
    Field("kind", TEXT, lambda x: x.kind),
    Field("name", TEXT, lambda x: x.name),
    Field("text", TEXT, lambda x: x.text),
    Field("formula", TEXT, lambda x: x.formula or None, is_optional=True),
    Field("values", TEXT, lambda x: x.values or None, is_optional=True),
    Field("for", TEXT, lambda x: x.scope or None, is_optional=True),
    Field("default", TEXT, lambda x: x.default or None, is_optional=True),
    Field("example", TEXT, lambda x: x.example or None, is_optional=True),
    Field("cure", TEXT, lambda x: x.cure or None, is_optional=True),
    Field("source", TEXT, lambda x: x.source),
    Field("see", array(TEXT), lambda x: list(x.see)),
)
_REPORT: Record[_Word] = Record(
    schema_named(SCHEMA),
    Field("word", TEXT, lambda x: x.word),
    _MEANING.every("meanings", lambda x: x.meanings),
)


def explain_report_schema() -> Schema:
    """The JSON Schema of ``gark explain --format json``."""
    return published("report of gark explain", _REPORT.schema)


def render(word: str, found: Sequence[Meaning], format: str, paint: Paint) -> str:
    """What a word means, as text or as JSON."""
    if format == "json":
        return _REPORT.text(_Word(word, found))
    blocks = [_block(meaning, paint) for meaning in found]
    return "\n".join(blocks)


def _block(meaning: Meaning, paint: Paint) -> str:
    lines = _lines(meaning, paint)
    return "\n".join(lines) + "\n"


def _lines(meaning: Meaning, paint: Paint) -> Iterator[str]:
    name = paint("strong", meaning.name)
    yield f"{name}: {meaning.kind}"
    yield from indented(folded(meaning.text, _WIDTH - 2, ""))
    if meaning.formula:
        yield ""
        yield from indented(folded(meaning.formula, _WIDTH - 4, ""), "    ")
        yield ""
    yield from _part("claim", meaning.values)
    yield from _part("for", meaning.scope)
    yield from _part("default", meaning.default)
    yield from _example(meaning.example)
    yield from _part("cure", meaning.cure)
    yield from _part("source", meaning.source)
    yield from _part("see", ", ".join(meaning.see))


def _example(text: str) -> Iterator[str]:
    """Lines of a file or a command, as they are written."""
    for number, line in enumerate(text.splitlines()):
        label = "  example" if number == 0 else ""
        yield label.ljust(_MARGIN) + line


def _part(label: str, text: str) -> list[str]:
    """A part beside its label; nothing where it is empty."""
    if not text:
        return []
    first, *rest = folded(text, _WIDTH - _MARGIN, "")
    head = f"  {label}".ljust(_MARGIN)
    return [head + first, *indented(rest, " " * _MARGIN)]


def render_list(format: str) -> str:
    """The terms by topic, as text or as JSON."""
    if format == "json":
        terms = chain.from_iterable(map(terms_of, TOPICS))
        meanings = [term_meaning(term) for term in terms]
        return _REPORT.text(_Word("", meanings))
    lines = []
    for topic, title in TOPICS.items():
        names = "; ".join(term.name for term in terms_of(topic))
        lines += [title, *indented(folded(names, _WIDTH - 2, ""))]
    return "\n".join(lines) + "\n"


def glossary() -> str:
    """The terms as a page in Markdown, without its head."""
    paragraphs: list[str] = []
    for topic, title in TOPICS.items():
        paragraphs.append(f"## {title}")
        for term in terms_of(topic):
            paragraphs += _entry(term)
    return "\n\n".join(paragraphs) + "\n"


def _entry(term: Term) -> Iterator[str]:
    """The paragraphs of a term."""
    yield f"### {term.name}"
    yield term.text
    if term.formula:
        yield f"    {term.formula}"
    if term.labels:
        labels = ", ".join(term.labels)
        yield f"Also: {labels}."
    if term.see:
        see = ", ".join(term.see)
        yield f"See {see}."
    yield f"Source: {term.source}."
