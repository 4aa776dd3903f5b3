"""Two springs for all slow frequencies of an interval: against single ones, decided one by one."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from click.testing import CliRunner
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.cli.main import gark
from garkcli.errors import GarkError
from garkcli.exact.cells import Interval
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.load import load
from garkcli.stability.two_frequencies import (
    SlowInterval,
    SplitSprings,
    slow_interval,
    springs,
    two_frequencies,
)
from tests.whole import at_most, in_whole

NAMES = ["collocation", "interpolation", "three-colours", "four-term-combination"]


def has(intervals: tuple[Interval, ...], x: fmpq) -> bool:
    """Whether a rational number lies in one of the intervals."""
    root = RealRoot.rational(x)
    for i in intervals:
        low, high = i.start, i.end
        is_right = low is None or low < root or (i.has_start and low == root)
        is_left = high is None or root < high or (i.has_end and root == high)
        if is_right and is_left:
            return True
    return False


@in_whole
@settings(max_examples=at_most(3, 25))
@given(
    st.sampled_from(NAMES),
    st.fractions(0, 3, max_denominator=4),
    st.fractions(1, 4, max_denominator=4),
    st.lists(st.fractions(0, 40, max_denominator=8), min_size=4, max_size=4),
)
def test_against_single_frequencies(
    name: str, low: Fraction, width: Fraction, at: list[Fraction]
) -> None:
    """For a fast x all a are stable as the problem with both springs exchanged has it, exactly; and
    where x is stable, so it is for each of many slow a.
    """
    tableau = load(f"methods/{name}.gark.yaml").tableau
    split = springs(tableau, 1)
    A = fmpq(low.numerator, low.denominator)
    B = A + fmpq(width.numerator, width.denominator)
    found = slow_interval(tableau, split, A, B)
    exchanged = SplitSprings(split.kinetic, slow=split.fast, fast=split.slow)
    ends = RealRoot.rational(A), RealRoot.rational(B)
    samples = [two_frequencies(tableau, split, A + (B - A) * fmpq(k, 6)) for k in range(7)]
    for value in at:
        x = fmpq(value.numerator, value.denominator)
        slow = two_frequencies(tableau, exchanged, x).stable
        holds = any(_covers(interval, *ends) for interval in slow)
        assert has(found.stable, x) == holds
        if holds:
            assert all(has(sample.stable, x) for sample in samples)


def _covers(interval: Interval, low: RealRoot, high: RealRoot) -> bool:
    start, end = interval.start, interval.end
    is_right = start is None or start < low or (interval.has_start and start == low)
    is_left = end is None or high < end or (interval.has_end and end == high)
    return is_right and is_left


def test_the_resonance_of_an_interval_is_that_of_its_ends() -> None:
    """Collocation of Gauss 2 and Lobatto 3: the resonance ends at 12 − a and begins at 9 − 3a/4."""
    tableau = load("methods/collocation.gark.yaml").tableau
    found = slow_interval(tableau, springs(tableau, 1), fmpq(1), fmpq(2))
    ends = [(i.start.exact, i.end.exact) for i in found.stable if i.start and i.end]
    assert ends == [(0, fmpq(15, 2)), (11, 36)]
    assert found.is_stable_for_all is False
    assert not found.open_points
    later = slow_interval(tableau, springs(tableau, 1), fmpq(13, 2), fmpq(21, 2)).stable
    ends = [(i.start.exact, i.end.exact) for i in later if i.start and i.end]
    assert ends == [(0, fmpq(9, 8)), (fmpq(11, 2), 36)]


FROM_0 = Interval(RealRoot.rational(fmpq(0)), None, has_start=True)


@pytest.mark.parametrize(
    ("low", "stable", "is_stable"),
    [
        (1, [FROM_0], True),
        (1, [], False),
        (1, [Interval(RealRoot.rational(fmpq(1)), None, has_start=True)], False),
        (1, [Interval(FROM_0.start, RealRoot.rational(fmpq(9)), has_start=True)], False),
        (1, [Interval(FROM_0.start, None)], False),  # x = 0 moves the slow spring alone
        (0, [Interval(FROM_0.start, None)], True),  # a free particle
    ],
)
def test_all_fast_frequencies(low: int, stable: list[Interval], is_stable: bool) -> None:
    """One interval from 0 to infinity, with 0 unless that is a free particle; an open point in it
    leaves it open.
    """
    found = SlowInterval(fmpq(low), fmpq(2), tuple(stable), ())
    assert found.is_stable_for_all is is_stable
    at = (RealRoot.rational(fmpq(3)),)
    left = SlowInterval(fmpq(low), fmpq(2), tuple(stable), at)
    assert left.is_stable_for_all is (None if is_stable else False)


def test_interpolation_has_no_resonance() -> None:
    """Its trace stays within ±2 for all a in [0, 100]; without any spring a particle moves away."""
    tableau = load("methods/interpolation.gark.yaml").tableau
    found = slow_interval(tableau, springs(tableau, 1), fmpq(0), fmpq(100))
    assert found.is_stable_for_all is True
    assert not found.stable[0].has_start


def run(*arguments: str) -> dict[str, Any]:
    """The JSON of one run."""
    words = ["stability", *arguments, "--format", "json"]
    result = CliRunner().invoke(gark, words)
    assert result.exit_code == 0, result.output
    (data,) = json.loads(result.output)["files"]
    return dict(data)


def test_the_command() -> None:
    """--slow A..B tells what the function finds, and draws the plane."""
    data = run("methods/interpolation.gark.yaml", "--slow", "1/4..2", "--fast", "2")
    assert data["kind"] == "slow-interval"
    assert data["slow"] == {"from": "1/4", "to": "2"}
    assert data["stable_for_every_fast"] is True


@pytest.mark.parametrize(
    ("slow", "message"), [("1..0", "ascending"), ("1..", "no number"), ("-1..2", "not negative")]
)
def test_refusals(slow: str, message: str) -> None:
    """Ends that make no interval are refused with their reason."""
    words = ["stability", "methods/collocation.gark.yaml", "--slow", slow, "--fast", "2"]
    result = CliRunner().invoke(gark, words)
    assert isinstance(result.exception, GarkError)
    assert message in result.exception.message


def test_irrational_coefficients_are_refused() -> None:
    """Curves are factored over the rational numbers."""
    tableau = load("methods/ark-ars222.gark.yaml").tableau
    with pytest.raises(GarkError, match="rational coefficients"):
        slow_interval(tableau, springs(tableau, 1), fmpq(0), fmpq(1))
