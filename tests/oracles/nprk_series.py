"""The order of nonlinearly partitioned methods without trees and without gark: one step as a power
series in h on a random ẏ = F(y, y), against the Taylor series, modulo a prime.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random

from tests.oracles.rosenbrock_series import (
    DIMENSION,
    Matrix,
    P,
    State,
    combined,
    plus,
    random_field,
    shifted,
)


def order(a: Sequence[Matrix], b: Matrix, limit: int, seed: int = 0) -> int:
    """The number of powers of h, at most ``limit``, in which a step agrees with the solution.

    Args:
        a: ``a[i][j][k]``, all of one shape.
        b: ``b[j][k]``.
        limit: the degree of the field less one.
        seed: of the field.
    """
    dice = Random(seed)
    F = random_field(2 * DIMENSION, DIMENSION, limit - 1, dice)
    y = [[dice.randrange(P)] + [0] * limit for _ in range(DIMENSION)]
    s = range(len(a))

    def value(matrix: Matrix, stages: Sequence[State]) -> State:
        weights = [matrix[j][k] for j in s for k in s if matrix[j][k]]
        slopes = [F([*stages[j], *stages[k]]) for j in s for k in s if matrix[j][k]]
        return plus(y, shifted(combined(weights, slopes))) if slopes else y

    stages = [y for _ in s]
    for _ in range(limit):
        stages = [value(x, stages) for x in a]
    step, exact = value(b, stages), y
    for _ in range(limit):
        slope = F([*exact, *exact])
        exact = plus(
            y, [[0, *(x * pow(n, -1, P) % P for n, x in enumerate(row[:-1], 1))] for row in slope]
        )
    powers = zip(zip(*exact, strict=True), zip(*step, strict=True), strict=True)
    return next((n for n, (u, v) in enumerate(powers) if u != v), limit + 1) - 1


def diagonal(A: Matrix, b: Sequence[Fraction]) -> tuple[list[Matrix], Matrix]:
    """A Runge–Kutta method with F(Y_j, Y_j) at every stage."""
    s = range(len(b))

    def spread(row: Sequence[Fraction]) -> Matrix:
        return [[row[j] if j == k else Fraction(0) for k in s] for j in s]

    return [spread(row) for row in A], spread(b)
