"""Lines over algebraic numbers: roots and signs there, against number fields and floats."""

from __future__ import annotations

import pytest
from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.exact.fibre import Fibre
from garkcli.exact.parametric import factors
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import PLANE
from garkcli.exact.roots import RealRoot, number_of, real_roots

Y, T = PLANE.gens()
SQRT2 = real_roots(Polynomial([-2, 0, 1]))[1][0]
QUINTIC = real_roots(Polynomial([-1, -1, 0, 0, 0, 1]))[0][0]
SEVENTH = real_roots(Polynomial([-5, 2, 0, 0, 0, 0, 0, 1]))[0][0]
NONE_NEGATIVE = [
    (Y - 1) * (Y - T) + 2,
    (Y - T) ** 2,
    Y**2 - T * Y + fmpq(1, 2),
    (Y**2 - T**2) * (Y - 3),
]


def floats(fibre: Fibre) -> list[float]:
    """The roots."""
    return [float(root.ball(60).mid()) for root in fibre.roots]


@pytest.mark.parametrize("t", [SQRT2, QUINTIC, SEVENTH, RealRoot.rational(fmpq(3, 2))])
def test_roots_of_curves(t: RealRoot) -> None:
    """Those of y² = t + 1, y = t and y = 2 − t, in floats, and as roots of polynomials over ℚ."""
    fibre = Fibre(t, factors([Y**2 - T - 1, Y - T, Y + T - 2]))
    value = float(t)
    expected = sorted(y for y in ((value + 1) ** 0.5, value, 2 - value) if y > 0)
    assert floats(fibre) == pytest.approx(expected, abs=1e-14)
    for root, known in zip(fibre.roots, expected, strict=True):
        assert float(root.exact) == pytest.approx(known)
    gaps = [float(y) for y in fibre.gaps]
    ends = zip(gaps[:-1], floats(fibre), gaps[1:], strict=True)
    assert all(a < y < b for a, y, b in ends)


def test_roots_in_common_are_one() -> None:
    """At t² = 2 the curves y = t and y² = 2 meet: one root of both, known without digits."""
    fibre = Fibre(SQRT2, [Y - T, Y**2 - 2])
    [root] = fibre.roots
    assert root.curves == {0, 1}
    assert root.exact == SQRT2
    near = Fibre(SQRT2, [Y - T, Y**2 - 2 + fmpq(1, 10**40)])
    assert len(near.roots) == 2


@pytest.mark.parametrize("polynomials", [NONE_NEGATIVE[:1], NONE_NEGATIVE[1:3], NONE_NEGATIVE])
@pytest.mark.parametrize("t", [SQRT2, QUINTIC, RealRoot.rational(fmpq(2))])
def test_first_failures(polynomials: list[fmpq_mpoly], t: RealRoot) -> None:
    """Where one of several polynomials becomes negative first: by their roots over ℚ(t_0)."""
    number = number_of(t, 6)
    assert number is not None
    fibre = Fibre(t, factors(polynomials))
    found = fibre.first_failure(polynomials, lambda signs: min(signs) >= 0)
    ends: list[RealRoot] = []
    for p in polynomials:
        powers: dict[int, object] = {}
        for (j, k), a in p.to_dict().items():
            powers[int(j)] = powers.get(int(j), fmpq(0)) + a * _power(number, int(k))  # type: ignore[operator]
        line = Polynomial([powers.get(k, fmpq(0)) for k in range(max(powers) + 1)])  # type: ignore[misc]
        for y, times in real_roots(line):
            if y > RealRoot.rational(fmpq(0)) and times % 2:
                ends.append(y)
                break
    if not ends:
        assert found is None
    else:
        assert found is not None
        assert not isinstance(found, fmpq)
        assert found.exact == min(ends)


def _power(number: object, exponent: int) -> object:
    total: object = fmpq(1)
    for _ in range(exponent):
        total = total * number  # type: ignore[operator]
    return total


def test_what_fails_at_a_point() -> None:
    """A double root ends what has to be positive, and not what must not be negative."""
    double = [(Y - T) ** 2 + (T**2 - 2) ** 2]
    fibre = Fibre(SQRT2, factors(double))
    assert fibre.first_failure(double, lambda signs: min(signs) >= 0) is None
    found = fibre.first_failure(double, lambda signs: min(signs) > 0)
    assert found is not None
    assert not isinstance(found, fmpq)
    assert found.exact == SQRT2
    assert fibre.have_common_zero([Y - T, Y**2 - 2])
    assert not fibre.have_common_zero([Y - T, Y**2 - 3])


def test_what_fails_at_once() -> None:
    """Behind 0 already."""
    fibre = Fibre(QUINTIC, factors([Y - T]))
    assert fibre.first_failure([Y - T], lambda signs: min(signs) >= 0) == fmpq(0)


def test_roots_that_first_balls_do_not_separate() -> None:
    """Those of (y − 1)² = 2⁻²⁰¹, at every line: 1 ± 2⁻¹⁰⁰·⁵."""
    fibre = Fibre(RealRoot.rational(fmpq(3, 2)), [(Y - 1) ** 2 - fmpq(1, 2**201)])
    low, high = fibre.roots
    assert low.high < 1 < high.low
    with ctx.workprec(400):
        for root, sign in ((low, -1), (high, 1)):
            shift = (root.ball(300) - 1) * 2**100
            assert abs(shift - sign * arb("0.5").sqrt()) < arb("1e-20")
