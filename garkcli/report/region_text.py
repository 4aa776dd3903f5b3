"""A region of the complex plane in plain text, for terminals."""

from __future__ import annotations

from collections.abc import Callable

FULL = "█"
"""Inside."""
EMPTY = " "
"""Outside."""


def terminal_region(
    is_inside: Callable[[complex], bool],
    left: float,
    right: float,
    top: float,
    width: int = 60,
    height: int = 21,
) -> str:
    """The points of a part of the plane for which something holds, as lines of text.

    Args:
        is_inside: decides a point, in floats.
        left: the least real part.
        right: the greatest one.
        top: the greatest imaginary part, and minus the least.
        width: columns inside the frame.
        height: lines inside the frame, odd so that one is the real axis.

    >>> print(terminal_region(lambda z: abs(z) <= 1, -2, 2, 1.5, width=9, height=5))
     1.5 ┤    │
         │   █│█
       0 ┤──██│██──
         │   █│█
    -1.5 ┤    │
         └┬───┬───┬
         -2   0   2
    """
    middle = height // 2
    extent = right - left
    axis = round(-left / extent * (width - 1))
    labels = {0: f"{top:.3g}", middle: "0", height - 1: f"{-top:.3g}"}
    margin = max(map(len, labels.values()))
    lines = []
    for i in range(height):
        y = top * (1 - 2 * i / (height - 1))
        cells = []
        for j in range(width):
            x = left + extent * j / (width - 1)
            cells.append(_cell(is_inside(complex(x, y)), i == middle))
        if 0 <= axis < width:
            cells[axis] = "│"
        number = labels.get(i, "").rjust(margin)
        edge = "┤" if i in labels else "│"
        line = f"{number} {edge}{''.join(cells)}"
        lines.append(line.rstrip())
    return "\n".join([*lines, *_scale(left, right, axis, width, margin)])


def _cell(inside: bool, is_axis: bool) -> str:
    if inside:
        return FULL
    return "─" if is_axis else EMPTY


def _scale(left: float, right: float, axis: int, width: int, margin: int) -> list[str]:
    """The horizontal axis with its marks."""
    marks = {0: f"{left:.3g}", axis: "0", width - 1: f"{right:.3g}"}
    line = "".join("┬" if j in marks else "─" for j in range(width))
    words = [" "] * (margin + 2 + width + 6)
    for j, text in marks.items():
        start = margin + 2 + j - len(text) // 2
        words[start : start + len(text)] = text
    return [" " * (margin + 1) + "└" + line, "".join(words).rstrip()]
