"""Steps of a symplectic pair, eq. (spgqrk), or of a GARK method, on a split problem.

With y_0 the start of the step, and the colours m of the tableau,

    Y^k_i = y_0 + h Σ_m Σ_j a^{k,m}_{ij} f^m(Y^{rows(m)}_j),
    y_1 = y_0 + h Σ_m Σ_j b^m_j f^m(Y^{rows(m)}_j),

where f^m drives positions (V), momenta (F) or both, or is a right-hand side of its own.
Explicit parts are computed in order; the unknowns of each implicit block by Newton's method with
exact Jacobians.
``garkcli.stepping.program`` writes this out for the method and the problem at hand. The numbers are
floats with compensated summation from step to step, or midpoints of balls with any number of
digits; Jacobians are floats in both cases, so that each iteration near the solution is worth the
digits of a float.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from flint import ctx, fmpq

from garkcli.errors import GarkError
from garkcli.stepping.integrator import Integrator, NotSolved, Real, Recorder

_AHEAD = 64  # most steps in floats by which a trajectory is ahead of who looks at it


class StepFailed(GarkError):
    """The stage equations of a step were not solved."""

    code = "step-fails"

    def __init__(self, number: int, h: fmpq, residual: float) -> None:
        what = "the stage equations were not solved"
        if not isfinite(residual):
            what = "the numbers leave the vector fields"
        super().__init__(
            f"step {number} of size {h}: {what} (residual {residual:.1e})",
            "choose a smaller step size, or an earlier final time: the solution may end there",
        )
        self.number = number
        self.h = h
        self.residual = residual


@dataclass(frozen=True)
class Work:
    """What a run of steps has cost.

    Attributes:
        evaluations: of vector fields, each one V^{l} or F^{l} at one stage, those of Newton's
            method included.
        iterations: of Newton's method, over all implicit blocks.
        jacobians: of an implicit block, each with its factorisation.
    """

    evaluations: int
    iterations: int
    jacobians: int


def trajectory(
    integrator: Integrator,
    h: fmpq,
    count: int,
    initial: Sequence[Any] | None = None,
    every: int = 1,
) -> Iterator[list[Real]]:
    """(q, p) at the start and after each ``every`` of ``count`` steps of size ``h``, shape (2d,).

    The last one is after ``count`` steps, whatever remains. The start is ``initial``, or that of
    the problem.

    Raises:
        StepFailed: the stage equations of a step were not solved.
    """
    stepper = Stepper(integrator, h, initial)
    yield stepper.y
    if every > 1 or integrator.is_for_balls:
        while stepper.done < count:
            stepper.advance(min(every, count - stepper.done))
            yield stepper.y
        return
    while stepper.done < count:
        states: list[list[Real]] = []
        try:
            stepper.advance(min(_AHEAD, count - stepper.done), states.append)
        except StepFailed:
            yield from states
            raise
        yield from states


def integrate(
    integrator: Integrator, h: fmpq, count: int, initial: Sequence[Any] | None = None
) -> list[Real]:
    """(q, p) after ``count`` steps; see ``trajectory``."""
    stepper = Stepper(integrator, h, initial)
    stepper.advance(count)
    return stepper.y


@dataclass
class Stepper:
    """A trajectory at one time, to be advanced.

    Attributes:
        integrator: what steps.
        h: the step size.
        initial: (q, p) at the start, shape (2d,), or None for the problem's.
        done: how many steps have been done.
    """

    integrator: Integrator
    h: fmpq
    initial: Sequence[Any] | None = None
    done: int = 0
    _numbers: list[Real] = field(init=False)  # as ``Program`` describes them
    _weights: list[Real] = field(init=False)
    _iterations: list[int] = field(init=False)
    _jacobians: int = 0

    def __post_init__(self) -> None:
        integrator = self.integrator
        start = integrator.problem.initial if self.initial is None else self.initial
        with ctx.workprec(integrator.bits):
            numbers = [integrator.number(x) for x in start]
            # time begins at 0; nothing has been lost or missed before the first step
            others = integrator.program.size - len(numbers)
            self._numbers = numbers + [integrator.number(0)] * others
        self._weights = integrator.weights(self.h)
        self._iterations = [0] * len(integrator.program.repeated)

    @property
    def y(self) -> list[Real]:
        """The unknowns: (q, p), shape (2d,), or y, shape (d,)."""
        return self._numbers[: self.integrator.problem.layout.unknowns]

    @property
    def work(self) -> Work:
        """What all steps so far have cost."""
        program = self.integrator.program
        repeated = sum(n * k for n, k in zip(self._iterations, program.repeated, strict=True))
        return Work(
            self.done * program.evaluations + repeated, sum(self._iterations), self._jacobians
        )

    def advance(self, count: int, record: Recorder | None = None) -> None:
        """``count`` steps; ``record`` is told of each.

        Raises:
            StepFailed: the stage equations of a step were not solved.
        """
        try:
            made = self._run(count, record)
        except NotSolved as failure:
            raise StepFailed(failure.number, self.h, failure.residual) from None
        self._numbers, iterations, jacobians = made
        pairs = zip(self._iterations, iterations, strict=True)
        self._iterations = [before + more for before, more in pairs]
        self._jacobians += jacobians
        self.done += count

    def _run(self, count: int, record: Recorder | None) -> tuple[list[Real], list[int], int]:
        """What the program of the steps gives, with balls at their precision."""
        integrator = self.integrator
        first = self.done + 1
        if not integrator.is_for_balls:
            return integrator.run(self._numbers, self._weights, first, count, record)
        with ctx.workprec(integrator.bits):
            return integrator.run(self._numbers, self._weights, first, count, record)
