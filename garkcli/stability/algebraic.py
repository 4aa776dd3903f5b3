"""Algebraic stability: whether differences of solutions of contractive problems never grow.

A Runge–Kutta method is algebraically stable, hence B-stable, when its weights are not negative and
the matrix M = B A + Aᵀ B − b bᵀ is positive semidefinite (K. Burrage, J. C. Butcher 1979). For a
GARK method M consists of the blocks B^l A^{l,m} + (A^{m,l})ᵀ B^m − b^l (b^m)ᵀ (A. Sandu,
M. Günther 2015, section 4). Both conditions are about quadratic forms, which may be written in any
basis: in the stage algebra of a family no node is needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, outer, subtract, transpose
from garkcli.exact.matrix import add as add_matrices
from garkcli.exact.roots import sign
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class AlgebraicStability:
    """What decides it.

    Attributes:
        weights_are_positive: whether no weight is negative.
        form_is_positive: whether M is positive semidefinite.
    """

    weights_are_positive: bool
    form_is_positive: bool

    @property
    def holds(self) -> bool:
        """Whether the method is algebraically stable."""
        return self.weights_are_positive and self.form_is_positive


def algebraic_stability(tableau: Tableau) -> AlgebraicStability | None:
    """Whether a method is algebraically stable; None where a block is missing.

    A missing block is no block of zeros: the problem has no such coupling, and so no contractivity
    of its own to be inherited.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> found = algebraic_stability(gark([diagonal_method("lobatto-iiia", 2)], {}))
    >>> found.weights_are_positive, found.form_is_positive
    (True, False)
    """
    if len(list(tableau.edges())) < tableau.size**2:
        return None
    grams = []
    for l, colour in enumerate(tableau.colours):
        gram = tableau.space(l).gram(colour.b)
        grams.append(gram)
    M = contractivity(tableau)
    return AlgebraicStability(
        weights_are_positive=all(map(is_positive_semidefinite, grams)),
        form_is_positive=is_positive_semidefinite(M),
    )


def contractivity(tableau: Tableau) -> Matrix:
    """The matrix M, in the bases of the stage spaces; all blocks exist."""
    colours = range(tableau.size)
    blocks = [[_form(tableau, l, m) for m in colours] for l in colours]
    return _assembled(blocks)


def _form(tableau: Tableau, l: int, m: int) -> Matrix:
    """B^l A^{l,m} + (A^{m,l})ᵀ B^m − b^l (b^m)ᵀ, in the bases of the two stage spaces."""
    there = tableau.block(l, m)
    back = tableau.block(m, l)
    assert there is not None
    assert back is not None
    weights = tableau.colours[l].b
    others = tableau.colours[m].b
    outgoing = tableau.space(l).form(weights, there)
    incoming = transpose(tableau.space(m).form(others, back))
    both = add_matrices(outgoing, incoming)
    return subtract(both, outer(weights, others))


def _assembled(blocks: list[list[Matrix]]) -> Matrix:
    """One matrix from rows of blocks."""
    rows: list[Vector] = []
    for row_of_blocks in blocks:
        pieces = zip(*row_of_blocks, strict=True)
        rows.extend(tuple(chain.from_iterable(parts)) for parts in pieces)
    return tuple(rows)


def is_positive_semidefinite(form: Matrix) -> bool:
    """Whether a symmetric matrix has no negative eigenvalue, by exact symmetric elimination."""
    return negative_pivot(form) is None


def negative_pivot(form: Matrix, is_definite: bool = False) -> Number | None:
    """What symmetric elimination of a matrix meets that speaks against a positive form; None where
    nothing does.

    A zero on the diagonal must have a zero row; a positive pivot is eliminated.

    Args:
        form: a symmetric matrix.
        is_definite: whether zeros on the diagonal speak against it, too.

    Returns:
        A number on the diagonal that is negative, or 0 with a row that is not zero.
    """
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
            return ZERO if is_definite else None
        pivot = pivots[0]
        remaining.remove(pivot)
        _eliminate(rows, pivot, remaining)
    return None


def _eliminate(rows: list[list[Number]], pivot: int, remaining: list[int]) -> None:
    """Take multiples of the row of the pivot from the others, among the remaining columns."""
    pivot_row = rows[pivot]
    for i in remaining:
        row = rows[i]
        factor = row[pivot] / pivot_row[pivot]
        if factor:
            for j in remaining:
                row[j] = row[j] - factor * pivot_row[j]
