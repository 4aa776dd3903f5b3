"""Whether what a problem calls an invariant keeps its value along the exact solution."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.convergence.reference import reference
from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.problems.mass import enclosed
from garkcli.problems.problem import Problem, unknowns
from garkcli.stepping.step import StepFailed

_PART = 64
"""The solution is followed for this part of the time of the problem."""
_DIGITS = 24
"""Of the solution."""
_LEAST = 1e-12
"""The smallest part of a change by each coordinate alone that is a change in all, not an error of
the solution.
"""
_BITS = 4 * _DIGITS


@doing("invariants along the solution")
def changing(problem: Problem) -> tuple[tuple[str, float, fmpq], ...]:
    """The invariants of ``problem`` that its solution does not keep: name, change, and the time
    that it is over.

    The change of an invariant I has to be below the errors of the solution; it is compared with
    Σ |∂I/∂y_i (y_i(t) − y_i(0))|, what the changes of the coordinates would make of I if they did
    not cancel. Nothing is said where there is no solution, or where I has no value on it.
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
    """Of one invariant; 0 where it is no more than the errors of the solution."""
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
