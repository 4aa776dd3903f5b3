"""Real roots and signs are exact: over ℚ and over number fields, against what was multiplied out."""

from __future__ import annotations

from itertools import combinations

import pytest
from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.cells import between, sign_of, where
from garkcli.exact.domain import Domain
from garkcli.exact.enclosing import isolated
from garkcli.exact.expression import parse
from garkcli.exact.field import Number, modulo
from garkcli.exact.polynomial import Polynomial, gcd, interpolated, subresultant
from garkcli.exact.roots import RealRoot, multiplicity_at, real_roots, sign, sign_at
from tests.oracles.draws import fractions

SMALL = fractions(-5, 5, 12).map(lambda x: fmpq(x.numerator, x.denominator))


def number(text: str) -> Number:
    """An exact number from its text."""
    expression = parse(text)
    return Domain([expression]).evaluate(expression)


def product(roots: list[Number]) -> Polynomial:
    """The monic polynomial with given roots."""
    result = Polynomial([1])
    for root in roots:
        result = result * Polynomial([-root, fmpq(1)])
    return result


@given(st.lists(SMALL, min_size=1, max_size=6))
def test_roots_that_were_multiplied_out_are_found(roots: list[fmpq]) -> None:
    """The roots with their multiplicities, in ascending order, and nothing else."""
    p = product([*roots]) * Polynomial([1, 0, 1])
    found = [(root.exact, power) for root, power in real_roots(p)]
    assert found == sorted((x, roots.count(x)) for x in set(roots))


@given(st.lists(SMALL, min_size=1, max_size=3), st.lists(SMALL, min_size=1, max_size=3))
def test_over_a_number_field_too(rational: list[fmpq], shifts: list[fmpq]) -> None:
    """Roots a + √2 are found, their conjugates a − √2 are told apart from them."""
    root_of_two = number("sqrt(2)")
    roots: list[Number] = [*rational, *(root_of_two + shift for shift in shifts)]
    found = real_roots(product(roots))
    assert sum(power for _, power in found) == len(roots)
    for root, power in found:
        close = [x for x in roots if abs(sign(x - between(root, None))) and _is(root, x)]
        assert len(close) == power


def _is(root: RealRoot, value: Number) -> bool:
    """Whether a root is a given number: p(x) = x − value vanishes there."""
    return multiplicity_at(Polynomial([-value, fmpq(1)]), root) == 1


def test_signs_at_algebraic_numbers_are_exact() -> None:
    """x² − 2 is zero at √2, and x² − 2 − 10⁻⁴⁰ is not."""
    (_, _), (root, _) = real_roots(Polynomial([-2, 0, 1]))
    assert sign_at(Polynomial([-2, 0, 1]), root) == 0
    assert sign_at(Polynomial([fmpq(-2) - fmpq(1, 10**40), fmpq(0), fmpq(1)]), root) == -1
    assert sign_at(Polynomial([fmpq(-2) + fmpq(1, 10**40), fmpq(0), fmpq(1)]), root) == 1


@given(st.lists(SMALL, max_size=4), st.lists(SMALL, max_size=4), st.lists(SMALL, max_size=3))
def test_common_roots_are_the_gcd(a: list[fmpq], b: list[fmpq], common: list[fmpq]) -> None:
    """gcd(p g, q g) = g for coprime p, q; the resultant vanishes where there is a common root."""
    a = [x for x in a if x not in b]
    p, q = product([*a, *common]), product([*b, *common])
    assert gcd(p, q) == product([*common])
    assert bool(subresultant(p, q, 0)) == (not common)


@given(st.lists(SMALL, min_size=1, max_size=6))
def test_interpolation_gives_the_polynomial_back(coefficients: list[fmpq]) -> None:
    """Through n points there is one polynomial of degree < n."""
    p = Polynomial(coefficients)
    points = [fmpq(k) for k in range(len(coefficients))]
    assert interpolated(points, [p(x) for x in points]) == p


@given(st.lists(SMALL, min_size=1, max_size=5), st.lists(SMALL, min_size=1, max_size=20))
def test_cells_decide_as_evaluation_does(roots: list[fmpq], samples: list[fmpq]) -> None:
    """A number lies in the set p ≥ 0 exactly when p is not negative there."""
    p = product([*roots])
    found = where(lambda x: sign_of(p, x) >= 0, [p])
    for x in samples:
        inside = False
        for interval in found:
            above = interval.start is None or interval.start <= RealRoot.rational(x)
            below = interval.end is None or RealRoot.rational(x) <= interval.end
            inside = inside or (above and below)
        assert inside == (p(x) >= 0)


@given(SMALL, SMALL)
def test_a_number_between_two_others(a: fmpq, b: fmpq) -> None:
    """Strictly between, and with the smallest denominator."""
    if a == b:
        return
    low, high = min(a, b), max(a, b)
    found = between(RealRoot.rational(low), RealRoot.rational(high))
    assert low < found < high
    for q in range(1, int(found.q)):
        assert (low * q).floor() + 1 >= (high * q)


def test_the_simplest_number_between_all_small_fractions() -> None:
    """For each pair of fractions the one between has the least denominator, by trying them all."""
    ends = sorted({fmpq(p, q) for q in range(1, 6) for p in range(-q, 2 * q + 1)})
    roots = [RealRoot.rational(x) for x in ends]
    for i, j in combinations(range(len(ends)), 2):
        found = between(roots[i], roots[j])
        assert ends[i] < found < ends[j]
        for q in range(1, int(found.q)):
            assert not any(ends[i] < fmpq(p, q) < ends[j] for p in range(-q, 2 * q + 1))


def test_enclosures_hold_the_root() -> None:
    """A ball of the golden ratio of 200 bits."""
    golden = real_roots(Polynomial([-1, -1, 1]))[1][0]
    ball = golden.ball(200)
    assert (ball * ball - ball - 1).contains(0)
    assert ball.rel_accuracy_bits() > 150
    assert isinstance(ball, arb)


def test_a_number_between_two_roots_that_are_very_close() -> None:
    """The square roots of 2 and of 2 + 10⁻⁴⁰, whose ends agree in more digits than floats have."""
    close = 1 / fmpq(10) ** 40
    left = real_roots(Polynomial([-2, 0, 1]))[1][0]
    right = real_roots(Polynomial([-2 - close, 0, 1]))[1][0]
    found = between(left, right)
    assert 2 < found * found < 2 + close


@pytest.mark.parametrize("gap", [-4, 4])
def test_roots_that_are_very_close_are_told_apart(gap: int) -> None:
    """Two roots near 10³⁰⁰ and 4 from one another, and two that are as near and not real: seeking
    all complex roots would take minutes.
    """
    middle, x = fmpq(10**300), fmpq(10**300 + 1)
    p = Polynomial([middle * middle + gap, -2 * middle, 1])
    found = [root for root, _ in real_roots(p * Polynomial([x, -1]))]
    assert len(found) == (3 if gap < 0 else 1)
    assert [sign_at(Polynomial([x, -1]), root) for root in found] == (
        [1, 0, -1] if gap < 0 else [0]
    )


def test_roots_in_balls_are_those_that_python_flint_finds() -> None:
    """Of Legendre polynomials and others, to the digits that were asked for."""
    cases = [fmpz_poly([1, -7, 0, 3, 5, 1]), fmpz_poly([-3, 0, 0, 0, 1])]
    cases += [fmpq_poly.legendre_p(n).numer() for n in (2, 9, 20)]
    for p in cases:
        for factor, _ in p.factor()[1]:
            with ctx.workprec(128):
                roots = [x.real for x, _ in factor.complex_roots() if x.imag == 0]
            found = isolated(tuple(int(a) for a in factor.coeffs()), 128)
            assert len(found) == len(roots)
            for mine, theirs in zip(found, sorted(roots, key=lambda x: x.mid()), strict=True):
                assert mine.overlaps(theirs)
                assert mine.rel_accuracy_bits() >= 120


def test_coprime_over_a_number_field_and_not() -> None:
    """A prime proves polynomials coprime, and never those that have a divisor."""
    roots = [parse("sqrt(2)"), parse("cbrt(5)")]
    a, b = map(Domain(roots).evaluate, roots)
    p, q, r = Polynomial([a, b, 1]), Polynomial([b, a + b, a]), Polynomial([a * b, 1])
    assert p.field is not None
    assert p.field.place is not None
    prime, root = p.field.place
    assert int(modulo(p.field.modulus, prime)(root)) == 0
    assert gcd(p, q) == Polynomial([1])
    assert gcd(p * r, q * r) == r
    assert gcd(p, p * r) == p
    # modulo the prime this divisor is the number 1, and the rest is coprime
    vanishing = Polynomial([1, prime])
    one, other = vanishing * Polynomial([a, 1]), vanishing * Polynomial([a + 1, 1])
    assert gcd(one, other) == vanishing.monic()


@given(
    st.lists(SMALL, min_size=2, max_size=6).filter(lambda x: bool(x[-1])),
    st.lists(SMALL, min_size=2, max_size=6).filter(lambda x: bool(x[-1])),
)
def test_subresultants_are_minors_of_sylvester(a: list[fmpq], b: list[fmpq]) -> None:
    """Determinants of rows of coefficients, with their signs."""
    a, b = sorted((a, b), key=len, reverse=True)
    m, n = len(a) - 1, len(b) - 1
    for k in range(n):
        size = m + n - 2 * k
        rows = [[*[0] * i, *a[::-1], *[0] * size][:size] for i in range(n - k)]
        rows += [[*[0] * i, *b[::-1], *[0] * size][:size] for i in range(m - k)]
        assert subresultant(Polynomial(a), Polynomial(b), k) == fmpq_mat(rows).det()
