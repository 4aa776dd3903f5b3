"""What a convergence test asks of a method on a problem: the error of any step size."""

from __future__ import annotations

from time import process_time
from typing import TYPE_CHECKING, Any, Protocol

from flint import arb, fmpq

from garkcli.convergence.result import Cost, Row, Visible
from garkcli.errors import UsageProblem
from garkcli.stepping.integrator import Integrator, Stepper

if TYPE_CHECKING:
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem


class NoUniqueStep(UsageProblem):
    """The stage equations of a linear problem have no unique solution at one step size."""


class Solver(Protocol):
    """A method that solves a problem up to one time."""

    @property
    def problem(self) -> Oscillator | Problem:
        """What is solved, in as many terms as the method is for."""
        ...

    @property
    def t_end(self) -> fmpq:
        """When errors are taken."""
        ...

    @property
    def visible(self) -> Visible:
        """What the problem can see of the method."""
        ...

    @property
    def unit(self) -> fmpq:
        """A unit of time that is natural for the problem."""
        ...

    @property
    def longest(self) -> fmpq:
        """The longest step that a ladder may begin with."""
        ...

    def is_too_short(self, h: fmpq) -> bool:
        """Whether a ladder ends before ``h``, because a stiff problem would no longer look so."""
        ...

    def resolution(self, h: fmpq) -> float:
        """H ‖∂f/∂y‖ of a right-hand side; 0 for other problems."""
        ...

    @property
    def most_steps(self) -> int:
        """That a row may take."""
        ...

    @property
    def decades(self) -> tuple[int, ...]:
        """Of the short times that are tried: parts 10^−k of the usual time of the problem."""
        ...

    def row(self, h: fmpq, before: Row | None) -> Row:
        """The errors of steps of size ``h``, with a slope from the row ``before``.

        Raises:
            StepFailed: the stage equations of a step were not solved.
            NoUniqueStep: they have no unique solution at this step size.
        """
        ...

    def size(self) -> arb:
        """How large the solution is: the sum of its numbers at the start and at the end."""
        ...

    def rests(self) -> bool:
        """Whether the solution ends where it starts, as far as floats can tell."""
        ...

    def rounding(self) -> arb:
        """About the error that the rounding of coefficients makes; 0 for exact ones."""
        ...

    def timed(self, row: Row) -> Row:
        """A row with what its steps cost when they are taken one by one."""
        ...

    def over(self, t_end: fmpq) -> Solver:
        """The same up to another time."""
        ...


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
    return state.y, cost_of(state, min(times) or elapsed / len(times))
