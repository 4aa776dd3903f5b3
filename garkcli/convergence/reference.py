"""Reference solutions: known ones, or by Gauss and Radau IIA methods with many digits."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import ceil, inf, log10
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.exact.display import BITS_OF_A_DIGIT, to_float
from garkcli.frozen import Frozen, Mutable, replace
from garkcli.problems import righthandside
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.mass import enclosed
from garkcli.problems.problem import Problem, unknowns
from garkcli.stepping.integrator import Integrator, StepFailed, Stepper, bind

MAX_TRIED = 10_000
"""Most steps that are tried: with more a failed step is the fault of the problem."""
MAX_STEPS = 1_000_000
_PIECES = 200  # of a run, after each of which it is said how far it is
_STAGES = 60  # beyond, a step costs more than fewer of them save
_SPARE = 10  # digits that round-off may grow by
_CREDIT = 1e-6  # part of a change that its later run is wrong by at least
_FAR = 0.01  # part of the solution by which runs differ that have found none
# of the number of steps, from one run to the next
_LEAST_FACTOR, _LARGEST_FACTOR = 1.3, 8
_REFINED = 64  # times the first number of steps with which they should have
_APART = 8  # times as many steps, between which it is seen how fast the error falls


def run(made: Integrator, h: fmpq, count: int, what: str) -> Stepper:
    """The state after ``count`` steps, or StepFailed; ``what`` names the work."""
    state = Stepper(made, h)
    each = max(1, count // _PIECES)
    with doing(what, count) as work:
        while state.done < count:
            state.advance(min(each, count - state.done))
            work.reach(state.done)
    return state


class ReferenceSolution(Mutable):
    """The solution ``y`` at ``t_end``, shape (2d,), with the most digits requested so far: the
    error is below 10^(−``digits``) times its ``magnitude``, 0 digits at first.
    """

    problem: Problem
    t_end: fmpq
    digits: int = 0
    y: tuple[arb, ...] = ()
    steps: int = 0

    def to(self, digits: int) -> tuple[arb, ...]:
        """Raises UsageProblem without a solution, near a singularity, or in round-off."""
        if digits > self.digits and self._is_known(digits):
            self.y = _exact(self.problem, self.t_end, digits)
            self.digits = digits
        if digits > self.digits:
            # more digits have more stages: about as many steps are enough again
            first = 2 * self.steps // 3
            if not first:
                first = ceil(4 * to_float(self.t_end))
            self.y, self.steps = _solved(self.problem, self.t_end, digits, max(4, first))
            self.digits = digits
        return self.y

    def _is_known(self, digits: int) -> bool:
        """Whether the exact solution is known and starts at the problem's start."""
        if isinstance(self.problem, Hamiltonian) or self.problem.exact is None:
            return False
        return digits <= righthandside.EXACT_DIGITS or righthandside.starts_exactly(self.problem)


def _exact(problem: Problem, t_end: fmpq, digits: int) -> tuple[arb, ...]:
    assert isinstance(problem, righthandside.RightHandSide)
    with ctx.workprec(ceil((digits + _SPARE) * BITS_OF_A_DIGIT) + 64):
        return tuple(x.mid() for x in righthandside.solution(problem, arb(t_end)))


def reference(problem: Problem, t_end: fmpq) -> ReferenceSolution:
    """The solution of ``problem`` at ``t_end``, shared by all its splits."""
    return _kept(replace(problem.unsplit(), name="", invariants=()), t_end)


@cache
def _kept(problem: Problem, t_end: fmpq) -> ReferenceSolution:
    return ReferenceSolution(problem, t_end)


def _solved(problem: Problem, t_end: fmpq, digits: int, steps: int) -> tuple[tuple[arb, ...], int]:
    """The solution by more steps until the last change is small enough, and their number."""
    runs = _Runs(problem, t_end, digits)
    fewer, before = 0, None
    changes: list[tuple[int, _Change]] = []
    enough = max(MAX_TRIED // 2, _REFINED * steps)
    while True:
        y = runs.end(steps)
        if y is None:
            steps, before = 4 * steps, None
            continue
        if before is None:
            before, fewer, steps = y, steps, ceil(1.5 * steps)
            continue
        change = runs.change(before, fewer, y, steps)
        if change.is_small:
            return tuple(y), steps
        if fewer > enough and change.is_far:
            raise UsageProblem(
                f"no solution is found at t = {t_end}: "
                f"{fewer} and {steps} steps end far from each other",
                "choose an earlier final time: it comes near a singularity, "
                "or depends on its start too much",
                code="step-fails",
            )
        changes.append((fewer, change))
        if fewer > enough and _needed(changes) > log10(MAX_STEPS):
            raise UsageProblem(
                f"the solution at t = {t_end} is not found to {digits} digits: "
                "shorter steps hardly reduce its error",
                "the problem is not smooth on the way, as sqrt(t) is not at t = 0: "
                "start or end elsewhere",
                code="step-fails",
            )
        before, fewer = y, steps
        steps = ceil(steps * change.factor)


class _Change(Frozen):
    """The change by more steps, ``is_far`` if the runs are unrelated. ``factor`` of steps is likely
    to suffice; ``decades`` are the powers of ten by which the change exceeds the allowed error.
    """

    is_small: bool
    is_far: bool
    factor: float
    decades: float = 0.0


def _needed(changes: Sequence[tuple[int, _Change]]) -> float:
    """The decades of steps needed if the error goes on falling; 0 if unknown. Changes ascend."""
    steps, last = changes[-1]
    earlier = [x for x in changes if _APART * x[0] <= steps and not x[1].is_far]
    if not earlier:
        return 0.0
    fewer, first = earlier[-1]
    rate = (first.decades - last.decades) / log10(steps / fewer)
    return log10(steps) + last.decades / rate if rate > 0 else inf


class _Runs:
    """Runs by Gauss methods, or by Radau IIA methods if not Hamiltonian, as these may be stiff."""

    def __init__(self, problem: Problem, t_end: fmpq, digits: int) -> None:
        from garkcli.families.collocation import gauss, radau_iia
        from garkcli.tableau.forms import gark

        self.problem = problem
        self.t_end = t_end
        self.digits = digits
        self.stages = min(_STAGES, max(6, 2 * digits // 5))
        spare = _SPARE
        family = gauss
        if isinstance(problem, righthandside.RightHandSide):
            family = radau_iia
            largest = max(1.0, float(righthandside.steepness(problem) * arb(t_end)))
            # what a stiff field makes of round-off
            spare += ceil(log10(largest))
        method = gark([family(self.stages)], {})
        self.integrator = bind(method, problem).at(digits + spare)

    def end(self, steps: int) -> list[Any] | None:
        """Returns the final state, or None if a step fails and shorter ones may succeed. Raises
        UsageProblem for too many steps, or if a step fails after ``MAX_TRIED``.
        """
        if steps > MAX_STEPS:
            raise UsageProblem(
                f"the solution at t = {self.t_end} is not found to "
                f"{self.digits} digits in {MAX_STEPS} steps",
                "choose an earlier final time",
                code="step-fails",
            )
        h = self.t_end / steps
        what = f"reference solution, {self.digits} digits"
        try:
            return run(self.integrator, h, steps, what).y
        except StepFailed as failure:
            if steps > MAX_TRIED:
                raise _no_solution(self.t_end, failure) from None
            return None

    def change(self, before: Sequence[Any], fewer: int, y: Sequence[Any], steps: int) -> _Change:
        """The change from ``fewer`` steps, ending at ``before``, to ``steps``, ending at ``y``.

        From n to m > n steps an error falls by (n/m)^2s when h is small enough, and by more than
        (n/m)^s long before. The change bounds the larger of the two errors, so the smaller one is
        taken to be (n/m)^s of it, but at least ``_CREDIT``, because round-off does not fall.
        """
        s = self.stages
        with ctx.workprec(self.integrator.bits):
            size = magnitude(y, self.problem)
            change = max((abs(a - b) for a, b in zip(y, before, strict=True)), key=float)
            goal = arb(10) ** -self.digits * size
            ratio = arb(fewer) / steps
            left = change * max(ratio**s, arb(_CREDIT))
            if left <= goal:  # both are 0 where the solution rests at 0
                return _Change(True, False, 1.0)
            is_far = bool(change > _FAR * size)
            decades = float(((change / goal).log() / arb(10).log()).mid())
            excess = float((change * ratio ** (2 * s) / goal).mid())
        factor = 1.1 * excess ** (1 / s) if excess > 0 else _LEAST_FACTOR
        factor = min(max(factor, _LEAST_FACTOR), _LARGEST_FACTOR)
        return _Change(False, is_far, factor, decades)


def _no_solution(t_end: fmpq, failure: StepFailed) -> UsageProblem:
    start = to_float((failure.number - 1) * failure.h)
    end = to_float(failure.number * failure.h)
    return UsageProblem(
        f"no solution is found at t = {t_end}: steps of {failure.h} fail at t = {start:.4g}, "
        "and so do longer ones",
        f"choose a final time before {end:.4g}",
        code="step-fails",
    )


def magnitude(y: Sequence[Any], problem: Problem) -> arb:
    total = arb(0)
    for x in (*y, *problem.initial):
        total += abs(arb(x))
    return total


_PART = 64
"""The solution is computed for this part of the time of the problem."""
_DIGITS = 24
_LEAST = 1e-12
"""The smallest relative change that counts as one, not as an error of the solution."""
_BITS = 4 * _DIGITS


@doing("invariants along the solution")
def changing(problem: Problem) -> tuple[tuple[str, float, fmpq], ...]:
    """The invariants of ``problem`` that its solution does not keep: name, change, and the time
    after which it is measured. The change has to be below the errors of the solution; it is
    compared with Σ |∂I/∂y_i (y_i(t) − y_i(0))|, the change without cancellation. Empty without a
    solution or a value of I.
    """
    if not problem.invariants:
        return ()
    time = problem.t_end / _PART
    try:
        end = reference(problem, time).to(_DIGITS)
    except (StepFailed, UsageProblem):
        return ()
    names = unknowns(problem)
    found = []
    for name, made in problem.invariants:
        change = _change(made, names, problem, end)
        if change:
            found.append((name, change, time))
    return tuple(found)


def _change(made: Any, names: Sequence[Any], problem: Problem, end: Sequence[arb]) -> float:
    """The change of one invariant; 0 if it is within the errors of the solution."""
    with ctx.workprec(_BITS):
        start = [arb(x) for x in problem.initial]
        at_start = dict(zip(names, start, strict=True))
        at_end = dict(zip(names, end, strict=True))
        (before,) = enclosed([made], at_start)
        (after,) = enclosed([made], at_end)
        change = after - before
        slopes = enclosed([made.diff(x) for x in names], at_end)
        each = arb(0)
        for slope, first, last in zip(slopes, start, end, strict=True):
            each += abs(slope * (last - first))
        is_finite = change.is_finite() and each.is_finite()
        is_change = is_finite and abs(change) > _LEAST * each
    return float(change.mid()) if is_change else 0.0
