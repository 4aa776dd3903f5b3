"""The interface of solvers for a convergence test: errors for any step size."""

from __future__ import annotations

from time import process_time
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.convergence.result import Cost
from garkcli.errors import UsageProblem
from garkcli.stepping.integrator import Integrator, Stepper

if TYPE_CHECKING:
    from garkcli.convergence.linear_solver import LinearSolver
    from garkcli.convergence.stepped_solver import SteppedSolver


class NoUniqueStep(UsageProblem):
    """The stage equations of a linear problem are singular at one step size."""


Solver: TypeAlias = "LinearSolver | SteppedSolver"
"""A method on a problem, up to a time: by exact powers of its step map, or step by step. Both have

- ``problem``, ``t_end`` and ``visible``: what the problem can see of the method;
- ``unit`` and ``longest``: a unit of time that is natural for it, the longest step of a ladder;
- ``most_steps`` of a row, ``decades``: parts 10^−k of the usual time, short times that are tried;
- ``row``: the errors of steps of one size, with a slope from the row before;
- ``size`` of the solution: the sum of its numbers at the start and at the end;
- ``rests``: whether it ends where it starts, as far as floats can tell;
- ``rounding``: about the error that the rounding of coefficients makes; 0 for exact ones;
- ``resolution``: h ‖∂f/∂y‖ of a right-hand side; 0 for other problems;
- ``is_too_short``: whether a ladder ends before a step size, where a stiff problem would no longer
  look so;
- ``timed``: a row with what its steps cost when they are taken one by one;
- ``over``: the same up to another time.
"""
ENOUGH = 0.1
"""Processor seconds after which a run is not repeated."""
MAX_RUNS = 20
"""Most repetitions of a run, of which the fastest counts."""
MAX_DIGITS = 1000
"""Most digits of a step; a smaller error counts as zero."""
REACHED = 0.1
"""The largest part of an error that round-off of floats may be."""


def cost_of(state: Stepper, seconds: float | None = None) -> Cost:
    """The cost of the steps of ``state`` so far."""
    work = state.work
    return Cost(state.done, work.evaluations, work.iterations, work.jacobians, seconds)


def work_of(integrator: Integrator, h: fmpq, count: int) -> tuple[list[Any], Cost]:
    """(q, p) after ``count`` steps of size ``h``, shape (2d,), and their cost with the time of the
    fastest run, or the mean time if the clock is too coarse.

    Raises ``StepFailed`` if the stage equations of a step were not solved.
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
