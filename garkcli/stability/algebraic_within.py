"""Algebraic stability of methods with rounded coefficients: for all methods within a tolerance.

Symmetric elimination in balls. A pivot that is positive for all numbers is eliminated; a diagonal
entry that is negative for all decides, and so does a minor of two rows that is. The matrix of many
methods is singular: then nothing is decided, for neighbours are on both sides.
"""

from __future__ import annotations

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.tableau.tableau import Tableau

BITS = 256


def algebraic_within(tableau: Tableau, tolerance: fmpq) -> bool | None:
    """Whether all methods within the tolerance are algebraically stable; None if not decided.

    Args:
        tableau: the method, one coordinate a stage; all blocks are there.
        tolerance: the rounding of coefficients that are not zero.
    """
    with ctx.workprec(BITS):
        weights = [[_ball(b, tolerance) for b in c.b] for c in tableau.colours]
        everything = [b for row in weights for b in row]
        if any(b < 0 for b in everything):
            return False
        found = is_positive(_form(tableau, weights, tolerance))
        are_positive = all(b > 0 or b.is_zero() for b in everything)
        return None if found and not are_positive else found


def _ball(x: Number, tolerance: fmpq) -> arb:
    """A coefficient with its rounding; zeros are structure."""
    ball = to_ball(x, BITS // 4)
    return ball + arb(0, arb(tolerance).upper()) if x else ball


def _form(
    tableau: Tableau, weights: list[list[arb]], tolerance: fmpq
) -> list[list[arb]]:
    """B A + Aᵀ B − b bᵀ over all colours and stages."""
    places = [(l, i) for l, row in enumerate(weights) for i in range(len(row))]
    blocks = {}
    for l in range(tableau.size):
        for m in range(tableau.size):
            block = tableau.block(l, m) or ()
            blocks[l, m] = [[_ball(x, tolerance) for x in row] for row in block]
    form = []
    for l, i in places:
        row = []
        for m, j in places:
            outgoing = weights[l][i] * blocks[l, m][i][j]
            incoming = weights[m][j] * blocks[m, l][j][i]
            row.append(outgoing + incoming - weights[l][i] * weights[m][j])
        form.append(row)
    return form


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
        pivot = next((i for i in remaining if rows[i][i] > 0), None)
        if pivot is None:
            return _without_pivot(rows, remaining)
        remaining.remove(pivot)
        for i in remaining:
            factor = rows[i][pivot] / rows[pivot][pivot]
            for j in remaining:
                rows[i][j] = rows[i][j] - factor * rows[pivot][j]
    return True


def _without_pivot(rows: list[list[arb]], remaining: list[int]) -> bool | None:
    """The same where no diagonal entry is known to be positive."""
    for i in remaining:
        for j in remaining:
            minor = rows[i][i] * rows[j][j] - rows[i][j] * rows[j][i]
            if i != j and minor < 0:
                return False
    entries = (rows[i][j] for i in remaining for j in remaining)
    return True if all(x.is_zero() for x in entries) else None
