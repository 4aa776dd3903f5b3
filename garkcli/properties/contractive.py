"""What stands in the way of algebraic stability, in words."""

from __future__ import annotations

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.exact.signs import sign
from garkcli.properties.naming import number_text, weight_name
from garkcli.properties.reduction import are_positive
from garkcli.stability.algebraic import contractivity, negative_pivot
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau

_BITS = 256
"""Precision of balls; far below any tolerance that files have."""


def obstacle(tableau: Tableau) -> str:
    """Why a method is not algebraically stable; empty where it is. All its blocks exist."""
    weights = _negative_weight(tableau)
    if weights:
        return weights
    pivot = negative_pivot(contractivity(tableau))
    if pivot is None:
        return ""
    what = number_text(pivot) if pivot else "0 beside entries that are not 0"
    return f"elimination of M meets {what} on its diagonal"


def _negative_weight(tableau: Tableau, tolerance: fmpq = ZERO) -> str:
    for m, colour in enumerate(tableau.colours):
        space = tableau.space(m)
        if not isinstance(space, PointSpace):
            is_positive = are_positive(space, colour.b)
            if (
                not is_positive
                and negative_pivot(space.gram(colour.b)) is not None
            ):
                return f"b{{{colour.name}}} has a negative entry"
            continue
        for j, b in enumerate(colour.b):
            if sign(b + tolerance) < 0:
                return f"{weight_name(tableau, m, j)} is {number_text(b)}"
    return ""


def obstacle_within(tableau: Tableau, tolerance: fmpq) -> str | None:
    """The same for all methods within a tolerance: empty where none has an obstacle, None where
    that is not decided.

    An entry of M is a sum of two products and a product; a minor of one or two rows that is
    negative for all numbers in the balls decides, or a definite M.
    """
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        return None
    weights = _negative_weight(tableau, tolerance)
    if weights:
        return weights
    with ctx.workprec(_BITS):
        form = _in_balls(tableau, tolerance)
        if _has_negative_minor(form):
            return "a minor of M is negative"
        is_positive = all(
            b > tolerance
            for colour in tableau.colours
            for b in map(to_ball, colour.b)
        )
        return "" if is_positive and _is_definite(form) else None


def _in_balls(tableau: Tableau, tolerance: fmpq) -> list[list[arb]]:
    """M with every coefficient a ball of the radius of the tolerance; zeros are zeros."""

    def widened(x: Number) -> arb:
        ball = to_ball(x, _BITS // 4)
        return ball if not x else ball + arb(0, arb(tolerance).upper())

    def balls(block: Matrix) -> list[list[arb]]:
        return [[widened(x) for x in row] for row in block]

    colours = range(tableau.size)
    weights = [[widened(x) for x in colour.b] for colour in tableau.colours]
    blocks = {
        (l, m): balls(tableau.block(l, m) or ())
        for l in colours
        for m in colours
    }
    places = [(l, i) for l in colours for i in range(len(weights[l]))]
    return [
        [
            weights[l][i] * blocks[l, m][i][j]
            + weights[m][j] * blocks[m, l][j][i]
            - weights[l][i] * weights[m][j]
            for m, j in places
        ]
        for l, i in places
    ]


def _has_negative_minor(form: list[list[arb]]) -> bool:
    n = range(len(form))
    if any(form[i][i] < 0 for i in n):
        return True
    pairs = ((i, j) for i in n for j in range(i))
    return any(
        form[i][i] * form[j][j] < form[i][j] * form[j][i] for i, j in pairs
    )


def _is_definite(form: list[list[arb]]) -> bool:
    rows = [list(row) for row in form]
    for k in range(len(rows)):
        if not rows[k][k] > 0:
            return False
        for i in range(k + 1, len(rows)):
            factor = rows[i][k] / rows[k][k]
            for j in range(k + 1, len(rows)):
                rows[i][j] = rows[i][j] - factor * rows[k][j]
    return True
