"""The lines that define letters for roots."""

from __future__ import annotations

from flint import fmpq, fmpz_poly

from garkcli.exact.letters import LETTERS
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import root_decimal
from garkcli.exact.rewriting import PlainText
from garkcli.exact.roots import RealRoot
from garkcli.page.exactly import polynomial_latex

DIGITS = 12
"""Digits of the decimal behind a letter."""


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
