"""MFEM: a header with a function that makes an ``ExplicitRKSolver``.

The solver keeps pointers to the numbers, which are static.
"""

from __future__ import annotations

from itertools import chain

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import vanishes
from garkcli.bridges.tables import below_diagonal, explicit_table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import cpp_values


def values(payload: Payload) -> Values:
    """The entries below the diagonal, one row after the other."""
    found = explicit_table(payload, "mfem")
    if not vanishes(found.c[0]):
        message = f"the first node of mfem's methods is 0; that of {payload.name} is not"
        raise CannotExport(message, "boost, json and numpy have such methods")
    return {"lower": tuple(chain.from_iterable(below_diagonal(found)))}


BRIDGES = (
    Bridge(
        name="mfem",
        summary="MFEM: a header of C++, explicit methods",
        kinds=("rk",),
        suffix=".hpp",
        values=values,
        program=cpp_values,
    ),
)
