"""``gark design --p-stable --slow --fast``: stability on two springs as a set of parameter values."""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.design.stability_kinds import Members, SpringStability, TwoSprings
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import StableValues
from garkcli.exact.cells import Interval
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign_at
from garkcli.methodfile.family import load_family, loads_family
from garkcli.methodfile.load import loads
from garkcli.stability.two_frequencies import springs, two_frequencies
from tests.cli.harness import ROOT, gark
from tests.whole import at_most, in_whole

ASK = "methods/found/asks/no-resonance-lobatto3-gauss2.yaml"
SMALL = """parameters: {{t: {}}}
methods:
  - {{family: lobatto-iiia, stages: 2}}
  - {{family: gauss, stages: 1}}
transfer: {{default: collocation, blocks: {{"2,1": [[1/2 - t, t]]}}}}
structure: semi-separable
"""


def has(intervals: tuple[Interval, ...], low: fmpq, high: fmpq) -> bool:
    """Whether one interval has all numbers from low to high."""
    left, right = RealRoot.rational(low), RealRoot.rational(high)
    for x in intervals:
        is_right = x.start is None or x.start < left
        is_left = x.end is None or right < x.end
        if x.has_start and x.start == left:
            is_right = True
        if x.has_end and x.end == right:
            is_left = True
        if is_right and is_left:
            return True
    return False


@cache
def small(slow: fmpq, greatest: fmpq | None) -> StableValues:
    """The set for the smallest family."""
    family = loads_family(SMALL.format("free"))
    wanted = TwoSprings(slow, 1, greatest)
    return stable_set(family, "p-stable", "method", wanted)


@in_whole
@settings(max_examples=at_most(3, 40))
@given(
    st.fractions(-1, 2, max_denominator=6),
    st.sampled_from([fmpq(1, 2), fmpq(2)]),
    st.sampled_from([fmpq(3), fmpq(10)]),
)
def test_against_single_values(t: Fraction, slow: fmpq, greatest: fmpq) -> None:
    """A rational t belongs to the set exactly where the method with it is stable from 0 to the
    bound, as ``gark stability`` decides that.
    """
    found = small(slow, greatest)
    assert not found.undecided
    value = fmpq(t.numerator, t.denominator)
    tableau = loads(SMALL.format(t)).tableau
    single = two_frequencies(tableau, springs(tableau, 1), slow)
    is_stable = has(single.stable, fmpq(0), greatest)
    assert has(found.found, value, value) == is_stable


LARGER = """parameters: {t: free}
methods:
  - {family: lobatto-iiia, stages: 3}
  - {family: gauss, stages: 2}
transfer: {interpolation: t, collocation: 1 - t}
structure: semi-separable
"""


@pytest.mark.parametrize(
    ("greatest", "is_stable", "witness"),
    [
        ("9", True, None),
        pytest.param("19/2", False, None, marks=in_whole),
        ("10", False, "10"),
        pytest.param("20", False, "10", marks=in_whole),
    ],
)
def test_one_interval_reaches_the_bound(
    greatest: str, is_stable: bool, witness: str | None
) -> None:
    """With t = 0 there are two, x < 9.48 and 11.25 < x < 54; that x = 10 is unstable tells nothing
    of what is asked up to 19/2.
    """
    family = loads_family(LARGER)
    wanted = TwoSprings(fmpq(1, 2), 1, fmpq(*map(int, greatest.split("/"))))
    kind = SpringStability(Members(family, "method"), family.tableau, wanted)
    assert kind.decide(fmpq(0)) is is_stable
    found = kind.witness(fmpq(0))
    assert (found and str(found)) == witness


@in_whole
def test_one_value_has_no_resonance_at_all() -> None:
    """Without a bound t = 1/4 is left, where the trace stays within ±2 for every x."""
    for slow in (fmpq(1, 2), fmpq(2)):
        found = small(slow, None).found
        assert [x.start.exact for x in found if x.start] == [fmpq(1, 4)]
        assert found[0].is_point


@in_whole
def test_the_transfer_without_the_first_resonance() -> None:
    """(τ − 1)² = 18a/((8 − a)(12 − a)), and no other τ, up to 3 (8 − a)(12 − a)/a, which is left
    out.
    """
    family = load_family(ROOT / ASK)
    slow = fmpq(1)
    product = (8 - slow) * (12 - slow)
    square = 18 * slow / product
    end = 3 * product / slow
    for greatest, is_stable in ((end - fmpq(1, 9), True), (end, False)):
        wanted = TwoSprings(slow, 1, greatest)
        values = stable_set(family, "p-stable", "method", wanted)
        assert not values.undecided
        roots = [x.start for x in values.found if x.is_point and x.start]
        assert len(roots) == len(values.found) == (2 if is_stable else 0)
        quadratic = Polynomial([1 - square, -2, 1])
        assert all(sign_at(quadratic, root) == 0 for root in roots)


@in_whole
def test_the_report(tmp_path: Path) -> None:
    """Text and JSON say which springs are meant."""
    (tmp_path / "free.yaml").write_text(SMALL.format("free"), "utf-8")
    command = ("design", "free.yaml", "--p-stable", "--fast", "F2", "--slow")
    text = gark(*command, "2", cwd=tmp_path).out
    assert "two springs  (hω_slow)² = 2, every (hω_fast)²\n" in text
    assert text.startswith("free.yaml: the method is stable for exactly t = 1/4\n")
    result = gark(*command, "2", "--format", "json", cwd=tmp_path)
    data = json.loads(result.out)
    assert data["springs"] == {"slow": "2", "fast": 2, "up_to": None}
    assert data["set"] == [{"point": "1/4"}]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--p-stable", "--slow", "1"), "--slow and --fast belong together"),
        (("--p-stable", "--up-to", "1"), "--up-to is a bound"),
        (("--slow", "1", "--fast", "F2"), "add --p-stable"),
        (("--p-stable", "--slow", "1", "--fast", "F3"), "no colour 'F3'"),
        (("--p-stable", "--slow", "-1", "--fast", "F2"), "not negative"),
    ],
)
def test_options_that_do_not_fit(options: tuple[str, ...], message: str) -> None:
    """They are refused before anything is computed."""
    result = gark("design", ASK, *options)
    assert result.code == 2
    assert message in result.err
