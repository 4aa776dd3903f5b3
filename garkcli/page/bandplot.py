"""A signal against time in plain text, for terminals: what lies between its least and greatest
value.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from garkcli.page.asciiplot import beside_axis

INSIDE = "│"
"""From the least to the greatest value of a column."""
SINGLE = "•"
"""A column whose values share a line."""
ZERO = "·"
"""The line of zero, where there is nothing else."""
_FRAME = 5  # columns of the axis left of what is inside, and of the letter right of it


def terminal_band(
    times: Sequence[float], values: Sequence[float], label: str, columns: int = 58, height: int = 11
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
    low = min(0.0, *values)
    high = max(0.0, *values)
    if high == low:
        high = 1.0
    extent = high - low
    last = height - 1

    def line(value: float) -> int:
        part = (high - value) / extent
        return round(part * last)

    # zero comes last: it replaces an end that shares its line
    marks = {0: high, last: low}
    marks[line(0.0)] = 0.0
    texts = {i: f"{x:.3g}" for i, x in marks.items()}
    margin = max(map(len, texts.values()))
    width = max(columns - margin - _FRAME, 2)

    field = [[" "] * width for _ in range(height)]
    field[line(0.0)] = [ZERO] * width
    bands = _bands(times, values, width)
    for j, (least, greatest) in enumerate(bands):
        top = line(greatest)
        bottom = line(least)
        sign = SINGLE if top == bottom else INSIDE
        for i in range(top, bottom + 1):
            field[i][j] = sign
    lines = _framed(field, texts, label, times[0], times[-1])
    return "\n".join(lines)


def _bands(
    times: Sequence[float], values: Sequence[float], width: int
) -> list[tuple[float, float]]:
    """The least and the greatest value of each column, of the line through all points."""
    start = times[0]
    span = times[-1] - start
    scale = (width - 1) / (span or 1.0)
    columns: list[list[float]] = [[] for _ in range(width)]
    columns[0].append(values[0])
    places = [(t - start) * scale for t in times]
    points = zip(places, values, strict=True)
    for (x, v), (y, w) in pairwise(points):
        first, last = round(x), round(y)
        columns[last].append(w)
        for j in range(first, last):
            # where the line goes from column j to the next
            edge = j + 0.5
            part = (edge - x) / (y - x)
            part = min(max(part, 0.0), 1.0)
            value = v + (w - v) * part
            columns[j].append(value)
            columns[j + 1].append(value)
    bands = []
    for column in columns:
        # a single point has one column
        filled = column or [values[-1]]
        bands.append((min(filled), max(filled)))
    return bands


def _framed(
    field: Sequence[Sequence[str]], marks: Mapping[int, str], label: str, start: float, end: float
) -> list[str]:
    margin = max(map(len, marks.values()))
    width = len(field[0])
    blank = " " * margin
    rule = "─" * (width - 2)
    first = f"{start:g}"
    last = f"{end:g}"
    last = last.rjust(width - len(first))
    lines = [f"{blank} {label}"]
    lines += beside_axis(field, marks, margin)
    lines.append(f"{blank} └┬{rule}┬")
    lines.append(f"{blank}  {first}{last}  t")
    return lines
