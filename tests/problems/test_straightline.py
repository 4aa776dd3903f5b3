"""Expressions as straight-line code: the same numbers as sympy's own, in floats and in balls."""

from __future__ import annotations

import math
from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli.problems.straightline import FUNCTIONS, code_of, function
from tests.oracles.draws import fractions
from tests.whole import at_most, in_whole

X = sympy.symbols("x y z", positive=True)
DIGITS = 40


def numbers() -> st.SearchStrategy[Any]:
    """Small rational numbers as sympy has them."""
    return fractions(-3, 3, 7).map(lambda x: sympy.Rational(x.numerator, x.denominator))


def combined(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Sums, products, powers and functions of what there is."""
    powers = st.sampled_from(
        [-3, -2, -1, 2, 3, 5, sympy.Rational(1, 2), sympy.Rational(-3, 2), sympy.Rational(2, 3)]
    )
    names = st.sampled_from(["sin", "cos", "exp", "atan", "tanh"])
    return st.one_of(
        st.tuples(inner, inner).map(sum),
        st.tuples(inner, inner).map(lambda x: x[0] * x[1]),
        st.tuples(inner, powers).map(lambda x: (x[0] ** 2 + 1) ** x[1]),
        st.tuples(inner, names).map(lambda x: getattr(sympy, x[1])(x[0] / 4)),
    )


EXPRESSIONS = st.recursive(
    st.one_of(st.sampled_from(X), numbers(), st.just(sympy.pi)), combined, max_leaves=8
)
POINTS = st.tuples(*[st.integers(1, 40).map(lambda k: fmpq(k, 16))] * 3)


@in_whole
@settings(max_examples=at_most(20, 60), deadline=None)
@given(st.lists(EXPRESSIONS, min_size=1, max_size=4), POINTS)
def test_values_are_those_of_sympy(expressions: list[Any], point: tuple[fmpq, ...]) -> None:
    """Several expressions at once, in 40 digits, and in floats where no part of one is large."""
    at = {x: sympy.Rational(int(a.p), int(a.q)) for x, a in zip(X, point, strict=True)}
    expected = [sympy.sympify(f).subs(at).evalf(DIGITS + 10) for f in expressions]
    assume(all(abs(x) < 1e12 for x in expected))
    size = max(1.0, *(float(abs(x)) for x in expected))
    parts = {x for f in expressions for x in sympy.preorder_traversal(sympy.sympify(f))}
    # the sine of a number of nine digits has half the digits of a float
    if all(abs(x.subs(at).evalf()) < 1e3 for x in parts):
        code = function(tuple(map(sympy.sympify, expressions)), X, False)
        floats = code(*(int(a.p) / int(a.q) for a in point))
        assert floats == pytest.approx([float(x) for x in expected], rel=1e-9, abs=1e-9 * size)
    with ctx.workprec(200):
        balls = function(tuple(map(sympy.sympify, expressions)), X, True)(*map(arb, point))
        for ball, value in zip(balls, expected, strict=True):
            assert abs(arb(ball) - arb(str(value))) < size * 1e-35


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_each_function(name: str) -> None:
    """Every function of the list has code for floats and for balls."""
    f = getattr(sympy, name)(X[0])
    expected = getattr(math, name)(0.375)
    assert function((f,), X[:1], False)(0.375) == [expected]
    assert abs(function((f,), X[:1], True)(arb(0.375))[0] - expected) < 1e-14


def test_common_parts_are_computed_once() -> None:
    """Kepler's force: one square root, one division, four products."""
    x, y, _ = X
    r3 = sympy.Pow(x**2 + y**2, sympy.Rational(3, 2))
    lines, results = code_of((-x / r3, -y / r3), (x, y), False).lines(("q0", "q1"), "f_")
    text = "\n".join(lines)
    assert (text.count("sqrt"), text.count("/"), text.count("*")) == (1, 1, 5)
    assert results == ["f_0", "f_1"]


def test_what_is_there_needs_no_line() -> None:
    """An argument is its own result, and zero is no code at all."""
    lines, results = code_of((X[1], sympy.Integer(0), sympy.Integer(2)), X[:2], False).lines(
        ("p0", "p1"), "f_"
    )
    assert (lines, results) == ([], ["p1", "0", "2.0"])


def test_names_of_others_are_no_code() -> None:
    """Symbols are renamed whatever they are called; foreign symbols and functions are refused."""
    nasty = sympy.Symbol("__import__('os').abort()")
    assert function((nasty + 1,), (nasty,), False)(2.0) == [3.0]
    with pytest.raises(TypeError, match="no argument"):
        code_of((X[0] + X[1],), X[:1], False)
    with pytest.raises(TypeError, match="no code for gamma"):
        code_of((sympy.gamma(X[0]),), X[:1], False)


def test_powers_are_real() -> None:
    """A root of a negative number is an error of floats and no number in balls, never complex."""
    for exponent in (sympy.Rational(1, 2), sympy.Rational(1, 3)):
        f = (X[0] - 10) ** exponent
        with pytest.raises(ValueError, match="domain"):
            function((f,), X[:1], False)(1.0)
        assert not function((f,), X[:1], True)(arb(1))[0].is_finite()


@in_whole
def test_deep_expressions_are_cut() -> None:
    """Seventy functions inside each other, with sums between: more parentheses than Python would
    nest.
    """
    f, value = X[0], 0.5
    for _ in range(70):
        f, value = sympy.sin(1 + f / 2), math.sin(1 + value / 2)
    assert function((f,), X[:1], False)(0.5) == pytest.approx([value], rel=1e-14)


def test_constants_beyond_the_floats_are_infinite() -> None:
    """No failure when the code is made: what is computed with them is no number, and balls have
    it.
    """
    huge = sympy.Integer(10) ** 400
    assert function((huge * X[0], -huge * X[0]), X[:1], False)(2.0) == [math.inf, -math.inf]
    assert function((huge * X[0],), X[:1], True)(arb(0.5))[0].overlaps(arb(10) ** 400 / 2)
    longest = sympy.Integer(10) ** 6000  # more digits than Python writes
    (found,) = function((longest * X[0],), X[:1], True)(arb(0.5))
    assert found.overlaps(arb(10) ** 6000 / 2)


def test_zero_is_a_number_of_the_kind_asked_for() -> None:
    """Zero beside other expressions and alone: a float for floats, a ball for balls."""
    zero, one = sympy.Integer(0), X[0]
    with ctx.workprec(100):
        assert function((zero, one), X[:1], False)(0.5) == [0.0, 0.5]
        found = function((zero, one), X[:1], True)(arb(2))
        assert all(isinstance(x, arb) for x in found)
        assert found[0] == 0
        (alone,) = function((zero,), X[:1], True)(arb(2))
        assert alone.mid() == 0
