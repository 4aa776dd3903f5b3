"""Points of real zeros that are found as critical points: on each closed set one is nearest to a
given point, and there the gradients of its equations and of the distance are dependent.
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
"""Equations that are written down at most."""
MOST_GENERATORS = 200
"""Most choices of as many basis elements as the codimension."""
MOST_POINTS = 60
"""Critical points, complex ones included."""
CENTRES = 3
"""Points to which nearest ones are sought; all but few give finitely many."""


def minors(rows: Sequence[Sequence[fmpq_mpoly]], size: int) -> list[fmpq_mpoly]:
    """All minors of a size that have the first row, and others of the rest.

    >>> ring = Parameters(["x", "y"])
    >>> x, y = ring.context.gens()
    >>> minors([[x, y], [y, x]], 2)
    [x^2 - y^2]

    Raises:
        NotDecided: there are too many of them.
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
    """The gradients of polynomials, by their first so many unknowns."""
    return [[p.derivative(i) for i in range(size)] for p in polynomials]


def _determinant(rows: Sequence[Sequence[fmpq_mpoly]]) -> fmpq_mpoly:
    """By the first row."""
    check_time()
    if len(rows) == 1:
        return rows[0][0]
    total = rows[0][0] * 0
    for j, a in enumerate(rows[0]):
        if a:
            smaller = [[*row[:j], *row[j + 1 :]] for row in rows[1:]]
            minor = a * _determinant(smaller)
            total = total - minor if j % 2 else total + minor
    return total


class Smooth(Frozen):
    """The smooth points of the real zeros of an ideal.

    Attributes:
        points: one on each component of them at least.
        others: polynomials that are zero at all other zeros.
    """

    points: tuple[Solution, ...]
    others: tuple[fmpq_mpoly, ...]


def smooth_points(ideal: Ideal) -> Smooth | None:
    """Some smooth points of the real zeros of an ideal of c generators, its codimension, so that no
    component has another dimension (F. S. Macaulay, 1916); None of other ideals, or where the
    critical points are not few.

    At a smooth point some minor of the gradients of the generators is not zero. With an unknown u
    and u Σ m² = 1 over these minors m the smooth points are a closed set without singularities.

    Raises:
        NotDecided: the time is not enough.
    """
    if ideal.dimension <= 0:
        return None
    ring, size = ideal.ring, len(ideal.ring.names)
    generators = _generators(ideal.closure)
    if not generators:
        return None
    gradients = slopes(generators, size)
    others = [m for m in minors(gradients, len(gradients)) if m]
    area = sum((m * m for m in others), start=ring.constant(fmpq(0)))
    larger = Parameters([*ring.names, UNIT])
    *gens, unit = larger.context.gens()
    *equations, last = (p.compose(*gens, ctx=larger.context) for p in (*generators, area))
    equations.append(unit * last - 1)
    smooth = Ideal(larger).with_zeros(equations)
    draw = Draw(0)
    for _ in range(CENTRES):
        distance = [x - fmpq(draw.between(1, 20), 20) for x in gens]
        rows = [[*distance, unit], *slopes(equations, size + 1)]
        found = smooth.with_zeros(minors(rows, len(rows)))
        if found.is_everything:
            return Smooth((), tuple(others))
        if found.dimension == 0 and found.degree <= MOST_POINTS:
            points = (replace(x, values=_without_unit(x)) for x in solutions(found) if x.real)
            return Smooth(tuple(points), tuple(others))
    return None


def _generators(closure: Ideal) -> list[fmpq_mpoly] | None:
    """As many members of its basis as its codimension that generate an ideal; None where none do.

    Raises:
        NotDecided: the time is not enough.
    """
    ring = closure.ring
    basis = [rational(p, ring) for p in closure.basis]
    count = len(ring.names) - closure.dimension
    for chosen in checked(islice(combinations(basis, count), MOST_GENERATORS)):
        if Ideal(ring).with_zeros(chosen).basis == closure.basis:
            return list(chosen)
    return None


def _without_unit(solution: Solution) -> dict[str, Number]:
    """The values of the unknowns alone."""
    return {name: x for name, x in solution.values.items() if name != UNIT}
