"""Exact number to text, LaTeX, decimals and floats."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.exact.enclosing import enclose
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.parametric import Parametric
from garkcli.exact.rewriting import decimal_latex

_LONG_DENOMINATOR = 1000
_SMALL = fmpq(1, 1000)

BITS_OF_A_DIGIT = 3.33
"""Bits of a decimal digit, log2(10) rounded up."""
LOG10_2 = fmpq(30103, 100000)
DIGITS_OF_A_BIT = 0.302
"""Decimal digits of a bit, log10(2) rounded up."""


def to_text(number: Number) -> str:
    return str(number)


def shortest(number: Number) -> str:
    """The number as people read it: decimals for long fractions if all of them are shorter.

    >>> shortest(fmpq(732233047, 2500000000)), shortest(fmpq(1, 20)), shortest(fmpq(1, 30000))
    ('0.2928932188', '1/20', '1/30000')
    """
    if isinstance(number, Algebraic):
        text = ""
        for coefficient, word in number.terms():
            size = _short_decimal(abs(coefficient))
            text += f" {'-' if coefficient < 0 else '+'} {number.term(coefficient, word, size)}"
        return "-" + text[3:] if text.startswith(" -") else text[3:]
    text = to_text(number)
    if isinstance(number, fmpq) and (decimals := _short_decimal(abs(number))):
        return f"-{decimals}" if number < 0 else decimals
    return text


def _short_decimal(size: fmpq) -> str:
    """The decimals of a positive fraction; empty unless all of them are shorter than it."""
    if size.q < _LONG_DENOMINATOR:
        return ""
    decimals = decimal(size) if size < _SMALL else plain_decimal(size)
    return decimals if len(decimals) < len(str(size)) else ""


def to_latex(number: Number | Parametric) -> str:
    r"""The number in LaTeX, for instance ``\frac{1}{2}-\frac{\sqrt{3}}{6}``."""
    if isinstance(number, Parametric):
        return number.latex()
    if not isinstance(number, Algebraic):
        text = shortest(number)
        return decimal_latex(text) if "." in text else _latex_term(number, "").removeprefix("+")
    text = ""
    for coefficient, word in number.terms():
        factors = ""
        for radical, power in number.field.powers(word, latex=True):
            factors += f"{radical}^{{{power}}}" if power > 1 else radical
        text += _latex_term(coefficient, factors)
    return text.removeprefix("+")


def _latex_term(coefficient: fmpq, factors: str) -> str:
    sign = "-" if coefficient < 0 else "+"
    numerator = abs(coefficient.p)
    top = f"{numerator}{factors}"
    if factors and numerator == 1:
        top = factors
    if coefficient.q == 1:
        return sign + top
    return rf"{sign}\frac{{{top}}}{{{coefficient.q}}}"


def to_balls(numbers: Iterable[Number], digits: int) -> list[arb]:
    """Encloses numbers; equal irrational ones once."""
    known: dict[Algebraic, arb] = {}
    balls = []
    with ctx.workprec(_bits(digits) + 32):
        for number in numbers:
            if not isinstance(number, Algebraic):
                balls.append(arb(number))
                continue
            if number not in known:
                known[number] = to_ball(number, digits)
            balls.append(known[number])
    return balls


def _bits(digits: int) -> int:
    return int(digits * BITS_OF_A_DIGIT) + 8


def digits_here() -> int:
    return int(ctx.prec * DIGITS_OF_A_BIT)


def to_ball(number: Number | arb, digits: int = 17) -> arb:
    """An enclosure with at least ``digits`` correct digits; balls are returned unchanged."""
    if isinstance(number, arb):
        return number
    goal = _bits(digits)
    with ctx.workprec(goal + 32):
        while True:
            ball = _ball(number)
            if ball.rel_accuracy_bits() >= goal or not number:
                return ball
            ctx.prec *= 2


def _ball(number: Number) -> arb:
    if not isinstance(number, Algebraic):
        return arb(number)
    total = arb(0)
    for coefficient, word in number.terms():
        term = arb(coefficient)
        for index in word:
            term *= enclose(number.field.radicals[index][0])
        total += term
    return total


def to_decimal(number: Number, digits: int = 17) -> str:
    return to_ball(number, digits).str(digits, radius=False)


def in_digits(number: Any, digits: int) -> fmpq:
    """The decimal with ``digits`` significant digits nearest to a number or the centre of a ball.

    >>> in_digits(fmpq(1, 3), 4)
    3333/10000
    """
    with ctx.workprec(_bits(digits) + 32):
        text = arb(number).mid().str(digits, radius=False)
    return fmpq(*Decimal(text).as_integer_ratio())


def decimal(number: fmpq) -> str:
    """A positive rational as people write tolerances, ``1e-13``, or as a fraction.

    >>> decimal(fmpq(1, 10**13)), decimal(fmpq(441, 10**10)), decimal(fmpq(1, 3))
    ('1e-13', '4.41e-8', '1/3')
    """
    if number >= 1:
        return plain_decimal(number)
    scaled = number
    exponent = 0
    while scaled.q != 1 and exponent < 400:
        scaled *= 10
        exponent += 1
    if scaled.q != 1 or not exponent:
        return str(number)
    digits = str(scaled)
    first, rest = digits[0], digits[1:]
    mantissa = f"{first}.{rest}" if rest else first
    return f"{mantissa}e-{exponent - len(rest)}"


def plain_decimal(number: fmpq) -> str:
    """A rational number with all its decimals; a fraction if they do not end.

    >>> plain_decimal(fmpq(-1, 8)), plain_decimal(fmpq(3)), plain_decimal(fmpq(1, 3))
    ('-0.125', '3', '1/3')
    """
    places = 0
    shifted = abs(number)
    while shifted.q % 2 == 0 or shifted.q % 5 == 0:
        shifted *= 10
        places += 1
    if shifted.q != 1:
        return str(number)
    sign = "-" if number < 0 else ""
    digits = str(shifted.p).rjust(places + 1, "0")
    point = len(digits) - places
    whole = digits[:point]
    fraction = digits[point:]
    if not fraction:
        return sign + whole
    return f"{sign}{whole}.{fraction}"


def nearest_float(number: Algebraic) -> float:
    """The float nearest to an irrational number: both ends of a narrow enclosure round to it."""
    digits = 20
    while True:
        ball = to_ball(number, digits)
        with ctx.workprec(8 * digits):  # the ends are not rounded before
            ends = {float(ball.lower()), float(ball.upper())}
        if len(ends) == 1:
            return ends.pop()
        digits *= 2


def to_float(number: Number) -> float:
    """The nearest float, up to a unit in the last place."""
    return float(to_ball(number))
