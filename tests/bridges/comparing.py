"""The errors of ``gark converge``, and how far those of another code may be from them.

Both compute the same steps, and round on their way. A step in floats of unit round-off u, for a
right-hand side with |f| ≤ M and Lipschitz constant L, on numbers of size Y, with s stages, weights
Σ|b| = β and rows Σ|a_ij| ≤ α, is off by at most

    u (Y + hβ ((s + E) M + L (Y + (s + E) hα M))) + hβL·τ

to first order: a sum of s terms is rounded s times and once more for each of E operations in f and
around it, every stage value is rounded like that, and stages that are solved for are off by the
tolerance τ of the solver. The time is off by n u t_end after n steps, which changes f like y does.
In n steps of length h = t_end/n these errors grow by exp(L t_end) at most. gark's own errors are
off by as much, with τ = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp

from flint import fmpq

from garkcli.bridges.payload import Payload
from garkcli.bridges.trials import STEPS, Trial, trial_of
from garkcli.convergence.convergence import converge
from garkcli.exact.display import to_ball
from garkcli.methodfile.build import MethodFile
from garkcli.problems.files.load import loads_problem

UNIT = 2.0**-53
OPERATIONS = 16
"""E: of f, whose formulas have fewer than ten, and of what is around the sums."""


@dataclass(frozen=True)
class Sizes:
    """What bounds a problem near its solution, in the maximum norm.

    Attributes:
        value: Y, of the unknowns.
        slope: M, of the right-hand side and of each of its terms.
        lipschitz: L, of the same.
    """

    value: float
    slope: float
    lipschitz: float


SIZES = {
    "whole": Sizes(1.5, 1.0, 1.0),
    "split": Sizes(1.3, 1.5, 2.5),
    "separable": Sizes(1.4, 1.3, 1.0),
}
"""A little larger than they are, which a test measures."""


def own_errors(method: MethodFile, payload: Payload) -> list[float]:
    """The errors that ``gark converge`` prints, in all their digits.

    Args:
        method: as it was read.
        payload: the same as writers see it, which tells the problem.
    """
    trial = trial_of(payload)
    problem = loads_problem(trial.file)
    steps = [fmpq(trial.t_end, n) for n in STEPS]
    found = converge(method.tableau, problem, steps=steps, tolerance=method.tolerance)
    return [float(row.error.mid()) for row in found.rows]


def allowed(payload: Payload, steps: int, solver: float = 0.0, reading: float = 0.0) -> float:
    """How far the errors of another code may be from ours, see above.

    Args:
        payload: the method.
        steps: n.
        solver: τ, to which stages are solved.
        reading: what is lost when the result is taken out, in units of u·Y.
    """
    trial = trial_of(payload)
    ours = _rounding(payload, trial, steps, 0.0)
    others = _rounding(payload, trial, steps, solver)
    size = SIZES[trial.name].value
    # errors are distances, √2 times as long as their larger part
    return 2**0.5 * (ours + others + (2 + reading) * UNIT * size)


def _rounding(payload: Payload, trial: Trial, steps: int, solver: float) -> float:
    sizes = SIZES[trial.name]
    h = trial.t_end / steps
    stages = max(payload.stages) * payload.size
    beta = max(_size(row) for row in payload.b) * payload.size
    alpha = max(
        sum(_size(block[i]) for block in blocks if block is not None)
        for l, blocks in enumerate(payload.A)
        for i in range(payload.stages[l])
    )
    M, L, Y = sizes.slope, sizes.lipschitz, sizes.value
    terms = stages + OPERATIONS
    value = Y + terms * h * alpha * M
    slope = terms * M + L * value + L * steps * trial.t_end
    step = UNIT * (Y + h * beta * slope) + h * beta * L * solver
    return steps * step * exp(L * trial.t_end)


def _size(row: object) -> float:
    """Σ|x| of a row of entries."""
    assert isinstance(row, tuple)
    total = 0.0
    for x in row:
        ball = to_ball(x) if not hasattr(x, "mid") else x
        total += abs(float(ball.mid()))
    return total
