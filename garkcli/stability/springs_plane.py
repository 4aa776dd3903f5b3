"""|tr M|/2 over two frequencies in floats, for pictures; ``two_frequencies`` decides stability."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.cells import Interval
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.stability.two_frequencies import SplitSprings
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.arrays import Floats
    from garkcli.exact.matrix import Matrix


class SpringsPlane(Frozen):
    """|tr M|/2 over both frequencies hω, shape (slow, fast)."""

    fast: list[float]
    slow: list[float]
    half_trace: list[list[float]]


def springs_plane(
    tableau: Tableau, split: SplitSprings, slow_end: float, fast_end: float, points: int = 160
) -> SpringsPlane:
    """Returns the half trace for hω up to both ends, from W = W_0 + a W_a + x W_x."""
    zero, one = fmpq(0), fmpq(1)
    W, B, E = _floats(tableau, split, zero, zero)
    W_one, B_one, _ = _floats(tableau, split, one, zero)
    W_a, B_a = W_one - W, B_one - B
    W_one, B_one, _ = _floats(tableau, split, zero, one)
    W_x, B_x = W_one - W, B_one - B
    slow = np.linspace(0.0, slow_end, points)
    fast = np.linspace(0.0, fast_end, points)
    half = np.empty((points, points))
    unit = np.eye(len(W))
    for i, s in enumerate(slow):
        for j, f in enumerate(fast):
            a, x = s * s, f * f
            matrix = unit - (W + a * W_a + x * W_x)
            weights = B + a * B_a + x * B_x
            try:
                solved = np.linalg.solve(matrix, E)
            except np.linalg.LinAlgError:
                half[i, j] = np.inf
                continue
            M = np.eye(2) + weights @ solved
            half[i, j] = abs(np.trace(M)) / 2
    half = np.nan_to_num(half, nan=np.inf, posinf=np.inf)
    return SpringsPlane(fast.tolist(), slow.tolist(), half.tolist())


def plane_with_ends_of(
    tableau: Tableau, split: SplitSprings, stable: Sequence[Interval], slow: fmpq
) -> SpringsPlane:
    """Returns the plane around the stable (hω)² of the fast spring, up to (hω)² = ``slow``."""
    ends = []
    for interval in stable:
        if interval.end is not None:
            square = float(interval.end.ball(64))
            ends.append(square**0.5)
    fast_end = 1.3 * max([*ends, 4.0])
    slow_end = 1.3 * max(to_float(slow) ** 0.5, 3.0)
    return springs_plane(tableau, split, slow_end, fast_end)


def _floats(
    tableau: Tableau, split: SplitSprings, a: fmpq, x: fmpq
) -> tuple[Floats, Floats, Floats]:
    fields = [split.matrix(colour, a, x) for colour in tableau.colours]
    one = fmpq(1)
    pattern = [split.matrix(colour, one, one) for colour in tableau.colours]
    system = stage_system(tableau, fields, pattern)
    return _array(system.W), _array(system.B), _array(system.E)


def _array(matrix: Matrix) -> Floats:
    return np.array([[to_float(x) for x in row] for row in matrix])
