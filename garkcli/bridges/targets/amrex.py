"""AMReX: the lines of an inputs file, read at run time; it reads no fractions."""

from __future__ import annotations

from garkcli.bridges.numbers import DECIMALS
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import explicit_table
from garkcli.bridges.texts import Values


def values(payload: Payload) -> Values:
    """The rows of the lower triangle, with their diagonal."""
    found = explicit_table(payload, "amrex")
    return {"rows": [payload.numbers(row[: i + 1], DECIMALS) for i, row in enumerate(found.A)]}


BRIDGES = (
    Bridge(
        name="amrex",
        summary="AMReX: lines of an inputs file, explicit methods",
        kinds=("rk",),
        suffix=".inputs",
        values=values,
    ),
)
