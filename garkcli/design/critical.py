"""Real points of closed sets as critical points.

On each closed set one is nearest to a given point, and there the gradients of its equations and of
the distance are dependent.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, islice
from math import comb

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time, checked
from garkcli.design.ideal import UNIT, Ideal, rational
from garkcli.design.solutions import Solution, solutions
from garkcli.errors import NotDecided
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parameters
from garkcli.frozen import Frozen, replace
from garkcli.problems.draw import Draw

MOST_MINORS = 200
MOST_GENERATORS = 200
MOST_POINTS = 60
CENTRES = 3
"""Points to which nearest ones are sought; almost all give finitely many."""


def minors(rows: Sequence[Sequence[fmpq_mpoly]], size: int) -> list[fmpq_mpoly]:
    """All minors of a size that contain the first row; NotDecided if they are too many.

    >>> ring = Parameters(["x", "y"])
    >>> x, y = ring.context.gens()
    >>> minors([[x, y], [y, x]], 2)
    [x^2 - y^2]
    """
    first, *others = rows
    width = len(first)
    if comb(len(others), size - 1) * comb(width, size) > MOST_MINORS:
        raise NotDecided
    return [
        _determinant([[row[j] for j in columns] for row in (first, *chosen)])
        for chosen in checked(combinations(others, size - 1))
        for columns in checked(combinations(range(width), size))
    ]


def slopes(polynomials: Sequence[fmpq_mpoly], size: int) -> list[list[fmpq_mpoly]]:
    return [[p.derivative(i) for i in range(size)] for p in polynomials]


def _determinant(rows: Sequence[Sequence[fmpq_mpoly]]) -> fmpq_mpoly:
    check_time()
    if len(rows) == 1:
        return rows[0][0]
    # Laplace expansion along the first row
    total = rows[0][0] * 0
    for j, a in enumerate(rows[0]):
        if a:
            smaller = [[*row[:j], *row[j + 1 :]] for row in rows[1:]]
            minor = a * _determinant(smaller)
            total = total - minor if j % 2 else total + minor
    return total


class SmoothPoints(Frozen):
    """Smooth real zeros of an ideal, at least one on each component of them. ``others`` vanish at
    all other zeros.
    """

    points: tuple[Solution, ...]
    others: tuple[fmpq_mpoly, ...]


def smooth_points(ideal: Ideal) -> SmoothPoints | None:
    """Smooth points of the real zeros of an ideal with as many generators as its codimension.

    No component of it has another dimension (F. S. Macaulay, 1916). At a smooth point some minor m
    of the gradients of the generators is not zero: with an unknown u and u Σ m² = 1 the smooth
    points are a closed set without singularities. None for other ideals, or if critical points are
    not few; raises NotDecided.
    """
    if ideal.dimension <= 0:
        return None
    ring, size = ideal.ring, len(ideal.ring.names)
    generators = _generators(ideal.closure)
    if not generators:
        return None
    gradients = slopes(generators, size)
    nonzero_minors = [m for m in minors(gradients, len(gradients)) if m]
    area = sum((m * m for m in nonzero_minors), start=ring.constant(fmpq(0)))
    larger = Parameters([*ring.names, UNIT])
    *gens, unit = larger.context.gens()
    *equations, last = (p.compose(*gens, ctx=larger.context) for p in (*generators, area))
    equations.append(unit * last - 1)
    smooth = Ideal(larger).with_zeros(equations)
    draw = Draw(0)
    for _ in range(CENTRES):
        distance = [x - fmpq(draw.between(1, 20), 20) for x in gens]
        rows = [[*distance, unit], *slopes(equations, size + 1)]
        critical = smooth.with_zeros(minors(rows, len(rows)))
        if critical.is_everything:
            return SmoothPoints((), tuple(nonzero_minors))
        if critical.dimension == 0 and critical.degree <= MOST_POINTS:
            points = (replace(x, values=_without_unit(x)) for x in solutions(critical) if x.real)
            return SmoothPoints(tuple(points), tuple(nonzero_minors))
    return None


def _generators(closure: Ideal) -> list[fmpq_mpoly] | None:
    """Basis elements that generate an ideal, as many as its codimension; None if no choice does."""
    ring = closure.ring
    basis = [rational(p, ring) for p in closure.basis]
    count = len(ring.names) - closure.dimension
    for chosen in checked(islice(combinations(basis, count), MOST_GENERATORS)):
        if Ideal(ring).with_zeros(chosen).basis == closure.basis:
            return list(chosen)
    return None


def _without_unit(solution: Solution) -> dict[str, Number]:
    return {name: x for name, x in solution.values.items() if name != UNIT}
