"""What a convergence test finds: a row a step size, the order they show, and a verdict."""

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
"""Of observed and visible order; undecided where there is no order to be seen, reduced where steps
that do not resolve a stiff problem show a smaller one.
"""
MAX_ORDER = 120
"""Where the certificate stops to look for a higher order."""
CLOSE = 0.05
"""How near the observed order is to the order it agrees with."""
_FITTED = 4  # rows that the order is extrapolated from
_CROSSING = 0.25  # how far an order is extrapolated from stiff slopes
_BITS = 256  # of the extrapolation: far more than any error has


class Cost(Frozen):
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


class Row(Frozen):
    """One step size.

    Errors are balls. Their radius is what the digits of the computation leave open, so a ball that
    contains 0 is below round-off, and 0 itself is proved. They reach below the range of floats.

    Attributes:
        h: the step size.
        error: the distance from the exact solution at t_end: ‖(Δq, Δp)‖₂, and ‖(Δq, Δp/ω)‖₂ on the
            oscillator. Its ball holds 0 only where it is 0: the method makes no error.
        slope: of log error over log h, between the row before and this one; None in the first row.
        energy_error: |H(t_end) − H(0)|; None where the problem has no energy.
        invariant_errors: |I(t_end) − I(0)| for each invariant of the problem besides H.
        digits: that the row was computed with, 15 for floats; None where nothing was rounded.
        cost: of the steps; None where they were not taken one by one.
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
    """The trees of a method that a problem can see.

    Attributes:
        order: of the method by these trees alone.
        is_sharp: whether an order above it cannot be observed. A problem may hide more trees than
            its form tells, or let their errors cancel.
        trees: which ones they are, in one line.
    """

    order: int
    is_sharp: bool
    trees: str


class Stiffness(Frozen):
    """What tells a stiff run, whose steps do not resolve the fastest part of the problem.

    Attributes:
        resolution: h ‖∂f/∂y‖ of the smallest step, far above 1.
        stage_order: the largest q for which B(q) and C(q) hold; None for a Rosenbrock method.
        weak_stage_order: up to which order what the stages miss never reaches the new value; None
            where the search for it stopped.
        is_stable: whether the error of the smallest step is a small part of the solution.
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
        rows: from the largest step to the smallest. A single one with the error 0 where the method
            makes no error on the problem.
        plateau: how many of the last rows show the rounding of the coefficients; they are not
            fitted.
        observed_order: extrapolated from the last rows before the plateau to h = 0; None for a
            single row.
        predicted_order: of the tableau for every problem, by the certificate.
        visible: what the problem can see; its order is at least the predicted one.
        short_time: the time of the observation with tiny steps; None where there was no need for
            it, and for rounded coefficients, whose errors are then all rounding.
        short_order: the order observed then.
        has_settled: whether the slopes before the plateau have.
        are_given: whether the caller chose the step sizes: then these have to show the
            order.
        stiff: where no step size resolves the problem.
        is_at_rest: whether there are no errors because nothing moves: the solution ends where it
            starts.
        method: what stepped, where it is known by more than its tableau.
        jacobian: what a Rosenbrock method took for the Jacobian.
    """

    problem: Oscillator | Problem
    t_end: fmpq
    rows: tuple[Row, ...]
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
        """The order by the trees that the problem can see."""
        return self.visible.order

    @property
    def hides_failure(self) -> bool:
        """Whether the trees at which the method fails are none that the problem sees."""
        return self.visible.order > self.predicted_order

    @property
    def is_exact(self) -> bool:
        """Whether the method makes no error on the problem."""
        return all(row.error.is_zero() for row in self.rows)

    @property
    def exit_code(self) -> int:
        """Of ``gark converge``: 0 the order that is to be seen is seen, or the problem is too stiff
        for it, 1 another one is, 3 none is.
        """
        return {"agree": 0, "reduced": 0, "disagree": 1, "undecided": 3}[self.verdict]

    @property
    def verdict(self) -> Verdict:
        """Whether the order is the visible one, or at least that where the problem may hide some
        trees.

        Undecided where there is no order to be seen, also because there are no errors, or because
        they grow as steps shrink, or where the rounding of the coefficients comes before the slopes
        have settled. Reduced where the steps are too large for a stiff problem to show it, unless
        tiny ones show another one.
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
        """Whether the verdict is that they agree."""
        return self.verdict == "agree"

    def __repr__(self) -> str:
        seen = "no observed order"
        if self.observed_order is not None:
            seen = f"observed order {self.observed_order:.1f}"
        return f"<Convergence {self.problem.name}: {seen}, {self.verdict}>"


def curve(result: Convergence, against: str) -> Iterator[tuple[float | fmpq, arb]]:
    """The points (x, error) over h, evaluations or seconds, where both are known and positive."""
    for row in result.rows:
        x = row.h if against == "h" else getattr(row.cost, against, None)
        if x is not None and row.error > 0:
            yield x, row.error


def absolute(x: arb) -> arb:
    """|x|; a ball that holds 0 becomes one about 0, whose radius does not depend on where the
    middle came out.
    """
    if not x.contains(0):
        return abs(x)
    return x if x.is_zero() else arb(0, 2 * x.rad())


def slope_between(before: Row | None, h: fmpq, error: arb) -> float | None:
    """The slope of log error over log h from a row to the next; None without a row or an error."""
    if before is None or error.contains(0):
        return None
    rise = (before.error / error).log()
    return float((rise / (arb(before.h) / arb(h)).log()).mid())


def stiff_order(rows: Sequence[Row]) -> float | None:
    """The order that slopes of a stiff problem show: extrapolated as well, but never far beyond the
    last slope.

    Errors of two kinds change places there, h^p and a smaller multiple of a lower power, and
    where they do slopes fall so fast that the extrapolation goes on below both.
    """
    order, last = observed_order(rows), rows[-1].slope
    if order is None or last is None or abs(order - last) <= _CROSSING:
        return order
    return last


def observed_order(rows: Sequence[Row]) -> float | None:
    """The order p in log error = log C + p log h + a h + b h² through the last four rows.

    The slopes alone approach p as fast as h → 0; with the first two terms of the expansion of the
    error taken along they do as h³. Fewer rows have fewer terms; one row has no order.
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
