"""Numbers of exported files: correctly rounded, by a second way of computing each."""

from __future__ import annotations

from decimal import Context, Decimal
from fractions import Fraction

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.bridges.numbers import EXACT, Style, ending
from garkcli.bridges.rounding import TooWide, nearest_float, rounded, significant
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number

FRACTIONS = st.fractions(max_denominator=10**30)


def number(text: str) -> Number:
    """An exact number from its text."""
    expression = parse(text)
    return Domain([expression]).evaluate(expression)


@given(FRACTIONS, st.integers(1, 60))
def test_decimals_are_those_of_whole_numbers(x: Fraction, digits: int) -> None:
    """Whole numbers, divided by hand with one rounding, half to even, say the same."""
    power = 0
    while x and abs(x) * Fraction(10) ** power < 10 ** (digits - 1):
        power += 1
    while abs(x) * Fraction(10) ** power >= 10**digits:
        power -= 1
    wanted = Decimal(round(x * Fraction(10) ** power)).scaleb(-power, Context(200))
    assert significant(fmpq(x.numerator, x.denominator), digits) == wanted


@given(FRACTIONS)
def test_floats_are_the_nearest(x: Fraction) -> None:
    """No float is nearer than the one that is written, and the text brings it back."""
    q = fmpq(x.numerator, x.denominator)
    found = nearest_float(q)
    assert found == float(x)
    assert float(Style().text(q)) == found


def test_half_way_goes_to_even() -> None:
    """Exact ties, on both sides and with a carry into a new digit."""
    assert significant(fmpq(25, 100), 1) == Decimal("0.2")
    assert significant(fmpq(35, 100), 1) == Decimal("0.4")
    assert significant(fmpq(-9995, 10), 3) == -1000


@pytest.mark.parametrize("digits", [1, 17, 36, 100, 1000])
def test_radicals_are_rounded_correctly(digits: int) -> None:
    """The decimal of an irrational number is within half a unit of it, by integer square roots."""
    found = rounded(number("sqrt(2)/3"), digits)
    half = Fraction(10) ** found.as_tuple().exponent / 2
    low, high = Fraction(found) - half, Fraction(found) + half
    assert low**2 < Fraction(2, 9) < high**2
    assert len(found.as_tuple().digits) == digits


def test_nines_take_more_digits() -> None:
    """A radical whose rounding only digits far behind decide: sqrt(10^60 + 1)/10^30."""
    x = number("sqrt(10**60 + 1)/10**30")
    assert rounded(x, 17) == 1
    assert Fraction(rounded(x, 62)) == 1 + Fraction(5, 10**61)
    assert nearest_float(x) == 1.0


def test_an_enclosure_that_is_too_wide_is_told() -> None:
    """Nothing is rounded by the middle of a ball."""
    before = ctx.prec
    ctx.prec = 30
    try:
        third = arb(1) / 3
        assert rounded(third, 5) == Decimal("0.33333")
        with pytest.raises(TooWide):
            rounded(third, 17)
    finally:
        ctx.prec = before


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_the_shortest_decimal_is_laid_out(x: float) -> None:
    """However it is written, a float comes back from its text."""
    assert float(Style().laid_out(Decimal(repr(x)))) == x


@given(FRACTIONS)
def test_exact_text_loses_nothing(x: Fraction) -> None:
    """It is the fraction again."""
    assert Fraction(EXACT.text(fmpq(x.numerator, x.denominator))) == x


@given(st.integers(-(10**20), 10**20), st.integers(0, 30))
def test_decimals_that_end_are_found(p: int, places: int) -> None:
    """A whole number over a power of ten has such a decimal."""
    found = ending(fmpq(p, 10**places))
    assert found is not None
    assert Fraction(found) == Fraction(p, 10**places)


def test_styles() -> None:
    """Whole numbers, fractions, ends and roundings as a language has them."""
    style = Style(digits=36, fraction="{p}.0/{q}.0", decimal="R({x})")
    third, eighth = fmpq(1, 3), fmpq(1, 8)
    assert style.text(fmpq(2)) == "R(2.0)"
    assert style.text(third) == "1.0/3.0"
    assert style.text(eighth) == "R(0.125)"
    assert style.text(third, 5) == "R(0.33333)"
    assert style.text(fmpq(1, 3**40)) == ("R(8.22526333996995908128205840060725024e-20)")
    assert Style().text(fmpq(0)) == "0.0"
