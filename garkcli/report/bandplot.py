"""A signal against time in plain text, for terminals: what lies between its least and greatest
value.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

INSIDE = "│"
"""From the least to the greatest value of a column."""
SINGLE = "•"
"""A column whose values share a line."""
ZERO = "·"
"""The line of zero, where there is nothing else."""
_FRAME = 5  # columns of the axis left of what is inside, and of the letter right of it


def terminal_band(
    times: Sequence[float],
    values: Sequence[float],
    label: str,
    columns: int = 58,
    height: int = 11,
) -> str:
    """Values against time, linear on both axes, as lines of text without a final newline.

    A column shows all values of its span of time, straight lines between them included. Zero is
    always shown.

    Args:
        times: ascending, at least one.
        values: finite, one for each time.
        label: of the vertical axis.
        columns: of the longest line.
        height: lines inside the frame.

    >>> print(terminal_band([0, 3, 5, 6], [0, 3, 3, -1], "f", columns=14, height=5))
       f
     3 ┤  │••│
       │  │  │
       ││•│  ││
     0 ┤│·····│
    -1 ┤      │
       └┬─────┬
        0     6  t
    """
    low, high = min(0.0, *values), max(0.0, *values)
    if high == low:
        high = 1.0

    def line(value: float) -> int:
        part = (high - value) / (high - low)
        return round(part * (height - 1))

    marks = {0: high, height - 1: low, line(0.0): 0.0}
    texts = {i: f"{x:.3g}" for i, x in marks.items()}
    margin = max(map(len, texts.values()))
    width = max(columns - margin - _FRAME, 2)
    bands = _bands(times, values, width)
    field = [[" "] * width for _ in range(height)]
    field[line(0.0)] = [ZERO] * width
    for j, (least, greatest) in enumerate(bands):
        top, bottom = line(greatest), line(least)
        for i in range(top, bottom + 1):
            field[i][j] = SINGLE if top == bottom else INSIDE
    return "\n".join(_framed(field, texts, label, times[0], times[-1]))


def _bands(
    times: Sequence[float], values: Sequence[float], width: int
) -> list[tuple[float, float]]:
    """The least and the greatest value of each column, of the line through all points."""
    scale = (width - 1) / ((times[-1] - times[0]) or 1.0)
    columns: list[list[float]] = [[] for _ in range(width)]
    columns[0].append(values[0])
    places = [(t - times[0]) * scale for t in times]
    points = zip(places, values, strict=True)
    for (x, v), (y, w) in pairwise(points):
        columns[round(y)].append(w)
        for j in range(round(x), round(y)):
            # where the line goes from column j to the next
            part = (j + 0.5 - x) / (y - x)
            value = v + (w - v) * min(max(part, 0.0), 1.0)
            columns[j].append(value)
            columns[j + 1].append(value)
    bands = []
    for column in columns:
        # a single point has one column
        filled = column or [values[-1]]
        bands.append((min(filled), max(filled)))
    return bands


def _framed(
    field: Sequence[Sequence[str]],
    marks: Mapping[int, str],
    label: str,
    start: float,
    end: float,
) -> list[str]:
    margin, width = max(map(len, marks.values())), len(field[0])
    blank = " " * margin
    lines = [f"{blank} {label}"]
    for i, row in enumerate(field):
        number = marks.get(i, "").rjust(margin)
        axis = "┤" if i in marks else "│"
        line = f"{number} {axis}{''.join(row)}"
        lines.append(line.rstrip())
    rule = "─" * (width - 2)
    first, last = f"{start:g}", f"{end:g}"
    last = last.rjust(width - len(first))
    return [*lines, f"{blank} └┬{rule}┬", f"{blank}  {first}{last}  t"]
