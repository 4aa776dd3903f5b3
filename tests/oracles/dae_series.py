"""The orders of Rosenbrock methods on ẏ = f(y, z), 0 = g(y, z) without trees and without gark: one
step as a power series in h, against the Taylor series of the solution; z has one component.

See ``rosenbrock_series``, whose numbers and fields these are.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random

from tests.oracles.rosenbrock_series import (
    DIMENSION,
    Field,
    Matrix,
    P,
    State,
    applied,
    combined,
    plus,
    random_field,
    residue,
    shifted,
)


def orders(
    alpha: Matrix, gamma: Matrix, b: Sequence[Fraction], limit: int, seed: int = 0
) -> tuple[int, int]:
    """The numbers of powers of h, at most ``limit``, in which y and z of a step agree with the
    solution.
    """
    dice = Random(seed)
    f = random_field(DIMENSION + 1, DIMENSION, limit - 1, dice)
    g = random_field(DIMENSION + 1, 1, limit, dice)
    start = [[dice.randrange(P)] + [0] * limit for _ in range(DIMENSION + 1)]
    y, z = _solution(f, g, start, limit)
    y_1, z_1 = _step(f, g, start, (alpha, gamma), b, limit)
    return _agreed(y, y_1, limit), _agreed(z, z_1, limit)


def _agreed(one: State, other: State, limit: int) -> int:
    powers = zip(zip(*one, strict=True), zip(*other, strict=True), strict=True)
    return next((n for n, (x, y) in enumerate(powers) if x != y), limit + 1) - 1


def _residual(g: Field, start: State, now: State) -> State:
    """G in 0 = g − g at the start, which is consistent there."""
    return plus(g(now), _times(-1, g(start)))


def _times(factor: int, x: State) -> State:
    return [[factor * y % P for y in row] for row in x]


def _slopes(f: Field, g: Field, start: State) -> tuple[list[list[int]], list[list[int]], int]:
    """The Jacobians at the start, and −1/g_z."""
    point = [row[0] for row in start]
    of_g = g.jacobian(point)
    return f.jacobian(point), of_g, -pow(of_g[0][-1], -1, P) % P


def _solution(f: Field, g: Field, start: State, limit: int) -> tuple[State, State]:
    """By Picard's iteration for y and Newton's with one Jacobian for z."""
    _, _, solve = _slopes(f, g, start)
    y, z = start[:DIMENSION], start[DIMENSION:]
    for _ in range(2 * limit + 2):
        slope = f([*y, *z])
        grown = [
            [0, *(x * pow(n, -1, P) % P for n, x in enumerate(row[:-1], start=1))] for row in slope
        ]
        z = plus(z, _times(solve, _residual(g, start, [*y, *z])))
        y = plus(start[:DIMENSION], grown)
    return y, z


def _step(
    f: Field,
    g: Field,
    start: State,
    method: tuple[Matrix, Matrix],
    b: Sequence[Fraction],
    limit: int,
) -> tuple[State, State]:
    """k_i = h f(v_i) + h f' Σ γ_ij (k_j, l_j), 0 = g(v_i) + g' Σ γ_ij (k_j, l_j), where v_i is the
    start + Σ α_ij (k_j, l_j).
    """
    alpha, gamma = method
    of_f, of_g, solve = _slopes(f, g, start)
    stages = len(b)
    K = [[[0] * (limit + 1) for _ in start] for _ in b]
    for _ in range((stages + 1) * (limit + 1)):
        for i in range(stages):
            seen = plus(start, combined(alpha[i], K))
            beside = combined(gamma[i], K)
            k = shifted(plus(f(seen), applied(of_f, beside)))
            missed = plus(_residual(g, start, seen), applied(of_g, beside))
            by = residue(1 / (alpha[i][i] + gamma[i][i])) * solve % P
            K[i] = [*k, *plus(K[i][DIMENSION:], _times(by, missed))]
    new = plus(start, combined(b, K))
    return new[:DIMENSION], new[DIMENSION:]
