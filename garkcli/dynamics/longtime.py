"""Conserved quantities of a nonlinear problem over a long time: how far they go, and whether they drift.

A nonlinear problem is stepped and measured after each step, in memory that does not grow with their number. How
good the errors are is measured too, on the first steps, against the same steps with more digits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from math import ceil
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.dynamics.courses import Course, LongRun, Verdict
from garkcli.dynamics.energy import BLOW_UP, MAX_STEPS, SERIES, extremes
from garkcli.dynamics.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.dynamics.linear import whole_steps
from garkcli.dynamics.measure import Measure
from garkcli.dynamics.scheme import scheme
from garkcli.dynamics.step import StepFailed, trajectory
from garkcli.dynamics.trend import LEAST, Shape, Trends
from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

Watch: TypeAlias = Callable[[Iterator[Any], int], Iterator[Any]]
"""Passes on a number of things, one a step, and may count them."""
_USUAL = {
    "split-oscillator": (fmpq(1, 10), fmpq(1000)),
    "pendulum": (fmpq(1, 10), fmpq(1000)),
    "kepler": (fmpq(1, 50), fmpq(1000)),
    "henon-heiles": (fmpq(1, 10), fmpq(1000)),
    "fput": (fmpq(1, 10), fmpq(1000)),
    "generic": (fmpq(1, 100), fmpq(1)),  # its solutions need not exist for long
}
_CHUNK = 8192  # steps measured at a time
_COMPARED = 128  # steps that are done with more digits too
_SPARE = 15  # how many more
_PARTS = 4  # equal parts of a run at whose ends the state is kept


def usual(problem: Hamiltonian) -> tuple[fmpq, fmpq]:
    """A step size and a time that show the long run of ``problem``; 10 000 steps where nothing more is known."""
    return _USUAL.get(problem.name, (problem.t_end / 40, 250 * problem.t_end))


def follow(
    tableau: Tableau,
    problem: Hamiltonian,
    t_end: fmpq,
    step: fmpq,
    digits: int = FLOAT_DIGITS,
    points: int = SERIES,
    tolerance: fmpq | None = None,
    watch: Watch = lambda path, _: path,
) -> LongRun:
    """Follow the energy and the other invariants of ``problem`` under ``tableau`` to the time ``t_end``.

    Args:
        tableau: any tableau whose structure the problem is of, made for it by ``fitted``.
        problem: split into as many terms as the tableau has.
        t_end: a whole number of steps.
        step: h.
        digits: of the steps; floats up to ``FLOAT_DIGITS``.
        points: about how many times are kept.
        tolerance: of rounded coefficients; what they can add in each step counts as round-off.
        watch: is given the states and their number.

    Raises:
        UsageProblem: the problem is not of the form of the structure, the step does not divide the time, or there
            are more than ``MAX_STEPS`` of them.
        StepFailed: the stage equations of a step were not solved, and the energy had not blown up before.
    """
    count = whole_steps(t_end, step)
    if count > MAX_STEPS:
        raise UsageProblem(f"{count} steps (limit {MAX_STEPS})", "choose a shorter time or a larger step")
    method = scheme(tableau, problem, digits)
    record = _Record(Measure(problem, method.digits), count, points)
    record.take(watch(trajectory(method, step, count), count + 1))
    noise = _noise(record, tableau, problem, step, method.digits)
    if tolerance is not None:
        noise += to_float(tolerance) * record.done * record.measure.scale
    times = (record.kept_numbers * to_float(step)).tolist()
    courses = (_course(record, k, to_float(step), float(noise[k])) for k in range(len(noise)))
    states = ((number * step, y) for number, y in sorted(record.states.items()))
    return LongRun(problem, step, t_end, record.done, method.digits, tuple(courses), tuple(times), tuple(states))


class _Record:
    """What is kept of a trajectory while it goes by: of all errors their extremes and sums, of a few themselves."""

    def __init__(self, measure: Measure, count: int, points: int) -> None:
        import numpy as np

        signals = len(measure.names)
        self.measure, self.count = measure, count
        self.trends = Trends(count, signals)
        self.span = 1 if count < points else ceil((count + 1) / max((points - 2) // (2 * signals), 1))
        self.largest: Floats = np.zeros(signals)
        self.states: dict[int, tuple[Any, ...]] = {}
        self.wanted = {count * part // _PARTS for part in range(_PARTS + 1)}
        self.done = -1
        self.blew_up = False
        self._numbers: list[int] = []
        self._errors: list[Floats] = []
        self.first: Floats = np.zeros((0, signals))

    @property
    def kept_numbers(self) -> NDArray[np.int64]:
        """The steps whose errors are kept."""
        import numpy as np

        return np.array(self._numbers)

    @property
    def kept_errors(self) -> Floats:
        """Their errors, shape (steps, signals)."""
        import numpy as np

        return np.concatenate(self._errors)

    def take(self, path: Iterator[list[Any]]) -> None:
        """Measure all states, or those before the blow-up; raises ``StepFailed`` where there is none."""
        chunk = self.span * max(1, _CHUNK // self.span)
        while self.done < self.count and not self.blew_up:
            states: list[list[Any]] = []
            failure: StepFailed | None = None
            try:
                for y in islice(path, chunk):
                    states.append(y)  # noqa: PERF402 -- what comes before a failure is wanted
            except StepFailed as error:
                failure = error
            if states:
                self._add(states)
            if failure is not None and not self.blew_up:
                self.blew_up = bool(self.largest[0] > self.measure.scale)
                if not self.blew_up:
                    raise failure

    def _add(self, states: Sequence[list[Any]]) -> None:
        import numpy as np

        errors, start = self.measure.errors(states), self.done + 1
        outside = np.flatnonzero(~(np.abs(errors) <= BLOW_UP * self.measure.scale).all(axis=1))
        if outside.size:
            self.blew_up = True
            errors = errors[: outside[0]]
        if not len(errors):
            return
        if start == 0:
            self.first = errors[: _COMPARED + 1].copy()
        self.trends.add(start, errors)
        np.maximum(self.largest, np.abs(errors).max(axis=0), out=self.largest)
        self.done += len(errors)
        chosen = self._chosen(errors, start)
        self._numbers += [start + i for i in chosen]
        self._errors.append(errors[chosen])
        for number in self.wanted:
            if start <= number <= self.done:
                self.states[number] = tuple(states[number - start])

    def _chosen(self, errors: Floats, start: int) -> list[int]:
        """Where an error is extreme in its span, and both ends of the run."""
        ends = {number - start for number in (0, self.count) if start <= number <= self.done}
        if self.span == 1:
            return list(range(len(errors)))
        spans = -(-len(errors) // self.span)
        found = (extremes(errors[:, k], 2 * spans).tolist() for k in range(errors.shape[1]))
        return sorted(ends.union(*found))


def _noise(record: _Record, tableau: Tableau, problem: Hamiltonian, step: fmpq, digits: int) -> Floats:
    """What the errors are good to at the end: what is found on the first steps, taken to grow with their number."""
    import numpy as np

    if record.blew_up:
        return np.zeros(len(record.largest))
    compared = len(record.first) - 1
    method = scheme(tableau, problem, digits + _SPARE)
    exact = Measure(problem, method.digits).errors(trajectory(method, step, compared))
    found = np.abs(record.first - exact).max(axis=0)
    least = 10.0**-digits * np.abs(record.measure.initial)
    noise: Floats = np.maximum(found, least) * (1 + record.done / max(compared, 1))
    return noise


def _course(record: _Record, k: int, h: float, noise: float) -> Course:
    errors = record.kept_errors[:, k]
    drift: float | None = None
    uncertainty: float | None = None
    shape: Shape = "none"
    verdict: Verdict = "unstable" if record.blew_up else "short"
    if not record.blew_up and record.count >= LEAST:
        trend = record.trends.of(k, noise)
        drift, uncertainty, shape = trend.slope / h, trend.uncertainty / h, trend.shape
        verdict = "bounded" if shape == "none" else "drifts"
    if not record.blew_up and record.largest[k] <= noise:
        verdict, shape = "round-off", "none"
    left = errors - (drift or 0.0) * h * record.kept_numbers
    return Course(
        record.measure.names[k],
        record.measure.initial[k],
        float(record.largest[k]),
        drift,
        uncertainty,
        float(left.max() - left.min()) / 2,
        noise,
        verdict,
        shape,
        tuple(errors.tolist()),
    )
