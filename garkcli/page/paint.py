"""Colour for the terminal, and columns that line up."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import zip_longest

from garkcli.frozen import Frozen

_CODES = {"good": "32", "bad": "31;1", "strong": "1", "faint": "2", "note": "36"}

_STYLE = "\x1b\\[[0-9;]*m"
"""What starts or ends a style."""
_DOT = "●([0-9]+)"
"""A dot of a drawn tree, with the number of its colour."""
_DOTS = (34, 33, 32, 35, 36, 31)
"""The codes of the colours 1, 2, …, taken anew after the last."""


class Paint(Frozen):
    """Marks text for a terminal when ``color`` is on; nothing is shown by colour alone.

    Attributes:
        color: whether there is any.
        encoding: of where the text goes: signs that it lacks are spelt before columns are made.
    """

    color: bool = False
    encoding: str = "utf-8"

    def __call__(self, style: str, text: str) -> str:
        """``text`` in one of the styles good, bad, strong, faint, note."""
        return text if not self.color or not text else _in_code(_CODES[style], text)

    def dots(self, line: str) -> str:
        """A line of a drawn tree, its dots in the colours of their numbers."""
        return line if not self.color else re.sub(_DOT, _coloured_dot, line)

    def verdict(self, holds: bool, yes: str = "yes", no: str = "no") -> str:
        """A word that is good or bad news."""
        return self("good", yes) if holds else self("bad", no)


def _coloured_dot(dot: re.Match[str]) -> str:
    number = int(dot[1])
    return _in_code(str(_DOTS[(number - 1) % len(_DOTS)]), dot[0])


def _in_code(code: str, text: str) -> str:
    """A text between the sequence that starts a style and the one that ends it."""
    return f"\x1b[{code}m{text}\x1b[0m"


def numbered(names: Sequence[str]) -> str:
    """Names behind their numbers; empty where they are these numbers.

    >>> numbered(["q", "p"]), numbered(["1", "2"])
    ('1 q, 2 p', '')
    """
    pairs = [(str(k), name) for k, name in enumerate(names, start=1)]
    return ", ".join(map(" ".join, pairs)) if any(k != name for k, name in pairs) else ""


def indented(lines: Iterable[str], indent: str = "  ") -> list[str]:
    """Lines with the same margin.

    >>> indented(["a", "b"])
    ['  a', '  b']
    """
    return [indent + line for line in lines]


def aligned(rows: Sequence[Sequence[str]], gap: str = "  ", right: bool = True) -> list[str]:
    """Rows of cells as lines with columns of equal width.

    >>> aligned([["1/2", "-1"], ["0", "1/36"]])
    ['1/2    -1', '  0  1/36']
    """
    widths = _widths(rows)
    place = str.rjust if right else str.ljust
    return [gap.join(map(place, row, widths)).rstrip() for row in rows]


def _widths(rows: Sequence[Sequence[str]]) -> list[int]:
    """The longest cell of each column; no row may have more or fewer cells than another."""
    return [max(map(len, column)) for column in zip(*rows, strict=True)]


_JOINTS = r".+?(?:(?<![∀=⊙]) |\}(?=[Ab(])|\](?:_\d+)?,|$)"
"""Pieces of a formula or of a tree, each up to a place where a line may end."""


def shown_width(text: str) -> int:
    """The columns of a text: codes of colours take none.

    >>> shown_width(Paint(True)("good", "yes"))
    3
    """
    return len(re.sub(_STYLE, "", text)) if "\x1b" in text else len(text)


def folded(text: str, width: int, indent: str = "      ") -> list[str]:
    """A formula or a tree in lines of at most ``width``, where it has places to break; those after
    the first are indented.

    >>> folded("b{l}A{l,m}A{m,n} = 1/24", 16, "  ")
    ['b{l}A{l,m}A{m,n}', '  = 1/24']
    """
    lines = [""]
    for piece in re.findall(_JOINTS, text):
        longer = lines[-1] + piece
        is_begun = bool(lines[-1].strip())
        if is_begun and shown_width(longer.rstrip()) > width:
            longer = indent + piece.lstrip()
            lines.append("")
        lines[-1] = longer
    return [line.rstrip() for line in lines]


def beside(left: Sequence[str], right: Sequence[str], gap: str = "   ") -> list[str]:
    """Two blocks of lines next to each other."""
    width = max((len(line) for line in left), default=0)
    lines = []
    for a, b in zip_longest(left, right, fillvalue=""):
        line = a.ljust(width) + gap + b
        lines.append(line.rstrip())
    return lines
