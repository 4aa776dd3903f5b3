"""The convergence test: errors over a ladder of step sizes, and the order they show.

The step map of a linear problem is known exactly and its powers are enclosed in balls with as many
bits as the error needs, so a slope is never a slope of rounding errors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count, islice
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, arb_mat, ctx, fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.matrix import Matrix
from garkcli.order.certificate import find_order
from garkcli.problems.oscillator import Oscillator
from garkcli.stepping.linear import (
    MAX_STEPS,
    LinearStep,
    conserves_energy,
    deviations,
    enclosure,
    linear_step,
    visible_order,
    whole_steps,
)
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.convergence.work import Cost

Verdict: TypeAlias = Literal["agree", "disagree", "undecided"]
"""Of observed and visible order; undecided where there is no order to be seen."""
LINEAR_ONLY = "a linear problem sees only the unbranched trees: it can show an order too high, never one too low"
"""What every report of this test has to say."""
ROWS = 8
"""Step sizes of the default ladder; more only while the slopes still move."""
MAX_ROWS = 24
"""Most step sizes of the default ladder."""
ERROR_BITS = 40
"""Correct bits of every error."""
ENERGY_BITS = 20
"""Correct bits of every energy error that is not zero."""
MAX_ORDER = 120
"""Where the certificate stops to look for a higher order."""
CLOSE = 0.05
"""How near the observed order is to the order it agrees with."""
_SETTLED = 0.01  # change between two slopes at which the ladder may end


@dataclass(frozen=True)
class Row:
    """One step size.

    Attributes:
        h: the step size.
        error: ‖(Δq, Δp/ω)‖₂ at t_end, in units of q, to ``ERROR_BITS``. Balls, because the errors
            of methods of high order lie below the range of floats; ``float(row.error)`` where they
            do not.
        slope: of log error over log h, between the row before and this one; None in the first row.
        energy_error: |H(t_end) − H(0)|. Zero only where that is proved, as for a step that
            conserves H; an upper bound, far smaller than the error, where the two energies could
            not be told apart.
        cost: of the steps; None where they were not taken one by one.
    """

    h: fmpq
    error: arb
    slope: float | None
    energy_error: arb
    cost: Cost | None = field(default=None, kw_only=True)


@dataclass(frozen=True)
class Convergence:
    """The outcome of a convergence test.

    Attributes:
        problem: the oscillator and its split.
        t_end: the time at which errors are taken; the initial values are q(0) = 1, p(0) = ω/2.
        rows: from the largest step to the smallest.
        observed_order: extrapolated from the last rows to h = 0; None for a single row.
        predicted_order: of the tableau, by the certificate.
        visible_order: the exact order on this problem, ≥ ``predicted_order``.
    """

    problem: Oscillator
    t_end: fmpq
    rows: tuple[Row, ...]
    observed_order: float | None
    predicted_order: int
    visible_order: int

    @property
    def verdict(self) -> Verdict:
        """Whether the observed order is the visible one, and that no smaller than predicted."""
        if self.observed_order is None:
            return "undecided"
        is_visible = abs(self.observed_order - self.visible_order) <= CLOSE
        return "agree" if is_visible and self.visible_order >= self.predicted_order else "disagree"

    @property
    def agrees(self) -> bool:
        """Whether the verdict is that they agree."""
        return self.verdict == "agree"


def converge(
    tableau: Tableau,
    problem: Oscillator,
    t_end: fmpq | None = None,
    steps: Sequence[fmpq] | None = None,
    predicted: int | None = None,
    tolerance: float = 0.0,
) -> Convergence:
    """Test the convergence of ``tableau`` on ``problem``.

    Args:
        tableau: any tableau whose structure fits the split.
        problem: the oscillator and its split.
        t_end: 4/ω by default.
        steps: step sizes that divide ``t_end``; by default 1/(2ω), halved until the slopes have
            settled.
        predicted: the order to compare with; by default that of the certificate.
        tolerance: of rounded coefficients, see ``visible_order``. The default ladder then ends
            before the rounding is a thousandth of the error.

    Raises:
        UsageProblem: the split does not fit the structure, a step does not divide ``t_end``, or the
            stage equations of a given step have no unique solution.
    """
    t_end = 4 / problem.omega if t_end is None else t_end
    step = linear_step(tableau, problem)
    visible = visible_order(step, tolerance)
    if steps is None:
        rows = _default_rows(step, t_end, list(islice(deviations(step), visible)))
    else:
        rows = []
        for h in sorted(set(steps), reverse=True):
            rows.append(_row(step, h, t_end, rows[-1] if rows else None))
    if predicted is None:
        predicted = find_order(tableau, MAX_ORDER).order
    return Convergence(problem, t_end, tuple(rows), observed_order(rows), predicted, visible)


def _default_rows(step: LinearStep, t_end: fmpq, rounding: Sequence[arb]) -> list[Row]:
    """The ladder; ``rounding`` are the deviations of the coefficients that only their rounding has
    caused.
    """
    rows: list[Row] = []
    turns = step.problem.omega * t_end
    for h in _halvings(step.problem.omega, t_end):
        try:
            row = _row(step, h, t_end, rows[-1] if rows else None)
        except UsageProblem:
            continue  # a pole of R at this very h; the next one is another
        x = step.problem.omega * h
        rounded = sum((deviation * x**k for k, deviation in enumerate(rounding)), arb(0)) * turns
        if len(rows) >= 2 and row.error < 1000 * rounded:
            break
        rows.append(row)
        if len(rows) == MAX_ROWS or (len(rows) >= ROWS and _has_settled(rows)):
            break
    return rows


def _halvings(omega: fmpq, t_end: fmpq) -> Iterator[fmpq]:
    """t_end/n with the smallest n for which ωh ≤ 1/2, then n doubled up to ``MAX_STEPS``."""
    whole_steps(t_end, t_end)  # refuses a time that is not positive
    n = (2 * omega * t_end).ceil()
    whole_steps(t_end, t_end / n)  # refuses too many
    for k in count():
        if n * 2**k > MAX_STEPS:
            return
        yield t_end / (n * 2**k)


def _has_settled(rows: Sequence[Row]) -> bool:
    before, last = rows[-2].slope, rows[-1].slope
    return before is not None and last is not None and abs(last - before) < _SETTLED


def _row(step: LinearStep, h: fmpq, t_end: fmpq, before: Row | None) -> Row:
    n, omega = whole_steps(t_end, h), step.problem.omega
    error, energy_error = _errors(step.at(h), n, omega, t_end)
    slope = (
        None
        if before is None
        else float((before.error / error).log() / (arb(before.h) / arb(h)).log())
    )
    return Row(h, error, slope, energy_error)


def _errors(R: Matrix, n: int, omega: fmpq, t_end: fmpq) -> tuple[arb, arb]:
    """Error and energy error of y_n = Rⁿ y₀.

    The loop ends because the error is not zero: R and y₀ are algebraic, cos ωt and sin ωt are not
    (Lindemann). The energy error can be zero by coincidence, so four times the bits have to do.
    """
    bits, enough, conserved = 128, 0, conserves_energy(R, omega)
    while True:
        with ctx.workprec(bits):
            power = enclosure(R, bits) ** n
            error, energy_error = _errors_of(power, arb(omega), arb(t_end))
        if error.rel_accuracy_bits() >= ERROR_BITS:
            enough = enough or 4 * bits
            if conserved:
                return error, arb(0)
            if energy_error.rel_accuracy_bits() >= ENERGY_BITS:
                return error, energy_error
            if bits >= enough:
                return error, energy_error.abs_upper()
        bits *= 2


def _errors_of(power: arb_mat, omega: arb, t: arb) -> tuple[arb, arb]:
    q0, p0 = arb(1), omega / 2
    q, p = (power[i, 0] * q0 + power[i, 1] * p0 for i in (0, 1))
    sine, cosine = (omega * t).sin_cos()
    dq = q - (q0 * cosine + p0 / omega * sine)
    dp = (p - (p0 * cosine - omega * q0 * sine)) / omega
    energy_error = ((p * p + omega**2 * q * q) - (p0 * p0 + omega**2 * q0 * q0)) / 2
    return (dq * dq + dp * dp).sqrt(), abs(energy_error)


def observed_order(rows: Sequence[Row]) -> float | None:
    """The order p in log error = log C + p log h + a h + b h² through the last four rows.

    The slopes alone approach p as fast as h → 0; with the first two terms of the expansion of the
    error taken along they do as h³. Fewer rows have fewer terms; one row has no order.
    """
    last = rows[-4:]
    if len(last) < 2:
        return None
    with ctx.workprec(256):
        terms = [
            [arb(1), arb(row.h).log(), arb(row.h / last[0].h), arb((row.h / last[0].h) ** 2)][
                : len(last)
            ]
            for row in last
        ]
        solution = arb_mat(terms).solve(arb_mat([[row.error.log()] for row in last]))
        return float(solution[1, 0])
