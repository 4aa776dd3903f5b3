"""Ways to show values to people: in words, as labels, as pictures, in parts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Generic, TypeAlias, TypeVar

from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.dialect import Plain
    from garkcli.tell.facts import Answer, Section

V = TypeVar("V", contravariant=True)
T = TypeVar("T")
Wording: TypeAlias = "Callable[[T, Plain], str]"
Labelling: TypeAlias = "Callable[[T, Plain], Iterable[tuple[str, str]]]"
Phrasing: TypeAlias = "Callable[[str, T, Answer[T], Plain], str]"
"""Makes a part of a sentence of a label, a value and its answer."""


class Display(Frozen, Generic[V]):
    """A way to show a value."""


class Words(Display[V]):
    """In a line.

    Attributes:
        whole: the answer in words, if its status and its reason are not added after ``words``.
        phrase: a part of a sentence, if that is not the label with the words.
        absent: the cell of a table if there is no value.
    """

    words: Wording[V]
    whole: Callable[[V, Answer[V], Plain], str] | None = None
    phrase: Phrasing[V] | None = None
    absent: str = ""


class Labels(Display[V]):
    """As rows among those of other facts."""

    rows: Labelling[V]


class Below(Display[V]):
    """In lines of its own, below the other facts."""


class TextPicture(Below[V]):
    """A picture in signs, which only some outputs have room for."""

    lines: Callable[[V, Plain], Sequence[str]]


class Drawing(Below[V]):
    """Finished lines of the output."""

    draw: Callable[[V, Plain], Iterable[str]]


class Plot(Below[V]):
    """Axes, curves and areas, which each output draws in its way."""

    scene: Callable[[V], Scene]


class OnePart(Display[T]):
    """By the facts of a section: usually some in a line, or ``words``; with details each alone."""

    section: Section[T]
    words: Wording[T] | None = None
    phrase: Phrasing[T] | None = None

    def values(self, value: T) -> Sequence[T]:
        return [value]


class ManyParts(Display[Sequence[T]]):
    """A list, by the facts of a section.

    Attributes:
        words: the line of all parts, if the usual facts do not make it.
        most: so many rows of a table are usual, 0 for all; None if a line is usual.
    """

    section: Section[T]
    words: Wording[Sequence[T]] | None = None
    most: int | None = None

    def values(self, value: Sequence[T]) -> Sequence[T]:
        return value


class Stream(Below[Iterable[T]]):
    """A line for each part, while the parts are found, below headings of ``by`` on a terminal."""

    section: Section[T]
    by: Wording[T] | None = None
