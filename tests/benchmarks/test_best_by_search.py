"""The best method by a search, against a short program with SciPy alone in the same run."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from garkcli import loads_family, search_methods
from tests.benchmarks.measuring import assert_ratio, seconds

STAGES, STARTS = 5, 10


def radius_by_scipy() -> float:
    """The SSP coefficient of five stages of order 4 as one writes it in an afternoon: weights and
    entries below the diagonal, conditions up to order 4 as equations, r to be large; all
    derivatives by differences, the same number of starts.
    """
    s = STAGES
    lower = np.tril_indices(s, -1)

    def parts(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        A = np.zeros((s, s))
        A[lower] = x[: len(lower[0])]
        return A, x[len(lower[0]) : -1]

    def equations(x: np.ndarray) -> np.ndarray:
        A, b = parts(x)
        c = A.sum(1)
        left = [b.sum(), b @ c, b @ c**2, b @ A @ c, b @ c**3, (b * c) @ A @ c]
        left += [b @ A @ c**2, b @ A @ A @ c]
        return np.array(left) - [1, 1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24]

    def signs(x: np.ndarray) -> np.ndarray:
        A, b = parts(x)
        K = np.zeros((s + 1, s + 1))
        K[:s, :s], K[s, :s] = A, b
        M = np.linalg.inv(np.eye(s + 1) + x[-1] * K)
        return np.concatenate([(M @ K)[np.tril_indices(s + 1, -1)], M.sum(1)])

    best = 0.0
    draw = np.random.default_rng(1)
    for _ in range(STARTS):
        start = np.append(draw.random(len(lower[0]) + s), 0.1)
        found = minimize(
            lambda x: -x[-1],
            start,
            constraints=[{"type": "eq", "fun": equations}, {"type": "ineq", "fun": signs}],
            method="SLSQP",
            options={"maxiter": 1000, "ftol": 1e-12},
        )
        if found.success and np.max(np.abs(equations(found.x))) < 1e-10:
            best = max(best, found.x[-1])
    return float(best)


def radius_by_gark() -> float:
    """The same number of starts; the method is exact and its order proved."""
    family = loads_family(f"unknown: {{stages: {STAGES}, shape: explicit}}\n")
    [method] = search_methods(family, 4, STARTS, most=1, objective="-ssp").methods
    assert method.proof == "exact"
    return float(method.objective or 0)


def test_the_best_ssp_method_of_five_stages() -> None:
    """Both find Kraaijevanger's 1.508180; with the proof gark takes at most five times as long."""
    assert radius_by_gark() == pytest.approx(1.508180, abs=2e-6)
    assert radius_by_scipy() == pytest.approx(1.508180, abs=2e-6)
    ours, theirs = seconds(radius_by_gark, 2), seconds(radius_by_scipy, 2)
    detail = f"{ours:.2f} s, {theirs:.2f} s"
    assert_ratio("SSP(5,4) with its proof / by scipy alone", ours / theirs, 5.0, detail)
