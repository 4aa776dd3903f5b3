"""Common divisors over number fields: against Euclid's algorithm, and without its fractions."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.errors import LimitExceeded
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.polynomial import Polynomial, gcd

FIELDS = [
    ["sqrt(2)"],
    ["cbrt(3)", "sqrt(7)"],
    ["root_of(3*x**5 - x - 1, 1)"],
    ["sqrt(2)", "sqrt(3)", "sqrt(5)"],
]


def euclid(a: Polynomial, b: Polynomial) -> Polynomial:
    """The monic common divisor by Euclid's algorithm over the field."""
    while b:
        a, b = b, a % b
    return a.monic()


def factors(texts: list[str]) -> tuple[Polynomial, Polynomial, Polynomial]:
    """Three polynomials with the radicals of a field, of which no two have a common divisor."""
    expressions = [parse(text) for text in texts]
    domain = Domain(expressions)
    radicals = [domain.evaluate(x) for x in expressions]
    first, last = radicals[0], radicals[-1]
    x = Polynomial([0, 1])
    return x * x * last - first / fmpq(7), x * first + last + fmpq(1, 3), x * x + x * last - 5


@pytest.mark.parametrize("texts", FIELDS)
def test_common_divisors_are_those_of_euclid(texts: list[str]) -> None:
    """Simple and multiple factors, none, rational polynomials, and zero."""
    f, g, h = factors(texts)
    assert gcd(f * g, f * h) == euclid(f * g, f * h) == f.monic()
    assert gcd(f * f * g, f * f * h) == (f * f).monic()
    assert gcd(f, g) == gcd(f * g, h) == Polynomial([1])
    assert gcd(f * f, (f * f).derivative()) == f.monic()
    assert gcd(f, Polynomial([])) == gcd(Polynomial([]), f) == f.monic()
    rational = Polynomial([-3, 1, 1])
    assert gcd(rational * f, rational) == rational
    assert (f * f * g).square_free() == (f * g).monic()


def test_common_divisors_take_no_inverse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each is an extended Euclidean algorithm of its own; over the field every step needs one."""
    f, g, h = factors(FIELDS[-1])
    products, expected = (f * g * g, f * h * h), f.monic()
    taken = []
    inverse = Algebraic.inverse

    def counted(number: Algebraic) -> Number:
        taken.append(number)
        return inverse(number)

    monkeypatch.setattr(Algebraic, "inverse", counted)
    found = gcd(*products)
    assert len(taken) <= 2  # of the leading coefficient 1, where something is divided by it
    assert found == expected


def test_long_radicands_of_a_high_degree_are_refused() -> None:
    """Adjoining them is a call of minutes; short ones of the same degree are read."""
    long = [parse(f"sqrt({10**200 + k})") for k in (1, 3, 7, 9, 13)]
    with pytest.raises(LimitExceeded, match=r"radicals of degree \d+ from numbers of \d+ bits"):
        Domain([*long, parse("cbrt(2)")])
    short = Domain([parse(text) for text in ("sqrt(2)", "sqrt(3)", "sqrt(5)", "cbrt(2)")])
    assert short.field is not None
    assert short.field.degree == 24
