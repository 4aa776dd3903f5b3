"""Numbers in lines of bounded length."""

from __future__ import annotations

from collections.abc import Sequence

COLUMNS = 88
"""Of lines of numbers, where a language has no bound of its own."""


def filled(
    items: Sequence[str],
    begin: str = "",
    end: str = "",
    joint: str = ", ",
    continuation: str = "",
    width: int = COLUMNS,
) -> list[str]:
    """Items one after the other in as few lines as hold them; one that is too long has its own.

    Args:
        items: any.
        begin: before the first one; further lines are indented as far.
        end: after the last one.
        joint: between two.
        continuation: what ends a line that goes on.
        width: of the lines.

    >>> filled(["1", "22", "333"], "x = [", "]", width=12)
    ['x = [1, 22,', '     333]']
    """
    indent = " " * len(begin)
    lines = []
    line = begin
    is_empty = True
    last = len(items) - 1
    for place, item in enumerate(items):
        piece = item + (end if place == last else joint)
        room = width - len(continuation)
        if not is_empty and len(line) + len(piece.rstrip()) > room:
            lines.append(line.rstrip() + continuation)
            line = indent
        line += piece
        is_empty = False
    if not items:
        line += end
    return [*lines, line.rstrip()]
