"""Algebraic stability: whether differences of solutions of contractive problems never grow.

A Runge–Kutta method is algebraically stable, hence B-stable, if its weights are not negative and
the matrix M = B A + Aᵀ B − b bᵀ is positive semidefinite (K. Burrage, J. C. Butcher 1979). For a
GARK method M consists of the blocks B^l A^{l,m} + (A^{m,l})ᵀ B^m − b^l (b^m)ᵀ (A. Sandu,
M. Günther 2015, section 4). Both conditions are about quadratic forms, which may be written in any
basis: in the stage algebra of a family no node is needed.
"""

from __future__ import annotations

from itertools import chain, combinations, product
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.exact.display import digits_here, to_ball
from garkcli.exact.enclosing import bits_for
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.roots import sign
from garkcli.frozen import Frozen
from garkcli.tableau.conjugate import symplectic_defect
from garkcli.tableau.tableau import Tableau


class AlgebraicStability(Frozen):
    weights_are_positive: bool
    form_is_positive: bool

    @property
    def holds(self) -> bool:
        return self.weights_are_positive and self.form_is_positive


def algebraic_stability(tableau: Tableau) -> AlgebraicStability | None:
    """Whether a method is algebraically stable; None if a block is missing, which is no zero block:
    without the coupling there is no contractivity to inherit.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> algebraic_stability(gark([diagonal_method("lobatto-iiia", 2)], {}))
    AlgebraicStability(weights_are_positive=True, form_is_positive=False)
    """
    tableau.demand_fields("algebraic stability")
    if len(list(tableau.edges())) < tableau.size**2:
        return None
    grams = (tableau.space(l).gram(colour.b) for l, colour in enumerate(tableau.colours))
    return AlgebraicStability(
        weights_are_positive=all(map(is_positive_semidefinite, grams)),
        form_is_positive=is_positive_semidefinite(contractivity(tableau)),
    )


def contractivity(tableau: Tableau) -> Matrix:
    """The matrix M in the bases of the stage spaces; all blocks must exist."""
    colours = range(tableau.size)
    rows: list[Vector] = []
    for l in colours:
        blocks = [symplectic_defect(tableau, l, m) for m in colours]
        rows += (tuple(chain.from_iterable(parts)) for parts in zip(*blocks, strict=True))
    return tuple(rows)


def is_positive_semidefinite(form: Matrix) -> bool:
    return negative_pivot(form) is None


def negative_pivot(form: Matrix) -> Number | None:
    """Returns a pivot that shows indefiniteness: negative, or 0 with a nonzero row; or None."""
    rows: list[list[Number]] = [list(row) for row in form]
    remaining = list(range(len(rows)))
    while remaining:
        signs = {i: sign(rows[i][i]) for i in remaining}
        for i in remaining:
            if signs[i] < 0:
                return rows[i][i]
        for i in remaining:
            if signs[i] == 0 and any(rows[i][j] for j in remaining):
                return ZERO
        pivots = [i for i in remaining if signs[i] > 0]
        if not pivots:
            return None
        _eliminate(rows, pivots[0], remaining)
    return None


def _eliminate(rows: list[list[Any]], pivot: int, remaining: list[int]) -> None:
    remaining.remove(pivot)
    pivot_row = rows[pivot]
    for i in remaining:
        row = rows[i]
        factor = row[pivot] / pivot_row[pivot]
        if factor:
            for j in remaining:
                row[j] = row[j] - factor * pivot_row[j]


def snapped(ball: arb) -> arb:
    """0 for a ball that contains 0: a nonzero number is larger than the balls."""
    return arb(0) if ball.contains(0) else ball


def algebraic_within(tableau: Tableau, tolerance: fmpq) -> bool | None:
    """Whether a method on point stages, in balls, is algebraically stable; None if undecided.

    By symmetric elimination, where a ball with 0 counts as 0: positive pivots are eliminated, and a
    negative diagonal entry or 2×2 minor excludes stability.
    """
    with ctx.workprec(bits_for(tolerance)):
        weights = [x for colour in tableau.colours for x in rounded_balls(colour.b, tolerance)]
        if any(b < 0 for b in weights):
            return False
        return is_positive([[*map(snapped, row)] for row in form_within(tableau, tolerance)])


def rounded_balls(row: Vector, tolerance: fmpq) -> list[arb]:
    """Coefficients with their rounding; zeros are exact."""
    rounding = arb(0, arb(tolerance).upper())
    digits = digits_here()
    return [to_ball(x, digits) + rounding if x else arb(0) for x in row]


def form_within(tableau: Tableau, tolerance: fmpq) -> list[list[arb]]:
    """M = B A + Aᵀ B − b bᵀ over all colours and stages, for all methods within a tolerance."""
    blocks = {
        (l, m): [rounded_balls(row, tolerance) for row in tableau.block(l, m) or ()]
        for l, m in product(range(tableau.size), repeat=2)
    }
    weights = [rounded_balls(colour.b, tolerance) for colour in tableau.colours]
    places = [(l, i) for l, row in enumerate(weights) for i in range(len(row))]
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
        for i, j in combinations(remaining, 2):
            diagonal = rows[i][i] * rows[j][j]
            if diagonal < rows[i][j] * rows[j][i]:
                return False
        pivots = [i for i in remaining if rows[i][i] > 0]
        if not pivots:
            is_zero = all(rows[i][j].is_zero() for i in remaining for j in remaining)
            return True if is_zero else None
        _eliminate(rows, pivots[0], remaining)
        for i, j in product(remaining, repeat=2):
            rows[i][j] = snapped(rows[i][j])
    return True
