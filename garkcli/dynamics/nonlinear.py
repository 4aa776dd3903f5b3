"""The convergence test on nonlinear problems: errors over a ladder of step sizes, against the order they can show.

Each row of the table is computed with as many digits as its error needs: floats where they do, more where the
error would fall below round-off. The reference solution is a Gauss method on the unsplit problem, with steps so
small that halving them changes nothing in the digits used.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from math import ceil, log2
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.dynamics.convergence import CLOSE, Row, observed_order
from garkcli.dynamics.hamiltonian import FLOAT_DIGITS, Hamiltonian, energy_function
from garkcli.dynamics.linear import whole_steps
from garkcli.dynamics.scheme import Scheme, scheme
from garkcli.dynamics.step import StepFailed, final
from garkcli.dynamics.structure import fields_of, sight, visible
from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.order.certificate import find_order
from garkcli.tableau.tableau import Tableau

ROWS = 5
"""Step sizes of the default ladder; more only while the slopes still move."""
MAX_ROWS = 9
"""Most step sizes of the default ladder."""
MAX_DIGITS = 250
"""Most digits: corrections of Newton's method are floats, which end soon after."""
MAX_STEPS = 1_000_000
"""Most steps of one row."""
_SPARE = 6  # correct digits of an error
_FLAT = 0.25  # how far a slope on the plateau is below the order
_ABOVE = 300  # how many times the error of the plateau an error has to be to count
_SETTLED = 0.01  # change between two slopes at which the ladder may end


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
) -> Observation:
    """Test the convergence of ``tableau`` on ``problem``.

    Args:
        tableau: any tableau whose structure the problem is of, made for it by ``fitted``.
        problem: split into as many terms as the tableau has.
        t_end: the problem's own by default.
        steps: step sizes that divide ``t_end``; by default an eighth, halved until the slopes have settled.
        tolerance: of rounded coefficients; slopes may then end on a plateau.

    Raises:
        UsageProblem: the problem is not of the form of the structure, a step does not divide ``t_end``, or no
            step size has an error.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.
    """
    t_end = problem.t_end if t_end is None else t_end
    fields = fields_of(tableau, problem)
    seen = visible(tableau, fields)
    predicted, order = (_order(x, tolerance) for x in (tableau, seen))
    test = _Test(tableau, problem, t_end, order)
    rows = _default_rows(test, tolerance is not None) if steps is None else _given_rows(test, steps)
    plateau = _plateau(rows, order) if tolerance is not None else 0
    observed = observed_order(rows[: len(rows) - plateau])
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


def _default_rows(test: _Test, is_rounded: bool) -> list[PathRow]:
    """The ladder from h ≈ 1/8 down; step sizes too large for Newton's method are left out."""
    rows: list[PathRow] = []
    observed: list[float] = []
    for h in _halvings(test.t_end):
        try:
            rows.append(test.row(h, rows[-1] if rows else None))
        except StepFailed:
            if rows or h * 4000 < test.t_end:
                raise
            continue
        if is_rounded and _plateau(rows, test.order) > 1:
            break
        observed.append(observed_order(rows) or 0.0)
        if len(rows) == MAX_ROWS or (len(rows) >= ROWS and _has_settled(rows, observed)):
            break
    return rows


def _halvings(t_end: fmpq) -> Iterator[fmpq]:
    whole_steps(t_end, t_end)  # refuses a time that is not positive
    n = max(int((8 * t_end).ceil()), 4)
    for k in count():
        yield t_end / (n * 2**k)


def _has_settled(rows: Sequence[Row], observed: Sequence[float]) -> bool:
    """Whether the last two slopes, or the last two extrapolated orders, are the same."""
    before, last = rows[-2].slope, rows[-1].slope
    if before is None or last is None:
        return False
    return abs(last - before) < _SETTLED or abs(observed[-1] - observed[-2]) < _SETTLED / 2


def _plateau(rows: Sequence[Row], order: int) -> int:
    """How many rows at the end are no longer of ``order``: from the first flat one after one that had it.

    Rows before it whose error is not far above that of the flat ones are spoilt by the rounding too.
    """
    had = [i for i, row in enumerate(rows) if row.slope is not None and row.slope > order - _FLAT]
    flat = [i for i in range(had[0] if had else len(rows), len(rows)) if _is_flat(rows[i], order)]
    if not flat:
        return 0
    level = min((row.error for row in rows[flat[0] :]), key=float) * _ABOVE
    return len(rows) - next(i for i, row in enumerate(rows) if i == flat[0] or row.error < level)


def _is_flat(row: Row, order: int) -> bool:
    return row.slope is not None and row.slope < order - _FLAT


@dataclass
class _Test:
    """One method on one problem, and what is kept between step sizes."""

    tableau: Tableau
    problem: Hamiltonian
    t_end: fmpq
    order: int
    schemes: dict[int, Scheme] = field(default_factory=dict)
    reference: tuple[arb, ...] = ()
    correct: int = 0  # digits of the reference

    def row(self, h: fmpq, before: PathRow | None) -> PathRow:
        """Errors at ``t_end``, with digits enough for them."""
        steps = whole_steps(self.t_end, h)
        if steps > MAX_STEPS:
            raise UsageProblem(f"{steps} steps (limit {MAX_STEPS})", "choose a shorter time or larger steps")
        digits = self._digits(h, before)
        while True:
            y = final(self._scheme(digits), h, steps)
            self._refer(digits)
            with ctx.workprec(self.schemes[digits].bits + 32):
                error = (
                    sum(((arb(a) - b) ** 2 for a, b in zip(y, self.reference, strict=True)), arb(0)).sqrt().mid()
                )
                size = sum((abs(b) for b in self.reference), arb(1))
                if error > size * arb(10) ** (_SPARE - 1 - digits):
                    break
            if digits == MAX_DIGITS:
                raise UsageProblem(f"the error for h = {h} is below 10^-{MAX_DIGITS}", "choose larger steps")
            digits = min(MAX_DIGITS, 2 * digits)
        slope = None if before is None else float((before.error / error).log() / (arb(before.h) / arb(h)).log())
        energy, *others = self._invariant_errors(y, digits)
        return PathRow(h, error, slope, energy, digits, tuple(others))

    def _digits(self, h: fmpq, before: PathRow | None) -> int:
        """Digits for the error that the row before and the order let expect."""
        if before is None:
            return FLOAT_DIGITS if self.order <= 6 else 30
        decades = float(before.error.log() / arb(10).log()) - self.order * log2(to_float(before.h / h)) / log2(10)
        needed = ceil(-decades) + _SPARE
        # in whole tens, so that the same scheme serves several rows
        return (
            FLOAT_DIGITS if needed <= FLOAT_DIGITS else min(MAX_DIGITS, max(before.digits, -(-needed // 10) * 10))
        )

    def _scheme(self, digits: int) -> Scheme:
        if digits not in self.schemes:
            self.schemes[digits] = scheme(self.tableau, self.problem, digits)
        return self.schemes[digits]

    def _refer(self, digits: int) -> None:
        if self.correct < digits + _SPARE:
            self.correct = digits + _SPARE
            self.reference = solution(self.problem, self.t_end, self.correct)

    def _invariant_errors(self, y: Sequence[Any], digits: int) -> list[arb]:
        bits = self.schemes[digits].bits + 32
        with ctx.workprec(bits):
            measure = energy_function(self.problem, digits + 10)
            now, then = measure(*map(arb, y)), measure(*map(arb, self.problem.initial))
            return [abs(a - b).mid() for a, b in zip(now, then, strict=True)]


@cache
def solution(problem: Hamiltonian, t_end: fmpq, digits: int) -> tuple[arb, ...]:
    """(q, p) at ``t_end``, shape (2d,), with an error below 10^(−digits) by the change when steps are halved.

    Raises:
        StepFailed: the problem has no solution up to there, or one too close to a singularity.
    """
    from garkcli.families.registry import diagonal_method
    from garkcli.tableau.forms import gark

    stages = min(14, max(5, digits // 4))
    method = scheme(gark([diagonal_method("gauss", stages)], {}), problem.unsplit(), digits + 5)
    steps = max(8, ceil(8 * to_float(t_end)))
    while True:
        try:
            coarse, fine = (final(method, t_end / n, n) for n in (steps, 2 * steps))
        except StepFailed:
            if steps > 10_000:
                raise
            steps *= 4
            continue
        with ctx.workprec(method.bits):
            change = max(float(abs(a - b)) for a, b in zip(coarse, fine, strict=True))
        if change < 10.0**-digits:
            return tuple(fine)
        factor = (change * 10.0**digits) ** (1 / (2 * stages))
        steps = max(steps + 1, ceil(steps * min(factor * 1.1, 8)))
