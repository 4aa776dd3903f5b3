"""What steps cost: evaluations, Newton's method, and processor time."""

from __future__ import annotations

from dataclasses import dataclass
from time import process_time
from typing import Any

from flint import fmpq

from garkcli.dynamics.scheme import Scheme
from garkcli.dynamics.step import State

ENOUGH = 0.1
"""Seconds of processor time after which a run is not repeated."""
MAX_RUNS = 20
"""Most runs of which the fastest counts."""


@dataclass(frozen=True)
class Cost:
    """What the steps of one row have cost.

    Attributes:
        steps: how many.
        evaluations: of vector fields: each is one V^{l} or F^{l} at one stage; those of Newton's method included.
        iterations: of Newton's method, over all steps and implicit blocks.
        jacobians: of an implicit block, each with its factorisation.
        seconds: of processor time, in floats; None where floats do not reach the error, and numbers with more
            digits were used.
    """

    steps: int
    evaluations: int
    iterations: int
    jacobians: int
    seconds: float | None = None


def cost_of(state: State, seconds: float | None = None) -> Cost:
    """What the steps of ``state`` so far have cost."""
    work = state.work
    return Cost(state.done, work.evaluations, work.iterations, work.jacobians, seconds)


def work_of(scheme: Scheme, h: fmpq, count: int) -> tuple[list[Any], Cost]:
    """(q, p) after ``count`` steps of size ``h``, shape (2d,), and their cost with the time of the fastest run.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    times: list[float] = []
    while sum(times) < ENOUGH and len(times) < MAX_RUNS:
        state = State(scheme, h)
        start = process_time()
        state.advance(count)
        times.append(process_time() - start)
    return state.y, cost_of(state, min(times))
