"""What stands in the way of algebraic stability, in words."""

from __future__ import annotations

from itertools import chain, combinations

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO
from garkcli.exact.roots import sign
from garkcli.properties.naming import number_text, weight_name
from garkcli.properties.reduction import are_positive
from garkcli.stability.algebraic import contractivity, form_within, negative_pivot
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
    what = "0 beside entries that are not 0"
    if pivot:
        what = number_text(pivot)
    return f"elimination of M meets {what} on its diagonal"


def _negative_weight(tableau: Tableau, tolerance: fmpq = ZERO) -> str:
    """The first weight that is negative for all methods within the tolerance; empty where there
    is none.
    """
    for m, colour in enumerate(tableau.colours):
        space = tableau.space(m)
        if not isinstance(space, PointSpace):
            if are_positive(space, colour.b):
                continue
            if negative_pivot(space.gram(colour.b)) is not None:
                return f"b{{{colour.name}}} has a negative entry"
            continue
        for j, b in enumerate(colour.b):
            if sign(b + tolerance) < 0:
                name = weight_name(tableau, m, j)
                value = number_text(b)
                return f"{name} is {value}"
    return ""


def obstacle_within(tableau: Tableau, tolerance: fmpq) -> str | None:
    """The same for all methods within a tolerance: empty where none has an obstacle, None where
    that is not decided.

    An entry of M is a sum of two products and a product; a minor of one or two rows that is
    negative for all numbers in the balls decides, or a definite M.
    """
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        return None
    negative = _negative_weight(tableau, tolerance)
    if negative:
        return negative
    with ctx.workprec(_BITS):
        form = form_within(tableau, tolerance)
        if _has_negative_minor(form):
            return "a minor of M is negative"
        rows = [colour.b for colour in tableau.colours]
        weights = map(to_ball, chain.from_iterable(rows))
        if all(b > tolerance for b in weights) and _is_definite(form):
            return ""
        return None


def _has_negative_minor(form: list[list[arb]]) -> bool:
    """Whether a minor of one row, or of two, is negative for all numbers in the balls."""
    numbers = range(len(form))
    if any(form[i][i] < 0 for i in numbers):
        return True
    for i, j in combinations(numbers, 2):
        diagonal = form[i][i] * form[j][j]
        others = form[i][j] * form[j][i]
        if diagonal < others:
            return True
    return False


def _is_definite(form: list[list[arb]]) -> bool:
    """Whether elimination meets positive pivots alone, for all numbers in the balls."""
    rows = [list(row) for row in form]
    while rows:
        (pivot, *right), *others = rows
        if not pivot > 0:
            return False
        rows = []
        for first, *row in others:
            factor = first / pivot
            pairs = zip(row, right, strict=True)
            rows.append([x - factor * y for x, y in pairs])
    return True
