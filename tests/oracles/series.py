"""The order without trees: one step of the method as a power series in h, against the Taylor series
of the flow.

Each colour l drives components of its own, ẋ_l = f_l, and f_l is a polynomial in the components of
the colours that l sees. That is the partitioned form of ẏ = Σ f_l(y), and it makes absent edges
true. Each component of f_l is a product of random affine forms, as many as the order looked for
(one for a linear colour), so that all its derivatives up to that degree are there. Coefficients are
small rational numbers and x(0) = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import TypeAlias

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector
from garkcli.tableau.tableau import Tableau
from tests.oracles.stages import image, one, pairing, product

Component: TypeAlias = tuple[int, int]
"""Component i of what colour m drives, as (m, i)."""
Series: TypeAlias = list[Vector]
"""Coefficients of h⁰, h¹, …; each of them an element of a stage space."""
Product: TypeAlias = Callable[[Vector, Vector], Vector]


@dataclass(frozen=True)
class Affine:
    """α + Σ w x over components."""

    constant: fmpq
    weights: Mapping[Component, fmpq]


@dataclass(frozen=True)
class Problem:
    """``fields[l, i]`` are the affine forms whose product is component i of f_l."""

    fields: Mapping[Component, Sequence[Affine]]


def random_problem(tableau: Tableau, degree: int, dice: Random) -> Problem:
    """A problem in which each colour depends on what it sees, and on nothing else."""
    dimension = 3 if tableau.size == 1 else 2
    fields: dict[Component, Sequence[Affine]] = {}
    for l, colour in enumerate(tableau.colours):
        seen = [
            (m, i)
            for m in range(tableau.size)
            if tableau.block(l, m) is not None
            for i in range(dimension)
        ]
        factors = 1 if colour.is_linear else max(degree, 1)
        for i in range(dimension):
            fields[l, i] = [_random_form(seen, dice) for _ in range(factors)]
    return Problem(fields)


def _random_form(seen: Sequence[Component], dice: Random) -> Affine:
    def small() -> fmpq:
        return fmpq(dice.choice([-3, -2, -1, 1, 2, 3]), dice.choice([1, 1, 2]))

    return Affine(small(), {component: small() for component in seen})


def flow(problem: Problem, powers: int) -> dict[Component, list[Number]]:
    """The solution x(h) up to h^powers, by Picard iteration."""
    x: dict[Component, Series] = {key: [(fmpq(0),)] for key in problem.fields}
    for known in range(powers):
        f = {
            key: _field(forms, x, known, (fmpq(1),), lambda u, v: (u[0] * v[0],))
            for key, forms in problem.fields.items()
        }
        x = {key: [(fmpq(0),), *((c[0] / n,) for n, c in enumerate(f[key], start=1))] for key in x}
    return {key: [c[0] for c in series] for key, series in x.items()}


def step(tableau: Tableau, problem: Problem, powers: int) -> dict[Component, list[Number]]:
    """One step from x = 0 up to h^powers; each iteration of the stage equations gains one power of
    h.
    """
    products = [product(space) for space in tableau.spaces]
    ones = [one(space) for space in tableau.spaces]
    zeros = [tuple(0 * x for x in v) for v in ones]
    f: dict[Component, Series] = {}
    for known in range(powers):
        stages = [
            {
                key: [zeros[k], *(image(tableau.blocks[k, key[0]], v) for v in f[key])]
                if f
                else [zeros[k]]
                for key in problem.fields
                if (k, key[0]) in tableau.blocks
            }
            for k in range(len(tableau.spaces))
        ]
        f = {}
        for (l, i), forms in problem.fields.items():
            rows = tableau.colours[l].space
            f[l, i] = _field(forms, stages[rows], known, ones[rows], products[rows])
    return {
        (l, i): [fmpq(0), *(pairing(tableau.colours[l].b, v) for v in f[l, i])]
        for l, i in problem.fields
    }


def _field(
    forms: Sequence[Affine],
    x: Mapping[Component, Series],
    powers: int,
    unit: Vector,
    times: Product,
) -> Series:
    """The product of affine forms in the series x, up to h^powers."""
    result: Series | None = None
    for form in forms:
        factor = list(_form(form, x, powers, unit))
        result = factor if result is None else _multiplied(result, factor, times)
    assert result is not None
    return result


def _form(
    form: Affine, x: Mapping[Component, Series], powers: int, unit: Vector
) -> Iterator[Vector]:
    for n in range(powers + 1):
        total: list[Number] = [form.constant * y if n == 0 else fmpq(0) for y in unit]
        for component, weight in form.weights.items():
            for k, y in enumerate(x[component][n]):
                total[k] = total[k] + weight * y
        yield tuple(total)


def _multiplied(u: Series, v: Series, times: Product) -> Series:
    result = []
    for n in range(len(u)):
        terms = [times(u[k], v[n - k]) for k in range(n + 1)]
        total = terms[0]
        for term in terms[1:]:
            total = tuple(x + y for x, y in zip(total, term, strict=True))
        result.append(total)
    return result


def series_order(tableau: Tableau, limit: int, seed: int = 0) -> int:
    """The number of powers of h, at most ``limit``, in which the step agrees with the flow."""
    problem = random_problem(tableau, limit - 1, Random(seed))
    exact, found = flow(problem, limit), step(tableau, problem, limit)
    agreeing = (
        n for n in range(1, limit + 1) if any(exact[key][n] != found[key][n] for key in exact)
    )
    return next(agreeing, limit + 1) - 1
