"""A region of the complex plane in plain text, for terminals."""

from __future__ import annotations

from collections.abc import Callable

from garkcli.page.asciiplot import beside_axis, ruled

FULL = "█"
"""Inside."""
SHADED = ":"
"""Outside, but inside of a second region."""
EMPTY = " "
"""Outside."""


def terminal_region(
    is_inside: Callable[[complex], bool],
    left: float,
    right: float,
    top: float,
    width: int = 60,
    height: int = 21,
    is_shaded: Callable[[complex], bool] | None = None,
) -> str:
    """The points of a part of the plane for which something holds, as lines of text.

    Args:
        is_inside: decides a point, in floats.
        left: the least real part.
        right: the greatest one.
        top: the greatest imaginary part, and minus the least.
        width: columns inside the frame.
        height: lines inside the frame, odd so that one is the real axis.
        is_shaded: decides whether a point outside belongs to a second region; None for no such.

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
    labels = {0: f"{top:.3g}", middle: "0"}
    labels[height - 1] = f"{-top:.3g}"
    margin = max(map(len, labels.values()))
    field = []
    for i in range(height):
        part = 2 * i / (height - 1)  # 0 at the top, 2 at the bottom
        y = top * (1 - part)
        is_axis = i == middle
        cells = []
        for j in range(width):
            x = left + extent * j / (width - 1)
            z = complex(x, y)
            empty = "─" if is_axis else EMPTY
            shaded = SHADED if is_shaded is not None and is_shaded(z) else empty
            cells.append(FULL if is_inside(z) else shaded)
        if 0 <= axis < width:
            cells[axis] = "│"
        field.append(cells)
    lines = beside_axis(field, labels, margin)
    lines += _scale(left, right, axis, width, margin)
    return "\n".join(lines)


def _scale(left: float, right: float, axis: int, width: int, margin: int) -> list[str]:
    """The horizontal axis with its marks."""
    marks = {0: f"{left:.3g}", axis: "0"}
    marks[width - 1] = f"{right:.3g}"
    inner = margin + 2  # columns left of what is inside
    words = [" "] * (inner + width + 6)
    for j, text in marks.items():
        half = len(text) // 2
        start = inner + j - half
        end = start + len(text)
        words[start:end] = text
    blank = " " * (margin + 1)
    numbers = "".join(words)
    return [blank + ruled(marks, width), numbers.rstrip()]
