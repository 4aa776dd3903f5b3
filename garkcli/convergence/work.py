"""What steps cost: evaluations, Newton's method, and processor time."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from time import process_time
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq

from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian, symbols
from garkcli.stepping.integrator import Integrator, bind
from garkcli.stepping.linear import whole_steps
from garkcli.stepping.step import Stepper

if TYPE_CHECKING:
    from garkcli.convergence.convergence import Convergence
    from garkcli.problems.oscillator import Oscillator
    from garkcli.tableau.tableau import Tableau

ENOUGH = 0.1
"""Seconds of processor time after which a run is not repeated."""
MAX_RUNS = 20
"""Most runs of which the fastest counts."""
MAX_DIGITS = 1000
"""Most digits of a step; a smaller error counts as none."""
REACHED = 0.1
"""The part of an error that the round-off of floats may be for them to have reached it."""


@dataclass(frozen=True)
class Cost:
    """What the steps of one row have cost.

    Attributes:
        steps: how many.
        evaluations: of vector fields: each is one V^{l} or F^{l} at one stage; those of Newton's
            method included.
        iterations: of Newton's method, over all steps and implicit blocks.
        jacobians: of an implicit block, each with its factorisation.
        seconds: of processor time, in floats; None where floats do not reach the error, and numbers
            with more digits were used.
    """

    steps: int
    evaluations: int
    iterations: int
    jacobians: int
    seconds: float | None = None


def cost_of(state: Stepper, seconds: float | None = None) -> Cost:
    """What the steps of ``state`` so far have cost."""
    work = state.work
    return Cost(state.done, work.evaluations, work.iterations, work.jacobians, seconds)


def work_of(integrator: Integrator, h: fmpq, count: int) -> tuple[list[Any], Cost]:
    """(q, p) after ``count`` steps of size ``h``, shape (2d,), and their cost with the time of the
    fastest run.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    times: list[float] = []
    while sum(times) < ENOUGH and len(times) < MAX_RUNS:
        state = Stepper(integrator, h)
        start = process_time()
        state.advance(count)
        times.append(process_time() - start)
    return state.y, cost_of(state, min(times))


def hamiltonian_of(oscillator: Oscillator, t_end: fmpq) -> Hamiltonian:
    """The oscillator as a problem to be stepped, from q(0) = 1, p(0) = ω/2."""
    import sympy

    (q,), (p,) = symbols(("q",), "q"), symbols(("q",), "p")
    half, omega = sympy.Rational(1, 2), _rational(oscillator.omega)
    terms = tuple(
        half * _rational(k) * p**2 + half * omega**2 * _rational(v) * q**2
        for k, v in oscillator.shares
    )
    start = (fmpq(1), oscillator.omega / 2)
    return Hamiltonian("oscillator", ("q",), terms, start, t_end)


def _rational(x: fmpq) -> Any:
    import sympy

    return sympy.Rational(int(x.p), int(x.q))


def timed(tableau: Tableau, result: Convergence) -> Convergence:
    """A convergence test on the oscillator with what its steps cost when they are taken one by one.

    Rows whose errors are below what ``MAX_DIGITS`` digits can show have no cost.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    problem = hamiltonian_of(result.problem, result.t_end)
    bound = bind(tableau, problem)
    integrators = {FLOAT_DIGITS: bound.at()}
    rows = []
    for row in result.rows:
        steps = whole_steps(result.t_end, row.h)
        y, cost = work_of(integrators[FLOAT_DIGITS], row.h, steps)
        if not abs(_error(y, result) - row.error) < REACHED * row.error:
            digits = -(-ceil(8 - float(row.error.log() / arb(10).log())) // 10) * 10
            if digits > MAX_DIGITS:
                rows.append(row)
                continue
            if digits not in integrators:
                integrators[digits] = bound.at(digits)
            state = Stepper(integrators[digits], row.h)
            state.advance(steps)
            cost = cost_of(state)
        rows.append(replace(row, cost=cost))
    return replace(result, rows=tuple(rows))


def _error(y: list[Any], result: Convergence) -> arb:
    """‖(Δq, Δp/ω)‖₂ of (q, p) at the final time."""
    omega, t = arb(result.problem.omega), arb(result.t_end)
    with ctx.workprec(128):
        sine, cosine = (omega * t).sin_cos()
        q, p = cosine + sine / 2, omega * (cosine / 2 - sine)
        return arb((y[0] - q) ** 2 + ((y[1] - p) / omega) ** 2).sqrt()
