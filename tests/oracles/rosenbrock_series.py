"""The order of Rosenbrock and W-methods without trees and without gark: one step as a power series
in h, against the Taylor series of the solution.

Numbers are those modulo a prime, series lists of coefficients of h⁰, h¹, …. The vector fields are
random: each component is a product of affine forms, as many as the order looked for, so that all
derivatives up to there are not zero; by chance a condition that fails looks met once in 10¹⁸.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from random import Random
from typing import Literal, TypeAlias

P = 2**61 - 1
DIMENSION = 2
Matrix: TypeAlias = Sequence[Sequence[Fraction]]
Series: TypeAlias = list[int]
State: TypeAlias = list[Series]
"""A series a component."""
Which: TypeAlias = Literal["exact", "any", "old"]
"""The matrix in the place of the Jacobian: itself, an arbitrary one, itself + O(h)."""


def residue(x: Fraction) -> int:
    """A fraction modulo P."""
    return x.numerator * pow(x.denominator, -1, P) % P


def times(u: Series, v: Series) -> Series:
    """The product of two series, up to the power that they have."""
    return [sum(u[k] * v[n - k] for k in range(n + 1)) % P for n in range(len(u))]


def shifted(x: State) -> State:
    """The state times h."""
    return [[0, *row[:-1]] for row in x]


def plus(*states: State) -> State:
    """The sum of states."""
    return [[sum(x) % P for x in zip(*rows, strict=True)] for rows in zip(*states, strict=True)]


def combined(weights: Sequence[Fraction], states: Sequence[State]) -> State:
    """Σ w_j x_j."""
    factors = [residue(w) for w in weights]
    return [
        [
            sum(f * x for f, x in zip(factors, column, strict=True)) % P
            for column in zip(*rows, strict=True)
        ]
        for rows in zip(*states, strict=True)
    ]


def applied(J: Sequence[Sequence[int]], x: State) -> State:
    """A matrix times a state."""
    columns = list(zip(*x, strict=True))
    return [
        [sum(a * y for a, y in zip(row, column, strict=True)) % P for column in columns]
        for row in J
    ]


@dataclass(frozen=True)
class Field:
    """A polynomial vector field: ``forms[i]`` are those whose product is component i, the constant
    last.
    """

    forms: Sequence[Sequence[Sequence[int]]]

    def __call__(self, x: State) -> State:
        one = [1] + [0] * (len(x[0]) - 1)
        found = []
        for forms in self.forms:
            value = one
            for *weights, constant in forms:
                [form] = applied([weights], x)
                form[0] += constant
                value = times(value, form)
            found.append(value)
        return found

    def jacobian(self, x: Sequence[int]) -> list[list[int]]:
        """At a point."""
        rows = []
        for forms in self.forms:
            values = [sum(w * y for w, y in zip(form, (*x, 1), strict=True)) for form in forms]
            others = [prod(values[:k] + values[k + 1 :]) for k in range(len(forms))]
            columns = range(len(x))
            rows.append(
                [sum(f[j] * y for f, y in zip(forms, others, strict=True)) % P for j in columns]
            )
        return rows


def random_field(inputs: int, outputs: int, degree: int, dice: Random) -> Field:
    """A field of some degree."""
    return Field(
        [
            [[dice.randrange(P) for _ in range(inputs + 1)] for _ in range(max(degree, 1))]
            for _ in range(outputs)
        ]
    )


@dataclass(frozen=True)
class Method:
    """α^{l,m}, γ^{l,m} and b^{l}; c and d where f depends on time too, of a method of one colour."""

    alpha: Sequence[Sequence[Matrix]]
    gamma: Sequence[Sequence[Matrix]]
    b: Sequence[Sequence[Fraction]]
    c: Sequence[Fraction] | None = None
    d: Sequence[Fraction] | None = None


def order(method: Method, which: Which, limit: int, seed: int = 0) -> int:
    """The number of powers of h, at most ``limit``, in which a step agrees with the solution."""
    dice = Random(seed)
    has_time = method.c is not None
    size = DIMENSION + has_time
    fields = [random_field(size, DIMENSION, limit - 1, dice) for _ in method.b]
    start = [[dice.randrange(P)] + [0] * limit for _ in range(DIMENSION)]
    clock = [dice.randrange(P), 1, *[0] * (limit - 1)][: limit + 1]
    point = [row[0] for row in start] + [clock[0]] * has_time

    exact = start
    for _ in range(limit):
        now = [*exact, clock] if has_time else exact
        slope = plus(*(f(now) for f in fields))
        grown = [
            [0, *(x * pow(n, -1, P) % P for n, x in enumerate(row[:-1], start=1))] for row in slope
        ]
        exact = plus(start, grown)
    step = _step(method, which, fields, start, point, dice)
    powers = zip(zip(*exact, strict=True), zip(*step, strict=True), strict=True)
    return next((n for n, (x, y) in enumerate(powers) if x != y), limit + 1) - 1


def _step(
    method: Method,
    which: Which,
    fields: Sequence[Field],
    start: State,
    point: Sequence[int],
    dice: Random,
) -> State:
    """y_1; each iteration of the stage equations gains one power of h."""
    length = len(start[0])
    zero = [[0] * length for _ in start]

    def random_matrix() -> list[list[int]]:
        return [[dice.randrange(P) for _ in start] for _ in start]

    full = [f.jacobian(point) for f in fields]
    J = [[row[:DIMENSION] for row in rows] for rows in full]
    if which == "any":
        J = [random_matrix() for _ in fields]
    errors = [random_matrix() for _ in fields] if which == "old" else None
    K = [[zero for _ in b] for b in method.b]
    for _ in range(length - 1):
        new = []
        for l, f in enumerate(fields):
            stages = []
            for i in range(len(method.b[l])):
                sums = [
                    plus(zero, *(combined(A[i], K[m]) for m, A in enumerate(blocks[l])))
                    for blocks in (method.alpha, method.gamma)
                ]
                seen = plus(start, sums[0])
                parts = [applied(J[l], sums[1])]
                if errors is not None:
                    parts.append(shifted(applied(errors[l], sums[1])))
                if method.c is not None and method.d is not None:
                    c, d = residue(method.c[i]), residue(method.d[i])
                    seen = [*seen, [point[-1], c, *[0] * (length - 2)]]
                    slopes = [row[-1] for row in full[l]]
                    parts.append([[0, d * x % P, *[0] * (length - 2)] for x in slopes])
                stages.append(shifted(plus(f(seen), *parts)))
            new.append(stages)
        K = new
    return plus(start, *(combined(b, K[l]) for l, b in enumerate(method.b)))
