"""Spans of points against the definition, one rank at a time."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.span import Span

Point = list[fmpq]


def rank(rows: list[list[Fraction]]) -> int:
    """The rank, by elimination over Python's fractions."""
    rows = [list(row) for row in rows]
    found = 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((i for i in range(found, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] / rows[found][column]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[found], strict=True)]
        found += 1
    return found


def affine_rank(points: list[Point]) -> int:
    """One more than the dimension of the affine hull; 0 of no points."""
    return rank([[Fraction(1), *(Fraction(int(x.p), int(x.q)) for x in point)] for point in points])


def points(group: list[Point]) -> list[Point]:
    """Vectors (1, point), whose span is the affine one."""
    return [[fmpq(1), *point] for point in group]


@st.composite
def batches(draw: st.DrawFn) -> tuple[int, list[list[Point]]]:
    """A dimension, and points of small coordinates in batches, many of them dependent."""
    dimension = draw(st.integers(1, 4))
    coordinate = st.sampled_from([fmpq(0), fmpq(1), fmpq(-1), fmpq(1, 2), fmpq(3)])
    point = st.lists(coordinate, min_size=dimension, max_size=dimension)
    points = draw(st.lists(point, min_size=2, max_size=8))
    weight = draw(st.sampled_from([fmpq(2), fmpq(1, 3), fmpq(-1)]))
    between = [weight * x + (1 - weight) * y for x, y in zip(points[0], points[1], strict=True)]
    place = draw(st.integers(0, len(points)))
    points = [*points[:place], between, *points[place:]]
    cut = draw(st.integers(0, len(points)))
    return dimension, [points[:cut], points[cut:]]


@given(batches())
def test_members_are_those_that_raise_the_rank(case: tuple[int, list[list[Point]]]) -> None:
    """Exactly those points join that are no affine combination of the ones before."""
    dimension, groups = case
    span, before = Span(dimension + 1), []
    for group in groups:
        joined = []
        for index, point in enumerate(group):
            if affine_rank([*before, point]) > affine_rank(before):
                joined.append(index)
            before.append(point)
        assert span.insert(points(group)) == joined
        assert len(span) == affine_rank(before)
        assert span.is_full == (affine_rank(before) == dimension + 1)


def test_dimension_zero() -> None:
    """A space with a single point is full after one insertion."""
    span = Span(1)
    assert not span.is_full
    assert span.insert(points([[], []])) == [0]
    assert span.is_full
    assert span.insert(points([[]])) == []


def test_affine_is_not_linear() -> None:
    """The point 0 joins an empty span, and 2x joins the span of x, although both are linear
    combinations.
    """
    span = Span(2)
    assert span.insert(points([[fmpq(0)]])) == [0]
    span = Span(3)
    x, twice = [fmpq(1), fmpq(1)], [fmpq(2), fmpq(2)]
    assert span.insert(points([x, twice, [fmpq(3), fmpq(3)]])) == [0, 1]
