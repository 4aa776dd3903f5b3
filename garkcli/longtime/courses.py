"""What becomes of conserved quantities over a long time: the results, and that of the
oscillator.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from flint import fmpq

from garkcli.exact.display import to_float
from garkcli.longtime.energy import Drift
from garkcli.longtime.stability import Stability
from garkcli.longtime.trend import Shape
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator

Verdict: TypeAlias = Literal["exact", "round-off", "bounded", "drifts", "unstable", "undecided"]
"""Conserved exactly; no error above round-off; no drift to be told; a drift; blown up; too short to
judge.
"""
State: TypeAlias = tuple[fmpq, tuple[Any, ...]]
"""A time, and (q, p) then, shape (2d,)."""


@dataclass(frozen=True)
class Course:
    """A conserved quantity I over a long time.

    Attributes:
        name: "energy", or what the problem calls the invariant.
        initial: I(0).
        max_error: max |I(t_n) − I(0)|, over all steps.
        drift: the slope of I(t) − I(0), per unit of time, see ``garkcli.longtime.trend``; None in a
            run that has blown up or has too few steps.
        uncertainty: of ``drift``; None as there.
        amplitude: half the range of I(t) − I(0) − drift·t.
        round_off: what the errors are good to, at the end of the run.
        verdict: what has become of I.
        shape: of the trend.
        errors: I(t) − I(0), with its sign, at the times of the run.
    """

    name: str
    initial: float
    max_error: float
    drift: float | None
    uncertainty: float | None
    amplitude: float
    round_off: float
    verdict: Verdict
    shape: Shape
    errors: tuple[float, ...]


@dataclass(frozen=True)
class LongRun:
    """A problem followed over a long time.

    Attributes:
        problem: the problem and its split.
        step: h.
        t_end: the time asked for.
        steps: how many steps were done; fewer than t_end/h only in a run that has blown up.
        digits: that the steps were done with; None where they are exact.
        courses: of the energy, then of the other invariants.
        times: at which the errors are kept, ascending: those where one is extreme in equal spans.
        states: at the start and after each quarter of the run; none for the oscillator.
        turns: how often the coordinate that oscillates fastest has turned back; 0 for the
            oscillator.
        stability: of the step map of the oscillator, else None.
    """

    problem: Oscillator | Hamiltonian
    step: fmpq
    t_end: fmpq
    steps: int
    digits: int | None
    courses: tuple[Course, ...]
    times: tuple[float, ...]
    states: tuple[State, ...] = ()
    turns: int = 0
    stability: Stability | None = None

    @property
    def end(self) -> float:
        """The time that was reached."""
        return to_float(self.steps * self.step)

    @property
    def blew_up(self) -> bool:
        """Whether the run has ended before its time."""
        return self.courses[0].verdict == "unstable"

    @property
    def drifts(self) -> bool:
        """Whether a quantity drifts or has blown up."""
        return any(course.verdict in ("drifts", "unstable") for course in self.courses)


def of_oscillator(result: Drift, tolerance: fmpq | None = None) -> LongRun:
    """The energy of the oscillator as a long run, judged by the step map, exactly.

    Args:
        result: the energy followed.
        tolerance: of rounded coefficients: a drift that they can cause is none of the method's.
    """
    rounding = (
        0.0 if tolerance is None else to_float(tolerance) * result.steps * result.initial_energy
    )
    is_bounded = result.stability.fate == "turns"
    if tolerance is not None:
        is_bounded |= abs(result.drift) * result.steps * to_float(result.step) <= rounding
    verdict: Verdict = "bounded" if is_bounded else "drifts"
    if result.is_exact or result.blew_up:
        verdict = "exact" if result.is_exact else "unstable"
    course = Course(
        "energy",
        result.initial_energy,
        result.max_energy_error,
        None if result.blew_up else result.drift,
        None if result.blew_up else result.uncertainty,
        result.amplitude,
        rounding,
        verdict,
        ("line" if abs(result.drift) > result.uncertainty else "curve")
        if verdict == "drifts"
        else "none",
        result.energy_errors,
    )
    return LongRun(
        result.problem,
        result.step,
        result.t_end,
        result.steps,
        None,
        (course,),
        result.times,
        stability=result.stability,
    )


def whole_run(
    step: fmpq | None, t_end: fmpq | None, usual_step: fmpq, usual_end: fmpq
) -> tuple[fmpq, fmpq]:
    """A step size, and a time that is a whole number of them; what is not given comes near the
    usual.

    >>> whole_run(None, fmpq(1), fmpq(3, 10), fmpq(100))
    (1/4, 1)
    >>> whole_run(fmpq(3, 10), None, fmpq(1, 2), fmpq(100))
    (3/10, 999/10)
    """
    if t_end is None:
        step = usual_step if step is None else step
        return step, step * max(int((usual_end / step).floor()), 1)
    if step is None:
        step = t_end / max(int((t_end / usual_step).ceil()), 1)
    return step, t_end
