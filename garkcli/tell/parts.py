"""Kinds made of sections, and kinds for people alone: parts, tables, streams, pictures, words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, TypeVar

from garkcli.tell import facts

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.dialect import Plain
    from garkcli.tell.facts import Labelling, Phrasing, Wording

T = TypeVar("T")


def part(
    section: facts.Section[T], words: Wording[T] | None = None, phrase: Phrasing[T] | None = None
) -> facts.Kind[T]:
    """A value with facts of its own; ``words`` replaces the line of the usual ones."""
    return facts.Kind(section, facts.OnePart(section, words, phrase))


def parts(
    section: facts.Section[T], words: Wording[Sequence[T]] | None = None
) -> facts.Kind[Sequence[T]]:
    return facts.Kind(facts.Several(section), facts.ManyParts(section, words))


def table(section: facts.Section[T], most: int) -> facts.Kind[Sequence[T]]:
    """A list of flat parts, a line each, of which so many are usual. Where the first column has no
    label of its own, that of the list is its head. A part of a line, and what is reported as rows,
    have columns of their own.
    """
    return facts.Kind(facts.Several(section), facts.ManyParts(section, most=most))


def shown(section: facts.Section[T], most: int) -> facts.Kind[Sequence[T]]:
    return facts.Kind(None, facts.ManyParts(section, most=most))


def stream(section: facts.Section[T], by: Wording[T] | None = None) -> facts.Kind[Iterable[T]]:
    """A list of flat parts that is reported while it is found, below headings of ``by``: memory
    does not grow with it. A terminal shows the usual rows of a part, LaTeX those of details too,
    Markdown those that programs get.
    """
    return facts.Kind(facts.Several(section), facts.Stream(section, by))


def told(words: Wording[T], phrase: Phrasing[T] | None = None) -> facts.Kind[T]:
    return facts.Kind(None, facts.Words(words, phrase=phrase))


SAID: facts.Kind[str] = told(lambda text, d: d.prose(text))
"""Words for people alone."""

BESIDE: facts.Kind[str] = told(lambda text, d: "" if d.breadth == "page" else d.prose(text))
"""Words for which documents have no room."""


def answer(words: Wording[T]) -> facts.Row[T]:
    """The answer about a result, in the first line."""
    return facts.Row("answer", told(words), lambda x: x, facts.Level.HEADLINE, label="")


def rows_of(rows: Labelling[T]) -> facts.Kind[T]:
    return facts.Kind(None, facts.Labels(rows))


def picture(lines: Callable[[T, Plain], Sequence[str]]) -> facts.Kind[T]:
    return facts.Kind(None, facts.TextPicture(lines))


def drawing(draw: Callable[[T, Plain], Iterable[str]]) -> facts.Kind[T]:
    return facts.Kind(None, facts.Drawing(draw))


def plot(make: Callable[[T], Scene], when: Callable[[T], bool] = lambda _: True) -> facts.Row[T]:
    """A picture of a result, with -v, for people alone."""
    return facts.Row(
        "plot",
        facts.Kind(None, facts.Plot(make)),
        lambda x: x if when(x) else None,
        facts.Level.DETAIL,
    )


def sentence(words: Callable[[T], str]) -> facts.Row[T]:
    """A sentence above or below a list, in its order among the rows."""

    def lines(x: T, d: Plain) -> list[str]:
        text = words(x)
        return d.sentence(d.prose(text), 0) if text else []

    return facts.Row("sentence", drawing(lines), lambda x: x, label="")
