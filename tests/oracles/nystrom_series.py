"""The orders of Nyström methods without trees and without gark: one step as a power series in h,
against the Taylor series of the solution of a random q″ = g(q, q′), modulo a prime.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
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


@dataclass(frozen=True)
class Method:
    """Its coefficients as papers print them; without A the force depends on q alone."""

    Abar: Matrix
    A: Matrix | None
    c: Sequence[Fraction]
    bbar: Sequence[Fraction]
    b: Sequence[Fraction]


def orders(method: Method, limit: int, seed: int = 0, *, has_time: bool = False) -> tuple[int, int]:
    """The numbers of powers of h, at most ``limit``, in which q_1 and q′_1 agree with the solution;
    with time the force is g(t, q, q′), evaluated at t + c_i h.
    """
    dice = Random(seed)
    sees_velocity = method.A is not None
    inputs = DIMENSION * (1 + sees_velocity) + has_time
    force = random_field(inputs, DIMENSION, limit - 1, dice)
    q, v = ([[dice.randrange(P)] + [0] * limit for _ in range(DIMENSION)] for _ in "qv")
    start = dice.randrange(P)

    def g(positions: State, velocities: State, node: Fraction) -> State:
        clock = [start, node.numerator * pow(node.denominator, -1, P) % P, *[0] * limit]
        times = [clock[: limit + 1]] if has_time else []
        return force([*positions, *(velocities if sees_velocity else []), *times])

    zero = [[0] * (limit + 1) for _ in q]
    stages = [zero for _ in method.b]
    for _ in range(limit):
        stages = [
            g(
                plus(q, combined([c], [shifted(v)]), _twice(combined(row, stages))),
                plus(v, shifted(combined(slopes, stages))),
                c,
            )
            for c, row, slopes in zip(method.c, method.Abar, method.A or method.Abar, strict=True)
        ]
    step = (
        plus(q, shifted(v), _twice(combined(method.bbar, stages))),
        plus(v, shifted(combined(method.b, stages))),
    )
    exact_q, exact_v = q, v
    for _ in range(limit):
        slope = g(exact_q, exact_v, Fraction(1))
        exact_q, exact_v = plus(q, _integral(exact_v)), plus(v, _integral(slope))
    return _agree(step[0], exact_q), _agree(step[1], exact_v)


def _twice(x: State) -> State:
    return shifted(shifted(x))


def _integral(x: State) -> State:
    return [[0, *(y * pow(n, -1, P) % P for n, y in enumerate(row[:-1], start=1))] for row in x]


def _agree(x: State, y: State) -> int:
    powers = zip(zip(*x, strict=True), zip(*y, strict=True), strict=True)
    return next((n for n, (u, v) in enumerate(powers) if u != v), len(x[0])) - 1
