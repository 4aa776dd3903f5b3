"""Kinds made of sections, and kinds for people alone: parts, tables, streams, pictures, words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, TypeVar

from garkcli.tell.facts import (
    Drawing,
    Kind,
    Labels,
    Level,
    ManyParts,
    OnePart,
    Plot,
    Row,
    Section,
    Several,
    Stream,
    TextPicture,
    Words,
)

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.dialect import Plain
    from garkcli.tell.facts import Labelling, Phrasing, Wording

T = TypeVar("T")


def part(
    section: Section[T], words: Wording[T] | None = None, phrase: Phrasing[T] | None = None
) -> Kind[T]:
    """A value with facts of its own; ``words`` replaces the line of the usual ones."""
    return Kind(section, OnePart(section, words, phrase))


def parts(section: Section[T], words: Wording[Sequence[T]] | None = None) -> Kind[Sequence[T]]:
    return Kind(Several(section), ManyParts(section, words))


def table(section: Section[T], most: int) -> Kind[Sequence[T]]:
    """A list of flat parts, a line each, of which so many are usual. Where the first column has no
    label of its own, that of the list is its head. A part of a line, and what is reported as rows,
    have columns of their own.
    """
    return Kind(Several(section), ManyParts(section, most=most))


def shown(section: Section[T], most: int) -> Kind[Sequence[T]]:
    return Kind(None, ManyParts(section, most=most))


def stream(section: Section[T], by: Wording[T] | None = None) -> Kind[Iterable[T]]:
    """A list of flat parts that is reported while it is found, below headings of ``by``: memory
    does not grow with it. A terminal shows the usual rows of a part, LaTeX those of details too,
    Markdown those that programs get.
    """
    return Kind(Several(section), Stream(section, by))


def told(words: Wording[T], phrase: Phrasing[T] | None = None) -> Kind[T]:
    return Kind(None, Words(words, phrase=phrase))


SAID: Kind[str] = told(lambda text, d: d.prose(text))
"""Words for people alone."""

BESIDE: Kind[str] = told(lambda text, d: "" if d.breadth == "page" else d.prose(text))
"""Words for which documents have no room."""


def answer(words: Wording[T]) -> Row[T]:
    """The answer about a result, in the first line."""
    return Row("answer", told(words), lambda x: x, Level.HEADLINE, label="")


def rows_of(rows: Labelling[T]) -> Kind[T]:
    return Kind(None, Labels(rows))


def picture(lines: Callable[[T, Plain], Sequence[str]]) -> Kind[T]:
    return Kind(None, TextPicture(lines))


def drawing(draw: Callable[[T, Plain], Iterable[str]]) -> Kind[T]:
    return Kind(None, Drawing(draw))


def plot(make: Callable[[T], Scene], when: Callable[[T], bool] = lambda _: True) -> Row[T]:
    """A picture of a result, with -v, for people alone."""
    return Row("plot", Kind(None, Plot(make)), lambda x: x if when(x) else None, Level.DETAIL)


def sentence(words: Callable[[T], str]) -> Row[T]:
    """A sentence above or below a list, in its order among the rows."""

    def lines(x: T, d: Plain) -> list[str]:
        text = words(x)
        return d.sentence(d.prose(text), 0) if text else []

    return Row("sentence", drawing(lines), lambda x: x, label="")
