"""Conserved quantities of nonlinear problems over a long time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import sympy
from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.longtime.courses import Course, LongRun, of_oscillator, whole_run
from garkcli.longtime.energy import MAX_STEPS, drift
from garkcli.longtime.longtime import follow, usual
from garkcli.methodfile.load import load, loads
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian, energy_function, symbols
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stepping.dependency import with_joined_terms
from garkcli.stepping.integrator import bind
from garkcli.stepping.step import StepFailed, trajectory
from garkcli.tableau.tableau import Tableau

RECTANGULAR = "methods/rectangular.gark.yaml"
LEAPFROG = "methods/stoermer-verlet.gark.yaml"
RK4 = """
ark:
  A: [[[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]]
  b: [[1/6, 1/3, 1/3, 1/6]]
"""
EULER = "ark: {A: [[[0]]], b: [[1]]}"
IMPLICIT_EULER = "ark: {A: [[[1]]], b: [[1]]}"
GAUSS3 = "methods: [{family: gauss, stages: 3}]"


def tableau_of(source: str) -> Tableau:
    """Of a file, or of its text."""
    return with_joined_terms((loads(source) if ":" in source else load(source)).tableau)


def run(source: str, name: str, t_end: fmpq | int, h: fmpq, **rest: Any) -> LongRun:
    """A built-in problem, followed."""
    tableau = tableau_of(source)
    return follow(tableau, hamiltonian(name, terms_of(tableau)), fmpq(t_end), h, **rest)


def stepped(source: str, name: str, count: int, h: fmpq) -> np.ndarray:
    """The errors of all invariants after each step, plainly."""
    tableau = tableau_of(source)
    problem = hamiltonian(name, terms_of(tableau))
    measure = energy_function(problem, 15)
    values = np.array([measure(*y) for y in trajectory(bind(tableau, problem).at(), h, count)])
    return values - values[0]


@pytest.mark.parametrize(
    ("name", "h"),
    [
        ("pendulum", fmpq(1, 10)),
        ("kepler", fmpq(1, 50)),
        ("henon-heiles", fmpq(1, 10)),
        ("fput", fmpq(1, 10)),
        ("split-oscillator", fmpq(1, 10)),
    ],
)
def test_the_rectangular_method_stays_and_runge_kutta_drifts(name: str, h: fmpq) -> None:
    """On the same problem with the same steps, each far beyond what rounding can do."""
    symplectic, other = run(RECTANGULAR, name, 200, h), run(RK4, name, 200, h)
    assert [x.verdict for x in symplectic.courses] == [
        "bounded",
        *["round-off"] * (name == "kepler"),
    ]
    assert not symplectic.drifts
    assert all(x.verdict == "drifts" for x in other.courses)
    energy = other.courses[0]
    assert energy.drift is not None
    assert energy.drift < 0
    assert energy.max_error > 1e5 * energy.round_off


def test_the_drift_of_runge_kutta_has_its_order() -> None:
    """Half the step, 2⁵ times less drift; the same per unit of time in a run twice as long."""
    runs = [
        run(RK4, "pendulum", t, h)
        for t, h in ((400, fmpq(1, 10)), (400, fmpq(1, 20)), (800, fmpq(1, 20)))
    ]
    drifts = [x.courses[0].drift or 0 for x in runs]
    assert np.log2(drifts[0] / drifts[1]) == pytest.approx(5, abs=0.1)
    assert drifts[2] == pytest.approx(drifts[1], rel=1e-2)


def test_errors_are_those_of_plain_steps() -> None:
    """The largest error, the errors kept and the states kept are those of the steps one by one."""
    count, h = 6000, fmpq(1, 50)
    plain = stepped(RECTANGULAR, "kepler", count, h)
    result = run(RECTANGULAR, "kepler", count * h, h, points=300)
    assert result.steps == count
    assert 250 < len(result.times) <= 310
    numbers = np.rint(np.array(result.times) * 50).astype(int)
    assert (numbers[0], numbers[-1]) == (0, count)
    assert all(np.diff(numbers) > 0)
    for k, course in enumerate(result.courses):
        assert course.max_error == np.abs(plain[:, k]).max()
        assert list(course.errors) == list(plain[numbers, k])
        assert max(course.errors) == plain[:, k].max()
        assert min(course.errors) == plain[:, k].min()
    assert [t for t, _ in result.states] == [count * h * fmpq(k, 4) for k in range(5)]


def test_short_runs_keep_all() -> None:
    """Every step of a run with fewer than the points asked for."""
    result = run(LEAPFROG, "pendulum", 100, fmpq(1, 10))
    assert len(result.times) == 1001
    assert list(result.courses[0].errors) == list(
        stepped(LEAPFROG, "pendulum", 1000, fmpq(1, 10))[:, 0]
    )


def test_turns_are_counted_across_chunks() -> None:
    """The pendulum turns twice a period, whatever the number of steps; the momentum as often."""
    coarse, fine = (run(LEAPFROG, "pendulum", 200, fmpq(1, n)) for n in (10, 100))
    assert (
        coarse.turns == fine.turns == 59
    )  # with k = sin(θ_max/2) = 0.541 the period is 4K(k) = 6.82


def test_more_digits_show_what_floats_hide() -> None:
    """Gauss 6 conserves the energy of the pendulum to round-off; with 40 digits the error is seen
    to stay.
    """
    text = "methods: [{family: gauss, stages: 6}]"
    floats, digits = (run(text, "pendulum", 60, fmpq(1, 10), digits=n) for n in (15, 40))
    assert floats.courses[0].verdict == "round-off"
    assert floats.courses[0].max_error < 1e-14
    assert digits.courses[0].verdict == "bounded"
    assert 1e-25 < digits.courses[0].max_error < 1e-20
    assert digits.courses[0].round_off < 1e-36


def test_more_digits_are_those_of_the_initial_values_too() -> None:
    """2/5 is no float: with 30 digits the angular momentum is conserved to 30 of them, from the
    first state on.
    """
    _, momentum = run(RECTANGULAR, "kepler", 20, fmpq(1, 50), digits=30).courses
    assert momentum.max_error < 1e-29
    assert momentum.verdict == "round-off"


def test_round_off_is_what_floats_do() -> None:
    """The bound is above the errors of an invariant that only rounding changes, and not by much."""
    momentum = run(RECTANGULAR, "kepler", 400, fmpq(1, 50)).courses[1]
    assert 1e-16 < momentum.max_error < momentum.round_off < 1e-11


def test_explicit_euler_blows_up() -> None:
    """A run that leaves all bounds ends, with errors that are numbers."""
    result = run(EULER, "fput", 100, fmpq(1, 10))
    energy = result.courses[0]
    assert result.blew_up
    assert result.drifts
    assert result.steps < 1000
    assert energy.verdict == "unstable"
    assert energy.drift is None
    assert np.isfinite([energy.max_error, energy.amplitude, *energy.errors]).all()


def test_failed_steps_are_faults_of_the_step() -> None:
    """A step that is too large for Newton's method is reported, not a verdict."""
    with pytest.raises(StepFailed):
        run(GAUSS3, "kepler", 100, fmpq(2))
    with pytest.raises(StepFailed):
        run(IMPLICIT_EULER, "pendulum", 100, fmpq(2))


def test_damping_is_a_move_to_another_level() -> None:
    """The implicit Euler method brings the pendulum to rest; long after that nothing moves."""
    energy = run(IMPLICIT_EULER, "pendulum", 5000, fmpq(1, 10)).courses[0]
    assert energy.verdict == "drifts"
    assert energy.shape == "step"
    assert energy.errors[-1] == pytest.approx(-energy.initial)


def test_growth_that_bends() -> None:
    """Explicit Euler on the pendulum drifts, at whatever rate."""
    energy = run(EULER, "pendulum", 100, fmpq(1, 10)).courses[0]
    assert energy.verdict == "drifts"
    assert energy.drift is not None
    assert energy.drift > 0


@pytest.mark.parametrize(
    ("t_end", "verdict"), [(1, "undecided"), (20, "undecided"), (60, "bounded")]
)
def test_short_runs_are_not_judged(t_end: int, verdict: str) -> None:
    """Neither with few steps nor with few revolutions."""
    assert run(RECTANGULAR, "kepler", t_end, fmpq(1, 50)).courses[0].verdict == verdict


def test_rounded_coefficients_excuse_their_drift() -> None:
    """A drift that rounding of the coefficients can cause is none of the method's, within the
    tolerance only.
    """
    text = """
ark:
  A: [[[0.25, -0.0386751], [0.5386751, 0.25]]]
  b: [[0.5, 0.50000004]]
"""
    h = fmpq(1, 10)
    strict = run(text, "pendulum", 400, h).courses[0]
    loose = run(text, "pendulum", 400, h, tolerance=fmpq(1, 10**6)).courses[0]
    assert strict.verdict == "drifts"
    assert loose.verdict == "bounded"
    assert loose.max_error == strict.max_error


def test_limits() -> None:
    """Too many steps, and steps that do not end at the end."""
    with pytest.raises(UsageProblem, match="limit"):
        run(LEAPFROG, "pendulum", MAX_STEPS + 1, fmpq(1))
    with pytest.raises(UsageProblem, match="whole number"):
        run(LEAPFROG, "pendulum", 1, fmpq(3, 10))


def test_progress_is_told_every_step() -> None:
    """The watch sees the start and each step, and how many there will be."""
    seen = []

    def watch(path: Iterator[Any], total: int) -> Iterator[Any]:
        for y in path:
            seen.append(total)
            yield y

    run(LEAPFROG, "pendulum", 2, fmpq(1, 10), watch=watch)
    assert seen == [21] * 21


def test_no_value_at_the_start() -> None:
    """An energy that is not defined there is said to be so."""
    q, p = symbols(("x",), "q")[0], symbols(("x",), "p")[0]
    problem = Hamiltonian("bad", ("x",), (p**2 / 2 - sympy.log(q),), (fmpq(0), fmpq(1)), fmpq(1))
    with pytest.raises(UsageProblem, match="no value at the start"):
        follow(tableau_of(RK4), problem, fmpq(1), fmpq(1, 10))


def test_usual_runs_are_whole() -> None:
    """Every problem has a step and a time that fit; unknown ones have ten thousand steps."""
    for name in ("split-oscillator", "pendulum", "kepler", "henon-heiles", "fput", "generic"):
        h, t_end = usual(hamiltonian(name, 1))
        assert (t_end / h).q == 1
    problem = hamiltonian("pendulum", 1)
    other = Hamiltonian("mine", problem.variables, problem.terms, problem.initial, fmpq(3))
    h, t_end = usual(other)
    assert t_end / h == 10_000


@pytest.mark.parametrize("step", [None, fmpq(3, 10), fmpq(7)])
@pytest.mark.parametrize("t_end", [None, fmpq(22, 7), fmpq(1, 100)])
def test_whole_runs(step: fmpq | None, t_end: fmpq | None) -> None:
    """What is given is kept, and what is not is near the usual and fits."""
    h, time = whole_run(step, t_end, fmpq(1, 3), fmpq(5))
    assert step is None or h == step
    assert t_end is None or time == t_end
    if step is None or t_end is None:
        assert (time / h).q == 1
    if step is None:
        assert 0 < h <= fmpq(1, 3)
    if t_end is None:
        assert time <= max(5, h)


def oscillator_run(source: str, tolerance: fmpq | None = None, t_end: int = 100) -> Course:
    """The energy of the oscillator."""
    tableau = tableau_of(source)
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    return of_oscillator(drift(tableau, problem, fmpq(t_end), fmpq(1, 2)), tolerance).courses[0]


@pytest.mark.parametrize(
    ("source", "verdict"),
    [
        (RECTANGULAR, "bounded"),
        (GAUSS3, "exact"),
        (RK4, "drifts"),
        (EULER, "drifts"),
        (IMPLICIT_EULER, "drifts"),
    ],
)
def test_the_oscillator_is_judged_exactly(source: str, verdict: str) -> None:
    """By the step map, however short the run."""
    assert oscillator_run(source).verdict == verdict
    assert oscillator_run(source, t_end=1).verdict == verdict


def test_the_oscillator_of_rounded_coefficients() -> None:
    """Within their tolerance they are bounded; without it the determinant is not 1."""
    text = """
ark:
  A: [[[0.25, -0.0386751345948], [0.5386751345948, 0.25]]]
  b: [[0.5, 0.5000000000001]]
"""
    assert oscillator_run(text).verdict == "drifts"
    assert oscillator_run(text, fmpq(1, 10**12)).verdict == "bounded"


def test_the_oscillator_agrees_with_the_nonlinear_path() -> None:
    """The same problem stepped in floats: the same errors and no drift either."""
    tableau = tableau_of(RECTANGULAR)
    exact = of_oscillator(drift(tableau, Oscillator.default(2, fmpq(1)), fmpq(500), fmpq(1, 2)))
    floats = run(RECTANGULAR, "oscillator", 500, fmpq(1, 2))
    assert floats.courses[0].max_error == pytest.approx(exact.courses[0].max_error, rel=1e-9)
    assert list(floats.courses[0].errors) == pytest.approx(list(exact.courses[0].errors), abs=1e-14)
    assert floats.courses[0].amplitude == pytest.approx(exact.courses[0].amplitude, rel=1e-3)
    assert [x.courses[0].verdict for x in (exact, floats)] == ["bounded", "bounded"]
