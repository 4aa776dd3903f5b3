"""``gark explain``: what words mean, for people and for programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from garkcli.check.meanings import Meaning, term_meaning
from garkcli.frozen import replace
from garkcli.glossary.term import TOPICS, terms_of
from garkcli.page.paint import folded, indented
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Row, Section, optional
from garkcli.tell.kinds import TEXT, TEXTS
from garkcli.tell.report import Report


class Told(NamedTuple):
    """A meaning of a word."""

    word: str
    meaning: Meaning


def _optional(key: str, field: str = "") -> Row:
    """A part of a meaning that some have."""
    return optional(key, TEXT, lambda x: getattr(x, field or key) or None)


def _example_rows(text: str, d: Plain) -> list[tuple[str, str]]:
    """Lines of a file or a command, as they are written."""
    return [("" if i else "example", d.prose(x)) for i, x in enumerate(text.splitlines())]


EXAMPLE = replace(TEXT, rows=_example_rows)
MEANING = Section(
    *(
        row.of(lambda x: x.meaning)
        for row in (
            Row("kind", TEXT, level=Level.DATA),
            Row("name", TEXT, level=Level.DATA),
            Row("text", TEXT, label="", line="text"),
            _optional("formula"),
            _optional("values"),
            _optional("for", "scope"),
            _optional("default"),
            replace(_optional("example"), kind=EXAMPLE),
            _optional("cure"),
            Row("source", TEXT),
            Row("see", TEXTS),
        )
    ),
    title=lambda x, d: d.prose(f"{x.meaning.name}: {x.meaning.kind}"),
)
REPORT: Report[Told] = Report(
    "gark/explain/1",
    "report of gark explain",
    lambda: [MEANING],
    lambda _: MEANING,
    key="meanings",
    tail=Section(Row("word", TEXT, "0.word")),
)


def told(word: str, found: Sequence[Meaning]) -> list[Told]:
    """The meanings of a word."""
    return [Told(word, meaning) for meaning in found]


def every_term() -> list[Told]:
    """The terms, each with its meaning."""
    return told("", [term_meaning(x) for topic in TOPICS for x in terms_of(topic)])


def list_text(width: int) -> str:
    """The names of the terms by topic."""
    lines = []
    for topic, title in TOPICS.items():
        names = "; ".join(term.name for term in terms_of(topic))
        lines += [title, *indented(folded(names, width - 2, ""))]
    return "\n".join(lines) + "\n"
