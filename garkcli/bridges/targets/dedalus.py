"""Dedalus 3: a class of implicit-explicit methods.

The last rows of its matrices are the weights, so both methods have to end with a stage at the new
value, and its first stage is explicit: a missing one is put in, with the weight 0.
"""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table, vanishes
from garkcli.bridges.tables import imex_tables, with_first_stage, with_last_stage
from garkcli.bridges.texts import Values
from garkcli.exact.field import ONE


def values(payload: Payload) -> Values:
    """A scheme; H is the implicit method, A the explicit one."""
    pair = imex_tables(payload, "dedalus")
    begins = all(_begins(found) for found in pair)
    if not begins:
        pair = with_first_stage(pair[0]), with_first_stage(pair[1])
    ends = all(_ends(found) for found in pair)
    if not ends:
        pair = with_last_stage(pair[0]), with_last_stage(pair[1])
    return {"explicit": pair[0], "implicit": pair[1], "is_put_in": not ends}


def _begins(found: Table) -> bool:
    return all(map(vanishes, found.A[0]))


def _ends(found: Table) -> bool:
    """Whether the last stage is at the new value; a single one is the first too."""
    return found.stages > 1 and found.A[-1] == found.b and found.c[-1] == ONE


BRIDGES = (
    Bridge(
        name="dedalus",
        summary="Dedalus 3: a class, IMEX methods",
        kinds=("ark", "prk", "gark"),
        suffix=".py",
        style=PYTHON,
        values=values,
    ),
)
