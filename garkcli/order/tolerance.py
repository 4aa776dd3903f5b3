"""Whether exact numbers, vectors and functionals are within a tolerance of zero; never decided by
floats.

Elements of a stage space are measured by their values at the nodes, functionals and bilinear forms
by their coefficients there: the entries that a printed tableau has.
"""

from __future__ import annotations

from contextlib import suppress
from math import factorial

from flint import arb, arb_mat, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.vandermonde import coordinates_at_nodes, powers_of_nodes

FIRST_BITS = 128
"""Precision at which values at irrational nodes are compared first; doubled until they tell."""
MOST_BITS = 8192
"""Precision at which a value at an irrational node that still cannot be told from the tolerance
counts as equal.
"""
TINY = fmpq(1, 10**6)
"""No larger residual is taken for rounding, at any order."""
UNNATURAL = fmpq(1, 1000)
"""Nor is one larger than this part of the smallest error that quadrature leaves at its order."""


def unnatural(order: int) -> fmpq:
    """The size below which a residual of an order is too small to be that of a good exact method.

    A thousandth of the error of x^(n−1) in the best quadrature of s = ⌊n/2⌋ nodes, which is
    (s!)⁴ / ((2s+1) ((2s)!)²), and 10⁻⁶ at most.
    """
    s = order // 2
    squares = (2 * s + 1) * factorial(2 * s) ** 2
    best = fmpq(factorial(s) ** 4, squares)
    return min(TINY, best * UNNATURAL)


def rounded_up(size: arb) -> fmpq:
    """A bound with two digits: at least ``size``, and less than a tenth more.

    >>> rounded_up(arb("3.14159e-9"))
    1/312500000
    """
    upper = size.abs_upper()
    if upper == 0:
        return fmpq(0)
    decades = upper.log() / arb(10).log()
    exponent = _whole(decades.mid().floor())
    step = fmpq(10) ** (exponent - 1)
    steps = (upper / arb(step)).abs_upper()
    return _whole(steps.ceil()) * step


def _whole(number: arb) -> int:
    found = number.unique_fmpz()
    if found is None:
        raise ArithmeticError(f"{number} is no whole number")
    return int(found)


def within(number: Number, tolerance: fmpq) -> bool:
    """Whether |number| ≤ tolerance.

    >>> within(fmpq(-1, 10), fmpq(1, 10)), within(fmpq(2, 19), fmpq(1, 10))
    (True, False)
    """
    if not tolerance:
        return not number
    if not isinstance(number, Algebraic):
        return bool(abs(number) <= tolerance)
    digits = 17
    while True:  # an irrational number is never equal to a rational one
        ball = to_ball(number, digits)
        with ctx.workprec(4 * digits):
            size = abs(ball)
            if size < tolerance or size > tolerance:
                return bool(size < tolerance)
        digits *= 2


def vector_within(space: StageSpace, vector: Vector, tolerance: fmpq) -> bool:
    """Whether an element of a stage space is within the tolerance of zero at every node."""
    column = tuple((x,) for x in vector)
    return form_within(space, None, column, tolerance, dual=False)


def functional_within(space: StageSpace, functional: Vector, tolerance: fmpq) -> bool:
    """Whether a functional, Σ w_i f(c_i), has all |w_i| ≤ tolerance."""
    column = tuple((x,) for x in functional)
    return form_within(space, None, column, tolerance)


def form_within(
    space: StageSpace, other: StageSpace | None, matrix: Matrix, tolerance: fmpq, dual: bool = True
) -> bool:
    """Whether a bilinear form Σ m_ij f(c_i) g(c_j) has all |m_ij| ≤ tolerance.

    Args:
        space: where f lives, s rows of ``matrix``.
        other: where g lives; None for numbers.
        matrix: the form on the coordinates of both.
        tolerance: not negative.
        dual: whether the rows are coefficients of a functional; otherwise coordinates of elements.
    """
    entries = [x for row in matrix for x in row]
    if not any(entries) or not tolerance:
        return not any(entries)
    if not any(isinstance(x, PolynomialSpace) for x in (space, other)):
        return all(within(x, tolerance) for x in entries)
    bits = FIRST_BITS
    while bits <= MOST_BITS:
        # a Vandermonde matrix may be too ill-conditioned for the precision
        with ctx.workprec(bits), suppress(ZeroDivisionError):
            values = _at_nodes(space, other, matrix, dual)
            sizes = [abs(x) for x in values.entries()]
            if any(size > tolerance for size in sizes):
                return False
            if all(size <= tolerance for size in sizes):
                return True
        bits *= 2
    return True


def form_entries(space: StageSpace, other: StageSpace, matrix: Matrix) -> arb_mat:
    """The coefficients m_ij of a bilinear form at the nodes, in balls."""
    with ctx.workprec(FIRST_BITS):
        return _at_nodes(space, other, matrix, dual=True)


def _to_nodes(space: PolynomialSpace, dual: bool) -> arb_mat:
    """From coordinates of functionals (``dual``), or of elements, to values at the nodes."""
    if dual:
        return coordinates_at_nodes(space).transpose()
    return powers_of_nodes(space)


def _at_nodes(space: StageSpace, other: StageSpace | None, matrix: Matrix, dual: bool) -> arb_mat:
    digits = int(ctx.prec * 0.302)
    rows = [[to_ball(x, digits) for x in row] for row in matrix]
    balls = arb_mat(rows)
    if isinstance(space, PolynomialSpace):
        balls = _to_nodes(space, dual) * balls
    if isinstance(other, PolynomialSpace):
        balls = balls * coordinates_at_nodes(other)
    return balls
