"""Formulas: what is read, what it is worth, and what is refused with its place."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx, fmpq
from hypothesis import assume, given
from hypothesis import strategies as st

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact.expression import parse
from garkcli.exact.formula import FUNCTIONS, exponent_of, parse_formula, value_of
from garkcli.exact.nodes import Call, Chain, Expression, Literal, Name, Power, RealPower, Root
from garkcli.exact.rewriting import format_expression, names_in, roots_in, size_of, substitute

FORMULAS: st.SearchStrategy[Expression] = st.recursive(
    st.one_of(
        st.fractions(-9, 9, max_denominator=9).map(
            lambda x: Literal(fmpq(x.numerator, x.denominator))
        ),
        st.sampled_from(["x", "px", "pi"]).map(Name),
    ),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(["+-", "++", "**", "*/"]), st.tuples(inner, inner)).map(
            lambda x: Chain(*x)
        ),
        inner.map(lambda x: Chain("-", (x,))),
        st.tuples(inner, st.integers(-3, 3)).map(lambda x: Power(*x)),
        st.tuples(inner, st.sampled_from(["3/2", "-1/2", "1/3"])).map(
            lambda x: RealPower(x[0], parse(x[1]))
        ),
        inner.map(lambda x: Root(x, 2)),
        st.tuples(st.sampled_from(FUNCTIONS), inner).map(lambda x: Call(*x)),
    ),
    max_leaves=8,
)
NAMES = {"x": fmpq(2, 3), "px": fmpq(-1, 2)}


def value(text: str) -> fmpq | arb:
    """The value of a text where x = 2/3 and px = −1/2."""
    return value_of(parse_formula(text), NAMES)


@given(FORMULAS)
def test_format_and_parse_are_inverse(expression: Expression) -> None:
    """What is written for a formula is read again with the same value, and from then on has the
    same text.
    """
    again = parse_formula(format_expression(expression))
    text = format_expression(again)
    assert parse_formula(text) == again
    assert format_expression(parse_formula(text)) == text
    try:
        wanted = value_of(expression, NAMES)
    except ExpressionError as error:
        with pytest.raises(type(error)):
            value_of(again, NAMES)
        return
    found = value_of(again, NAMES)
    assert found == wanted if isinstance(wanted, fmpq) else arb(found).overlaps(wanted)


@given(FORMULAS)
def test_values_are_those_of_floats(expression: Expression) -> None:
    """Balls hold what Python's own functions of floats give, up to their rounding."""
    try:
        with ctx.workprec(200):
            ball = arb(value_of(expression, NAMES))
    except ExpressionError:
        assume(False)
        return
    assume(1e-6 < abs(float(ball)) < 1e6)
    try:
        found = in_floats(expression)
    except (ArithmeticError, ValueError):
        return
    worst = condition(expression)
    assert abs(found - float(ball)) < 1e-12 * max(worst, 1.0)


def in_floats(expression: Expression) -> float:
    """The value by Python's math, at the same names."""
    match expression:
        case Literal(value=number):
            return int(number.p) / int(number.q)
        case Name(name=name):
            return math.pi if name == "pi" else float(int(NAMES[name].p) / int(NAMES[name].q))
        case Chain(signs=signs, operands=operands):
            total = 0.0 if signs[0] in "+-" else 1.0
            for sign, x in zip(signs, map(in_floats, operands), strict=True):
                total = (
                    {"+": total + x, "-": total - x, "*": total * x}[sign]
                    if sign != "/"
                    else total / x
                )
            return total
        case Power(base=base, exponent=exponent):
            return float(in_floats(base) ** exponent)
        case RealPower(base=base, exponent=exponent):
            return math.pow(in_floats(base), in_floats(exponent))
        case Root(radicand=radicand):
            return math.sqrt(in_floats(radicand))
        case Call(function=function, argument=argument):
            return float(getattr(math, function)(in_floats(argument)))
    raise TypeError(expression)


def condition(expression: Expression) -> float:
    """How much relative changes of 2^-40 in the names and numbers change the value, times 2^40."""
    with ctx.workprec(300):
        spread = arb(1, arb(2) ** -40)
        try:
            ball = arb(
                value_of(expression, {**NAMES, **{x: arb(y) * spread for x, y in NAMES.items()}})
            )
        except ExpressionError:
            return math.inf
        return float(ball.rad()) * 2.0**40 + abs(float(ball)) + 1e3


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("x**2/2 + px", fmpq(-5, 18)),
        ("(x + 1/3)**3", fmpq(1)),
        ("x**-1", fmpq(3, 2)),
        ("2**(1 + 1)", fmpq(4)),
        ("sqrt(4/9)", fmpq(2, 3)),
        ("cbrt(-8)", fmpq(-2)),
        ("root(32, 5)", fmpq(2)),
        ("-x^2", fmpq(-4, 9)),
        ("0**(3/2)", fmpq(0)),
        ("1.5e1", fmpq(15)),
    ],
)
def test_rational_values_are_exact(text: str, wanted: fmpq) -> None:
    """What is rational by rational operations stays so."""
    found = value(text)
    assert isinstance(found, fmpq)
    assert found == wanted


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("sin(pi/6)", 0.5),
        ("exp(1)", math.e),
        ("log(x)", math.log(2 / 3)),
        ("4**1.5", 8.0),
        ("x**0.25", (2 / 3) ** 0.25),
        ("atan(1)*4", math.pi),
        ("tanh(x) - sinh(x)/cosh(x)", 0.0),
        ("cbrt(-2)", -(2 ** (1 / 3))),
        ("asin(x) + acos(x) - pi/2", 0.0),
    ],
)
def test_irrational_values(text: str, wanted: float) -> None:
    """Functions, π and roots, to the digits of a float."""
    assert float(arb(value(text))) == pytest.approx(wanted, abs=1e-14)


@pytest.mark.parametrize(
    ("text", "message", "start", "end"),
    [
        ("log(-1)", "log of -1 is not a real number", 0, 7),
        ("1 + log(px)", "log of px = -1/2 is not a real number", 4, 11),
        ("1/(x - 2/3)", "division by zero", 3, 10),
        ("x/0", "division by zero", 2, 3),
        ("(sqrt(2)**2 - 2)**-1", "division by zero", 1, 15),
        ("sqrt(px)", "an even root of px = -1/2", 0, 8),
        ("px**0.5", "a power with the exponent 1/2 of -1/2", 0, 7),
        ("px**(1/3)", "a power with the exponent 1/3 of -1/2", 0, 9),
        ("x**pi", "the exponent pi is not a rational number", 3, 5),
        ("asin(2)", "asin of 2 is not a real number", 0, 7),
        ("tan(pi/2)", "tan of pi/2 = 1.5708 is not a real number", 0, 9),
        ("0**(-1)", "division by zero", 0, 1),
    ],
)
def test_what_has_no_value_is_refused_with_its_place(
    text: str, message: str, start: int, end: int
) -> None:
    """The operation that fails, what it is of, and its offsets."""
    with pytest.raises(UndefinedValue) as caught:
        value(text)
    assert message in caught.value.message
    assert (caught.value.start, caught.value.end) == (start, end)


@pytest.mark.parametrize(
    "text",
    [
        "x*" * 10_001 + "x",
        "(" * 61 + "x" + ")" * 61,
        "sin(" * 61 + "x" + ")" * 61,
        "x**65",
        "x**-65",
        "x**(64 + 1)",
        "x**0.12345",
        "((((2**64)**64)**64)**64)",
        "exp(exp(exp(9)))",
        "exp(-exp(20))",
        "1e303*x",
        "sinh(1e9)",
        "1e1001",
    ],
)
def test_texts_that_would_exhaust_the_machine_are_refused(text: str) -> None:
    """Each limit holds, and is told as a limit."""
    with pytest.raises(LimitExceeded):
        value(text)


@pytest.mark.parametrize(
    ("text", "cure", "start"),
    [
        ("coss(x)", "did you mean 'cos'?", 0),
        ("ln(x)", "write log(x)", 0),
        ("1 + abs(x)", "no derivative at 0", 4),
        ("x(1 + x)", "write products with *", 0),
        ("2x", "write products with *", 1),
        ("x²", "x**2", 1),
        ("sin x", "write products with *", 4),
        ("x**2**3", "parentheses", 4),
        ("sin()", "", 4),
        ("sin(x", "the parenthesis at column 4 is open", 5),
        ("", "such as p**2/2 - cos(x)", 0),
        ("x +", "", 3),
        ("__import__('os')", "functions: sin, cos", 0),
        ("x.y", "", 1),
        ("x if x else x", "", 2),
        ("lambda: 0", "", 6),
    ],
)
def test_what_is_no_formula_is_refused_with_its_place(text: str, cure: str, start: int) -> None:
    """The offset of the fault, and the cure where there is one."""
    with pytest.raises(ExpressionError) as caught:
        parse_formula(text)
    assert caught.value.start == start
    assert cure in caught.value.help


@pytest.mark.parametrize("text", ["sin(1)", "exp(0)", "2**(1/2)", "2**x", "log(2)", "2**1.5"])
def test_coefficients_have_no_functions(text: str) -> None:
    """The grammar of method files is as it was."""
    parse_formula(text)
    with pytest.raises(ExpressionError):
        parse(text)


@given(st.text(alphabet="0123456789.+-*/^()exp sincoqrtla,_\n", max_size=40))
def test_any_text_is_read_or_refused(text: str) -> None:
    """Whatever the text, it has a value or is refused as an expression."""
    try:
        expression = parse_formula(text)
        value_of(expression, dict.fromkeys((x.name for x in names_in(expression)), fmpq(1, 2)))
    except ExpressionError as error:
        start = error.start
    else:
        start = 0
    assert 0 <= start <= len(text)


def test_exponents_are_rational_constants() -> None:
    """A parameter may be one; its value is exact."""
    power = parse_formula("x**(n/2)")
    assert isinstance(power, RealPower)
    assert exponent_of(power.exponent, {"n": fmpq(3)}) == fmpq(3, 2)
    assert isinstance(parse_formula("x**(2)"), Power)


def test_expressions_are_walked() -> None:
    """Names, roots, sizes and substitution see the parts of functions and powers."""
    expression = parse_formula("sin(a*sqrt(b))**(c/2) + a")
    assert [x.name for x in names_in(expression)] == ["a", "b", "c", "a"]
    assert len(list(roots_in(expression))) == 1
    assert size_of(expression, {"a": 100}) == 209
    values = {x: parse_formula(y) for x, y in (("a", "pi"), ("b", "4"), ("c", "1 + 1"))}
    assert format_expression(substitute(expression, values)) == "sin(pi*sqrt(4))**((1+1)/2)+pi"
    assert (
        format_expression(parse_formula("sin(x)**(1/2)"), latex=True)
        == r"\sin\left(x\right)^{\frac{1}{2}}"
    )
