"""The content of pictures in the coordinates of their axes. The style of a shape is a number that
selects a colour, dashes and marks, so that they can be distinguished in grey too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from math import ceil, floor, log10
from typing import TypeAlias

from garkcli.errors import printable
from garkcli.frozen import Frozen

_STEPS = (1, 2, 5, 10)
"""Distances between marks, times powers of ten."""
_DIGITS = (1, 2, 5)
"""Digits of marks between powers of ten."""
_FEW_DECADES = 0.5
_FLOATS = 290
"""The range of floats in decades."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Mark(Frozen):
    at: float
    label: str


def linear_marks(low: float, high: float, most: int) -> list[Mark]:
    """Returns about ``most`` round numbers between the ends.

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
    """Returns powers of ten at equal distances, with round numbers between them if there is space.

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
    if -3 <= exponent <= 3:
        return f"{digit * 10.0**exponent:g}"
    return power_of_ten(exponent) if digit == 1 else f"{digit}·{power_of_ten(exponent)}"


def power_of_ten(exponent: int) -> str:
    raised = str(exponent).translate(_SUPERSCRIPTS)
    return f"10{raised}"


def in_words(measured: str) -> str:
    """Returns a measured number with a power of ten; words stay as they are.

    >>> in_words("5.9e-06"), in_words("-2e+01"), in_words("below round-off")
    ('5.9·10⁻⁶', '−2·10¹', 'below round-off')
    """
    mantissa, mark, exponent = measured.partition("e")
    if not mark or not mantissa.removeprefix("-").replace(".", "").isdigit():
        return measured
    return f"{mantissa}·{power_of_ten(int(exponent))}".replace("-", "−")


def common_exponent(numbers: Sequence[float]) -> int:
    """Returns the decimal exponent of the largest number; 0 for numbers of common size."""
    largest = max(map(abs, numbers))
    if largest == 0:
        return 0
    exponent = floor(log10(largest))
    return 0 if -2 <= exponent <= 3 else max(exponent, -_FLOATS)


Point: TypeAlias = tuple[float, float]
COLOURS = ("#24558f", "#a02417", "#35702f", "#76439a", "#8a6d1a", "#30777a", "#1d1f24", "#8c8c8c")
"""By style, on white; contrast at least 4.5 to 1 except for the last."""
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
"""By style: lengths of dashes and gaps."""
WIDTH = 360
"""The width of a picture, about that of a phone: a letter is 12 high."""


class Axis(Frozen):
    """An axis, of decimal logarithms if ``is_logarithmic``; ``given`` replaces round marks."""

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
        """Returns an axis that extends the coordinates by a twentieth on both sides."""
        found = [*coordinates] or [0.0]
        low, high = min(found), max(found)
        beside = 0.05 * (high - low) or 0.5
        return Axis(label, low - beside, high + beside, is_logarithmic, given)

    def marks(self, most: int) -> Sequence[Mark]:
        if self.given:
            return self.given
        make = logarithmic_marks if self.is_logarithmic else linear_marks
        return make(self.low, self.high, most)


class Curve(Frozen):
    """A curve through points; if ``is_dense`` it is pale, so that other lines are visible on it."""

    style: int
    points: Sequence[Point]
    label: str = ""
    has_dots: bool = False
    has_line: bool = True
    width: float = 1.6
    is_dense: bool = False


Loops: TypeAlias = Sequence[Sequence[Point]]
"""Corners of closed outlines with the region on their left."""


class Area(Frozen):
    """A region; ``style`` is None for the colour of text, ``outlines`` are within two axes."""

    style: int | None
    holds: Callable[[float, float], bool]
    outlines: Callable[[Axis, Axis], Loops]
    opacity: float
    has_outline: bool = True
    label: str = ""


def polygons(style: int | None, loops: Loops, opacity: float, has_outline: bool = True) -> Area:
    def holds(x: float, y: float) -> bool:
        sides = (side for loop in loops for side in pairwise([*loop, *loop[:1]]))
        return sum(_crosses(x, y, *side) for side in sides) % 2 == 1

    return Area(style, holds, lambda *_: loops, opacity, has_outline)


def _crosses(x: float, y: float, start: Point, end: Point) -> bool:
    (a, b), (c, d) = start, end
    return (b > y) != (d > y) and a + (c - a) * (y - b) / (d - b) > x


class RuledLine(Frozen):
    """A thin straight line; the label is to the right of its middle, or below, as these say."""

    start: Point
    end: Point
    label: str = ""
    is_right: bool = False
    is_below: bool = False


Shape: TypeAlias = Curve | Area | RuledLine


class Panel(Frozen):
    """Axes and the shapes between them, the last ones on top. ``description`` is for screen
    readers. In a plane the scales of both axes are equal, and ``height`` is the largest height.
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
        named = [shape for shape in self.shapes if not isinstance(shape, RuledLine)]
        return [shape for shape in named if shape.label]


class Scene(Frozen):
    title: str
    panels: Sequence[Panel]
    is_row: bool = False


def capitalized(name: str) -> str:
    return name[:1].upper() + name[1:]


def shortened(name: str, longest: int) -> str:
    shown = printable(name)
    if len(shown) <= longest:
        return shown
    return f"{shown[: longest - 1]}…"
