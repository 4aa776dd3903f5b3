"""Facts told: the text of a result in a dialect, many results as a table, JSON and its schema."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from itertools import groupby
from typing import TypeVar

from garkcli.glossary.labels import label_of
from garkcli.tell.dialect import GridLayout, Plain
from garkcli.tell.facts import (
    Drawing,
    Fact,
    Labels,
    Level,
    ManyParts,
    OnePart,
    Plot,
    Row,
    Section,
    Stream,
    TextPicture,
    Words,
)

T = TypeVar("T")

COLUMNS = {"terminal": Level.USUAL, "page": Level.DETAIL, "any": Level.DATA}
"""The level of the columns of a stream, by the breadth of the output."""


def words(fact: Fact, d: Plain) -> str:
    answer, shown = fact.answer, fact.shown
    if answer.value is None:
        if answer.status.open:
            return f"not decided: {d.reason(answer.status.open)}"
        return d.reason(answer.reason) if answer.reason else "none"
    if isinstance(shown, Words) and shown.whole is not None:
        return shown.whole(answer.value, answer, d)
    assert isinstance(shown, (Words, OnePart, ManyParts))
    if shown.words is None:
        return gist(fact, d)
    text = d.known(shown.words(answer.value, d), answer.status)
    return f"{text}: {d.reason(answer.reason)}" if answer.reason else text


def gist(fact: Fact, d: Plain) -> str:
    """The usual facts of a part, or of each of several, in a line."""
    shown = fact.shown
    assert isinstance(shown, (OnePart, ManyParts))
    values = shown.values(fact.value)
    return "; ".join(", ".join(phrases(shown.section, x, d, Level.USUAL)) for x in values)


def phrases(section: Section[T], whole: T, d: Plain, level: Level) -> Iterator[str]:
    """Facts down to a level, each as a part of a sentence."""
    for fact in section.facts(whole, level):
        can_be_said = not fact.is_below and not isinstance(fact.shown, Labels)
        if fact.level <= level and fact.is_something and can_be_said:
            yield phrase(fact, d)


def phrase(fact: Fact, d: Plain) -> str:
    """``order 4, proved``; ``not A-stable: R is unbounded``."""
    shown, name = fact.shown, label(fact, d)
    if isinstance(shown, (Words, OnePart)) and shown.phrase is not None and fact.value is not None:
        return shown.phrase(name, fact.value, fact.answer, d)
    if isinstance(shown, (OnePart, ManyParts)) and shown.words is None and fact.row.line:
        return gist(fact, d)
    return f"{name} {words(fact, d)}".strip()


def label(fact: Fact, d: Plain) -> str:
    return named(fact.row, d)


def named(row: Row[T], d: Plain) -> str:
    return d.prose(label_of(row.key) if row.label is None else row.label)


def cell(fact: Fact, d: Plain) -> str:
    shown, answer = fact.shown, fact.answer
    if answer.value is None:
        absent = shown.absent if isinstance(shown, Words) else ""
        return "?" if answer.status.open else d.prose(absent)
    if isinstance(shown, (Words, OnePart, ManyParts)) and shown.words is not None:
        return d.known(shown.words(answer.value, d), answer.status)
    if isinstance(shown, (OnePart, ManyParts)):
        return gist(fact, d)
    what = fact.row.kind.what
    return d.prose(str(answer.value if what is None else what.data(answer.value, d)))


def one(section: Section[T], whole: T, d: Plain, level: Level = Level.USUAL) -> Iterator[str]:
    headline = "; ".join(phrases(section, whole, d, Level.HEADLINE))
    subject = section.title(whole, d) if section.title else ""
    head: list[str] = []
    if subject or headline:
        head = d.headline(": ".join(filter(None, [subject, headline])))
    yield from head
    lines = body(section, whole, d, level, 1)
    if d.letters is not None:
        lines = iter(told := [*lines])
        yield from d.definitions(d.letters, "\n".join([*head, *told]))
    yield from lines


def body(section: Section[T], whole: T, d: Plain, level: Level, depth: int) -> Iterator[str]:
    """Usually facts share lines; with details each has its own, and parts follow with titles."""
    sentences: dict[str, list[str]] = {}
    rows: list[tuple[str, str]] = []
    below: list[Fact] = []
    for fact in section.facts(whole, level):
        if fact.level > level or not fact.is_something:
            continue
        if fact.level == Level.HEADLINE and depth == 1:
            continue
        if fact.row.is_short and level >= Level.DETAIL:
            continue
        if fact.is_below or _is_opened(fact, level):
            below.append(fact)
        elif isinstance(fact.shown, Labels):
            rows += fact.shown.rows(fact.value, d)
        elif fact.row.line and level < Level.DETAIL:
            sentences.setdefault(fact.row.line, []).append(phrase(fact, d))
        elif text := words(fact, d):
            rows.append((label(fact, d), text))
    for said in sentences.values():
        if text := "; ".join(filter(None, said)):
            yield from d.sentence(text, depth)
    if rows:
        yield from d.rows(rows, depth)
    for fact in below:
        yield from block(fact, d, level, depth)


def _is_opened(fact: Fact, level: Level) -> bool:
    is_part = isinstance(fact.shown, (OnePart, ManyParts))
    return is_part and fact.value is not None and level >= Level.DETAIL


def labelled(
    section: Section[T], whole: T, d: Plain, level: Level, without: Collection[str] = ()
) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """The facts as labels with words, the parts behind them under their titles."""
    rows: list[tuple[str, str]] = []
    below: list[tuple[str, list[tuple[str, str]]]] = []
    for fact in section.facts(whole, level):
        shown = fact.shown
        if fact.level > level or not fact.is_something or fact.row.key in without:
            continue
        titled = shown.section.title if isinstance(shown, (OnePart, ManyParts)) else None
        if (
            isinstance(shown, (OnePart, ManyParts))
            and titled is not None
            and fact.value is not None
        ):
            for part in shown.values(fact.value):
                (_, part_rows), *_ = labelled(shown.section, part, d, level, without)
                below.append((titled(part, d), part_rows))
        elif isinstance(shown, Labels):
            rows += shown.rows(fact.value, d)
        elif not fact.is_below or isinstance(shown, ManyParts):
            rows.append((label(fact, d), words(fact, d)))
    yield "", rows
    yield from below


def block(fact: Fact, d: Plain, level: Level, depth: int) -> Iterator[str]:
    shown, value = fact.shown, fact.value
    match shown:
        case Drawing():
            yield from shown.draw(value, d)
        case Plot():
            yield from d.scene(shown.scene(value), depth)
        case TextPicture():
            yield from d.picture(shown.lines(value, d), depth)
        case Stream():
            yield from stream(shown, value, d, depth)
        case ManyParts() if shown.section.title is None:
            yield from table(fact, shown, d, level, depth)
        case OnePart() | ManyParts():
            section, values = shown.section, shown.values(value)
            most = shown.most if isinstance(shown, ManyParts) and level < Level.DETAIL else None
            for part in values[:most]:
                lines = list(body(section, part, d, level, depth + 1))
                if lines:
                    named = section.title(part, d) if section.title else label(fact, d)
                    yield from d.title(named, depth)
                    yield from lines
            if more := len(values) - len(values[:most]):
                yield from d.more(more, depth)


def stream(shown: Stream[T], parts: Iterable[T], d: Plain, depth: int) -> Iterator[str]:
    """A line for each part, while it is found."""
    section, by = shown.section, shown.by
    level = COLUMNS[d.breadth]
    rows = section.columns_of(level)
    heads = [named(row, d) for row in rows]
    is_grouped = level == Level.USUAL
    for heading, same in groupby(parts, lambda x: by(x, d) if by and is_grouped else ""):
        if heading:
            yield from d.title(heading, depth - 1)
        lines = ([cell(row.fact(part), d) for row in rows] for part in same)
        yield from d.grid(heads, lines, GridLayout(depth, is_stream=True))


def table(fact: Fact, told: ManyParts[T], d: Plain, level: Level, depth: int) -> Iterator[str]:
    """A line for each part; of a long list usually the first ones."""
    section, most = told.section, told.most
    values = fact.value if level >= Level.DETAIL else fact.value[: most or None]
    shown = [dict(_cells(section, x, d, level)) for x in values]
    heads = [*dict.fromkeys(head for row in shown for head in row)]
    rows = [[row.get(head, "") for head in heads] for row in shown]
    if heads[0]:
        yield from d.title(label(fact, d), depth)
        depth += 1
    heads[0] = heads[0] or label(fact, d)
    yield from d.grid(*filled(heads, rows), GridLayout(depth, section.is_cut))
    if more := len(fact.value) - len(values):
        yield from d.more(more, depth + 1)


def _cells(section: Section[T], part: T, d: Plain, level: Level) -> Iterator[tuple[str, str]]:
    """The cells of a line by their heads; parts have columns of their own."""
    for fact in section.facts(part, level):
        shown, value = fact.shown, fact.value
        if fact.level > level:
            continue
        if isinstance(shown, Labels):
            yield from () if value is None else shown.rows(value, d)
        elif isinstance(shown, OnePart) and shown.words is None:
            yield from () if value is None else _cells(shown.section, value, d, level)
        else:
            yield label(fact, d), cell(fact, d)


def filled(
    heads: Sequence[str], rows: Sequence[Sequence[str]]
) -> tuple[list[str], list[list[str]]]:
    kept = [i for i in range(len(heads)) if any(row[i] for row in rows)]
    return [heads[i] for i in kept], [[row[i] for i in kept] for row in rows]


def many(
    form: Callable[[T], Section[T]], wholes: Sequence[T], dialect: Callable[[T], Plain]
) -> Iterator[str]:
    keys = [*dict.fromkeys(key for whole in wholes for key in form(whole).columns)]
    heads = list(keys)
    rows = []
    for whole in wholes:
        d = dialect(whole)
        facts = form(whole).named(whole, form(whole).columns)
        rows.append([cell(facts[key], d) if key in facts else "" for key in keys])
        heads = [
            label(facts[x], d) if x in facts else head for x, head in zip(keys, heads, strict=True)
        ]
    yield from dialect(wholes[0]).grid(*filled(heads, rows))
