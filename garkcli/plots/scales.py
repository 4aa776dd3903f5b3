"""Axes of pictures: where their marks are, and how numbers are written there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

_STEPS = (1, 2, 5, 10)
"""What marks are apart, times powers of ten."""
_DIGITS = (1, 2, 5)
"""Of numbers between powers of ten."""
_FEW_DECADES = 0.5
_FLOATS = 290
"""Decades."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


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
