"""Dedalus 3: a class of implicit-explicit methods.

The last rows of its matrices are the weights, so both methods have to end with a stage at the new
value, and its first stage is explicit: a missing one is put in, with the weight 0. H is the
implicit method, A the explicit one.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import DENSE, EMBEDDED, Bridge
from garkcli.bridges.structure import Table, vanishes, with_first_stage, with_last_stage
from garkcli.bridges.texts import Values
from garkcli.exact.field import ONE


def values(_: Payload, tables: Sequence[Table]) -> Values:
    """The tables with the stages that they need."""
    if not all(vanishes(x) for found in tables for x in found.A[0]):
        tables = [*map(with_first_stage, tables)]
    # a single stage is the first too
    ends = all(x.stages > 1 and x.A[-1] == x.b and x.c[-1] == ONE for x in tables)
    return {"tables": tables if ends else [*map(with_last_stage, tables)], "is_put_in": not ends}


BRIDGES = (
    Bridge(
        name="dedalus",
        summary="Dedalus 3: a class, IMEX methods",
        kinds=("ark", "prk", "gark"),
        suffix=".py",
        style=PYTHON,
        stages="lower",
        several="pair",
        lacks=(EMBEDDED, DENSE),
        values=values,
    ),
)
