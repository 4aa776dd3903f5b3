"""The oscillator: the step matrix and the stable step sizes by a second way, and the known figures."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.display import to_float
from garkcli.exact.field import ONE
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.families.registry import diagonal_method
from garkcli.longtime.history import stability as fate_of
from garkcli.methodfile.load import load, loads
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stability.oscillator import (
    OscillatorStability,
    Ratio,
    oscillator_stability,
    stable_set,
    usual_oscillator,
)
from garkcli.stability.springs_plane import springs_plane
from garkcli.stability.two_frequencies import springs, two_frequencies
from garkcli.stepping.linear import linear_step
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark as gark_command
from tests.whole import at_most

METHODS = sorted(Path("methods").glob("*.gark.yaml"))
STEPS = st.fractions(min_value="1/40", max_value=8, max_denominator=40).map(
    lambda x: fmpq(x.numerator, x.denominator)
)


@cache
def analysed(path: Path) -> tuple[Tableau, Oscillator, OscillatorStability]:
    """A method of the paper with what is found of it."""
    tableau = load(str(path)).tableau
    problem = Oscillator.default(terms_of(tableau), ONE)
    return tableau, problem, oscillator_stability(tableau, problem)


def contains(found: OscillatorStability, x: fmpq) -> bool:
    """Whether x is in the stable set."""
    at = RealRoot.rational(x)
    for interval in found.stable:
        after = interval.start < at or (interval.has_start and interval.start == at)  # type: ignore[operator]
        before = (
            interval.end is None or at < interval.end or (interval.has_end and interval.end == at)
        )
        if after and before:
            return True
    return False


@pytest.mark.parametrize("path", METHODS, ids=lambda path: path.name)
@settings(max_examples=at_most(5, 80), deadline=None)
@given(STEPS)
def test_step_sizes_one_by_one(path: Path, h: fmpq) -> None:
    """For single step sizes R(h) is found by solving the stages, and its powers are followed exactly."""
    tableau, problem, found = analysed(path)
    R = linear_step(tableau, problem).at(h)
    for i in range(2):
        for j in range(2):
            entry = found.step.numerators[i][j](h)
            assert entry == R[i][j] * found.step.denominator(h)
    is_bounded = fate_of(R).fate not in ("grows", "unstable")
    assert contains(found, h * h) == is_bounded


def test_the_rectangular_method() -> None:
    """Its trace, both intervals, its phase lag and the form that it conserves."""
    _, _, found = analysed(Path("methods/rectangular.gark.yaml"))
    x = Polynomial([0, 1])
    assert found.trace.numerator * 24 == x * x - x * 22 + 48
    assert found.trace.denominator * 24 == x + 24
    assert found.determinant.is_one
    ends = [(i.start.exact, i.end.exact) for i in found.stable]  # type: ignore[union-attr]
    assert ends == [(0, 8), (12, 24)]
    assert [(i.has_start, i.has_end) for i in found.stable] == [(True, False), (False, False)]
    assert not found.is_p_stable
    assert (found.phase.order, found.phase.constant) == (4, fmpq(-1, 2880))


@pytest.mark.parametrize("path", METHODS, ids=lambda path: path.name)
def test_the_form_is_conserved(path: Path) -> None:
    """S(M y) = S(y) as an identity of rational functions, where det M = 1."""
    _, _, found = analysed(path)
    form = found.conserved
    if form is None:
        assert not found.determinant.is_one
        return
    (a, b), (c, d) = found.step.numerators
    D = found.step.denominator
    alpha, beta, gamma = form
    # columns of M are the images of (1, 0) and (0, 1)
    assert alpha * a * a + beta * a * c + gamma * c * c == alpha * D * D
    assert alpha * b * b + beta * b * d + gamma * d * d == gamma * D * D
    mixed = alpha * a * b * 2 + beta * (a * d + b * c) + gamma * c * d * 2
    assert mixed == beta * D * D


@pytest.mark.parametrize("stages", range(1, 7))
def test_gauss_methods_are_p_stable(stages: int) -> None:
    """|R(iy)| = 1 for all y."""
    tableau = gark([diagonal_method("gauss", stages)], {})
    found = oscillator_stability(tableau, Oscillator.default(1, ONE))
    assert found.is_p_stable
    assert found.phase.order == 2 * stages


def test_stoermer_verlet_is_unstable_at_its_end() -> None:
    """At hω = 2 the eigenvalue −1 is double and the step is no multiple of the identity."""
    _, _, found = analysed(Path("methods/stoermer-verlet.gark.yaml"))
    (interval,) = found.stable
    assert interval.end is not None
    assert interval.end.exact == 4
    assert not interval.has_end
    assert (found.phase.order, found.phase.constant) == (2, fmpq(-1, 24))


def test_half_interpolation_half_collocation() -> None:
    """The combination with τ = 1/2 on Gauss 2 × Lobatto IIIA 3: its first instability, exactly."""
    tableau = loads(
        "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\n"
        "transfer: {interpolation: 1/2, collocation: 1/2}"
    ).tableau
    found = oscillator_stability(tableau, Oscillator.default(2, ONE))
    first = found.stable[0].end
    assert first is not None
    assert first.exact == fmpq(144, 13)
    assert not found.stable[0].has_end


def test_a_fast_spring_against_steps_at_single_strengths() -> None:
    """The trace in x for given a is that of the step with both strengths put in."""
    tableau = load("methods/three-colours.gark.yaml").tableau
    split = springs(tableau, 1)
    found = two_frequencies(tableau, split, fmpq(1, 4))
    for x in (fmpq(1), fmpq(7, 3), fmpq(40)):
        total = fmpq(1, 4) + x
        shares = tuple(
            (k, (s * fmpq(1, 4) + f * x) / total)
            for k, s, f in zip(split.kinetic, split.slow, split.fast, strict=True)
        )
        whole = Oscillator(ONE, shares)
        M = oscillator_stability(tableau, whole)
        left = M.trace.numerator(total) * found.trace.denominator(x)
        assert left == found.trace.numerator(x) * M.trace.denominator(total)


def test_the_plane_of_springs_has_the_exact_traces() -> None:
    """|tr M|/2 in floats at points of a grid, by the exact trace for each slow frequency."""
    tableau = load("methods/three-colours.gark.yaml").tableau
    split = springs(tableau, 1)
    plane = springs_plane(tableau, split, 3.0, 6.0, points=4)
    assert (plane.slow, plane.fast) == ([0, 1, 2, 3], [0, 2, 4, 6])
    for i, slow in enumerate((0, 1, 2, 3)):
        trace = two_frequencies(tableau, split, fmpq(slow**2)).trace
        for j, fast in enumerate((0, 2, 4, 6)):
            value = trace.numerator(fmpq(fast**2)) / trace.denominator(fmpq(fast**2))
            assert plane.half_trace[i][j] == pytest.approx(abs(float(value)) / 2, rel=1e-12)


def test_one_spring_is_two_without_the_slow_one() -> None:
    """With a = 0 the fast spring has the intervals of the oscillator with the same split.

    At x = 0 there is no spring at all, and the particle goes away: in units of ω nothing moves.
    """
    tableau = load("methods/three-colours.gark.yaml").tableau
    found = two_frequencies(tableau, springs(tableau, 1), fmpq(0)).stable
    shares = ((ONE, fmpq(0)), (fmpq(0), ONE), (fmpq(0), fmpq(0)))
    alone = oscillator_stability(tableau, Oscillator(ONE, shares)).stable
    assert [(x.start, x.end, x.has_end) for x in found] == [
        (x.start, x.end, x.has_end) for x in alone
    ]
    assert not found[0].has_start


def test_where_an_entry_has_a_pole_there_is_no_step() -> None:
    """M = (0, 1 − x; −1/(1 − x), 0) has trace 0 and determinant 1, and does not exist at x = 1."""
    zero, one = Polynomial([]), Polynomial([1])
    pole = Polynomial([1, -1])
    found = stable_set(Ratio(zero, one), Ratio(one, one), (pole * pole, -one), pole)
    before, after = found
    assert before.end is not None
    assert before.end.exact == 1
    assert (before.has_end, after.has_start) == (False, False)


@pytest.mark.parametrize(
    ("name", "i_stable", "p_stable"),
    [
        ("backward-euler", True, False),
        ("sdirk-23", True, False),
        ("radau-iia-2", True, False),
        ("lobatto-iiic-2", True, False),
        ("implicit-midpoint", True, True),
        ("lobatto-iiib-2", True, True),
        ("forward-euler", False, False),
        ("rk4", False, False),
    ],
)
def test_p_stability_wants_that_nothing_decays(name: str, i_stable: bool, p_stable: bool) -> None:
    """Bounded for every step size is I-stable; P-stable with det M = |R(iy)|² = 1, as single steps
    have it.
    """
    tableau = load(name).tableau
    problem = Oscillator.default(1, ONE)
    found = oscillator_stability(tableau, problem)
    assert (found.is_i_stable, found.is_p_stable) == (i_stable, p_stable)
    areas = set()
    for z in (fmpq(1, 3), fmpq(2), fmpq(7)):
        (a, b), (c, d) = linear_step(tableau, problem).at(z)
        areas.add(a * d - b * c)
    assert (areas == {1}) is p_stable
    assert (max(map(to_float, areas)) <= 1) is i_stable


@pytest.mark.parametrize(
    ("name", "order", "constant"),
    [
        ("forward-euler", 2, fmpq(1, 3)),  # z − arctan z
        ("backward-euler", 2, fmpq(1, 3)),
        ("implicit-midpoint", 2, fmpq(1, 12)),  # z − 2 arctan(z/2)
        ("rk4", 4, fmpq(1, 120)),
        ("stoermer-verlet", 2, fmpq(-1, 24)),  # z − 2 arcsin(z/2): known to be ahead
    ],
)
def test_the_sign_of_the_phase_lag(name: str, order: int, constant: fmpq) -> None:
    """A step of Euler's method turns by arctan z < z and lags: the lag is positive; that of
    leapfrog is negative. A single step that is taken turns by as much less than z.
    """
    source = "methods/stoermer-verlet.gark.yaml" if name == "stoermer-verlet" else name
    tableau = load(source).tableau
    problem = Oscillator.default(terms_of(tableau), ONE)
    phase = oscillator_stability(tableau, problem).phase
    assert (phase.order, phase.constant) == (order, constant)
    z = fmpq(1, 50)
    (a, b), (c, d) = linear_step(tableau, problem).at(z)
    with ctx.workprec(200):
        cosine = arb(a + d) / (2 * arb(a * d - b * c).sqrt())
        lag = arb(z) - cosine.acos()
        leading = arb(constant) * arb(z) ** (order + 1)
    assert abs(float(lag / leading) - 1) < 1e-2


def test_the_phase_lag_says_who_is_ahead() -> None:
    """The report says what z is, and on which side the numerical solution is."""
    for name, told in (("backward-euler", "1/3*z^3, z = hω: behind"), ("verlet", ": ahead")):
        assert told in gark_command("stability", name).out


def test_between_poles_denominators_are_negative() -> None:
    """Tr M = x/(1 − x) and det M = 1: |tr M| < 2 for x < 2/3 and, where 1 − x < 0, for x > 2."""
    one = Polynomial([1])
    trace = Ratio(Polynomial([0, 1]), Polynomial([1, -1]))
    before, behind = stable_set(trace, Ratio(one, one), (one, -one), Polynomial([1, -1]))
    assert before.end is not None
    assert behind.start is not None
    assert (before.end.exact, behind.start.exact, behind.end) == (fmpq(2, 3), 2, None)
    assert (before.has_start, before.has_end, behind.has_start) == (True, False, False)


def test_a_method_that_does_nothing_has_order_zero() -> None:
    """With weights 0 the step is the identity, and no constant is made up."""
    tableau = loads("methods: [{A: [[0]], b: [0]}]").tableau
    found = oscillator_stability(tableau, Oscillator.default(1, ONE))
    assert (found.phase.order, found.phase.constant) == (0, None)


@pytest.mark.parametrize("x", [fmpq(1, 3), fmpq(2), fmpq(9)])
def test_the_discriminant_is_that_of_the_trace(x: fmpq) -> None:
    """4D² − N² over D² is 4 − (tr M)², where RK4 has tr M = 2 Re R(iy) = 2 − x + x²/12, x = y²."""
    found = usual_oscillator(load("rk4").tableau)
    assert found is not None
    trace = 2 - x + x**2 / 12
    assert found.discriminant(x) / found.trace.denominator(x) ** 2 == 4 - trace**2


def test_the_discriminant_of_two_springs_is_that_of_the_trace() -> None:
    """The same for a pair with a fast and a slow spring, from its trace."""
    tableau = load("methods/collocation.gark.yaml").tableau
    found = two_frequencies(tableau, springs(tableau, 1), fmpq(1))
    for x in (fmpq(1, 3), fmpq(2), fmpq(9)):
        N, D = found.trace.numerator(x), found.trace.denominator(x)
        assert found.discriminant(x) == (2 * D - N) * (2 * D + N)
