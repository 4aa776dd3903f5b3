"""SciPy: a subclass of ``RungeKutta`` for ``solve_ivp``; the program takes fixed steps."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import combined
from garkcli.bridges.structure import Table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

HERMITE = ((0, 3, -2), (1, -2, 1), (0, -1, 1))
"""The cubic that has the values and slopes of both ends: what b_i, the first and the last slope
are multiplied by, as coefficients of θ, θ² and θ³.
"""


def values(_: Payload, tables: Sequence[Table]) -> Values:
    """What the class has; without the last stage where that is f at the new value.

    The errors are the differences b̂ − b, the sign that the classes of SciPy have.
    """
    (found,) = tables
    kept = found.stages - found.is_fsal
    last = () if found.is_fsal else (ZERO,)
    return {
        "kept": kept,
        "errors": (*(combined((-1, x)) for x in found.error), *last),
        "between": _dense(found, kept),
    }


def _dense(found: Table, kept: int) -> Sequence[Row]:
    """The coefficients of θ, θ², … for the stages, and for f at the new value."""
    if found.dense is not None:
        nothing = (ZERO,) * len(found.dense[0])
        return found.dense if found.is_fsal else (*found.dense, nothing)
    of_value, of_first, of_last = HERMITE
    rows = [tuple(b * k for k in of_value) for b in found.b[:kept]]
    rows[0] = tuple(x + k for x, k in zip(rows[0], of_first, strict=True))
    last: Row = tuple(map(fmpq, of_last))
    return [*rows, last]


BRIDGES = (
    Bridge(
        name="scipy",
        summary="a method of scipy.integrate.solve_ivp, explicit",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        lacks=(),
        values=values,
        words=WORDS,
    ),
)
