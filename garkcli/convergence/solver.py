"""Limits of the solvers of a convergence test, and the cost of their steps."""

from __future__ import annotations

from time import process_time
from typing import Any

from flint import fmpq

from garkcli.convergence.result import Cost
from garkcli.errors import UsageProblem
from garkcli.stepping.integrator import Integrator, Stepper


class NoUniqueStep(UsageProblem):
    """The stage equations of a linear problem are singular at one step size."""


ENOUGH = 0.1
"""Processor seconds after which a run is not repeated."""
MAX_RUNS = 20
"""Most repetitions of a run, of which the fastest counts."""
MAX_DIGITS = 1000
"""Most digits of a step; a smaller error counts as zero."""
ROWS = 5
"""Step sizes of the default ladder; more only while the slopes still change."""
REACHED = 0.1
"""The largest part of an error that round-off of floats may be."""


def cost_of(state: Stepper, seconds: float | None = None) -> Cost:
    work = state.work
    return Cost(state.done, work.evaluations, work.iterations, work.jacobians, seconds)


def work_of(integrator: Integrator, h: fmpq, count: int) -> tuple[list[Any], Cost]:
    """(q, p), shape (2d,), and the cost, with the time of the fastest run, or a mean if the clock
    is coarse. Raises StepFailed if the stage equations of a step were not solved.
    """
    times: list[float] = []
    begin = process_time()
    elapsed = 0.0
    while elapsed < ENOUGH and (len(times) < MAX_RUNS or not elapsed):
        state = Stepper(integrator, h)
        start = process_time()
        state.advance(count)
        end = process_time()
        times.append(end - start)
        elapsed = end - begin
    return state.y, cost_of(state, min(times) or elapsed / len(times))
