"""Searches for methods as one writes them in an afternoon: conditions tree by tree, NumPy, and
SciPy's SLSQP from random starts with derivatives by differences. No code of gark.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from math import factorial, prod
from time import process_time
from typing import TypeAlias

import numpy as np
from scipy.linalg import qr
from scipy.optimize import least_squares, minimize

Tree: TypeAlias = tuple[int, tuple["Tree", ...]]
"""The colour of the root, and the branches in a fixed order."""
Blocks: TypeAlias = Mapping[tuple[int, int], np.ndarray]
"""A block for each colour of a stage and colour of a slope that it sees."""
Weights: TypeAlias = Sequence[np.ndarray]
ACCURACY = 1e-9
"""A start succeeds if its equations hold to so much."""


TIGHT = {"ftol": 1e-15, "xtol": 1e-15, "gtol": 1e-15}


@dataclass(frozen=True)
class Problem:
    """What is searched.

    Attributes:
        objective: to be made small.
        equations: to be 0.
        inequalities: to be at least 0; None for none.
        draw: a random start.
    """

    objective: Callable[[np.ndarray], float]
    equations: Callable[[np.ndarray], np.ndarray]
    inequalities: Callable[[np.ndarray], np.ndarray] | None
    draw: Callable[[np.random.Generator], np.ndarray]


def least(problem: Problem, starts: int, most: float = 60.0) -> tuple[float | None, int]:
    """The least objective over the starts that succeed, None if none does, and how many starts were
    made in so many seconds of the processor.

    A start first solves the equations alone; SLSQP then sees those that are independent there.
    """
    generator = np.random.default_rng(1)
    values: list[float] = []
    end = process_time() + most
    for start in range(starts):
        with np.errstate(all="ignore"), suppress(TimeoutError):
            values += _one(problem, generator, end)
        if process_time() > end:
            return min(values, default=None), start
    return min(values, default=None), starts


def _one(problem: Problem, generator: np.random.Generator, end: float) -> list[float]:
    """The objective at the end of a start; nothing where it fails."""

    def equations(x: np.ndarray) -> np.ndarray:
        if process_time() > end:
            raise TimeoutError
        return problem.equations(x)

    solution = least_squares(equations, problem.draw(generator), max_nfev=200, **TIGHT)
    if np.max(np.abs(solution.fun)) > ACCURACY:
        return []
    _, triangle, rows = qr(solution.jac.T, mode="economic", pivoting=True)
    sizes = np.abs(np.diag(triangle))
    rows = rows[: len(sizes)][sizes > 1e-5 * sizes[0]]
    constraints = [{"type": "eq", "fun": lambda x: equations(x)[rows]}]
    if problem.inequalities is not None:
        constraints.append({"type": "ineq", "fun": problem.inequalities})
    found = minimize(
        problem.objective,
        solution.x,
        constraints=constraints,
        method="SLSQP",
        options={"maxiter": 300, "ftol": 1e-12},
    ).x
    signs = [] if problem.inequalities is None else problem.inequalities(found)
    is_solution = np.max(np.abs(equations(found))) < ACCURACY
    if is_solution and np.min(signs, initial=0.0) > -ACCURACY:
        return [problem.objective(found)]
    return []


@cache
def trees(order: int, pairs: frozenset[tuple[int, int]]) -> list[Tree]:
    """All trees of an order whose branches have colours that their parents see."""
    found = set()
    for root in {k for k, _ in pairs}:
        if order == 1:
            found.add((root, ()))
        for size in range(1, order):
            for branch in trees(size, pairs):
                if (root, branch[0]) in pairs:
                    for stem_root, branches in trees(order - size, pairs):
                        if stem_root == root:
                            found.add((root, tuple(sorted((*branches, branch)))))
    return sorted(found)


def size(tree: Tree) -> int:
    return 1 + sum(map(size, tree[1]))


def density(tree: Tree) -> int:
    return size(tree) * prod(map(density, tree[1]))


def symmetry(tree: Tree) -> int:
    branches = tree[1]
    return prod(map(symmetry, branches)) * prod(
        factorial(branches.count(branch)) for branch in {*branches}
    )


def residuals(blocks: Blocks, weights: Weights, order: int, scaled: bool = False) -> np.ndarray:
    """b·Φ(t) − 1/γ(t) for all trees of one order, or those over σ(t)."""
    values: dict[Tree, np.ndarray] = {}

    def stages(tree: Tree) -> np.ndarray:
        if tree not in values:
            root, branches = tree
            values[tree] = prod(
                (blocks[root, branch[0]] @ stages(branch) for branch in branches),
                start=np.ones(len(weights[root])),
            )
        return values[tree]

    every = trees(order, frozenset(blocks))
    found = np.array([weights[t[0]] @ stages(t) - 1 / density(t) for t in every])
    return found / [symmetry(t) for t in every] if scaled else found


def upto(blocks: Blocks, weights: Weights, order: int) -> np.ndarray:
    """The residuals of all trees up to an order."""
    return np.concatenate([residuals(blocks, weights, p) for p in range(1, order + 1)])


def squared_error(blocks: Blocks, weights: Weights, order: int) -> float:
    """Σ e(u)² over the trees of the order after that of the method."""
    return float(np.sum(residuals(blocks, weights, order + 1, scaled=True) ** 2))


def one_part(A: np.ndarray, b: np.ndarray) -> tuple[Blocks, Weights]:
    return {(0, 0): A}, [b]


def additive(parts: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[Blocks, Weights]:
    """All parts have the same stages, and each stage sees all parts."""
    colours = range(len(parts))
    return {(k, l): parts[l][0] for k in colours for l in colours}, [b for _, b in parts]


def lower(x: np.ndarray, stages: int, diagonal: int = -1) -> np.ndarray:
    """A triangle with entries from the beginning of x, by rows."""
    A = np.zeros((stages, stages))
    rows = np.tril_indices(stages, diagonal)
    A[rows] = x[: len(rows[0])]
    return A


def stability(A: np.ndarray, b: np.ndarray, z: np.ndarray) -> np.ndarray:
    """R(z) at points."""
    s = len(b)
    slopes = np.linalg.solve(np.eye(s) - z[:, None, None] * A, np.ones((len(z), s, 1)))
    return 1 + z * (b @ slopes[..., 0].T)


AXIS = 1j * (1 / (np.arange(1, 41) / 41) - 1) ** 1.5
"""Points of the imaginary axis where A-stability is looked at."""


def contractive(A: np.ndarray, b: np.ndarray, r: float) -> np.ndarray:
    """The entries that must not be negative where the SSP coefficient is at least r."""
    s = len(b)
    K = np.zeros((s + 1, s + 1))
    K[:s, :s], K[s, :s] = A, b
    M = np.linalg.inv(np.eye(s + 1) + r * K)
    return np.concatenate([(M @ K)[np.tril_indices(s + 1, -1)], M.sum(1)])
