"""Tasks of designers as plain programs, a function each, see ``plain_search``."""

from __future__ import annotations

from collections.abc import Callable
from math import factorial, prod

import numpy as np

from tests.benchmarks.plain_search import (
    AXIS,
    Blocks,
    Problem,
    Weights,
    additive,
    contractive,
    lower,
    one_part,
    residuals,
    squared_error,
    stability,
    upto,
)

Method = Callable[[np.ndarray], tuple[Blocks, Weights]]


def uniform(length: int, low: float = -1.0, high: float = 1.0) -> Callable[..., np.ndarray]:
    return lambda generator: generator.uniform(low, high, length)


def least_error(method: Method, order: int, length: int) -> Problem:
    """Σ e(u)² of a method of an order."""
    return Problem(
        lambda x: squared_error(*method(x), order),
        lambda x: upto(*method(x), order),
        None,
        uniform(length),
    )


def explicit(x: np.ndarray, stages: int) -> tuple[np.ndarray, np.ndarray]:
    return lower(x, stages), x[-stages:]


def explicit_error(stages: int, order: int) -> Problem:
    return least_error(lambda x: one_part(*explicit(x, stages)), order, stages * (stages + 1) // 2)


def ssp(stages: int, order: int) -> Problem:
    """The SSP coefficient is the last number."""
    return Problem(
        lambda x: -x[-1],
        lambda x: upto(*one_part(*explicit(x[:-1], stages)), order),
        lambda x: contractive(*explicit(x[:-1], stages), x[-1]),
        lambda generator: np.append(generator.random(stages * (stages + 1) // 2), 0.1),
    )


def fsal(x: np.ndarray, stages: int) -> tuple[np.ndarray, np.ndarray]:
    A = lower(x, stages)
    return A, A[-1]


def fsal_error(stages: int, order: int) -> Problem:
    """The second weight is 0."""
    problem = least_error(lambda x: one_part(*fsal(x, stages)), order, stages * (stages - 1) // 2)
    return Problem(
        problem.objective,
        lambda x: np.append(problem.equations(x), fsal(x, stages)[1][1]),
        None,
        problem.draw,
    )


def fsal_pair(A: np.ndarray, embedded: np.ndarray, order: int, largest: float) -> Problem:
    """A pair of orders p and p − 1 from a given start, with coefficients up to a size."""
    stages = len(embedded)
    count = stages * (stages - 1) // 2

    def equations(x: np.ndarray) -> np.ndarray:
        A, b = fsal(x, stages)
        return np.append(
            upto(*one_part(A, b), order), [*upto(*one_part(A, x[count:]), order - 1), b[1]]
        )

    return Problem(
        lambda x: squared_error(*one_part(*fsal(x, stages)), order),
        equations,
        lambda x: np.append(largest - x, largest + x),
        lambda _: np.append(A[np.tril_indices(stages, -1)], embedded),
    )


def esdirk(x: np.ndarray, stages: int) -> tuple[np.ndarray, np.ndarray]:
    """Its last row is b; γ is the first number."""
    A = lower(x[1:], stages)
    A += np.diag([0.0, *[x[0]] * (stages - 1)])
    return A, A[-1]


def damping(A: np.ndarray) -> float:
    """R(∞) of an ESDIRK method whose last row is b."""
    return float(np.linalg.solve(A[1:, 1:], A[1:, 0])[-1])


def esdirk_error(stages: int, order: int) -> Problem:
    """Stages of order 2, L-stable, nodes in [0, 1], γ between 1/5 and 1/2."""

    def equations(x: np.ndarray) -> np.ndarray:
        A, b = esdirk(x, stages)
        c = A.sum(1)
        rows = (A @ c - c**2 / 2)[1:]
        return np.concatenate([upto(*one_part(A, b), order), rows, [damping(A)]])

    def signs(x: np.ndarray) -> np.ndarray:
        A, b = esdirk(x, stages)
        c = A.sum(1)
        return np.concatenate(
            [1 - np.abs(stability(A, b, AXIS)), c, 1 - c, [x[0] - 0.2, 0.5 - x[0]]]
        )

    return Problem(
        lambda x: squared_error(*one_part(*esdirk(x, stages)), order),
        equations,
        signs,
        lambda generator: np.append(
            generator.uniform(0.1, 0.5), generator.uniform(-1, 1, stages * (stages - 1) // 2)
        ),
    )


def sdirk_error() -> Problem:
    """Three stages, order 3, the last row b, L-stable."""

    def method(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        A = lower(x[1:], 3) + x[0] * np.eye(3)
        return A, A[-1]

    return Problem(
        lambda x: squared_error(*one_part(*method(x)), 3),
        lambda x: upto(*one_part(*method(x)), 3),
        lambda x: 1 - np.abs(stability(*method(x), AXIS)),
        lambda generator: np.append(generator.uniform(0.1, 1), generator.uniform(-1, 1, 3)),
    )


def crouzeix_error() -> Problem:
    """Two stages with one diagonal entry, order 3, A-stable."""

    def method(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return lower(x[3:], 2) + x[0] * np.eye(2), x[1:3]

    return Problem(
        lambda x: squared_error(*one_part(*method(x)), 3),
        lambda x: upto(*one_part(*method(x)), 3),
        lambda x: 1 - np.abs(stability(*method(x), AXIS)),
        lambda generator: np.append(generator.uniform(0.1, 1), generator.uniform(-1, 1, 3)),
    )


def imex_error(stages: int, order: int, largest: float) -> Problem:
    """An explicit and an ESDIRK part with the same weights and nodes, the latter with R(∞) = 0 and
    γ between 1/5 and ``largest``.
    """

    def parts(x: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
        count = 1 + stages * (stages - 1) // 2
        implicit, b = esdirk(x[:count], stages)
        return [(lower(x[count:], stages), b), (implicit, b)]

    def equations(x: np.ndarray) -> np.ndarray:
        (E, _), (A, _) = parts(x)
        nodes = E.sum(1) - A.sum(1)
        return np.concatenate([upto(*additive(parts(x)), order), nodes, [damping(A)]])

    return Problem(
        lambda x: squared_error(*additive(parts(x)), order),
        equations,
        lambda x: np.array([x[0] - 0.2, largest - x[0]]),
        lambda generator: np.append(
            generator.uniform(0.1, 0.5), generator.uniform(-1, 1, stages * (stages - 1))
        ),
    )


def low_storage(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two registers: the slope A_i d + k_i, and the sum of B_i d."""
    stages = (len(x) + 1) // 2
    rows = np.zeros((stages + 1, stages))
    slope = np.zeros(stages)
    for i in range(stages):
        slope = (x[stages + i - 1] if i else 0.0) * slope
        slope[i] = 1.0
        rows[i + 1] = rows[i] + x[i] * slope
    return rows[:-1], rows[-1]


def low_storage_interval(stages: int, order: int) -> Problem:
    """The interval of the imaginary axis is the last number."""
    points = np.arange(1, 41) / 40
    return Problem(
        lambda x: -x[-1],
        lambda x: upto(*one_part(*low_storage(x[:-1])), order),
        lambda x: (
            (1 - np.abs(stability(*low_storage(x[:-1]), 1j * x[-1] * points)) ** 2)
            / points ** (order + 1)
        ),
        lambda generator: np.append(
            [*generator.uniform(0, 1, stages), *generator.uniform(-1, 0, stages - 1)], 1.0
        ),
    )


Force = tuple[int, tuple["Force", ...]]
"""A value of the force: how many velocities its derivative sees, and which forces."""


def degree(tree: Force) -> int:
    """The power of the step in it."""
    return tree[0] + sum(degree(force) + 2 for force in tree[1])


def forces(power: int) -> list[Force]:
    """All with that power of the step."""
    if power == 0:
        return [(0, ())]
    found = {(n + 1, inner) for n, inner in forces(power - 1)}
    for e in range(power - 1):
        for force in forces(e):
            found |= {(n, tuple(sorted((*inner, force)))) for n, inner in forces(power - 2 - e)}
    return sorted(found)


def nystrom_error() -> Problem:
    """q″ = f(q), four explicit stages, order 5; the weights of q are b (1 − c)."""

    def parts(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        c, b = np.array([0.0, *x[6:9]]), x[9:]
        return lower(x, 4), c, b, b * (1 - c)

    def value(force: Force, A: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, float, int]:
        n, inner = force
        stages, exact, symmetry = c**n, 1.0, factorial(n)
        for x in inner:
            of_stages, of_exact, own = value(x, A, c)
            stages = stages * (A @ of_stages)
            exact *= of_exact / ((degree(x) + 1) * (degree(x) + 2))
            symmetry *= own
        return stages, exact, symmetry * prod(factorial(inner.count(x)) for x in {*inner})

    def defects(x: np.ndarray, order: int, scaled: bool = False) -> np.ndarray:
        A, c, b, of_positions = parts(x)
        found = []
        for power, weights, share in (
            (order - 1, b, order),
            (order - 2, of_positions, order * (order - 1)),
        ):
            for force in forces(power) if power >= 0 else []:
                stages, exact, symmetry = value(force, A, c)
                found.append((weights @ stages - exact / share) / (symmetry if scaled else 1))
        return np.array(found)

    return Problem(
        lambda x: float(np.sum(defects(x, 6, scaled=True) ** 2)),
        lambda x: np.concatenate([defects(x, order) for order in range(1, 6)]),
        None,
        uniform(13, 0.0),
    )


def composition_error(stages: int, order: int) -> Problem:
    """Implicit midpoint rules, one after the other, the same backwards."""

    def method(x: np.ndarray) -> tuple[Blocks, Weights]:
        b = np.array([*x, 1 - 2 * np.sum(x), *x[::-1]])
        return one_part(np.tril(np.tile(b, (stages, 1)), -1) + np.diag(b / 2), b)

    odd = range(3, order, 2)
    return Problem(
        lambda x: squared_error(*method(x), order),
        lambda x: np.concatenate([residuals(*method(x), p) for p in odd]),
        None,
        uniform(stages // 2, -0.5, 0.5),
    )


def splitting_error() -> Problem:
    """Seven and six maps of two parts, one after the other, the same backwards; order 4."""

    def method(x: np.ndarray) -> tuple[Blocks, Weights]:
        a = np.array([*x[:3], 1 - 2 * np.sum(x[:3]), *x[2::-1]])
        b = np.array([*x[3:], 0.5 - np.sum(x[3:])])
        b = np.array([*b, *b[::-1]])
        blocks = {(0, 1): np.tril(np.tile(b, (7, 1)), -1), (1, 0): np.tril(np.tile(a, (6, 1)))}
        return blocks, [a, b]

    return Problem(
        lambda x: squared_error(*method(x), 4),
        lambda x: residuals(*method(x), 3),
        None,
        uniform(5, -0.3, 0.6),
    )


def rosenbrock_error() -> Problem:
    """Four stages, order 4, order 2 with any matrix, L-stable. A vertex with one branch sees β."""

    def parts(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        alpha = lower(x[1:], 4)
        return alpha, alpha + lower(x[7:], 4) + x[0] * np.eye(4), x[13:]

    def defects(x: np.ndarray, order: int) -> np.ndarray:
        alpha, beta, b = parts(x)
        one = np.ones(4)
        c, e = alpha @ one, beta @ one
        every = {
            1: [(one, 1, 1)],
            2: [(e, 2, 1)],
            3: [(c**2, 3, 2), (beta @ e, 6, 1)],
            4: [
                (c**3, 4, 6),
                (c * (alpha @ e), 8, 1),
                (beta @ c**2, 12, 2),
                (beta @ beta @ e, 24, 1),
            ],
            5: [
                (c**4, 5, 24),
                (c**2 * (alpha @ e), 10, 2),
                (c * (alpha @ c**2), 15, 2),
                (c * (alpha @ beta @ e), 30, 1),
                ((alpha @ e) ** 2, 20, 2),
                (beta @ c**3, 20, 6),
                (beta @ (c * (alpha @ e)), 40, 1),
                (beta @ beta @ c**2, 60, 2),
                (beta @ beta @ beta @ e, 120, 1),
            ],
        }
        return np.array([(b @ v - 1 / density) / sigma for v, density, sigma in every[order]])

    def equations(x: np.ndarray) -> np.ndarray:
        alpha, beta, b = parts(x)
        orders = [defects(x, p) for p in range(1, 5)]
        return np.concatenate(
            [*orders, [b @ alpha.sum(1) - 0.5, 1 - b @ np.linalg.solve(beta, np.ones(4))]]
        )

    return Problem(
        lambda x: float(np.sum(defects(x, 5) ** 2)),
        equations,
        lambda x: 1 - np.abs(stability(parts(x)[1], parts(x)[2], AXIS)),
        lambda generator: np.append(generator.uniform(0.1, 0.9), generator.uniform(-1, 1, 16)),
    )


def multirate(gamma: np.ndarray, nodes: np.ndarray) -> tuple[Blocks, Weights]:
    """An infinitesimal method, Gauss' collocation of three stages for each of its fast problems.

    Args:
        gamma: shape (powers of τ, slow stages and the step, slow stages).
        nodes: those of the stages, and 1.
    """
    x, w = np.polynomial.legendre.leggauss(3)
    tau, w = (x + 1) / 2, w / 2
    powers = np.vander(tau, 3, increasing=True)
    collocation = (powers * tau[:, None] / [1, 2, 3]) @ np.linalg.inv(powers)
    lengths = np.diff(nodes)
    steps, s = gamma.shape[1], gamma.shape[2]
    shares = gamma / np.arange(1, len(gamma) + 1)[:, None, None]
    ends = np.concatenate([np.zeros((1, s)), np.cumsum(shares.sum(0), 0)])
    forcing = [
        ends[i] + sum(share[i] * tau[:, None] ** (k + 1) for k, share in enumerate(shares))
        for i in range(steps)
    ]
    fast = np.kron(lengths, w)
    inner = np.kron(np.diag(lengths), collocation)
    inner += np.kron(np.tril(np.ones((steps, steps)), -1), np.ones((3, 3))) * fast
    before = np.kron(np.tril(np.ones((s, steps)), -1), np.ones((1, 3))) * fast
    blocks = {(0, 0): inner, (0, 1): np.concatenate(forcing), (1, 0): before, (1, 1): ends[:s]}
    return blocks, [fast, ends[s]]


def multirate_error(nodes: tuple[float, ...], order: int) -> Problem:
    """Explicit, linear in τ; the first power integrates to the nodes."""
    s = len(nodes)
    lengths = np.diff([*nodes, 1.0])
    rows = np.tril_indices(s)

    def method(x: np.ndarray) -> tuple[Blocks, Weights]:
        gamma = np.zeros((2, s, s))
        gamma[:, *rows] = x.reshape(2, -1)
        return multirate(gamma, np.array([*nodes, 1.0]))

    def equations(x: np.ndarray) -> np.ndarray:
        gamma = np.zeros((2, s, s))
        gamma[:, *rows] = x.reshape(2, -1)
        return np.concatenate([gamma[0].sum(1) - lengths, gamma[1].sum(1), upto(*method(x), order)])

    return Problem(
        lambda x: squared_error(*method(x), order), equations, None, uniform(2 * len(rows[0]))
    )
