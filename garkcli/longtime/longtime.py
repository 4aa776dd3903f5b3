"""Conserved quantities over a long time: their errors, and whether they drift. The oscillator has
an exact step. Others are measured after each step, in constant memory; the uncertainty of the
errors is bounded from the digits, and checked on the first steps against steps with more digits.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli import numpy_on_use as np
from garkcli.doing import counting, doing
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.longtime import history as histories
from garkcli.longtime.energy import oscillator_run
from garkcli.longtime.measure import Measure
from garkcli.longtime.record import RunRecord
from garkcli.longtime.rounding import energy_rate, invariant_rate, power_of_ten, unit_round_off
from garkcli.longtime.symplecticity import is_proved
from garkcli.longtime.trend import CERTAIN, LEAST, Shape, Trend
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem
from garkcli.stepping.integrator import Binding, bind, trajectory
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.arrays import Floats


_SPARE = 15  # more digits with which the first steps are done too
_TURNS = 8  # times that some coordinate has to turn back: four oscillations
_LARGE = 0.1  # part of the energy that is no oscillation however short the run
_LONGER = 4  # how many times as long a run is proposed at least where this one decides nothing
_MARGIN = 2  # and how many times as long as would just do
_LEFT_TO_TIME = ("steps", "turns", "modulation", "level", "symplectic")  # what a longer run decides


def usual(problem: Oscillator | Problem) -> tuple[fmpq, fmpq]:
    """A step size and a time that show the long run of ``problem``; 10 000 steps by default."""
    if isinstance(problem, Oscillator):
        return fmpq(1, 2) / problem.omega, fmpq(10_000) / problem.omega
    return problem.long_run or (problem.t_end / 40, 250 * problem.t_end)


def long_run(
    tableau: Tableau,
    problem: Oscillator | Problem,
    t_end: fmpq,
    step: fmpq,
    digits: int = FLOAT_DIGITS,
    points: int = histories.SERIES,
    tolerance: fmpq | None = None,
) -> histories.LongRun:
    """Steps ``problem`` to ``t_end`` and judges its energy and other invariants at about ``points``
    times.

    Up to ``FLOAT_DIGITS`` digits are floats; steps of the oscillator are exact. A drift that
    ``tolerance`` can cause is undecided. Raises UsageProblem if the problem or the step does not
    fit, or the stage equations of the oscillator are singular; StepFailed before the energy has
    blown up.

    >>> from garkcli import hamiltonian, loads, pair
    >>> midpoint = pair(loads("methods: [{family: gauss, stages: 1}]").tableau)
    >>> run = long_run(midpoint, hamiltonian("pendulum", 1), fmpq(100), fmpq(1, 10))
    >>> [(x.name, x.verdict) for x in run.invariants]
    [('energy', 'bounded')]
    """
    if isinstance(problem, Oscillator):
        return oscillator_run(tableau, problem, t_end, step, points, tolerance)
    bound = bind(tableau, problem)
    problem = bound.problem
    count = histories.count_steps(t_end, step)
    method = bound.at(digits)
    record = RunRecord(Measure(problem, method.digits), count, points)
    record.take(counting("steps", trajectory(method, step, count), count + 1))
    h = to_float(step)
    if isinstance(problem, Hamiltonian):
        rate = energy_rate(tableau, tolerance, h, record.exchange.powers(h))
    else:
        states = [(number * h, y) for number, y in record.states.items()]
        rate = invariant_rate(tableau, tolerance, problem, states)
    judge = _Judge(record, step, tableau, problem, tolerance, rate * record.done * h)
    noise = _noise(record, bound, step, method.digits)
    return histories.LongRun(
        problem,
        step,
        t_end,
        record.done,
        method.digits,
        tuple(judge.history(k, float(x)) for k, x in enumerate(noise)),
        tuple((record.kept_numbers * h).tolist()),
        tuple((number * step, y) for number, y in sorted(record.states.items())),
        record.excursions.turns,
        None if judge.escape is None else judge.escape * step,
    )


@doing("round-off")
def _noise(record: RunRecord, bound: Binding, step: fmpq, digits: int) -> Floats:
    """The uncertainty of the errors at the end, as powers of ten: each step rounds each summand of
    an invariant once, to leading order; at least that found on the first steps.
    """
    if record.blew_up or not record.has_moved:
        return np.zeros(len(record.largest))
    by_state = [record.measure.sizes(y) for y in record.states.values()]
    derived = unit_round_off(digits) * np.nanmax(by_state, axis=0) * (1 + record.done)

    compared = len(record.first) - 1
    finer = bound.at(digits + _SPARE)
    exact = Measure(bound.problem, finer.digits).errors(trajectory(finer, step, compared))
    record.lose(0, exact)
    found = np.nan_to_num(np.abs(record.first - exact)).max(axis=0)
    # rounding errors of all steps are taken to add up like those of the first
    expected = found * (1 + record.done / max(compared, 1))
    return np.array([power_of_ten(float(x)) for x in np.maximum(derived, expected)])


_Finding: TypeAlias = tuple[histories.Verdict, Shape, histories.Doubt | None]


class _Judge(Frozen):
    """Judges the invariants; rounded coefficients may cause the energy error ``excused``."""

    record: RunRecord
    step: fmpq
    tableau: Tableau
    problem: Problem
    tolerance: fmpq | None
    excused: float

    @cached_property
    def is_symplectic(self) -> bool:
        problem = self.problem
        return isinstance(problem, Hamiltonian) and is_proved(self.tableau, problem, self.tolerance)

    @property
    def escape(self) -> int | None:
        record = self.record
        if record.blew_up:
            return None
        error = float(record.kept_errors[-1, 0])
        is_wrong = abs(error) > _LARGE * record.measure.scale
        return record.excursions.escape if is_wrong else None

    def history(self, k: int, noise: float) -> histories.InvariantHistory:
        record, h = self.record, to_float(self.step)
        # the bound is one of the energy; other invariants are taken to change in proportion
        share = 1.0 if k == 0 else self._size(k) / self._size(0)
        excused = self.excused * share
        trend = None
        if not record.blew_up and record.count >= LEAST and k not in record.lost:
            trend = record.trends.of(k, noise)
        verdict, shape, doubt = self._finding(k, noise, excused, trend)
        drift, uncertainty, slope = None, None, 0.0
        if trend and verdict != "unstable":
            slope = trend.slope
            drift = slope / h
            uncertainty = trend.uncertainty / h
        errors = record.kept_errors[:, k]
        left = errors - slope * record.kept_numbers
        height = float(np.nanmax(left) - np.nanmin(left))
        lost = record.lost.get(k)
        return histories.InvariantHistory(
            name=record.measure.names[k],
            initial=record.measure.initial[k],
            max_error=float(record.largest[k]),
            drift=drift,
            uncertainty=uncertainty,
            amplitude=height / 2,
            round_off=noise,
            coefficients=excused,
            verdict=verdict,
            shape=shape,
            errors=tuple(errors.tolist()),
            longer=self._longer(trend, doubt),
            doubt=doubt,
            no_value_at=None if lost is None else lost * self.step,
        )

    def _finding(self, k: int, noise: float, excused: float, trend: Trend | None) -> _Finding:
        record = self.record
        if record.blew_up or self.escape is not None:
            return "unstable", "none", None
        if not record.has_moved:
            return _undecided("rest")
        if k in record.lost:
            return _undecided("value")
        if record.largest[k] <= noise:
            is_told = noise < _LARGE * self._size(k)
            return ("round-off", "none", None) if is_told else _undecided("round-off")
        if trend is None:
            return _undecided("steps")
        # an error of that size leaves no doubt about the shortness of the run
        error = float(record.largest[0])
        is_large = error >= _LARGE * record.measure.scale
        is_short = record.excursions.turns < _TURNS
        if is_short and not is_large:
            return _undecided("turns")
        if trend.finding == "none":
            return "bounded", "none", None
        if not self._drifts(k, trend):
            return _undecided("modulation" if trend.shape == "line" else "level", trend.shape)
        if excused and not trend.exceeds(excused, record.count):
            return _undecided("rounding", trend.shape)
        if self.is_symplectic and record.largest[k] < _LARGE * self._size(k):
            return _undecided("symplectic", trend.shape)
        return "drifts", trend.shape, None

    def _drifts(self, k: int, trend: Trend) -> bool:
        """Whether a trend is a drift: no modulation explains it, or the quantity is gone."""
        return trend.finding == "drift" or trend.move >= _LARGE * self._size(k)

    def _size(self, k: int) -> float:
        """The sum of the sizes of an invariant's summands at the start; 1 if all are zero."""
        return float(self.record.measure.sizes(self.record.states[0])[k]) or 1.0

    def _longer(self, trend: Trend | None, doubt: histories.Doubt | None) -> fmpq | None:
        """A time that would decide; None if there is none within the limit of steps."""
        if doubt not in _LEFT_TO_TIME:
            return None
        record = self.record
        turns = record.excursions.turns
        needed = _LONGER
        if trend is None:
            needed = -(-_MARGIN * LEAST // record.count)  # rounded up
        elif turns < _TURNS:
            needed = -(-_MARGIN * _TURNS // max(turns, 1))
        elif doubt == "modulation":
            # what drifts grows with time, and what modulates does not
            ratio = abs(trend.slope) / trend.uncertainty
            needed = int(_MARGIN * CERTAIN / ratio)
        count = max(_LONGER, needed) * record.count
        return count * self.step if count <= histories.MAX_STEPS else None


def _undecided(doubt: histories.Doubt, shape: Shape = "none") -> _Finding:
    return "undecided", shape, doubt
