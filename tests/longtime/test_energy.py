"""The energy error over a long time."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb, fmpq

from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.longtime.energy import oscillator_run
from garkcli.longtime.history import MAX_STEPS, SERIES
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stepping.linear import linear_step
from garkcli.tableau.forms import gark, symplectic_pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation

HALF = fmpq(1, 2)


def separable(s: int, t: int) -> Tableau:
    """Gauss s for velocities, Lobatto IIIA t for forces, by collocation: eq. (rectangular) for 2,
    3.
    """
    one, other = (diagonal_method("gauss", s), diagonal_method("lobatto-iiia", t))
    Q = gark([one, other], {(0, 1): collocation(one, other), (1, 0): collocation(other, one)})
    return symplectic_pair(Q, [0], [1])


def alone(name: str, s: int | None = None) -> Tableau:
    """A single method."""
    return gark([diagonal_method(name, s)], {})


def default(tableau: Tableau, omega: fmpq | None = None) -> Oscillator:
    """The default split."""
    return Oscillator.default(terms_of(tableau), omega or fmpq(1))


def exact_energy_errors(tableau: Tableau, problem: Oscillator, h: fmpq, steps: int) -> list[float]:
    """H(t_n) − H(0), stepped in exact rational arithmetic and rounded at the very end."""
    (a, b), (c, d) = linear_step(tableau, problem).at(h)
    omega = problem.omega
    q, p, errors = fmpq(1), omega / 2, []
    for _ in range(steps + 1):
        errors.append(float(arb((p * p + omega**2 * q * q) / 2 - 5 * omega**2 / 8)))
        q, p = a * q + b * p, c * q + d * p
    return errors


@pytest.mark.parametrize("omega", [fmpq(1), fmpq(5, 3)])
@pytest.mark.parametrize(
    "tableau",
    [
        separable(2, 3),
        separable(6, 7),
        alone("explicit-euler"),
        alone("radau-iia", 2),
        alone("lobatto-iiic", 2),
    ],
)
def test_energy_errors_are_exact_to_the_last_digits(tableau: Tableau, omega: fmpq) -> None:
    """Against rational arithmetic: also errors of 1e-17 of the energy come out to nearly all their
    digits.
    """
    steps = 120
    expected = np.array(exact_energy_errors(tableau, default(tableau, omega), HALF, steps))
    result = oscillator_run(tableau, default(tableau, omega), HALF * steps, HALF)
    assert result.steps == steps
    assert np.array(result.energy.errors) == pytest.approx(
        expected, rel=1e-9, abs=1e-13 * np.abs(expected).max()
    )
    assert result.energy.max_error == pytest.approx(np.abs(expected).max(), rel=1e-12)


def test_rectangular_method_does_not_drift() -> None:
    """The paper's figure: h = 1/2 to t = 10⁴, the energy error oscillates and stays."""
    tableau = separable(2, 3)
    result = oscillator_run(tableau, default(tableau), fmpq(10_000), HALF)
    assert result.steps == 20_000
    assert 1e-5 < result.energy.max_error < 1e-3
    assert result.energy.drift == 0
    assert not result.is_unstable


def test_small_energy_errors_are_not_rounding() -> None:
    """Gauss 6 × Lobatto IIIA 7 at h = 1/100: errors of 1e-37 over a million steps, of the same size
    all along.
    """
    tableau = separable(6, 7)
    result = oscillator_run(tableau, default(tableau), fmpq(10_000), fmpq(1, 100))
    assert result.steps == 1_000_000
    early, late = (
        max(map(abs, half)) for half in (result.energy.errors[:1000], result.energy.errors[1000:])
    )
    assert 1e-38 < result.energy.max_error < 1e-36
    assert early == pytest.approx(late, rel=1e-3)


def test_dissipation_is_drift() -> None:
    """Rk4 loses energy at the rate h⁵ω⁶/72·2H: |R|² = 1 − x⁶/72 + x⁸/576 a step."""
    h = fmpq(1, 10)
    result = oscillator_run(alone("rk4"), default(alone("rk4")), fmpq(100), h)
    rate = np.log1p(-1e-6 / 72 + 1e-8 / 576) / 0.1
    assert result.energy.drift == pytest.approx(5 / 8 * rate * (1 + rate * 50), rel=1e-3)
    assert result.energy.max_error == pytest.approx(-5 / 8 * np.expm1(100 * rate), rel=1e-9)


def test_explicit_euler_drifts_and_blows_up() -> None:
    """Energy grows by 1 + h² a step; a run that leaves all bounds ends there and says so."""
    short = oscillator_run(
        alone("explicit-euler"), default(alone("explicit-euler")), fmpq(1), fmpq(1, 100)
    )
    assert short.energy.max_error == pytest.approx(5 / 8 * (1.0001**100 - 1), rel=1e-10)
    assert short.energy.drift == pytest.approx(short.energy.max_error, rel=1e-2)
    long = oscillator_run(
        alone("explicit-euler"), default(alone("explicit-euler")), fmpq(10_000), HALF
    )
    assert long.is_unstable
    assert long.steps == int(30 * np.log(10) / np.log(1.25))  # 1.25^n − 1 ≤ 1e30
    assert long.energy.drift is None
    assert np.isfinite([long.energy.max_error, *long.energy.errors]).all()


def test_violent_instability_is_finite_too() -> None:
    """Rk4 with ωh = 1000 multiplies by 4e10 a step: it ends after a few."""
    result = oscillator_run(alone("rk4"), default(alone("rk4"), fmpq(1000)), fmpq(100), fmpq(1))
    assert result.is_unstable
    assert result.steps < 5


def test_strong_damping() -> None:
    """Radau IIA at ωh = 50 has lost all energy after a while: the error is −H(0)."""
    tableau = alone("radau-iia", 1)
    result = oscillator_run(tableau, default(tableau, fmpq(100)), fmpq(500), HALF)
    assert result.energy.max_error == pytest.approx(result.energy.initial)
    assert result.energy.errors[-1] == pytest.approx(-result.energy.initial)


def test_exact_conservation_is_zero() -> None:
    """Gauss: no energy error, no drift, exactly."""
    result = oscillator_run(alone("gauss", 3), default(alone("gauss", 3)), fmpq(1000), HALF)
    assert (result.energy.max_error, result.energy.drift) == (0, 0)


def test_series_is_small_and_keeps_the_extremes() -> None:
    """The series for a plot has its bound, ascends, and contains the largest error."""
    tableau = separable(2, 3)
    result = oscillator_run(tableau, default(tableau), fmpq(10_000), HALF)
    assert len(result.times) == len(result.energy.errors) <= SERIES
    assert all(np.diff(result.times) > 0)
    assert max(map(abs, result.energy.errors)) == result.energy.max_error


def test_too_many_steps_are_refused() -> None:
    """Before memory is."""
    with pytest.raises(UsageProblem, match="steps"):
        oscillator_run(alone("rk4"), default(alone("rk4")), fmpq(MAX_STEPS + 1), fmpq(1))


@pytest.mark.parametrize("t_end", [100, 10_000, 100_000])
def test_uncertainty_of_no_drift(t_end: int) -> None:
    """A bounded error has no drift, which is proved and not measured."""
    tableau = separable(2, 3)
    result = oscillator_run(tableau, default(tableau), fmpq(t_end), HALF)
    assert (result.energy.drift, result.energy.uncertainty) == (0, 0)
    assert result.energy.verdict == "bounded"
    assert result.stability.fate == "elliptic"


def test_uncertainty_of_a_drift() -> None:
    """A slow exponential is nearly a line: its slope is known as well as it is one."""
    result = oscillator_run(alone("rk4"), default(alone("rk4")), fmpq(100), fmpq(1, 10))
    assert 0 < result.energy.uncertainty < 0.01 * abs(result.energy.drift)
    assert result.stability.fate == "contractive"


def test_amplitude_is_what_the_line_leaves() -> None:
    """Half the range of the error where nothing drifts; hardly anything of a monotone loss."""
    tableau = separable(2, 3)
    result = oscillator_run(tableau, default(tableau), fmpq(10_000), HALF)
    errors = result.energy.errors
    assert result.energy.amplitude == pytest.approx((max(errors) - min(errors)) / 2, rel=1e-9)
    lost = oscillator_run(alone("rk4"), default(alone("rk4")), fmpq(100), fmpq(1, 10))
    assert lost.energy.amplitude < 0.01 * lost.energy.max_error


def test_series_has_both_ends() -> None:
    """From the start to the end, whatever the number of points."""
    tableau = separable(2, 3)
    for points in (10, 100, 2000):
        result = oscillator_run(tableau, default(tableau), fmpq(10_000), HALF, points)
        assert (result.times[0], result.times[-1]) == (0, 10_000)
        assert len(result.times) <= points


def test_exact_conservation_is_known() -> None:
    """It is decided, not seen from errors of zero."""
    assert (
        oscillator_run(alone("gauss", 3), default(alone("gauss", 3)), fmpq(10), HALF).energy.verdict
        == "exact"
    )
    assert (
        oscillator_run(alone("rk4"), default(alone("rk4")), fmpq(10), HALF).energy.verdict
        == "drifts"
    )
