"""Records how numbers are computed from printed ones, so that others can recompute them."""

from __future__ import annotations

from typing import Any, TypeAlias

from flint import arb, fmpq, fmpz

Told: TypeAlias = "str | int | list[Any]"
"""A rational number as text, the index of a printed number, or [sign, left, right]."""


class Untold(ValueError):
    """A number that cannot be recomputed from rationals."""


class Trace:
    """A printed number, or an expression of ``length`` leaves. A trace is never false, so never
    taken for zero, and equal to itself alone.
    """

    __slots__ = ("length", "told")

    def __init__(self, told: Told, length: int = 1) -> None:
        self.told = told
        self.length = length

    def height_bits(self) -> int:
        """0, as the number of digits does not grow."""
        return 0

    def _joined(self, sign: str, other: Any, is_turned: bool = False) -> Trace:
        length = self.length + (other.length if isinstance(other, Trace) else 1)
        parts = [self.told, told(other)]
        return Trace([sign, *(parts[::-1] if is_turned else parts)], length)

    def __add__(self, other: Any) -> Trace:
        return self if _is_number(other, 0) else self._joined("+", other)

    __radd__ = __add__

    def __neg__(self) -> Trace:
        return self._joined("*", fmpq(-1))

    def __sub__(self, other: Any) -> Trace:
        return self if _is_number(other, 0) else self._joined("-", other)

    def __rsub__(self, other: Any) -> Trace:
        return self._joined("-", other, is_turned=True)

    def __mul__(self, other: Any) -> Any:
        if _is_number(other, 0):
            return fmpq(0)
        return self if _is_number(other, 1) else self._joined("*", other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Trace:
        return self if _is_number(other, 1) else self._joined("/", other)

    def __rtruediv__(self, other: Any) -> Trace:
        return self._joined("/", other, is_turned=True)

    def __pow__(self, exponent: int) -> Any:
        result: Any = fmpq(1)
        for _ in range(abs(exponent)):
            result = self * result
        return 1 / result if exponent < 0 else result

    def root(self, index: int) -> Trace:
        raise Untold(f"a rounded number is under a root of index {index}")


def told(number: Any) -> Told:
    """The expression of a number; Untold if it is only known as a ball.

    >>> x = Trace(1)
    >>> told(1 - x * x / 3)
    ['-', '1', ['/', ['*', 1, 1], '3']]
    """
    if isinstance(number, Trace):
        return number.told
    if isinstance(number, arb) and number.is_exact():
        mantissa, exponent = number.man_exp()
        return rational_text(fmpq(mantissa) * fmpq(2) ** int(exponent))
    if isinstance(number, (fmpq, fmpz, int)):
        return rational_text(fmpq(number))
    raise Untold("an entry is made of irrational numbers")


def rational_text(number: fmpq) -> str:
    """A fraction, or decimals without an exponent if they are shorter.

    >>> rational_text(fmpq(1, 3)), rational_text(fmpq(1, 10**6)), rational_text(fmpq(-3, 250))
    ('1/3', '0.000001', '-0.012')
    """
    text = str(number)
    if number.q < 100:
        return text
    twos, fives = _power(number.q, 2), _power(number.q, 5)
    if 2**twos * 5**fives != number.q:
        return text
    places = max(twos, fives)
    digits = str(abs(number.p) * 10**places // number.q).rjust(places + 1, "0")
    sign = "-" if number < 0 else ""
    return min(f"{sign}{digits[:-places]}.{digits[-places:]}", text, key=len)


def _power(number: fmpz, prime: int) -> int:
    times = 0
    while number % prime == 0:
        number //= prime
        times += 1
    return times


def _is_number(number: Any, value: int) -> bool:
    return not isinstance(number, Trace) and bool(number == value)
