"""A small log–log plot in plain text, for terminals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import ceil, floor
from typing import TypeAlias

from flint import arb, fmpq

Positive: TypeAlias = float | fmpq | arb
"""What can be plotted; balls and fractions reach beyond the range of floats."""

POINT, LINE, SEVERAL = "•", "·", "*"
COLUMNS = 58
"""Of a plot with its axes; indented by two it fits narrow terminals."""
_AROUND = 13  # columns beside the frame: marks of decades, half a number, gaps


def log10(x: Positive) -> float:
    """The decimal logarithm of a positive number, however small.

    >>> log10(fmpq(1, 10**400))
    -400.0
    """
    natural = arb(x).log()
    return float(natural / arb(10).log())


def terminal_plot(
    hs: Sequence[Positive],
    errors: Sequence[Positive],
    width: int = 0,
    height: int = 16,
    order: int | None = None,
) -> str:
    """Errors against step sizes, both on logarithmic axes, as lines of text without a final
    newline.

    Args:
        hs: step sizes, positive.
        errors: an error for each; those that are not positive are left out.
        width: columns inside the frame, so many that the lines have at most ``COLUMNS`` by default.
        height: lines inside the frame.
        order: the slope of a dotted line through the smallest step; none by default.

    >>> print(terminal_plot([1, 0.1, 0.01], [1, 0.01, 0.0001], width=21, height=5))
         error
    1e+0 ┤                    •
         │
    1e-2 ┤          •
         │
    1e-4 ┤•
         └┬─────────┬─────────┬
        0.01       0.1        1  h
    """
    points = []
    for h, error in zip(hs, errors, strict=True):
        if error > 0:
            points.append((log10(h), log10(error)))
    points.sort()
    line = None
    if order is not None and points:
        line = (*points[0], order)
    marked = [(x, y, POINT) for x, y in points]
    return _plot(marked, "h", width or _inside("h"), height, line)


def terminal_curves(
    curves: Mapping[str, Iterable[tuple[Positive, Positive]]],
    label: str,
    width: int = 0,
    height: int = 16,
) -> str:
    """Errors of several methods, as ``terminal_plot`` draws those of one.

    Args:
        curves: pairs (x, error) by the letter that marks them; two on top of each other make a *.
        label: of the horizontal axis.
        width: columns inside the frame, so many that the lines have at most ``COLUMNS`` by default.
        height: lines inside the frame.

    >>> curves = {"A": [(10, 1), (100, 0.1)], "B": [(100, 1)]}
    >>> print(terminal_curves(curves, "steps", width=13, height=3))
         error
    1e+0 ┤A           B
         │
    1e-1 ┤            A
         └┬───────────┬
         10          100  steps
    """
    points = []
    for mark, pairs in curves.items():
        for x, y in pairs:
            if x > 0 and y > 0:
                points.append((log10(x), log10(y), mark))
    return _plot(points, label, width or _inside(label), height, None)


def _inside(label: str) -> int:
    """Columns inside a frame with this label behind its horizontal axis."""
    return COLUMNS - _AROUND - len(label)


def _plot(
    points: Sequence[tuple[float, float, str]],
    label: str,
    width: int,
    height: int,
    line: tuple[float, float, float] | None,
) -> str:
    """Marks at decimal logarithms, over a dotted line through the point (x, y) with a slope."""
    if not points:
        return "no positive errors to plot"
    xs, ys, _ = zip(*points, strict=True)
    left = min(xs)
    right = max(*xs, left + 0.1)
    bottom = floor(min(ys))
    top = max(ceil(max(ys)), bottom + 1)
    frame = [[" "] * width for _ in range(height)]

    def put(x: float, y: float, mark: str) -> None:
        row = _cell(top - y, top - bottom, height)
        if not 0 <= row < height:
            return
        column = _cell(x - left, right - left, width)
        is_free = frame[row][column] in (" ", LINE, mark)
        frame[row][column] = mark if is_free else SEVERAL

    if line is not None:
        start, level, slope = line
        extent = right - left
        last = width - 1
        for column in range(width):
            x = left + extent * column / last
            y = level + slope * (x - start)
            put(x, y, LINE)
    for x, y, mark in points:
        put(x, y, mark)

    rows = {}
    for k in _decades(bottom, top, (height + 1) // 2):
        row = _cell(top - k, top - bottom, height)
        rows[row] = f"1e{k:+d}"
    columns = {}
    whole = range(ceil(left), floor(right) + 1)
    # the ends come last: they replace a whole power that shares their column
    for x in (*whole, left, right):
        column = _cell(x - left, right - left, width)
        columns[column] = _short(x)
    return "\n".join(_framed(frame, rows, columns, label))


def _cell(distance: float, extent: float, cells: int) -> int:
    part = distance / extent
    return round(part * (cells - 1))


def _decades(bottom: int, top: int, most: int) -> range:
    """Whole exponents from the top down, so far apart that they are at most ``most``."""
    gaps = max(most - 1, 1)
    apart = max(1, ceil((top - bottom) / gaps))
    return range(top, bottom - 1, -apart)


def _short(exponent: float) -> str:
    if abs(exponent) >= 300:
        return f"1e{exponent:+.1f}"
    number = 10**exponent
    if not 2 <= exponent < 15:
        return f"{number:.2g}"
    digits, _, ending = f"{number:.1e}".partition("e")
    mantissa = float(digits)
    power = int(ending)
    if power >= 5:
        return f"{mantissa:g}e{power}"
    return str(round(mantissa * 10**power))


def _framed(
    frame: Sequence[Sequence[str]], rows: Mapping[int, str], columns: Mapping[int, str], label: str
) -> list[str]:
    """The frame with its axes; ``rows`` and ``columns`` say where they have a mark, and its
    label.
    """
    margin = max(map(len, rows.values()))
    width = len(frame[0])
    blank = " " * margin
    numbers = _placed(columns, margin, width)
    lines = [f"{blank} error"]
    lines += beside_axis(frame, rows, margin)
    lines.append(f"{blank} {ruled(columns, width)}")
    lines.append(f"{numbers}  {label}")
    return lines


def beside_axis(frame: Sequence[Sequence[str]], marks: Mapping[int, str], margin: int) -> list[str]:
    """The lines of a frame right of their axis; ``marks`` has the numbers of some of them, and
    ``margin`` their width.
    """
    lines = []
    for i, cells in enumerate(frame):
        number = marks.get(i, "").rjust(margin)
        axis = "┤" if i in marks else "│"
        inside = "".join(cells)
        line = f"{number} {axis}{inside}"
        lines.append(line.rstrip())
    return lines


def ruled(marks: Iterable[int], width: int) -> str:
    """A horizontal axis with marks at some columns."""
    cells = ["─"] * width
    for j in marks:
        if 0 <= j < width:
            cells[j] = "┬"
    return "└" + "".join(cells)


def _placed(columns: Mapping[int, str], margin: int, width: int) -> str:
    """The numbers below their marks: those at the ends first, then what still fits."""
    cells = [" "] * (margin + width + 8)
    last = width - 1
    ends_first = sorted(columns, key=lambda j: (0 < j < last, j))
    for j in ends_first:
        text = columns[j]
        half = len(text) // 2
        start = margin + 2 + j - half
        end = start + len(text)
        around = cells[start - 1 : end + 1]
        if all(x == " " for x in around):
            cells[start:end] = text
    return "".join(cells).rstrip()
