"""Conserved quantities of nonlinear problems over a long time."""

from __future__ import annotations

import tracemalloc
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.doing import telling
from garkcli.errors import UsageProblem
from garkcli.longtime.history import MAX_STEPS, InvariantHistory, LongRun, whole_run
from garkcli.longtime.longtime import long_run, usual
from garkcli.methodfile.load import load, loads
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.files.load import loads_problem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.problems.problem import quantities_function
from garkcli.problems.vectorfield import symbols
from garkcli.report.energy import REPORT, EnergyReport
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.integrator import StepFailed, bind, trajectory
from garkcli.tableau.tableau import Tableau
from tests.listener import Listener
from tests.longtime.planets import (
    GAUSS_2,
    RALSTON,
    STOERMER_VERLET,
    SUN_JUPITER_SATURN,
    YOSHIDA_4,
    system,
    two_planets,
)
from tests.whole import at_most, in_whole

RECTANGULAR = "methods/rectangular.gark.yaml"
RK4_FILE = "methods/rk4.gark.yaml"
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
    return long_run(tableau, hamiltonian(name, terms_of(tableau)), fmpq(t_end), h, **rest)


def stepped(source: str, name: str, count: int, h: fmpq) -> np.ndarray:
    """The errors of all invariants after each step, plainly."""
    tableau = tableau_of(source)
    problem = hamiltonian(name, terms_of(tableau))
    measure = quantities_function(problem, 15)
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
    assert [x.verdict for x in symplectic.invariants] == [
        "bounded",
        *["round-off"] * (name == "kepler"),
    ]
    assert not symplectic.drifts
    assert all(x.verdict == "drifts" for x in other.invariants)
    energy = other.invariants[0]
    assert energy.drift is not None
    assert energy.drift < 0
    assert energy.max_error > 1e5 * energy.round_off


def test_the_drift_of_runge_kutta_has_its_order() -> None:
    """Half the step, 2⁵ times less drift; the same per unit of time in a run twice as long."""
    runs = [
        run(RK4, "pendulum", t, h)
        for t, h in ((400, fmpq(1, 10)), (400, fmpq(1, 20)), (800, fmpq(1, 20)))
    ]
    drifts = [x.invariants[0].drift or 0 for x in runs]
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
    for k, history in enumerate(result.invariants):
        assert history.max_error == np.abs(plain[:, k]).max()
        assert list(history.errors) == list(plain[numbers, k])
        assert max(history.errors) == plain[:, k].max()
        assert min(history.errors) == plain[:, k].min()
    assert [t for t, _ in result.states] == [count * h * fmpq(k, 4) for k in range(5)]


def test_short_runs_keep_all() -> None:
    """Every step of a run with fewer than the points asked for."""
    result = run(LEAPFROG, "pendulum", 100, fmpq(1, 10))
    assert len(result.times) == 1001
    assert list(result.invariants[0].errors) == list(
        stepped(LEAPFROG, "pendulum", 1000, fmpq(1, 10))[:, 0]
    )


def test_turns_are_counted_across_chunks() -> None:
    """The pendulum turns twice a period, whatever the number of steps; the momentum as often."""
    coarse, fine = (run(LEAPFROG, "pendulum", 200, fmpq(1, n)) for n in (10, 100))
    assert (
        coarse.turns == fine.turns == 59
    )  # with k = sin(θ_max/2) = 0.541 the period is 4K(k) = 6.82


@in_whole
def test_more_digits_show_what_floats_hide() -> None:
    """Gauss 6 conserves the energy of the pendulum to round-off; with 40 digits the error is seen
    to stay.
    """
    text = "methods: [{family: gauss, stages: 6}]"
    floats, digits = (run(text, "pendulum", 60, fmpq(1, 10), digits=n) for n in (15, 40))
    assert floats.invariants[0].verdict == "round-off"
    assert floats.invariants[0].max_error < 1e-14
    assert digits.invariants[0].verdict == "bounded"
    assert 1e-25 < digits.invariants[0].max_error < 1e-20
    assert digits.invariants[0].round_off <= 1e-36


def test_more_digits_are_those_of_the_initial_values_too() -> None:
    """2/5 is no float: with 30 digits the angular momentum is conserved to 30 of them, from the
    first state on.
    """
    _, momentum = run(RECTANGULAR, "kepler", 20, fmpq(1, 50), digits=30).invariants
    assert momentum.max_error < 1e-29
    assert momentum.verdict == "round-off"


def test_round_off_is_what_floats_do() -> None:
    """The bound is above the errors of an invariant that only rounding changes, and not by much."""
    momentum = run(RECTANGULAR, "kepler", 400, fmpq(1, 50)).invariants[1]
    assert 1e-16 < momentum.max_error < momentum.round_off <= 1e-11


def test_explicit_euler_blows_up() -> None:
    """A run that leaves all bounds ends, with errors that are numbers."""
    result = run(EULER, "fput", 100, fmpq(1, 10))
    energy = result.invariants[0]
    assert result.is_unstable
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
    energy = run(IMPLICIT_EULER, "pendulum", 5000, fmpq(1, 10)).invariants[0]
    assert energy.verdict == "drifts"
    assert energy.shape == "step"
    assert energy.errors[-1] == pytest.approx(-energy.initial)


def test_growth_that_bends() -> None:
    """Explicit Euler on the pendulum drifts, at whatever rate."""
    energy = run(EULER, "pendulum", 100, fmpq(1, 10)).invariants[0]
    assert energy.verdict == "drifts"
    assert energy.drift is not None
    assert energy.drift > 0


@pytest.mark.parametrize(
    ("t_end", "verdict"), [(1, "undecided"), (20, "undecided"), (60, "bounded")]
)
def test_short_runs_are_not_judged(t_end: int, verdict: str) -> None:
    """Neither with few steps nor with few revolutions."""
    assert run(RECTANGULAR, "kepler", t_end, fmpq(1, 50)).invariants[0].verdict == verdict


ROUNDED_GAUSS_2 = """
ark:
  A: [[[0.25, -0.0386751], [0.5386751, 0.25]]]
  b: [[0.5, 0.50000004]]
"""
RALSTON_8 = "ark: {A: [[[0, 0], [0.66666667, 0]]], b: [[0.25, 0.75]]}"
BOGACKI_SHAMPINE_8 = """
ark:
  A: [[[0, 0, 0], [0.5, 0, 0], [0, 0.75, 0]]]
  b: [[0.22222222, 0.33333333, 0.44444444]]
"""


def test_rounded_coefficients_may_be_the_cause_of_a_drift() -> None:
    """A drift that is seen, and that rounding of the coefficients can cause, is undecided, within the
    tolerance only; it is measured as without one.
    """
    h = fmpq(1, 10)
    strict = run(ROUNDED_GAUSS_2, "pendulum", 400, h).energy
    loose = run(ROUNDED_GAUSS_2, "pendulum", 400, h, tolerance=fmpq(1, 10**6)).energy
    assert strict.verdict == "drifts"
    assert (loose.verdict, loose.doubt) == ("undecided", "rounding")
    assert loose.max_error == strict.max_error
    assert (loose.drift, loose.uncertainty) == (strict.drift, strict.uncertainty)
    assert abs(strict.drift or 0) * 400 < loose.coefficients


RK4_6 = """
A: [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0]]
b: [0.166667, 0.333333, 0.333333, 0.166667]
"""
RALSTON_4 = """
A:
  - [0, 0, 0, 0]
  - [0.4, 0, 0, 0]
  - [0.29697761, 0.15875964, 0, 0]
  - [0.21810040, -3.05096516, 3.83286476, 0]
b: [0.17476028, -0.55148066, 1.20553560, 0.17118478]
"""


@pytest.mark.parametrize(("source", "digits"), [(RK4_6, 6), (RALSTON_4, 8)])
def test_a_tolerance_makes_no_drift_bounded(source: str, digits: int) -> None:
    """The energy of Kepler falls throughout, by thousands of uncertainties: whatever the tolerance
    may explain, no claim on it holds.
    """
    found = run(source, "kepler", 200, fmpq(1, 50), tolerance=fmpq(1, 10**digits))
    for history in found.invariants:
        assert history.drift is not None
        assert history.uncertainty is not None
        assert abs(history.drift) > 1000 * history.uncertainty
        assert (history.verdict, history.doubt, history.longer) == ("undecided", "rounding", None)
    shown = " ".join(REPORT.render([EnergyReport("m", found)]).split())
    assert shown.count("undecided: drifts; rounding of the coefficients may be the cause") == 2


RADAU_5 = """
A: [[0.41667, -0.08333], [0.75, 0.25]]
b: [0.75, 0.25]
"""
ROTOR = """
variables: [x, y]
hamiltonian:
  - (px**2 + py**2)/2
  - 1 - cos(x) + (1 - cos(y))/4000 + x**2*(1 - cos(y))/50
initial: {x: 1, y: 0, px: 0, py: 1/50}
"""


@pytest.mark.parametrize(("unit", "verdict"), [(1, "drifts"), (3, "undecided")])
def test_rounding_excuses_no_drift_above_its_bound(unit: int, verdict: str) -> None:
    """The drift of Radau IIA is twice the bound within 1e-5, and below it within 3e-5: the
    verdict is that of the comparison.
    """
    problem = loads_problem(ROTOR)
    tolerance = fmpq(unit, 10**5)
    energy = long_run(
        tableau_of(RADAU_5), problem, fmpq(100), fmpq(1, 10), tolerance=tolerance
    ).energy
    assert energy.drift is not None
    assert energy.uncertainty is not None
    is_above = (abs(energy.drift) - energy.uncertainty) * 100 > energy.coefficients
    assert is_above is (verdict == "drifts")
    assert energy.verdict == verdict


SLOW = """
variables: [x, y]
hamiltonian: (px**2 + py**2 + x**2)/2 + {y}*y**2 + x**2*y/{coupling}
initial: {{x: 1, y: 0, px: 0, py: 0}}
"""
"""A resonance of 1 : 2, nearly: the energy goes from one oscillator to the other and back, slowly."""


@pytest.mark.parametrize(
    ("y", "coupling", "h", "short"),
    [pytest.param("2", 100, fmpq(1, 10), 1000, marks=in_whole), ("2001/1000", 50, fmpq(1, 5), 300)],
)
def test_a_symplectic_method_does_not_drift_for_a_slow_oscillation(
    y: str, coupling: int, h: fmpq, short: int
) -> None:
    """The energy error of Gauss 2 rises throughout the run; its symplecticity is proved, and the time
    that is proposed shows the oscillation. A method that is not symplectic drifts.
    """
    problem = loads_problem(SLOW.format(y=y, coupling=coupling))
    gauss, heun = (load(name).tableau for name in ("gauss-2", "heun-3"))
    energy = long_run(gauss, problem, fmpq(short), h).energy
    assert energy is not None
    assert (energy.verdict, energy.doubt, energy.shape) == ("undecided", "symplectic", "curve")
    assert energy.longer is not None
    longer = long_run(gauss, problem, energy.longer, h).energy
    assert longer is not None
    assert longer.verdict == "bounded"
    other = long_run(heun, problem, fmpq(short), h).energy
    assert other is not None
    assert other.verdict == "drifts"


def test_a_symplectic_method_may_lose_the_energy() -> None:
    """What has moved by a tenth of its terms is no slow oscillation of a small error: leapfrog on
    Kepler with steps that are far too large.
    """
    energy = run(LEAPFROG, "kepler", 2000, fmpq(1, 2)).energy
    assert energy is not None
    assert (energy.verdict, energy.doubt) == ("drifts", None)


FALL = """
variables: [x]
hamiltonian: px**2/2 + x
initial: {x: 0, px: 1}
invariants: {I: %s}
"""
"""A stone that is at rest at t = 1."""


@pytest.mark.parametrize("invariant", ["1/px", "log(px)"])
@pytest.mark.parametrize("digits", [15, 30])
@pytest.mark.parametrize("n", [6, 8])
def test_an_invariant_without_a_value(invariant: str, digits: int, n: int) -> None:
    """At t = 1 it has none, be it that the steps find that, or the same steps with more digits:
    nothing is decided about it, and the energy is none the worse for it.
    """
    problem = loads_problem(FALL % invariant)
    found = long_run(load("gauss-2").tableau, problem, fmpq(20), fmpq(1, n), digits)
    energy, other = found.invariants
    assert energy.verdict == "round-off"
    assert (other.verdict, other.doubt) == ("undecided", "value")
    assert other.no_value_at == 1
    assert (other.drift, other.longer, found.steps) == (None, None, 20 * n)
    shown = " ".join(REPORT.render([EnergyReport("m", found)]).split())
    assert "undecided: it has no value at t = 1;" in shown


def test_an_invariant_that_rounding_hides() -> None:
    """Near its pole 1/px is nothing but rounding: that is no confirmation."""
    problem = loads_problem(FALL % "1/px")
    found = long_run(load("gauss-2").tableau, problem, fmpq(14), fmpq(1, 10))
    assert (found.invariants[1].verdict, found.invariants[1].doubt) == ("undecided", "round-off")


@pytest.mark.parametrize("start", ["{x: 0, px: 0}", "{x: sqrt(2), px: 0}"])
def test_a_solution_that_rests_shows_nothing(start: str) -> None:
    """On an equilibrium, also where floats are beside it by their rounding."""
    text = f"{{variables: [x], hamiltonian: px**2/2 + x**2*(x**2 - 4), initial: {start}}}"
    energy = long_run(load("gauss-2").tableau, loads_problem(text), fmpq(50), fmpq(1, 10)).energy
    assert energy is not None
    assert (energy.verdict, energy.doubt) == ("undecided", "rest")


@pytest.mark.parametrize("source", [RALSTON_8, BOGACKI_SHAMPINE_8])
def test_rounded_coefficients_excuse_no_other_drift(source: str) -> None:
    """Methods of low order drift by orders of magnitude more than their tolerance explains."""
    h = fmpq(1, 50)
    energy = run(source, "kepler", 200, h, tolerance=fmpq(1, 10**8)).energy
    assert energy.verdict == "drifts"
    assert 0 < energy.coefficients < 1e-2 * abs(energy.drift or 0) * 200


@in_whole
@given(st.lists(st.integers(-9, 9), min_size=6, max_size=6))
@settings(max_examples=at_most(5, 10), deadline=None)
def test_what_rounding_does_is_within_its_bound(units: list[int]) -> None:
    """Gauss 2 with every coefficient changed by up to the tolerance drifts no more than the bound
    on that.
    """
    digits = [0.25, 0.25 - 3**0.5 / 6, 0.25 + 3**0.5 / 6, 0.25, 0.5, 0.5]
    a, b, c, d, e, f = (f"{x + unit * 1e-6:.15f}" for x, unit in zip(digits, units, strict=True))
    text = f"ark: {{A: [[[{a}, {b}], [{c}, {d}]]], b: [[{e}, {f}]]}}"
    energy = run(text, "kepler", 100, fmpq(1, 20), tolerance=fmpq(9, 10**6)).energy
    assert (energy.verdict, energy.doubt) in {("bounded", None), ("undecided", "rounding")}
    assert energy.drift is not None
    assert energy.uncertainty is not None
    is_seen = abs(energy.drift) > energy.uncertainty
    assert is_seen or energy.verdict == "bounded"
    assert abs(energy.drift) * 100 < energy.coefficients


@pytest.mark.parametrize("seed", range(at_most(1, 2)))
@pytest.mark.parametrize("source", [STOERMER_VERLET, YOSHIDA_4, GAUSS_2])
def test_slow_modulation_is_no_drift(source: str, seed: int) -> None:
    """Symplectic methods on two planets, which perturb each other over thousands of orbits."""
    result = planets(source, two_planets(seed), 300)
    assert result.energy.verdict == "bounded"


@pytest.mark.parametrize("seed", range(at_most(1, 4)))
@pytest.mark.parametrize("source", [RK4_FILE, RALSTON])
def test_drift_under_slow_modulation_is_seen(source: str, seed: int) -> None:
    """Runge-Kutta methods on the same systems."""
    assert planets(source, two_planets(seed), 300).energy.verdict == "drifts"


@pytest.mark.parametrize("sun_moves", [False, pytest.param(True, marks=in_whole)])
@pytest.mark.parametrize("source", [STOERMER_VERLET, YOSHIDA_4, GAUSS_2])
def test_sun_jupiter_saturn(source: str, sun_moves: bool) -> None:
    """The masses of the planets are 10⁻³ and 3·10⁻⁴ of the sun's; no drift in a short run, none in
    one that is twenty times as long, and one of Runge's and Kutta's in both.
    """
    jupiter, saturn = SUN_JUPITER_SATURN
    orbits = [
        (jupiter, Fraction(1), Fraction(48, 1000), Fraction(1, 4)),
        (saturn, Fraction(183, 100), Fraction(54, 1000), Fraction(2)),
    ]
    text = system(orbits, sun_moves)
    assert planets(source, text, 150).energy.verdict == "bounded"
    assert planets(RK4_FILE, text, 150).energy.verdict == "drifts"
    if source == STOERMER_VERLET:
        assert planets(source, text, 3000).energy.verdict == "bounded"


@cache
def planets(source: str, text: str, t_end: int) -> LongRun:
    """A system of planets, in steps of 3/20: 42 an orbit of the inner planet."""
    return long_run(tableau_of(source), loads_problem(text), fmpq(t_end), fmpq(3, 20))


MAGNETIC = """
variables: [x, y]
lagrangian: "(vx**2 + vy**2)/2 + (x*vy - y*vx)/2 - x**2/2 - y**2 - (x**4 + x**2*y**2)/10"
initial: {x: 1, y: 1/2, vx: 0, vy: 1/2}
"""
HENON_HEILES = """
variables: [x, y]
hamiltonian:
  - (px**2 + py**2)/2
  - (x**2 + y**2)/2 + x**2*y - y**3/3
initial: {x: 0, y: 1/10, px: sqrt(1/3 - 1/100 + 2/3000 - 1/100), py: 1/10}
"""


@in_whole
@pytest.mark.parametrize("text", [MAGNETIC, HENON_HEILES])
def test_chaos_and_magnetic_fields(text: str) -> None:
    """A symplectic method is bounded, and the method of Runge and Kutta drifts."""
    problem = loads_problem(text)
    verdicts = [
        long_run(tableau_of(source), problem, fmpq(500), fmpq(1, 10)).energy.verdict
        for source in (GAUSS_2, RK4_FILE)
    ]
    assert verdicts == ["bounded", "drifts"]


def test_what_is_undecided_names_a_longer_run() -> None:
    """A slope of a few times its uncertainty is neither none nor a drift; the time that is proposed
    decides.
    """
    text = two_planets(0)
    short = planets(RK4_FILE, text, 12).energy
    assert short.verdict == "undecided"
    assert short.longer is not None
    assert short.longer >= 4 * 12
    longer = planets(RK4_FILE, text, int(short.longer)).energy
    assert longer.verdict == "drifts"
    assert longer.longer is None


@in_whole
def test_an_orbit_that_escapes_is_unstable() -> None:
    """Explicit Euler drives the planet away: it turns no more, and no drift is given."""
    result = run(EULER, "kepler", 400, fmpq(1, 100))
    assert result.is_unstable
    assert result.escaped is not None
    assert 0 < result.escaped < 400
    assert result.steps == 40_000
    assert result.energy.drift is None
    assert run(LEAPFROG, "kepler", 400, fmpq(1, 20)).escaped is None


def test_an_orbit_that_escapes_soon_is_unstable() -> None:
    """Also where it has gone round but once: Ralston's method with a large step. Euler's has the
    planet leave at once, which is a drift: it has never been seen to be bound. Its slope is nothing
    but rounding, and not shown.
    """
    once = run(RALSTON, "kepler", 100, fmpq(1, 5))
    assert once.is_unstable
    assert once.energy.drift is None
    never = run(EULER, "kepler", 400, fmpq(1, 5))
    assert never.escaped is None
    assert (never.energy.verdict, never.energy.shape) == ("drifts", "curve")
    assert never.energy.max_error > 1
    shown = REPORT.render([EnergyReport("Euler", never)], verbosity=1)
    assert "it rises all along" in shown
    assert "not at one rate in this run" in shown


def test_rotation_is_no_escape() -> None:
    """A pendulum that goes round leaves all angles behind, and comes back to all momenta."""
    assert run(EULER, "pendulum", 100, fmpq(1, 10)).escaped is None


@in_whole
def test_memory_does_not_grow_with_the_steps() -> None:
    """Three times the steps, and no more is kept."""
    sizes = []
    for t_end in (300, 900):
        tracemalloc.start()
        run(LEAPFROG, "kepler", t_end, fmpq(1, 20), points=100)
        sizes.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert sizes[1] < 1.5 * sizes[0]


def test_limits() -> None:
    """Too many steps, and steps that do not end at the end."""
    with pytest.raises(UsageProblem, match="limit"):
        run(LEAPFROG, "pendulum", MAX_STEPS + 1, fmpq(1))
    with pytest.raises(UsageProblem, match="whole number"):
        run(LEAPFROG, "pendulum", 1, fmpq(3, 10))


def test_every_step_is_counted() -> None:
    """The start and each step, and how many there will be."""
    who = Listener()
    with telling(who):
        run(LEAPFROG, "pendulum", 2, fmpq(1, 10))
    assert [(x.done, x.total) for x in who.told if x.what == "steps"] == [(21, 21)]


def test_no_value_at_the_start() -> None:
    """An energy that is not defined there is said to be so."""
    q, p = symbols(("x",), "q")[0], symbols(("x",), "p")[0]
    problem = Hamiltonian("bad", ("x",), (p**2 / 2 - sympy.log(q),), (fmpq(0), fmpq(1)), fmpq(1))
    with pytest.raises(UsageProblem, match="no value at the start"):
        long_run(tableau_of(RK4), problem, fmpq(1), fmpq(1, 10))


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


def oscillator_run(
    source: str, tolerance: fmpq | None = None, t_end: int = 100
) -> InvariantHistory:
    """The energy of the oscillator."""
    tableau = tableau_of(source)
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    return long_run(tableau, problem, fmpq(t_end), fmpq(1, 2), tolerance=tolerance).energy


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
    """Without a tolerance the determinant is not 1, and the energy drifts; within one that may be
    rounding. Where the determinant is 1 the energy is bounded with a tolerance too.
    """
    text = """
ark:
  A: [[[0.25, -0.0386751345948], [0.5386751345948, 0.25]]]
  b: [[0.5, 0.5000000000001]]
"""
    assert oscillator_run(text).verdict == "drifts"
    rounded = oscillator_run(text, fmpq(1, 10**12))
    assert (rounded.verdict, rounded.doubt) == ("undecided", "rounding")
    assert oscillator_run(RECTANGULAR, fmpq(1, 10**12)).verdict == "bounded"


@pytest.mark.parametrize("source", [RK4, IMPLICIT_EULER])
def test_an_energy_that_is_lost_is_no_rounding(source: str) -> None:
    """No line fits an energy that decays to nothing in a small part of the run; the determinant
    differs from 1 by 2e-4 and more, which a tolerance of 1e-9 does not explain.
    """
    tolerance = fmpq(1, 10**9)
    assert oscillator_run(source, tolerance, 100_000).verdict == "drifts"
    assert oscillator_run(source, t_end=100_000).verdict == "drifts"


def test_the_oscillator_agrees_with_the_nonlinear_path() -> None:
    """The same problem stepped in floats: the same errors and no drift either."""
    tableau = tableau_of(RECTANGULAR)
    exact = long_run(tableau, Oscillator.default(2, fmpq(1)), fmpq(500), fmpq(1, 2))
    floats = run(RECTANGULAR, "oscillator", 500, fmpq(1, 2))
    assert floats.invariants[0].max_error == pytest.approx(exact.invariants[0].max_error, rel=1e-9)
    assert list(floats.invariants[0].errors) == pytest.approx(
        list(exact.invariants[0].errors), abs=1e-14
    )
    assert floats.invariants[0].amplitude == pytest.approx(exact.invariants[0].amplitude, rel=1e-3)
    assert [x.invariants[0].verdict for x in (exact, floats)] == ["bounded", "bounded"]
