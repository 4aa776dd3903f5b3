"""The step of a method on a linear problem as a matrix of rational functions of the step size.

With W, E and B of the stage system y₁ = M(z) y₀ with M(z) = I + z B (I − zW)⁻¹ E. Its entries have
the common denominator det(I − zW); by Cramer's rule the numerators have at most its degree bound,
the number of unknowns, so that finitely many terms of the power series of M determine them.
"""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector, apply, reciprocal_characteristic, transpose
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.stepping.stage_system import StageSystem


@dataclass(frozen=True)
class StepFunction:
    """M(z) as one denominator and a numerator an entry, without a common factor.

    Attributes:
        denominator: D, with D(0) = 1.
        numerators: shape (d, d); the entries of D · M.
    """

    denominator: Polynomial
    numerators: tuple[tuple[Polynomial, ...], ...]


def step_function(system: StageSystem) -> StepFunction:
    """M(z) in lowest terms."""
    return _reduced(unreduced(system))


def unreduced(system: StageSystem) -> StepFunction:
    """M(z) with the denominator det(I − zW), whatever could be cancelled."""
    n = len(system.W)
    d = len(system.B)
    denominator = reciprocal_characteristic(system.W)
    # without a stage the step does nothing
    columns = transpose(system.E) if n else ((),) * d
    series = [_series(system, column, n) for column in columns]
    numerators = []
    for i in range(d):
        entries = []
        for j in range(d):
            constant = ONE if i == j else ZERO
            powers = Polynomial([constant, *series[j][i]])
            # the first terms of D · M_ij are all there are
            entries.append(Polynomial((denominator * powers).coefficients[: n + 1]))
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


def _reduced(step: StepFunction) -> StepFunction:
    common = step.denominator
    for row in step.numerators:
        for p in row:
            common = gcd(common, p)
    lowest = step.denominator // common
    scale = ONE / lowest[0]
    numerators = [tuple(p // common * scale for p in row) for row in step.numerators]
    return StepFunction(lowest * scale, tuple(numerators))
