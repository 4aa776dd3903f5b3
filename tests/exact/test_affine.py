"""Affine forms enclose what is made of the printed numbers: exact fractions at random points."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random
from typing import Any, TypeAlias

import numpy as np
import pytest
from flint import arb, arb_mat, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.affine import Affine, FormMatrix, Forms
from tests.whole import at_most

SEEDS = st.integers(0, 2**32 - 1)
NUMBERS = 4
Point: TypeAlias = "tuple[fmpq, ...]"
Known: TypeAlias = "tuple[Any, list[fmpq]]"
"""A form or an exact number, and its values at some points."""


def points(dice: Random) -> list[Point]:
    """Shares ε: corners, and points inside."""
    corners = [tuple(fmpq(dice.choice((-1, 1))) for _ in range(NUMBERS)) for _ in range(3)]
    inside = [tuple(fmpq(dice.randint(-9, 9), 9) for _ in range(NUMBERS)) for _ in range(2)]
    return corners + inside


def exactly(x: float) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def fraction_of(ball: arb) -> fmpq:
    """A number that is a ball without radius, such as the radius of another."""
    mantissa, exponent = ball.man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


def printed(dice: Random, at: Sequence[Point]) -> Known:
    """A printed number with a radius that is a float; or an exact one."""
    x = fmpq(dice.randint(-30, 30), dice.choice((1, 2, 3, 7)))
    if dice.random() < 0.2:
        return x, [x] * len(at)
    k, t = dice.randrange(NUMBERS), dice.randint(1, 2**53) * 2.0 ** dice.randint(-100, -50)
    return Affine(arb(x), {k: t}), [x + exactly(t) * eps[k] for eps in at]


def grown(dice: Random, at: Sequence[Point], depth: int) -> Known:
    """A random expression."""
    if not depth:
        return printed(dice, at)
    x, of_x = grown(dice, at, depth - 1)
    kind = dice.choice("+-*/^")
    if kind == "^":
        n = dice.randint(-2, 3)
        if n < 0 and not isinstance(x, Affine) and not x:
            return x, of_x
        return x**n, [a**n if n >= 0 or a else fmpq(0) for a in of_x]
    y, of_y = grown(dice, at, dice.randint(0, depth - 1))
    pairs = list(zip(of_x, of_y, strict=True))
    if kind == "+":
        return x + y, [a + b for a, b in pairs]
    if kind == "-":
        return x - y, [a - b for a, b in pairs]
    if kind == "*":
        return x * y, [a * b for a, b in pairs]
    if not isinstance(y, Affine) and not y:
        return x, of_x
    return x / y, [a / b if b else fmpq(0) for a, b in pairs]


def assert_encloses(form: Any, values: Sequence[fmpq], at: Sequence[Point]) -> bool:
    """Each value is centre + slopes · ε up to the remainder; False where there is no bound."""
    if not isinstance(form, Affine):
        assert all(x == form for x in values)
        return True
    if not (math.isfinite(form.remainder) and form.centre.is_finite()):
        assert not form.ball.is_finite()
        return False
    allowed = exactly(form.remainder) + fraction_of(form.centre.rad())
    for value, eps in zip(values, at, strict=True):
        linear = sum((exactly(g) * eps[k] for k, g in form.slopes.items()), fmpq(0))
        assert abs(value - fraction_of(form.centre.mid()) - linear) <= allowed
        assert abs(value - fraction_of(form.ball.mid())) <= fraction_of(form.ball.rad())
    return True


@given(SEEDS)
@settings(max_examples=at_most(50, 400))
def test_expressions_are_enclosed(seed: int) -> None:
    """+, −, *, / and powers of printed numbers, at corners and inside, in exact fractions."""
    dice = Random(seed)
    at = points(dice)
    with ctx.workprec(300):
        form, values = grown(dice, at, dice.randint(1, 6))
        assert_encloses(form, values, at)


def test_most_expressions_have_a_bound() -> None:
    """The test above says something: of 200 expressions few divide by what may be zero."""
    dice, bounded = Random(1), 0
    with ctx.workprec(300):
        for _ in range(200):
            at = points(dice)
            bounded += assert_encloses(*grown(dice, at, 4), at)
    assert bounded > 130


def wide(dice: Random, at: Sequence[Point]) -> Known:
    """A form that depends on much, with a remainder of all sizes; or an exact number."""
    x = fmpq(dice.randint(-9, 9), dice.choice((1, 3)))
    if dice.random() < 0.2:
        return x, [x] * len(at)
    slopes = {k: dice.uniform(-1, 1) * 10.0 ** dice.randint(-12, 0) for k in range(NUMBERS)}
    rest = dice.choice((0.0, 2.0 ** dice.randint(-40, 0)))
    offs = [exactly(rest) * dice.choice((-1, 1)) for _ in at]
    values = [
        x + off + sum((exactly(g) * eps[k] for k, g in slopes.items()), fmpq(0))
        for off, eps in zip(offs, at, strict=True)
    ]
    return Affine(arb(x), slopes, rest), values


def assert_row(forms: Forms, values: Sequence[Sequence[fmpq]], at: Sequence[Point]) -> None:
    """Each form of a row encloses its values."""
    for i, of_form in enumerate(values):
        slopes = dict(enumerate(map(float, forms.slopes[i])))
        form = Affine(forms.centres[i], slopes, float(forms.remainders[i]))
        assert assert_encloses(form, of_form, at)


def summed(terms: Sequence[Sequence[fmpq]]) -> list[fmpq]:
    """Sums, point by point."""
    return [sum(xs, fmpq(0)) for xs in zip(*terms, strict=True)]


def multiplied(one: Sequence[fmpq], other: Sequence[fmpq]) -> list[fmpq]:
    """Products, point by point."""
    return [a * b for a, b in zip(one, other, strict=True)]


@given(SEEDS)
@settings(max_examples=at_most(15, 400))
def test_rows_and_matrices_are_enclosed(seed: int) -> None:
    """Products, shares, differences, scalar products, A v, wᵀ A, rows and columns of a matrix, in
    exact fractions; forms with remainders go through all of it.
    """
    dice = Random(seed)
    at = points(dice)
    s = dice.randint(1, 4)
    v, w = ([wide(dice, at) for _ in range(s)] for _ in range(2))
    block = [[wide(dice, at) for _ in range(s)] for _ in range(s)]
    share = fmpq(dice.randint(-9, 9) or 1, dice.randint(1, 9))
    with ctx.workprec(300):
        V, W = (Forms.of([x for x, _ in row], NUMBERS) for row in (v, w))
        A = FormMatrix([[x for x, _ in row] for row in block], NUMBERS)
        of_v, of_w = [x for _, x in v], [x for _, x in w]
        products = [multiplied(x, y) for x, y in zip(of_v, of_w, strict=True)]
        assert_row(V * W, products, at)
        assert_row(V.dot(W), [summed(products)], at)
        assert_row(V.scaled(share), [[share * x for x in row] for row in of_v], at)
        less = [
            [a - share * b for a, b in zip(*x, strict=True)] for x in zip(of_v, of_w, strict=True)
        ]
        assert_row(V.minus(W, share), less, at)
        of_A = [[x for _, x in row] for row in block]
        turned = [list(column) for column in zip(*of_A, strict=True)]
        for found, rows, u in ((A.times(V), of_A, of_v), (A.before(W), turned, of_w)):
            image = [
                summed([multiplied(x, y) for x, y in zip(row, u, strict=True)]) for row in rows
            ]
            assert_row(found, image, at)
            twice = [
                summed([multiplied(x, y) for x, y in zip(row, image, strict=True)]) for row in rows
            ]
            assert_row(A.times(found) if rows is of_A else A.before(found), twice, at)
        i = dice.randrange(s)
        assert_row(A.row(i), of_A[i], at)
        assert_row(A.column(i), turned[i], at)


ONE, OTHER = (Affine(arb(0), {k: 2.0**-k}) for k in (1, 2))
"""ε₁/2 and ε₂/4: their product is of second order alone."""


def column(*forms: Any) -> Forms:
    return Forms.of(forms, 3)


SQUARES: dict[str, Callable[[], tuple[Any, float]]] = {
    "x y": lambda: (ONE * OTHER, 1 / 8),
    "x x": lambda: (ONE**2, 1 / 4),
    "rows": lambda: (column(ONE) * column(OTHER), 1 / 8),
    "scalar product": lambda: (column(ONE, ONE).dot(column(OTHER, OTHER)), 1 / 4),
    "matrix": lambda: (FormMatrix([[ONE, ONE]], 3).times(column(OTHER, OTHER)), 1 / 4),
    "matrix from the left": lambda: (
        FormMatrix([[ONE], [ONE]], 3).before(column(OTHER, OTHER)),
        1 / 4,
    ),
}


@pytest.mark.parametrize("name", SQUARES)
def test_what_is_of_second_order_is_in_the_remainder(name: str) -> None:
    """Numbers around 0: centre and slopes of the product are 0, the corner reaches the remainder,
    which is no wider than it has to be.
    """
    found, corner = SQUARES[name]()
    if isinstance(found, Forms):
        assert not found.slopes.any()
        (rest,), (centre,) = found.remainders, found.centres
    else:
        assert not any(found.slopes.values())
        rest, centre = found.remainder, found.centre
    assert centre == 0
    assert corner <= rest <= corner * (1 + 1e-12)


def test_remainders_go_on() -> None:
    """Forms that are all remainder: products of remainders with centres, slopes and each other."""
    left, right = Affine(arb(3), {0: 0.5}, 0.25), Affine(arb(-2), {1: 1.0}, 0.125)
    # 3 · 0.125 + 2 · 0.25 + (0.5 + 0.25) (1 + 0.125)
    most = 0.375 + 0.5 + 0.84375
    matrix = FormMatrix([[left]], 2)
    for found in (
        (left * right).remainder,
        (Forms.of([left], 2) * Forms.of([right], 2)).remainders[0],
        Forms.of([left], 2).dot(Forms.of([right], 2)).remainders[0],
        matrix.times(Forms.of([right], 2)).remainders[0],
        matrix.before(Forms.of([right], 2)).remainders[0],
    ):
        assert most <= found <= most * (1 + 1e-12)


def test_what_slopes_lose_is_in_the_remainder() -> None:
    """2⁵³ + 1 is no float; thirds of slopes are none either."""
    large, small = Affine(arb(0), {0: 2.0**53}), Affine(arb(0), {0: 1.0})
    assert (large + small).remainder >= 1
    assert (large - small).remainder >= 0.5
    row, other = Forms.of([large], 1), Forms.of([small], 1)
    assert row.minus(other, fmpq(-1)).remainders[0] >= 1
    third = fmpq(1, 3)
    lost = abs(exactly(1 / 3) - third)
    for found in (
        (small * third).remainder,
        Forms.of([small], 1).scaled(third).remainders[0],
        (small * Affine(arb(third), {})).remainder,
        (Forms.of([small], 1) * Forms.of([third], 1)).remainders[0],
        Forms.of([small], 1).dot(Forms.of([third], 1)).remainders[0],
        FormMatrix([[small]], 1).times(Forms.of([third], 1)).remainders[0],
        FormMatrix([[third]], 1).before(Forms.of([small], 1)).remainders[0],
    ):
        assert exactly(float(found)) >= lost


def test_the_inverse_is_as_wide_as_it_has_to_be() -> None:
    """1/(1 + ε/4): at ε = −1 it is 4/3, of which centre and slope give 5/4."""
    found = Affine(arb(1), {0: 0.25}).inverse()
    assert (found.centre, found.slopes) == (1, {0: -0.25})
    assert fmpq(1, 12) <= exactly(found.remainder) <= fmpq(1, 12) + fmpq(1, 10**12)


@pytest.mark.parametrize("index", [2, 3, 4, 5])
@pytest.mark.parametrize("centre", [fmpq(1), fmpq(7, 3), fmpq(-2)])
def test_roots_are_enclosed(index: int, centre: fmpq) -> None:
    """The power of a root is the number itself, at corners and inside; no even root of a negative
    number is real.
    """
    x = Affine(arb(centre), {0: 0.25, 1: 0.125}, 0.0625)
    found = x.root(index)
    if centre < 0 and index % 2 == 0:
        assert not found.ball.is_finite()
        return
    for eps in ((1, 1, 1), (-1, -1, -1), (1, -1, 1), (fmpq(1, 2), fmpq(-1, 3), 0), (0, 0, 0)):
        value = centre + fmpq(eps[0], 4) + fmpq(eps[1], 8) + fmpq(eps[2], 16)
        linear = found.centre + sum(arb(g) * arb(fmpq(eps[k])) for k, g in found.slopes.items())
        ends = [linear + found.remainder, linear - found.remainder]
        high, low = (end**index - value for end in ends)
        assert high > 0
        assert low < 0
    near = Affine(arb(1), {0: 0.25}).root(2)
    # at ε = −1 it is sqrt(3/4), of which centre and slope give 7/8
    assert 0.875 - 0.75**0.5 <= near.remainder <= 0.0121


@pytest.mark.parametrize("slope", [1.0, 2.0])
def test_roots_of_what_may_be_zero_have_no_bound(slope: float) -> None:
    """The slope of a root has none there."""
    assert not Affine(arb(1), {0: slope}).root(2).ball.is_finite()
    assert not Affine(arb(-1), {0: slope}).root(3).ball.is_finite()


def test_division_near_zero_has_no_bound() -> None:
    """Where the divisor may be zero, or touches it, nothing is said; a row with it may be zero."""
    for centre, slope, rest in ((0, 1.0, 0.0), (1, 1.0, 0.0), (1, 0.5, 0.5), (-1, 2.0, 0.0)):
        found = Affine(arb(centre), {0: slope}, rest).inverse()
        assert not math.isfinite(found.remainder)
        assert not found.ball.is_finite()
        assert not (found * 2 + 1).ball.is_finite()
        assert not (found * found).ball.is_finite()
    assert (1 / Affine(arb(1), {0: 0.99})).ball.is_finite()


def test_equal_numbers_stay_equal() -> None:
    """A − a is 0 up to the rounding of its slopes, which balls do not know; 0 · a is 0 itself."""
    a = Affine(arb(fmpq(4, 3)), {0: 0.1, 1: 0.7})
    gone = a - a
    assert gone.centre.contains(0)
    assert not any(gone.slopes.values())
    assert gone.reach < 1e-14
    assert float((a.ball - a.ball).rad()) > 1
    assert a * 0 == fmpq(0)
    quotient = a / a
    assert quotient.centre.contains(1)
    assert max(abs(g) for g in quotient.slopes.values()) < 1e-14


def test_numbers_that_depend_on_nothing() -> None:
    """K = 0: rows and matrices are balls, as those of a method at one place."""
    v, w = (Forms.of([fmpq(n, 3), fmpq(n)], 0) for n in (1, 2))
    A = FormMatrix([[fmpq(1), fmpq(2)], [fmpq(3), fmpq(4)]], 0)
    assert v.are_numbers
    for found, wanted in (
        (v * w, (fmpq(2, 9), fmpq(2))),
        (v.dot(w), (fmpq(20, 9),)),
        (v.scaled(fmpq(3)), (fmpq(1), fmpq(3))),
        (v.minus(w, fmpq(1, 2)), (fmpq(0), fmpq(0))),
        (A.times(v), (fmpq(7, 3), fmpq(5))),
        (A.before(v), (fmpq(10, 3), fmpq(14, 3))),
        (A.row(1), (fmpq(3), fmpq(4))),
        (A.column(1), (fmpq(2), fmpq(4))),
    ):
        assert not found.remainders.any()
        assert found.slopes.shape == (len(wanted), 0)
        assert all(x.contains(y) for x, y in zip(found.centres, wanted, strict=True))
        assert all(x.rad() < 1e-9 for x in found.centres)


def test_the_same_by_rows_and_by_matrices() -> None:
    """A matrix times a row is the scalar products of its rows with it, in centres and slopes."""
    dice = Random(3)
    rows = [[wide(dice, ())[0] for _ in range(3)] for _ in range(3)]
    v = Forms.of([wide(dice, ())[0] for _ in range(3)], NUMBERS)
    A = FormMatrix(rows, NUMBERS)
    image = A.times(v)
    assert isinstance(A.centres, arb_mat)
    for i in range(3):
        one = A.row(i).dot(v)
        assert one.centres[0].overlaps(image.centres[i])
        assert np.allclose(one.slopes[0], image.slopes[i], rtol=1e-12, atol=1e-15)


RADIUS = fmpq(1, 8)
"""Of the centres below: 1 ± 1/8 and ε, of which all products are."""


def around_one(shift: Any) -> Affine:
    return Affine(shift if isinstance(shift, arb) else arb(shift), {0: 1.0})


WIDE: dict[str, Callable[[Affine], Any]] = {
    "x y": lambda x: x * x,
    "x c": lambda x: x * x.centre,
    "1/x": lambda x: (x * fmpq(1, 4) + 1).inverse(),
    "rows": lambda x: Forms.of([x], 1) * Forms.of([x], 1),
    "scalar product": lambda x: Forms.of([x], 1).dot(Forms.of([x], 1)),
    "matrix": lambda x: FormMatrix([[x]], 1).times(Forms.of([x], 1)),
    "matrix from the left": lambda x: FormMatrix([[x]], 1).before(Forms.of([x], 1)),
}


@pytest.mark.parametrize("name", WIDE)
def test_radii_of_centres_count(name: str) -> None:
    """Whatever number a centre stands for, what is made of it is enclosed at both ends of ε."""
    make = WIDE[name]

    def ends(found: Any) -> arb:
        """Centre, slopes and remainder of what was made."""
        if isinstance(found, Forms):
            slopes = dict(enumerate(found.slopes[0]))
            return Affine(found.centres[0], slopes, found.remainders[0]).ball
        return found.ball

    with ctx.workprec(200):
        all_of_them = ends(make(around_one(arb(1, arb(RADIUS)))))
        for shift in (1 - RADIUS, fmpq(1), 1 + RADIUS):
            for eps in (-1, 1):
                factor = shift if name == "x c" else shift + eps
                value = 1 / ((shift + eps) / 4 + 1) if name == "1/x" else (shift + eps) * factor
                assert all_of_them.contains(value)
