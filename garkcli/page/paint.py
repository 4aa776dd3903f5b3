"""Colours for the terminal, and aligned columns."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import zip_longest

from garkcli.frozen import Frozen

_CODES = {"good": "32", "bad": "31;1", "strong": "1", "faint": "2", "note": "36"}

_STYLE = "\x1b\\[[0-9;]*m"
"""The start or end of a style."""
_DOT = "●([0-9]+)"
"""A dot of a drawn tree, with the number of its colour."""
_DOTS = (34, 33, 32, 35, 36, 31)
"""The codes of the colours 1, 2, …, repeated after the last."""


class Paint(Frozen):
    """Colours text for a terminal if ``color`` is set; the colour is never the only information.

    Characters that the ``encoding`` lacks are replaced before columns are aligned.
    """

    color: bool = False
    encoding: str = "utf-8"

    def __call__(self, style: str, text: str) -> str:
        """Returns ``text`` in one of the styles good, bad, strong, faint, note."""
        return text if not self.color or not text else _in_code(_CODES[style], text)

    def dots(self, line: str) -> str:
        """Returns a line of a drawn tree with its dots in colour."""
        return line if not self.color else re.sub(_DOT, _coloured_dot, line)

    def verdict(self, holds: bool, yes: str = "yes", no: str = "no") -> str:
        return self("good", yes) if holds else self("bad", no)


def _coloured_dot(dot: re.Match[str]) -> str:
    number = int(dot[1])
    return _in_code(str(_DOTS[(number - 1) % len(_DOTS)]), dot[0])


def _in_code(code: str, text: str) -> str:
    return f"\x1b[{code}m{text}\x1b[0m"


def numbered(names: Sequence[str]) -> str:
    """Returns names with their numbers; empty if they are the numbers.

    >>> numbered(["q", "p"]), numbered(["1", "2"])
    ('1 q, 2 p', '')
    """
    pairs = [(str(k), name) for k, name in enumerate(names, start=1)]
    return ", ".join(map(" ".join, pairs)) if any(k != name for k, name in pairs) else ""


def indented(lines: Iterable[str], indent: str = "  ") -> list[str]:
    """Returns lines with the same margin.

    >>> indented(["a", "b"])
    ['  a', '  b']
    """
    return [indent + line for line in lines]


def aligned(rows: Sequence[Sequence[str]], gap: str = "  ", right: bool = True) -> list[str]:
    """Returns rows as lines with columns of equal width.

    >>> aligned([["1/2", "-1"], ["0", "1/36"]])
    ['1/2    -1', '  0  1/36']
    """
    widths = _widths(rows)
    place = str.rjust if right else str.ljust
    return [gap.join(map(place, row, widths)).rstrip() for row in rows]


def _widths(rows: Sequence[Sequence[str]]) -> list[int]:
    """Returns the longest cell of each column; all rows have as many cells."""
    return [max(map(len, column)) for column in zip(*rows, strict=True)]


_JOINTS = r".+?(?:(?<![∀=⊙]) |\}(?=[Ab(])|\](?:_\d+)?,|$)"
"""Pieces of a formula or tree, each up to a place where a line may end."""


def shown_width(text: str) -> int:
    """Returns the width of a text in columns, without colour codes.

    >>> shown_width(Paint(True)("good", "yes"))
    3
    """
    return len(re.sub(_STYLE, "", text)) if "\x1b" in text else len(text)


def folded(text: str, width: int, indent: str = "      ") -> list[str]:
    """Returns a formula or tree in lines of at most ``width``, if it has places to break; later
    lines are indented.

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
    """Returns two blocks of lines side by side."""
    width = max((len(line) for line in left), default=0)
    lines = []
    for a, b in zip_longest(left, right, fillvalue=""):
        line = a.ljust(width) + gap + b
        lines.append(line.rstrip())
    return lines
