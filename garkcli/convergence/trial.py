"""Rows of a convergence test on a nonlinear problem: one method, one step size, one error.

Each row is computed with as many digits as its error needs: floats where they do, more where the
error would fall below round-off. The reference solution has more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import ceil, log10
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.convergence import ladder
from garkcli.convergence.convergence import Row
from garkcli.convergence.reference import Reference, Watch, magnitude, reference, run
from garkcli.convergence.work import MAX_DIGITS, REACHED, cost_of, work_of
from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian, energy_function
from garkcli.stepping.integrator import Binding, Integrator
from garkcli.stepping.linear import whole_steps

MAX_STEPS = 1_000_000
"""Most steps of one row."""
_MANY = 120  # digits that do not agree by chance
_SPARE = 6  # correct digits of an error
_AHEAD = 2  # halvings of the step for which a reference solution will do


@dataclass(frozen=True)
class PathRow(Row):
    """One step size on a nonlinear problem.

    Attributes:
        digits: that the row was computed with; ``FLOAT_DIGITS`` are floats with compensated
            summation.
        invariant_errors: |I(t_end) − I(0)| for each invariant of the problem besides H. These and
            the energy error are good to ``digits`` digits of the invariant itself, not of the
            error.
    """

    digits: int
    invariant_errors: tuple[arb, ...] = ()


@dataclass
class Trial:
    """One method on one problem up to one time, and what is kept between step sizes.

    Attributes:
        bound: the method on the problem.
        t_end: when errors are taken.
        order: that the errors are expected to have; tells only how many digits to begin with.
        watch: is told how far each run is.
    """

    bound: Binding
    t_end: fmpq
    order: int
    watch: Watch | None
    integrators: dict[int, Integrator] = field(default_factory=dict)
    reference: Reference = field(init=False)

    @property
    def problem(self) -> Hamiltonian:
        """What is solved."""
        return self.bound.problem

    def __post_init__(self) -> None:
        self.reference = reference(self.problem, self.t_end)

    def row(self, h: fmpq, before: PathRow | None) -> PathRow:
        """Errors at ``t_end``, with digits enough for them; 0 where ``MAX_DIGITS`` digits do not
        show any.
        """
        steps = whole_steps(self.t_end, h)
        if steps > MAX_STEPS:
            raise UsageProblem(
                f"{steps} steps (limit {MAX_STEPS})", "choose a shorter time or larger steps"
            )
        digits = self._digits(h, before)
        while True:
            state = run(self._integrator(digits), h, steps, self.watch, f"h = {h}")
            error = self._error(state.y, digits)
            if error > self._size * arb(10) ** (_SPARE - 1 - digits):
                break
            # all digits of many are the same only where nothing moves
            if digits == MAX_DIGITS or (digits >= _MANY and error.is_zero()):
                error = arb(0)
                break
            digits = min(MAX_DIGITS, 2 * digits)
        slope = (
            None
            if before is None or error.is_zero()
            else float((before.error / error).log() / (arb(before.h) / arb(h)).log())
        )
        energy, *others = self._invariant_errors(state.y, digits)
        return PathRow(h, error, slope, energy, digits, tuple(others), cost=cost_of(state))

    def is_small(self, row: PathRow) -> bool:
        """Whether the error is a small part of the solution."""
        return bool(row.error < self._size * ladder.LARGEST / 2)  # the size counts start and end

    def rounding(self, tolerance: fmpq | None) -> arb:
        """About the error that coefficients rounded to ``tolerance`` make; 0 for exact ones."""
        return (
            arb(0)
            if tolerance is None
            else self._size * arb(tolerance) * max(arb(1), arb(self.t_end))
        )

    def timed(self, row: PathRow) -> PathRow:
        """The row with the cost of its steps in floats, where these reach its error to a tenth."""
        y, cost = work_of(self._integrator(FLOAT_DIGITS), row.h, whole_steps(self.t_end, row.h))
        difference = abs(self._error(y, FLOAT_DIGITS) - row.error)
        return replace(row, cost=cost) if difference < REACHED * row.error else row

    @property
    def _size(self) -> arb:
        return magnitude(self.reference.y, self.problem)

    def _error(self, y: Sequence[Any], digits: int) -> arb:
        """The distance of ``y`` from the reference solution."""
        exact = self.reference.to(self._digits_of_reference(digits), self.watch)
        with ctx.workprec(self._integrator(digits).bits + 32):
            return (
                sum(((arb(a) - b) ** 2 for a, b in zip(y, exact, strict=True)), arb(0)).sqrt().mid()
            )

    def _digits_of_reference(self, digits: int) -> int:
        """Enough for the row, and beyond floats for the next ones as well."""
        if digits <= FLOAT_DIGITS or self.reference.digits >= digits + _SPARE:
            return digits + _SPARE
        return digits + _SPARE + ceil(_AHEAD * self.order * log10(2))

    def _digits(self, h: fmpq, before: PathRow | None) -> int:
        """Digits for the error that the row before and the order let expect."""
        if before is None:
            return FLOAT_DIGITS
        decades = float((before.error / self._size).log() / arb(10).log()) - self.order * log10(
            to_float(before.h / h)
        )
        needed = ceil(-decades) + _SPARE
        # in whole tens, so that the same integrator serves several rows
        return (
            FLOAT_DIGITS
            if needed <= FLOAT_DIGITS
            else min(MAX_DIGITS, max(before.digits, -(-needed // 10) * 10))
        )

    def _integrator(self, digits: int) -> Integrator:
        if digits not in self.integrators:
            self.integrators[digits] = self.bound.at(digits)
        return self.integrators[digits]

    def _invariant_errors(self, y: Sequence[Any], digits: int) -> list[arb]:
        bits = self.integrators[digits].bits + 32
        with ctx.workprec(bits):
            measure = energy_function(self.problem, digits + 10)
            now, then = measure(*map(arb, y)), measure(*map(arb, self.problem.initial))
            return [abs(a - b).mid() for a, b in zip(now, then, strict=True)]
