"""Drift told from oscillation, on signals whose drift is known."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from garkcli.longtime.trend import LEAST, Trend, Trends
from tests.whole import at_most

Floats = NDArray[np.float64]
N = 2000
S = np.arange(N + 1) / N
"""From 0 to 1 over the run."""


def trend_of(errors: Floats, noise: float = 0.0) -> Trend:
    """The trend of one signal, given at once."""
    trends = Trends(len(errors) - 1, 1)
    trends.add(0, errors[:, None])
    return trends.of(0, noise)


waves = st.lists(
    st.tuples(st.floats(0.01, 1), st.floats(3, 900), st.floats(0, 2 * np.pi)),
    min_size=1,
    max_size=5,
)
"""Amplitudes, numbers of oscillations in the run, and phases."""


def oscillation(parts: list[tuple[float, float, float]]) -> Floats:
    """The sum of the waves, from zero on as errors are."""
    total = sum((a * np.cos(2 * np.pi * f * S + phase) for a, f, phase in parts), np.zeros(N + 1))
    return np.asarray(total - total[0])


@given(waves, st.floats(-1, 1))
@settings(max_examples=at_most(30, 100), deadline=None)
def test_slope_of_a_line_through_oscillations(
    parts: list[tuple[float, float, float]], slope: float
) -> None:
    """The slope is right within its uncertainty, whatever the frequencies, and a line is seen that
    exceeds it.
    """
    found = trend_of(oscillation(parts) + slope * S)
    assert abs(found.slope * N - slope) <= found.uncertainty * N
    if abs(slope) > 2 * found.uncertainty * N:
        assert found.finding != "none"
    if abs(slope) > 20 * found.uncertainty * N:
        assert (found.finding, found.shape) == ("drift", "line")


@given(waves)
@settings(max_examples=at_most(30, 100), deadline=None)
def test_oscillations_do_not_drift(parts: list[tuple[float, float, float]]) -> None:
    """No slope beyond its uncertainty, and none of the other trends but by a beat slower than the
    run.
    """
    found = trend_of(oscillation(parts))
    assert abs(found.slope) <= found.uncertainty
    assert found.finding != "drift"
    if min(f for _, f, _ in parts) > 16:
        assert found.shape == "none"


@given(
    st.floats(-0.9, 0.9),
    st.floats(0.001, 2),
    st.floats(0, 2 * np.pi),
    st.floats(0, 2),
    st.floats(20, 300),
)
@settings(max_examples=at_most(30, 100), deadline=None)
def test_slow_modulation_is_no_drift(
    depth: float, periods: float, phase: float, offset: float, frequency: float
) -> None:
    """What modulates the height of an oscillation and its mean alike is no drift, be its period a
    thousand times the run.
    """
    slow = 1 + depth * np.sin(2 * np.pi * periods * S + phase)
    signal = slow * (offset + np.sqrt(2) * np.cos(2 * np.pi * frequency * S))
    assert trend_of(signal - signal[0]).finding != "drift"


@pytest.mark.parametrize(("slope", "finding"), [(0.02, "none"), (0.2, "undecided"), (2, "drift")])
def test_three_findings(slope: float, finding: str) -> None:
    """Of one modulated oscillation, with drifts of different size."""
    slow = 1 + 0.1 * S
    signal = slow * np.cos(2 * np.pi * 60.3 * S) + slope * S
    assert trend_of(signal - signal[0]).finding == finding


@given(
    st.lists(
        st.tuples(st.floats(0.01, 1), st.floats(150, 900), st.floats(0, 6)), min_size=1, max_size=5
    )
)
@settings(max_examples=at_most(30, 100), deadline=None)
def test_uncertainty_of_fast_oscillations_is_tiny(parts: list[tuple[float, float, float]]) -> None:
    """Hundreds of oscillations in the run: a drift of a millionth of their height is found, where
    they do not beat.
    """
    height = sum(a for a, _, _ in parts)
    found = trend_of(oscillation(parts) + 1e-6 * height * S)
    assert abs(found.slope * N - 1e-6 * height) < 1e-8 * height
    beats = [abs(f - g) for k, (_, f, _) in enumerate(parts) for _, g, _ in parts[:k]]
    if min(beats, default=np.inf) > 150:
        assert found.uncertainty * N < 1e-7 * height
        assert (found.finding, found.shape) == ("drift", "line")


@given(st.integers(0, 10**6), st.floats(1e-12, 1e12))
@settings(max_examples=at_most(30, 100), deadline=None)
def test_noise_has_an_uncertainty(seed: int, size: float) -> None:
    """Of noise and a wave the uncertainty is a few standard deviations of the slope, not a small
    part of one.
    """
    draw = np.random.default_rng(seed)
    found = trend_of(size * (draw.normal(size=N + 1) + np.cos(400 * S)))
    deviation = size * 8.0 / np.sqrt(N)  # of this weight's least squares, measured on many draws
    assert deviation < found.uncertainty * N < 20 * deviation


def test_noise_hardly_ever_drifts() -> None:
    """One signal in a hundred, at most, of a thousand that are nothing but noise."""
    draw = np.random.default_rng(1)
    trends = Trends(N, 1000)
    trends.add(0, draw.normal(size=(N + 1, 1000)))
    assert sum(trends.of(k).shape != "none" for k in range(1000)) <= 10


@given(waves, st.floats(-1, 1), st.lists(st.integers(1, N), max_size=6))
@settings(max_examples=at_most(15, 50), deadline=None)
def test_pieces_make_no_difference(
    parts: list[tuple[float, float, float]], slope: float, cuts: list[int]
) -> None:
    """Signals that come in pieces have the trend of those that come at once, side by side or
    alone.
    """
    errors = np.stack([oscillation(parts) + slope * S, S**2], axis=1)
    trends = Trends(N, 2)
    bounds = [0, *sorted(set(cuts)), N + 1]
    for start, end in pairwise(bounds):
        trends.add(start, errors[start:end])
    for k in (0, 1):
        whole, found = trend_of(errors[:, k]), trends.of(k)
        scale = float(np.abs(errors[:, k]).max()) + 1e-300
        assert found.slope * N == pytest.approx(whole.slope * N, rel=1e-9, abs=1e-12 * scale)
        assert found.uncertainty == pytest.approx(whole.uncertainty, rel=1e-6)
        assert found.shape == whole.shape


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("rate", [0.1, 1, 3, 5, 10, 30, 100, 1000])
@pytest.mark.parametrize("oscillates", [0.0, 0.1])
def test_what_is_no_line_is_a_trend(sign: int, rate: float, oscillates: float) -> None:
    """Growth that sets in late, and decay that is over soon, are trends too."""
    bend = np.expm1(-rate * S) / np.expm1(-rate)
    for errors in (bend, bend[::-1] - bend[-1]):
        found = trend_of(sign * (errors + oscillates * np.sin(2 * np.pi * 51.3 * S)))
        assert found.shape != "none"
        if rate <= 3:
            assert found.finding == "drift"


def test_shapes() -> None:
    """Each trend is called by what it is."""
    assert trend_of(S).shape == "line"
    assert trend_of(np.expm1(5 * S)).shape == "curve"
    assert trend_of(np.expm1(-300 * S)).shape == "step"
    assert trend_of(np.zeros(N + 1)).shape == "none"


def test_a_line_below_the_noise_is_none() -> None:
    """What the errors are not good to is no trend."""
    assert trend_of(1e-14 * S, noise=1e-16).finding == "drift"
    assert trend_of(1e-14 * S, noise=5e-15).finding == "undecided"
    assert trend_of(1e-14 * S, noise=2e-14).finding == "none"


@pytest.mark.parametrize("count", [LEAST, LEAST + 1, 2 * LEAST - 1])
def test_shortest_runs(count: int) -> None:
    """Every window has steps to weigh in the shortest run that is judged."""
    found = trend_of(0.5 * np.arange(count + 1))
    assert found.slope == pytest.approx(0.5)
    assert found.shape == "line"


@pytest.mark.parametrize("errors", [S, S**4])
def test_what_a_bound_explains(errors: Floats) -> None:
    """A line from 0 to 1, and a curve from 0 to 1, are explained by more than that and not by half
    of it.
    """
    found = trend_of(errors)
    assert found.finding == "drift"
    assert not found.exceeds(1.01, N)
    assert found.exceeds(0.5, N)


def test_a_bound_is_held_against_a_line_less_its_uncertainty() -> None:
    """Noise of a known size leaves the slope open by as much: a bound within that is not
    exceeded.
    """
    found = trend_of(S, noise=0.05)
    assert (found.finding, found.shape) == ("drift", "line")
    assert not found.exceeds(0.97, N)
    assert found.exceeds(0.93, N)
