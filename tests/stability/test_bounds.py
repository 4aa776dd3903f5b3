"""Rounded coefficients: intervals, SSP and algebraic stability hold for every method within."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner
from flint import arb, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.cli.main import gark
from garkcli.exact.cells import Interval
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.load import loads
from garkcli.stability.algebraic import algebraic_stability, algebraic_within, is_positive
from garkcli.stability.ball_polynomials import OPEN, UNLIMITED, Bounds, first_failure, least
from garkcli.stability.linear import imaginary_set, real_set, stability_function
from garkcli.stability.ssp import ssp_coefficient
from garkcli.stability.within import stability_within
from garkcli.tableau.tableau import Tableau
from tests.oracles.draws import fractions
from tests.whole import at_most

TOLERANCE = fmpq(1, 10**10)
GRAIN = fmpq(1, 1 << 150)
ENTRY = fractions(0, 1, 6)
KNOWN = {
    "heun": ([["0", "0"], ["1", "0"]], ["1/2", "1/2"], 2),
    "rk4": (
        [["0"] * 4, ["1/2", "0", "0", "0"], ["0", "1/2", "0", "0"], ["0", "0", "1", "0"]],
        ["1/6", "1/3", "1/3", "1/6"],
        4,
    ),
    "ssp3": ([["0"] * 3, ["1", "0", "0"], ["1/4", "1/4", "0"]], ["1/6", "1/6", "2/3"], 3),
    "radau-iia": ([["5/12", "-1/12"], ["3/4", "1/4"]], ["3/4", "1/4"], 3),
    "lobatto-iiia": ([["0", "0"], ["1/2", "1/2"]], ["1/2", "1/2"], 2),
}


def method(A: list[list[str]], b: list[str]) -> Tableau:
    """A method of one colour."""
    return loads(f"methods: [{{A: {A}, b: {b}}}]").tableau


def disturbed(A: list[list[str]], b: list[str], signs: list[int]) -> Tableau:
    """The method with each coefficient that is not zero off by the tolerance, by a sign each."""
    following = iter(signs * 30)

    def changed(x: str) -> str:
        return x if x == "0" else f"{x} + {next(following)}*({TOLERANCE})"

    return method([[changed(x) for x in row] for row in A], [changed(x) for x in b])


def lies_within(value: RealRoot | None, bounds: Bounds) -> bool:
    """Whether a number, or ∞, is between bounds."""
    if value is None:
        return bounds.high is None
    above = bounds.low is not None and not value < RealRoot.rational(bounds.low)
    below = bounds.high is None or not RealRoot.rational(bounds.high) < value
    return above and below


def first_end(intervals: tuple[Interval, ...]) -> RealRoot | None:
    """The end of the interval that begins at 0."""
    if not intervals or intervals[0].start != RealRoot.rational(fmpq(0)):
        return RealRoot.rational(fmpq(0))
    return intervals[0].end


@st.composite
def explicit(draw: st.DrawFn) -> tuple[list[list[str]], list[str]]:
    """Random explicit methods."""
    s = draw(st.integers(1, 3))
    A = [[str(draw(ENTRY)) if j < i else "0" for j in range(s)] for i in range(s)]
    return A, [str(draw(ENTRY)) for _ in range(s)]


@settings(max_examples=at_most(12, 200))
@given(explicit())
def test_every_method_is_between_its_bounds(entries: tuple[list[list[str]], list[str]]) -> None:
    """Real interval, SSP and algebraic stability, exactly and in balls."""
    bounds = stability_within(method(*entries), [fmpq(1)], GRAIN)
    neighbour = method(*entries)
    R = stability_function(neighbour)
    assert lies_within(first_end(real_set(R)), bounds.real)
    ssp = ssp_coefficient(neighbour)
    assert ssp is not None
    assert lies_within(ssp.value, bounds.ssp)
    verdict = algebraic_within(method(*entries), GRAIN)
    exact = algebraic_stability(neighbour)
    assert exact is not None
    assert verdict in {None, exact.holds}


@pytest.mark.parametrize("name", KNOWN)
def test_known_methods(name: str) -> None:
    """The exact values lie between bounds that are close."""
    A, b, _ = KNOWN[name]
    tableau = method(A, b)
    found = stability_within(tableau, [fmpq(1)], GRAIN)
    R = stability_function(tableau)
    ssp = ssp_coefficient(tableau)
    assert ssp is not None
    pairs = [
        (first_end(real_set(R)), found.real),
        (first_end(imaginary_set(R)), found.imaginary),
        (ssp.value, found.ssp),
    ]
    for value, bounds in pairs:
        assert lies_within(value, bounds)
        if bounds.high is not None and bounds.low is not None:
            assert bounds.high - bounds.low < fmpq(1, 1000)
    if name not in {"radau-iia", "lobatto-iiia"}:
        assert all(bounds.high is not None for _, bounds in pairs)


def test_algebraic_stability_is_decided_where_it_can_be() -> None:
    """Weights below zero, or a negative direction, decide, and a singular matrix too."""
    assert algebraic_within(method(*KNOWN["rk4"][:2]), GRAIN) is False
    assert algebraic_within(method(*KNOWN["radau-iia"][:2]), GRAIN) is True
    clear = method([["1", "0"], ["0", "1"]], ["1/2", "1/2"])
    assert algebraic_within(clear, GRAIN) is True
    assert is_positive([[arb(0, 1), arb(3)], [arb(3), arb(0, 1)]]) is False


def test_first_failures() -> None:
    """Never, at once, open from the start, and open beyond a double root."""
    assert first_failure([arb(1), arb(0), arb(2)]) == UNLIMITED
    assert first_failure([arb(0), arb(-1)]).high == 0
    assert first_failure([arb(0, 1), arb(1)]) == OPEN
    touching = first_failure([arb(1, 1e-20), arb(-2), arb(1)])
    assert touching.high is None
    assert touching.low is not None
    assert fmpq(9, 10) < touching.low <= 1
    both = least([touching, Bounds(fmpq(3), fmpq(4)), UNLIMITED])
    assert (both.low, both.high) == (touching.low, 4)


@given(st.fractions(Fraction(1, 1000), 900, max_denominator=1000))
def test_far_and_near_roots_are_found(root: Fraction) -> None:
    """1 − x/r fails at r."""
    r = fmpq(root.numerator, root.denominator)
    found = first_failure([arb(1), arb(-1 / r)])
    assert found.low is not None
    assert found.high is not None
    assert found.low <= r <= found.high
    assert found.high - found.low < r / 10**9


def test_the_report(tmp_path: Path) -> None:
    """Text has the digits that are certain, JSON the bounds."""
    path = tmp_path / "rounded.yaml"
    path.write_text(
        "A: [[0, 0, 0], [1, 0, 0], [0.25, 0.25, 0]]\n"
        "b: [0.166666666667, 0.166666666667, 0.666666666667]\n"
        "tolerance: 1e-12\n",
        encoding="utf-8",
    )
    text = CliRunner().invoke(gark, ["stability", str(path)]).output
    assert "−z ≤ 2.51274532662\n" in text
    assert "y² ≤ 3.00000000000\n" in text
    json_text = CliRunner().invoke(gark, ["stability", str(path), "--format", "json"])
    (data,) = json.loads(json_text.output)["files"]
    ends = data["real_interval"]
    assert float(ends["at_least"]) == float(ends["at_most"]) == 2.5127453266183286
