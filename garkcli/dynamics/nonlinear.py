"""The convergence test on nonlinear problems: errors over a ladder of step sizes, against the order they can show.

Each row of the table is computed with as many digits as its error needs: floats where they do, more where the
error would fall below round-off. The reference solution has more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import ceil, log10
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.dynamics import ladder
from garkcli.dynamics.convergence import CLOSE, Row, observed_order
from garkcli.dynamics.hamiltonian import FLOAT_DIGITS, Hamiltonian, energy_function
from garkcli.dynamics.linear import whole_steps
from garkcli.dynamics.reference import Reference, Watch, magnitude, reference, run
from garkcli.dynamics.scheme import Scheme, scheme
from garkcli.dynamics.step import StepFailed
from garkcli.dynamics.structure import fields_of, sight, visible
from garkcli.dynamics.work import MAX_DIGITS, REACHED, cost_of, work_of
from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.order.certificate import find_order
from garkcli.tableau.tableau import Tableau

MAX_STEPS = 1_000_000
"""Most steps of one row."""
_SPARE = 6  # correct digits of an error
_AHEAD = 2  # halvings of the step for which a reference solution will do


@dataclass(frozen=True)
class PathRow(Row):
    """One step size on a nonlinear problem.

    Attributes:
        digits: that the row was computed with; ``FLOAT_DIGITS`` are floats with compensated summation.
        invariant_errors: |I(t_end) − I(0)| for each invariant of the problem besides H. These and the energy
            error are good to ``digits`` digits of the invariant itself, not of the error.
    """

    digits: int
    invariant_errors: tuple[arb, ...] = ()


@dataclass(frozen=True)
class Observation:
    """The outcome of a convergence test on a nonlinear problem.

    Attributes:
        problem: the problem and its split.
        t_end: the time at which errors ‖(Δq, Δp)‖₂ are taken.
        rows: from the largest step to the smallest.
        plateau: how many of the last rows show the rounding of the coefficients; they are not fitted.
        observed_order: extrapolated from the last rows before the plateau to h = 0; None for a single row.
        predicted_order: of the tableau, by the certificate.
        visible_order: the order by the trees that the problem can see, ≥ ``predicted_order``.
        sees: which trees these are, in one line.
    """

    problem: Hamiltonian
    t_end: fmpq
    rows: tuple[PathRow, ...]
    plateau: int
    observed_order: float | None
    predicted_order: int
    visible_order: int
    sees: str

    @property
    def agrees(self) -> bool:
        """Whether the observed order is the visible one; it may be larger where equal parts can cancel errors."""
        if self.observed_order is None or self.visible_order < self.predicted_order:
            return False
        excess = self.observed_order - self.visible_order
        return excess >= -CLOSE if self.problem.has_equal_parts else abs(excess) <= CLOSE


def observe(
    tableau: Tableau,
    problem: Hamiltonian,
    t_end: fmpq | None = None,
    steps: Sequence[fmpq] | None = None,
    tolerance: fmpq | None = None,
    is_timed: bool = False,
    watch: Watch | None = None,
) -> Observation:
    """Test the convergence of ``tableau`` on ``problem``.

    Args:
        tableau: any tableau whose structure the problem is of, made for it by ``fitted``.
        problem: split into as many terms as the tableau has.
        t_end: the problem's own by default.
        steps: step sizes that divide ``t_end``; by default the ladder of ``garkcli.dynamics.ladder``.
        tolerance: of rounded coefficients; slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well.
        watch: is told how far each run is.

    Raises:
        UsageProblem: the problem is not of the form of the structure, a step does not divide ``t_end``, or no
            step size has an error.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.
    """
    t_end = problem.t_end if t_end is None else t_end
    fields = fields_of(tableau, problem)
    seen = visible(tableau, fields)
    predicted, order = (_order(x, tolerance) for x in (tableau, seen))
    test = _Test(tableau, problem, t_end, order, watch)
    rows = _default_rows(test, tolerance is not None, is_timed) if steps is None else _given_rows(test, steps)
    plateau = ladder.plateau(rows, order) if tolerance is not None else 0
    observed = observed_order(rows[: len(rows) - plateau])
    if is_timed:
        rows = [test.timed(row) for row in rows]
    return Observation(problem, t_end, tuple(rows), plateau, observed, predicted, order, sight(fields))


def _order(tableau: Tableau, tolerance: fmpq | None) -> int:
    if tolerance is None:
        return find_order(tableau).order
    from garkcli.order.rounded import find_order_within

    return find_order_within(tableau, tolerance).order


def _given_rows(test: _Test, steps: Sequence[fmpq]) -> list[PathRow]:
    rows: list[PathRow] = []
    for h in sorted(set(steps), reverse=True):
        rows.append(test.row(h, rows[-1] if rows else None))
    return rows


def _default_rows(test: _Test, is_rounded: bool, is_timed: bool) -> list[PathRow]:
    """The ladder of ``garkcli.dynamics.ladder``; step sizes too large for Newton's method are left out.

    Where costs are compared it keeps its coarse steps: large errors are asked for as well.
    """
    rows: list[PathRow] = []
    is_small: list[bool] = []
    for h in ladder.halvings(test.t_end):
        is_coarse = h * ladder.MAX_COARSE > test.t_end
        try:
            rows.append(test.row(h, rows[-1] if rows else None))
        except StepFailed:
            if any(is_small) or not is_coarse:
                raise
            rows, is_small = [], []
            continue
        is_small.append(test.is_small(rows[-1]) or not is_coarse)
        plateau = ladder.plateau(rows, test.order) if is_rounded else 0
        if plateau > 1 or ladder.is_complete(rows, is_small):
            return ladder.trimmed(rows, is_small, plateau, may_be_off=is_timed)
    raise AssertionError("halvings end only with the loop")


@dataclass
class _Test:
    """One method on one problem, and what is kept between step sizes."""

    tableau: Tableau
    problem: Hamiltonian
    t_end: fmpq
    order: int
    watch: Watch | None
    schemes: dict[int, Scheme] = field(default_factory=dict)
    reference: Reference = field(init=False)

    def __post_init__(self) -> None:
        self.reference = reference(self.problem, self.t_end)

    def row(self, h: fmpq, before: PathRow | None) -> PathRow:
        """Errors at ``t_end``, with digits enough for them."""
        steps = whole_steps(self.t_end, h)
        if steps > MAX_STEPS:
            raise UsageProblem(f"{steps} steps (limit {MAX_STEPS})", "choose a shorter time or larger steps")
        digits = self._digits(h, before)
        while True:
            state = run(self._scheme(digits), h, steps, self.watch, f"h = {h}")
            error = self._error(state.y, digits)
            if error > self._size * arb(10) ** (_SPARE - 1 - digits):
                break
            if digits == MAX_DIGITS:
                raise UsageProblem(f"the error for h = {h} is below 10^-{MAX_DIGITS}", "choose larger steps")
            digits = min(MAX_DIGITS, 2 * digits)
        slope = None if before is None else float((before.error / error).log() / (arb(before.h) / arb(h)).log())
        energy, *others = self._invariant_errors(state.y, digits)
        return PathRow(h, error, slope, energy, digits, tuple(others), cost=cost_of(state))

    def is_small(self, row: PathRow) -> bool:
        """Whether the error is a small part of the solution."""
        return bool(row.error < self._size * ladder.LARGEST / 2)  # the size counts start and end

    def timed(self, row: PathRow) -> PathRow:
        """The row with the cost of its steps in floats, where these reach its error to a tenth."""
        y, cost = work_of(self._scheme(FLOAT_DIGITS), row.h, whole_steps(self.t_end, row.h))
        difference = abs(self._error(y, FLOAT_DIGITS) - row.error)
        return replace(row, cost=cost) if difference < REACHED * row.error else row

    @property
    def _size(self) -> arb:
        return magnitude(self.reference.y, self.problem)

    def _error(self, y: Sequence[Any], digits: int) -> arb:
        """The distance of ``y`` from the reference solution."""
        exact = self.reference.to(self._digits_of_reference(digits), self.watch)
        with ctx.workprec(self._scheme(digits).bits + 32):
            return sum(((arb(a) - b) ** 2 for a, b in zip(y, exact, strict=True)), arb(0)).sqrt().mid()

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
        # in whole tens, so that the same scheme serves several rows
        return (
            FLOAT_DIGITS if needed <= FLOAT_DIGITS else min(MAX_DIGITS, max(before.digits, -(-needed // 10) * 10))
        )

    def _scheme(self, digits: int) -> Scheme:
        if digits not in self.schemes:
            self.schemes[digits] = scheme(self.tableau, self.problem, digits)
        return self.schemes[digits]

    def _invariant_errors(self, y: Sequence[Any], digits: int) -> list[arb]:
        bits = self.schemes[digits].bits + 32
        with ctx.workprec(bits):
            measure = energy_function(self.problem, digits + 10)
            now, then = measure(*map(arb, y)), measure(*map(arb, self.problem.initial))
            return [abs(a - b).mid() for a, b in zip(now, then, strict=True)]
