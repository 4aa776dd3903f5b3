"""Axes and curves in the colours of the page they stand in.

Text, axes and marks have the colour of the text around them. Curves have the colours --picture-1 to
--picture-4 of the page, which STYLE sets for light and dark backgrounds; they differ in dashes too,
so that they can be told apart in grey. There are no ids: any number of pictures fit on a page.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from garkcli.errors import printable
from garkcli.webpage.pictures.elements import Point, Value, element, number, opened, path_of
from garkcli.webpage.pictures.scales import Mark, Scale

WIDTH = 360
"""Of a picture, in units of which a letter is 12 high: about those of a phone."""
LEFT, RIGHT, TOP, BOTTOM = 58, 12, 10, 40
"""Around the frame: numbers and a label on the left and below."""
INSIDE = WIDTH - LEFT - RIGHT
COLOURS = ("#24558f", "#a02417", "#35702f", "#76439a")
"""Of clearly different lightness from white, at least 4.5 to 1."""
ON_ANY = ("#2f7dc8", "#d24a3a", "#3f8f36", "#9b6ac0")
"""Of a page without STYLE, a notebook for instance, light or dark: 3 to 1 and more on both."""
_DARK_COLOURS = ("#8ab8f5", "#ff9d8c", "#8fd08a", "#d3a6f2")
DASHES = (None, "7 3", "2 2.5", "8 2.5 2 2.5")
_LEGEND_ROW = 18
_LONGEST = 46  # characters of a name


def _variables(colours: Sequence[str]) -> str:
    found = []
    for k, colour in enumerate(colours, start=1):
        found.append(f"--picture-{k}:{colour}")
    return ";".join(found)


def _style() -> str:
    light = _variables(COLOURS)
    dark = _variables(_DARK_COLOURS)
    return (
        f":root{{{light}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"
        "svg.plot{display:block;width:100%;max-width:30rem;height:auto}\n"
    )


STYLE = _style()
"""What a page with pictures has among its styles."""


def colour(k: int) -> str:
    """The colour of the k-th curve, that of the page or else one for any page."""
    place = k % len(ON_ANY)
    ours = ON_ANY[place]
    return f"var(--picture-{place + 1},{ours})"


def dashes(k: int) -> str | None:
    """The dashes of the k-th curve."""
    place = k % len(DASHES)
    return DASHES[place]


def shortened(name: str) -> str:
    """A name from outside on one line of a legend."""
    shown = printable(name)
    if len(shown) <= _LONGEST:
        return shown
    start = shown[: _LONGEST - 1]
    return f"{start}…"


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
        spare = INSIDE - width
        left = LEFT + spare / 2
        x = Scale(*horizontal, left, left + width)
        y = Scale(*vertical, TOP + height, TOP)
        return Frame(x, y)

    def place(self, points: Iterable[Point]) -> list[Point]:
        """Where points are in the picture."""
        return [(self.x(a), self.y(b)) for a, b in points]

    def path(self, data: str, **attributes: Value) -> None:
        """Draw a path."""
        drawn = element("path", None, d=data, **attributes)
        self.inside.append(drawn)

    def curve(self, k: int, points: Iterable[Point], width: float) -> None:
        """Draw the k-th curve."""
        placed = self.place(points)
        paint = colour(k)
        self.path(
            path_of(placed),
            fill="none",
            style=f"stroke:{paint}",
            stroke_width=width,
            stroke_dasharray=dashes(k),
        )

    def dots(self, k: int, points: Iterable[Point], radius: float) -> None:
        """Draw dots at points of the k-th curve."""
        paint = colour(k)
        style = f"fill:{paint}"
        for x, y in self.place(points):
            dot = element("circle", cx=x, cy=y, r=radius, style=style)
            self.inside.append(dot)

    def rectangle(self, low: Point, high: Point, **attributes: Value) -> None:
        """Draw a filled rectangle between two of its corners."""
        left, bottom = low
        right, top = high
        corners = [low, (right, bottom), high, (left, top)]
        placed = self.place(corners)
        self.path(path_of(placed) + "Z", **attributes)

    def line(self, start: Point, end: Point) -> None:
        """Draw a thin line, such as an axis through 0."""
        ends = self.place([start, end])
        self.path(path_of(ends), stroke="currentColor", stroke_width=0.7)

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
        across, up = marks
        bottom = self.y.start + BOTTOM
        rows = _LEGEND_ROW * len(self.legend)
        height = number(bottom + rows)
        head = opened(
            "svg",
            **{"class": "plot"},
            role="img",
            viewBox=f"0 0 {WIDTH} {height}",
            font_size="12",
            fill="currentColor",
            stroke_linejoin="round",
        )
        lines = [
            head,
            element("title", title),
            element("desc", description),
            *self._axis_below(across),
            *self._axis_beside(up),
            *self._labels(*labels),
            *self._cut_off(),
            *self._legend_rows(bottom),
            "</svg>",
        ]
        return "\n".join(lines)

    def _axis_below(self, marks: Sequence[Mark]) -> Iterator[str]:
        left = self.x.start
        bottom = self.y.start
        width = self.x.end - left
        height = bottom - self.y.end
        yield element(
            "rect",
            x=left,
            y=self.y.end,
            width=width,
            height=height,
            fill="none",
            stroke="currentColor",
        )
        for mark in marks:
            x = self.x(mark.at)
            yield _rule((x, bottom), (x, bottom + 4))
            yield element("text", mark.label, x=x, y=bottom + 16, text_anchor="middle")

    def _axis_beside(self, marks: Sequence[Mark]) -> Iterator[str]:
        left = self.x.start
        for mark in marks:
            y = self.y(mark.at)
            yield _rule((left - 4, y), (left, y))
            yield element("text", mark.label, x=left - 7, y=y + 4, text_anchor="end")

    def _labels(self, below: str, beside: str) -> Iterator[str]:
        middle = (self.x.start + self.x.end) / 2
        yield element("text", below, x=middle, y=self.y.start + 33, text_anchor="middle")
        left = self.x.start - LEFT + 12
        height = (self.y.start + self.y.end) / 2
        across = number(left)
        down = number(height)
        yield element(
            "text",
            beside,
            x=left,
            y=height,
            text_anchor="middle",
            transform=f"rotate(-90 {across} {down})",
        )

    def _cut_off(self) -> list[str]:
        """A nested picture cuts off what is outside of it, and needs no id for that."""
        left = self.x.start
        top = self.y.end
        width = self.x.end - left
        height = self.y.start - top
        sides = [left, top, width, height]
        box = " ".join(map(number, sides))
        head = opened("svg", x=left, y=top, width=width, height=height, viewBox=box)
        return [head, *self.inside, "</svg>"]

    def _legend_rows(self, top: float) -> Iterator[str]:
        y = top + 6
        for k, name in self.legend:
            paint = colour(k)
            yield element(
                "path",
                d=path_of([(LEFT - 46, y), (LEFT - 12, y)]),
                style=f"stroke:{paint}",
                stroke_width=2.0,
                stroke_dasharray=dashes(k),
            )
            yield element("text", shortened(name), x=LEFT - 4, y=y + 4)
            y += _LEGEND_ROW


def _rule(start: Point, end: Point) -> str:
    """A mark on an axis."""
    data = path_of([start, end])
    return element("path", d=data, stroke="currentColor")
