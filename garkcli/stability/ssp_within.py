"""The SSP coefficient of methods with rounded coefficients, between bounds.

The conditions are those of ``garkcli.stability.ssp`` with balls as coefficients; zeros are
structure.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, arb_mat, arb_poly, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix
from garkcli.graph import components
from garkcli.stability.bounds import Bounds, first_failure, least
from garkcli.stability.ssp import driven_part, stacked
from garkcli.tableau.tableau import Tableau

DIGITS = 64
"""Digits of the balls."""


def ssp_within(tableau: Tableau, shares: Sequence[Number], tolerance: fmpq) -> Bounds:
    """The first failure of any condition, between bounds.

    Args:
        tableau: the method, one coordinate a stage.
        shares: r_l / r for each colour; those with 0 have the vector field 0, as for
            ``ssp_coefficient``.
        tolerance: the rounding of coefficients that are not zero.
    """
    pattern, parts = stacked(*driven_part(tableau, shares))
    n = len(pattern)
    whole = arb_mat(n, n)
    vectors = [[arb(1)] * n]
    driven = [share for share in shares if share]
    for share, part in zip(driven, parts, strict=True):
        wide = _widened(part, tolerance)
        whole += wide * to_ball(share, DIGITS)
        vectors += _columns(wide)
    denominator = _reciprocal(pattern, whole)
    conditions = [denominator]
    for vector in vectors:
        conditions += _entries(denominator, whole, vector)
    failures = [first_failure(condition) for condition in conditions]
    return least(failures)


def _widened(matrix: Matrix, tolerance: fmpq) -> arb_mat:
    """The coefficients with their rounding; zeros are structure."""
    rounding = arb(0, arb(tolerance).upper())
    rows = []
    for exact in matrix:
        row = [to_ball(x, DIGITS) + rounding if x else arb(0) for x in exact]
        rows.append(row)
    return arb_mat(rows)


def _columns(matrix: arb_mat) -> list[list[arb]]:
    """The columns that are not zero."""
    columns = matrix.transpose().tolist()
    return [column for column in columns if not all(x.is_zero() for x in column)]


def _reciprocal(pattern: Matrix, matrix: arb_mat) -> list[arb]:
    """det(I + rK) as coefficients of r, component by component."""
    edges = {}
    for i, row in enumerate(pattern):
        edges[i] = [j for j, x in enumerate(row) if x]
    result = arb_poly([1])
    for component in components(edges):
        block = arb_mat([[-matrix[i, j] for j in component] for i in component])
        factor = [arb(1), -block[0, 0]]
        if len(component) > 1:
            characteristic = list(block.charpoly().coeffs())
            factor = characteristic[::-1]
        result = result * arb_poly(factor)
    return [result[k] for k in range(len(result))]


def _entries(denominator: list[arb], matrix: arb_mat, vector: list[arb]) -> list[list[arb]]:
    """The numerators of (I + rK)⁻¹ v, polynomials in r."""
    n = len(vector)
    state = arb_mat([[x] for x in vector])
    series: list[list[arb]] = [[] for _ in range(n)]
    for _ in range(n + 1):
        for i in range(n):
            series[i].append(state[i, 0])
        state = -(matrix * state)
    common = arb_poly(denominator)
    found = []
    for terms in series:
        product = common * arb_poly(terms)
        found.append([product[k] for k in range(n + 1)])
    return found
