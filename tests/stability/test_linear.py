"""The linear test equation: R by a second way, A-stability of what is known and of what is tight."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import identity, scale, solve, subtract
from garkcli.exact.polynomial import Polynomial
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import loads
from garkcli.stability.linear import (
    StabilityFunction,
    e_polynomial,
    imaginary_set,
    is_a_stable,
    is_i_stable,
    is_l_stable,
    poles_are_right,
    real_set,
    stability_function,
)
from garkcli.stability.sector import largest_sector
from garkcli.stability.summary import stability, stability_of_rounded
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau
from tests.oracles.draws import fractions
from tests.whole import at_most

ENTRIES = fractions(-2, 2, 6)


def family(name: str, stages: int) -> Tableau:
    """A method of one colour."""
    return gark([diagonal_method(name, stages)], {})


@st.composite
def tableaus(draw: st.DrawFn) -> Tableau:
    """Random methods of one colour."""
    s = draw(st.integers(1, 4))
    row = st.lists(ENTRIES, min_size=s, max_size=s)
    A = [draw(row) for _ in range(s)]
    b = draw(row)
    text = [[str(x) for x in line] for line in A]
    return loads(f"methods: [{{A: {text}, b: {[str(x) for x in b]}}}]").tableau


@given(tableaus(), ENTRIES)
def test_the_fraction_is_what_a_step_gives(tableau: Tableau, at: Fraction) -> None:
    """P(z)/Q(z) = 1 + z bᵀ(I − zA)⁻¹𝟙 by solving the stage equations at one z."""
    z = (
        fmpq(str(at).split("/", maxsplit=1)[0])
        if "/" not in str(at)
        else fmpq(*map(int, str(at).split("/")))
    )
    R = stability_function(tableau)
    A = tableau.block(0, 0)
    assert A is not None
    matrix = subtract(identity(len(A)), scale(z, A))
    if not R.denominator(z):
        return
    try:
        stages = solve(matrix, tuple((ONE,) for _ in A))
    except ArithmeticError:
        return
    total: Number = ONE
    for weight, (value,) in zip(tableau.colours[0].b, stages, strict=True):
        total = total + z * weight * value
    assert R.numerator(z) == total * R.denominator(z)


@pytest.mark.parametrize("stages", range(2, 8))
@pytest.mark.parametrize(
    ("name", "l_stable"),
    [
        ("gauss", False),
        ("radau-ia", True),
        ("radau-iia", True),
        ("lobatto-iiia", False),
        ("lobatto-iiib", False),
        ("lobatto-iiic", True),
    ],
)
def test_the_classical_families(name: str, l_stable: bool, stages: int) -> None:
    """All are A-stable (Hairer, Wanner, section IV.5); Radau and Lobatto IIIC are L-stable."""
    R = stability_function(family(name, stages))
    assert is_a_stable(R)
    assert is_l_stable(R) == l_stable


@pytest.mark.parametrize("name", ["explicit-euler", "heun", "kutta", "rk4"])
def test_explicit_methods_are_not(name: str) -> None:
    """A polynomial is unbounded."""
    R = stability_function(gark([diagonal_method(name, None)], {}))
    assert not is_a_stable(R)
    assert R.at_infinity() is None
    assert largest_sector(R).cosine is None  # type: ignore[union-attr]


def tangent(shift: fmpq) -> StabilityFunction:
    """A function with |R(iy)|² = 1 + (4δ + δ²) y²/|Q|² − y²(y² − 1)²/|Q|², δ the shift: it touches 1 at y = 1."""
    return StabilityFunction(Polynomial([fmpq(1), -(2 + shift)]), Polynomial([1, -3, 2, -1]))


def test_tangency_is_decided() -> None:
    """|R(i)| = 1 exactly is stable, and a millionth of a millionth more is not: no grid would tell."""
    assert is_a_stable(tangent(fmpq(0)))
    assert not is_a_stable(tangent(fmpq(1, 10**12)))
    assert is_a_stable(tangent(fmpq(-1, 10**12)))
    touching = imaginary_set(tangent(fmpq(1, 10**12)))
    assert len(touching) == 2  # a gap around y² = 1
    assert touching[0].end is not None
    assert abs(float(touching[0].end.ball(64)) - 1) < 1e-5


@pytest.mark.parametrize("distance", [10**3, 10**12, 10**40])
def test_a_pole_close_to_the_axis(distance: int) -> None:
    """A pole at 1/distance is to the right, one at −1/distance is not, a pair on the axis neither."""
    right, left = Polynomial([1, -distance]), Polynomial([1, distance])
    rest = Polynomial([1, -1]) * Polynomial([2, -2, 1])
    assert poles_are_right(right * rest)
    assert not poles_are_right(left * rest)
    assert not poles_are_right(rest * Polynomial([1, 0, distance]))
    assert not poles_are_right(rest * right * left)


@given(st.lists(st.tuples(st.integers(-4, 4), st.integers(0, 3)), min_size=1, max_size=5))
def test_poles_against_what_was_multiplied_out(pairs: list[tuple[int, int]]) -> None:
    """Q with roots r ± is has all roots to the right exactly when all r > 0."""
    Q = Polynomial([1])
    for r, s in pairs:
        Q = Q * (Polynomial([r * r + s * s, -2 * r, 1]) if s else Polynomial([-r, 1]))
    assert poles_are_right(Q) == all(r > 0 for r, _ in pairs)


@settings(max_examples=at_most(12, 200))
@given(tableaus())
def test_against_a_grid(tableau: Tableau) -> None:
    """Where a grid finds |R| > 1 on the axes, the sets have an end before it; and the other way round."""
    R = stability_function(tableau)
    P = np.array([float(a) for a in reversed(R.numerator.coefficients)])
    Q = np.array([float(a) for a in reversed(R.denominator.coefficients)])
    for found, direction, root in (
        (imaginary_set(R), 1j, np.sqrt),
        (real_set(R), -1.0, np.asarray),
    ):
        for x in np.geomspace(1e-2, 1e3, 60):
            z = direction * root(x)
            size = abs(np.polyval(P, z) / np.polyval(Q, z))
            inside = any(
                (i.start is None or float(i.start.ball(64)) <= x)
                and (i.end is None or x <= float(i.end.ball(64)))
                for i in found
            )
            if abs(size - 1) > 1e-6:
                assert inside == (size < 1), (x, size, found)


def test_real_interval_of_rk4_is_the_known_one() -> None:
    """−2.7852935634…, the real root of x³ + 4x² + 12x + 24."""
    (interval,) = real_set(stability_function(gark([diagonal_method("rk4", None)], {})))
    assert interval.end is not None
    assert [int(a) for a in interval.end.polynomial.coeffs()] == [-24, 12, -4, 1]


def restricted_denominator(gamma: fmpq, stages: int, order: int) -> StabilityFunction:
    """R of an SDIRK method: P/(1 − γz)^s with R = e^z + O(z^(order+1))."""
    Q = Polynomial([fmpq(1), -gamma]) ** stages
    exponential = [fmpq(1)]
    for k in range(1, stages + 1):
        exponential.append(exponential[-1] / k)
    P = (Q * Polynomial(exponential)).coefficients[: order + 1]
    return StabilityFunction(Polynomial(P), Q)


@pytest.mark.parametrize(
    ("gamma", "stages", "order"),
    [
        (fmpq(1, 5), 4, 3),
        (fmpq(1, 2), 5, 5),
        (fmpq(1, 6), 3, 2),
        (fmpq(3, 20), 4, 2),
        (fmpq(1, 7), 3, 2),
    ],
)
def test_sectors_against_rays(gamma: fmpq, stages: int, order: int) -> None:
    """|R| ≤ 1 on rays a little inside of the sector, and not on rays a little outside."""
    R = restricted_denominator(gamma, stages, order)
    sector = largest_sector(R)
    assert sector is not None
    P = np.array([float(a) for a in reversed(R.numerator.coefficients)])
    Q = np.array([float(a) for a in reversed(R.denominator.coefficients)])
    r = np.geomspace(1e-3, 1e4, 20_000)

    def largest(phi: float) -> float:
        z = -r * np.exp(1j * phi)
        return float(np.max(abs(np.polyval(P, z) / np.polyval(Q, z))))

    if sector.cosine is None:
        assert largest(0.0) > 1
        return
    alpha = float(np.arccos(float(sector.cosine.ball(64))))
    assert largest(alpha - 0.01) <= 1 + 1e-12
    if alpha < np.pi / 2:
        assert largest(alpha + 0.01) > 1


def test_in_short() -> None:
    """What is said of a method in one line; L-stability of A-stable ones alone."""
    told = {
        ("rk4", None): "not A-stable",
        ("gauss", 2): "A-stable, not L-stable",
        ("radau-iia", 2): "A-stable, L-stable",
    }
    for (name, stages), words in told.items():
        tableau = gark([diagonal_method(name, stages)], {})
        (found,) = stability(tableau).linear
        assert found.words == words
    rounded = stability_of_rounded(family("gauss", 1), fmpq(1, 10**6))
    assert rounded.linear[0].words == "A-stable, not L-stable"


def test_the_sdirk_methods_of_crouzeix() -> None:
    """γ = (3 + √3)/6 is A-stable, (3 − √3)/6 is not (Hairer, Wanner, section IV.6)."""
    for sign, expected in (("+", True), ("-", False)):
        tableau = loads(
            f"parameters: {{g: 1/2 {sign} sqrt(3)/6}}\n"
            "methods: [{A: [[g, 0], [1 - 2*g, g]], b: [1/2, 1/2]}]"
        ).tableau
        assert is_a_stable(stability_function(tableau)) == expected


def test_the_e_polynomial_of_a_symmetric_method_is_zero() -> None:
    """|R(iy)| = 1 for Gauss methods."""
    assert not e_polynomial(stability_function(family("gauss", 4)))
    assert is_i_stable(stability_function(family("gauss", 4)))
