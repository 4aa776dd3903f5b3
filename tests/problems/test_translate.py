"""Formulas as sympy expressions: the same values, real and differentiable, of bounded length."""

from __future__ import annotations

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import assume, given, settings

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact.formula import parse_formula, value_of
from garkcli.exact.nodes import Expression
from garkcli.problems.straightline import function
from garkcli.problems.translate import Translator, size_of_derivatives
from tests.exact.test_formula import FORMULAS, NAMES
from tests.whole import at_most, in_whole

SYMBOLS = {name: sympy.Symbol(name, real=True) for name in ("x", "px", "y")}
PLAIN = Translator(SYMBOLS, {})


def translated(text: str) -> sympy.Expr:
    """The sympy expression of a text in x, px and y."""
    return PLAIN.translate(parse_formula(text))


@in_whole
@settings(deadline=None, max_examples=at_most(20, 80))
@given(FORMULAS)
def test_values_stay(expression: Expression) -> None:
    """Translated, differentiated once by nothing, and written as code for balls, a formula has the
    value it had.
    """
    try:
        with ctx.workprec(300):
            wanted = arb(value_of(expression, NAMES))
        made = PLAIN.translate(expression)
    except ExpressionError:
        assume(False)
        return
    with ctx.workprec(300):
        run = function((sympy.sympify(made),), (SYMBOLS["x"], SYMBOLS["px"]), True)
        (found,) = run(arb(NAMES["x"]), arb(NAMES["px"]))
    assert arb(found).overlaps(wanted)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("x**2/2 - y", "x**2/2 - y"),
        ("cbrt(-8)*x", "-2*x"),
        ("cbrt(-2)*x", "-2**(1/3)*x"),
        ("root(2, 5)", "2**(1/5)"),
        ("(x**2 + y**2)**(-3/2)", "(x**2 + y**2)**(-3/2)"),
        ("tan(x + pi/2)", "-1/tan(x)"),
        ("sqrt(x)**2", "x"),
        ("exp(1)*x", "E*x"),
        ("-x - -y", "-x + y"),
        ("x/y/2", "x/(2*y)"),
        ("0.1*x", "x/10"),
    ],
)
def test_what_is_made(text: str, wanted: str) -> None:
    """Exact numbers, real roots, and functions that there is code for."""
    assert str(translated(text)) == wanted


@pytest.mark.parametrize(
    ("text", "message", "start"),
    [
        ("y + sqrt(x**2)", "this has |x|", 4),
        ("((x + y)**2)**1.5", "this has |x + y|", 0),
        ("(x**4)**(1/4)", "this has |x|", 0),
        ("y + cbrt(x)", "only square roots are taken of variables", 4),
        ("x + log(-1)", "log of -1 is not a real number", 4),
        ("x**y", "the exponent depends on y", 3),
        ("y*x**(2*px)", "the exponent depends on px", 8),
        ("sqrt(-1 - 1)*x", "an even root", 0),
        ("sqrt(-x**2)", "this has |x|", 0),
    ],
)
def test_what_is_not_smooth_or_real_is_refused(text: str, message: str, start: int) -> None:
    """What, and where in the text."""
    with pytest.raises(UndefinedValue) as caught:
        translated(text)
    assert message in caught.value.message
    assert caught.value.start == start


@pytest.mark.parametrize(
    "text",
    [
        "(x**8)**9",
        "((10**900*x)**64)*((10**900*y)**64)",
        "(1/3**64*x)**64*(1/3**64*y)**64*x/7**40/2**9999",
        "1e200*x*1e200/y",
        "y + (-1e200)**3*x",
    ],
)
def test_large_numbers_are_refused(text: str) -> None:
    """Exponents and coefficients are bounded together, too."""
    with pytest.raises(LimitExceeded):
        translated(text)


def test_parameters_stand_for_their_expressions() -> None:
    """Exact ones as numbers; exponents may be made of them."""
    third = sympy.Rational(1, 3)
    translator = Translator({**SYMBOLS, "a": third}, {"a": fmpq(1, 3)})
    assert str(translator.translate(parse_formula("a*x**(3*a/2)"))) == "sqrt(x)/3"


@pytest.mark.parametrize(
    "text",
    [
        "x*y*px",
        "sin(x*y)*cos(px)",
        "(x + y)**8/(1 + px**2)",
        pytest.param("*".join(f"(x + {i}*y)" for i in range(1, 9)), marks=in_whole),
        "sin(sin(sin(sin(sin(x)))))",
        "1/sqrt(x**2 + y**2) + x**4*y**3 + exp(-px)",
        "+".join(f"(x - {i}*px)**4" for i in range(9)),
    ],
)
def test_length_of_derivatives_is_estimated(text: str) -> None:
    """Within a factor of six of what sympy makes of them, which the limit is for."""
    made = translated(text)
    actual = sum(
        sum(1 for _ in sympy.preorder_traversal(made.diff(x, y)))
        for x in SYMBOLS.values()
        for y in SYMBOLS.values()
        if made.diff(x, y) != 0
    )
    assert actual / 6 < size_of_derivatives(made) < 6 * actual


def test_long_products_have_longer_derivatives() -> None:
    """The estimate of a product of n factors grows like the cube, and is made without
    derivatives.
    """
    sizes = [
        size_of_derivatives(translated("*".join(f"(x + {i})" for i in range(n))))
        for n in (50, 100, 200)
    ]
    assert 7 < sizes[1] / sizes[0] < 9
    assert 7 < sizes[2] / sizes[1] < 9


def test_of_several_kinks_the_same_one_is_told() -> None:
    """Of √(x²y²) sympy makes |x| and |y|, in a set, which has no first one."""
    with pytest.raises(UndefinedValue, match=r"this has \|x\|"):
        translated("sqrt(x**2*y**2)")
