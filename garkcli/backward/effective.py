"""Effective order: the order of a method up to a change of coordinates.

Φ has effective order q if β Φ β⁻¹ has order q for some B-series β near the identity. For vector
fields: e^{ad χ} b is that of the problem up to order q. The change is found order by order. If the
transported field has the residual r at order n = k + 1, the part of order k of χ has to satisfy

    [χ_k, δ] = −r,          δ(u) = 1 for single vertices, 0 for all other trees,

a linear system with integer coefficients. If δ commutes only with its multiples, as free fields of
the structure do, solutions are unique up to χ_1 = c δ, a shift of time by c h along the exact flow,
which keeps the effective order. So if there is no solution, and the homogeneous systems before had
only these, the effective order is proved.

Source: J. C. Butcher, *The effective order of Runge–Kutta methods*, LNM 109 (1969) 133; Butcher and
Sanz-Serna, *The number of conditions for a Runge–Kutta method to have effective order p*, Appl.
Numer. Math. 22 (1996) 103.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from flint import fmpq, fmpq_mat, fmpz_mat

from garkcli.backward.modified import ModifiedEquation
from garkcli.backward.series import Forest, transported
from garkcli.exact.field import ZERO, Number, NumberField, coordinates
from garkcli.exact.span import leading_columns
from garkcli.frozen import Frozen

MAX_ENTRIES = 5_000_000
MAX_SOLVED = 1_000_000
"""Most entries of a system that is solved; for larger ones only solvability is decided."""


class EffectiveOrder(Frozen):
    """The effective order if ``is_proved``, or a lower bound of it."""

    order: int
    is_proved: bool


def effective_order(equation: ModifiedEquation) -> EffectiveOrder:
    """The effective order, as far as the trees of ``equation`` and the limits on systems allow.

    >>> from garkcli import loads
    >>> from garkcli.backward.modified import modified_equation
    >>> euler = "prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1]}}"
    >>> method = loads(f"{{{euler}, structure: separable}}").tableau
    >>> effective_order(modified_equation(method, 4))
    EffectiveOrder(order=2, is_proved=True)
    """
    forest = equation.forest
    if equation.order == 0:
        return EffectiveOrder(0, True)  # e^{ad χ} leaves the terms of order 1
    field = list(equation.coefficients)
    is_unique = True
    for k in range(1, equation.max_order):
        rows = forest.of_order(k + 1)
        columns = forest.of_order(k)
        residual = [field[u] for u in rows]
        is_large = len(rows) * len(columns) > MAX_ENTRIES
        if is_large and any(residual):
            return EffectiveOrder(k, False)
        if is_large:
            is_unique = False  # nobody has looked
            continue
        sides: list[list[fmpq]] = []
        if any(residual):
            number_field = equation.tableau.field
            degree = number_field.degree if number_field else 1
            # over ℚ, one column for each coordinate
            by_row = [coordinates(number, degree) for number in residual]
            sides = [list(column) for column in zip(*by_row, strict=True)]
        extended = _bracket_with_delta(forest, k, sides)
        rank = rank_of_all = extended.rank()
        if sides and rank_of_all == extended.ncols():
            rank = len(columns)  # independent columns: no second elimination
        elif sides:
            rank = _bracket_with_delta(forest, k).rank()
        commuting = len(columns) - rank
        is_unique &= commuting == (1 if k == 1 else 0)  # 1: δ itself
        if not sides:
            continue
        if rank_of_all > rank:
            return EffectiveOrder(k, is_unique)
        if len(rows) * len(columns) > MAX_SOLVED:
            return EffectiveOrder(k + 1, False)
        solution = _solve(_bracket_with_delta(forest, k), sides, equation.tableau.field)
        change: list[Number] = [ZERO] * len(field)
        change[columns.start : columns.stop] = [-x for x in solution]
        field = transported(forest, field, change, k)
    return EffectiveOrder(equation.max_order, False)


def _bracket_with_delta(
    forest: Forest, order: int, sides: Sequence[Sequence[fmpq]] = ()
) -> fmpz_mat:
    """The matrices of χ ↦ [χ, δ] to the next order, and right-hand sides, without denominators."""
    rows = forest.of_order(order + 1)
    columns = forest.of_order(order)
    matrix = fmpz_mat(len(rows), len(columns) + len(sides))
    for i, number in enumerate(rows):
        for cut in forest.cuts[number]:
            if forest.order(cut.branch) == 1:
                matrix[i, cut.rest - columns.start] += cut.times
            if forest.order(cut.rest) == 1:
                matrix[i, cut.branch - columns.start] -= cut.times
    for j, side in enumerate(sides, start=len(columns)):
        common = lcm(*[int(x.q) for x in side])
        for i, x in enumerate(side):
            matrix[i, j] = (x * common).p
    return matrix


def _solve(
    matrix: fmpz_mat, sides: Sequence[Sequence[fmpq]], field: NumberField | None
) -> list[Number]:
    columns = matrix.ncols()
    extended = []
    for i, row in enumerate(matrix.tolist()):
        left = [fmpq(x) for x in row]
        extended.append(left + [side[i] for side in sides])
    reduced, _ = fmpq_mat(extended).rref()
    behind = range(columns, columns + len(sides))
    solution: list[Number] = [ZERO] * columns
    for i, j in enumerate(leading_columns(reduced)):
        values = [reduced[i, column] for column in behind]
        if field is None:
            [solution[j]] = values
        else:
            solution[j] = field.from_coordinates(values)
    return solution
