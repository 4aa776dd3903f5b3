"""The order of multirate infinitesimal methods without trees and without gark: one step as a power
series in h, its fast problems solved exactly, against the Taylor series of the solution.

Numbers are those modulo a prime. A value on the way from τ = 0 to 1 is a polynomial in τ for each
power of h, so that integrals over τ are exact. The vector fields are random, as in
``rosenbrock_series``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from random import Random
from typing import Literal, TypeAlias

from tests.oracles.rosenbrock_series import DIMENSION, Field, P, random_field, residue

Polynomial: TypeAlias = list[int]
"""Coefficients of τ⁰, τ¹, …"""
Series: TypeAlias = list[Polynomial]
"""A polynomial in τ for each of h⁰, h¹, …"""
State: TypeAlias = list[Series]
"""A series a component."""
Row: TypeAlias = Sequence[Fraction]
Matrix: TypeAlias = Sequence[Row]
Kind: TypeAlias = Literal["mri", "merk", "sr", "mis", "predictor"]


@dataclass(frozen=True)
class Method:
    """A method as its paper prints it.

    ``forcing[m][k][i]`` is the row of τ^k that leads to stage i + 1, for the slow part m. ``gamma``
    is what is added after the fast problems of ``sr`` to the last slow part, or γ of ``mis``, with
    ``alpha``; for ``predictor`` alpha is the matrix A of the slow method, which takes the step for both parts
    first, and the last rows of ``forcing`` are its interpolating polynomials.
    """

    kind: Kind
    c: Row
    forcing: Sequence[Sequence[Matrix]]
    alpha: Matrix = field(default_factory=list)
    gamma: Matrix = field(default_factory=list)


def plus(*states: State) -> State:
    """The sum of states."""
    return [[_sum(x) for x in zip(*rows, strict=True)] for rows in zip(*states, strict=True)]


def _sum(parts: Sequence[Polynomial]) -> Polynomial:
    length = max(map(len, parts))
    return [sum(p[k] for p in parts if k < len(p)) % P for k in range(length)]


def scaled(factor: int, x: State) -> State:
    """A number times a state."""
    return [[[factor * a % P for a in p] for p in row] for row in x]


def mixed(row: Row, states: Sequence[State]) -> list[State]:
    """The states that a row weighs, each with its weight."""
    return [scaled(residue(w), x) for w, x in zip(row, states, strict=False) if w]


def times(u: Series, v: Series) -> Series:
    """The product of two series."""
    found: Series = []
    for n in range(len(u)):
        total: Polynomial = []
        for k in range(n + 1):
            p, q = u[k], v[n - k]
            total += [0] * (len(p) + len(q) - 1 - len(total)) if p and q else []
            for i, x in enumerate(p):
                for j, y in enumerate(q):
                    total[i + j] += x * y
        found.append([x % P for x in total])
    return found


def value(f: Field, x: State) -> State:
    """A field along a value."""
    powers = len(x[0])
    found = []
    for forms in f.forms:
        product: Series = [[1], *([] for _ in range(powers - 1))]
        for *weights, constant in forms:
            start: Series = [[constant], *([] for _ in range(powers - 1))]
            [form] = plus([start], *([scaled(w, [y])[0]] for w, y in zip(weights, x, strict=True)))
            product = times(product, form)
        found.append(product)
    return found


def times_h(x: State) -> State:
    """The state times h."""
    return [[[], *row[:-1]] for row in x]


def times_tau(x: State, power: int) -> State:
    """The state times a power of τ."""
    return [[[0] * power + p if p else [] for p in row] for row in x]


def integrated(x: State) -> State:
    """∫_0^τ."""
    return [
        [[0, *(a * pow(k, -1, P) % P for k, a in enumerate(p, start=1))] if p else [] for p in row]
        for row in x
    ]


def at(tau: int, x: State) -> State:
    """The state at one τ, which does not depend on τ any more."""
    return [
        [[sum(a * pow(tau, k, P) for k, a in enumerate(p)) % P] if p else [] for p in row]
        for row in x
    ]


def order(method: Method, limit: int, seed: int = 0) -> int:
    """The number of powers of h, at most ``limit``, in which a step agrees with the solution."""
    dice = Random(seed)
    fields = [
        random_field(DIMENSION, DIMENSION, limit - 1, dice) for _ in range(len(method.forcing) + 1)
    ]
    start: State = [[[dice.randrange(P)], *([] for _ in range(limit))] for _ in range(DIMENSION)]
    exact = start
    for _ in range(limit):  # τ from 0 to 1 is the step
        exact = plus(start, integrated(times_h(plus(*(value(f, exact) for f in fields)))))
    ends = [at(1, x) for x in (exact, _step(method, fields, start, limit))]
    powers = zip(*([[*zip(*x, strict=True)] for x in ends]), strict=True)
    same = [all((p or [0]) == (q or [0]) for p, q in zip(x, y, strict=True)) for x, y in powers]
    return [*same, False].index(False) - 1


def _step(method: Method, fields: Sequence[Field], start: State, limit: int) -> State:
    """y_1; each iteration gains one power of h."""
    fast, *slow = fields
    count = len(method.c)
    first = count - 2 if method.kind == "predictor" else 0
    stages = [start] * count
    on_the_way = [start] * count
    for _ in range(limit + 1):
        slopes = [[times_h(value(g, y)) for y in stages] for g in slow]
        if method.kind == "predictor":
            of_fast = [times_h(value(fast, y)) for y in stages]
            both = [plus(*x) for x in zip(of_fast, *slopes, strict=True)]
            stages = [*(plus(start, *mixed(row, both)) for row in method.alpha), stages[-1]]
        for i in range(first, count - 1):
            problem = _problem(method, i, start, stages)
            moved = scaled(problem.width, times_h(value(fast, on_the_way[i])))
            grown = [integrated(x) for x in (moved, *problem.drift)]
            on_the_way[i] = plus(problem.begin, *grown, *_forced(method, i, slopes))
            after = mixed(method.gamma[i], slopes[-1]) if method.kind == "sr" else []
            stages[i + 1] = plus(at(problem.end, on_the_way[i]), *after)
    return stages[-1]


def _forced(method: Method, i: int, slopes: Sequence[Sequence[State]]) -> list[State]:
    """The slow slopes times their polynomials in τ, integrated."""
    return [
        integrated(times_tau(x, k))
        for powers, of_part in zip(method.forcing, slopes, strict=True)
        for k, matrix in enumerate(powers)
        for x in mixed(matrix[i], of_part)
    ]


@dataclass(frozen=True)
class Problem:
    """A fast problem dv/dτ = h width f(v) + drift + …, from ``begin`` until τ = ``end``."""

    begin: State
    width: int = 1
    drift: Sequence[State] = ()
    end: int = 1


def _problem(method: Method, i: int, start: State, stages: Sequence[State]) -> Problem:
    """That which leads to stage i + 1."""
    match method.kind:
        case "mri":
            return Problem(stages[i], residue(method.c[i + 1] - method.c[i]))
        case "sr":
            return Problem(start, residue(method.c[i + 1]))
        case "mis":
            increments = [plus(y, scaled(P - 1, start)) for y in stages]
            begin = plus(start, *mixed(method.alpha[i], increments))
            width = residue(sum(method.forcing[0][0][i], Fraction(0)))
            return Problem(begin, width, mixed(method.gamma[i], increments))
    return Problem(start, end=residue(method.c[i + 1]))  # τ is the time of the step
