"""Texts as lines: aligned columns, folded formulas."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

_STYLE = "\x1b\\[[0-9;]*m"


def numbered(names: Sequence[str]) -> str:
    """Returns names with their numbers, as ``1 q, 2 p``; empty if they are the numbers."""
    pairs = [(str(k), name) for k, name in enumerate(names, start=1)]
    return ", ".join(map(" ".join, pairs)) if any(k != name for k, name in pairs) else ""


def indented(lines: Iterable[str], indent: str = "  ") -> list[str]:
    return [indent + line for line in lines]


def aligned(rows: Sequence[Sequence[str]], gap: str = "  ", right: bool = True) -> list[str]:
    """Returns rows as lines with columns of equal width."""
    widths = _widths(rows)
    place = str.rjust if right else str.ljust
    return [gap.join(map(place, row, widths)).rstrip() for row in rows]


def _widths(rows: Sequence[Sequence[str]]) -> list[int]:
    return [max(map(len, column)) for column in zip(*rows, strict=True)]


_JOINTS = r".+?(?:(?<![∀=⊙]) |\}(?=[Ab(])|\](?:_\d+)?,|$)"
"""Pieces of a formula or tree, each up to a possible end of line."""


def joints(text: str) -> list[int]:
    """Returns the places where pieces of a formula or tree begin."""
    return [piece.start() for piece in re.finditer(_JOINTS, text)]


def shown_width(text: str) -> int:
    r"""Returns the width in columns, without colour codes."""
    return len(re.sub(_STYLE, "", text)) if "\x1b" in text else len(text)


def folded(text: str, width: int, indent: str = "      ") -> list[str]:
    """Returns a formula or tree in lines of ``width``, if it has places to break.

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
