"""Where a rational function on a set of solutions has its critical points.

On the zeros of f_1, …, f_m of codimension c these are the points where the gradients of the
function and of the f_i have rank c at most: where all minors of size c + 1 are zero. Points at
which the set is not smooth are among them. Of components of a larger codimension not all are.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from math import comb

from flint import fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.minimise.parts import Part
from garkcli.errors import NotDecided

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
