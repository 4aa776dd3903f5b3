"""``gark converge`` of Rosenbrock methods: steps with the exact Jacobian, and with other matrices."""

from __future__ import annotations

import re

import pytest
from flint import fmpq
from mpmath import lu_solve, matrix, mp, mpc, mpf

from garkcli.api.runs import converge, taking
from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.convergence.linear_solver import hamiltonian_of, linear_solver
from garkcli.errors import MethodError
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.files.load import loads_problem
from garkcli.problems.oscillator import Oscillator
from garkcli.stepping.integrator import bind, integrate
from garkcli.stepping.linearly_implicit import Taken
from tests.bridges.test_rosenbrock import TIMED, number, printed_run
from tests.cli.harness import gark

WRONG_D = """
name: wrong d
rosenbrock: {alpha: [[], [1]], gamma: [[1/2], [-1, 1/2]], b: [1/2, 1/2], d: [1/2, 1/2]}
"""
WITH_TIME = """
name: time in it
variables: [y1, y2]
rhs:
  - {y1: "y2*cos(t)", y2: "-sin(y1)"}
initial: {y1: 6/5, y2: 2/5}
t_end: 2
"""


@pytest.mark.parametrize(
    ("name", "order"), [("ros3p", 3), ("rodas3", 3), ("grk4t", 4), ("ros2", 2)]
)
def test_the_observed_order_is_that_of_check(name: str, order: int) -> None:
    """On the problem that sees every tree."""
    found = converge(name)
    assert found.verdict == "agree"
    assert found.predicted_order == order
    assert found.visible.order == order
    assert found.observed_order is not None
    assert abs(found.observed_order - order) < 0.1


@pytest.mark.parametrize("name", ["timed", "ros3p", "lassp-34"])
def test_steps_are_those_of_the_definition(name: str) -> None:
    """With 40 digits and in floats, on a problem with t: also where the γ_ii differ, one is 0, or c
    and d are no row sums.
    """
    tableau = (loads(TIMED) if name == "timed" else load(name)).tableau
    bound = bind(tableau, loads_problem(WITH_TIME))
    with mp.workdps(45):
        wanted = printed_run(name)
        for digits, near in ((40, "1e-38"), (15, "1e-13")):
            found = integrate(bound.at(digits), fmpq(1, 3), 6)
            for x, y in zip(found, wanted, strict=True):
                text = repr(x) if digits == 15 else x.str(45, radius=False)
                assert abs(mpf(text) - y) < mpf(near)


def test_the_step_on_the_oscillator_is_r_of_z() -> None:
    """With q + ip = z: ż = −iz, so a step multiplies by R(−ih) = 1 + z bᵀ (I − z (α + γ))⁻¹ 𝟙,
    both by steps and by the exact step map.
    """
    tableau = load("ros3p").tableau
    method = Rosenbrock.of(tableau)
    h, steps = fmpq(1, 4), 16
    with mp.workdps(40):
        s, z = 3, mpc(0, -mpf(1) / 4)
        beta = matrix(s, s)
        for i in range(s):
            for j in range(s):
                alpha, gamma = method.alpha[0][0][i][j], method.gamma[0][0][i][j]
                beta[i, j] = number(alpha) + number(gamma)
        stages = lu_solve(mp.eye(s) - z * beta, matrix([1] * s))
        R = 1 + z * sum(number(x) * y for x, y in zip(method.b[0], stages, strict=True))
        end = (mpc(1, mpf(1) / 2)) * R**steps
        oscillator = Oscillator.default(1)
        problem = hamiltonian_of(oscillator, fmpq(4))
        found = integrate(bind(tableau, problem).at(35), h, steps)
        assert abs(mpf(found[0].str(40, radius=False)) - end.real) < mpf("1e-32")
        assert abs(mpf(found[1].str(40, radius=False)) - end.imag) < mpf("1e-32")
        row = linear_solver(tableau, oscillator, fmpq(4)).row(h, None)
        exact = mpc(1, mpf(1) / 2) * mp.expj(-4)
        assert abs(mpf(row.error.mid().str(30, radius=False)) - abs(end - exact)) < mpf("1e-12")


def test_a_wrong_d_shows_where_f_depends_on_t() -> None:
    """Order 2 without t, and 1 with it, as check says of f(t, y)."""
    method = loads(WRONG_D)
    assert converge(method, "pendulum").predicted_order == 2
    found = converge(method, loads_problem(WITH_TIME))
    assert (found.predicted_order, found.verdict) == (1, "agree")
    assert found.observed_order is not None
    assert abs(found.observed_order - 1) < 0.05


def test_high_orders_take_digits() -> None:
    """A method of order 4 shows 4, also where floats would end."""
    found = converge("shampine-rosenbrock-4")
    assert found.verdict == "agree"
    assert found.rows[-1].digits is not None
    assert found.rows[-1].digits > 15


def test_the_cost_of_steps() -> None:
    """A step has one Jacobian, and an evaluation a stage of the velocities and of the forces."""
    found = converge("ros3p", hamiltonian("pendulum", 1), steps=["1/4"], is_timed=True)
    (row,) = found.rows
    assert row.cost is not None
    assert (row.cost.steps, row.cost.evaluations, row.cost.jacobians) == (16, 96, 16)


def test_a_linear_problem_sees_fewer_trees() -> None:
    """ROS2 with the γ of a third order R(z) shows order 3 there, and 2 on others."""
    text = "rosenbrock: {alpha: [[], [1]], gamma: [[g], [-2*g, g]], b: [1/2, 1/2]}\n"
    text += "parameters: {g: 1/2 + sqrt(3)/6}\n"
    method = loads(text)
    found = converge(method, "split-oscillator")
    assert (found.predicted_order, found.visible.order, found.verdict) == (2, 3, "agree")
    assert linear_solver(method.tableau, Oscillator.default(1), fmpq(4)).visible.order == 3
    assert converge(method).visible.order == 2


def test_stiff_problems_have_no_stage_order() -> None:
    """The report says how stiff the problem is, and names no stage order."""
    run = gark("converge", "ros3p", "--problem", "prothero-robinson", "--stiffness", "1e6")
    assert "reduced by stiffness" in " ".join(run.out.split())
    assert "classical order 3\n" in run.out
    assert "stage order" not in run.out


def test_steps_that_need_later_stages_are_refused() -> None:
    """With the reason."""
    method = loads("rosenbrock: {alpha: [[0, 1], [1, 0]], gamma: [[1, 0], [0, 1]], b: [1/2, 1/2]}")
    with pytest.raises(MethodError, match="a stage needs a later one"):
        converge(method, "pendulum")
    run = gark("converge", "ros3p", "rk4", "--problem", "pendulum")
    assert run.code == 0
    assert "2 methods: 2 agree" in run.out


@pytest.mark.parametrize(
    ("name", "jacobian", "order"),
    [("rodas3", "old", 2), ("rodas3", "diagonal", 1), ("ros2", "diagonal", 2), ("ros3p", "old", 2)],
)
def test_other_matrices_show_their_orders(name: str, jacobian: Taken, order: int) -> None:
    """With the Jacobian of the step before, and with its diagonal alone, the observed order is that
    which gark check proves with an old Jacobian, and with any matrix.
    """
    method = load(name)
    tableau = method.tableau
    which = {"old": "with_old_jacobian", "diagonal": "with_any_matrix"}[jacobian]
    assert find_order(getattr(Rosenbrock.of(tableau), which)).order == order
    found = converge(method, jacobian=jacobian)
    assert (found.predicted_order, found.visible.order, found.verdict) == (order, order, "agree")
    assert found.observed_order is not None
    assert abs(found.observed_order - order) < 0.1


@pytest.mark.parametrize("jacobian", ["old", "diagonal"])
def test_steps_with_other_matrices_are_those_of_the_definition(jacobian: Taken) -> None:
    """On a problem with t, with 40 digits: J and ∂f/∂t at (t − h, y − h f), or the diagonal of J
    with ∂f/∂t = 0, with J and f written out here.
    """
    tableau = load("ros3p").tableau
    method = Rosenbrock.of(tableau)
    alpha, gamma = method.alpha[0][0], method.gamma[0][0]
    bound = bind(taking(tableau, None, jacobian), loads_problem(WITH_TIME))
    with mp.workdps(45):
        c, d = ([number(x) for x in row[0]] for row in method.nodes)
        h, t, y = mpf(1) / 3, mpf(0), matrix([mpf(6) / 5, mpf(2) / 5])

        def f(t: mpf, y: matrix) -> matrix:
            return matrix([y[1] * mp.cos(t), -mp.sin(y[0])])

        for _ in range(6):
            at_t, at = (t, y) if jacobian == "diagonal" else (t - h, y - h * f(t, y))
            J = matrix([[0, mp.cos(at_t)], [-mp.cos(at[0]), 0]])
            slopes = matrix([-at[1] * mp.sin(at_t), 0])
            if jacobian == "diagonal":
                J, slopes = matrix([[0, 0], [0, 0]]), matrix([0, 0])
            k: list[matrix] = []
            for i in range(3):
                seen, beside = y, matrix([0, 0])
                for j in range(i):
                    seen += number(alpha[i][j]) * k[j]
                    beside += number(gamma[i][j]) * k[j]
                right = h * f(t + c[i] * h, seen) + h * h * d[i] * slopes + h * J * beside
                k.append(lu_solve(mp.eye(2) - h * number(gamma[i][i]) * J, right))
            for b, x in zip(method.b[0], k, strict=True):
                y += number(b) * x
            t += h
        found = integrate(bound.at(40), fmpq(1, 3), 6)
        for x, wanted in zip(found, y, strict=True):
            assert abs(mpf(x.str(45, radius=False)) - wanted) < mpf("1e-38")


def test_other_matrices_on_the_command_line() -> None:
    """--jacobian is told in the report, and refused where it means nothing."""
    run = gark("converge", "rodas3", "--jacobian", "old")
    assert run.code == 0
    assert "order 2.00 observed" in run.out
    assert "Jacobian" in run.out
    assert "Jacobian" not in gark("converge", "rodas3").out
    several = gark("converge", "rodas3", "ros3p", "--jacobian", "old", "--steps", "1/2,1/4")
    assert re.search(r"^ *Jacobian +old$", several.out, re.M)
    assert "applies to Rosenbrock methods only" in gark("converge", "rk4", "--jacobian", "old").err
    run = gark("converge", "rodas3", "--jacobian", "old", "--problem", "oscillator")
    assert "the oscillator takes" in run.err
