"""Solves a problem step by step, with as many digits as the errors need, and a finer reference."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import ceil, log10
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.convergence.reference import ReferenceSolution, magnitude, reference, run
from garkcli.convergence.result import MAX_ORDER, StepSizeRow, Visible, absolute, slope_between
from garkcli.convergence.solver import MAX_DIGITS, REACHED, ROWS, cost_of, work_of
from garkcli.exact.display import to_float
from garkcli.frozen import Mutable, field, replace
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.problem import Problem, conserved_names, quantities_function
from garkcli.problems.righthandside import steepness
from garkcli.stepping.integrator import FLOAT_PRECISION, Binding, Integrator
from garkcli.stepping.linear import whole_steps

MAX_STEPS = 1_000_000
GROWTH = 16
"""The largest growth of round-off. On the built-in problems it was at most 1."""
_ENOUGH = 30  # digits whose round-off alone proves enough where every condition holds
_MANY = 120  # digits that do not agree by chance
_OF_AN_ORDER = 8  # digits an order, below which a long step of such a method has its error
_SPARE = 6  # correct digits of an error
_HIGH = 4  # of this order methods need more digits than floats after few halvings
_NEXT_DIGITS = 20  # those of the first rows beyond floats
_AHEAD = 2  # halvings of the step for which a reference solution will do
_GUARD = 32  # bits
_STIFF = 1000
_GENERIC_DECADES = (6, 12, 24, 48)
_DECADES = (6, 12, 18)


class SteppedSolver(Mutable):
    """A method on a problem, with results shared between step sizes and by digits."""

    bound: Binding
    t_end: fmpq
    visible: Visible
    tolerance: fmpq | None = None
    integrators: dict[int, Integrator] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.reference: ReferenceSolution = reference(self.problem, self.t_end)

    @property
    def problem(self) -> Problem:
        return self.bound.problem

    @property
    def most_steps(self) -> int:
        return MAX_STEPS

    @property
    def unit(self) -> fmpq:
        """1: problems come in units of their own."""
        return fmpq(1)

    @property
    def longest(self) -> fmpq:
        """8: solutions may move slowly."""
        return fmpq(8)

    def is_too_short(self, h: fmpq) -> bool:
        """Whether h² ‖∂f/∂y‖ is below ``_STIFF`` although a longer ladder is stiff: there |R(h λ)|
        of a method with |R(∞)| = 1 damps its errors, and slopes belong to neither regime.
        """
        last = self.t_end / 2 ** (ROWS - 1)
        is_stiff = self._slope * arb(last) ** 2 > _STIFF
        return bool(is_stiff and self._slope * arb(h) ** 2 < _STIFF)

    def resolution(self, h: fmpq) -> float:
        return float(self._slope * arb(h))

    @property
    def decades(self) -> tuple[int, ...]:
        """The exponents of short times, larger if the observed order has to be the visible one."""
        return _GENERIC_DECADES if self.visible.is_sharp else _DECADES

    def over(self, t_end: fmpq) -> SteppedSolver:
        return replace(self, t_end=t_end)

    def size(self) -> arb:
        return magnitude(self.reference.to(self._digits_of_reference(FLOAT_DIGITS)), self.problem)

    def rests(self) -> bool:
        """Whether the end equals the start up to round-off."""
        end = self.reference.to(self._digits_of_reference(FLOAT_DIGITS))
        least = self.size() * FLOAT_PRECISION
        pairs = zip(end, self.problem.initial, strict=True)
        return not any(abs(now - arb(then)) > least for now, then in pairs)

    def row(self, h: fmpq, before: StepSizeRow | None) -> StepSizeRow:
        """Errors with enough digits, 0 if these show none; StepFailed if a step was not solved."""
        steps = whole_steps(self.t_end, h)
        digits = self._digits(h, before)
        while True:
            state = run(self._integrator(digits), h, steps, f"h = {h}")
            error = self._distance(state.y, digits)
            if error > self.size() * (arb(10) ** (_SPARE - 1 - digits) * self._amplified(h)):
                break
            if self._shows_no_error(error, digits):
                error = arb(0)
                break
            digits = min(MAX_DIGITS, 2 * digits)
        error = _with_radius(error, self._round_off(digits, h))
        energy, others = self._invariant_errors(state.y, digits, h)
        slope = slope_between(before, h, error)
        return StepSizeRow(h, error, slope, energy, tuple(others), digits, cost_of(state))

    def rounding(self) -> arb:
        """The approximate error from coefficients rounded to the tolerance."""
        if self.tolerance is None:
            return arb(0)
        return self.size() * arb(self.tolerance) * max(arb(1), arb(self.t_end))

    def timed(self, row: StepSizeRow) -> StepSizeRow:
        """The row with the cost of its steps in floats, if these reach its error to a tenth."""
        y, cost = work_of(self._integrator(FLOAT_DIGITS), row.h, whole_steps(self.t_end, row.h))
        if abs(self._distance(y, FLOAT_DIGITS) - row.error) < REACHED * row.error:
            return replace(row, cost=cost)
        return row

    def _shows_no_error(self, error: arb, digits: int) -> bool:
        """Whether an error within round-off counts as zero. Many digits agree only if nothing moves
        or the method is exact: the error of a long step of order p is far above 10^(−8 p). If no
        visible tree fails, as for a constant force, the error is round-off for any digits.
        """
        if digits == MAX_DIGITS:
            return True
        if self.visible.order >= MAX_ORDER and digits >= _ENOUGH:
            return True
        return digits >= _MANY and (error.is_zero() or digits >= _OF_AN_ORDER * self.visible.order)

    def _distance(self, y: Sequence[Any], digits: int) -> arb:
        """‖(Δq, Δp)‖₂ of ``y`` from the reference solution, the centre of its ball."""
        exact = self.reference.to(self._digits_of_reference(digits))
        with ctx.workprec(self._integrator(digits).bits + _GUARD):
            total = arb(0)
            for a, b in zip(y, exact, strict=True):
                total += (arb(a) - b) ** 2
            return total.sqrt().mid()

    def _round_off(self, digits: int, h: fmpq) -> arb:
        """The uncertainty of a state at ``t_end`` from round-off. Steps are summed with
        compensation, so their number does not count; the rounded increments add up to the length of
        the solution's path, and the flow amplifies them.
        """
        precision = arb(FLOAT_PRECISION) if digits <= FLOAT_DIGITS else arb(10) ** -digits
        time = max(arb(1), arb(self.t_end))
        return self.size() * precision * time * GROWTH * self._amplified(h)

    @cached_property
    def _slope(self) -> arb:
        """‖∂f/∂y‖ at the start of a right-hand side; 0 for Hamiltonians."""
        if isinstance(self.problem, Hamiltonian):
            return arb(0)
        return steepness(self.problem)

    def _amplified(self, h: fmpq) -> arb:
        """The amplification of round-off: stiff increments h f are h ‖∂f/∂y‖ times as wrong."""
        return max(arb(1), self._slope * arb(h))

    def _digits_of_reference(self, digits: int) -> int:
        """Digits for the row, beyond floats for the following ones too."""
        if digits <= FLOAT_DIGITS and self.visible.order >= _HIGH:
            digits = _NEXT_DIGITS
        if digits <= FLOAT_DIGITS or self.reference.digits >= digits + _SPARE:
            return digits + _SPARE
        return digits + _SPARE + ceil(_AHEAD * self.visible.order * log10(2))

    def _digits(self, h: fmpq, before: StepSizeRow | None) -> int:
        if before is None:
            return FLOAT_DIGITS
        part = before.error.mid() / self.size()
        decades = float((part.log() / arb(10).log()).mid())
        decades -= self.visible.order * log10(to_float(before.h / h))
        needed = ceil(-decades + log10(float(self._amplified(h)))) + _SPARE
        if needed <= FLOAT_DIGITS:
            return FLOAT_DIGITS
        # in whole tens, so that the same integrator serves several rows
        return min(MAX_DIGITS, max(before.digits or 0, 10 * ceil(needed / 10)))

    def _integrator(self, digits: int) -> Integrator:
        if digits not in self.integrators:
            self.integrators[digits] = self.bound.at(digits)
        return self.integrators[digits]

    def _invariant_errors(
        self, y: Sequence[Any], digits: int, h: fmpq
    ) -> tuple[arb | None, list[arb]]:
        if not conserved_names(self.problem):
            return None, []
        round_off = self._round_off(digits, h)
        with ctx.workprec(self._integrator(digits).bits + _GUARD):
            measure = quantities_function(self.problem, digits + 10)
            possible = [_with_radius(arb(x), round_off) for x in y]
            now = measure(*possible)
            then = measure(*map(arb, self.problem.initial))
            changes = [arb(a) - arb(b) for a, b in zip(now, then, strict=True)]
        errors = [absolute(change) for change in changes]
        if isinstance(self.problem, Hamiltonian):
            return errors[0], errors[1:]
        return None, errors


def _with_radius(x: arb, radius: arb) -> arb:
    return x if x.is_zero() else arb(x.mid(), radius.abs_upper())
