"""``gark explain``: meanings of words, for people and for programs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from garkcli.check.meanings import Meaning, term_meaning
from garkcli.glossary.term import TOPICS, terms_of
from garkcli.page.lines import folded, indented
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Kind, Labels, Level, Row, Rows, Section, optional, via
from garkcli.tell.kinds import TEXT, TEXTS
from garkcli.tell.report import Report


class Told(NamedTuple):
    word: str
    meaning: Meaning


def _optional(key: str, get: Callable[[Meaning], str]) -> Row[Meaning]:
    return optional(key, TEXT, lambda x: get(x) or None)


def _example_rows(text: str, d: Plain) -> list[tuple[str, str]]:
    return [("" if i else "example", d.prose(x)) for i, x in enumerate(text.splitlines())]


EXAMPLE: Kind[str] = Kind(TEXT.what, Labels(_example_rows))
OF_MEANING: Rows[Meaning] = (
    Row("kind", TEXT, lambda x: x.kind, Level.DATA),
    Row("name", TEXT, lambda x: x.name, Level.DATA),
    Row("text", TEXT, lambda x: x.text, label="", line="text"),
    _optional("formula", lambda x: x.formula),
    _optional("values", lambda x: x.values),
    _optional("for", lambda x: x.scope),
    _optional("default", lambda x: x.default),
    optional("example", EXAMPLE, lambda x: x.example or None),
    _optional("cure", lambda x: x.cure),
    Row("source", TEXT, lambda x: x.source),
    Row("see", TEXTS, lambda x: x.see),
)
MEANING: Section[Told] = Section(
    via(lambda x: x.meaning, OF_MEANING),
    title=lambda x, d: d.prose(f"{x.meaning.name}: {x.meaning.kind}"),
)
REPORT: Report[Told] = Report(
    "gark/explain/1",
    "report of gark explain",
    lambda: [MEANING],
    lambda _: MEANING,
    key="meanings",
    tail=Section(Row("word", TEXT, lambda x: x[0].word)),
)


def told(word: str, found: Sequence[Meaning]) -> list[Told]:
    return [Told(word, meaning) for meaning in found]


def every_term() -> list[Told]:
    return told("", [term_meaning(x) for topic in TOPICS for x in terms_of(topic)])


def list_text(width: int) -> str:
    lines = []
    for topic, title in TOPICS.items():
        names = "; ".join(term.name for term in terms_of(topic))
        lines += [title, *indented(folded(names, width - 2, ""))]
    return "\n".join(lines) + "\n"
