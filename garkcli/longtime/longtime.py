"""Conserved quantities of a nonlinear problem over a long time: how far they go, and whether they
drift.

A nonlinear problem is stepped and measured after each step, in memory that does not grow with their
number. How good the errors are is measured too, on the first steps, against the same steps with
more digits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.display import to_float
from garkcli.longtime.courses import Course, LongRun, Verdict
from garkcli.longtime.energy import MAX_STEPS, SERIES
from garkcli.longtime.measure import Measure
from garkcli.longtime.record import Record
from garkcli.longtime.trend import LEAST, Shape
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.stepping.integrator import Binding, bind
from garkcli.stepping.linear import whole_steps
from garkcli.stepping.step import trajectory
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

Watch: TypeAlias = Callable[[Iterator[Any], int], Iterator[Any]]
"""Passes on a number of things, one a step, and may count them."""
_SPARE = 15  # more digits with which the first steps are done too
_TURNS = 8  # times that some coordinate has to turn back: four oscillations
_LARGE = 0.1  # part of the energy that is a drift however short the run


def usual(problem: Hamiltonian) -> tuple[fmpq, fmpq]:
    """A step size and a time that show the long run of ``problem``; 10 000 steps where nothing more
    is known.
    """
    return problem.long_run or (problem.t_end / 40, 250 * problem.t_end)


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
    """Follow the energy and the other invariants of ``problem`` under ``tableau`` to the time
    ``t_end``.

    Args:
        tableau: of any structure.
        problem: in as many terms as the tableau is for, or in one that has a natural split.
        t_end: a whole number of steps.
        step: h.
        digits: of the steps; floats up to ``FLOAT_DIGITS``.
        points: about how many times are kept.
        tolerance: of rounded coefficients; a drift that they can cause is none of the method's.
        watch: is given the states and their number.

    Raises:
        UsageProblem: the problem is not of the form of the structure, the step does not divide the
            time, or there are more than ``MAX_STEPS`` of them.
        StepFailed: the stage equations of a step were not solved, and the energy had not blown up
            before.

    >>> from garkcli import hamiltonian, loads, pair
    >>> midpoint = pair(loads("methods: [{family: gauss, stages: 1}]").tableau)
    >>> run = follow(midpoint, hamiltonian("pendulum", 1), fmpq(100), fmpq(1, 10))
    >>> [(course.name, course.verdict) for course in run.courses]
    [('energy', 'bounded')]
    """
    bound = bind(tableau, problem)
    problem = bound.problem
    count = whole_steps(t_end, step)
    if count > MAX_STEPS:
        raise UsageProblem(
            f"{count} steps (limit {MAX_STEPS})", "choose a shorter time or a larger step"
        )
    method = bound.at(digits)
    record = Record(Measure(problem, method.digits), count, points)
    record.take(watch(trajectory(method, step, count), count + 1))
    noise = _noise(record, bound, step, method.digits)
    rounding = (
        0.0 if tolerance is None else to_float(tolerance) * record.done * record.measure.scale
    )
    times = (record.kept_numbers * to_float(step)).tolist()
    courses = (
        _course(record, k, to_float(step), float(noise[k]), rounding) for k in range(len(noise))
    )
    states = ((number * step, y) for number, y in sorted(record.states.items()))
    return LongRun(
        problem,
        step,
        t_end,
        record.done,
        method.digits,
        tuple(courses),
        tuple(times),
        tuple(states),
        record.turns,
    )


def _noise(record: Record, bound: Binding, step: fmpq, digits: int) -> Floats:
    """What the errors are good to at the end: what is found on the first steps, taken to grow with
    their number.
    """
    import numpy as np

    if record.blew_up:
        return np.zeros(len(record.largest))
    compared = len(record.first) - 1
    method = bound.at(digits + _SPARE)
    exact = Measure(bound.problem, method.digits).errors(trajectory(method, step, compared))
    found = np.abs(record.first - exact).max(axis=0)
    least = 10.0**-digits * np.abs(record.measure.initial)
    noise: Floats = np.maximum(found, least) * (1 + record.done / max(compared, 1))
    return noise


def _course(record: Record, k: int, h: float, noise: float, rounding: float) -> Course:
    errors = record.kept_errors[:, k]
    drift: float | None = None
    uncertainty: float | None = None
    shape: Shape = "none"
    verdict: Verdict = "unstable" if record.blew_up else "undecided"
    if not record.blew_up and record.count >= LEAST:
        trend = record.trends.of(k, noise + rounding)
        drift, uncertainty, shape = trend.slope / h, trend.uncertainty / h, trend.shape
        verdict = "bounded" if shape == "none" else "drifts"
        if record.turns < _TURNS and record.largest[0] < _LARGE * record.measure.scale:
            verdict = "undecided"
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
