"""Tempus of Trilinos: a parameter list in XML, of an explicit, diagonally implicit or IMEX method.

Tempus reads numbers by the stream operator of C++, for which ``1/3`` is 1: all are decimals.
"""

from __future__ import annotations

from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import imex_tables, lower_table
from garkcli.bridges.texts import Values


def values(payload: Payload) -> Values:
    """The table, or the two."""
    if payload.kind == "rk":
        return {"table": lower_table(payload, "tempus")}
    explicit, implicit = imex_tables(payload, "tempus")
    return {"explicit": explicit, "implicit": implicit}


BRIDGES = (
    Bridge(
        name="tempus",
        summary="Tempus of Trilinos: XML, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark"),
        suffix=".xml",
        values=values,
    ),
)
