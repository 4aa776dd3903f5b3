"""Texts of coefficients: what is read, what it is worth, and what is refused with its place."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact.display import to_ball, to_decimal, to_float, to_latex, to_text
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse, read_decimal
from garkcli.exact.field import Number
from garkcli.exact.nodes import Chain, Expression, Literal, Name, Power, Root
from garkcli.exact.rewriting import format_expression, roots_in, substitute

literals = st.fractions(0, 50, max_denominator=30).map(lambda x: f"{x.numerator}/{x.denominator}")
decimals = st.from_regex(r"[0-9]{1,6}(\.[0-9]{0,6})?([eE][+-]?[0-9])?", fullmatch=True)
RATIONAL_TEXTS = st.recursive(
    literals | decimals | st.integers(0, 99).map(str),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from([" + ", "-", "*", " / "]), inner).map("".join),
        inner.map("({})".format),
        inner.map("-{}".format),
        st.tuples(inner, st.integers(-3, 3)).map(lambda x: f"({x[0]})**{x[1]}"),
    ),
    max_leaves=8,
)
EXPRESSIONS: st.SearchStrategy[Expression] = st.recursive(
    st.one_of(
        st.fractions(-9, 9, max_denominator=9).map(
            lambda x: Literal(fmpq(x.numerator, x.denominator))
        ),
        st.sampled_from(["tau", "x_1"]).map(Name),
    ),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(["+-", "++", "+"]), st.lists(inner, min_size=2, max_size=2)).map(
            lambda x: (
                Chain(x[0], tuple(x[1][: len(x[0])])) if len(x[0]) > 1 else Chain("-", (x[1][0],))
            )
        ),
        st.tuples(st.sampled_from(["**", "*/"]), st.tuples(inner, inner)).map(lambda x: Chain(*x)),
        st.tuples(inner, st.integers(-5, 5)).map(lambda x: Power(*x)),
        st.tuples(inner, st.sampled_from([2, 3, 5])).map(lambda x: Root(*x)),
    ),
    max_leaves=8,
)


def evaluate(text: str) -> Number:
    """The exact value of a text."""
    expression = parse(text)
    return Domain([expression]).evaluate(expression)


def by_python(text: str) -> Fraction:
    """The value of a rational text by another reader: Python's own parser over fractions."""
    import ast
    import re

    wrapped = re.sub(r"(?<![\w.])(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)", r"F('\1')", text)
    wrapped = re.sub(r"\*\*F\('(\d+)'\)", r"**\1", wrapped)
    wrapped = re.sub(r"\*\*-F\('(\d+)'\)", r"**-\1", wrapped)
    tree = ast.parse(wrapped.strip(), mode="eval")
    return Fraction(eval(compile(tree, "", "eval"), {"F": _fraction}))


def _fraction(text: str) -> Fraction:
    return Fraction(
        text.rstrip(".") if text.endswith(".") else text.replace(".e", "e").replace(".E", "e")
    )


@given(RATIONAL_TEXTS)
def test_rational_texts_are_worth_what_python_says(text: str) -> None:
    """Precedence, signs, decimals and powers agree with Python's parser over fractions."""
    try:
        wanted = by_python(text)
    except ZeroDivisionError:
        with pytest.raises(UndefinedValue, match="division by zero"):
            evaluate(text)
        return
    assert evaluate(text) == fmpq(wanted.numerator, wanted.denominator)


@given(EXPRESSIONS)
def test_format_and_parse_are_inverse(expression: Expression) -> None:
    """What is written for an expression is read again with the same value, and from then on has the
    same text.
    """
    again = parse(format_expression(expression))
    text = format_expression(again)
    assert parse(text) == again
    assert format_expression(parse(text)) == text
    values = {name: parse(value) for name, value in (("tau", "2/7"), ("x_1", "-3/5"))}
    assert _have_one_value(substitute(expression, values), substitute(again, values))


def _have_one_value(*expressions: Expression) -> bool:
    """Whether the values are equal, or undefined for one reason; fields of many radicals are not
    tried.
    """
    if any(len(list(roots_in(expression))) > 1 for expression in expressions):
        return True
    try:
        domain = Domain(expressions)
        values = [domain.evaluate(expression) for expression in expressions]
    except UndefinedValue:
        for expression in expressions:
            with pytest.raises(UndefinedValue):
                Domain([expression]).evaluate(expression)
        return True
    return values[0] == values[1]


@given(st.integers(0, 10**12), st.integers(0, 12), st.integers(-30, 30))
def test_decimals_are_exact(digits: int, places: int, exponent: int) -> None:
    """A decimal is the rational number that it says, never a binary float."""
    text = f"{digits // 10**places}.{digits % 10**places:0{max(places, 1)}d}e{exponent}"
    wanted = Fraction(text)
    assert read_decimal(text) == fmpq(wanted.numerator, wanted.denominator)
    assert evaluate(f"-{text}") == -fmpq(wanted.numerator, wanted.denominator)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", fmpq(1, 10)),
        (".5", fmpq(1, 2)),
        ("5.", fmpq(5)),
        ("1e-3", fmpq(1, 1000)),
        ("010", fmpq(10)),
        ("-2**2", fmpq(-4)),
        ("2**-2", fmpq(1, 4)),
        ("2^3", fmpq(8)),
        ("1/2/3", fmpq(1, 6)),
        ("1 - 2 - 3", fmpq(-4)),
        ("2*3/4*5", fmpq(15, 2)),
        ("--3", fmpq(3)),
        ("1 - -1", fmpq(2)),
        ("sqrt(9/4)", fmpq(3, 2)),
        ("cbrt(-8/27)", fmpq(-2, 3)),
        ("root(32, 5)", fmpq(2)),
        ("sqrt(sqrt(16))", fmpq(2)),
        ("sqrt(3)**2", fmpq(3)),
        ("sqrt(2)*sqrt(8)", fmpq(4)),
        ("sqrt(3)/sqrt(12)", fmpq(1, 2)),
        ("cbrt(2)*cbrt(4)", fmpq(2)),
        ("sqrt(2)*sqrt(3) - sqrt(6)", fmpq(0)),
        ("sqrt(3 + 2*sqrt(2)) - sqrt(2)", fmpq(1)),
        ("sqrt((1 - sqrt(2))**2) + 1 - sqrt(2)", fmpq(0)),
        ("cbrt(2 + sqrt(5)) + cbrt(2 - sqrt(5))", fmpq(1)),
    ],
)
def test_values(text: str, value: fmpq) -> None:
    """Numbers whose exact value is known; identities between radicals are seen."""
    assert evaluate(text) == value
    assert not evaluate(text) - value


@pytest.mark.parametrize(
    "text",
    [
        "1/2 - sqrt(3)/6",
        "(sqrt(2) + sqrt(5))**3/(1 - sqrt(10))",
        "1/(2 - cbrt(2))",
        "-cbrt(2)/(2*(2 - cbrt(2)))",
        "cbrt(2/7) + cbrt(-12)",
        "root(17/8, 5)",
        "root(7, 4) - sqrt(7)",
        "sqrt(2 - sqrt(2))*sqrt(2 + sqrt(2))",
        "sqrt(5 - 2*sqrt(5))/10",
        "cbrt(-3) + 1",
        "cbrt(1 - sqrt(2))",
        "root(-2, 5)**2 - 1/3",
    ],
)
def test_radicals_are_worth_what_sympy_says(text: str) -> None:
    """Values of radicals agree with sympy's real roots to 40 digits, and so do their texts, read
    again.
    """
    number = evaluate(text)
    names = {"sqrt": sympy.sqrt, "cbrt": lambda x: sympy.real_root(x, 3), "root": sympy.real_root}
    wanted = sympy.N(sympy.sympify(text, locals=names, rational=True), 50)
    for found in (number, evaluate(to_text(number))):
        assert abs(sympy.Float(to_decimal(found, 45), 50) - wanted) < sympy.Float("1e-40")
        assert abs(to_float(found) - float(wanted)) < 1e-14
    assert to_ball(number, 60).rel_accuracy_bits() >= 199


@pytest.mark.parametrize(
    ("text", "start", "end"),
    [
        ("1 + $", 4, 5),
        ("1 +", 3, 4),
        ("(1 + 2", 6, 7),
        ("1 2", 2, 3),
        ("exp(1)", 0, 3),
        ("", 0, 1),
        ("2**x", 3, 4),
        ("2**2**2", 4, 6),
        ("1 − 2", 2, 3),
        ("1/(2 - 2)", 3, 8),
        ("1 + sqrt(2 - 3)", 4, 15),
    ],
)
def test_faults_have_their_place(text: str, start: int, end: int) -> None:
    """What is no number is refused with the offsets of the fault."""
    with pytest.raises(ExpressionError) as caught:
        evaluate(text)
    assert (caught.value.start, caught.value.end) == (start, end)


@pytest.mark.parametrize(
    "text", ["sqrt(-1)", "root(-2, 4)", "sqrt(1 - sqrt(2))", "sqrt(2 - sqrt(3)*sqrt(3))"]
)
def test_even_roots_of_negative_numbers_are_refused(text: str) -> None:
    """There are no complex coefficients, however the sign is hidden."""
    with pytest.raises(UndefinedValue, match="even root of a negative number"):
        evaluate(text)


def test_radicands_that_are_nearly_zero() -> None:
    """Zero is found to be zero, also before other roots, and 9.7e-30 positive, whose root is
    3.1e-15; below it is refused.
    """
    assert evaluate("sqrt(sqrt(8) - 2*sqrt(2))") == 0
    zero = "sqrt(3 + 2*sqrt(2) - (1 + sqrt(2))**2)"
    assert to_float(evaluate(f"{zero} + sqrt(1 + sqrt(2))")) == pytest.approx((1 + 2**0.5) ** 0.5)
    digits = "1.4142135623730950488016887242"
    found = evaluate(f"sqrt(sqrt(2) - {digits}0)")
    assert 3.114e-15 < to_float(found) < 3.115e-15
    with pytest.raises(UndefinedValue, match="even root of a negative number"):
        evaluate(f"sqrt(sqrt(2) - {digits}1)")


@pytest.mark.parametrize(
    "text",
    [
        "1" * 1001,
        "1e999999999999",
        "1e1001",
        "2**65",
        "(" * 61 + "1" + ")" * 61,
        "-" * 61 + "1",
        "1+" * 99 + "(" * 61 + "1" + ")" * 61,
        "root(2, 13)",
        "1+" * 10_001 + "1",
        "((((2**64)**64)**64)**64)",
        "root(1 + root(2, 12), 12)",
        "+".join(
            f"sqrt({p})" for p in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59)
        ),
    ],
)
def test_texts_that_would_exhaust_the_machine_are_refused(text: str) -> None:
    """Each limit holds, and is told as a limit."""
    with pytest.raises(LimitExceeded):
        evaluate(text)


def test_names_need_values() -> None:
    """A parameter is replaced by its value; without one it is undefined."""
    expression = parse("(1 - tau)/2")
    value = substitute(expression, {"tau": parse("1/3")})
    assert Domain([value]).evaluate(value) == fmpq(1, 3)
    with pytest.raises(UndefinedValue, match="'tau' is not a parameter"):
        substitute(expression, {"sigma": parse("1")})
    with pytest.raises(UndefinedValue, match="'tau' has no value"):
        Domain([expression]).evaluate(expression)


def test_latex() -> None:
    """Numbers in LaTeX, rational and with radicals."""
    assert to_latex(evaluate("-1/2")) == r"-\frac{1}{2}"
    for number in (fmpq(-1, 2), fmpq(1, 2), fmpq(-3)):
        assert format_expression(Literal(number), latex=True) == to_latex(number)
    assert to_latex(evaluate("1/2 - sqrt(3)/6")) == r"\frac{1}{2}-\frac{\sqrt{3}}{6}"
    assert to_latex(evaluate("4*sqrt(3)/27")) == r"\frac{4\sqrt{3}}{27}"
    assert to_latex(evaluate("cbrt(2)**2")) == r"\sqrt[3]{2}^{2}"


@given(st.fractions(-1000, 1000), st.integers(1, 30))
def test_decimals_are_rounded_right(number: Fraction, digits: int) -> None:
    """A decimal of n digits differs from the number by at most a unit of its last digit."""
    text = to_decimal(fmpq(number.numerator, number.denominator), digits)
    assert abs(Fraction(text) - number) <= abs(number) * Fraction(1, 10 ** (digits - 1))
