"""Polynomials, algebraic numbers and the letters of these as text and as data."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from flint import arb, fmpq, fmpz_poly

from garkcli.exact.display import to_latex
from garkcli.exact.field import Number
from garkcli.exact.letters import LETTERS
from garkcli.exact.multivariate import Multivariate
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.parametric import Parametric
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    integral,
    polynomial_text,
    power_text,
    root_decimal,
    root_text,
)
from garkcli.exact.rewriting import PlainText
from garkcli.exact.roots import RealRoot
from garkcli.page.schema import TEXT, Schema, one_of

ROOT_OF: Schema = {
    "type": "object",
    "required": ["root_of", "decimal"],
    "properties": {"root_of": TEXT, "decimal": TEXT},
    "additionalProperties": False,
}
"""An algebraic number without simple radicals: a polynomial in x and a decimal."""
ALGEBRAIC: Schema = one_of(TEXT, ROOT_OF)
DIGITS = 12


def polynomial_latex(p: Polynomial, variable: str) -> str:
    r"""Returns a polynomial in LaTeX, highest power first.

    >>> print(polynomial_latex(Polynomial([48, -22, 1]), "x"))
    x^{2}-22x+48
    """
    descending = reversed(list(enumerate(p.coefficients)))
    return sum_latex((a, power_text(variable, k, f"{{{k}}}")) for k, a in descending)


def multivariate_latex(p: Multivariate, variables: Sequence[str]) -> str:
    terms = []
    for exponents, a in p.terms:
        named = zip(variables, exponents, strict=True)
        terms.append((a, "".join(power_text(x, k, f"{{{k}}}") for x, k in named)))
    return sum_latex(terms)


def quotient_latex(p: Polynomial, q: Polynomial, variable: str) -> str:
    """Returns p/q in LaTeX with integer coefficients."""
    over, under = (polynomial_latex(x, variable) for x in integral([p, q]))
    return over if under == "1" else rf"\frac{{{over}}}{{{under}}}"


def sum_latex(
    terms: Iterable[tuple[Number | Parametric | arb, str]], latex: Callable[[Any], str] = to_latex
) -> str:
    """Returns a sum in LaTeX without zero terms."""
    text = ""
    for a, power in terms:
        factor = latex(a)
        if factor == "0":
            continue
        is_sum = not isinstance(a, arb) and " " in str(a)
        is_negative = factor.startswith("-") and not is_sum
        factor = factor.removeprefix("-") if is_negative else factor
        if is_sum:
            factor = rf"\left({factor}\right)"
        text += "-" if is_negative else "+"
        text += power if factor == "1" and power else factor + power
    return text.removeprefix("+") or "0"


def root_data(root: RealRoot, digits: int = 17) -> Any:
    simple = root_text(root)
    if simple is not None:
        return simple
    polynomial = polynomial_text(Polynomial.from_flint(root.polynomial), "x")
    return {"root_of": polynomial, "decimal": root_decimal(root, digits)}


def decimal_of(root: AlgebraicRoot) -> str:
    return root_decimal(RealRoot(fmpz_poly([*root.coefficients]), root.number), DIGITS)


def definition(root: AlgebraicRoot, letter: str) -> str:
    """``γ = root_of(6*x**3-18*x**2+9*x-1, 0.4358665215) = 0.435866521508…``."""
    return f"{letter} = {PlainText().algebraic(root)} = {decimal_of(root)}…"


def definition_latex(root: AlgebraicRoot, letter: str) -> str:
    r"""``6\gamma ^{3}-18\gamma ^{2}+9\gamma -1 = 0``, with its decimal."""
    command = LETTERS[letter]
    polynomial = polynomial_latex(Polynomial([fmpq(a) for a in root.coefficients]), command)
    return rf"{polynomial} = 0, \quad {command}\approx {decimal_of(root)}"
