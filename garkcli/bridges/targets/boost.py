"""Boost.Odeint: a header with a function that makes the stepper, of any type of state.

With embedded weights the stepper estimates errors.
"""

from __future__ import annotations

from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import below_diagonal, error_weights, explicit_table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import cpp_values


def values(payload: Payload) -> Values:
    """The arrays with their names."""
    found = explicit_table(payload, "boost")
    error = error_weights(found)
    lower = {f"a{i}": row for i, row in enumerate(below_diagonal(found), start=2)}
    weights = {"b": found.b} if error is None else {"b": found.b, "e": error}
    arrays = {**lower, **weights, "c": found.c}
    return {"arrays": arrays.items(), "rows": list(lower), "error": error}


BRIDGES = (
    Bridge(
        name="boost",
        summary="Boost.Odeint: a header of C++, explicit methods",
        kinds=("rk",),
        suffix=".hpp",
        values=values,
        program=cpp_values,
    ),
)
