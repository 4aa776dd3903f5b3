"""Kinds made of sections, and kinds for people alone: parts, tables, streams, pictures, words."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from garkcli.tell.facts import Answer, Getter, Kind, Level, Row, Section, Words

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.dialect import Plain


def part(section: Section, words: Words | None = None) -> Kind:
    """A value with facts of its own; its words where its gist does not do."""
    return Kind({}, section=section, words=words)


def told(words: Words, phrase: Callable[[str, Answer, Plain], str] | None = None) -> Kind:
    """What is for people alone."""
    return Kind({}, words=words, phrase=phrase, is_data=False)


SAID = Kind({}, words=lambda text, d: d.prose(text), is_data=False)
"""Words for people alone."""

BESIDE = told(lambda text, d: "" if d.breadth == "page" else d.prose(text))
"""Words for which documents have no room."""


def answer(words: Words, get: Getter = ".") -> Row:
    """The answer, in the first line."""
    return Row("answer", told(words), get, Level.HEADLINE, label="")


def rows_of(rows: Callable[[Any, Plain], list[tuple[str, str]]]) -> Kind:
    """Labels with words, for people alone."""
    return Kind({}, rows=rows, is_data=False)


def picture(lines: Callable[[Any, Plain], list[str]]) -> Kind:
    """A picture in signs, for people alone."""
    return Kind({}, lines=lines, is_data=False)


def drawing(draw: Callable[[Any, Plain], list[str]]) -> Kind:
    """What each output draws in its way, for people alone."""
    return Kind({}, draw=draw, is_data=False)


def scene(make: Callable[[Any], Scene]) -> Kind:
    """A picture of its axes, curves and areas, for people alone."""
    return Kind({}, scene=make, is_data=False)


def sentence(words: Callable[[Any], str]) -> Row:
    """What is reported above or below a list, when it is its turn."""

    def lines(x: Any, d: Plain) -> list[str]:
        text = words(x)
        return d.sentence(d.prose(text), 0) if text else []

    return Row("sentence", drawing(lines), ".", label="")


def parts(section: Section, words: Words | None = None) -> Kind:
    """A list of such values."""
    return Kind({}, section=section, is_list=True, words=words)


def table(section: Section, most: int, is_data: bool = True) -> Kind:
    """A list of flat parts, a line each, of which so many are usual. Where the first column has no
    label of its own, that of the list is its head. A part of a line, and what is reported as rows,
    have columns of their own.
    """
    return Kind({}, section=section, is_list=True, most=most, is_data=is_data)


def shown(section: Section, most: int) -> Kind:
    """The same for people alone."""
    return table(section, most, is_data=False)


def stream(section: Section, by: Callable[[Any, Plain], str] | None = None) -> Kind:
    """A list of flat parts that is reported while it is found; memory does not grow with it. A
    terminal shows the usual rows of a part, LaTeX those of details too, Markdown those that
    programs get.

    Args:
        section: of a part.
        by: the heading above parts that have the same.
    """
    return Kind({}, section=section, is_list=True, is_stream=True, by=by)
