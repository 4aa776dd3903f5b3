"""What a picture shows, in the coordinates of its axes; ``terminal``, ``svg`` and ``figure`` draw.

Curves and areas have a style, a number: of a colour, of dashes and of marks, so that they can be
distinguished in grey too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from math import ceil, floor, log10
from typing import TypeAlias

from garkcli.errors import printable
from garkcli.frozen import Frozen

_STEPS = (1, 2, 5, 10)
"""What marks are apart, times powers of ten."""
_DIGITS = (1, 2, 5)
"""Of numbers between powers of ten."""
_FEW_DECADES = 0.5
_FLOATS = 290
"""Decades."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Mark(Frozen):
    """A mark on an axis, and its label."""

    at: float
    label: str


def linear_marks(low: float, high: float, most: int) -> list[Mark]:
    """Round numbers between the ends, about ``most`` of them at most.

    >>> [mark.label for mark in linear_marks(-4.2, 4.2, 5)]
    ['−4', '−2', '0', '2', '4']
    """
    step = _round_step((high - low) / most)
    # an end that rounding has put just beside a mark has it
    first = ceil(low / step - 1e-9)
    last = floor(high / step + 1e-9)
    marks = []
    for k in range(first, last + 1):
        at = k * step
        marks.append(Mark(at, f"{at:.6g}".replace("-", "−")))
    return marks


def _round_step(least: float) -> float:
    power = 10.0 ** floor(log10(least))
    enough = least * (1 - 1e-9)
    steps = (step * power for step in _STEPS)
    return next((step for step in steps if step >= enough), 10 * power)


def logarithmic_marks(low: float, high: float, most: int) -> list[Mark]:
    """Powers of ten between decimal logarithms, evenly apart, with round numbers between them where
    there is space.

    >>> [mark.label for mark in logarithmic_marks(-6.5, -1.5, 3)]
    ['10⁻⁶', '10⁻⁴', '10⁻²']
    >>> [mark.label for mark in logarithmic_marks(-1.4, 0.1, 6)]
    ['0.05', '0.1', '0.2', '0.5', '1']
    """
    first = ceil(low - 1e-9)
    last = floor(high + 1e-9)
    if high - low < _FEW_DECADES and max(-low, high) < _FLOATS:
        return [Mark(log10(x.at), x.label) for x in linear_marks(10**low, 10**high, most)]
    between = [
        Mark(k + log10(digit), _rounded(digit, k))
        for k in range(first - 1, last + 1)
        for digit in _DIGITS
    ]
    fitting = [mark for mark in between if low - 1e-9 <= mark.at <= high + 1e-9]
    if len(fitting) <= most:
        return fitting
    apart = max(1, ceil((last - first + 1) / most))
    return [Mark(k, power_of_ten(k)) for k in range(first, last + 1, apart)]


def _rounded(digit: int, exponent: int) -> str:
    """The number of one digit, with a power of ten where it is large or small."""
    if -3 <= exponent <= 3:
        return f"{digit * 10.0**exponent:g}"
    return power_of_ten(exponent) if digit == 1 else f"{digit}·{power_of_ten(exponent)}"


def power_of_ten(exponent: int) -> str:
    """10 to a power, with raised digits."""
    raised = str(exponent).translate(_SUPERSCRIPTS)
    return f"10{raised}"


def in_words(measured: str) -> str:
    """A measured number as people write it, on one line; words stay as they are.

    >>> in_words("5.9e-06"), in_words("-2e+01"), in_words("below round-off")
    ('5.9·10⁻⁶', '−2·10¹', 'below round-off')
    """
    mantissa, mark, exponent = measured.partition("e")
    if not mark or not mantissa.removeprefix("-").replace(".", "").isdigit():
        return measured
    return f"{mantissa}·{power_of_ten(int(exponent))}".replace("-", "−")


def common_exponent(numbers: Sequence[float]) -> int:
    """The decimal exponent of the largest of some numbers; 0 where all are of usual size.

    >>> common_exponent([2e-7, -3.1e-6]), common_exponent([0.5, 20]), common_exponent([0])
    (-6, 0, 0)
    """
    largest = max(map(abs, numbers))
    if largest == 0:
        return 0
    exponent = floor(log10(largest))
    return 0 if -2 <= exponent <= 3 else max(exponent, -_FLOATS)


Point: TypeAlias = tuple[float, float]
COLOURS = ("#24558f", "#a02417", "#35702f", "#76439a", "#8a6d1a", "#30777a", "#1d1f24", "#8c8c8c")
"""By style, on white; all but the last at least 4.5 to 1."""
DASHES: tuple[tuple[float, ...], ...] = (
    (),
    (7, 3),
    (2, 2.5),
    (8, 2.5, 2, 2.5),
    (12, 3),
    (8, 2, 2, 2, 2, 2),
    (1.5, 4),
    (4, 1.5),
)
"""By style: lengths of dashes and of gaps, in units of a picture."""
WIDTH = 360
"""Of a picture, in units of which a letter is 12 high: about those of a phone."""


class Axis(Frozen):
    """An axis from ``low`` to ``high``.

    Attributes:
        label: what it shows.
        low, high: its ends, not equal.
        is_logarithmic: whether coordinates are decimal logarithms of the numbers.
        given: the marks on it; none for round numbers.
    """

    label: str
    low: float
    high: float
    is_logarithmic: bool = False
    given: Sequence[Mark] = ()

    @staticmethod
    def around(
        label: str,
        coordinates: Iterable[float],
        is_logarithmic: bool = False,
        given: Sequence[Mark] = (),
    ) -> Axis:
        """An axis with a twentieth of its length beside the coordinates on both sides."""
        found = [*coordinates] or [0.0]
        low, high = min(found), max(found)
        beside = 0.05 * (high - low) or 0.5
        return Axis(label, low - beside, high + beside, is_logarithmic, given)

    def marks(self, most: int) -> Sequence[Mark]:
        """Marks with labels, about ``most`` of them at most."""
        if self.given:
            return self.given
        make = logarithmic_marks if self.is_logarithmic else linear_marks
        return make(self.low, self.high, most)


class Curve(Frozen):
    """Points, and lines between them.

    Attributes:
        style: a number from 0.
        points: from the first to the last.
        label: in the legend; empty for none.
        has_dots: whether the points are marked.
        has_line: whether there are lines between them.
        width: of the lines.
        is_dense: whether they may fill a band, which is pale on white paper, so that other lines
            can be seen on it.
    """

    style: int
    points: Sequence[Point]
    label: str = ""
    has_dots: bool = False
    has_line: bool = True
    width: float = 1.6
    is_dense: bool = False


Loops: TypeAlias = Sequence[Sequence[Point]]
"""The corners of closed outlines, with an area on their left: those of holes turn the other way."""


class Area(Frozen):
    """A part of the picture. Every output samples it as finely as it draws.

    Attributes:
        style: that of a curve; None for the colour of text.
        holds: whether a point belongs to it.
        outlines: its outlines between two axes.
        opacity: of what is filled, from 0 to 1.
        has_outline: whether the outlines are drawn.
        label: in the legend; empty for none.
    """

    style: int | None
    holds: Callable[[float, float], bool]
    outlines: Callable[[Axis, Axis], Loops]
    opacity: float
    has_outline: bool = True
    label: str = ""


def polygons(style: int | None, loops: Loops, opacity: float, has_outline: bool = True) -> Area:
    """The area inside of outlines."""

    def holds(x: float, y: float) -> bool:
        sides = (side for loop in loops for side in pairwise([*loop, *loop[:1]]))
        return sum(_crosses(x, y, *side) for side in sides) % 2 == 1

    return Area(style, holds, lambda *_: loops, opacity, has_outline)


def _crosses(x: float, y: float, start: Point, end: Point) -> bool:
    """Whether a side lies to the right of a point."""
    (a, b), (c, d) = start, end
    return (b > y) != (d > y) and a + (c - a) * (y - b) / (d - b) > x


class Rule(Frozen):
    """A thin straight line in the colour of text.

    Attributes:
        start, end: its ends.
        label: beside its middle; empty for none.
        is_right, is_below: on which side of the middle the label is.
    """

    start: Point
    end: Point
    label: str = ""
    is_right: bool = False
    is_below: bool = False


Shape: TypeAlias = Curve | Area | Rule


class Panel(Frozen):
    """Axes and what is drawn between them.

    Attributes:
        title: its heading, a few words.
        description: what one sees, for those who do not see it.
        x, y: the horizontal and the vertical axis.
        shapes: what is drawn, the last ones on top.
        note: what is drawn, in a sentence beside it; empty for none.
        height: of the space between the axes.
        is_plane: whether the scales of both axes are alike; the height is then the largest.
        has_grid: whether there are lines at the marks where there is space for them.
    """

    title: str
    description: str
    x: Axis
    y: Axis
    shapes: Sequence[Shape]
    note: str = ""
    height: float = 200
    is_plane: bool = False
    has_grid: bool = False

    @property
    def legend(self) -> list[Curve | Area]:
        """What is named."""
        named = [shape for shape in self.shapes if not isinstance(shape, Rule)]
        return [shape for shape in named if shape.label]


class Scene(Frozen):
    """A picture in a file: panels with a common title.

    Attributes:
        title: above all.
        panels: at least one.
        is_row: whether they are side by side; otherwise they are one below the other, and share
            their horizontal axis.
    """

    title: str
    panels: Sequence[Panel]
    is_row: bool = False


def capitalized(name: str) -> str:
    """A name at the beginning of a sentence."""
    return name[:1].upper() + name[1:]


def shortened(name: str, longest: int) -> str:
    """A name from outside on one line of so many characters."""
    shown = printable(name)
    if len(shown) <= longest:
        return shown
    return f"{shown[: longest - 1]}…"
