"""The result of a convergence test: a row for each step size, the observed order, and a verdict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, arb_mat, ctx, fmpq

from garkcli.frozen import Frozen
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem
    from garkcli.stepping.linearly_implicit import Taken
    from garkcli.tableau.garkmethod import GarkMethod

Verdict: TypeAlias = Literal["agree", "disagree", "undecided", "reduced"]
"""Undecided if no order is observed, reduced if a stiff problem shows a smaller one."""
MAX_ORDER = 120
CLOSE = 0.05
"""The tolerance of the observed order."""
_FITTED = 4  # rows that the order is extrapolated from
_CROSSING = 0.25  # how far an order is extrapolated from stiff slopes
_BITS = 256  # of the extrapolation: far more than any error has


class Cost(Frozen):
    """The cost of a row; evaluations include Newton's method, seconds are of floats alone."""

    steps: int
    evaluations: int
    iterations: int
    jacobians: int
    seconds: float | None = None


class StepSizeRow(Frozen):
    """One step size.

    Errors are balls with the uncertainty of the computation as radius: one that contains 0 is below
    round-off, and 0 itself is proved. They reach below the range of floats.

    Attributes:
        h: the step size.
        error: ‖(Δq, Δp)‖₂ from the exact solution at t_end, ‖(Δq, Δp/ω)‖₂ on the oscillator. Its
            ball contains 0 only if the method makes no error.
        slope: of log error over log h, between the row before and this one; None in the first row.
        energy_error: |H(t_end) − H(0)|; None if the problem has no energy.
        invariant_errors: |I(t_end) − I(0)| for each invariant of the problem besides H.
        digits: the digits of the computation, 15 for floats; None if nothing was rounded.
        cost: of the steps; None if they were not taken one by one.
    """

    h: fmpq
    error: arb
    slope: float | None
    energy_error: arb | None
    invariant_errors: tuple[arb, ...] = ()
    digits: int | None = None
    cost: Cost | None = None

    def __repr__(self) -> str:
        slope = "" if self.slope is None else f", slope {self.slope:.2f}"
        return f"<Row h = {self.h}: error {float(self.error):.1e}{slope}>"


class Visible(Frozen):
    """The trees of a method that a problem sees.

    Attributes:
        order: the order of the method by these trees only.
        is_sharp: whether no higher order can be observed; others may hide trees, or cancel errors.
    """

    order: int
    is_sharp: bool
    trees: str


class Stiffness(Frozen):
    """The stiffness of a run whose steps do not resolve the fastest part of the problem:
    ``resolution`` h ‖∂f/∂y‖ of the smallest step is far above 1. ``weak_stage_order`` is None if
    the search stopped; ``is_stable`` says that the error of the smallest step is a small part of
    the solution.
    """

    resolution: float
    stage_order: int | None
    weak_stage_order: int | None
    is_stable: bool


class Convergence(Shown, Frozen):
    """The outcome of a convergence test.

    Attributes:
        problem: the problem and its split.
        t_end: the time at which errors are taken.
        rows: from the largest step to the smallest; a single one with the error 0 if there is none.
        plateau: the number of last rows that show the rounding of the coefficients, not fitted.
        observed_order: extrapolated from the last rows before the plateau to h = 0; None for a
            single row.
        predicted_order: the order for every problem, by the certificate.
        visible: the trees that the problem sees; their order is at least the predicted one.
        short_time: of the observation with tiny steps; None if it was not needed, or rounded.
        short_order: the order observed over it.
        has_settled: whether the slopes before the plateau have settled.
        are_given: whether the caller chose the step sizes, which then have to show the order.
        stiff: the stiffness if no step size resolves the problem.
        is_at_rest: whether errors are missing because the solution ends where it starts.
        method: the method, if more than its tableau is known.
        jacobian: the matrix that a Rosenbrock method used for the Jacobian.

    >>> from garkcli import converge
    >>> found = converge("heun")
    >>> round(found.observed_order, 1), found.predicted_order
    (2.0, 2)
    """

    problem: Oscillator | Problem
    t_end: fmpq
    rows: tuple[StepSizeRow, ...]
    plateau: int
    observed_order: float | None
    predicted_order: int
    visible: Visible
    short_time: fmpq | None = None
    short_order: float | None = None
    has_settled: bool = True
    are_given: bool = False
    stiff: Stiffness | None = None
    is_at_rest: bool = False
    method: GarkMethod | None = None
    jacobian: Taken = "exact"

    @property
    def visible_order(self) -> int:
        """The order by the trees that the problem sees."""
        return self.visible.order

    @property
    def hides_failure(self) -> bool:
        """Whether the problem does not see the trees at which the method fails."""
        return self.visible.order > self.predicted_order

    @property
    def is_exact(self) -> bool:
        """Whether the method makes no error on the problem."""
        return all(row.error.is_zero() for row in self.rows)

    @property
    def exit_code(self) -> int:
        """0 if the visible order is observed or it is too stiff, 1 for another, 3 for none."""
        return {"agree": 0, "reduced": 0, "disagree": 1, "undecided": 3}[self.verdict]

    @property
    def verdict(self) -> Verdict:
        """Whether the observed order is the visible one, or at least it if the problem may hide
        some trees.

        Undecided if no order is observed: there are no errors, they grow as steps shrink, or the
        rounding of the coefficients comes before the slopes have settled. Reduced if the steps are
        too large for a stiff problem, unless tiny ones show another order.
        """
        if self.observed_order is None:
            return "undecided"
        if self.stiff is not None:
            return self._stiff_verdict(self.observed_order)
        if self.short_order is None:
            if self._is_visible(self.observed_order):
                return "agree"
            return "disagree" if self.has_settled else "undecided"
        is_shown = not self.are_given or abs(self.observed_order - self.short_order) <= CLOSE
        if is_shown and self._is_visible(self.short_order):
            return "agree" if self.observed_order > 0 else "undecided"
        return "disagree"

    @property
    def is_left_to_tiny_steps(self) -> bool:
        """Whether the visible order shows with tiny steps only."""
        observed, short = self.observed_order, self.short_order
        if self.verdict != "agree" or observed is None or short is None:
            return False
        return abs(observed - short) > CLOSE

    @property
    def shown_order(self) -> int:
        """The order to which the errors of the rows are compared."""
        observed = self.observed_order
        if not self.is_left_to_tiny_steps or observed is None:
            return self.visible_order
        nearest = round(observed)
        return nearest if abs(observed - nearest) <= CLOSE else self.visible_order

    def _stiff_verdict(self, observed: float) -> Verdict:
        assert self.stiff is not None
        if not self.stiff.is_stable:
            return "disagree"
        if self.short_order is not None and not self._is_visible(self.short_order):
            return "disagree"
        is_reached = observed >= self.visible.order - CLOSE
        return "agree" if is_reached else "reduced"

    def _is_visible(self, order: float) -> bool:
        if self.visible.order < self.predicted_order:
            return False
        excess = order - self.visible.order
        return abs(excess) <= CLOSE or (excess > 0 and not self.visible.is_sharp)

    @property
    def agrees(self) -> bool:
        return self.verdict == "agree"

    def __repr__(self) -> str:
        seen = "no observed order"
        if self.observed_order is not None:
            seen = f"observed order {self.observed_order:.1f}"
        return f"<Convergence {self.problem.name}: {seen}, {self.verdict}>"


def curve(result: Convergence, against: str) -> Iterator[tuple[float | fmpq, arb]]:
    """The points (x, error) over h, evaluations or seconds, if both are known and positive."""
    for row in result.rows:
        x = row.h if against == "h" else getattr(row.cost, against, None)
        if x is not None and row.error > 0:
            yield x, row.error


def absolute(x: arb) -> arb:
    """|x|; a ball that contains 0 becomes one about 0."""
    if not x.contains(0):
        return abs(x)
    return x if x.is_zero() else arb(0, 2 * x.rad())


def slope_between(before: StepSizeRow | None, h: fmpq, error: arb) -> float | None:
    """The slope of log error over log h between two rows; None without a row or an error."""
    if before is None or error.contains(0):
        return None
    rise = (before.error / error).log()
    return float((rise / (arb(before.h) / arb(h)).log()).mid())


def stiff_order(rows: Sequence[StepSizeRow]) -> float | None:
    """The order that slopes of a stiff problem show: extrapolated, but not far beyond the last
    slope. Two errors compete, h^p and a smaller multiple of a lower power; where they change places
    slopes fall so fast that the extrapolation would end below both.
    """
    order, last = observed_order(rows), rows[-1].slope
    if order is None or last is None or abs(order - last) <= _CROSSING:
        return order
    return last


def observed_order(rows: Sequence[StepSizeRow]) -> float | None:
    """The order p in log error = log C + p log h + a h + b h² through the last four rows. The
    slopes converge to p like h; with two terms of the expansion of the error the estimate converges
    like h³. Fewer rows have fewer terms; one row has no order.
    """
    last = rows[-_FITTED:]
    if len(last) < 2:
        return None
    with ctx.workprec(_BITS):
        equations = []
        for row in last:
            ratio = arb(row.h / last[0].h)
            log_h = arb(row.h).log()
            equations.append([arb(1), log_h, ratio, ratio * ratio][: len(last)])
        logarithms = [[row.error.mid().log()] for row in last]
        return float(arb_mat(equations).solve(arb_mat(logarithms))[1, 0])
