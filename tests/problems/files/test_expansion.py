"""How long equations for velocities get: never underestimated, and refused before they are
multiplied out.
"""

from __future__ import annotations

from time import process_time
from typing import Any

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.errors import MethodFileError
from garkcli.problems.files.expansion import _fraction, too_long
from garkcli.problems.files.load import loads_problem
from tests.whole import at_most

v, x, y = sympy.symbols("v x y")
FORMULAS = st.recursive(
    st.sampled_from(
        [v, x, y, sympy.Integer(1), sympy.Integer(2), sympy.Rational(1, 3), sympy.sin(x)]
    ),
    lambda below: st.one_of(
        st.builds(lambda a, b: a + b, below, below),
        st.builds(lambda a, b: a * b, below, below),
        st.builds(lambda a, n: a**n, below, st.integers(0, 3)),
    ),
    max_leaves=8,
)
MANY = [f"y{i}" for i in range(20)]


def problem(lagrangian: str, variables: list[str]) -> str:
    """A file of one term that moves with every variable."""
    initial = ", ".join(f"{q}: {k + 1}, v{q}: 1/2" for k, q in enumerate(variables))
    return (
        f"variables: [{', '.join(variables)}]\nlagrangian: {lagrangian}\ninitial: {{{initial}}}\n"
    )


@given(FORMULAS, FORMULAS)
@settings(max_examples=at_most(20, 60), deadline=None)
def test_terms_are_not_underestimated(numerator: Any, denominator: Any) -> None:
    """A polynomial has at most so many terms; nor does it matter that it is divided by another
    one.
    """
    assert len(sympy.Add.make_args(sympy.expand(numerator))) <= _fraction(numerator).terms
    if denominator != 0:
        quotient = numerator + 1 / denominator
        top = sympy.expand(sympy.together(quotient).as_numer_denom()[0])
        assert len(sympy.Add.make_args(top)) <= _fraction(quotient).terms


def test_what_is_undone_is_not_multiplied_out() -> None:
    """Powers and functions of what has the velocity alone are undone, and linear equations
    eliminated.
    """
    w = sum(sympy.symbols("w1:30"))
    assert too_long((v - w) ** 64, [v]) is None
    assert too_long(v**2 * (1 + x + y) ** 64, [v]) is None
    assert too_long(v**2 + (1 + x + y + v) ** 64, [v]) == v
    assert too_long(v**2 / 2 + sympy.sqrt(1 - v**2 - x), [v]) is None


@pytest.mark.parametrize(
    "text",
    [
        problem("(sqrt(vz) - vz - sqrt(2))**64 + z", ["z"]),
        problem("((1 + (vy + y + 1 + cbrt(7)**2)**2))**64", ["y"]),
        problem("vx**2 + " + " + ".join(f"v{q}**2 + log(vx + {q})" for q in MANY), ["x", *MANY]),
        problem("(vx**2 + vy**2 + x + y)**40", ["x", "y"]),
    ],
)
def test_long_equations_are_refused_soon(text: str) -> None:
    """Files that took gigabytes or minutes: refused in a second of the processor, at the term."""
    before = process_time()
    with pytest.raises(MethodFileError, match=r"was not solved for v., it is too long") as caught:
        loads_problem(text)
    assert process_time() - before < 5
    assert [(fault.line, fault.column) for fault in caught.value.faults] == [(2, 13)]
