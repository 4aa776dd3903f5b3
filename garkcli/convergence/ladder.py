"""Which step sizes a convergence test takes: a ladder of halvings that begins and ends where the
errors say.

It begins where the error is a small part of the solution and slopes come near to what they will be,
and ends when slopes and extrapolated orders have settled. Both are read from the errors alone,
never from the predicted order: a ladder that ends where it finds what it expects would prove
nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

from flint import arb, fmpq

from garkcli.convergence.result import CLOSE, Row, observed_order
from garkcli.convergence.solver import NoUniqueStep, Solver
from garkcli.frozen import replace
from garkcli.stepping.integrator import StepFailed
from garkcli.stepping.linear import whole_steps

ROWS = 5
"""Step sizes of the default ladder; more only while the slopes still move."""
MAX_ROWS = 10
"""Most step sizes of the default ladder."""
MAX_COARSE = 20_000
"""Steps from which on the default ladder takes a large error for what there is to see."""
LARGEST = 1 / 32
"""The part of the solution that an error of the default ladder is at most."""
STIFF = 30
"""h ‖∂f/∂y‖ from which on steps do not resolve a problem."""
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


def default_rows(solver: Solver, is_timed: bool) -> tuple[list[Row], int]:
    """The rows of the default ladder, and how many at its end show the rounding of coefficients.

    Step sizes that are too large for Newton's method, and poles of a step map, are left out. A
    single row with the error 0 is all there is where the method makes no error.

    Args:
        solver: the method on the problem.
        is_timed: whether costs are compared: then the ladder keeps its coarse steps, because large
            errors are requested as well.

    Raises:
        StepFailed: Newton's method fails where steps are not coarse.
    """
    rows: list[Row] = []
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


def is_part(row: Row, size: arb) -> bool:
    """Whether the error is a small part of the solution; ``size`` counts its start and its end."""
    return bool(row.error < size * LARGEST / 2)


def halvings(t_end: fmpq, unit: fmpq, longest: fmpq) -> Iterator[fmpq]:
    """t_end/n with n doubled without end. The first step is no longer than ``longest``, nor than a
    unit of time where that is shorter and cannot be doubled; all methods have the same.

    Raises:
        UsageProblem: the time is not positive.

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


def is_complete(rows: Sequence[Row], is_small: Sequence[bool]) -> bool:
    """Whether the ladder may end with the last of ``rows``.

    Args:
        rows: all so far, from the largest step down.
        is_small: for each whether its error is at most ``LARGEST`` of the solution.
    """
    if len(rows) - _first_small(is_small) >= MAX_ROWS:
        return True
    return len(rows) - _start(rows, is_small) >= ROWS and has_settled(rows)


def _first_small(is_small: Sequence[bool]) -> int:
    """Where the errors begin to stay small."""
    start = len(is_small)
    while start > 0 and is_small[start - 1]:
        start -= 1
    return start


def _start(rows: Sequence[Row], is_small: Sequence[bool]) -> int:
    """The first row of those with small errors and slopes near the last extrapolated order."""
    observed = observed_order(rows)
    start = _first_small(is_small)
    if observed is None:
        return start
    allowed = max(_NEAR * observed, _FLAT)
    for i, row in enumerate(rows):
        if row.slope is not None and abs(row.slope - observed) > allowed:
            start = max(start, i)
    return start


def has_settled(rows: Sequence[Row]) -> bool:
    """Whether slope and extrapolated order agree and one of them is steady, or the latter is very
    steady.

    The order of a method is a whole number, so something else has not settled yet.
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
    rows: Sequence[Row], is_small: Sequence[bool], plateau: int = 0, may_be_off: bool = False
) -> list[Row]:
    """The rows without those at the start that are too coarse to belong; ``ROWS`` of them stay at
    least.

    The last ``plateau`` rows stay, and have no say. With ``may_be_off`` rows with small errors
    belong, whatever their slopes.
    """
    end = len(rows) - plateau
    start = _first_small(is_small[:end]) if may_be_off else _start(rows[:end], is_small[:end])
    kept = list(rows[min(start, max(0, len(rows) - ROWS)) :])
    if kept:
        kept[0] = replace(kept[0], slope=None)
    return kept


def unspoilt_order(solver: Solver, h: fmpq) -> int:
    """The order below which slopes at steps of size ``h`` are taken to be those of rounding: that
    of a stiff problem is reduced as well, but seldom below 1.
    """
    order = solver.visible.order
    return min(order, 1) if solver.resolution(h) >= STIFF else order


def plateau(rows: Sequence[Row], order: int, rounding: arb) -> int:
    """How many rows at the end are no longer of ``order`` because of rounded coefficients.

    They begin with the first flat one whose error may be that of the rounding; rows before it whose
    error is not far above that of the flat ones are spoilt too.

    Args:
        rows: from the largest step down.
        order: that slopes have before.
        rounding: about the error that the rounding of the coefficients makes; 0 for exact ones.
    """
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
