"""Real roots and signs are exact: over ℚ and over number fields, against what was multiplied out."""

from __future__ import annotations

from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.cells import between, sign_of, where
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
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
