"""Whether an expression is a constant, decided without asking sympy for what it cannot do soon."""

from __future__ import annotations

import pytest
import sympy

from garkcli.problems.vectorfield import is_constant, symbols

(X,) = symbols(("x",), "q")


@pytest.mark.parametrize(
    "expression",
    [
        sympy.sin(10**64 * X),
        sympy.sin(2**300 * X) * sympy.cos(X),
        sympy.tan(10**50 * X) ** 2,
        sympy.sin(sympy.sin(10**64 * X)),
        sympy.cos(X) ** 64 * sympy.sin(X) ** 63,
    ],
)
def test_large_numbers_are_told_by_values(
    expression: sympy.Expr, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With digits enough two values differ; sympy, which halves the angle again and again, is not
    asked.
    """
    monkeypatch.setattr(sympy, "simplify", None)
    assert not is_constant(expression)


def test_what_no_digits_tell_is_no_constant(monkeypatch: pytest.MonkeyPatch) -> None:
    """An identity with large numbers is not left to sympy either: a vector field that may be
    linear is taken not to be.
    """
    monkeypatch.setattr(sympy, "simplify", None)
    large = 2**100 * X
    assert not is_constant(sympy.sin(large) ** 2 + sympy.cos(large) ** 2)


def test_a_constant_written_with_symbols() -> None:
    """With small numbers sympy proves the identity."""
    assert is_constant(sympy.sin(2 * X) ** 2 + sympy.cos(2 * X) ** 2)
    assert is_constant(sympy.log(sympy.exp(X)) - X + 1)
