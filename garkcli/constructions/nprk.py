"""Nonlinearly partitioned Runge–Kutta methods for ẏ = F(y, y) as tableaus.

    Y_i = y + h Σ_jk a_ijk F(Y_j, Y_k),        y_1 = y + h Σ_jk b_jk F(Y_j, Y_k).

The stages of the tableau are the pairs (j, k) at which F is evaluated. The colour of a branch tells
whether it is in the first or second argument of F: it is seen through the rows of a for Y_j, or
those for Y_k. Proof of the conditions: docs/exact-order.md, section 12.

T. Buvoli, B. S. Southworth, arXiv 2401.04859; B. K. Tran, B. S. Southworth, T. Buvoli, arXiv
2401.12427.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.ntrees.kind import ARGUMENT
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Tableau

Tensor = Sequence[Matrix]
"""``a[i][j][k]``; rows and matrices may be short, with zeros to follow."""


class Pairs(PointSpace):
    pairs: tuple[tuple[int, int], ...]


def nprk(a: Tensor, b: Matrix, embedded: Matrix | None = None) -> tuple[Tableau, Vector | None]:
    """The tableau, with the pairs in use as stages, and the embedded weights there. ``a`` has a
    matrix for each stage, ``b`` and ``embedded`` a row for each first argument.

    >>> from flint import fmpq
    >>> from garkcli.order.certificate import find_order
    >>> semi_implicit_euler, _ = nprk([[], [[], [fmpq(1)]]], [[], [fmpq(1)]])
    >>> find_order(semi_implicit_euler)
    <Order 1>
    """
    s = range(len(a))
    parts = [*a, b] if embedded is None else [*a, b, embedded]
    pairs = [(j, k) for j in s for k in s if any(_entry(x, j, k) != 0 for x in parts)] or [(0, 0)]
    rows = [tuple(_entry(x, j, k) for j, k in pairs) for x in parts]
    nodes = [sum(row, start=ZERO) for row in rows]
    weights = rows[len(a)]
    space = Pairs(tuple(nodes[j] for j, _ in pairs), tuple(pairs))
    # the colour of a root says nothing: each tree has one condition
    colours = tuple(
        Colour(str(m + 1), 0, weights, tuple(nodes[x[m]] for x in pairs), kind=ARGUMENT, late=late)
        for m, late in enumerate((0, None))
    )
    blocks = {(0, m): tuple(rows[x[m]] for x in pairs) for m in range(2)}
    further = None if embedded is None else rows[-1]
    return Tableau((space,), colours, blocks), further


def _entry(matrix: Matrix, j: int, k: int) -> Number:
    return matrix[j][k] if j < len(matrix) and k < len(matrix[j]) else ZERO


def is_nprk(tableau: Tableau) -> bool:
    return all(colour.kind == ARGUMENT for colour in tableau.colours)


def arrays_of(tableau: Tableau) -> tuple[tuple[Matrix, ...], Vector]:
    """The numbers a_ijk and the nodes; rows of stages in no pair are zero."""
    (space,) = tableau.spaces
    assert isinstance(space, Pairs)
    s = 1 + max(map(max, space.pairs))
    rows: list[Vector] = [(ZERO,) * space.stages] * s
    for p, places in enumerate(space.pairs):
        for m, i in enumerate(places):
            rows[i] = tableau.blocks[0, m][p]
    nodes = tuple(sum(row, start=ZERO) for row in rows)
    return tuple(matrix_of(row, tableau) for row in rows), nodes


def matrix_of(row: Vector, tableau: Tableau) -> Matrix:
    """Numbers at the pairs of stages, such as weights, as a square matrix."""
    (space,) = tableau.spaces
    assert isinstance(space, Pairs)
    s = range(1 + max(map(max, space.pairs)))
    known = dict(zip(space.pairs, row, strict=True))
    return tuple(tuple(known.get((j, k), ZERO) for k in s) for j in s)


def additive(tableau: Tableau) -> Tableau:
    """Returns the method for F(u, v) = f₁(u) + f₂(v): the stages of f₁ are the first arguments of
    the pairs, those of f₂ the second.
    """
    (space,) = tableau.spaces
    colours = tuple(
        Colour(colour.name, l, colour.b, colour.c, term=l)
        for l, colour in enumerate(tableau.colours)
    )
    size = range(len(colours))
    blocks = {(l, m): tableau.blocks[0, l] for l in size for m in size}
    return Tableau((space, space), colours, blocks)
