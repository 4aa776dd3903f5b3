"""From a point on a set of solutions to one with as many short rational numbers as possible.

On a manifold of solutions of dimension d, d independent functions of the unknowns can be given
values: the nodes first, then the unknowns. Each gets the shortest rational number near its present
value from which least squares return to the manifold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import ceil, floor
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.design.search.least_squares import least_squares
from garkcli.design.search.points import Fixed, Fixings, rank
from garkcli.design.search.rational import RationalFunction, as_float
from garkcli.exact.parametric import Parameters, Parametric
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array
    from garkcli.design.search.residuals import Residuals

DENOMINATORS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 30)
REACH = 0.12
TRIALS = 10
"""Values tried first, the shortest."""
STEPS = 120
CLOSE = 1e-11
"""Residuals from which Newton's method continues."""
FINE = (10**3, 10**6, 10**9)
"""Denominators tried if no short one leads back."""
NEAR = 1e-4
"""Largest distance from a degenerate solution to the end of least squares."""
DEGENERATE = 1e-4
"""Largest size of pivots near a degenerate solution that vanish at it."""
LARGEST = 20.0


def nodes_of(tableau: Tableau, ring: Parameters) -> Iterator[RationalFunction]:
    yielded = set()
    for colour in tableau.colours:
        if isinstance(tableau.spaces[colour.space], PointSpace):
            nodes: Sequence[object] = colour.c
            for node in nodes:
                if isinstance(node, Parametric) and node not in yielded:
                    yielded.add(node)
                    yield RationalFunction(node, ring)


def unknowns_of(ring: Parameters) -> list[RationalFunction]:
    return [RationalFunction(ring.parameter(name), ring) for name in ring.names]


def snapped(
    conditions: Residuals,
    wanted: Sequence[RationalFunction],
    point: Array,
    is_allowed: Callable[[Array], bool] = lambda _: True,
) -> tuple[Fixings, Array]:
    """A system with isolated solutions, and one of them near a point. ``wanted`` functions should
    be short, in this order. The point has the shape (unknowns,), a solution that may be taken
    (``is_allowed``) the shape (unknowns, 1).
    """
    fixed: list[Fixed] = []
    x = point[:, None]
    _, jacobians = conditions.at(x)
    independent = rank(jacobians[:, :, 0])
    for function in wanted:
        if len(independent) == len(point):
            break
        if not _is_independent(conditions, fixed, function, x, len(independent)):
            continue
        for values in values_near(float_at(function, x)):
            moved = _moved(conditions, fixed, function, values, x, len(independent), is_allowed)
            if moved is not None:
                value, x = moved
                fixed.append(Fixed(function, value))
                _, jacobians = Fixings(conditions, fixed).at(x)
                independent = rank(jacobians[:, :, 0])
                break
    return Fixings(conditions, fixed), x[:, 0]


def fixed_nearby(
    conditions: Residuals, wanted: Sequence[RationalFunction], x: Array
) -> list[Fixed]:
    """Functions that are near short numbers, with these, and independent of the conditions at x.
    They are examined in order; x has the shape (unknowns, 1).
    """
    fixed: list[Fixed] = []
    _, jacobians = conditions.at(x)
    rank_before = len(rank(jacobians[:, :, 0], DEGENERATE))
    for function in wanted:
        if rank_before == len(x):
            break
        present = float_at(function, x)
        value = next(
            (
                fmpq(round(present * q), q)
                for q in DENOMINATORS
                if abs(present - round(present * q) / q) < NEAR
            ),
            None,
        )
        if value is None:
            continue
        extended = [*fixed, Fixed(function, value)]
        _, jacobians = Fixings(conditions, extended).at(x)
        if len(rank(jacobians[:, :, 0], DEGENERATE)) > rank_before:
            fixed = extended
            rank_before += 1
    return fixed


def float_at(function: RationalFunction, x: Array) -> float:
    """The value at a point, shape (unknowns, 1)."""
    import numpy as np

    return float(np.broadcast_to(function.at(x, as_float).value, 1)[0])


def _is_independent(
    conditions: Residuals, fixed: Sequence[Fixed], function: RationalFunction, x: Array, before: int
) -> bool:
    system = Fixings(conditions, fixed, function, [fmpq(0)])
    _, jacobians = system.at(x)
    return len(rank(jacobians[:, :, 0])) > before


def values_near(present: float) -> Iterator[list[fmpq]]:
    """Lists of values near the present one: short ones, then ones that hardly differ from it. Zero
    comes last among the short ones, unless it is the present value: it makes another kind of
    method, explicit instead of implicit.
    """
    short = []
    for q in DENOMINATORS:
        for p in range(ceil((present - REACH) * q), floor((present + REACH) * q) + 1):
            value = fmpq(p, q)
            if value not in short:
                short.append(value)
    short.sort(key=lambda value: int(value.q))
    zero = fmpq(0)
    if zero in short and abs(present) > CLOSE:
        short.remove(zero)
        short.append(zero)
    yield short[:TRIALS]
    yield short[TRIALS:]
    for q in FINE:
        yield [fmpq(round(present * q), q)]


def _moved(
    conditions: Residuals,
    fixed: Sequence[Fixed],
    function: RationalFunction,
    values: Sequence[fmpq],
    x: Array,
    before: int,
    is_allowed: Callable[[Array], bool],
) -> tuple[fmpq, Array] | None:
    """Returns the first value that an allowed solution attains, with that solution; or None."""
    import numpy as np

    if not values:
        return None
    system = Fixings(conditions, fixed, function, values)
    starts = np.repeat(x, len(values), axis=1)
    # points that leave the batch would have to take their values with them
    minima = least_squares(system.at, starts, STEPS, CLOSE, are_kept=True)
    for k, value in enumerate(values):
        end = np.ascontiguousarray(minima.points[:, k : k + 1])
        if not minima.succeeded[k] or np.max(np.abs(end)) > LARGEST or not is_allowed(end):
            continue
        _, jacobians = Fixings(conditions, [*fixed, Fixed(function, value)]).at(end)
        if len(rank(jacobians[:, :, 0])) > before:
            return value, end
    return None
