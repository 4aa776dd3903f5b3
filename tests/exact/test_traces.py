"""How numbers are made of printed ones, made again."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Any

import pytest
from flint import fmpq

from garkcli.exact.traces import Told, Trace, told

PRINTED = (Fraction(3, 7), Fraction(-5, 2), Fraction(11, 13))


def made(text: Told) -> Fraction:
    """The value of what is told, in plain fractions."""
    if isinstance(text, str):
        return Fraction(text)
    if isinstance(text, int):
        return PRINTED[text]
    sign, one, other = text[0], made(text[1]), made(text[2])
    if sign == "+":
        return one + other
    if sign == "-":
        return one - other
    return one * other if sign == "*" else one / other


def combined(dice: Random, one: tuple[Any, Fraction], other: tuple[Any, Fraction]) -> Any:
    """A sum, difference, product or quotient, or a power, as a trace and as a fraction."""
    (x, u), (y, v) = one, other
    sign = dice.choice("+-*/^~")
    if sign == "^":
        n = dice.randrange(1, 4)
        return x**n, u**n
    if sign == "~":
        return -x, -u
    if sign == "/" and not v:
        sign = "*"
    operations = {
        "+": lambda a, b: a + b,
        "-": lambda a, b: a - b,
        "*": lambda a, b: a * b,
        "/": lambda a, b: a / b,
    }
    return operations[sign](x, y), operations[sign](u, v)


@pytest.mark.parametrize("seed", range(200))
def test_what_is_told_makes_the_number_again(seed: int) -> None:
    """Random expressions of printed numbers and of 0, 1 and other exact ones: the numbers that are
    left out, 0 in sums and 1 in products, change no value.
    """
    dice = Random(seed)
    exact = [(fmpq(x.numerator, x.denominator), x) for x in map(Fraction, ("0", "1", "-1", "2/3"))]
    pool: list[tuple[Any, Fraction]] = [(Trace(k), x) for k, x in enumerate(PRINTED)]
    for _ in range(4):
        pair = [dice.choice(pool), dice.choice(pool + exact)]
        dice.shuffle(pair)
        found = combined(dice, *pair)
        if found[1]:
            pool.append(found)
    for trace, value in pool:
        assert made(told(trace)) == value
