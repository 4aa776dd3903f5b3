"""Numbers as texts: read back, they are what they were, or as near as they say."""

from __future__ import annotations

import re
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

import mpmath
import pytest
from flint import arb, fmpq
from hypothesis import assume, given
from hypothesis import strategies as st

from garkcli.exact.display import (
    decimal,
    decimal_latex,
    in_digits,
    nearest_float,
    plain_decimal,
    shortest,
    to_ball,
    to_balls,
    to_decimal,
    to_float,
    to_latex,
    to_text,
)
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_decimals

FRACTIONS = st.one_of(
    st.fractions(-50, 50, max_denominator=40),
    st.builds(
        lambda p, k, m: Fraction(p, 2**k * 5**m),
        st.integers(-(10**8), 10**8),
        st.integers(0, 12),
        st.integers(0, 12),
    ),
    st.builds(Fraction, st.integers(-(10**6), 10**6), st.integers(1, 10**7)),
)
ROOTS = st.sampled_from(["sqrt(2)", "cbrt(5)", "sqrt(1 + sqrt(3))", "sqrt(6) - cbrt(2)"])


def exact(x: Fraction) -> fmpq:
    """Of python-flint."""
    return fmpq(x.numerator, x.denominator)


def read(text: str) -> Number:
    """The value of a text of a method file."""
    expression = parse(text)
    return Domain([expression]).evaluate(expression)


def irrational(root: str, x: Fraction, y: Fraction) -> Algebraic:
    """Of the form x + y·root."""
    number = read(f"{x} + ({y})*({root})")
    assume(isinstance(number, Algebraic))
    assert isinstance(number, Algebraic)
    return number


@given(FRACTIONS)
def test_decimals_are_read_back(x: Fraction) -> None:
    """All of them, where they end; a fraction otherwise; the shortest is no longer than either."""
    number = exact(x)
    ends = _ends(x)
    for text in (plain_decimal(number), shortest(number), *([decimal(number)] if x > 0 else [])):
        assert Fraction(text) == x
    assert ("/" in plain_decimal(number)) == (not ends)
    assert len(shortest(number)) <= len(str(x))
    if ends:
        mantissa = plain_decimal(abs(number))
        whole, _, rest = mantissa.partition(".")
        assert whole == "0" or not whole.startswith("0")
        assert not mantissa.endswith(".")
        assert not rest.endswith("0")
    if ends and 0 < x < 1:
        digits, _, exponent = decimal(number).partition("e-")
        assert 1 <= float(digits) < 10
        assert int(exponent) > 0


def _ends(x: Fraction) -> bool:
    q = x.denominator
    for prime in (2, 5):
        while q % prime == 0:
            q //= prime
    return q == 1


def test_long_fractions_are_decimals_if_these_are_shorter() -> None:
    """From denominators of 1000 on, and in powers of ten below a thousandth."""
    assert (shortest(fmpq(109, 250)), shortest(fmpq(-2417, 2000))) == ("109/250", "-1.2085")
    assert shortest(fmpq(1, 8192)) == "1/8192"
    assert shortest(fmpq(9999, 10000)) == "0.9999"
    assert shortest(fmpq(-1, 10**9)) == "-1e-9"
    assert shortest(fmpq(1, 1000) + fmpq(1, 10**6)) == "0.001001"
    assert shortest(fmpq(123, 10**6)) == "1.23e-4"
    assert shortest(fmpq(1, 3**9)) == "1/19683"
    assert decimal(fmpq(1, 3)) == "1/3"
    assert decimal(fmpq(1, 2**10)) == "9.765625e-4"
    assert decimal(fmpq(7, 2)) == "3.5"
    assert decimal_latex("1.5e-7") == r"1.5 \cdot 10^{-7}"


@given(FRACTIONS, st.integers(1, 25))
def test_so_many_digits(x: Fraction, digits: int) -> None:
    """Of decimals and of balls: those of Python, to half a unit of the last."""
    assume(x)
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN)
    wanted = context.divide(Decimal(x.numerator), Decimal(x.denominator))
    unit = Fraction(10) ** (wanted.adjusted() - digits + 1)
    found = in_digits(exact(x), digits)
    assert abs(Fraction(int(found.p), int(found.q)) - x) <= unit * Fraction(51, 100)
    assert abs(Fraction(to_decimal(exact(x), digits)) - x) <= unit
    assert (found * exact(1 / unit)).q == 1


@given(ROOTS, FRACTIONS, FRACTIONS, st.integers(5, 60))
def test_irrational_numbers(root: str, x: Fraction, y: Fraction, digits: int) -> None:
    """Texts are read back; balls hold the value and have the digits; floats are the nearest."""
    assume(y)
    number = irrational(root, x, y)
    assert read(to_text(number)) == number
    assert read(shortest(number)) == number
    with mpmath.workdps(400):
        names = {
            "sqrt": mpmath.sqrt,
            "cbrt": mpmath.cbrt,
            "x": mpmath.mpf(x.numerator) / x.denominator,
            "y": mpmath.mpf(y.numerator) / y.denominator,
        }
        value = eval(f"x + y*({root})", names)
        assert nearest_float(number) == float(value)
        assert to_float(number) == pytest.approx(float(value), rel=3e-16)
        for ball in (to_ball(number, digits), to_balls([number, fmpq(1)], digits)[0]):
            assert ball.rel_accuracy_bits() >= digits * 3.32
            assert abs(mpmath.mpf(ball.mid().str(350, radius=False)) - value) < (
                abs(value) * mpmath.mpf(10) ** -digits
            )


def test_small_differences_have_their_digits() -> None:
    """√2 minus thirty of its digits, where the first enclosure has none left."""
    number = read("sqrt(2) - 1.41421356237309504880168872420")
    assert isinstance(number, Algebraic)
    assert to_decimal(number, 12).startswith("9.69807856967")
    assert nearest_float(number) == pytest.approx(9.69807856967e-30, rel=1e-11)
    ball = arb("0.5")
    assert to_ball(ball) is ball


@given(ROOTS, FRACTIONS, FRACTIONS)
def test_latex_is_worth_the_number(root: str, x: Fraction, y: Fraction) -> None:
    """Fractions, radicals and powers of them."""
    for number in (exact(x), irrational(root, x, y) if y else exact(y)):
        text = to_latex(number)
        while r"\sqrt" in text or r"\frac" in text:  # inner ones first
            before = text
            text = re.sub(r"\\sqrt\{([^{}\\]*)\}", r"sqrt(\1)", text)
            text = re.sub(r"\\sqrt\[(\d+)\]\{([^{}\\]*)\}", r"root(\2,\1)", text)
            text = re.sub(r"(?<=[)])\^\{(\d+)\}", r"**\1", text)
            text = re.sub(r"\\frac\{([^{}\\]*)\}\{(\d+)\}", r"((\1)/\2)", text)
            assert text != before
        text = re.sub(r" \\cdot 10\^\{(-?\d+)\}", r"*10**(\1)", text)
        text = re.sub(r"\^\{(\d+)\}", r"**\1", text)
        text = re.sub(r"(?<=[0-9)])(?=sqrt|root)", "*", text)
        with mpmath.workdps(30):
            names = {"sqrt": mpmath.sqrt, "root": mpmath.root}
            exact_parts = re.sub(r"(?<![\w.*])(\d+(?:\.\d+)?)(?![\w.])", r"mpf('\1')", text)
            value = eval(exact_parts, {**names, "mpf": mpmath.mpf})
            assert float(value) == pytest.approx(to_float(number), rel=1e-14, abs=1e-300)


def test_polynomials_in_decimals() -> None:
    """Coefficients are rounded, and have no zeros at the end."""
    third = Polynomial([fmpq(1), fmpq(10**30 + 1, 7 * 10**30)])
    assert polynomial_decimals(third, "z") == "0.14285714*z + 1"
    assert polynomial_decimals(Polynomial([fmpq(8), fmpq(0), fmpq(-1)]), "x") == "-x^2 + 8"
