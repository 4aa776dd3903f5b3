"""SciPy's sequential quadratic programming (D. Kraft, 1988) on the solutions of equations.

In local coordinates every point it evaluates is a solution.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import inf
from typing import TYPE_CHECKING
from warnings import catch_warnings, simplefilter

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.design.search.chart import Chart, OutsideError
from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from garkcli.design.search.chart import Equations, Gradient
    from garkcli.design.search.rational import Array

STEPS = 30
"""Steps of the optimiser before it restarts, in coordinates around the new point."""
ROUNDS = 20
REACH = 1.0
LEAST_REACH = 1e-4
"""The search ends if Newton's method finds no solutions even as near as this."""
GAIN = 1e-4
"""Relative gain of a round, or it is the last."""
ACCURACY = 1e-12
"""The change of the value at which a round ends."""
TINY = 1e-20
STRETCH = 1e-8
"""Second derivatives that are smaller, relative to the largest, count as this."""


class TaskValues(Frozen):
    """The functions of a task at a point. ``signs`` must be at least 0; ``found`` is the value for
    the unknowns alone, or infinite.
    """

    value: float
    gradient: Array
    signs: Array
    of_signs: Array
    found: float


class OptimiserTask(ABC):
    """A function to minimise on the solutions of equations, under inequalities. There are
    ``levels`` further variables ≥ 0; the optimiser stops at the value ``enough``.
    """

    levels = 0
    enough = -inf

    @abstractmethod
    def at(self, z: Array) -> TaskValues:
        """The functions at a point: the unknowns, then the further variables."""

    @abstractmethod
    def value(self, x: Array) -> float:
        """The function to minimise, at unknowns with all wants."""

    def guess(self, x: Array) -> Array:  # noqa: ARG002
        """The first values of the further variables."""
        return np.zeros(self.levels)

    def parts(self, x: Array) -> Gradient | None:  # noqa: ARG002
        """The squared terms, if the value is a sum of squares."""
        return None

    def scale(self, x: Array) -> float:
        """A factor of the value: the optimiser would stop at small numbers."""
        return 1 / max(abs(self.value(x)), TINY)


def descended(task: OptimiserTask, equations: Equations, x: Array) -> Array:
    """The best solution found from the solution x."""
    reach, value = REACH, task.value(x)
    for _ in range(ROUNDS):
        if value <= task.enough:
            break
        end, is_outside = _round(task, Chart(equations, x), x, reach)
        now = task.value(end)
        is_little = value - now <= GAIN * abs(value)
        if now < value:
            x, value = end, now
        if is_little and not is_outside:
            break
        reach = reach / 4 if is_outside else min(2 * reach, REACH)
        if reach < LEAST_REACH:
            break
    return x


class _EnoughError(Exception):
    """The value is small enough."""


def _round(task: OptimiserTask, chart: Chart, start: Array, reach: float) -> tuple[Array, bool]:
    """The best point of one run, and whether the run left the domain of the chart."""
    from scipy.optimize import minimize

    if not chart.dimension:
        return start, False
    scale = task.scale(start)
    size = np.full(chart.dimension, reach)
    if (parts := task.parts(start)) is not None:
        # the Hessian of a sum of squares, without second derivatives, becomes the identity
        slopes = parts[1] @ chart.tangent
        squares, basis = np.linalg.eigh(2 * scale * slopes.transpose() @ slopes)
        stretch = np.sqrt(np.maximum(squares, STRETCH * squares[-1] + TINY))
        chart.scale(basis / stretch)
        size = reach * stretch
    best, least = start, np.inf
    known: dict[bytes, TaskValues] = {}

    def at(z: Array) -> TaskValues:
        nonlocal best, least
        key = z.tobytes()
        if key not in known:
            check_time()
            known.clear()
            known[key], x = _in_chart(task, chart, z, scale)
            if known[key].found < least:
                best, least = x, known[key].found
            if least <= task.enough:
                raise _EnoughError
        return known[key]

    bounds = [*zip(-size, size, strict=True), *[(0.0, None)] * task.levels]
    try:
        with catch_warnings():
            # older versions of SciPy warn about steps that they shorten
            simplefilter("ignore", RuntimeWarning)
            minimize(
                lambda z: at(z).value,
                np.append(np.zeros(len(size)), task.guess(start)),
                jac=lambda z: at(z).gradient,
                bounds=bounds,
                constraints={
                    "type": "ineq",
                    "fun": lambda z: at(z).signs,
                    "jac": lambda z: at(z).of_signs,
                },
                method="SLSQP",
                options={"maxiter": STEPS, "ftol": ACCURACY},
            )
    except _EnoughError:
        pass
    except (OutsideError, ValueError, np.linalg.LinAlgError):  # NaN or infinity
        return best, True
    return best, False


def _in_chart(
    task: OptimiserTask, chart: Chart, z: Array, scale: float
) -> tuple[TaskValues, Array]:
    """The task at coordinates, with its further variables; and the unknowns there."""
    d = chart.dimension
    x, tangent = chart.at(z[:d])
    further = len(z) - d
    whole = np.zeros((len(z), len(x) + further))
    whole[:d, : len(x)], whole[d:, len(x) :] = tangent.transpose(), np.eye(further)
    look = task.at(np.append(x, z[d:]))
    return TaskValues(
        scale * look.value,
        scale * whole @ look.gradient,
        look.signs,
        look.of_signs @ whole.transpose(),
        look.found,
    ), x
