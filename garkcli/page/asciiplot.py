"""Plots in plain text, for terminals: points, a signal in bands, a region; one frame for all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from math import ceil, floor
from typing import TypeAlias

from flint import arb, fmpq

from garkcli.page.figures import log10

Positive: TypeAlias = float | fmpq | arb
"""What can be plotted; balls and fractions reach beyond the range of floats."""
_Field: TypeAlias = Sequence[Sequence[str]]
"""The signs inside a frame, line by line."""

POINT, SEVERAL = "•", "*"
COLUMNS = 58
"""Of a plot with its axes; indented by two it fits narrow terminals."""
_AROUND = 13  # columns beside the frame: marks of decades, half a number, gaps
INSIDE = "│"
"""From the least to the greatest value of a column."""
ZERO = "·"
"""The line of zero, where there is nothing else."""
_BESIDE_BAND = 5  # columns of the axis left of what is inside, and of the letter right of it
FULL = "█"
"""Inside of a region."""
SHADED = ":"
"""Outside, but inside of a second region."""


def terminal_curves(
    curves: Mapping[str, Iterable[tuple[Positive, Positive]]],
    label: str,
    width: int = 0,
    height: int = 16,
) -> str:
    """Errors on logarithmic axes, as lines of text without a final newline.

    Args:
        curves: pairs (x, error) by the sign that marks them; two on top of each other make a *.
            Those that are not positive are left out.
        label: of the horizontal axis.
        width: columns inside the frame, so many that the lines have at most ``COLUMNS`` by default.
        height: lines inside the frame.

    >>> print(terminal_curves({POINT: [(1, 1), (0.1, 0.01), (0.01, 0.0001)]}, "h", 21, 5))
         error
    1e+0 ┤                    •
         │
    1e-2 ┤          •
         │
    1e-4 ┤•
         └┬─────────┬─────────┬
        0.01       0.1        1  h

    >>> curves = {"A": [(10, 1), (100, 0.1)], "B": [(100, 1)]}
    >>> print(terminal_curves(curves, "steps", width=13, height=3))
         error
    1e+0 ┤A           B
         │
    1e-1 ┤            A
         └┬───────────┬
         10          100  steps
    """
    points = [
        (log10(x), log10(y), mark)
        for mark, pairs in curves.items()
        for x, y in pairs
        if x > 0 and y > 0
    ]
    if not points:
        return "no positive errors to plot"
    width = width or COLUMNS - _AROUND - len(label)
    xs, ys, _ = zip(*points, strict=True)
    left = min(xs)
    right = max(*xs, left + 0.1)
    bottom = floor(min(ys))
    top = max(ceil(max(ys)), bottom + 1)
    field = [[" "] * width for _ in range(height)]
    for x, y, mark in points:
        row = _cell(top - y, top - bottom, height)
        column = _cell(x - left, right - left, width)
        is_free = field[row][column] in (" ", mark)
        field[row][column] = mark if is_free else SEVERAL
    rows = {
        _cell(top - k, top - bottom, height): f"1e{k:+d}"
        for k in _decades(bottom, top, (height + 1) // 2)
    }
    # the ends come last: they replace a whole power that shares their column
    powers = (*range(ceil(left), floor(right) + 1), left, right)
    columns = {_cell(x - left, right - left, width): _short(x) for x in powers}
    return _framed(field, rows, columns, "error", label)


def _cell(distance: float, extent: float, cells: int) -> int:
    return round(distance / extent * (cells - 1))


def _decades(bottom: int, top: int, most: int) -> range:
    """Whole exponents from the top down, so far apart that they are at most ``most``."""
    gaps = max(most - 1, 1)
    return range(top, bottom - 1, -max(1, ceil((top - bottom) / gaps)))


def _short(exponent: float) -> str:
    if abs(exponent) >= 300:
        return f"1e{exponent:+.1f}"
    number = 10**exponent
    if not 2 <= exponent < 15:
        return f"{number:.2g}"
    digits, _, ending = f"{number:.1e}".partition("e")
    mantissa = float(digits)
    power = int(ending)
    return f"{mantissa:g}e{power}" if power >= 5 else str(round(mantissa * 10**power))


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
        return round((high - value) / extent * last)

    # zero comes last: it replaces an end that shares its line
    marks = {0: high, last: low}
    marks[line(0.0)] = 0.0
    texts = {i: f"{x:.3g}" for i, x in marks.items()}
    first, end = f"{times[0]:g}", f"{times[-1]:g}"
    around = max(map(len, texts.values())) + len(end) // 2 + _BESIDE_BAND
    width = max(columns - around, 2)

    field = [[" "] * width for _ in range(height)]
    field[line(0.0)] = [ZERO] * width
    for j, (least, greatest) in enumerate(_bands(times, values, width)):
        top = line(greatest)
        bottom = line(least)
        sign = POINT if top == bottom else INSIDE
        for i in range(top, bottom + 1):
            field[i][j] = sign
    return _framed(field, texts, {0: first, width - 1: end}, label, "t")


def _bands(
    times: Sequence[float], values: Sequence[float], width: int
) -> list[tuple[float, float]]:
    """The least and the greatest value of each column, of the line through all points."""
    start = times[0]
    scale = (width - 1) / (times[-1] - start or 1.0)
    columns: list[list[float]] = [[] for _ in range(width)]
    columns[0].append(values[0])
    places = [(t - start) * scale for t in times]
    for (x, v), (y, w) in pairwise(zip(places, values, strict=True)):
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
    rows = {0: f"{top:.3g}", middle: "0", height - 1: f"{-top:.3g}"}
    columns = {0: f"{left:.3g}", axis: "0", width - 1: f"{right:.3g}"}
    field = []
    for i in range(height):
        part = 2 * i / (height - 1)  # 0 at the top, 2 at the bottom
        y = top * (1 - part)
        is_axis = i == middle
        cells = []
        for j in range(width):
            z = complex(left + extent * j / (width - 1), y)
            empty = "─" if is_axis else " "
            shaded = SHADED if is_shaded is not None and is_shaded(z) else empty
            cells.append(FULL if is_inside(z) else shaded)
        if 0 <= axis < width:
            cells[axis] = "│"
        field.append(cells)
    return _framed(field, rows, columns)


def _framed(
    field: _Field,
    rows: Mapping[int, str],
    columns: Mapping[int, str],
    above: str = "",
    beside: str = "",
) -> str:
    """A field with its axes, as lines.

    Args:
        field: what is inside.
        rows: where the vertical axis has a mark, and its number.
        columns: the same of the horizontal axis.
        above: the label of the vertical axis.
        beside: that of the horizontal axis.
    """
    margin = max(map(len, rows.values()))
    width = len(field[0])
    blank = " " * margin
    lines = [f"{blank} {above}"] if above else []
    for i, cells in enumerate(field):
        axis = "┤" if i in rows else "│"
        lines.append(f"{rows.get(i, ''):>{margin}} {axis}{''.join(cells)}".rstrip())
    rule = "".join("┬" if j in columns else "─" for j in range(width))
    lines.append(f"{blank} └{rule}")
    lines.append(f"{_placed(columns, margin, width)}  {beside}".rstrip())
    return "\n".join(lines)


def _placed(columns: Mapping[int, str], margin: int, width: int) -> str:
    """The numbers below their marks: those at the ends first, then what still fits."""
    cells = [" "] * (margin + width + 8)
    last = width - 1
    for j in sorted(columns, key=lambda j: (0 < j < last, j)):
        text = columns[j]
        start = margin + 2 + j - len(text) // 2
        end = start + len(text)
        if all(x == " " for x in cells[start - 1 : end + 1]):
            cells[start:end] = text
    return "".join(cells).rstrip()
