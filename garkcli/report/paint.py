"""Colour for the terminal, and columns that line up."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

_CODES = {"good": "32", "bad": "31;1", "strong": "1", "faint": "2", "note": "36"}

_DOTS = (34, 33, 32, 35, 36, 31)


@dataclass(frozen=True)
class Paint:
    """Marks text for a terminal when ``color`` is on; nothing is told by colour alone."""

    color: bool = False

    def __call__(self, style: str, text: str) -> str:
        """``text`` in one of the styles good, bad, strong, faint, note."""
        return f"\x1b[{_CODES[style]}m{text}\x1b[0m" if self.color and text else text

    def dots(self, line: str) -> str:
        """A line of a drawn tree, its dots in the colours of their numbers."""
        if not self.color:
            return line
        return re.sub(
            "●([0-9]+)",
            lambda dot: f"\x1b[{_DOTS[(int(dot[1]) - 1) % len(_DOTS)]}m{dot[0]}\x1b[0m",
            line,
        )

    def verdict(self, holds: bool, yes: str = "yes", no: str = "no") -> str:
        """A word that is good or bad news."""
        return self("good", yes) if holds else self("bad", no)


def aligned(
    rows: Sequence[Sequence[str]], gap: str = "  ", right: bool = True
) -> list[str]:
    """Rows of cells as lines with columns of equal width.

    >>> aligned([["1/2", "-1"], ["0", "1/36"]])
    ['1/2    -1', '  0  1/36']
    """
    widths = (
        [max(len(row[j]) for row in rows) for j in range(len(rows[0]))] if rows else []
    )
    place = str.rjust if right else str.ljust
    return [
        gap.join(place(x, w) for x, w in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]


_JOINTS = re.compile(r".+?(?:(?<![∀=⊙]) |\}(?=[Ab(])|\](?:_\d+)?,|$)")
"""Pieces of a formula or of a tree, each up to a place where a line may end."""


def folded(text: str, width: int, indent: str = "      ") -> list[str]:
    """A formula or a tree in lines of at most ``width``, where it has places to break; those after
    the first are indented.

    >>> folded("b{l}A{l,m}A{m,n} = 1/24", 16, "  ")
    ['b{l}A{l,m}A{m,n}', '  = 1/24']
    """
    lines = [""]
    for piece in _JOINTS.findall(text):
        if lines[-1].strip() and len((lines[-1] + piece).rstrip()) > width:
            lines.append(indent)
        lines[-1] += piece
    return [line.rstrip() for line in lines]


def beside(left: Sequence[str], right: Sequence[str], gap: str = "   ") -> list[str]:
    """Two blocks of lines next to each other."""
    width = max((len(line) for line in left), default=0)
    height = max(len(left), len(right))
    rows = zip(
        [*left, *[""] * (height - len(left))],
        [*right, *[""] * (height - len(right))],
        strict=True,
    )
    return [f"{a.ljust(width)}{gap}{b}".rstrip() for a, b in rows]


def padded(rows: Sequence[Sequence[str]], gap: str = "   ") -> list[str]:
    """The same with the first column to the left, the others to the right.

    >>> padded([["order", "4"], ["A", "12"]])
    ['order    4', 'A       12']
    """
    widths = [max(len(row[j]) for row in rows) for j in range(len(rows[0]))]
    lines = []
    for first, *others in rows:
        cells = [x.rjust(w) for x, w in zip(others, widths[1:], strict=True)]
        lines.append(gap.join([first.ljust(widths[0]), *cells]).rstrip())
    return lines
