"""Several colours: R(z1, …, zN) by a second way, implicit-explicit pairs, additive SSP radii."""

from __future__ import annotations

import numpy as np
import pytest
from flint import Ordering, fmpq, fmpq_mpoly_ctx
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli.exact.display import to_ball, to_float
from garkcli.exact.enclosing import root_count
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import SingularMatrixError, solve
from garkcli.exact.multivariate import Multivariate
from garkcli.exact.polynomial import Polynomial, gcd, subresultant
from garkcli.exact.roots import real_roots
from garkcli.methodfile.load import load, loads
from garkcli.stability.damping import (
    ImexPair,
    ball_roots_are_right,
    exact_roots_are_right,
    imex_pair,
)
from garkcli.stability.fraction import Fraction, stability_fraction
from garkcli.stability.ssp import additive_radius, ssp_coefficient
from garkcli.stability.summary import several_colours
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau
from tests.oracles.draws import fractions
from tests.whole import at_most, in_whole

ENTRY = fractions(-2, 2, 4).map(str)
IMEX_EULER = "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [[1, 0], [0, 1]]}"
SSP_222 = """
parameters: {g: 1 - sqrt(2)/2}
methods:
  - {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}
  - {A: [[g, 0], [1 - 2*g, g]], b: [1/2, 1/2]}
transfer: {blocks: {"1,2": [[g, 0], [1 - 2*g, g]], "2,1": [[0, 0], [1, 0]]}}
"""
"""L. Pareschi, G. Russo 2005, IMEX-SSP2(2,2,2): stages of both parts at one point."""


def matrix(draw: st.DrawFn, rows: int, columns: int) -> list[list[str]]:
    """Entries with small denominators."""
    row = st.lists(ENTRY, min_size=columns, max_size=columns)
    return [draw(row) for _ in range(rows)]


@st.composite
def coupled(draw: st.DrawFn) -> Tableau:
    """Random methods of two or three colours with all blocks."""
    stages = draw(st.lists(st.integers(1, 2), min_size=2, max_size=3))
    A = [[matrix(draw, s, t) for t in stages] for s in stages]
    b = [matrix(draw, 1, s)[0] for s in stages]
    return loads(f"tableau: {{A: {A}, b: {b}}}").tableau


@st.composite
def pairs(draw: st.DrawFn) -> Tableau:
    """Random pairs, the first part explicit, the second one diagonally implicit."""
    s = draw(st.integers(1, 3))
    gamma = draw(st.sampled_from(["1/4", "1/2", "1", "1/2 + sqrt(2)/4"]))
    explicit = [[draw(ENTRY) if j < i else "0" for j in range(s)] for i in range(s)]
    implicit = [
        [gamma if j == i else (draw(ENTRY) if j < i else "0") for j in range(s)] for i in range(s)
    ]
    b = matrix(draw, 2, s)
    return loads(f"ark: {{A: [{explicit}, {implicit}], b: {b}}}").tableau


def value_of_a_step(tableau: Tableau, z: list[fmpq]) -> Number:
    """R(z) = 1 + Σ z_l b_lᵀ Y_l with the stage values Y_l from their linear equations."""
    starts, size = [], 0
    for space in tableau.spaces:
        starts.append(size)
        size += space.stages
    rows: list[list[Number]] = [[ONE if i == j else ZERO for j in range(size)] for i in range(size)]
    for k, start in enumerate(starts):
        for m, colour in enumerate(tableau.colours):
            block = tableau.blocks[k, m]
            for i, line in enumerate(block, start=start):
                for j, a in enumerate(line, start=starts[colour.space]):
                    rows[i][j] = rows[i][j] - z[m] * a
    right = tuple((x,) for space in tableau.spaces for x in space.one)
    stages = solve(tuple(map(tuple, rows)), right)
    total: Number = ONE
    for m, colour in enumerate(tableau.colours):
        for i, b in enumerate(colour.b, start=starts[colour.space]):
            total = total + z[m] * b * stages[i][0]
    return total


@settings(max_examples=at_most(8, 160))
@given(coupled() | pairs(), st.data())
def test_the_fraction_is_what_a_step_gives(tableau: Tableau, data: st.DataObject) -> None:
    """P(z) = Q(z) R(z) at rational points where the stage equations are solved one by one."""
    R = stability_fraction(tableau)
    assert R is not None
    for _ in range(3):
        point = [fmpq(data.draw(st.integers(-9, 9)), 7) for _ in range(tableau.size)]
        try:
            expected = value_of_a_step(tableau, point)
        except SingularMatrixError:
            continue
        assert R.numerator(point) == expected * R.denominator(point)


def common_factor_degree(R: Fraction) -> int:
    """The total degree of the greatest common divisor, by python-flint."""
    names = [f"z{k}" for k in range(R.numerator.variables)]
    ring = fmpq_mpoly_ctx.get(names, Ordering.degrevlex)
    P, Q = (ring.from_dict(dict(p.terms)) for p in (R.numerator, R.denominator))
    return int(P.gcd(Q).total_degree())


@in_whole
@settings(max_examples=at_most(3, 60))
@given(coupled())
def test_lowest_terms(tableau: Tableau) -> None:
    """No common factor is left, and the doubled method has the fraction of the method itself."""
    R = stability_fraction(tableau)
    assert R is not None
    assert R.is_reduced
    assert common_factor_degree(R) == 0
    assert stability_fraction(doubled(tableau)) == R


def doubled(tableau: Tableau) -> Tableau:
    """The same method with two copies of each stage, which share its weight.

    Copies see themselves more than each other: the difference of two copies of colour l is zero,
    and puts the factor 1 − 2z_l/3 into det(I − W(z)).
    """
    exact = in_points(tableau)
    assert exact is not None
    N = range(exact.size)

    def shared(row: tuple[Number, ...], more: int | None) -> list[str]:
        entries = [x / 2 for x in row for _ in range(2)]
        if more is not None:
            entries[more] = entries[more] + fmpq(1, 3)
            entries[more ^ 1] = entries[more ^ 1] - fmpq(1, 3)
        return [str(x) for x in entries]

    A = []
    for l in N:
        blocks = []
        for m in N:
            rows = [row for row in exact.block(l, m) or () for _ in range(2)]
            blocks.append([shared(row, i if l == m else None) for i, row in enumerate(rows)])
        A.append(blocks)
    b = [shared(colour.b, None) for colour in exact.colours]
    return loads(f"tableau: {{A: {A}, b: {b}}}").tableau


def test_a_common_factor_of_a_number_field_is_cancelled() -> None:
    """Over ℚ(√2) too: the doubled method has the fraction of the method itself."""
    tableau = loads(SSP_222).tableau
    once, twice = (stability_fraction(tableau), stability_fraction(doubled(tableau)))
    # each file has a number field of its own: numbers are compared as texts
    assert str(once) == str(twice)


def test_a_large_method_is_refused() -> None:
    """Three times ten stages would take 496 lines."""
    families = ["{family: gauss, stages: 10}"] * 3
    text = f"methods: [{', '.join(families)}]\ntransfer: collocation"
    assert stability_fraction(loads(text).tableau) is None


def test_imex_euler() -> None:
    """R = (1 + z1)/(1 − z2): damped for |1 + z1| ≤ 1; r ≤ (1, ∞) (I. Higueras 2006)."""
    found = several_colours(loads(IMEX_EULER).tableau)
    assert found.R is not None
    assert found.R.numerator == Multivariate.of(2, {(0, 0): ONE, (1, 0): ONE})
    assert found.R.denominator == Multivariate.of(2, {(0, 0): ONE, (0, 1): -ONE})
    assert found.pair is not None
    assert (found.pair.explicit, found.pair.implicit) == (0, 1)
    assert found.real is not None
    assert found.real.end is not None
    assert found.real.end.exact == 2
    assert found.imaginary is not None
    assert found.imaginary.end is not None
    assert found.imaginary.end.exact == 0
    on_circle = [(fmpq(-1) + fmpq(3, 5), fmpq(4, 5)), (fmpq(-2), ZERO), (ZERO, ZERO)]
    assert all(found.pair.is_damped(a, b) for a, b in on_circle)
    assert not found.pair.is_damped(fmpq(-2, 5), fmpq(4, 5) + fmpq(1, 10**40))
    radii = [radius.radius for radius in found.radii]
    ends = [None if r is None or r.value is None else r.value.exact for r in radii]
    assert ends == [fmpq(1), None, fmpq(1)]


IMAGINARY = np.concatenate([-np.geomspace(1e3, 1e-3, 400), [0], np.geomspace(1e-3, 1e3, 400)])
"""Many y; z_I = iy."""


def largest_modulus(tableau: Tableau, pair: ImexPair, z: complex) -> float:
    """The largest |R(z, iy)| over many y, by a step of y' = λ_E y + λ_I y in floats for each."""
    numbers = np.empty((tableau.size, len(IMAGINARY)), complex)
    numbers[pair.explicit] = z
    numbers[pair.implicit] = 1j * IMAGINARY
    return float(np.max(np.abs(steps(tableau, numbers))))


def steps(tableau: Tableau, z: np.ndarray) -> np.ndarray:
    """R at many points, colours × points, by the linear equations of the stages in floats."""
    sizes = [space.stages for space in tableau.spaces]
    starts = np.cumsum([0, *sizes])
    whole = np.zeros((z.shape[1], starts[-1], starts[-1]), complex)
    weights = np.zeros((z.shape[1], starts[-1]), complex)
    for m, colour in enumerate(tableau.colours):
        columns = slice(starts[colour.space], starts[colour.space + 1])
        weights[:, columns] += np.outer(z[m], [to_float(x) for x in colour.b])
        for k in range(len(sizes)):
            block = np.array([[to_float(x) for x in row] for row in tableau.blocks[k, m]])
            whole[:, starts[k] : starts[k + 1], columns] += z[m][:, None, None] * block
    right = np.ones((z.shape[1], starts[-1], 1))
    stages = np.linalg.solve(np.eye(starts[-1]) - whole, right)[:, :, 0]
    return 1 + (weights * stages).sum(axis=1)


Complex = tuple[Number, Number]
"""The real and the imaginary part, exactly."""


def product(z: Complex, w: Complex) -> Complex:
    """Two complex numbers multiplied as at school."""
    return z[0] * w[0] - z[1] * w[1], z[0] * w[1] + z[1] * w[0]


def value_at(p: Multivariate, points: list[Complex]) -> Complex:
    """A polynomial in complex numbers, power by power."""
    real, imaginary = ZERO, ZERO
    for exponents, coefficient in p.terms:
        term: Complex = (coefficient, ZERO)
        for z, e in zip(points, exponents, strict=True):
            for _ in range(e):
                term = product(term, z)
        real, imaginary = real + term[0], imaginary + term[1]
    return real, imaginary


THIRDS = fractions(-3, 3, 3).map(lambda x: fmpq(x.numerator, x.denominator))


@settings(max_examples=at_most(25, 400))
@given(pairs(), THIRDS, THIRDS, THIRDS)
def test_parts_are_those_of_complex_numbers(tableau: Tableau, a: fmpq, b: fmpq, y: fmpq) -> None:
    """P(a + ib, iy) and Q by complex arithmetic, exactly; E is the difference of their squares."""
    assert_parts(tableau, a, b, y)


@pytest.mark.parametrize("name", ["ars-233", "ars-343", "imex-ssp3-332"])
def test_parts_of_known_pairs(name: str) -> None:
    """The same where z_I and z_E occur in powers up to the third one."""
    assert_parts(load(name).tableau, fmpq(-2, 3), fmpq(5, 4), fmpq(-7, 5))


def assert_parts(tableau: Tableau, a: fmpq, b: fmpq, y: fmpq) -> None:
    """The parts of a pair at one point."""
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    points: list[Complex] = [(ZERO, y), (ZERO, y)]
    points[pair.explicit] = (a, b)
    P = value_at(pair.R.numerator, points)
    Q = value_at(pair.R.denominator, points)
    (p, q), (u, v) = pair.parts
    assert (p((a, b, y)), q((a, b, y))) == P
    assert (u((a, b, y)), v((a, b, y))) == Q
    assert pair.margin((a, b, y)) == Q[0] ** 2 + Q[1] ** 2 - P[0] ** 2 - P[1] ** 2


@pytest.mark.parametrize(
    ("name", "real", "imaginary"),
    [
        ("ars-121", 1, 1),
        ("ars-222", 2, 0),
        ("ars-233", 2.318307693735, 0),
        ("ars-232", 1.060660171780, 0),
        ("imex-ssp2-322", 1.859150765998, 0),
        ("imex-ssp3-332", 2.512745326618, 0),
    ],
)
def test_rays_of_known_pairs_by_steps(name: str, real: float, imaginary: float) -> None:
    """Up to the end of each ray steps in floats are damped, and just beyond some are not."""
    tableau = load(name).tableau
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    rays = [(pair.real_ray(), real, -1), (pair.imaginary_ray(), imaginary, 1j)]
    for ray, length, direction in rays:
        assert ray is not None
        assert ray.end is not None
        assert abs(float(ray.end.ball(64)) - length) < 1e-11
        for share in (0.1, 0.5, 0.9, 1 - 1e-6):
            assert largest_modulus(tableau, pair, direction * length * share) <= 1 + 1e-12
        assert largest_modulus(tableau, pair, direction * (length + 0.1)) > 1 + 1e-6
        if length:
            assert largest_modulus(tableau, pair, direction * (length + 1e-3)) > 1 + 1e-4


@settings(max_examples=at_most(10, 200))
@given(pairs(), st.integers(-12, 4), st.integers(0, 8))
def test_damped_points_against_many_samples(tableau: Tableau, a: int, b: int) -> None:
    """A γ > 0 has its poles to the right: the imaginary axis decides, and a grid on it agrees."""
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    point = fmpq(a, 4), fmpq(b, 4)
    largest = largest_modulus(tableau, pair, complex(a / 4, b / 4))
    assume(abs(largest - 1) > 1e-6)
    assert pair.is_damped(*point) == (largest < 1)


def test_damped_points_without_balls(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where balls say nothing the exact decision does; the poles of a full implicit part depend on
    z_E, and a grid of z_I on the axis and in the half plane agrees.
    """
    tableau = loads(
        "ark: {A: [[[1/2, -1/4], [1/2, 1/2]], [[0, 0], [1/2, 0]]], b: [[1/2, 1/2], [1/2, 1/2]]}"
    ).tableau
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    assert not pair.has_fixed_poles
    points = [(fmpq(a, 4), fmpq(b, 4)) for a in (-12, -5, -1, 1, 3) for b in (0, 1, 5)]
    by_balls = [pair.is_damped(*point) for point in points]
    assert {*by_balls} == {True, False}
    for (a, b), is_damped in zip(points, by_balls, strict=True):
        assert (largest_modulus(tableau, pair, complex(float(a), float(b))) < 1) == is_damped
    monkeypatch.setattr("garkcli.stability.damping.ball_roots_are_right", lambda *_: None)
    monkeypatch.setattr("garkcli.stability.damping.root_count", lambda *_: None)
    assert [pair.is_damped(*point) for point in points] == by_balls


@settings(max_examples=at_most(60, 400))
@given(st.lists(st.tuples(st.integers(-2, 4), st.integers(-3, 3)), max_size=4))
def test_roots_to_the_right_against_what_was_multiplied_out(roots: list[tuple[int, int]]) -> None:
    """Q = Π (z − a − ib), along z = iy with complex coefficients: to the right exactly when all
    a > 0; balls say the same or nothing.
    """
    u, v = Polynomial([1]), Polynomial([])
    for a, b in roots:
        line = Polynomial([-b, 1])
        u, v = -(u * a) - v * line, u * line - v * a
    is_right = all(a > 0 for a, _ in roots)
    assert exact_roots_are_right(u, v) == is_right
    balls = [[to_ball(x, 40) for x in p.coefficients] for p in (u, v)]
    assert ball_roots_are_right(*balls) in {None, is_right}


def test_poles_that_move() -> None:
    """Couplings back and forth: Q = 1 − z2 − z1 z2, whose root in z2 is 1/(1 + z1)."""
    text = "tableau: {A: [[[[0]], [[1]]], [[[1]], [[1]]]], b: [[0], [1]]}"
    tableau = loads(text).tableau
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    assert not pair.has_fixed_poles
    assert pair.real_ray() is None
    assert pair.is_damped(fmpq(-1, 2), ZERO)
    assert not pair.is_damped(fmpq(-1, 2), fmpq(1, 3))
    assert not pair.is_damped(fmpq(-3, 2), ZERO)


@in_whole
@settings(max_examples=at_most(8, 60))
@given(pairs())
def test_rays_end_where_points_end(tableau: Tableau) -> None:
    """Points inside are damped, also by steps in floats; a little beyond the end they are not."""
    pair = imex_pair(tableau, stability_fraction(tableau))
    assert pair is not None
    rays = [(pair.real_ray(), -1, 0), (pair.imaginary_ray(), 0, 1)]
    for ray, u, v in rays:
        assert ray is not None
        end = fmpq(8)
        if ray.end is not None:
            mantissa, exponent = ray.end.ball(128).mid().man_exp()
            end = fmpq(mantissa) * fmpq(2) ** int(exponent)
            beyond = end + fmpq(1, 10**9)
            assert not pair.is_damped(u * beyond, v * beyond)
        for k in range(1, 8):
            inside = end * fmpq(k, 8)
            if inside > fmpq(1, 10**9):
                assert pair.is_damped(u * inside, v * inside)
                z = complex(u * float(inside), v * float(inside))
                assert largest_modulus(tableau, pair, z) <= 1 + 1e-9


def test_an_explicit_and_an_implicit_colour_are_told_apart() -> None:
    """Which one is explicit follows from the diagonal blocks; two implicit ones are no pair."""
    ars = load("methods/ark-ars222.gark.yaml").tableau
    pair = imex_pair(ars, stability_fraction(ars))
    assert pair is not None
    assert pair.explicit == 0
    both = load("methods/collocation.gark.yaml").tableau
    assert imex_pair(both, stability_fraction(both)) is None


@settings(max_examples=at_most(10, 200))
@given(pairs(), st.sampled_from([(1, 0), (0, 1), (1, 1), (1, 2)]))
def test_additive_radii_by_floating_point(tableau: Tableau, direction: tuple[int, int]) -> None:
    """Below the radius all conditions of both colours hold; just above it one of them fails."""
    found = additive_radius(tableau, [fmpq(q) for q in direction]).radius
    assert found is not None
    s = tableau.space(0).stages
    parts = []
    for l in (0, 1):
        K = np.zeros((s + 1, s + 1))
        K[:s, :s] = [[to_float(x) for x in row] for row in tableau.blocks[0, l]]
        K[s, :s] = [to_float(x) for x in tableau.colours[l].b]
        parts.append(K)
    whole = direction[0] * parts[0] + direction[1] * parts[1]

    def smallest(r: float) -> float:
        inverse = np.linalg.inv(np.eye(s + 1) + r * whole)
        products = [inverse @ K for K in parts]
        return float(min(x.min() for x in (*products, inverse.sum(axis=1))))

    radius = 5.0 if found.value is None else float(found.value.ball(64))
    if radius > 0.01:
        assert smallest(radius * 0.999) >= -1e-9
    if found.value is not None:
        assert min(smallest(radius + t) for t in (1e-3, 1e-2, 0.1, 0.5, 1.0)) < 0


def test_the_region_of_ssp_222() -> None:
    """Alone, the implicit part has 1 + √2 and the explicit one 1; together they are what they are."""
    tableau = loads(SSP_222).tableau
    explicit = ssp_coefficient(tableau, [ONE, ZERO])
    implicit = ssp_coefficient(tableau, [ZERO, ONE])
    assert explicit is not None
    assert explicit.value is not None
    assert explicit.value.exact == 1
    assert implicit is not None
    assert implicit.value is not None
    both = additive_radius(tableau, [ONE, ONE]).radius
    assert both is not None
    assert both.value is not None
    assert both.value <= min(explicit.value, implicit.value)


@given(st.lists(st.integers(-6, 6), min_size=2, max_size=6), st.integers(0, 2))
def test_roots_in_balls_are_counted_as_exactly(roots: list[int], extra: int) -> None:
    """Sturm's chain in balls finds the distinct real roots, or says that it cannot."""
    p = Polynomial([1])
    for root in roots:
        p = p * Polynomial([-root, 1])
    p = p * Polynomial([1, 0, 1]) ** extra
    found = root_count([to_ball(a, 40) for a in p.coefficients])
    assert found in {None, len(real_roots(p))}
    if len(set(roots)) == len(roots) and extra < 2:
        assert found == len(roots)


@pytest.mark.parametrize("k", range(4))
def test_subresultants_tell_the_degree_of_the_gcd(k: int) -> None:
    """With a common factor of degree k the first k of them are zero, and the next one is not."""
    p, q = Polynomial([-7, 2, 0, 1]), Polynomial([3, 1, 5])
    common = Polynomial([1])
    for root in range(k):
        common = common * Polynomial([-root, 1])
    a, b = p * common, q * common
    assert gcd(a, b).degree == k
    assert [bool(subresultant(a, b, j)) for j in range(k + 1)] == [False] * k + [True]
