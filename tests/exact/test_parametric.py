"""Rational functions of parameters, against their values, sympy, and balls."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
import sympy
from flint import arb, ctx, fmpq, fmpq_mpoly
from hypothesis import assume, given
from hypothesis import strategies as st

from garkcli.errors import TooManyTerms
from garkcli.exact.parametric import (
    Mixed,
    Parameters,
    Parametric,
    Rule,
    common_denominator,
    evaluated,
    factors,
    fraction,
    terms_of_power,
    terms_of_product,
    terms_of_sum,
    times,
    unknowns_of,
)

X, Y = Parameters(["x", "y"]).context.gens()


def test_products_are_refused_by_their_own_terms() -> None:
    """800 terms times 800: 1599 powers of x, whose coefficients count the ways to write a sum, or
    640 000 products of a power of x and one of y.
    """
    p, q = (sum((v**k for k in range(1, 800)), v**0) for v in (X, Y))
    product = times(p, p)
    assert len(product) == 1599
    assert all(product[k, 0] == min(k + 1, 1599 - k) for k in range(1599))
    with pytest.raises(TooManyTerms):
        times(p, q)


COEFFICIENTS = st.fractions(-3, 3, max_denominator=4).map(
    lambda x: fmpq(x.numerator, x.denominator)
)
POLYNOMIALS = st.dictionaries(
    st.tuples(st.integers(0, 2), st.integers(0, 2)), COEFFICIENTS, max_size=4
)
RING = Parameters(["x", "y"])
POINTS = [(fmpq(2, 7), fmpq(-5, 3)), (fmpq(-11, 5), fmpq(13, 2)), (fmpq(3), fmpq(7, 11))]
Terms = dict[tuple[int, ...], fmpq]


def polynomial(terms: Terms) -> fmpq_mpoly:
    """In x and y."""
    return RING.context.from_dict(terms)


def worth(terms: Terms, point: tuple[fmpq, fmpq]) -> fmpq:
    """The value of a polynomial, term by term."""
    x, y = point
    return sum((a * x ** e[0] * y ** e[1] for e, a in terms.items()), fmpq(0))


def at(number: Mixed, point: tuple[fmpq, fmpq]) -> fmpq | None:
    """The value of a function, None at a pole."""
    p, q = fraction(number, RING)
    below = worth({(int(i), int(j)): a for (i, j), a in q.to_dict().items()}, point)
    above = worth({(int(i), int(j)): a for (i, j), a in p.to_dict().items()}, point)
    return above / below if below else None


@given(POLYNOMIALS, POLYNOMIALS, POLYNOMIALS, POLYNOMIALS, st.integers(-3, 3), COEFFICIENTS)
def test_functions_compute_as_their_values(
    a: Terms, b: Terms, c: Terms, d: Terms, exponent: int, number: fmpq
) -> None:
    """Sums, products, quotients and powers at points, in lowest terms; a number is a plain one."""
    below, under = polynomial(b), polynomial(d)
    assume(below and under)
    f, g = RING.quotient(polynomial(a), below), RING.quotient(polynomial(c), under)
    results: list[tuple[Mixed, Callable[[fmpq, fmpq], fmpq]]] = [
        (f + g, lambda x, y: x + y),
        (f - g, lambda x, y: x - y),
        (f * g, lambda x, y: x * y),
        (f + number, lambda x, _: x + number),
        (number - f, lambda x, _: number - x),
        (number * f, lambda x, _: number * x),
        (-f, lambda x, _: -x),
    ]
    if g:
        results += [(f / g, lambda x, y: x / y), (number / g, lambda _, y: number / y)]
    if f and isinstance(f, Parametric):
        results.append((f**exponent, lambda x, _: x**exponent))
    for result, meant in results:
        p, q = fraction(result, RING)
        assert p.gcd(q).is_one()
        assert q.leading_coefficient() == 1
        assert isinstance(result, fmpq) == (p.is_constant() and q.is_one())
        for point in POINTS:
            x, y = worth(a, point), worth(c, point)
            poles = worth(b, point), worth(d, point)
            if all(poles) and x and y:
                assert at(result, point) == meant(x / poles[0], y / poles[1])
    assert (f == g) == (not f - g)
    assert (f == number) == (not f - number)
    assert f + g == g + f
    assert hash(f + g) == hash(g + f)


@given(POLYNOMIALS, POLYNOMIALS)
def test_texts_are_those_of_the_terms(a: Terms, b: Terms) -> None:
    """Read by sympy, LaTeX too, they are the quotient of the sums of terms."""
    x, y = sympy.symbols("x y")

    def total(terms: Terms) -> sympy.Expr:
        parts = [
            sympy.Rational(int(k.p), int(k.q)) * x ** e[0] * y ** e[1] for e, k in terms.items()
        ]
        return sympy.Add(*parts)

    def read(text: str) -> sympy.Expr:
        while r"\frac" in text:
            text = re.sub(
                r"\\frac\{((?:[^{}]|\^\{\d\})*)\}\{((?:[^{}]|\^\{\d\})*)\}", r"((\1)/(\2))", text
            )
        text = re.sub(r"\^\{(\d)\}", r"^\1", text)
        text = re.sub(r"(?<=[0-9xy])(?=[xy])", "*", text)
        return sympy.sympify(text.replace("^", "**"), locals={"x": x, "y": y})

    below = polynomial(b)
    assume(below)
    function = RING.quotient(polynomial(a), below)
    assume(isinstance(function, Parametric))
    assert isinstance(function, Parametric)
    wanted = total(a) / total(b)
    assert sympy.simplify(read(str(function)) - wanted) == 0
    assert sympy.simplify(read(function.latex()) - wanted) == 0
    height = max(int(k.height_bits()) for p in fraction(function, RING) for k in p.coeffs())
    assert function.height_bits() == height


@given(POLYNOMIALS, POLYNOMIALS, st.integers(0, 5))
def test_terms_are_no_more_than_their_bounds(a: Terms, b: Terms, exponent: int) -> None:
    """Of products, sums and powers; dense ones have as many."""
    p, q = polynomial(a), polynomial(b)
    assert len(p * q) <= terms_of_product(p, q)
    assert len(p + q) <= terms_of_sum(p, q)
    assert len(p**exponent) <= terms_of_power(p, exponent)
    dense = (1 + X + Y) ** exponent
    assert terms_of_sum(dense, dense) == len(dense)
    assert terms_of_product(dense, 1 + X + Y) == len(dense * (1 + X + Y))
    assert terms_of_sum(dense, X * 0) == terms_of_sum(X * 0, dense) == len(dense)
    assert terms_of_product(dense, X * 0) == 0
    assert terms_of_power(1 + X**3 * Y, exponent) == exponent + 1


@given(st.dictionaries(st.tuples(st.integers(0, 7), st.integers(0, 5)), COEFFICIENTS, max_size=5))
def test_rules_keep_the_value(terms: Terms) -> None:
    """With s³ = 2 and r² = s + 1 no power of r above 1, or of s above 2, is left."""
    ring = Parameters(["s", "r"])
    s, r = ring.context.gens()
    ring.rules = (Rule(0, 3, ring.constant(fmpq(2))), Rule(1, 2, s + 1))
    p = ring.context.from_dict(terms)
    smaller = ring.reduced(p)
    assert all(degree < most for degree, most in zip(smaller.degrees(), (3, 2), strict=True))
    with ctx.workprec(200):
        root = arb(2).root(3)
        values = [root, (root + 1).sqrt()]
        difference = evaluated(p, values) - evaluated(smaller, values)
        assert abs(difference) < arb("1e-40")
    assert ring.quotient(r**2 - s, ring.constant(fmpq(1))) == 1


def test_what_is_taken_to_be_nonzero() -> None:
    """Divisors and conditions, but no constants; inside a decision alone, and as before after it."""
    x, y = map(RING.parameter, RING.names)
    with RING.telling_apart() as outer:
        assert x / (y + 1)
        with RING.telling_apart() as inner:
            half = x / 2
            assert isinstance(half, Parametric)
            assert half.inverse() == 2 / x
        assert 1 / y == y**-1
        assert (y + 2) ** 0 == 1
    assert not x - x
    assert {str(p) for p in inner.values()} == {"1/2*x", "x"}
    assert {str(p) for p in outer.values()} == {"y + 1", "x", "y"}
    assert bool(x)
    assert "1/2*x" not in outer


def test_numbers_of_several_functions() -> None:
    """Their denominator in common, factors, and the variables in them."""
    x, y = map(RING.parameter, RING.names)
    numbers = [1 / x, 1 / (x * y), y / (x * x), fmpq(1, 2), x]
    assert str(common_denominator(numbers, RING)) == "x^2*y"
    assert unknowns_of(X**2 + 1) == [0]
    assert unknowns_of(X * 0 + 5) == []
    assert unknowns_of(X + Y) == [0, 1]
    assert {str(p) for p in factors([X**2 * (Y - 1), X * 0, X * (Y + 1) * 3, X * 0 + 7])} == {
        *("x", "y - 1", "y + 1")
    }
    with pytest.raises(TypeError):
        x + Parameters(["x", "y"]).parameter("x")
    assert x != "x"
