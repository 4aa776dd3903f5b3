"""Least squares from many starts at once: the method of Levenberg and Marquardt.

Each start has its own damping. The step of a system r with Jacobian J is

    δ = −Jᵀ (J Jᵀ + λ I)⁻¹ r = −(Jᵀ J + λ I)⁻¹ Jᵀ r,

by Cholesky's method on the smaller of both matrices. λ is proportional to |r|, which keeps the
convergence quadratic also where solutions are not isolated (J. Fan, Y. Yuan, Computing 74, 2005).
What happens to a start depends neither on the others nor, by ``garkcli.design.search.rational``, on
the machine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from garkcli.deadline import check_time
from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array

    System = Callable[[Array], tuple[Array, Array]]

MAX_STEPS = 300
SMALL = 1e-13
"""Residuals that are nothing but rounding."""
LARGE = 40.0
"""Unknowns beyond are taken to diverge, as many starts do."""
MAX_DAMPING = 1e10
MIN_DAMPING = 1e-14
PATIENCE = 35
"""Steps within which the sum of squares must fall by half."""


class Minima(Frozen):
    """Ends of starts, shape (unknowns, starts), and whether each solves the system in floats."""

    points: Array
    succeeded: Array


def least_squares(
    system: System,
    starts: Array,
    steps: int = MAX_STEPS,
    small: float = SMALL,
    are_kept: bool = False,
) -> Minima:
    """Solves a system from every start, of shape (unknowns, starts).

    Residuals have the shape (conditions, points), derivatives (conditions, unknowns, points). A
    start succeeds if no residual is larger than ``small``. No point is dropped if the system
    depends on their places (``are_kept``).
    """
    import numpy as np

    points = starts.copy()
    succeeded = np.zeros(starts.shape[1], bool)
    alive = np.arange(starts.shape[1])
    with np.errstate(all="ignore"):
        run = _Starts(system, points)
        for _ in range(steps):
            check_time()
            done = run.largest < small
            succeeded[alive[done]] = True
            points[:, alive] = run.x
            stays = ~done & run.is_promising()
            if are_kept:
                if not stays.any():
                    break
            elif not stays.all():
                alive = alive[stays]
                run.keep(stays)
            if not len(alive):
                break
            run.step()
        else:
            succeeded[alive[run.largest < small]] = True
            points[:, alive] = run.x
    return Minima(points, succeeded)


class _Starts:
    def __init__(self, system: System, starts: Array) -> None:
        import numpy as np

        self.np = np
        self.system = system
        self.x = starts.copy()
        self.residuals, self.jacobians = system(self.x)
        self.squares = _sum_of_squares(self.residuals)
        self.largest = self._largest(self.residuals)
        size = starts.shape[1]
        self.damping = np.full(size, 1.0)
        self.age = np.zeros(size, int)
        self.mark = self.squares.copy()

    def _largest(self, residuals: Array) -> Array:
        largest: Array = self.np.max(self.np.abs(residuals), axis=0)
        return largest

    def is_promising(self) -> Array:
        np = self.np
        self.age += 1
        fell = self.squares < 0.5 * self.mark
        self.mark = np.where(fell, self.squares, self.mark)
        self.age = np.where(fell, 0, self.age)
        within = np.max(np.abs(self.x), axis=0) < LARGE
        able = self.damping < MAX_DAMPING
        promising: Array = within & able & (self.age < PATIENCE) & np.isfinite(self.squares)
        return promising

    def keep(self, stays: Array) -> None:
        for name in ("x", "residuals", "jacobians"):
            setattr(self, name, self.np.ascontiguousarray(getattr(self, name)[..., stays]))
        for name in ("squares", "largest", "damping", "age", "mark"):
            setattr(self, name, getattr(self, name)[stays])

    def step(self) -> None:
        np = self.np
        amount = self.damping * np.sqrt(self.squares)
        change = damped_step(self.residuals, self.jacobians, amount)
        moved = self.x + change
        residuals, jacobians = self.system(moved)
        squares = _sum_of_squares(residuals)
        better = squares < self.squares
        total: Array = self.jacobians[:, 0] * change[0]
        for k in range(1, len(change)):
            total += self.jacobians[:, k] * change[k]
        predicted = _sum_of_squares(self.residuals + total)
        gain = (self.squares - squares) / (self.squares - predicted)
        self.x = np.where(better, moved, self.x)
        self.residuals = np.where(better, residuals, self.residuals)
        self.jacobians = np.where(better, jacobians, self.jacobians)
        self.squares = np.where(better, squares, self.squares)
        self.largest = self._largest(self.residuals)
        factor = np.where(gain > 0.75, 0.2, np.where(gain < 0.25, 4.0, 1.0))
        factor = np.where(better, factor, 8.0)
        self.damping = np.maximum(self.damping * factor, 1e-6)


def _sum_of_squares(rows: Array) -> Array:
    # another order of summation may round differently
    total: Array = rows[0] * rows[0]
    for row in rows[1:]:
        total = total + row * row
    return total


def damped_step(residuals: Array, jacobians: Array, damping: Array) -> Array:
    """δ for each point, shape (unknowns, points); ``damping`` is λ."""
    conditions, unknowns, _ = jacobians.shape
    if conditions <= unknowns:
        right = -residuals
        multipliers = _solve(_gram(jacobians, axis=1), damping, right)
        return _transposed_applied(jacobians, multipliers)
    right = _transposed_applied(jacobians, -residuals)
    return _solve(_gram(jacobians, axis=0), damping, right)


def _transposed_applied(jacobians: Array, rows: Array) -> Array:
    """Jᵀ r for each point."""
    total: Array = jacobians[0] * rows[0]
    for k in range(1, len(rows)):
        total += jacobians[k] * rows[k]
    return total


def _gram(jacobians: Array, axis: int) -> Array:
    """J Jᵀ (axis 1) or Jᵀ J (axis 0) for each point."""
    import numpy as np

    vectors = np.moveaxis(jacobians, axis, 0)
    size, points = vectors.shape[1], vectors.shape[2]
    gram = np.zeros((size, size, points))
    for i in range(size):
        # the lower half of a symmetric matrix
        part = gram[i, : i + 1]
        for v in vectors:
            part += v[i] * v[: i + 1]
    return gram


def _solve(matrices: Array, damping: Array, right: Array) -> Array:
    """(M + λ I)⁻¹ r for each point by Cholesky's method; the lower half of M is overwritten."""
    import numpy as np

    size = len(right)
    trace = matrices[0, 0].copy()
    for k in range(1, size):
        trace += matrices[k, k]
    amount = damping + MIN_DAMPING * trace
    x = right.copy()
    for k in range(size):
        matrices[k, k] += amount
    for k in range(size):
        pivot = np.sqrt(matrices[k, k])  # NaN if rounding has made it negative
        matrices[k, k] = pivot
        column = matrices[k + 1 :, k]
        column /= pivot
        for i in range(k + 1, size):
            matrices[i, k + 1 : i + 1] -= matrices[i, k] * column[: i - k]
        x[k] /= pivot
        x[k + 1 :] -= column * x[k]
    for k in range(size - 1, -1, -1):
        x[k] /= matrices[k, k]
        x[:k] -= matrices[k, :k] * x[k]
    return x
