"""Number fields: the axioms, in every kind of field that a method file can ask for."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.display import to_float
from garkcli.exact.domain import Domain, square_free
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic, Number, coordinates
from garkcli.exact.matrix import (
    SingularMatrixError,
    apply,
    apply_left,
    identity,
    multiply,
    solve,
    transpose,
)
from tests.oracles.draws import fractions

FIELDS = {
    "sqrt(3)": (Domain([parse("sqrt(3)")]), 2),
    "sqrt(2), sqrt(5)": (Domain([parse("sqrt(2) + sqrt(5)")]), 4),
    "cbrt(2)": (Domain([parse("cbrt(2)")]), 3),
    "sqrt(2 + sqrt(2))": (Domain([parse("sqrt(2 + sqrt(2))")]), 4),
}
rationals = fractions(-6, 6, 6).map(lambda x: fmpq(x.numerator, x.denominator))


@st.composite
def elements(draw: st.DrawFn, count: int) -> tuple[Number, ...]:
    """Some elements of one of the fields, rational ones among them."""
    domain, degree = FIELDS[draw(st.sampled_from(sorted(FIELDS)))]
    assert domain.field is not None
    width = st.sampled_from([1, degree])
    return tuple(
        domain.field.from_coordinates(draw(st.lists(rationals, min_size=n, max_size=n)))
        for n in (draw(width) for _ in range(count))
    )


@pytest.mark.parametrize("name", FIELDS)
def test_degrees(name: str) -> None:
    """The fields have the degrees that they should, no radical counted twice."""
    domain, degree = FIELDS[name]
    assert domain.degree == degree
    assert domain.field is not None
    assert len(domain.field.monomials) == degree


def test_square_roots_of_one_class_share_a_field() -> None:
    """√3, √12, √(1/3) and √(4/3) all live in ℚ(√3); with √2 the degree is 4."""
    assert (
        Domain(
            [parse(x) for x in ("sqrt(3)", "sqrt(12)", "sqrt(1/3)", "sqrt(4/3)", "sqrt(9)")]
        ).degree
        == 2
    )
    assert Domain([parse(x) for x in ("sqrt(3)", "sqrt(12)", "sqrt(2)", "sqrt(6)")]).degree == 4
    assert Domain([parse(x) for x in ("sqrt(3 + 2*sqrt(2))", "sqrt(2)")]).degree == 2
    assert Domain([parse("sqrt(49/121)")]).degree == 1


@given(elements(3))
def test_ring_axioms(numbers: tuple[Number, ...]) -> None:
    """Sums and products are associative, commutative and distributive, with 0, 1 and opposites."""
    x, y, z = numbers
    assert (x + y) + z == x + (y + z)
    assert (x * y) * z == x * (y * z)
    assert x + y == y + x
    assert x * y == y * x
    assert x * (y + z) == x * y + x * z
    assert x - y == x + (-y) == -(y - x)
    assert x + 0 == 0 + x == x * 1 == 1 * x == x
    assert x - x == fmpq(0)
    assert not (x - x)
    assert 1 - x == -(x - 1)


@given(elements(2))
def test_inverses(numbers: tuple[Number, ...]) -> None:
    """Everything but 0 has an inverse; quotients undo products; zero is rational and false."""
    x, y = numbers
    if x:
        assert x * (1 / x) == fmpq(1)
        assert (y * x) / x == y
        assert y / x == y * (fmpq(1) / x)
        assert x**-2 == 1 / (x * x)
    else:
        assert x == fmpq(0)
        with pytest.raises(ZeroDivisionError):
            y / x
    if x * y == fmpq(0):
        assert not x or not y


@given(elements(2), st.integers(0, 7))
def test_powers_and_values(numbers: tuple[Number, ...], exponent: int) -> None:
    """A power is a repeated product, and sums and products have the floats that they should."""
    x, y = numbers
    product: Number = fmpq(1)
    for _ in range(exponent):
        product = product * x
    assert x**exponent == product
    a, b = to_float(x), to_float(y)
    assert to_float(x + y) == pytest.approx(a + b, abs=1e-9)
    assert to_float(x * y) == pytest.approx(a * b, abs=1e-9)


@given(elements(2))
def test_equality(numbers: tuple[Number, ...]) -> None:
    """Numbers are equal when their difference is zero, then with equal hashes; irrational is never
    rational.
    """
    x, y = numbers
    assert (x == y) == (not (x - y))
    again = (x + y) - y
    assert again == x
    assert hash(again) == hash(x)
    if isinstance(x, Algebraic):
        assert x != fmpq(1)
        assert x != 0
        assert x != "x"


@given(elements(1))
def test_coordinates_and_radicals(numbers: tuple[Number, ...]) -> None:
    """A number is rebuilt from its coordinates, and from its coordinates in products of
    radicals.
    """
    (x,) = numbers
    if not isinstance(x, Algebraic):
        assert coordinates(x, 3) == [x, fmpq(0), fmpq(0)]
        return
    field = x.field
    assert field.from_coordinates(coordinates(x, field.degree)) == x
    total: Number = fmpq(0)
    for coefficient, word in zip(field.in_radicals(x), field.monomials, strict=True):
        term: Number = coefficient
        for index in word:
            term = term * field.element(field.radicals[index][1])
        total = total + term
    assert total == x


def test_two_fields_do_not_mix() -> None:
    """Numbers of two fields cannot be added, and are not equal; a field that is made once more
    from the same radicals is the same.
    """

    def number(text: str) -> Algebraic:
        made = Domain([parse(text)]).evaluate(parse(text))
        assert isinstance(made, Algebraic)
        return made

    one, other = number("sqrt(3)"), number("sqrt(2)")
    assert one != other
    with pytest.raises(TypeError, match="two different fields"):
        one + other
    with pytest.raises(TypeError):
        one + 0.5  # type: ignore[operator]
    with pytest.raises(TypeError):
        one / "x"  # type: ignore[operator]
    again = number("sqrt(3)")
    assert again.field is not one.field
    assert again == one
    assert hash(again) == hash(one)
    assert again * one == 3


@given(elements(4))
def test_linear_systems(numbers: tuple[Number, ...]) -> None:
    """The inverse of a matrix is one from both sides; singular matrices are told."""
    a, b, c, d = numbers
    A = ((a, b), (c, d))
    if a * d - b * c:
        inverse = solve(A, identity(2))
        assert multiply(A, inverse) == multiply(inverse, A) == identity(2)
        assert apply(inverse, apply(A, (a, d))) == (a, d)
        assert apply_left((a, d), A) == apply(transpose(A), (a, d))
    else:
        with pytest.raises(SingularMatrixError):
            solve(A, identity(2))


@given(st.fractions(), st.fractions())
def test_rationals_are_plain(x: Fraction, y: Fraction) -> None:
    """(x + y√3)(x − y√3) is the rational number x² − 3y², not an element of the field."""
    domain = FIELDS["sqrt(3)"][0]
    root = domain.evaluate(parse("sqrt(3)"))
    a, b = fmpq(x.numerator, x.denominator), fmpq(y.numerator, y.denominator)
    norm = (a + b * root) * (a - b * root)
    assert isinstance(norm, fmpq)
    assert norm == a * a - 3 * b * b


@given(
    st.fractions(-4, 4, max_denominator=200).filter(bool),
    st.fractions(1, 10**6, max_denominator=1500),
)
def test_square_classes(number: Fraction, factor: Fraction) -> None:
    """Numbers whose ratio is a square have the same square-free integer."""
    times = number * factor**2
    small, large = (fmpq(x.numerator, x.denominator) for x in (number, times))
    found = square_free(small)
    assert found == square_free(large)
    assert found.q == 1
    assert int(found.p) * number > 0
    ratio = found / small
    assert ratio.p.isqrt() ** 2 == ratio.p
    assert ratio.q.isqrt() ** 2 == ratio.q


def test_powers_of_what_cancels() -> None:
    """The square of sqrt(2) − sqrt(2) is 0, under a root too: a ball around 0 has powers."""
    expression = parse("sqrt(2 + (sqrt(2) - sqrt(2))**2)")
    root = parse("sqrt(2)")
    domain = Domain([expression, root])
    assert domain.evaluate(expression) == domain.evaluate(root)
