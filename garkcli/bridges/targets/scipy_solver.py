"""SciPy: a subclass of ``RungeKutta`` for ``solve_ivp``."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table, table, vanishes
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

HERMITE = ((0, 3, -2), (1, -2, 1), (0, -1, 1))
"""The cubic that has the values and slopes of both ends: what b_i, the first and the last slope
are multiplied by, as coefficients of θ, θ² and θ³.
"""


def values(payload: Payload) -> Values:
    """What the class has; without the last stage where that is f at the new value."""
    found = table(payload)
    _refuse(payload, found)
    kept = found.stages - 1 if found.is_fsal else found.stages
    return {"kept": kept, "errors": _errors(found, kept), "between": _dense(found, kept)}


def _refuse(payload: Payload, found: Table) -> None:
    """Whether SciPy can hold the method.

    Raises:
        CannotExport: it cannot.
    """
    if not found.is_explicit:
        message = f"scipy takes explicit methods, and {payload.name} has implicit stages"
        raise CannotExport(message, "sundials, petsc and diffrax take diagonally implicit ones")
    if not vanishes(found.c[0]):
        raise CannotExport(
            "scipy evaluates the first stage at t, and the first node is "
            f"{payload.number(found.c[0])}",
            "where f does not depend on t, set the first node to 0",
        )


def _errors(found: Table, kept: int) -> Row:
    """The differences b̂ − b of the stages, and of f at the new value: the sign that the classes of
    SciPy have.
    """
    if found.embedded is None:
        return (ZERO,) * (kept + 1)
    pairs = zip(found.b, found.embedded, strict=True)
    errors = tuple(other - b for b, other in pairs)
    return errors if kept < found.stages else (*errors, ZERO)


def _dense(found: Table, kept: int) -> Sequence[Row]:
    """The coefficients of θ, θ², … for the stages, and for f at the new value."""
    if found.dense is not None:
        nothing = (ZERO,) * len(found.dense[0])
        if kept < found.stages:
            return found.dense
        return (*found.dense, nothing)
    of_value, of_first, of_last = HERMITE
    rows = [tuple(b * k for k in of_value) for b in found.b[:kept]]
    rows[0] = tuple(x + k for x, k in zip(rows[0], of_first, strict=True))
    last: Row = tuple(map(fmpq, of_last))
    return [*rows, last]


def program(payload: Payload, _file: str) -> Values:
    """For fixed steps with ``solve_ivp``."""
    return {"sides": trial_of(payload).formulas(0, WORDS)}


BRIDGES = (
    Bridge(
        name="scipy",
        summary="a method of scipy.integrate.solve_ivp, explicit",
        kinds=("rk",),
        suffix=".py",
        style=PYTHON,
        values=values,
        program=program,
    ),
)
