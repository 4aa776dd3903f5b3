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
    """``words`` replaces the line of the usual facts."""
    return facts.Kind(section, facts.OnePart(section, words, phrase))


def parts(
    section: facts.Section[T], words: Wording[Sequence[T]] | None = None
) -> facts.Kind[Sequence[T]]:
    return facts.Kind(facts.Several(section), facts.ManyParts(section, words))


def table(section: facts.Section[T], most: int) -> facts.Kind[Sequence[T]]:
    """``most`` parts are usual, a line each; the first column may have the label of the list."""
    return facts.Kind(facts.Several(section), facts.ManyParts(section, most=most))


def shown(section: facts.Section[T], most: int) -> facts.Kind[Sequence[T]]:
    return facts.Kind(None, facts.ManyParts(section, most=most))


def stream(section: facts.Section[T], by: Wording[T] | None = None) -> facts.Kind[Iterable[T]]:
    """Parts are reported while they are found, below headings of ``by``: memory does not grow."""
    return facts.Kind(facts.Several(section), facts.Stream(section, by))


def told(words: Wording[T], phrase: Phrasing[T] | None = None) -> facts.Kind[T]:
    return facts.Kind(None, facts.Words(words, phrase=phrase))


SAID: facts.Kind[str] = told(lambda text, d: d.prose(text))

BESIDE: facts.Kind[str] = told(lambda text, d: "" if d.breadth == "page" else d.prose(text))
"""Documents have no room for these words."""


def answer(words: Wording[T]) -> facts.Row[T]:
    return facts.Row("answer", told(words), lambda x: x, facts.Level.HEADLINE, label="")


def rows_of(rows: Labelling[T]) -> facts.Kind[T]:
    return facts.Kind(None, facts.Labels(rows))


def picture(lines: Callable[[T, Plain], Sequence[str]]) -> facts.Kind[T]:
    return facts.Kind(None, facts.TextPicture(lines))


def drawing(draw: Callable[[T, Plain], Iterable[str]]) -> facts.Kind[T]:
    return facts.Kind(None, facts.Drawing(draw))


def plot(make: Callable[[T], Scene], when: Callable[[T], bool] = lambda _: True) -> facts.Row[T]:
    return facts.Row(
        "plot",
        facts.Kind(None, facts.Plot(make)),
        lambda x: x if when(x) else None,
        facts.Level.DETAIL,
    )


def sentence(words: Callable[[T], str]) -> facts.Row[T]:
    def lines(x: T, d: Plain) -> list[str]:
        text = words(x)
        return d.sentence(d.prose(text), 0) if text else []

    return facts.Row("sentence", drawing(lines), lambda x: x, label="")
