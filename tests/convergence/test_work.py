"""Costs of steps, against what is counted by hand."""

from __future__ import annotations

from itertools import count

import pytest
from flint import fmpq

from garkcli.convergence import solver
from garkcli.convergence.convergence import converge
from garkcli.convergence.solver import cost_of, work_of
from garkcli.families.registry import diagonal_method
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.stepping.integrator import Stepper, bind, integrate
from garkcli.tableau.forms import gark, pair
from tests.stepping.test_step import RECTANGULAR, RK4, coupled
from tests.whole import in_whole


def test_explicit_method_is_counted_by_hand() -> None:
    """rk4 has four stages with a velocity and a force each, and nothing to solve."""
    y, cost = work_of(bind(RK4, hamiltonian("pendulum", 1)).at(), fmpq(1, 10), 50)
    assert (cost.steps, cost.evaluations, cost.iterations, cost.jacobians) == (50, 400, 0, 0)
    assert cost.seconds is not None
    assert 0 < cost.seconds < 1
    assert y == integrate(bind(RK4, hamiltonian("pendulum", 1)).at(), fmpq(1, 10), 50)


def test_clocks_that_tick_seldom_have_the_mean(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that moves once in two hundred looks shows no single run: a hundred of them took a
    tick.
    """
    looks = count()
    monkeypatch.setattr(solver, "process_time", lambda: next(looks) // 200)
    made = bind(RK4, hamiltonian("pendulum", 1)).at()
    _, cost = work_of(made, fmpq(1, 10), 1)
    assert cost.seconds == pytest.approx(1 / 100)


def test_implicit_method_iterates() -> None:
    """An iteration of Gauss 2 evaluates both fields at both stages; besides, each step has its
    constant share.
    """
    tableau = gark([diagonal_method("gauss", 2)], {})
    made = bind(tableau, hamiltonian("pendulum", terms_of(tableau))).at()
    outside = set()
    for n in (4, 16, 256):
        _, cost = work_of(made, fmpq(4, n), n)
        assert cost.iterations >= n
        assert cost.jacobians >= 1
        outside.add(fmpq(cost.evaluations - 4 * cost.iterations, n))
    assert len(outside) == 1
    assert 0 <= outside.pop() <= 6


def test_digits_cost_evaluations() -> None:
    """More digits take more iterations."""
    costs = []
    for digits in (15, 40):
        state = Stepper(bind(RECTANGULAR, hamiltonian("pendulum", 2)).at(digits), fmpq(1, 10))
        state.advance(20)
        costs.append(cost_of(state))
    assert costs[0].seconds is None
    assert costs[1].evaluations > costs[0].evaluations


@in_whole
def test_time_is_measured_where_floats_reach() -> None:
    """Gauss 3 × Lobatto IIIA 4 leaves the range of floats: its last rows have counts and no
    time.
    """
    tableau = pair(coupled(3, 4))
    steps = [fmpq(1, 2**k) for k in (0, 1, 2, 3, 7, 10)]
    rows = converge(tableau, hamiltonian("generic", 2), steps=steps, is_timed=True).rows
    timed = [row.cost is not None and row.cost.seconds is not None for row in rows]
    assert timed[:4] == [True] * 4
    assert not timed[-1]
    assert all(row.cost is not None and row.cost.evaluations > 0 for row in rows)
    assert rows[-1].cost is not None
    assert rows[-1].cost.steps == 1024
