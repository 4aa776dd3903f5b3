"""Observed orders on nonlinear problems, the reference solution, and their report."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from flint import arb, fmpq

from garkcli.convergence.convergence import converge
from garkcli.convergence.result import Convergence, StepSizeRow, Visible
from garkcli.convergence.stepped_solver import SteppedSolver
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.integrator import bind, integrate
from garkcli.tableau.forms import gark as gark_tableau
from garkcli.tableau.forms import pair, spelled_out
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import interpolation
from tests.cli.harness import ROOT, gark
from tests.stepping.test_step import RECTANGULAR, RK4, coupled
from tests.whole import in_whole

VERLET = str(ROOT / "methods" / "stoermer-verlet.gark.yaml")
COLLOCATION = str(ROOT / "methods" / "collocation.gark.yaml")


def observed(tableau: Tableau, name: str, seed: int = 1) -> Convergence:
    """The convergence test with its defaults."""
    return converge(tableau, hamiltonian(name, terms_of(tableau), seed))


@pytest.mark.parametrize(
    ("tableau", "name", "order"),
    [
        (pair(coupled(2, 3)), "generic", 4),
        (pair(coupled(2, 3, interpolation)), "generic", 4),
        (pair(coupled(3, 4)), "generic", 6),
        (pair(coupled(2, 4)), "generic", 2),
        (coupled(2, 3), "generic", 4),
        (RECTANGULAR, "pendulum", 4),
        (RECTANGULAR, "kepler", 4),
        (RK4, "fput", 4),
    ],
)
def test_observed_order_is_the_exact_one(tableau: Tableau, name: str, order: int) -> None:
    """Within 0.01 of the certificate's order, and the last slope within 0.05."""
    result = observed(tableau, name)
    assert (result.predicted_order, result.visible_order) == (order, order)
    assert result.observed_order == pytest.approx(order, abs=0.01)
    assert result.rows[-1].slope == pytest.approx(order, abs=0.05)
    assert result.agrees


@in_whole
def test_order_twelve_is_seen() -> None:
    """Gauss 6 × Lobatto IIIA 7 on generic, from h = 1/8: errors of 1e-25 have slope 12."""
    tableau = pair(coupled(6, 7))
    steps = [fmpq(1, 8 * 2**k) for k in range(3)]
    result = converge(tableau, hamiltonian("generic", 2), steps=steps)
    assert (result.predicted_order, result.visible_order) == (12, 12)
    assert result.observed_order == pytest.approx(12, abs=0.05)
    assert result.rows[-1].digits > 25
    assert result.agrees


def test_separable_problem_hides_the_loss() -> None:
    """The pair of order 2 shows 4 on the pendulum, as predicted from the trees a pendulum sees."""
    result = observed(pair(coupled(2, 4)), "pendulum")
    assert (result.predicted_order, result.visible_order) == (2, 4)
    assert result.observed_order == pytest.approx(4, abs=0.01)


@in_whole
def test_seed_makes_another_problem() -> None:
    """Other coefficients, the same order."""
    tableau = gark_tableau([diagonal_method("kutta")], {})
    result = observed(tableau, "generic", 2)
    assert result.problem.terms != hamiltonian("generic", 1, 1).terms
    assert result.observed_order == pytest.approx(3, abs=0.05)


@in_whole
def test_disagreement_is_told() -> None:
    """Two large steps show no order: slopes far from 4 do not agree."""
    result = converge(RECTANGULAR, hamiltonian("kepler", 2), steps=[fmpq(1, 2), fmpq(1, 4)])
    assert not result.agrees
    assert not converge(RECTANGULAR, hamiltonian("kepler", 2), steps=[fmpq(1, 8)]).agrees


def test_equal_parts_may_only_gain() -> None:
    """Three colours, equal halves of the potential: an order above the visible one is not a
    disagreement.
    """
    methods = [diagonal_method("gauss", 2)] * 3
    blocks = {(l, m): methods[0].A for l in range(3) for m in range(3) if l != m}
    result = observed(gark_tableau(methods, blocks), "pendulum")
    assert result.problem.terms[1] == result.problem.terms[2]
    assert result.agrees


def test_rounded_coefficients_end_on_a_plateau() -> None:
    """rk4 with a weight that is off by 1e-9: the rows without slope are recognised and not
    fitted.
    """
    rk4 = diagonal_method("rk4")
    b = (*rk4.b[:3], rk4.b[3] + fmpq(1, 10**9))
    tableau, problem = (spelled_out([[rk4.A]], [b], [None]), hamiltonian("pendulum", 1))
    steps = [fmpq(4, 4 * 2**k) for k in range(9)]
    result = converge(tableau, problem, steps=steps, tolerance=fmpq(1, 10**8))
    assert result.plateau > 0
    assert result.observed_order == pytest.approx(4, abs=0.05)
    assert result.agrees


def test_invariants_are_reported() -> None:
    """Angular momentum is kept to round-off by the pair, in the table, JSON and CSV."""
    run = gark("converge", VERLET, "--problem", "kepler", "--steps", "1/16,1/32,1/64,1/128")
    assert run.code == 0
    assert "angular momentum error" in run.out
    assert run.out.count("< 1e-1") == 4
    data = json.loads(gark("converge", VERLET, "--problem", "kepler", "--format", "json").out)
    assert data["problem"] == "kepler"
    for step in data["steps"]:
        assert step["invariant_errors"]["angular momentum"] <= 1e-12
        assert step["below_round_off"] == ["angular momentum"]


@pytest.mark.parametrize(
    ("code", "said", "arguments"),
    [
        (2, "H{1} of generic depends on q", ("--problem", "generic")),
        (2, "--omega is for the oscillator", ("--problem", "kepler", "--omega", "2")),
        (2, "--seed is for the problems generic", ("--problem", "pendulum", "--seed", "2")),
        (2, "--seed is for the problems generic", ("--omega", "2", "--seed", "2")),
        (2, "not a whole number of steps", ("--problem", "pendulum", "--steps", "3/7")),
        (1, "THEY DISAGREE", ("--problem", "kepler", "--steps", "1/2,1/4")),
    ],
)
def test_command_says_what_is_wrong(code: int, said: str, arguments: tuple[str, ...]) -> None:
    """Options of another problem, misfits and disagreement."""
    run = gark("converge", VERLET, *arguments)
    assert run.code == code
    assert said in run.out + run.err


def test_failing_step_ends_with_1() -> None:
    """The step, its size and the residual, on stderr."""
    run = gark(
        "converge", COLLOCATION, "--problem", "generic", "--t-end", "1000000", "--steps", "1000000"
    )
    assert run.code == 1
    assert "step 1 of size 1000000" in run.err


def made(observed: float | None, is_sharp: bool = False, **changes: Any) -> Convergence:
    """What would be observed with this order, where 4 is to be seen."""
    row = StepSizeRow(fmpq(1), arb(1), None, arb(0))
    visible = Visible(4, is_sharp, "")
    problem = hamiltonian("pendulum", 2)
    result = Convergence(problem, fmpq(1), (row, row), 0, observed, 4, visible)
    return replace(result, **changes)


@pytest.mark.parametrize(
    ("result", "verdict"),
    [
        (made(4.01), "agree"),
        (made(3.0), "disagree"),
        (made(5.0), "agree"),  # the pendulum may hide trees, and errors may cancel
        (made(5.0, is_sharp=True), "disagree"),
        (made(3.5, short_order=4.0), "agree"),
        (made(3.5, short_order=3.0), "disagree"),
        (made(-1.8, short_order=4.0), "undecided"),  # errors grow as steps shrink
        (made(-1.8, short_order=3.0), "disagree"),
        (made(3.5, short_order=4.0, are_given=True), "disagree"),
        (made(5.0, short_order=5.0, are_given=True), "agree"),
        (made(9.0, short_order=4.0, are_given=True), "disagree"),
        (made(3.5, has_settled=False), "undecided"),
        (made(None), "undecided"),
        (made(None, rows=(StepSizeRow(fmpq(1), arb(0), None, arb(0)),)), "undecided"),
    ],
)
def test_verdict(result: Convergence, verdict: str) -> None:
    """What is observed, over a short time too, against what is to be seen."""
    assert result.verdict == verdict
    assert result.agrees == (verdict == "agree")


@in_whole
def test_small_error_constant_needs_tiny_steps() -> None:
    """An error of h⁴ + h³/10⁵: slopes of 4 at usual steps, and the order is 3; over a short time
    that shows.
    """
    rk4 = diagonal_method("rk4")
    A = (
        *rk4.A[:3],
        (rk4.A[3][0], rk4.A[3][1] + fmpq(1, 10**4), rk4.A[3][2] - fmpq(1, 10**4), rk4.A[3][3]),
    )
    result = converge(spelled_out([[A]], [rk4.b], [None]), hamiltonian("pendulum", 1))
    assert (result.predicted_order, result.visible_order) == (3, 3)
    assert result.observed_order is not None
    assert result.observed_order > 3.5
    assert result.short_order == pytest.approx(3, abs=0.02)
    assert result.verdict == "agree"


@in_whole
def test_exact_solution_has_no_error() -> None:
    """A stone that falls: rk4 makes no error, and there is no order to be seen; a start at rest
    stays there, whatever the method is. Neither confirms an order.
    """
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    fall = Hamiltonian("fall", ("x",), (p**2 / 2 + x,), (fmpq(0), fmpq(1)), fmpq(2))
    rest = replace(hamiltonian("pendulum", 1), initial=(fmpq(0), fmpq(0)))
    for problem, is_at_rest in ((fall, False), (rest, True)):
        result = converge(RK4, problem)
        assert result.is_exact
        assert result.is_at_rest is is_at_rest
        assert (len(result.rows), result.observed_order) == (1, None)
        assert (result.verdict, result.agrees, result.exit_code) == ("undecided", False, 3)


def test_ladder_ends_before_too_many_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is room for few step sizes only, those are kept."""
    monkeypatch.setattr("garkcli.convergence.stepped_solver.MAX_STEPS", 8)
    result = converge(RECTANGULAR, hamiltonian("pendulum", 2))
    assert result.rows[-1].h == hamiltonian("pendulum", 2).t_end / 8
    assert result.observed_order is not None


@in_whole
def test_mixed_orders_need_a_shorter_time() -> None:
    """Gauss 2 in 13 digits: residuals of 1e-14 at order 2, seen only where h⁴ is far smaller than
    that.
    """
    A = [["1/4", "-0.0386751345948"], ["0.5386751345948", "1/4"]]
    tableau = spelled_out([[[[read(x) for x in row] for row in A]]], [[fmpq(1, 2)] * 2], [None])
    result = converge(tableau, hamiltonian("kepler", 1))
    assert result.observed_order == pytest.approx(4, abs=0.1)
    assert result.short_time is not None
    assert result.short_time < fmpq(1, 10**10)
    assert result.short_order == pytest.approx(result.visible_order, abs=0.01)
    assert result.verdict == "agree"


def read(text: str) -> fmpq:
    """A fraction or a decimal."""
    exact = Fraction(text)
    return fmpq(exact.numerator, exact.denominator)


@in_whole
def test_constant_force_is_exact_at_once() -> None:
    """A stone that falls with g = 1/3, which no binary number is: no condition that it sees fails,
    so that round-off is taken for no error without hundreds of digits.
    """
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    fall = Hamiltonian("fall", ("x",), (p**2 / 2 + x / 3,), (fmpq(0), fmpq(1, 7)), fmpq(2))
    result = converge(RK4, fall)
    assert result.is_exact
    assert result.rows[0].digits == 30


def test_usage_errors_come_before_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """Steps that do not divide the time are refused before the order or a solution is looked
    for.
    """

    def never(*_: Any, **__: Any) -> None:
        raise AssertionError("work was done")

    monkeypatch.setattr("garkcli.convergence.convergence.order_of", never)
    monkeypatch.setattr("garkcli.convergence.stepped_solver.reference", never)
    for problem in (hamiltonian("kepler", 2), Oscillator.default(2, fmpq(1))):
        with pytest.raises(UsageProblem, match="not a whole number of steps"):
            converge(RECTANGULAR, problem, steps=[fmpq(1, 2), fmpq(3, 7)])
        with pytest.raises(UsageProblem, match="limit"):
            converge(RECTANGULAR, problem, steps=[fmpq(1, 10**16)])


@pytest.mark.parametrize("order", [2, 4])
def test_the_reference_has_more_digits_than_a_row(order: int) -> None:
    """Six more than are right in a row, and for a method of order 4 at once those of its later
    rows: the solution is not sought twice.
    """
    problem = hamiltonian("kepler", 2)
    solver = SteppedSolver(bind(RECTANGULAR, problem), problem.t_end, Visible(order, False, ""))
    first = solver.row(fmpq(1, 64), None)
    assert (first.digits, solver.reference.digits >= 21) == (15, True)
    if order == 4:
        assert solver.reference.digits >= 26


def test_round_off_is_below_its_bound() -> None:
    """What came out of floats lies far within the ball that the digits promise, for energies that
    are kept: the bound hangs on no rounding.
    """
    for name in ("kepler", "henon-heiles", "fput"):
        problem = hamiltonian(name, 2)
        bound = bind(RECTANGULAR, problem)
        solver = SteppedSolver(bound, problem.t_end, Visible(4, False, ""))
        floats = integrate(bound.at(), fmpq(1, 64), int(64 * problem.t_end))
        exact = integrate(bound.at(40), fmpq(1, 64), int(64 * problem.t_end))
        distance = sum(abs(arb(a) - b) for a, b in zip(floats, exact, strict=True))
        assert distance < solver._round_off(15, fmpq(1, 64)) / 4
