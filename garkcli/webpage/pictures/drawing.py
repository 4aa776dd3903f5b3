"""SVG in the colours of the page it stands in.

Text, axes and marks have the colour of the text around them. Curves have the colours --picture-1 to
--picture-4 of the page, which STYLE sets for light and dark backgrounds; they differ in dashes too,
so that they can be told apart in grey. There are no ids: any number of pictures fit on a page.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import TypeAlias

from garkcli.errors import printable
from garkcli.webpage.pictures.scales import Mark, Scale

WIDTH = 360
"""Of a picture, in units of which a letter is 12 high: about those of a phone."""
LEFT, RIGHT, TOP, BOTTOM = 58, 12, 10, 40
"""Around the frame: numbers and a label on the left and below."""
INSIDE = WIDTH - LEFT - RIGHT
COLOURS = ("#24558f", "#a02417", "#35702f", "#76439a")
"""Of clearly different lightness from white, at least 4.5 to 1."""
_DARK_COLOURS = ("#8ab8f5", "#ff9d8c", "#8fd08a", "#d3a6f2")
DASHES = ("", "7 3", "2 2.5", "8 2.5 2 2.5")
_LEGEND_ROW = 18
_LONGEST = 46  # characters of a name
Point: TypeAlias = tuple[float, float]


def _variables(colours: Sequence[str]) -> str:
    numbered = enumerate(colours, start=1)
    return ";".join(f"--picture-{k}:{colour}" for k, colour in numbered)


def _style() -> str:
    light, dark = _variables(COLOURS), _variables(_DARK_COLOURS)
    return (
        f":root{{{light}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"
        "svg.plot{display:block;width:100%;max-width:30rem;height:auto}\n"
    )


STYLE = _style()
"""What a page with pictures has among its styles."""


def colour(k: int) -> str:
    """The colour of the k-th curve."""
    number = k % len(COLOURS)
    return f"var(--picture-{number + 1},{COLOURS[number]})"


def dashes(k: int) -> str:
    """The attribute with the dashes of the k-th curve."""
    pattern = DASHES[k % len(DASHES)]
    return f' stroke-dasharray="{pattern}"' if pattern else ""


def path_of(points: Iterable[Point]) -> str:
    """A polygon or polyline as the data of a path, to a tenth of a unit.

    >>> path_of([(0, 1.26), (2, -0.01)])
    'M0 1.3L2 0'
    """
    pairs = [f"{number(x)} {number(y)}" for x, y in points]
    joined = "L".join(pairs)
    return f"M{joined}"


def number(x: float) -> str:
    """A length to a tenth of a unit."""
    tenths = f"{x:.1f}".removesuffix(".0")
    return "0" if tenths == "-0" else tenths


def shortened(name: str) -> str:
    """A name from outside on one line of a legend."""
    shown = printable(name)
    if len(shown) <= _LONGEST:
        return shown
    return shown[: _LONGEST - 1] + "…"


def text(x: float, y: float, words: str, more: str = "") -> str:
    """Words at a place."""
    place = f'x="{number(x)}" y="{number(y)}"'
    return f"<text {place}{more}>{escape(words)}</text>"


@dataclass(frozen=True)
class Frame:
    """The axes of a picture, and what is drawn between them.

    Attributes:
        x, y: the scales, in units of the picture.
        inside: elements between the axes, cut off there.
        legend: the curves by their numbers, with their names.
    """

    x: Scale
    y: Scale
    inside: list[str] = field(default_factory=list)
    legend: list[tuple[int, str]] = field(default_factory=list)

    @staticmethod
    def of(
        horizontal: tuple[float, float],
        vertical: tuple[float, float],
        height: float,
        width: float = INSIDE,
    ) -> Frame:
        """A frame for numbers between these ends, in the middle of the picture."""
        left = LEFT + (INSIDE - width) / 2
        x = Scale(*horizontal, left, left + width)
        y = Scale(*vertical, TOP + height, TOP)
        return Frame(x, y)

    def place(self, points: Iterable[Point]) -> list[Point]:
        """Where points are in the picture."""
        return [(self.x(a), self.y(b)) for a, b in points]

    def draw(self, element: str) -> None:
        """Add an element."""
        self.inside.append(element)

    def curve(self, k: int, points: Iterable[Point], width: float) -> None:
        """The k-th curve."""
        data = path_of(self.place(points))
        style = f'style="stroke:{colour(k)}" stroke-width="{width:g}"'
        self.draw(f'<path d="{data}" fill="none" {style}{dashes(k)}/>')

    def dots(self, k: int, points: Iterable[Point], radius: float) -> None:
        """Dots at points of the k-th curve."""
        for x, y in self.place(points):
            place = f'cx="{number(x)}" cy="{number(y)}" r="{radius:g}"'
            self.draw(f'<circle {place} style="fill:{colour(k)}"/>')

    def polygon(self, corners: Iterable[Point], paint: str) -> None:
        """A filled polygon."""
        data = path_of(self.place(corners))
        self.draw(f'<path d="{data}Z" {paint}/>')

    def line(self, start: Point, end: Point, more: str = "") -> None:
        """A thin line, such as an axis through 0."""
        data = path_of(self.place([start, end]))
        self.draw(f'<path d="{data}" stroke="currentColor"{more}/>')

    def finished(
        self,
        title: str,
        description: str,
        marks: tuple[Sequence[Mark], Sequence[Mark]],
        labels: tuple[str, str],
    ) -> str:
        """The whole picture.

        Args:
            title: its name.
            description: what it shows, for those who do not see it.
            marks: on the horizontal and on the vertical axis.
            labels: of the horizontal and of the vertical axis.
        """
        bottom = self.y.start + BOTTOM
        height = bottom + _LEGEND_ROW * len(self.legend)
        lines = [
            f'<svg class="plot" role="img" viewBox="0 0 {WIDTH} {number(height)}" '
            'font-size="12" fill="currentColor" stroke-linejoin="round">',
            f"<title>{escape(title)}</title>",
            f"<desc>{escape(description)}</desc>",
            *self._axes(*marks),
            *self._labels(*labels),
            *self._cut_off(),
            *self._legend_rows(bottom),
            "</svg>",
        ]
        return "\n".join(lines)

    def _axes(self, across: Sequence[Mark], up: Sequence[Mark]) -> list[str]:
        left, right = self.x.start, self.x.end
        bottom, top = self.y.start, self.y.end
        corners = [(left, top), (left, bottom), (right, bottom), (right, top)]
        rules = []
        words = []
        for mark in across:
            x = self.x(mark.at)
            rules.append(path_of([(x, bottom), (x, bottom + 4)]))
            words.append(
                text(x, bottom + 16, mark.label, ' text-anchor="middle"')
            )
        for mark in up:
            y = self.y(mark.at)
            rules.append(path_of([(left - 4, y), (left, y)]))
            words.append(text(left - 7, y + 4, mark.label, _AT_END))
        frame = path_of(corners) + "Z"
        data = frame + "".join(rules)
        return [
            f'<path d="{data}" fill="none" stroke="currentColor"/>',
            *words,
        ]

    def _labels(self, below: str, beside: str) -> list[str]:
        middle = (self.x.start + self.x.end) / 2
        height = (self.y.start + self.y.end) / 2
        x = self.x.start - LEFT + 12
        centre = f"{number(x)} {number(height)}"
        turned = f' text-anchor="middle" transform="rotate(-90 {centre})"'
        return [
            text(middle, self.y.start + 33, below, ' text-anchor="middle"'),
            text(x, height, beside, turned),
        ]

    def _cut_off(self) -> list[str]:
        """A nested picture cuts off what is outside of it, and needs no id for that."""
        left, top = self.x.start, self.y.end
        width, height = self.x.end - left, self.y.start - top
        place = [number(x) for x in (left, top, width, height)]
        box = " ".join(place)
        at = f'x="{place[0]}" y="{place[1]}" width="{place[2]}" height="{place[3]}"'
        return [f'<svg {at} viewBox="{box}">', *self.inside, "</svg>"]

    def _legend_rows(self, top: float) -> list[str]:
        rows = []
        for i, (k, name) in enumerate(self.legend):
            y = top + i * _LEGEND_ROW + 6
            data = path_of([(LEFT - 46, y), (LEFT - 12, y)])
            style = f'style="stroke:{colour(k)}" stroke-width="2"'
            rows.append(f'<path d="{data}" {style}{dashes(k)}/>')
            rows.append(text(LEFT - 4, y + 4, shortened(name)))
        return rows


_AT_END = ' text-anchor="end"'
