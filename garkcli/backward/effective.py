"""Effective order: the order of a method up to a change of coordinates.

Φ has effective order q if there is a B-series β, a change of coordinates near the identity, for
which β Φ β⁻¹ has order q. In terms of vector fields: e^{ad χ} b is that of the problem up to order
q. The change is looked for order by order. Where the transported field has the residual r at order
n = k + 1, the part of order k of χ has to satisfy

    [χ_k, δ] = −r,          δ(u) = 1 for single vertices, 0 for all other trees,

a linear system with integer coefficients. δ commutes with multiples of itself alone, if free fields
of this structure do: then solutions are unique, but for χ_1 = c δ. This is the change of time by
c h along the exact flow, which changes no effective order. So where no solution exists, and each
homogeneous system before had no other solution than these, there is no change at all, and the
effective order is proved.

Source: J. C. Butcher, *The effective order of Runge–Kutta methods*, LNM 109 (1969) 133; Butcher and
Sanz-Serna, *The number of conditions for a Runge–Kutta method to have effective order p*, Appl.
Numer. Math. 22 (1996) 103.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq, fmpq_mat, fmpz_mat

from garkcli.backward.forest import Forest
from garkcli.backward.modified import ModifiedEquation
from garkcli.backward.series import transported
from garkcli.exact.echelon import pivot_columns
from garkcli.exact.field import ZERO, Number, NumberField, coordinates

MAX_ENTRIES = 1_000_000
"""The largest linear system that is solved, rows times columns."""


@dataclass(frozen=True)
class EffectiveOrder:
    """The effective order of a method.

    Attributes:
        order: the largest found.
        is_proved: whether no change of coordinates gives a higher one. Otherwise the order is a
            lower bound.
    """

    order: int
    is_proved: bool


def effective_order(equation: ModifiedEquation) -> EffectiveOrder:
    """The effective order, as far as the trees of ``equation`` tell and systems are not too large.

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
        rows, columns = forest.of_order(k + 1), forest.of_order(k)
        residual = [field[u] for u in rows]
        is_large = len(rows) * len(columns) > MAX_ENTRIES
        if is_large and any(residual):
            return EffectiveOrder(k, False)
        if is_large:
            is_unique = False  # nobody has looked
            continue
        matrix = _bracket_with_delta(forest, k)
        commuting = len(columns) - matrix.rank()
        is_unique &= commuting == (1 if k == 1 else 0)  # 1: δ itself
        if not any(residual):
            continue
        solution = _solve(matrix, residual, equation.tableau.field)
        if solution is None:
            return EffectiveOrder(k, is_unique)
        change: list[Number] = [ZERO] * len(field)
        change[columns.start : columns.stop] = [-x for x in solution]
        field = transported(forest, field, change, k)
    return EffectiveOrder(equation.max_order, False)


def _bracket_with_delta(forest: Forest, order: int) -> fmpz_mat:
    """χ ↦ [χ, δ] from trees of an order to those of the next."""
    rows, columns = forest.of_order(order + 1), forest.of_order(order)
    matrix = fmpz_mat(len(rows), len(columns))
    for number in rows:
        i = number - rows.start
        for cut in forest.cuts[number]:
            if forest.order(cut.branch) == 1:
                j = cut.rest - columns.start
                matrix[i, j] = matrix[i, j] + cut.times
            if forest.order(cut.rest) == 1:
                j = cut.branch - columns.start
                matrix[i, j] = matrix[i, j] - cut.times
    return matrix


def _solve(
    matrix: fmpz_mat, right: Sequence[Number], field: NumberField | None
) -> list[Number] | None:
    """One solution of a linear system with integer coefficients; None where there is none.

    A right-hand side in a number field is one for each coordinate over ℚ.
    """
    degree = field.degree if field else 1
    rows, columns = matrix.nrows(), matrix.ncols()
    extended = fmpq_mat(rows, columns + degree)
    for i in range(rows):
        for j in range(columns):
            extended[i, j] = fmpq(matrix[i, j])
        for d, x in enumerate(coordinates(right[i], degree)):
            extended[i, columns + d] = x
    pivots = pivot_columns(extended)
    if pivots and pivots[-1] >= columns:
        return None
    reduced, _ = extended.rref()
    solution: list[Number] = [ZERO] * columns
    for i, j in enumerate(pivots):
        values = [reduced[i, columns + d] for d in range(degree)]
        solution[j] = field.from_coordinates(values) if field else values[0]
    return solution
