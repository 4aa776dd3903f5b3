"""PETSc TS in C: RK, ARKIMEX for pairs and diagonally implicit methods, basic symplectic."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.numbers import c_style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.bridges.structure import Table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ZERO


def values(_: Payload, tables: Sequence[Table]) -> Values:
    """An implicit method is the implicit half of a pair; its explicit half is never used."""
    found = tables[0]
    if len(tables) > 1 or found.is_explicit:
        return {}
    zeros = (ZERO,) * found.stages
    nothing = Table((zeros,) * found.stages, zeros, found.c, found.embedded and zeros)
    return {"tables": [nothing, found]}


BRIDGES = (
    Bridge(
        name="petsc",
        summary="C for PETSc TS: RK, ARKIMEX, basic symplectic",
        kinds=EVERYTHING,
        suffix=".c",
        style=c_style("PetscRealConstant"),
        stages="lower",
        several="pair",
        is_split=True,
        lacks=(),
        values=values,
        words=WORDS,
        reads_back=True,
    ),
)
