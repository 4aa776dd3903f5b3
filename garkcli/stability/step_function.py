"""The step of a method on a linear problem as a matrix of rational functions of the step size.

With the vector field y ↦ L^m y of colour m, L^m ∈ K^{d×d}, the stage values obey

    Y^k = 𝟙 ⊗ y₀ + z Σ_m (A^{k,m} ⊗ L^m) Y^{space(m)},    y₁ = y₀ + z Σ_m (b_m ⊗ L^m) Y^{space(m)},

so that y₁ = M(z) y₀ with M(z) = I + z B (I − zW)⁻¹ E. Its entries have the common denominator
det(I − zW); by Cramer's rule the numerators have at most its degree bound, the number of unknowns,
so that finitely many terms of the power series of M determine them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from garkcli.exact.characteristic import reciprocal_characteristic
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, apply, transpose
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class StageSystem:
    """W, E and B of this module's heading, over the domain K of the coefficients.

    Attributes:
        W: shape (n, n), n the number of unknown stage values that are used.
        E: shape (n, d).
        B: shape (d, n).
    """

    W: Matrix
    E: Matrix
    B: Matrix


@dataclass(frozen=True)
class StepFunction:
    """M(z) as one denominator and a numerator an entry, without a common factor.

    Attributes:
        denominator: D, with D(0) = 1.
        numerators: shape (d, d); the entries of D · M.
    """

    denominator: Polynomial
    numerators: tuple[tuple[Polynomial, ...], ...]


def stage_system(
    tableau: Tableau, fields: Sequence[Matrix], pattern: Sequence[Matrix] | None = None
) -> StageSystem:
    """The linear system of the stages.

    Args:
        tableau: the method.
        fields: L^m for each colour m, all of one shape (d, d).
        pattern: matrices that are zero only where the L^m are zero for all parameters of a problem,
            so that the unknowns are the same for all; None for the L^m themselves.
    """
    d = len(fields[0])
    driven = []
    for m, kept in enumerate(fields if pattern is None else pattern):
        for i in range(d):
            driven += [(m, i, j, fields[m][i][j]) for j in range(d) if kept[i][j]]
    first: dict[
        tuple[int, int], int
    ] = {}  # (stage space, component of y) → its first unknown
    size = 0
    for m, _, j, _ in driven:
        values = tableau.colours[m].space, j
        if values not in first:
            first[values] = size
            size += tableau.space(m).stages
    W = _zeros(size, size)
    E = _zeros(size, d)
    B = _zeros(d, size)
    for m, i, j, factor in driven:
        colour = tableau.colours[m]
        column = first[colour.space, j]
        _add(B, i, column, factor, (colour.b,))
        for (k, component), row in first.items():
            block = tableau.blocks.get((k, m))
            if component == i and block is not None:
                _add(W, row, column, factor, block)
    for (k, component), row in first.items():
        ones = tuple((x,) for x in tableau.spaces[k].one)
        _add(E, row, component, ONE, ones)
    return StageSystem(_frozen(W), _frozen(E), _frozen(B))


def _zeros(rows: int, columns: int) -> list[list[Number]]:
    return [[ZERO] * columns for _ in range(rows)]


def _frozen(rows: list[list[Number]]) -> Matrix:
    return tuple(tuple(row) for row in rows)


def _add(
    matrix: list[list[Number]], row: int, column: int, factor: Number, block: Matrix
) -> None:
    for i, entries in enumerate(block, start=row):
        for j, x in enumerate(entries, start=column):
            matrix[i][j] = matrix[i][j] + factor * x


def step_function(system: StageSystem) -> StepFunction:
    """M(z) in lowest terms."""
    return _reduced(unreduced(system))


def unreduced(system: StageSystem) -> StepFunction:
    """M(z) with the denominator det(I − zW), whatever could be cancelled."""
    n, d = len(system.W), len(system.B)
    denominator = reciprocal_characteristic(system.W)
    # without a stage the step does nothing
    columns = transpose(system.E) if n else ((),) * d
    series = [_series(system, column, n) for column in columns]
    numerators = []
    for i in range(d):
        entries = (_numerator(denominator, series[j][i], i == j, n) for j in range(d))
        numerators.append(tuple(entries))
    return StepFunction(denominator, tuple(numerators))


def _series(system: StageSystem, column: Vector, terms: int) -> list[list[Number]]:
    """The coefficients of z, z², … in one column of M, a list for each row."""
    found: list[list[Number]] = [[] for _ in system.B]
    state = column
    for _ in range(terms):
        for i, value in enumerate(apply(system.B, state)):
            found[i].append(value)
        state = apply(system.W, state)
    return found


def _numerator(
    denominator: Polynomial, series: Sequence[Number], is_diagonal: bool, degree: int
) -> Polynomial:
    """The first terms of D · M_ij, which are all there are."""
    entry = Polynomial([ONE if is_diagonal else ZERO, *series])
    product = denominator * entry
    return Polynomial(product.coefficients[: degree + 1])


def _reduced(step: StepFunction) -> StepFunction:
    common = step.denominator
    for row in step.numerators:
        for p in row:
            common = gcd(common, p)
    lowest = step.denominator // common
    scale = ONE / lowest[0]
    numerators = tuple(
        tuple(p // common * scale for p in row) for row in step.numerators
    )
    return StepFunction(lowest * scale, numerators)
