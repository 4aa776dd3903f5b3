"""What steps cost: evaluations, Newton's method, and processor time."""

from __future__ import annotations

from time import process_time
from typing import Any

from flint import fmpq

from garkcli.convergence.result import Cost
from garkcli.stepping.integrator import Integrator
from garkcli.stepping.step import Stepper

ENOUGH = 0.1
"""Seconds of processor time after which a run is not repeated."""
MAX_RUNS = 20
"""Most runs of which the fastest counts."""
MAX_DIGITS = 1000
"""Most digits of a step; a smaller error counts as none."""
REACHED = 0.1
"""The part of an error that the round-off of floats may be for them to have reached it."""


def cost_of(state: Stepper, seconds: float | None = None) -> Cost:
    """What the steps of ``state`` so far have cost."""
    work = state.work
    return Cost(state.done, work.evaluations, work.iterations, work.jacobians, seconds)


def work_of(integrator: Integrator, h: fmpq, count: int) -> tuple[list[Any], Cost]:
    """(q, p) after ``count`` steps of size ``h``, shape (2d,), and their cost with the time of the
    fastest run; the mean time where the clock ticks too seldom for single runs.

    Raises:
        StepFailed: the stage equations of a step were not solved.
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
    mean = elapsed / len(times)
    return state.y, cost_of(state, min(times) or mean)
