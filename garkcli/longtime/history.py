"""Results on conserved quantities over a long time, for all problems."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.display import to_ball, to_float
from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Frozen
from garkcli.longtime.trend import Shape
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem
from garkcli.problems.righthandside import RightHandSide
from garkcli.stepping.linear import whole_steps
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import GarkMethod


Fate: TypeAlias = Literal["elliptic", "unstable", "contractive", "marginal"]
"""Orbits stay on ellipses; are unbounded; go to zero; stay bounded otherwise."""


class StepMapStability(Frozen):
    """The long-time behaviour of the step map R of a linear problem, for almost all orbits."""

    determinant: Number
    trace: Number
    fate: Fate

    @property
    def is_symplectic(self) -> bool:
        return self.determinant == ONE


def stability(R: Matrix) -> StepMapStability:
    """Decides the fate of the orbits of ``R``, shape (2, 2)."""
    (a, b), (c, d) = R
    determinant, trace = a * d - b * c, a + d
    return StepMapStability(determinant, trace, _fate(R, determinant, trace))


def _fate(R: Matrix, determinant: Number, trace: Number) -> Fate:
    if determinant == ONE:
        room = _sign(4 - trace * trace)
        (_, b), (c, _) = R
        # of trace ±2 a diagonal R is the identity, or its negative
        is_identity = room == 0 and not (b or c)
        return "elliptic" if room > 0 or is_identity else "unstable"
    area = _sign(1 - determinant * determinant)
    most = 1 + determinant
    room = _sign(most * most - trace * trace)
    if area > 0 and room > 0:
        return "contractive"
    if area < 0 or room < 0:
        return "unstable"
    return "marginal"


def _sign(x: Number) -> int:
    """The sign, exact because a nonzero ball has one."""
    if not x:
        return 0
    return 1 if to_ball(x) > 0 else -1


MAX_STEPS = 10_000_000
SERIES = 2000
"""Most points of a series kept for plots."""
BLOW_UP = 1e30
"""A run ends as unstable when the energy error is so many times the energy."""

Verdict: TypeAlias = Literal["exact", "round-off", "bounded", "drifts", "unstable", "undecided"]
WORDS: dict[str, tuple[str, str]] = {
    "exact": ("good", "conserved"),
    "round-off": ("good", "no error above round-off"),
    "bounded": ("good", "bounded"),
    "unstable": ("bad", "UNSTABLE"),
    "undecided": ("note", "undecided"),
    "drifts": ("bad", "DRIFTS"),
}
"""The severity of a verdict, and its word."""
Doubt: TypeAlias = Literal[
    "steps", "turns", "rest", "value", "round-off", "modulation", "level", "symplectic", "rounding"
]
"""Why a verdict is undecided: too few steps; coordinates hardly turn back; nothing moves; the
quantity has no value at some step; rounding may be as large as the quantity; a slow modulation may
be the slope; a single move to another level; a rise or fall throughout, for symplectic methods
usually a slow oscillation; a drift that the rounding of the coefficients may cause.
"""
State: TypeAlias = tuple[fmpq, tuple[Any, ...]]
"""A time, and (q, p) at it, shape (2d,)."""


class InvariantHistory(Frozen):
    """A conserved quantity I over a long time.

    Attributes:
        name: "energy", or the problem's name of the invariant.
        initial: I(0).
        max_error: max |I(t_n) − I(0)|, over all steps.
        drift: the slope of I(t) − I(0), per unit of time; None after a blow-up or with too few
            steps.
        uncertainty: of ``drift``, or None.
        amplitude: half the range of I(t) − I(0) − drift·t.
        round_off: the uncertainty of the errors at the end of the run, a power of ten.
        coefficients: the error that rounding of the coefficients can cause; 0 without a tolerance.
        verdict: on I.
        shape: of the trend.
        errors: I(t) − I(0) at the times of the run.
        longer: a time that would decide; None if decided, or none is within ``MAX_STEPS``.
        doubt: why it is undecided, or None.
        no_value_at: the first time without a value of I, or one beyond 1e150; errors are nan from
            there on.
    """

    name: str
    initial: float
    max_error: float
    drift: float | None
    uncertainty: float | None
    amplitude: float
    round_off: float
    coefficients: float
    verdict: Verdict
    shape: Shape
    errors: tuple[float, ...]
    longer: fmpq | None = None
    doubt: Doubt | None = None
    no_value_at: fmpq | None = None

    def __repr__(self) -> str:
        return f"<InvariantHistory {self.name}: {self.verdict}>"


class LongRun(Shown, Frozen):
    """A problem stepped over a long time.

    Attributes:
        problem: the problem and its split.
        step: h.
        t_end: the requested time.
        steps: the number of steps; fewer than t_end/h only after a blow-up.
        digits: the digits of the steps; None if they are exact.
        invariants: the energy, if there is one, then the other invariants; at least one.
        times: the times of the kept errors, ascending: extremes of equal spans.
        states: at the start and after each quarter of the run; empty for the oscillator.
        turns: of the coordinate that oscillates fastest; 0 for the oscillator.
        escaped: when the orbit leaves for ever, with a large error of the energy; or None.
        stability: of the step map of the oscillator, or None.
        method: the method, if more than its tableau is known.

    >>> from garkcli import hamiltonian, long_run
    >>> run = long_run("rk4", hamiltonian("pendulum"), t_end=200, step="1/2")
    >>> run.steps, run.energy.verdict
    (400, 'drifts')
    """

    problem: Oscillator | Problem
    step: fmpq
    t_end: fmpq
    steps: int
    digits: int | None
    invariants: tuple[InvariantHistory, ...]
    times: tuple[float, ...]
    states: tuple[State, ...] = ()
    turns: int = 0
    escaped: fmpq | None = None
    stability: StepMapStability | None = None
    method: GarkMethod | None = None

    @property
    def energy(self) -> InvariantHistory | None:
        """The history of the energy; None if the problem has no energy."""
        if isinstance(self.problem, RightHandSide):
            return None
        return self.invariants[0]

    @property
    def end(self) -> float:
        return to_float(self.steps * self.step)

    @property
    def is_unstable(self) -> bool:
        """Whether the run has blown up, or its orbit has escaped."""
        return self.invariants[0].verdict == "unstable"

    @property
    def drifts(self) -> bool:
        return any(x.verdict in ("drifts", "unstable") for x in self.invariants)

    def __repr__(self) -> str:
        name = getattr(self.problem, "name", "oscillator")
        found = [f"{x.name} {x.verdict}" for x in self.invariants]
        words = ", ".join([f"{self.steps} steps of {self.step}", *found])
        return f"<LongRun {name}: {words}>"


def count_steps(t_end: fmpq, step: fmpq) -> int:
    """Raises UsageProblem if the step does not divide the time, or beyond ``MAX_STEPS``."""
    count = whole_steps(t_end, step)
    if count > MAX_STEPS:
        message = f"{count} steps (limit {MAX_STEPS})"
        raise UsageProblem(message, "choose a shorter time or a larger step", code="too-many")
    return count


def whole_run(
    step: fmpq | None, t_end: fmpq | None, usual_step: fmpq, usual_end: fmpq
) -> tuple[fmpq, fmpq]:
    """A step size, and a time that is a multiple of it; missing ones are close to the usual.

    >>> whole_run(fmpq(3, 10), None, fmpq(1, 2), fmpq(100))
    (3/10, 999/10)
    """
    if t_end is None:
        step = usual_step if step is None else step
        count = max(int((usual_end / step).floor()), 1)
        return step, step * count
    if step is None:
        count = max(int((t_end / usual_step).ceil()), 1)
        step = t_end / count
    return step, t_end
