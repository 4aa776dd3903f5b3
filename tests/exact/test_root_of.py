"""Roots of polynomials as coefficients: which root is meant, its field, what is refused."""

from __future__ import annotations

from math import isqrt
from typing import Any

import pytest
from flint import arb, fmpq, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import ExpressionError, GarkError, LimitExceeded, UndefinedValue
from garkcli.exact.display import to_ball, to_latex, to_text
from garkcli.exact.domain import Domain
from garkcli.exact.enclosing import _narrowed, _value, enclose, midpoint
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.formula import parse_formula
from garkcli.exact.roots import sign
from garkcli.methodfile.load import loads
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.summary import stability

GAMMA = "root_of(6*x^3 - 18*x^2 + 9*x - 1, 0.4358665)"
SDIRK = """
parameters:
  g: {gamma}
  c: (1 + g)/2
  b1: -3*g**2/2 + 4*g - 1/4
  b2: 3*g**2/2 - 5*g + 5/4
A: [[g], [c - g, g], [b1, b2, g]]
b: [b1, b2, g]
"""
"""R. Alexander 1977: the stiffly accurate method of three stages and order 3."""


def value(text: str) -> Number:
    """The exact value of one coefficient."""
    expression = parse(text)
    return Domain([expression]).evaluate(expression)


def test_the_root_is_a_root() -> None:
    """Its polynomial vanishes at it exactly, and its decimals are those that were given."""
    g = value(GAMMA)
    assert 6 * g**3 - 18 * g**2 + 9 * g - 1 == 0
    assert abs(to_ball(g) - arb("0.43586652150845899942")) < 1e-16
    assert abs(enclose(parse(GAMMA)) - to_ball(g)) < 1e-14


@pytest.mark.parametrize(("near", "k"), [("0.1", 0), ("0.44", 1), ("2", 2), ("9", 2)])
def test_the_nearest_root_is_meant(near: str, k: int) -> None:
    """The three roots are 0.1589…, 0.4358… and 2.4052…"""
    roots = ["0.15898389998867", "0.43586652150846", "2.40514957850287"]
    found = to_ball(value(f"root_of(6*x**3 - 18*x**2 + 9*x - 1, {near})"))
    assert abs(found - arb(roots[k])) < 1e-13


@given(st.lists(st.fractions(-3, 3, max_denominator=5), min_size=1, max_size=4), st.data())
def test_rational_roots_are_rational_numbers(roots: list, data: st.DataObject) -> None:
    """Of a product of linear factors the root asked for comes out as a fraction."""
    product = "*".join(f"(x - ({root}))" for root in roots)
    wanted = data.draw(st.sampled_from(roots))
    found = value(f"root_of({product}, {wanted})")
    assert found == fmpq(wanted.numerator, wanted.denominator)


def test_quadratic_roots_are_radicals() -> None:
    """They lie in the field of the square root, whichever way they are written."""
    expressions = [parse("root_of(x**2 - x - 1, 1.6)"), parse("sqrt(5)/2")]
    domain = Domain(expressions)
    golden, half = (domain.evaluate(x) for x in expressions)
    assert golden == fmpq(1, 2) + half
    assert domain.degree == 2
    assert to_text(golden) == "1/2 + sqrt(5)/2"


def test_other_roots_and_radicals_share_a_field() -> None:
    """∛2 is a root of x³ − 2, and with √3 generates a field of degree 6."""
    expressions = [parse("root_of(x^3 - 2, 1)"), parse("cbrt(2)"), parse("sqrt(3)")]
    domain = Domain(expressions)
    first, second, third = (domain.evaluate(x) for x in expressions)
    assert first == second
    assert domain.degree == 6
    assert (first * third) ** 6 == 108


@pytest.mark.parametrize("k", range(3))
def test_the_text_is_read_again(k: int) -> None:
    """A value written out is the same number, and LaTeX has the polynomial."""
    near = ["0.16", "0.43", "2.4"][k]
    expression = parse(f"root_of(6*x^3 - 18*x^2 + 9*x - 1, {near})")
    number = Domain([expression]).evaluate(expression) / 3 + 1
    again = value(to_text(number))
    assert to_text(again) == to_text(number)
    assert abs(to_ball(again, 40) - to_ball(number, 40)) < 1e-39
    assert "6x^{3}-18x^{2}+9x-1" in to_latex(number)


def test_close_roots_have_digits_enough() -> None:
    """Two roots 2e-15 apart: the text says which one is meant."""
    text = "root_of((x**3 - 2)*((10**15*x + 1)**3 - 2*10**45), {})"
    near = [arb(2).root(3) - arb(k, 0) / 10**15 for k in (0, 1)]
    found = [value(text.format(x.str(17, radius=False))) for x in near]
    assert to_text(found[0]) == "root_of(x**3-2, 1.259921050)"
    assert "1000" in to_text(found[1])


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("root_of(x**2 + 1, 0)", UndefinedValue, "no real root"),
        ("root_of(3, 0)", ExpressionError, "a polynomial in x"),
        ("root_of(x - x, 0)", ExpressionError, "a polynomial in x"),
        ("root_of(x**3 - 2, x)", ExpressionError, "a number near the root"),
        ("root_of(x**3 - y, 1)", ExpressionError, "names other than x"),
        ("root_of(x**3 - sqrt(2), 1)", ExpressionError, "rational coefficients"),
        ("root_of(1/x - 2, 1)", ExpressionError, "not divided by x"),
        ("root_of(x**-2, 1)", ExpressionError, "not divided by x"),
        ("root_of(x/0 - 2, 1)", UndefinedValue, "division by zero"),
        ("root_of(x**4 - 5*x**2 + 5, 0)", UndefinedValue, "equally near"),
        ("root_of(x**13 - 2, 1)", LimitExceeded, "too large"),
        ("root_of((x**6 - 2)*(x**7 - 2), 1)", LimitExceeded, "too large"),
        ("root_of((10**60)**64*x**64 - 2, 1)", LimitExceeded, "too large"),
        ("root_of((10**60)**64*x - 2, 1)", LimitExceeded, "too large"),
        ("root_of(x**3 - 2)", ExpressionError, "',' expected"),
        ("root_of(x**3 - 2, 1", ExpressionError, "')' expected"),
        ("root_of", UndefinedValue, "no value"),
        ("root_off(x, 1)", ExpressionError, "not a function"),
    ],
)
def test_refusals(text: str, error: type[GarkError], message: str) -> None:
    """What is no such root is refused with its reason, as text that is shown."""
    with pytest.raises(error) as caught:
        value(text)
    assert message in caught.value.message


def test_formulas_have_no_such_roots() -> None:
    """Problems are differentiated; there they are refused."""
    with pytest.raises(ExpressionError, match="for coefficients"):
        parse_formula("root_of(x**3 - 2, 1)*q")


def test_the_sdirk_method_of_order_three_is_l_stable() -> None:
    """With γ a root of its polynomial: proved, and of order 3, in a field of degree 3."""
    method = loads(SDIRK.format(gamma=GAMMA))
    (found,) = stability(method.tableau).linear
    assert (found.a_stable, found.l_stable) == (True, True)
    assert found.R.at_infinity() == 0


def test_the_other_roots_are_not() -> None:
    """0.1589… is not A-stable; 2.405… is not either, though its poles are to the right."""
    for near in ("0.16", "2.4"):
        gamma = GAMMA.replace("0.4358665", near)
        R = stability_function(loads(SDIRK.format(gamma=gamma)).tableau)
        assert not is_a_stable(R)


@pytest.mark.parametrize("digits", [5, 8, 11])
def test_a_digit_off_loses_it_exactly(digits: int) -> None:
    """A wrong digit of γ at one place, the rest exact: R(∞) is not 0, and L-stability is gone."""
    wrong = f"g + 1/10**{digits}"
    text = SDIRK.format(gamma=GAMMA).replace("A: [[g]", f"A: [[{wrong}]")
    R = stability_function(loads(text.replace("b1, b2, g]]", f"b1, b2, {wrong}]]")).tableau)
    assert not is_l_stable(R)
    limit = R.at_infinity()
    assert limit is not None
    assert sign(limit) != 0


def test_a_method_with_the_cosine_of_ten_degrees() -> None:
    """γ = 1/2 + cos(π/18)/√3 is a root of 24x³ − 36x² + 12x − 1: order 4, A- and B-stable.

    K. Burrage 1979; Hairer, Wanner, section IV.6.
    """
    text = (
        "parameters: {g: 'root_of(24*x^3 - 36*x^2 + 12*x - 1, 1.07)', d: 1/(6*(1 - 2*g)**2)}\n"
        "A: [[g], [1/2 - g, g], [2*g, 1 - 4*g, g]]\n"
        "b: [d, 1 - 2*d, d]\n"
    )
    found = stability(loads(text).tableau)
    (linear,) = found.linear
    assert (linear.a_stable, linear.l_stable) == (True, False)
    assert found.algebraic is not None
    assert found.algebraic.holds
    assert linear.ssp is not None
    assert linear.ssp.value is not None
    assert linear.ssp.value.exact == 0


def test_roots_are_narrowed_by_values_in_balls() -> None:
    """Exact values at numbers of thousands of bits are many times as long."""
    exact = []

    class Counted(fmpz_poly):
        def __call__(self, x: Any) -> Any:
            exact.append(x)
            return fmpz_poly.__call__(self, x)

    p = Counted([-1, 9, -18, 6, 0, 0, 1])
    ball = _narrowed(p, fmpq(0), fmpq(1, 3), 2000)
    assert len(exact) == 1  # the sign at the end
    assert ball.rad() < fmpq(1, 2**1990)
    low, high = (midpoint(x) for x in (ball.lower(), ball.upper()))
    assert p(low) < 0 < p(high)


def test_values_beside_a_root_have_their_sign() -> None:
    """Where a ball leaves the sign of p(x) open p(x) is computed exactly: x is within 1e-60 of √2."""
    p = fmpz_poly([-2, 0, 1])
    below = fmpq(isqrt(2 * 10**120), 10**60)
    assert _value(p, below) < 0
    assert _value(p, below + fmpq(1, 10**60)) > 0
