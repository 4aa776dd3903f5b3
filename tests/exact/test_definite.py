"""Polynomials that keep their sign, against values at many points."""

from __future__ import annotations

from itertools import product

import pytest
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.cells import Interval
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import Along, kept_sign
from garkcli.exact.roots import RealRoot, is_nonnegative, square_root
from tests.whole import at_most

CONTEXT = fmpq_mpoly_ctx.get(["x", "y", "z"], Ordering.lex)
X, Y, Z = CONTEXT.gens()
MOTZKIN = X**4 * Y**2 + X**2 * Y**4 - 3 * X**2 * Y**2 + 1


@pytest.mark.parametrize(
    ("p", "expected"),
    [
        (X**2 + Y**2, 1),
        (X**2 + Y**2 + Z**2, 1),
        (-(X**2) - Y**4 - 1, -1),
        (X**2 + X * Y + Y**2, 1),
        (X**2 + 3 * X * Y + Y**2, None),
        ((X**2 - Y) ** 2 + (Y * Z - 1) ** 2, 1),
        (X**2 - 2 * X * Y + Y**2 + (Z - 1) ** 4, 1),
        (X**6 + 3 * X**3 * Y**3 + Y**6, None),
        (X**2 + X * Y + Y**2 + Z**2, 1),
        (-(X**2) - X * Y - Y**2 - Z**2, -1),
        (X**2 + 3 * X * Y + Y**2 + Z**2, None),
        (X**4 + X**2 * Y + Y**2 + Z**2 + 1, 1),
        (Z**4 - 2 * Z**2 * X + (X - Y) ** 2 + X**2, 1),
        (MOTZKIN, 1),
        (MOTZKIN - fmpq(1, 1000), None),
        (X**2 + Y**2 - Z, None),
        ((X**2 + 1) * (Y**2 + Z**2), 1),
        ((X**2 + 1) * (Y - Z), None),
        ((X - Y) ** 2 * (X**2 + Z**2), 1),
        (X**2 - 2, None),
        (CONTEXT.constant(fmpq(-3)), -1),
        (X * 0, 1),
    ],
)
def test_signs_that_are_kept(p: fmpq_mpoly, expected: int | None) -> None:
    """Sums of squares, quadratic forms, the polynomial of T. S. Motzkin (1967), which is no sum of
    squares and has zeros, and products.
    """
    assert kept_sign(p) == expected


def at_root(square: int) -> Interval:
    root = square_root(RealRoot.rational(fmpq(square)))
    return Interval(root, root, has_start=True, has_end=True)


def to_end(end: fmpq) -> Interval:
    return Interval(RealRoot.rational(fmpq(0)), RealRoot.rational(end), True, True)


@pytest.mark.parametrize(
    ("p", "values", "expected"),
    [
        (X**2 + 2 * X * Y * Z + 2 * Y**2, at_root(2), 1),
        (X**2 + 2 * X * Y * Z + 2 * Y**2, at_root(3), None),
        (X**4 - Z * X**2 * Y**2 + Y**4, at_root(3), 1),
        (X**4 - Z * X**2 * Y**2 + Y**4, at_root(4), 1),
        (X**4 - Z * X**2 * Y**2 + Y**4, at_root(5), None),
        (-(X**4) + Z * X**2 * Y**2 - Y**4, at_root(2), -1),
        ((X**2 * Y - Z) ** 2 + (X * Y**2 - Z) ** 2 + Z - fmpq(7, 5), at_root(2), 1),
        ((X**2 * Y - Z) ** 2 + (X * Y**2 - Z) ** 2 + Z - fmpq(3, 2), at_root(2), None),
        ((Z**2 - 2) * X + X**2 + Y**2, at_root(2), 1),
        (Z * X**2 - Y * Z**3 + Y**2 + 2, at_root(2), 1),
        # (x² − z y)² ((x − 5)² + y² − z), irreducible over ℚ without z²
        (
            (X**4 - 2 * Z * X**2 * Y + 2 * Y**2) * ((X - 5) ** 2 + Y**2 - Z)
            - 2 * X**2 * Y * (Z**2 - 2),
            at_root(2),
            None,
        ),
        (Z**2 - 2, at_root(2), 1),
        (Z - 1, at_root(2), 1),
        (Z * X**2 - Z**2 + 2, to_end(fmpq(1)), 1),
        (Z * X**2 - Z**2 + 2, to_end(fmpq(2)), None),
        (X**2 + (Y - Z) ** 2 - Z**2 + 1, to_end(fmpq(1)), 1),
        (X**2 + (Y - Z) ** 2 - Z**2 + 1, to_end(fmpq(3, 2)), None),
        (X - Z, to_end(fmpq(1)), None),
    ],
)
def test_signs_along_values(p: fmpq_mpoly, values: Interval, expected: int | None) -> None:
    """Of polynomials in which z is an irrational number, or in an interval."""
    assert kept_sign(p, Along(2, values)) == expected


COEFFICIENTS = st.lists(st.integers(-3, 3), min_size=9, max_size=9)
GRID = [fmpq(a, 4) for a in range(-12, 13)]


@settings(max_examples=at_most(20, 400))
@given(COEFFICIENTS)
def test_two_variables_are_always_decided(numbers: list[int]) -> None:
    """A polynomial of degree 2 in each of two has both signs where no sign is said, and never the
    other one where one is.
    """
    terms = {(i, j, 0): numbers[3 * i + j] for i, j in product(range(3), repeat=2)}
    p = CONTEXT.from_dict({e: fmpq(a) for e, a in terms.items() if a})
    found = kept_sign(p)
    values = [p(x, y, fmpq(0)) for x, y in product(GRID, repeat=2)]
    if found is not None:
        assert all(value * found >= 0 for value in values)
    else:
        far = [fmpq(k) for k in (-10000, -100, 100, 10000)]
        values += [p(x, y, fmpq(0)) for x, y in product((*GRID, *far), repeat=2)]
        # a window that the grid misses is narrow
        assert min(values) < 0 < max(values) or min(map(abs, values)) < fmpq(1, 2)


def test_nonnegative_polynomials() -> None:
    """A square is never negative; with two simple roots a polynomial is, between them."""
    assert is_nonnegative(Polynomial([1, -2, 1]))
    assert not is_nonnegative(Polynomial([1, -3, 1]))
    assert is_nonnegative(Polynomial([]))
