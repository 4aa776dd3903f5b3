"""Panels in characters: one for each point, the letter of the legend if it has one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import TypeAlias

from garkcli.errors import printable
from garkcli.page.lines import folded
from garkcli.plots.scene import Area, Curve, Mark, Panel, RuledLine, shortened

COLUMNS = 58
"""Indented by two it fits narrow terminals."""
_NARROWEST = 8  # columns between the axes
_LINE = 16
"""Units of a picture per line."""
_DOTS = "•○×+"
_FILLED = "█▒░:"
"""Signs by style; the first regions are on top."""
_PALE = ":"
_STEEP, _STRAIGHT = "│", "·"
"""A line across several rows of a column, and a line between two points."""
SEVERAL = "*"
"""Points with several letters."""
_Cells: TypeAlias = dict[tuple[int, int], str]
"""Signs by row and column, from the upper left."""


def drawn(panel: Panel, spelt: Callable[[str], str] = str, columns: int = COLUMNS) -> list[str]:
    r"""Returns a panel in lines of ``columns``; ``spelt`` replaces characters that the terminal
    lacks.

    >>> from garkcli.plots.scene import Axis
    >>> squares = [(x, x * x) for x in range(-3, 4)]
    >>> shapes = [RuledLine((0, 0), (0, 9)), Curve(0, squares, has_dots=True)]
    >>> panel = Panel("", "", Axis("x", -3, 3), Axis("x squared", 0, 9), shapes, height=96)
    >>> print("\n".join(drawn(panel, columns=22)))
      x squared
      │•        │        •
      │         │
      │         │
    5 ┤   •     │     •
      │         │
      │      •  │  •
    0 ┤         •
      └─────────┬─────────
                0
                         x
    """
    return _Picture(panel, spelt, columns).lines()


class _Picture:
    def __init__(self, panel: Panel, spelt: Callable[[str], str], columns: int) -> None:
        self.panel = panel
        self.spelt: Callable[[str], str] = lambda text: spelt(printable(text))
        self.height = 2 * round(panel.height / _LINE / 2) + 1
        marks = panel.y.marks(self.height // 2 + 1)
        self.rows = {self.row(mark.at): self.spelt(mark.label) for mark in marks}
        self.margin = max(map(len, self.rows.values()), default=0)
        self.width = max(columns - self.margin - 2, _NARROWEST)
        self.columns = self.margin + 2 + self.width

    # places

    def row(self, y: float) -> int:
        axis = self.panel.y
        return round((axis.high - y) / (axis.high - axis.low) * (self.height - 1))

    def column(self, x: float) -> int:
        axis = self.panel.x
        return round((x - axis.low) / (axis.high - axis.low) * (self.width - 1))

    def inside(self) -> Iterator[tuple[int, int, float, float]]:
        x, y = self.panel.x, self.panel.y
        last = self.height - 1
        for i in range(self.height):
            up = (y.high + y.low) / 2 + (y.high - y.low) / 2 * ((last - 2 * i) / last)
            for j in range(self.width):
                yield i, j, x.low + (x.high - x.low) * j / (self.width - 1), up

    # shapes

    def cells(self) -> _Cells:
        """Returns the shapes: regions, the first on top, then rules, lines and points."""
        found: _Cells = {}
        shapes = self.panel.shapes
        areas = [x for x in shapes if isinstance(x, Area)]
        if areas:
            for i, j, x, y in self.inside():
                sign = next((sign_of(area) for area in areas if area.holds(x, y)), "")
                if sign:
                    found[i, j] = sign
        for shape in shapes:
            if isinstance(shape, RuledLine):
                self.rule(shape, found)
        curves = [x for x in shapes if isinstance(x, Curve)]
        # a reference is below what is drawn
        for curve in sorted(curves, key=lambda x: not is_straight(x)):
            if not curve.has_dots:
                found.update(self.line(curve, sign_of(curve)))
        dots: _Cells = {}
        for curve in curves:
            sign = sign_of(curve)
            for x, y in curve.points if curve.has_dots else ():
                place = self.row(y), self.column(x)
                is_free = dots.get(place, sign) == sign or not sign.isalpha()
                dots[place] = sign if is_free else SEVERAL
        found |= dots
        for shape in shapes:
            if isinstance(shape, RuledLine) and shape.label:
                self.label(shape, found)
        return found

    def rule(self, rule: RuledLine, found: _Cells) -> None:
        """Draws a thin line: above regions if it is vertical, otherwise in empty cells only."""
        curve = Curve(0, [rule.start, rule.end])
        (a, b), (c, d) = rule.start, rule.end
        sign = "│" if a == c else "─" if b == d else _STRAIGHT
        cells = self.line(curve, sign)
        found.update(cells if a == c else {x: sign for x in cells if x not in found})

    def label(self, rule: RuledLine, found: _Cells) -> None:
        text = self.spelt(rule.label)
        (a, b), (c, d) = rule.start, rule.end
        row, column = self.row((b + d) / 2), self.column((a + c) / 2)
        start = column + 2 if rule.is_right else column - 1 - len(text)
        start = min(max(start, 0), self.width - len(text))
        side = 1 if rule.is_below else -1
        for i in (row + side * k for k in (0, 1, 2, -1, -2)):
            places = [(i, start + k) for k in range(len(text))]
            if 0 <= i < self.height and not any(place in found for place in places):
                found.update(zip(places, text, strict=True))
                return

    def line(self, curve: Curve, sign: str) -> _Cells:
        """Returns the characters of a line: in each column all rows that it passes."""
        last = self.height - 1
        x, y = self.panel.x, self.panel.y
        spans: dict[int, tuple[float, float]] = {}

        def reach(column: int, place: float) -> None:
            low, high = spans.get(column, (place, place))
            spans[column] = min(low, place), max(high, place)

        places = [
            (
                (a - x.low) / (x.high - x.low) * (self.width - 1),
                (y.high - b) / (y.high - y.low) * last,
            )
            for a, b in curve.points
        ]
        for a, b in places:
            reach(round(a), b)
        for (a, b), (c, d) in pairwise(places):
            for j in range(min(round(a), round(c)), max(round(a), round(c))):
                # where the line goes from column j to the next
                part = min(max((j + 0.5 - a) / (c - a), 0.0), 1.0)
                reach(j, b + (d - b) * part)
                reach(j + 1, b + (d - b) * part)
        found = {}
        for j, (top, bottom) in spans.items():
            rows = range(max(round(top), 0), min(round(bottom), last) + 1)
            steep = _STEEP if len(rows) > 1 and sign == _DOTS[0] else sign
            found.update({(i, j): steep for i in rows if 0 <= j < self.width})
        return found

    # the frame

    def lines(self) -> list[str]:
        panel, cells, spelt = self.panel, self.cells(), self.spelt
        blank = " " * self.margin
        columns = {self.column(mark.at): mark for mark in panel.x.marks(max(self.width // 7, 2))}
        lines = folded(spelt(panel.note), self.columns, "") if panel.note else []
        lines.append(f"{blank} {spelt(panel.y.label)}")
        for i in range(self.height):
            inside = "".join(cells.get((i, j), " ") for j in range(self.width))
            axis = "┤" if i in self.rows else "│"
            lines.append(f"{self.rows.get(i, ''):>{self.margin}} {axis}{inside}".rstrip())
        below = "".join("┬" if j in columns else "─" for j in range(self.width))
        lines += [f"{blank} └{below}", self.below(columns)]
        lines.append(f"{spelt(panel.x.label):>{self.columns}}")
        return [*lines, *self.legend(cells)]

    def below(self, columns: Mapping[int, Mark]) -> str:
        line = ""
        for j, mark in sorted(columns.items()):
            text = self.spelt(mark.label)
            start = self.margin + 2 + j - len(text) // 2
            start = min(start, self.columns - len(text))
            if start > len(line) or not line:
                line += " " * (start - len(line)) + text
        return line

    def legend(self, cells: _Cells) -> list[str]:
        named = [x for x in self.panel.legend if x.label != sign_of(x)]
        # a dot alone is a dot in ASCII, and between blanks a product
        signs = [self.spelt(sign_of(x)) for x in named]
        labels = [self.spelt(shortened(x.label, self.columns - 2)) for x in named]
        texts = [f"{sign} {label}" for sign, label in zip(signs, labels, strict=True)]
        if SEVERAL in cells.values():
            texts.append(f"{SEVERAL} several")
        lines: list[str] = []
        for text in texts:
            if lines and len(lines[-1]) + 3 + len(text) <= self.columns:
                lines[-1] += f"   {text}"
            else:
                lines.append(text)
        return lines


def is_straight(curve: Curve) -> bool:
    return len(curve.points) == 2 and not curve.has_dots


def sign_of(shape: Curve | Area) -> str:
    """Returns the character of a shape: its one-letter label, or that of its style."""
    if isinstance(shape, Area):
        return _PALE if shape.style is None else _FILLED[shape.style % len(_FILLED)]
    if len(shape.label) == 1:
        return shape.label
    return _STRAIGHT if is_straight(shape) else _DOTS[shape.style % len(_DOTS)]
