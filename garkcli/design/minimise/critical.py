"""Where a rational function on a set of solutions has its critical points.

On the zeros of f_1, …, f_m of codimension c these are the points where the gradients of the
function and of the f_i have rank c at most: where all minors of size c + 1 are zero. Points at
which the set is not smooth are among them. Of components of a larger codimension not all are.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from math import comb
from typing import TYPE_CHECKING

from flint import arb, fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.minimise.parts import Part
from garkcli.design.search.points import Fixings, is_proved, polished
from garkcli.design.search.rational import System, as_float, polynomial_functions
from garkcli.errors import NotDecided
from garkcli.exact.parametric import Parameters

if TYPE_CHECKING:
    pass


MOST_MINORS = 200
"""Equations that are written down at most."""


def critical_equations(
    part: Part, numerator: fmpq_mpoly, denominator: fmpq_mpoly
) -> list[fmpq_mpoly]:
    """Polynomials that are zero at the critical points of N/D on a part.

    Raises:
        NotDecided: there are too many of them.
    """
    size = len(part.ring.names)
    gradient = []
    for i in range(size):
        over = numerator.derivative(i) * denominator
        gradient.append(over - numerator * denominator.derivative(i))
    if part.is_free:
        return gradient
    equations = part.equations
    codimension = size - part.dimension
    minors = comb(len(equations), codimension)
    if minors * comb(size, codimension + 1) > MOST_MINORS:
        raise NotDecided
    zeros = []
    for chosen in combinations(equations, codimension):
        rows = [gradient]
        rows += [[p.derivative(i) for i in range(size)] for p in chosen]
        for columns in combinations(range(size), codimension + 1):
            check_time()
            minor = [[row[j] for j in columns] for row in rows]
            zeros.append(_determinant(minor))
    return zeros


def is_of_one_dimension(part: Part) -> bool:
    """Whether no component of a part is known to be able to have a smaller dimension than another:
    as many equations as the codimension have none (F. S. Macaulay, 1916).
    """
    codimension = len(part.ring.names) - part.dimension
    return part.is_free or len(part.equations) == codimension


def without_factors(p: fmpq_mpoly, denominator: fmpq_mpoly) -> fmpq_mpoly:
    """A polynomial without the factors that it has in common with another one."""
    while True:
        common = p.gcd(denominator)
        if common.is_constant() or not p:
            return p
        p = p // common


def _determinant(rows: Sequence[Sequence[fmpq_mpoly]]) -> fmpq_mpoly:
    """By the first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = rows[0][0] * 0
    for j, a in enumerate(rows[0]):
        if a:
            smaller = [[*row[:j], *row[j + 1 :]] for row in rows[1:]]
            minor = a * _determinant(smaller)
            total = total - minor if j % 2 else total + minor
    return total


BITS = 256
"""Of Newton's method and the test, which then encloses the point to half as many."""
DECIMALS = 20
"""Of the rational point beside it."""
NEAR = fmpq(1, 100)
"""How far from the point that is given it may be."""


def critical_point_near(
    point: Sequence[fmpq],
    gradient: Sequence[fmpq_mpoly],
    nonzero: Sequence[fmpq_mpoly],
    ring: Parameters,
) -> tuple[fmpq, ...] | None:
    """A rational point within 10^−DECIMALS of a common zero of some polynomials; None where none is
    proved to exist near, by Krawczyk's test.

    The coordinates of a part are free, so that the rational point is a method as well, of the same
    order and, but for rounding, the same value.

    Args:
        point: near which it is looked for.
        gradient: the polynomials, as many as unknowns.
        nonzero: polynomials that are not to vanish there.
        ring: of the unknowns.
    """
    system = Fixings(System(polynomial_functions(gradient, ring)))
    zero = polished(system, [as_float(x) for x in point], BITS)
    if zero is None or not is_proved(system, zero, BITS, polynomial_functions(nonzero, ring)):
        return None
    rounded = tuple(_rounded(x) for x in zero[:, 0])
    if any(abs(x - y) > NEAR for x, y in zip(rounded, point, strict=True)):
        return None
    return rounded


def _rounded(x: arb) -> fmpq:
    """The nearest number with so many decimals."""
    mantissa, exponent = x.mid().man_exp()
    exact = fmpq(mantissa) * fmpq(2) ** int(exponent)
    scale = 10**DECIMALS
    return fmpq((exact * scale + fmpq(1, 2)).floor(), scale)
