"""The convergence test on nonlinear problems: errors over a ladder of step sizes, against the order
they can show.

Slopes at steps of usual size may still be those of larger ones, where the error constant is small
or coefficients are large. Then the order is observed over a short time as well, with steps so small
that nothing is left of that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.convergence import ladder
from garkcli.convergence.convergence import CLOSE, MAX_ORDER, Verdict, observed_order
from garkcli.convergence.reference import Watch
from garkcli.convergence.trial import MAX_STEPS, PathRow, Trial
from garkcli.order.certificate import find_order
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.stepping.dependency import visible_tableau, visible_trees
from garkcli.stepping.integrator import bind
from garkcli.stepping.step import StepFailed
from garkcli.tableau.tableau import Tableau

SHORT = 10**6
"""The part of the usual time that a short one is."""
_SHORT_STEPS = (4, 8, 16, 32)
# short times that are tried, each that part of the one before, until the order is a whole number
_SHORTER = 3


@dataclass(frozen=True)
class Observation:
    """The outcome of a convergence test on a nonlinear problem.

    Attributes:
        problem: the problem and its split.
        t_end: the time at which errors ‖(Δq, Δp)‖₂ are taken.
        rows: from the largest step to the smallest. A single one with the error 0 where the method
            makes no error that ``trial.MAX_DIGITS`` digits show.
        plateau: how many of the last rows show the rounding of the coefficients; they are not
            fitted.
        observed_order: extrapolated from the last rows before the plateau to h = 0; None for a
            single row.
        predicted_order: of the tableau, by the certificate.
        visible_order: the order by the trees that the problem can see, ≥ ``predicted_order``. A
            problem may hide more of them than its form tells, or let their errors cancel, so the
            observed order may be larger; only for ``generic`` it is this one.
        sees: which trees these are, in one line.
        short_time: the time of the observation with tiny steps; None where there was no need for
            it, and for rounded coefficients, whose errors are then all rounding.
        short_order: the order observed then.
        has_settled: whether the slopes before the plateau have.
        are_given: whether the step sizes were asked for: then it is these that have to show the
            order.
    """

    problem: Hamiltonian
    t_end: fmpq
    rows: tuple[PathRow, ...]
    plateau: int
    observed_order: float | None
    predicted_order: int
    visible_order: int
    sees: str
    short_time: fmpq | None = None
    short_order: float | None = None
    has_settled: bool = True
    are_given: bool = False

    @property
    def is_exact(self) -> bool:
        """Whether the method makes no error on the problem."""
        return all(row.error.is_zero() for row in self.rows)

    @property
    def verdict(self) -> Verdict:
        """Whether the order is the visible one, or at least that where the problem may hide some
        trees.

        Undecided where there is no order to be seen, or where the rounding of the coefficients
        comes before the slopes have settled.
        """
        if self.observed_order is None:
            return "agree" if self.is_exact else "undecided"
        if self._is_visible(self.observed_order) and self.short_order is None:
            return "agree"
        if self.short_order is None:
            return "disagree" if self.has_settled else "undecided"
        is_shown = not self.are_given or abs(self.observed_order - self.short_order) <= CLOSE
        return "agree" if is_shown and self._is_visible(self.short_order) else "disagree"

    def _is_visible(self, order: float) -> bool:
        excess = order - self.visible_order
        return abs(excess) <= CLOSE or (excess > 0 and not self.problem.is_generic)

    @property
    def agrees(self) -> bool:
        """Whether the verdict is that they agree."""
        return self.verdict == "agree"


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
        tableau: of any structure.
        problem: in as many terms as the tableau is for, or in one that has a natural split.
        t_end: the problem's own by default.
        steps: step sizes that divide ``t_end``; by default the ladder of
            ``garkcli.convergence.ladder``.
        tolerance: of rounded coefficients; slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well.
        watch: is told how far each run is.

    Raises:
        UsageProblem: the problem is not of the form of the structure, or a step does not divide
            ``t_end``.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.

    >>> from garkcli import hamiltonian, loads
    >>> rk4 = loads("methods: [{family: rk4}]").tableau
    >>> result = observe(rk4, hamiltonian("pendulum", 1))
    >>> round(result.observed_order, 1), result.verdict
    (4.0, 'agree')
    """
    bound = bind(tableau, problem)
    tableau, problem, fields = bound.tableau, bound.problem, bound.fields
    t_end = problem.t_end if t_end is None else t_end
    seen = visible_tableau(tableau, fields)
    predicted, order = (_order(x, tolerance) for x in (tableau, seen))
    trial = Trial(bound, t_end, order, watch)
    rows = _default_rows(trial, tolerance, is_timed) if steps is None else _given_rows(trial, steps)
    plateau = ladder.plateau(rows, order, trial.rounding(tolerance))
    fitted = rows[: len(rows) - plateau]
    observed = observed_order(fitted)
    if is_timed:
        rows = [trial.timed(row) for row in rows]
    short_time: fmpq | None = None
    short_order: float | None = None
    is_off = observed is not None and abs(observed - order) > CLOSE
    if is_off and tolerance is None:
        for k in range(1, _SHORTER + 1):
            short_time = min(t_end, problem.t_end) / SHORT**k
            short_order = _short_order(Trial(bound, short_time, order, watch))
            if short_order is None or abs(short_order - round(short_order)) <= CLOSE:
                break
    return Observation(
        problem,
        t_end,
        tuple(rows),
        plateau,
        observed,
        predicted,
        order,
        visible_trees(fields),
        short_time,
        short_order,
        tolerance is None or (len(fitted) >= ladder.ROWS and ladder.has_settled(fitted)),
        steps is not None,
    )


def _order(tableau: Tableau, tolerance: fmpq | None) -> int:
    if tolerance is None:
        return find_order(tableau, MAX_ORDER).order
    from garkcli.order.rounded import find_order_within

    return find_order_within(tableau, tolerance).order


def _given_rows(trial: Trial, steps: Sequence[fmpq]) -> list[PathRow]:
    rows: list[PathRow] = []
    for h in sorted(set(steps), reverse=True):
        rows.append(trial.row(h, rows[-1] if rows else None))
        if rows[-1].error.is_zero():
            return rows[-1:]
    return rows


def _default_rows(trial: Trial, tolerance: fmpq | None, is_timed: bool) -> list[PathRow]:
    """The ladder of ``garkcli.convergence.ladder``; step sizes too large for Newton's method are
    left out.

    Where costs are compared it keeps its coarse steps: large errors are asked for as well.
    """
    rows: list[PathRow] = []
    is_small: list[bool] = []
    plateau = 0
    for h in ladder.halvings(trial.t_end):
        is_coarse = h * ladder.MAX_COARSE > trial.t_end
        if rows and trial.t_end / h > MAX_STEPS:
            break
        try:
            rows.append(trial.row(h, rows[-1] if rows else None))
        except StepFailed:
            if any(is_small) or not is_coarse:
                raise
            rows, is_small = [], []
            continue
        if rows[-1].error.is_zero():
            return rows[-1:]
        is_small.append(trial.is_small(rows[-1]) or not is_coarse)
        plateau = ladder.plateau(rows, trial.order, trial.rounding(tolerance))
        if plateau > 1 or ladder.is_complete(rows, is_small):
            break
    return ladder.trimmed(rows, is_small, plateau, may_be_off=is_timed)


def _short_order(trial: Trial) -> float | None:
    """The order over the time of ``trial``; None where the problem or the method has no error
    there.
    """
    rows: list[PathRow] = []
    for n in _SHORT_STEPS:
        rows.append(trial.row(trial.t_end / n, rows[-1] if rows else None))
        if rows[-1].error.is_zero():
            return None
    return observed_order(rows)
