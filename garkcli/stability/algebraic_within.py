"""Algebraic stability of methods with rounded coefficients: for all methods within a tolerance.

Symmetric elimination in balls. A pivot that is positive for all numbers is eliminated; a diagonal
entry that is negative for all decides, and so does a minor of two rows that is. The matrix of many
methods is singular: then nothing is decided, for neighbours are on both sides.
"""

from __future__ import annotations

from itertools import chain, combinations

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.matrix import Vector
from garkcli.tableau.tableau import Edge, Tableau

BITS = 256
"""Precision of the balls; far below any tolerance that files have."""
DIGITS = BITS // 4
"""Digits of exact numbers that become balls."""


def algebraic_within(tableau: Tableau, tolerance: fmpq) -> bool | None:
    """Whether all methods within the tolerance are algebraically stable; None if not decided.

    Args:
        tableau: the method, one coordinate a stage; all blocks are there.
        tolerance: the rounding of coefficients that are not zero.
    """
    with ctx.workprec(BITS):
        weights = [_balls(colour.b, tolerance) for colour in tableau.colours]
        everything = list(chain.from_iterable(weights))
        if any(b < 0 for b in everything):
            return False
        form = form_within(tableau, tolerance)
        found = is_positive(form)
        if found and not all(b > 0 or b.is_zero() for b in everything):
            return None
        return found


def _balls(row: Vector, tolerance: fmpq) -> list[arb]:
    """Coefficients with their rounding; zeros are structure."""
    rounding = arb(0, arb(tolerance).upper())
    found = []
    for x in row:
        ball = to_ball(x, DIGITS)
        if x:
            ball += rounding
        found.append(ball)
    return found


def form_within(tableau: Tableau, tolerance: fmpq) -> list[list[arb]]:
    """M = B A + Aᵀ B − b bᵀ over all colours and stages, of all methods within a tolerance.

    The precision is that of the caller.
    """
    blocks = _blocks(tableau, tolerance)
    weights = [_balls(colour.b, tolerance) for colour in tableau.colours]
    places = []
    for l, row in enumerate(weights):
        places += [(l, i) for i in range(len(row))]
    form = []
    for l, i in places:
        b_i = weights[l][i]
        entries = []
        for m, j in places:
            b_j = weights[m][j]
            outgoing = b_i * blocks[l, m][i][j]
            incoming = b_j * blocks[m, l][j][i]
            entries.append(outgoing + incoming - b_i * b_j)
        form.append(entries)
    return form


def _blocks(tableau: Tableau, tolerance: fmpq) -> dict[Edge, list[list[arb]]]:
    """The blocks of every pair of colours with their rounding."""
    found = {}
    for l in range(tableau.size):
        for m in range(tableau.size):
            block = tableau.block(l, m) or ()
            found[l, m] = [_balls(row, tolerance) for row in block]
    return found


def is_positive(form: list[list[arb]]) -> bool | None:
    """Whether a symmetric matrix is positive semidefinite for all numbers in its balls.

    >>> is_positive([[arb(2), arb(1)], [arb(1), arb(1)]]), is_positive([[arb(0, 1e-9)]])
    (True, None)
    """
    rows = [list(row) for row in form]
    remaining = list(range(len(rows)))
    while remaining:
        if any(rows[i][i] < 0 for i in remaining):
            return False
        pivots = [i for i in remaining if rows[i][i] > 0]
        if not pivots:
            return _without_pivot(rows, remaining)
        pivot = pivots[0]
        pivot_row = rows[pivot]
        remaining.remove(pivot)
        for i in remaining:
            row = rows[i]
            factor = row[pivot] / pivot_row[pivot]
            for j in remaining:
                row[j] = row[j] - factor * pivot_row[j]
    return True


def _without_pivot(rows: list[list[arb]], remaining: list[int]) -> bool | None:
    """The same where no diagonal entry is known to be positive."""
    for i, j in combinations(remaining, 2):
        diagonal = rows[i][i] * rows[j][j]
        others = rows[i][j] * rows[j][i]
        if diagonal - others < 0:
            return False
    for i in remaining:
        if not all(rows[i][j].is_zero() for j in remaining):
            return None
    return True
