"""Reasons: sentences with values, which every output words in its own notation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from garkcli.frozen import Frozen


class Value(Protocol):
    """A value in a reason, worded by the dialect of an output; ``str`` is its text."""

    def words(self, dialect: Any, /) -> str:
        """The value in the signs of a dialect."""


class Place(Frozen):
    """An entry of a block or of a row, counted from 0, or the whole of it; one colour has no name.

    >>> print(Place("a", ("q", "p"), (1, 0)), Place("b", (), (1,)), Place("A", ("q", "p")))
    a{q,p}[2,1] b[2] A{q,p}
    """

    letter: str
    colours: tuple[str, ...] = ()
    indices: tuple[int, ...] = ()

    def __str__(self) -> str:
        colours = f"{{{','.join(self.colours)}}}" if self.colours else ""
        indices = f"[{','.join(str(i + 1) for i in self.indices)}]" if self.indices else ""
        return self.letter + colours + indices

    def words(self, dialect: Any) -> str:
        return str(dialect.place(self))


class Formula(Frozen):
    """An expression in the notation of method files, or a text with LaTeX."""

    text: str
    latex: str = ""

    def __str__(self) -> str:
        return self.text

    def words(self, dialect: Any) -> str:
        latex = self.latex
        return str(dialect.expression(self.text, (lambda: latex) if latex else None))


class Code(Frozen):
    """A quoted text, such as a tree."""

    text: str

    def __str__(self) -> str:
        return self.text

    def words(self, dialect: Any) -> str:
        return str(dialect.code(self.text))


class Reason:
    """A sentence with ``{}`` for each value, words or to be worded by a dialect; false if empty.

    >>> print(Reason("{} is {}", Place("b", (), (0,)), Formula("-1/4")))
    b[1] is -1/4
    """

    def __init__(self, template: str = "", *values: Value | str) -> None:
        self.template = template
        self.values = values

    def told(self, prose: Callable[[str], str], words: Callable[[Value | str], str]) -> str:
        """The sentence with ``prose`` applied to its text and ``words`` to its values."""
        first, *rest = self.template.split("{}")
        pairs = zip(self.values, rest, strict=True)
        return prose(first) + "".join(words(value) + prose(text) for value, text in pairs)

    def words(self, dialect: Any) -> str:
        return str(dialect.reason(self))

    def __str__(self) -> str:
        return self.told(str, str)

    def __bool__(self) -> bool:
        return bool(self.template)

    def __repr__(self) -> str:
        return f"<Reason {self}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Reason):
            return NotImplemented
        return (self.template, self.values) == (other.template, other.values)

    def __hash__(self) -> int:
        return hash(self.template)


NO_REASON = Reason()


def joined(separator: str, values: Sequence[Value]) -> Reason:
    return Reason(separator.join(["{}"] * len(values)), *values)
