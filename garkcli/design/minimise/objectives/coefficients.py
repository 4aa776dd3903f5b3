"""The size of the coefficients: the sum of their squares."""

from itertools import chain
from typing import Any

from flint import fmpq, fmpq_mat

from garkcli.design.minimise.objective import Objective
from garkcli.design.minimise.squared_error import Quotient
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix, identity
from garkcli.exact.parametric import Parameters, fraction
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau


def _formula(tableau: Tableau, _order: int, ring: Parameters | None) -> Quotient:
    """Σ a_ij² = tr(A T_m⁻¹ Aᵀ T_k), Σ b_j² = b T⁻¹ bᵀ with T_ij = Σ e_i e_j over the nodes.

    At nodes T is the identity; in a polynomial space it makes the sum rational where the nodes are
    not.
    """
    total: Any = fmpq(0)
    inverses = [_inverse(_traces(space)) for space in tableau.spaces]
    for colour in tableau.colours:
        total = total + _form(colour.b, inverses[colour.space])
    for (k, m), block in tableau.blocks.items():
        T = _traces(tableau.spaces[k])
        inverse = inverses[tableau.colours[m].space]
        for i, row in enumerate(block):
            for j, other in enumerate(block):
                if T[i][j]:
                    total = total + _product(row, inverse, other) * T[i][j]
    if ring is None:
        return Quotient(total, ONE)
    return Quotient(*fraction(total, ring))


def _traces(space: StageSpace) -> Matrix:
    """T."""
    s = space.stages
    if not isinstance(space, PolynomialSpace):
        return identity(s)
    # the sum of f over the nodes is the trace of multiplication by f
    powers = list(zip(*space.reductions(3 * s - 2), strict=True))
    sums = [sum(powers[k + i][i] for i in range(s)) for k in range(2 * s - 1)]
    return tuple(tuple(sums[i : i + s]) for i in range(s))


def _inverse(T: Matrix) -> Matrix:
    s = len(T)
    entries: list[Any] = list(chain.from_iterable(T))
    inverse = fmpq_mat(s, s, entries).inv()
    return tuple(map(tuple, inverse.tolist()))


def _form(row: Any, matrix: Matrix) -> Any:
    return _product(row, matrix, row)


def _product(left: Any, matrix: Matrix, right: Any) -> Any:
    """The number left · matrix · rightᵀ."""
    total: Any = fmpq(0)
    for x, line in zip(left, matrix, strict=True):
        for a, y in zip(line, right, strict=True):
            if a and x and y:
                total = total + x * y * a
    return total


OBJECTIVE = Objective(
    "coefficients", "Σ a² + Σ b² over all coefficients of all blocks and weights", _formula
)
"""The Frobenius norm of the tableau, squared."""
