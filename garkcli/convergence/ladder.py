"""The step sizes of a convergence test: halvings between ends that the errors determine.

It begins where the error is a small part of the solution and slopes approach their limit, and ends
when slopes and extrapolated orders have settled. Both are read from the errors, never from the
predicted order: a ladder that stops at the expected result would prove nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING, TypeAlias

from flint import arb, fmpq

from garkcli.convergence.result import CLOSE, StepSizeRow, observed_order
from garkcli.convergence.solver import ROWS, NoUniqueStep
from garkcli.frozen import replace
from garkcli.stepping.integrator import StepFailed
from garkcli.stepping.linear import whole_steps

if TYPE_CHECKING:
    from garkcli.convergence.linear_solver import LinearSolver
    from garkcli.convergence.stepped_solver import SteppedSolver

Solver: TypeAlias = "LinearSolver | SteppedSolver"
"""A method on a problem, by exact powers of its step map, or step by step. Both have

- ``visible``: what the problem can see of the method;
- ``unit`` and ``longest``: a natural unit of time, the longest step of a ladder;
- ``most_steps`` of a row, ``decades``: parts 10^−k of the usual time, short times that are tried;
- ``size``, the sum of numbers at the start and end, and ``rests`` if these are equal in floats;
- ``rounding``: about the error that the rounding of coefficients makes; 0 for exact ones;
- ``resolution``: h ‖∂f/∂y‖ of a right-hand side; 0 for other problems;
- ``is_too_short``: whether a stiff problem would no longer look so at a step size.
"""
MAX_ROWS = 10
MAX_COARSE = 20_000
"""Most steps with which the default ladder refuses a large error."""
LARGEST = 1 / 32
"""Largest error of the default ladder, as a part of the solution."""
STIFF = 30
"""Steps with a larger h ‖∂f/∂y‖ do not resolve a problem."""
# how far, in parts of the order, the first slope of a ladder may be off
_NEAR = 0.125
# changes between two slopes, and between two extrapolated orders, at which they have settled
_STEADY, _EXTRAPOLATED = 0.02, 0.06
# change between two extrapolated orders that is enough, wherever the slopes are
_SURE = 0.005
# how far a slope on the plateau is below the order
_FLAT = 0.25
# how many times the error of the plateau an error has to be to count
_ABOVE = 300


def default_rows(solver: Solver, is_timed: bool) -> tuple[list[StepSizeRow], int]:
    """Returns the rows of the default ladder, and how many at the end show rounded coefficients.
    Steps too large for Newton's method, and poles of a step map, are left out; without an error
    there is a single row. With ``is_timed`` coarse steps stay, as costs are compared for large
    errors too. Raises StepFailed if Newton's method fails for steps that are not coarse.
    """
    rows: list[StepSizeRow] = []
    is_small: list[bool] = []
    flat = 0
    for h in halvings(solver.t_end, solver.unit, solver.longest):
        is_coarse = h * MAX_COARSE > solver.t_end
        is_long = solver.t_end / h > solver.most_steps
        is_shown = bool(is_small) and is_small[-1] and solver.is_too_short(h)
        if rows and (is_long or is_shown):
            break
        try:
            row = solver.row(h, rows[-1] if rows else None)
        except NoUniqueStep:
            continue
        except StepFailed:
            if any(is_small) or not is_coarse:
                raise
            rows, is_small = [], []
            continue
        if row.error.is_zero():
            return [row], 0
        rows.append(row)
        is_small.append(not is_coarse or is_part(row, solver.size()))
        flat = plateau(rows, unspoilt_order(solver, h), solver.rounding())
        if flat > 1 or is_complete(rows, is_small):
            break
    return trimmed(rows, is_small, flat, may_be_off=is_timed), flat


def is_part(row: StepSizeRow, size: arb) -> bool:
    """Whether the error is a small part of the solution; ``size`` includes its start and end."""
    return bool(row.error < size * LARGEST / 2)


def halvings(t_end: fmpq, unit: fmpq, longest: fmpq) -> Iterator[fmpq]:
    """t_end/n with n doubled without end. The first step is at most ``longest``, and at most a unit
    of time if that is shorter and cannot be doubled. Raises UsageProblem unless the time is
    positive.

    >>> from itertools import islice
    >>> [str(h) for h in islice(halvings(fmpq(12), fmpq(1), fmpq(8)), 4)]
    ['4', '2', '1', '1/2']
    """
    whole_steps(t_end, t_end)
    n = int((t_end / min(unit, longest)).ceil())
    while n % 2 == 0 and t_end / (n // 2) <= longest:
        n //= 2
    for k in count():
        yield t_end / (n * 2**k)


def is_complete(rows: Sequence[StepSizeRow], is_small: Sequence[bool]) -> bool:
    """Returns whether the ladder may end; errors that are small are within ``LARGEST``."""
    if len(rows) - _first_small(is_small) >= MAX_ROWS:
        return True
    return len(rows) - _start(rows, is_small) >= ROWS and has_settled(rows)


def _first_small(is_small: Sequence[bool]) -> int:
    start = len(is_small)
    while start > 0 and is_small[start - 1]:
        start -= 1
    return start


def _start(rows: Sequence[StepSizeRow], is_small: Sequence[bool]) -> int:
    """The first row from which on errors are small and slopes near the last extrapolated order."""
    observed = observed_order(rows)
    start = _first_small(is_small)
    if observed is None:
        return start
    allowed = max(_NEAR * observed, _FLAT)
    for i, row in enumerate(rows):
        if row.slope is not None and abs(row.slope - observed) > allowed:
            start = max(start, i)
    return start


def has_settled(rows: Sequence[StepSizeRow]) -> bool:
    """Whether slope and extrapolated order agree and one of them is steady, or the latter is very
    steady. The order of a method is an integer, so otherwise something has not settled yet.
    """
    before, last = rows[-2].slope, rows[-1].slope
    estimated = observed_order(rows[:-1])
    observed = observed_order(rows)
    if before is None or last is None:
        return False
    if estimated is None or observed is None:
        return False
    if abs(observed - round(observed)) > CLOSE / 2:
        return False
    change = abs(observed - estimated)
    if change < _SURE:
        return True
    is_steady = abs(last - before) < _STEADY or change < _EXTRAPOLATED
    return is_steady and abs(last - observed) < CLOSE


def trimmed(
    rows: Sequence[StepSizeRow],
    is_small: Sequence[bool],
    plateau: int = 0,
    may_be_off: bool = False,
) -> list[StepSizeRow]:
    """The rows without the first ones that are too coarse; at least ``ROWS`` stay, and the last
    ``plateau``, which are ignored. With ``may_be_off`` small errors stay, whatever their slopes.
    """
    end = len(rows) - plateau
    start = _first_small(is_small[:end]) if may_be_off else _start(rows[:end], is_small[:end])
    kept = list(rows[min(start, max(0, len(rows) - ROWS)) :])
    if kept:
        kept[0] = replace(kept[0], slope=None)
    return kept


def unspoilt_order(solver: Solver, h: fmpq) -> int:
    """The order below which slopes are ascribed to rounding; at most 1 for a stiff problem."""
    order = solver.visible.order
    return min(order, 1) if solver.resolution(h) >= STIFF else order


def plateau(rows: Sequence[StepSizeRow], order: int, rounding: arb) -> int:
    """Returns the number of last rows that show rounding, from a flat one within it on."""
    limit = rounding * _ABOVE
    flat = 0  # the first flat row
    while flat < len(rows):
        row = rows[flat]
        is_flat = row.slope is not None and row.slope < order - _FLAT
        if is_flat and row.error < limit:
            break
        flat += 1
    if flat == len(rows):
        return 0
    least = min((row.error for row in rows[flat:]), key=float)
    level = least * _ABOVE
    spoilt = 0
    while spoilt < flat and not rows[spoilt].error < level:
        spoilt += 1
    return len(rows) - spoilt
