"""The order of methods that use derivatives of f, without trees and without gark: one step as a
power series in h on a random field, against the Taylor series, modulo a prime.

The derivatives of f along the solution through a stage are those of the solution itself, as a power
series in a second variable.
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
    Series,
    State,
    combined,
    plus,
    random_field,
    shifted,
    times,
)

Jet = list[State]
"""The coefficients of 1, ε, ε², …, a state each."""


def order(A: Sequence[Matrix], b: Matrix, limit: int, seed: int = 0) -> int:
    """The number of powers of h, at most ``limit``, in which a step agrees with the solution.

    Args:
        A: a matrix for f, one for f′f, …; all of one shape.
        b: the weights of each.
        limit: the degree of the field less one.
        seed: of the field.
    """
    dice = Random(seed)
    f = random_field(DIMENSION, DIMENSION, limit - 1, dice)
    y = [[dice.randrange(P)] + [0] * limit for _ in range(DIMENSION)]
    s = range(len(b[0]))

    def value(weights: Sequence[Sequence[Fraction]], jets: Sequence[Jet]) -> State:
        parts = [combined(row, [jet[k] for jet in jets]) for k, row in enumerate(weights)]
        return plus(y, *parts)

    stages = [y for _ in s]
    for _ in range(limit):
        jets = [_derivatives(f, x, len(b)) for x in stages]
        stages = [value([matrix[i] for matrix in A], jets) for i in s]
    step = value(b, [_derivatives(f, x, len(b)) for x in stages])
    exact = y
    for _ in range(limit):
        slope = f(exact)
        exact = plus(
            y, [[0, *(x * pow(n, -1, P) % P for n, x in enumerate(row[:-1], 1))] for row in slope]
        )
    powers = zip(zip(*exact, strict=True), zip(*step, strict=True), strict=True)
    return next((n for n, (u, v) in enumerate(powers) if u != v), limit + 1) - 1


def _derivatives(f: Field, start: State, count: int) -> list[State]:
    """The h^k f_k at a state, k = 1, 2, …: derivatives of z with dz/dε = h f(z), z(0) = start."""
    z: Jet = [start]
    found: list[State] = []
    factorial = 1
    for k in range(count):
        slope = shifted(_at(f, z)[k])
        inverse = pow(k + 1, -1, P)
        z.append([[x * inverse % P for x in row] for row in slope])
        factorial = factorial * (k + 1)
        found.append([[x * factorial % P for x in row] for row in z[-1]])
    return found


def _at(f: Field, z: Jet) -> Jet:
    """The field at a jet, as many coefficients as that has."""
    found: list[list[Series]] = []
    zero = [0] * len(z[0][0])
    for forms in f.forms:
        value = [[1, *zero[1:]], *[zero] * (len(z) - 1)]
        for *weights, constant in forms:
            form = [
                [
                    sum(w * x for w, x in zip(weights, column, strict=True)) % P
                    for column in zip(*x, strict=True)
                ]
                for x in z
            ]
            form[0] = [form[0][0] + constant, *form[0][1:]]
            value = [
                [
                    sum(x) % P
                    for x in zip(*(times(value[i], form[k - i]) for i in range(k + 1)), strict=True)
                ]
                for k in range(len(z))
            ]
        found.append(value)
    return [[component[k] for component in found] for k in range(len(z))]
