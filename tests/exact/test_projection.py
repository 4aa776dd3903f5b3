"""Cells of the line and of the plane, against evaluation at points and sympy."""

from __future__ import annotations

from itertools import pairwise

import pytest
import sympy
from flint import fmpq, fmpq_mpoly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli.exact.cells import (
    Interval,
    between,
    contains,
    ends_of,
    first_end,
    has,
    is_half_line,
    roots_of,
    where,
    where_not_negative,
)
from garkcli.exact.parametric import factors
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import (
    PLANE,
    at_y,
    coefficient_of,
    coefficients,
    discriminant,
    is_nowhere_negative,
    of_root,
    on_line,
    projected,
    resultant,
)
from garkcli.exact.roots import RealRoot, real_roots
from tests.whole import at_most

Y, T = PLANE.gens()
SMALL = st.integers(-2, 2)
TERMS = st.dictionaries(st.tuples(st.integers(0, 2), st.integers(0, 2)), SMALL, max_size=4)
ENDS = [
    *(RealRoot.rational(fmpq(k, 2)) for k in range(-3, 4)),
    *(root for root, _ in real_roots(Polynomial([-2, 0, 1]))),
]
MARKS = sorted(ENDS)
PLACES = [*MARKS, *(RealRoot.rational(between(a, b)) for a, b in pairwise([None, *MARKS, None]))]


@given(st.sampled_from([None, *ENDS]), st.sampled_from([None, *ENDS]), st.booleans(), st.booleans())
def test_numbers_in_an_interval(
    start: RealRoot | None, end: RealRoot | None, has_start: bool, has_end: bool
) -> None:
    """Those between its ends, and the ends that belong to it; [a, b] with a and b."""
    if start is not None and end is not None:
        assume(start <= end)
        if start == end:
            has_start = has_end = True
    has_start, has_end = has_start and start is not None, has_end and end is not None
    interval = Interval(start, end, has_start, has_end)
    inside = [
        x
        for x in PLACES
        if (start is None or start < x or (has_start and start == x))
        and (end is None or x < end or (has_end and end == x))
    ]
    assert [x for x in PLACES if has([interval], x)] == inside
    for left in PLACES:
        for right in PLACES:
            if left <= right:
                assert contains(interval, left, right) == (left in inside and right in inside)
    assert not has([], PLACES[0])
    assert interval.is_point == (start is not None and start == end)
    known = {x for x in (start, end) if x is not None}
    assert {x for p in ends_of([interval]) for x, _ in real_roots(p)} >= known
    assert is_half_line([interval]) == (has_start and start is not None and end is None)


@given(
    st.lists(st.sampled_from(ENDS), min_size=1, max_size=4),
    st.sampled_from([None, fmpq(-1), fmpq(0), fmpq(1, 3)]),
    st.sampled_from([lambda s: s >= 0, lambda s: s > 0, lambda s: s == 0, lambda s: s != 0]),
)
def test_sets_are_those_of_their_points(roots, start, holds) -> None:  # type: ignore[no-untyped-def]
    """A condition on the sign of a product of factors, from some number on."""
    p = Polynomial([1])
    for root in roots:
        p = p * Polynomial.from_flint(root.polynomial)

    def is_met(x: RealRoot) -> bool:
        sign = 1
        for root in roots:
            for zero, _ in real_roots(Polynomial.from_flint(root.polynomial)):
                sign *= (x > zero) - (x < zero)
            if root.polynomial.coeffs()[-1] < 0:
                sign = -sign
        return bool(holds(sign))

    def at(x: object) -> bool:
        return is_met(x if isinstance(x, RealRoot) else RealRoot.rational(x))  # type: ignore[arg-type]

    found = where(at, [p, Polynomial([])], start)
    for x in PLACES:
        is_behind = start is None or x >= RealRoot.rational(start)
        assert has(found, x) == (is_behind and is_met(x))
    for a, b in pairwise(found):  # apart, and in order
        assert a.end is not None
        assert b.start is not None
        assert a.end < b.start or (a.end == b.start and not (a.has_end and b.has_start))
    if start == 0 and found:
        end = first_end(found)
        begins = found[0].start == RealRoot.rational(fmpq(0))
        assert end == (found[0].end if begins else RealRoot.rational(fmpq(0)))


def curve(terms: dict[tuple[int, int], int]) -> fmpq_mpoly:
    """A polynomial in y and t."""
    return PLANE.from_dict({e: fmpq(a) for e, a in terms.items()})


@given(TERMS, TERMS, st.sampled_from([[], [fmpq(0)], [fmpq(-1), fmpq(1, 2)]]))
@settings(max_examples=at_most(40, 400))
def test_between_critical_lines_nothing_changes(
    a: dict[tuple[int, int], int], b: dict[tuple[int, int], int], ends: list[fmpq]
) -> None:
    """Which curve meets a line next, from below: on two lines between neighbouring critical ones;
    the ends of the interval of y are among them.
    """
    curves = factors([curve(a), curve(b)])
    assume(curves and all(at_y(p, end) for p in curves for end in ends))
    critical = roots_of(projected(curves, ends))

    def order_on(t: fmpq) -> list[object]:
        lines = [on_line(p, t) for p in curves]
        marks: list[tuple[RealRoot, object]] = [(RealRoot.rational(y), "end") for y in ends]
        for k, line in enumerate(lines):
            assert line  # no line is part of a curve
            marks += [(root, (k, power)) for root, power in real_roots(line)]
        marks.sort(key=lambda mark: mark[0])
        assert all(x < y for (x, _), (y, _) in pairwise(marks))
        return [mark for _, mark in marks]

    for left, right in pairwise([None, *critical, None]):
        first = between(left, right)
        second = between(RealRoot.rational(first), right)
        assert order_on(first) == order_on(second)


@given(TERMS, TERMS)
@settings(max_examples=at_most(15, 150))
def test_elimination_is_that_of_sympy(
    a: dict[tuple[int, int], int], b: dict[tuple[int, int], int]
) -> None:
    """Resultants, discriminants and coefficients, in either variable."""
    y, t = sympy.symbols("y t")
    p, q = curve(a), curve(b)
    assume(p.degrees()[0] > 0 and q.degrees()[0] > 0)

    def read(x: object) -> sympy.Expr:
        return sympy.sympify(str(x).replace("^", "**"), locals={"y": y, "t": t})

    def is_same(x: object, expression: sympy.Expr) -> bool:
        return bool(sympy.expand(read(x) - expression) == 0)

    assert is_same(resultant(p, q), sympy.resultant(read(p), read(q), y))
    if p.degrees()[0] > 1:
        assert is_same(discriminant(p), sympy.discriminant(read(p), y))
    if p.degrees()[1] > 0 and q.degrees()[1] > 0:
        assert is_same(resultant(p, q, "t"), sympy.resultant(read(p), read(q), t))
    for k in range(3):
        assert is_same(coefficient_of(p, k), read(p).expand().coeff(y, k))
        assert is_same(coefficient_of(p, k, 1), read(p).expand().coeff(t, k))
    number = fmpq(3, 5)
    for k, row in enumerate(coefficients(p)):
        assert row(number) == at_y(coefficient_of(p, k), fmpq(0))(number)
    assert at_y(p, fmpq(2, 3))(number) == on_line(p, number)(fmpq(2, 3))


def points(*numbers: RealRoot) -> list[Interval]:
    """A set of numbers."""
    return [Interval(x, x, has_start=True, has_end=True) for x in numbers]


SQRT2 = real_roots(Polynomial([-2, 0, 1]))[1][0]
SEVENTH = real_roots(Polynomial([-5, 2, 0, 0, 0, 0, 0, 1]))[0][0]
ONE, TWO = (RealRoot.rational(fmpq(k)) for k in (1, 2))
CIRCLE = Y**2 + T**2 - 2


@pytest.mark.parametrize(
    ("p", "within", "expected"),
    [
        (CIRCLE, None, False),
        (CIRCLE + 2, None, True),
        (CIRCLE, points(SQRT2), True),
        (CIRCLE, points(ONE), False),
        (CIRCLE, points(SQRT2, TWO), True),
        (CIRCLE, points(TWO, ONE), False),
        (CIRCLE, points(SEVENTH), None),
        (CIRCLE, [*points(SEVENTH), Interval(ONE, TWO)], None),
        (CIRCLE, [Interval(SQRT2, None, has_start=True)], True),
        (CIRCLE, [Interval(ONE, None)], False),
        (CIRCLE, [*points(SQRT2), Interval(TWO, None)], True),
        (CIRCLE, [*points(ONE), Interval(TWO, None)], False),
        (CIRCLE, [Interval(None, RealRoot.rational(fmpq(-3, 2))), Interval(TWO, None)], True),
        (CIRCLE, [], True),
        (Y * T, points(RealRoot.rational(fmpq(0))), True),
        (T - 1 + Y**2, [Interval(ONE, TWO)], True),
        (-((Y - T) ** 2), points(ONE), False),
    ],
)
def test_signs_over_sets_of_lines(
    p: fmpq_mpoly, within: list[Interval] | None, expected: bool | None
) -> None:
    """On isolated lines and between them; not decided on a line at a number of degree 7."""
    assert is_nowhere_negative(p, within) is expected


def test_a_root_as_a_curve() -> None:
    """t² − 2 has the line t = √2."""
    assert of_root(SQRT2) == T**2 - 2
    assert where_not_negative([Polynomial([1]), Polynomial([-2, 0, 1])])[1].start == SQRT2
