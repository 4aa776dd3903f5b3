"""Axes of pictures: from numbers to pixels, and where the marks are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

_STEPS = (1, 2, 5, 10)
"""What marks are apart, times powers of ten."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Scale:
    """A linear scale.

    Attributes:
        low, high: the numbers at its ends, not equal.
        start, end: the pixels there; start > end on a vertical axis.
    """

    low: float
    high: float
    start: float
    end: float

    def __call__(self, x: float) -> float:
        """The pixel of a number."""
        part = (x - self.low) / (self.high - self.low)
        return self.start + part * (self.end - self.start)


@dataclass(frozen=True)
class Mark:
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
        marks.append(Mark(at, _number(at)))
    return marks


def _round_step(least: float) -> float:
    decade = floor(log10(least))
    power = 10.0**decade
    enough = least * (1 - 1e-9)
    steps = (step * power for step in _STEPS)
    return next((step for step in steps if step >= enough), 10 * power)


def _number(x: float) -> str:
    return f"{x:.6g}".replace("-", "−")


def decade_marks(low: float, high: float, most: int) -> list[Mark]:
    """Powers of ten between decimal logarithms, evenly apart.

    >>> [mark.label for mark in decade_marks(-6.5, -1.5, 3)]
    ['10⁻⁶', '10⁻⁴', '10⁻²']
    """
    first = ceil(low - 1e-9)
    last = floor(high + 1e-9)
    count = last - first + 1
    apart = max(1, ceil(count / most))
    chosen = range(first, last + 1, apart)
    return [Mark(k, power_of_ten(k)) for k in chosen]


def power_of_ten(exponent: int) -> str:
    """10 to a power, with raised digits."""
    raised = str(exponent).translate(_SUPERSCRIPTS)
    return f"10{raised}"


def in_words(measured: str) -> str:
    """A measured number as people write it, on one line; words stay as they are.

    >>> in_words("5.9e-06"), in_words("below round-off")
    ('5.9·10⁻⁶', 'below round-off')
    """
    mantissa, mark, exponent = measured.partition("e")
    if not mark or not mantissa.replace(".", "").isdigit():
        return measured
    return f"{mantissa}·{power_of_ten(int(exponent))}"


def common_exponent(numbers: Sequence[float]) -> int:
    """The decimal exponent of the largest of some numbers; 0 where all are of usual size.

    >>> common_exponent([2e-7, -3.1e-6]), common_exponent([0.5, 20]), common_exponent([0])
    (-6, 0, 0)
    """
    largest = max(map(abs, numbers))
    if largest == 0:
        return 0
    exponent = floor(log10(largest))
    return 0 if -2 <= exponent <= 3 else exponent
