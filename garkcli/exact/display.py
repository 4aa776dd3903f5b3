"""Exact number to text, LaTeX, decimals and floats."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from flint import arb, ctx, fmpq

from garkcli.exact.domain import enclose
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.rewriting import format_expression


def to_text(number: Number) -> str:
    """The number as a method file writes it, for instance ``1/2 - sqrt(3)/6``."""
    if not isinstance(number, Algebraic):
        return str(number)
    text = ""
    for coefficient, word in _terms(number):
        factors = "*".join(
            f"{w}**{k}" if k > 1 else w for w, k in _powers(number, word, latex=False)
        )
        p, q = abs(coefficient.p), coefficient.q
        term = (f"{p}*{factors}" if p != 1 else factors) if factors else str(p)
        term += f"/{q}" if q != 1 else ""
        text += f"{' - ' if coefficient < 0 else ' + '}{term}"
    return text.removeprefix(" + ") if text.startswith(" + ") else "-" + text.removeprefix(" - ")


def to_latex(number: Number) -> str:
    r"""The number in LaTeX, for instance ``\frac{1}{2}-\frac{\sqrt{3}}{6}``."""
    terms = _terms(number) if isinstance(number, Algebraic) else iter([(number, ())])
    text = ""
    for coefficient, word in terms:
        factors = ""
        if isinstance(number, Algebraic):
            factors = "".join(
                f"{w}^{{{k}}}" if k > 1 else w for w, k in _powers(number, word, latex=True)
            )
        p, q = abs(coefficient.p), coefficient.q
        top = (f"{p}{factors}" if p != 1 else factors) if factors else str(p)
        text += ("-" if coefficient < 0 else "+") + (rf"\frac{{{top}}}{{{q}}}" if q != 1 else top)
    return text.removeprefix("+")


def _terms(number: Algebraic) -> Iterator[tuple[fmpq, tuple[int, ...]]]:
    for coefficient, word in zip(
        number.field.in_radicals(number), number.field.monomials, strict=True
    ):
        if coefficient:
            yield coefficient, word


def _powers(number: Algebraic, word: tuple[int, ...], latex: bool) -> Iterator[tuple[str, int]]:
    for index, power in Counter(word).items():
        yield format_expression(number.field.radicals[index][0], latex), power


def to_ball(number: Number, digits: int = 17) -> arb:
    """An enclosure of ``number`` with at least ``digits`` correct decimal digits."""
    precision = ctx.prec
    goal = int(digits * 3.33) + 8
    try:
        ctx.prec = goal + 32
        while True:
            ball = _ball(number)
            if ball.rel_accuracy_bits() >= goal or not number:
                return ball
            ctx.prec *= 2
    finally:
        ctx.prec = precision


def _ball(number: Number) -> arb:
    if not isinstance(number, Algebraic):
        return arb(number)
    total = arb(0)
    for coefficient, word in _terms(number):
        term = arb(coefficient)
        for index in word:
            term *= enclose(number.field.radicals[index][0])
        total += term
    return total


def to_decimal(number: Number, digits: int = 17) -> str:
    """The number rounded to ``digits`` significant digits."""
    return to_ball(number, digits).str(digits, radius=False)


def decimal(number: fmpq) -> str:
    """A positive rational as people write tolerances: ``1e-13``, or a fraction where it is no such
    decimal.

    >>> decimal(fmpq(1, 10**13)), decimal(fmpq(5, 10**8)), decimal(fmpq(1, 3))
    ('1e-13', '5e-8', '1/3')
    """
    exponent = 0
    while number.q != 1 and exponent < 400:
        number, exponent = number * 10, exponent + 1
    return (
        f"{number}e-{exponent}"
        if number.q == 1 and exponent
        else str(number / fmpq(10) ** exponent)
    )


def plain_decimal(number: fmpq) -> str:
    """A rational number in decimals, all of them; a fraction where they do not end.

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
    digits = str(shifted.p).rjust(places + 1, "0")
    sign = "-" if number < 0 else ""
    whole, fraction = digits[: len(digits) - places], digits[len(digits) - places :]
    return sign + (f"{whole}.{fraction}" if fraction else whole)


def to_float(number: Number) -> float:
    """The nearest float, or nearly so."""
    return float(to_ball(number))
