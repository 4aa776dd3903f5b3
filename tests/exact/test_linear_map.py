"""A matrix made ready to act on many vectors, against the definition of its action."""

from __future__ import annotations

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.matrix import LinearMap, Matrix, Vector, _has_denominators_apart, _sum, dot
from tests.oracles.draws import fractions

FIELDS = {
    "rational": None,
    "sqrt(3)": Domain([parse("sqrt(3)")]).field,
    "cbrt(2)": Domain([parse("cbrt(2)")]).field,
    "sqrt(2 + sqrt(2))": Domain([parse("sqrt(2 + sqrt(2))")]).field,
}
rationals = fractions(-4, 4, 6).map(lambda x: fmpq(x.numerator, x.denominator))


@st.composite
def maps(draw: st.DrawFn) -> tuple[NumberField | None, Matrix, Matrix, Matrix]:
    """A field, a matrix, some vectors and some functionals; zeros and rational numbers are
    frequent.
    """
    field = FIELDS[draw(st.sampled_from(sorted(FIELDS)))]
    height, width = draw(st.integers(1, 4)), draw(st.integers(1, 4))

    def number() -> Number:
        if field is None or draw(st.booleans()):
            return draw(rationals)
        return field.from_coordinates(
            draw(st.lists(rationals, min_size=field.degree, max_size=field.degree))
        )

    def rows(count: int, length: int) -> Matrix:
        return tuple(tuple(number() for _ in range(length)) for _ in range(count))

    return (
        field,
        rows(height, width),
        rows(draw(st.integers(0, 3)), width),
        rows(draw(st.integers(0, 3)), height),
    )


def naive(u: Vector, v: Vector) -> Number:
    """Σ u_i v_i, term by term."""
    total: Number = fmpq(0)
    for x, y in zip(u, v, strict=True):
        total = total + x * y
    return total


@given(maps())
def test_images_and_pullbacks(case: tuple[NumberField | None, Matrix, Matrix, Matrix]) -> None:
    """Both are what multiplication entry by entry gives, and rational values are plain
    rationals.
    """
    field, A, vectors, functionals = case
    ready = LinearMap(A, field)
    columns = tuple(zip(*A, strict=True))
    images, pullbacks = ready.images(vectors), ready.pullbacks(functionals)
    assert images == [tuple(naive(row, v) for row in A) for v in vectors]
    assert pullbacks == [tuple(naive(w, column) for column in columns) for w in functionals]
    entries = [x for row in images + pullbacks for x in row]
    assert all(x.poly.degree() > 0 for x in entries if isinstance(x, Algebraic))


@given(maps())
def test_dot_is_the_sum_of_the_products(
    case: tuple[NumberField | None, Matrix, Matrix, Matrix],
) -> None:
    """The products of irrational numbers may be added up before they are reduced."""
    _, A, vectors, _ = case
    for row in A:
        for v in vectors:
            assert dot(row, v) == naive(row, v)


def test_numbers_of_two_fields_do_not_meet() -> None:
    """A sum of products over two different fields is refused, also where each product is in one of
    them.
    """
    a, b = (Domain([parse(text)]).evaluate(parse(text)) for text in ("sqrt(2)", "sqrt(3)"))
    with pytest.raises(TypeError, match="two different fields"):
        dot((a, fmpq(1)), (fmpq(1), b))


@given(st.integers(8, 12), st.integers(0, 5))
def test_rows_of_unrelated_denominators(width: int, seed: int) -> None:
    """Rows that are summed as fractions have the same images as by definition."""
    row = tuple(fmpq(k + seed, 2 ** (6000 + k) + 2 * k + 1) for k in range(1, width + 1))
    vector = tuple(fmpq(2 * k - 5, k + 3) for k in range(width))
    linear = LinearMap((row, vector), None)
    assert _has_denominators_apart(row)
    assert not _has_denominators_apart((row[0],) * 60)
    assert linear.images([vector, row]) == [
        (naive(row, vector), naive(vector, vector)),
        (naive(row, row), naive(vector, row)),
    ]
    assert _sum(vector) == naive(vector, (fmpq(1),) * width)
