"""The equations of first lectures: their solutions solve them, their invariants stay."""

from __future__ import annotations

import pytest
import sympy
from flint import fmpq

from garkcli import converge, find_order, load
from garkcli.problems.builtin import problem
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.vectorfield import TIME, symbols


@pytest.mark.parametrize("name", ["dahlquist", "logistic"])
def test_the_solution_solves_it(name: str) -> None:
    """ẏ − f(y) is zero, and y(0) is the start."""
    made = problem(name, 1)
    assert isinstance(made, RightHandSide)
    assert made.exact is not None
    (y,), (t,) = symbols(made.variables, "y"), symbols(made.variables, TIME)
    (solution,), (f,) = made.exact, made.total
    assert sympy.simplify(solution.diff(t) - f.subs(y, solution)) == 0
    assert fmpq(str(solution.subs(t, 0))) == made.initial[0]


@pytest.mark.parametrize("name", ["lotka-volterra", "robertson"])
def test_the_invariant_stays(name: str) -> None:
    """Its derivative along the flow is zero."""
    made = problem(name, 2)
    assert isinstance(made, RightHandSide)
    ((_, invariant),) = made.invariants
    unknowns = symbols(made.variables, "y")
    flow = zip(unknowns, made.total, strict=True)
    assert sympy.simplify(sum(invariant.diff(y) * f for y, f in flow)) == 0


@pytest.mark.parametrize("name", ["dahlquist", "logistic", "lotka-volterra", "robertson"])
@pytest.mark.parametrize("method", ["rk4", "radau-iia-2", "ars-222"])
def test_it_shows_the_order(name: str, method: str) -> None:
    """That of the certificate, as no tree of order p + 1 can hide it for long."""
    test = converge(method, name)
    order = find_order(load(method).tableau).order
    assert test.verdict == "agree"
    assert abs(float(test.observed_order or 0) - order) < 0.3
