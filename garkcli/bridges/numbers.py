"""Exact numbers as texts of a language: integers, fractions, decimals, radicals."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Context, Decimal, Inexact

from flint import fmpq

from garkcli.bridges.rounding import nearest_float, quotient, rounded
from garkcli.exact.field import Algebraic
from garkcli.frozen import Frozen
from garkcli.tableau.pointwise import Cell

FLOAT_DIGITS = 17
"""Digits for a binary64 number, written with the fewest that restore it."""
EXACT_IN_FLOATS = 2**53
"""Largest integer up to which all are binary64 numbers, so that a quotient is rounded once."""
MOST_ZEROS = 5
"""Decimals with more zeros after the point are written with an exponent."""


class Style(Frozen):
    """The format of numbers in a language.

    Attributes:
        longest: decimals that end within so many digits are written in full; 0 for none.
        decimal: the text around a decimal ``{x}``.
        fraction: the text of a fraction, with ``{p}`` and ``{q}``; empty for decimals instead.
        largest: the largest numerator and denominator of fractions.
        exponent: the letter before the power of ten.
        point: whether integers have a point: ``1.0``.
    """

    digits: int = FLOAT_DIGITS
    longest: int = 0
    decimal: str = "{x}"
    fraction: str = ""
    is_fraction_first: bool = False
    largest: int = EXACT_IN_FLOATS
    irrational: Callable[[Algebraic], str] | None = None
    exponent: str = "e"
    point: bool = True

    def text(self, x: Cell, digits: int | None = None) -> str:
        """Writes a number; with ``digits`` fractions become decimals."""
        if digits is not None:
            return self._decimal(x, digits, is_short=False)
        if isinstance(x, Algebraic) and self.irrational is not None:
            return self.irrational(x)
        if isinstance(x, fmpq):
            rational = self._rational(x)
            if rational:
                return rational
        return self._decimal(x, self.digits, self.digits == FLOAT_DIGITS)

    def _rational(self, x: fmpq) -> str:
        """An integer, a decimal that ends, or a fraction; empty if it must be rounded."""
        if x.q == 1 and abs(x.p) <= self.largest:
            return self._around(f"{x}.0" if self.point else str(x))
        p, q = int(x.p), int(x.q)
        may_divide = bool(self.fraction) and max(abs(p), q) <= self.largest
        fraction = self.fraction.format(p=p, q=q) if may_divide else ""
        if self.is_fraction_first and fraction:
            return fraction
        ends = ending(x)
        if ends is None:
            return fraction
        places = len(_digits(ends))
        if places <= self.digits or (not fraction and places <= self.longest):
            return self._around(self.laid_out(ends))
        return fraction

    def _decimal(self, x: Cell, digits: int, is_short: bool) -> str:
        nearest = Decimal(repr(nearest_float(x))) if is_short else rounded(x, digits)
        return self._around(self.laid_out(nearest))

    def _around(self, text: str) -> str:
        return self.decimal.format(x=text)

    def laid_out(self, x: Decimal) -> str:
        """A decimal without zeros at its end.

        >>> Style().laid_out(Decimal("-.1250")), Style().laid_out(Decimal("125e-10"))
        ('-0.125', '1.25e-8')
        """
        digits, whole = _digits(x), "0" if self.point else ""
        # the digits before the point, counted from the first one
        before = x.adjusted() + 1
        if not x or -MOST_ZEROS < before <= max(len(digits), FLOAT_DIGITS):
            text, _, rest = f"{x:f}".partition(".")
            rest = rest.rstrip("0") or whole
            return f"{text}.{rest}" if rest else text
        sign, rest = "-" if x < 0 else "", digits[1:] or whole
        return f"{sign}{digits[0]}{'.' if rest else ''}{rest}{self.exponent}{before - 1}"


def _digits(x: Decimal) -> str:
    return "".join(map(str, x.as_tuple().digits)).rstrip("0")


def ending(x: fmpq) -> Decimal | None:
    """The exact decimal of a fraction; None if it does not end.

    >>> ending(fmpq(-1, 8)), ending(fmpq(1, 3)), ending(fmpq(300))
    (Decimal('-0.125'), None, Decimal('300'))
    """
    # p/q with q = 2^a 5^b has at most a + b digits behind the point
    room = int(x.p).bit_length() + int(x.q).bit_length() + 1
    try:
        return quotient(x, Context(room, traps=[Inexact]))
    except Inexact:
        return None


EXACT = Style(
    longest=1000,
    fraction="{p}/{q}",
    is_fraction_first=True,
    largest=10**4000,
    irrational=str,
    point=False,
)
PYTHON = Style(longest=100, fraction="{p}/{q}", point=False)
"""Python and MATLAB round the quotient of two integers, and a decimal of any length, once."""
DECIMALS = Style()
"""Floats of languages that round both integers before they divide."""


def c_style(macro: str) -> Style:
    """A quotient of integers of the type is right in every precision; binary128 needs 36 digits."""
    return Style(
        digits=36,
        longest=100,
        fraction=f"{macro}({{p}}.0) / {macro}({{q}}.0)",
        decimal=f"{macro}({{x}})",
    )
