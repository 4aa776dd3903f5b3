"""Polynomials and matrices in balls: statements hold for every number in them, against floats."""

from __future__ import annotations

import cmath

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import (
    bits_for,
    cauchy_index,
    derivative,
    entrywise_max,
    integer_power,
    midpoint,
    plus,
    real_root,
    root_count,
    scalar_product,
    times,
    value,
)
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots, sign
from garkcli.stability.algebraic import is_positive as is_positive_form
from garkcli.stability.algebraic import negative_pivot
from garkcli.stability.ball_polynomials import (
    OPEN,
    UNLIMITED,
    Bounds,
    are_coprime,
    both,
    difference,
    first_failure,
    is_positive,
    least,
    mirrored,
    poles_are_right,
)
from tests.whole import at_most

ROOTS = st.lists(st.integers(-12, 12).map(lambda k: fmpq(k, 4)), max_size=4)
PAIRS = st.lists(
    st.tuples(st.integers(-8, 8).map(lambda k: fmpq(k, 4)), st.integers(1, 8)), max_size=2
)
LEADING = st.sampled_from([fmpq(1), fmpq(-1), fmpq(5, 3), fmpq(-1, 7)])
RADII = st.sampled_from([0.0, 1e-12, 1e-3, 0.3])


def polynomial(roots: list[fmpq], pairs: list[tuple[fmpq, int]], leading: fmpq) -> Polynomial:
    """With real roots, and pairs x ± i y of others."""
    p = Polynomial([leading])
    for x in roots:
        p = p * Polynomial([-x, 1])
    for x, y in pairs:
        p = p * Polynomial([x * x + y * y, -2 * x, 1])
    return p


def in_balls(p: Polynomial, radius: float = 0.0) -> list[arb]:
    """Its coefficients, each within a radius; zeros are exact."""
    with ctx.workprec(200):
        return [to_ball(a, 60) + arb(0, radius) if a else arb(0) for a in p.coefficients]


@given(ROOTS, PAIRS, LEADING, RADII)
def test_roots_in_balls_are_counted(
    roots: list[fmpq], pairs: list[tuple[fmpq, int]], leading: fmpq, radius: float
) -> None:
    """By Sturm's chain: the distinct real roots, or nothing; always where they are simple, exactly
    known, and no remainder is zero by chance.
    """
    p = polynomial(roots, pairs, leading)
    with ctx.workprec(200):
        count = root_count(in_balls(p, radius))
        if count is not None:
            assert count == len(set(roots))
            assert len(set(roots)) == len(roots)
        elif not radius and not pairs and len(roots) > 1:
            assert len(set(roots)) < len(roots) or sum(roots) == 0
        x = fmpq(3, 7)
        assert (value(in_balls(p), arb(x)) - p(x)).contains(0)
        assert (value(derivative(in_balls(p)), arb(x)) - p.derivative()(x)).contains(0)


@given(st.sets(st.integers(-12, 12), max_size=6), st.lists(st.integers(-12, 12), max_size=5))
def test_the_cauchy_index(poles: set[int], others: list[int]) -> None:
    """Jumps of g/f from −∞ to ∞ minus those from ∞ to −∞, at the roots of f."""
    zeros = [fmpq(x) for x in others if x not in poles][: max(len(poles) - 1, 0)]
    f, g = polynomial([fmpq(x) for x in poles], [], fmpq(1)), polynomial(zeros, [], fmpq(-2))
    with ctx.workprec(200):
        found = cauchy_index(in_balls(f), in_balls(g))
    jumps = [1 if sign(g(fmpq(x)) / f.derivative()(fmpq(x))) > 0 else -1 for x in poles]
    assert found is None or found == sum(jumps)
    assert found is not None or len(poles) > 1


@given(ROOTS, PAIRS, LEADING, RADII)
@settings(max_examples=at_most(10, 80))
def test_what_is_positive_and_where_it_fails(
    roots: list[fmpq], pairs: list[tuple[fmpq, int]], leading: fmpq, radius: float
) -> None:
    """For x > 0, and up to the first sign change there, for every polynomial in the balls."""
    p = polynomial(roots, pairs, leading)
    with ctx.workprec(200):
        balls = in_balls(p, radius)
        found = is_positive(balls)
        bounds = first_failure(balls)
        up_to = first_failure(balls, fmpq(1))
    positive = sorted(x for x in roots if x > 0)
    is_above = leading > 0 and not positive
    if found is not None:
        assert found == is_above
    elif not radius:
        assert not is_above or 0 in roots  # a root at an end leaves it open
    at_once = sign(p(fmpq(1, 10**9))) < 0
    behind = [fmpq(0)] if at_once else [x for x in positive if roots.count(x) % 2]
    fails = next(iter(behind), None)
    assert bounds.low is None or bounds.high is None or bounds.low <= bounds.high
    if fails is None:
        assert bounds.high is None
        assert (bounds == UNLIMITED) or positive or radius
    else:
        assert bounds != UNLIMITED
        assert bounds.low is not None
        assert bounds.low <= fails
        if bounds.high is not None:
            assert bounds.high >= fails
        if not radius and positive[:1] == [fails] and roots.count(fails) == 1 and not at_once:
            assert bounds.high is not None
            assert bounds.high - bounds.low < fmpq(1, 10**6)
    if up_to == UNLIMITED:
        assert fails is None or fails >= 1
    elif not radius and (not positive or positive[0] > 1) and not at_once:
        raise AssertionError("positive up to 1")


def test_edges_of_first_failures() -> None:
    """Zero polynomials, constants, a constant term that may be zero, and least ones."""
    assert first_failure([]) == first_failure([arb(0), arb(0)]) == UNLIMITED
    assert first_failure([arb(3)]) == first_failure([arb(0), arb(3), arb(0)]) == UNLIMITED
    assert first_failure([arb(-1), arb(5)]) == Bounds(fmpq(0), fmpq(0))
    assert first_failure([arb(0), arb(-1), arb(5)]) == Bounds(fmpq(0), fmpq(0))
    assert first_failure([arb(0, 1), arb(1)]) == OPEN
    one, two = Bounds(fmpq(1), fmpq(2)), Bounds(fmpq(3, 2), fmpq(7, 4))
    assert least([one, UNLIMITED, two]) == Bounds(fmpq(1), fmpq(7, 4))
    assert least([OPEN, one]) == Bounds(fmpq(0), fmpq(2))
    assert least([OPEN]) == OPEN
    assert least([UNLIMITED]) == least([]) == UNLIMITED
    assert [both(x, y) for x in (True, False, None) for y in (True, False, None)] == [
        *(True, False, None, False, False, False, None, False, None)
    ]


@given(ROOTS, PAIRS, LEADING, RADII)
def test_roots_to_the_right(
    roots: list[fmpq], pairs: list[tuple[fmpq, int]], leading: fmpq, radius: float
) -> None:
    """Whether all real parts are positive."""
    p = polynomial(roots, pairs, leading)
    with ctx.workprec(200):
        found = poles_are_right(in_balls(p, radius))
        again = poles_are_right([*in_balls(p, radius), arb(0)])
        x = arb(fmpq(2, 5))
        turned = value(mirrored(in_balls(p)), x) - value(in_balls(p), -x)
        assert turned.contains(0)
    assert found == again
    parts = [*roots, *(x for x, _ in pairs)]
    if found is not None:
        assert found == all(x > 0 for x in parts)
    elif not radius:
        assert any(x <= 0 for x in parts)


@given(ROOTS, PAIRS, ROOTS, PAIRS, RADII)
def test_common_roots_in_balls(
    roots: list[fmpq],
    pairs: list[tuple[fmpq, int]],
    others: list[fmpq],
    other_pairs: list[tuple[fmpq, int]],
    radius: float,
) -> None:
    """None are proved where there is one; without radii, wherever there is none."""
    p, q = polynomial(roots, pairs, fmpq(2)), polynomial(others, other_pairs, fmpq(-1))
    with ctx.workprec(400):
        found = are_coprime(in_balls(p, radius), in_balls(q, radius))
        x = fmpq(1, 3)
        apart = value(difference(in_balls(p), in_balls(q)), arb(x))
        assert (apart - (p(x) - q(x))).contains(0)
    has_common = bool(set(roots) & set(others)) or bool(set(pairs) & set(other_pairs))
    assert not (found and has_common)
    if not radius:
        assert found != has_common


MATRICES = st.integers(1, 4).flatmap(
    lambda n: st.lists(st.lists(st.integers(-3, 3), min_size=n, max_size=n), min_size=1, max_size=n)
)


@given(MATRICES, st.integers(-2, 1), st.integers(0, 3), st.sampled_from([0.0, 1e-12]))
def test_forms_are_positive_as_their_eigenvalues_are(
    rows: list[list[int]], shift: int, place: int, radius: float
) -> None:
    """Sums of squares, some with a diagonal entry less."""
    B = np.array(rows)
    M = B.T @ B
    k = place % len(M)
    M[k, k] += shift
    smallest = np.linalg.eigvalsh(M)[0]
    is_semidefinite = all(
        round(float(np.linalg.det(M[np.ix_(c, c)]))) >= 0 for c in _subsets(len(M))
    )
    assert (smallest > -1e-9) == is_semidefinite
    exact = tuple(tuple(fmpq(int(x)) for x in row) for row in M)
    pivot = negative_pivot(exact)
    assert (pivot is None) == is_semidefinite
    assert pivot is None or sign(pivot) <= 0
    balls = [[arb(int(x)) + arb(0, radius) if x else arb(0) for x in row] for row in M]
    with ctx.workprec(200):
        found = is_positive_form(balls)
    if found is not None:
        assert found == is_semidefinite
    elif not radius:
        assert abs(smallest) < 1e-9 or not is_semidefinite


def _subsets(size: int) -> list[list[int]]:
    return [[i for i in range(size) if mask >> i & 1] for mask in range(1, 1 << size)]


@given(st.fractions(-4, 4, max_denominator=9), st.integers(-5, 5), st.sampled_from([0.0, 0.1, 2.0]))
def test_powers_and_roots_hold_every_number(x: object, exponent: int, radius: float) -> None:
    """At the ends and within."""
    centre = fmpq(x.numerator, x.denominator)  # type: ignore[attr-defined]
    ball = arb(centre) + arb(0, radius)
    for share in (-1, fmpq(-1, 3), 0, fmpq(1, 2), 1):
        number = centre + midpoint(arb(radius)) * fmpq(share)
        if number or exponent >= 0:
            power = integer_power(ball, exponent)
            assert power.contains(number**exponent) or not power.is_finite()
            if not radius:
                assert power.is_finite()
    for index in (2, 3, 5):
        if centre > 0 or index % 2:
            root = real_root(arb(centre), index)
            if centre:
                assert integer_power(root, index).contains(centre)
                assert (root > 0) == (centre > 0)
    assert midpoint(arb(fmpq(3, 8))) == fmpq(3, 8)
    assert midpoint(arb(-20)) == -20
    assert bits_for(fmpq(1, 2**100)) >= 200 + 64


def test_entries() -> None:
    """Sums, products and larger ones, entry by entry."""
    u, v = [arb(1), arb(-2), arb(3)], [arb(4), arb(5), arb(-6)]
    assert [float(x) for x in plus(u, v)] == [5, 3, -3]
    assert [float(x) for x in times(u, v)] == [4, -10, -18]
    assert [float(x) for x in entrywise_max(u, v)] == [4, 5, 3]
    assert float(scalar_product(u, v)) == -24


@pytest.mark.parametrize("degree", [3, 4, 7])
def test_poles_of_published_denominators(degree: int) -> None:
    """Those of (1 − γz)ⁿ are right for γ > 0, of e^z's Taylor polynomials not all from degree 5 on."""
    power = Polynomial([1])
    for _ in range(degree):
        power = power * Polynomial([1, fmpq(-1, 3)])
    assert poles_are_right(in_balls(power)) is True
    taylor, a = [], fmpq(1)
    for k in range(degree + 1):
        taylor.append(a)
        a /= -(k + 1)
    roots = np.roots([float(x.p) / float(x.q) for x in reversed(taylor)])
    assert poles_are_right(in_balls(Polynomial(taylor))) is bool(roots.real.min() > 0)
    assert all(cmath.isfinite(x) for x in roots)
    assert len(real_roots(Polynomial(taylor))) == degree % 2
