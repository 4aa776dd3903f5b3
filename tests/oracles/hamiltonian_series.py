"""Steps on random Hamiltonian problems as power series in h, with rational coefficients, and without
trees.

H = Σ_l Σ_k c (1 + a·y)^m, y = (q, p): all its derivatives are sums of powers. A term depends on q and
p as the colours of the method say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from math import perm
from operator import mul
from random import Random
from typing import TypeAlias

from flint import fmpq, fmpq_poly

from garkcli.ntrees.tree import Tree
from garkcli.stepping.fields import with_joined_terms
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Tableau

Point: TypeAlias = list[fmpq_poly]
"""(q, p), each a series in h."""


@dataclass(frozen=True)
class Ridge:
    """The function c (1 + a·y)^m."""

    c: fmpq
    a: tuple[fmpq, ...]
    m: int


@dataclass(frozen=True)
class Problem:
    """H = Σ H^{l}, for a tableau, modulo h^powers."""

    tableau: Tableau
    terms: tuple[tuple[Ridge, ...], ...]
    start: tuple[fmpq, ...]
    powers: int

    @property
    def d(self) -> int:
        """Degrees of freedom."""
        return len(self.start) // 2

    def cut(self, x: fmpq_poly) -> fmpq_poly:
        """Without the powers of h that nobody looks at."""
        return fmpq_poly([x[k] for k in range(self.powers)])

    def times(self, *factors: fmpq_poly) -> fmpq_poly:
        """A truncated product."""
        return reduce(lambda x, y: self.cut(x * y), factors, fmpq_poly([1]))

    def inner(self, a: Sequence[fmpq], v: Point) -> fmpq_poly:
        """a·v."""
        return sum(map(mul, v, a), fmpq_poly())

    def weights(self, term: int, y: Point, vectors: Sequence[Point]) -> list[fmpq_poly]:
        """For each ridge the derivative H^(k)(v_1, …, v_k) before the last factor a."""
        found = []
        for ridge in self.terms[term]:
            k = len(vectors)
            if k > ridge.m:
                found.append(fmpq_poly())
                continue
            form = self.inner(ridge.a, y) + 1
            powers = [form] * (ridge.m - k)
            along = [self.inner(ridge.a, v) for v in vectors]
            scale = fmpq_poly([ridge.c * perm(ridge.m, k)])
            found.append(self.times(scale, *powers, *along))
        return found

    def derivative(self, term: int, y: Point, vectors: Sequence[Point]) -> fmpq_poly:
        """H^{l}^(k)(v_1, …, v_k) at y."""
        return sum(self.weights(term, y, vectors), fmpq_poly())

    def energy(self, y: Point) -> fmpq_poly:
        """H(y)."""
        terms = range(len(self.terms))
        return sum((self.derivative(l, y, []) for l in terms), fmpq_poly())

    def field(self, colour: Colour, y: Point, vectors: Sequence[Point] = ()) -> Point:
        """The k-th derivative of the vector field of a colour along k vectors."""
        lowered = [self.lowered(ridge) for ridge in self.terms[colour.term]]
        lower = Problem(self.tableau, (tuple(lowered),), self.start, self.powers)
        weights = lower.weights(0, y, vectors)
        d, zero = self.d, fmpq_poly()
        result = [zero] * (2 * d)
        for ridge, weight in zip(self.terms[colour.term], weights, strict=True):
            for i in range(d):
                if colour.part != "p":
                    result[i] = result[i] + weight * ridge.a[d + i]
                if colour.part != "q":
                    result[d + i] = result[d + i] - weight * ridge.a[i]
        return result

    @staticmethod
    def lowered(ridge: Ridge) -> Ridge:
        """What the derivative of a ridge has as the factor of a."""
        return Ridge(ridge.c * ridge.m, ridge.a, ridge.m - 1)

    def elementary(self, tree: Tree, y: Point) -> Point:
        """F(u)(y), by its definition."""
        branches = [self.elementary(u, y) for u in tree.branches]
        return self.field(self.tableau.colours[tree.root], y, branches)

    def elementary_hamiltonian(self, tree: Tree, y: Point) -> fmpq_poly:
        """H(u)(y), by its definition."""
        branches = [self.elementary(u, y) for u in tree.branches]
        term = self.tableau.colours[tree.root].term
        return self.derivative(term, y, branches)


def random_problem(tableau: Tableau, powers: int, seed: int, d: int = 2) -> Problem:
    """A problem for a tableau with stages in points; coefficients are small rational numbers."""
    tableau = with_joined_terms(tableau)
    dice = Random(seed)
    count = 1 + max(x.term for x in tableau.colours)

    def small() -> fmpq:
        return fmpq(dice.choice([-3, -2, -1, 1, 2, 3]), dice.choice([1, 2]))

    terms = []
    for l in range(count):
        here = [x for x in tableau.colours if x.term == l]
        parts = {x.part for x in here}
        is_quadratic = all(x.is_linear for x in here)
        degree = 2 if is_quadratic else powers + 1
        # V^l is there where H^l depends on p, F^l where on q
        of_q = bool(parts & {"p", "y"})
        of_p = bool(parts & {"q", "y"})
        ridges = []
        for _ in range(3):
            a = [small() if of_q else fmpq(0) for _ in range(d)]
            a += [small() if of_p else fmpq(0) for _ in range(d)]
            ridges.append(Ridge(small(), tuple(a), degree))
        terms.append(tuple(ridges))
    start = tuple(small() / 4 for _ in range(2 * d))
    return Problem(tableau, tuple(terms), start, powers)


def step(problem: Problem) -> tuple[Point, list[Point]]:
    """y₁ and the columns of ∂y₁/∂y₀, each series in h; every iteration gains a power of h."""
    tableau, size = problem.tableau, 2 * problem.d
    start = [fmpq_poly([x]) for x in problem.start]
    unit = [[fmpq_poly([int(i == j)]) for i in range(size)] for j in range(size)]
    stages = []
    for space in tableau.spaces:
        assert isinstance(space, PointSpace)
        stages.append([(start, unit)] * space.stages)
    h = fmpq_poly([0, 1])
    for _ in range(problem.powers):
        slopes = []
        for colour in tableau.colours:
            values = []
            for y, tangents in stages[colour.space]:
                moved = [problem.field(colour, y, [v]) for v in tangents]
                values.append((problem.field(colour, y), moved))
            slopes.append(values)

        def moved_by(rows: dict[int, Sequence[fmpq]]) -> tuple[Point, list[Point]]:
            y, tangents = list(start), [list(v) for v in unit]
            for m, row in rows.items():
                for a, (f, df) in zip(row, slopes[m], strict=True):  # noqa: B023
                    for i in range(size):
                        y[i] = problem.cut(y[i] + h * a * f[i])
                        for j in range(size):
                            v = tangents[j]
                            v[i] = problem.cut(v[i] + h * a * df[j][i])
            return y, tangents

        stages = [
            [
                moved_by({m: B[i] for (k, m), B in tableau.blocks.items() if k == n})
                for i in range(space.stages)
            ]
            for n, space in enumerate(tableau.spaces)
        ]
    return moved_by({m: colour.b for m, colour in enumerate(tableau.colours)})


def lowest_power(series: Sequence[fmpq_poly], powers: int) -> int:
    """The lowest power of h in any of them; ``powers`` where there is none below."""
    for n in range(powers):
        if any(x[n] for x in series):
            return n
    return powers


def energy_order(problem: Problem) -> int:
    """The r with H(y₁) − H(y₀) = O(h^(r+1)), at most powers − 1."""
    y, _ = step(problem)
    start = [fmpq_poly([x]) for x in problem.start]
    change = problem.energy(y) - problem.energy(start)
    return lowest_power([change], problem.powers) - 1


def symplectic_order(problem: Problem) -> int:
    """The q with MᵀJM − J = O(h^(q+1)), at most powers − 1."""
    _, tangents = step(problem)
    d = problem.d
    entries = []
    for i, u in enumerate(tangents):
        for j, v in enumerate(tangents):
            form = fmpq_poly([-int(i + d == j) + int(j + d == i)])
            for k in range(d):
                form += problem.times(u[k], v[d + k]) - problem.times(u[d + k], v[k])
            entries.append(problem.cut(form))
    return lowest_power(entries, problem.powers) - 1
