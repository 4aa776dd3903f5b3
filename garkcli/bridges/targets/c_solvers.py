"""Integrators in C: ARKODE of SUNDIALS, TS of PETSc."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.linear_stages import printed_stages
from garkcli.bridges.numbers import c_style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.bridges.structure import Table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ONE, ZERO


def _of_arkode(_: Payload, tables: Sequence[Table]) -> Values:
    first, *others = tables
    if others:
        return {"form": "ark"}
    if not first.is_explicit:
        return {"form": "dirk"}
    # Before 6.6.1 ERKStep takes each method with 1 as its last node for one whose last stage is the
    # first of the next step, and silently has another order.
    return {"form": "erk" if first.is_fsal or first.c[-1] != ONE else "explicit"}


def _of_ts(_: Payload, tables: Sequence[Table]) -> Values:
    """An implicit method as the implicit half of a pair; its explicit half is never used."""
    implicit = tables[0]
    if len(tables) > 1 or implicit.is_explicit:
        return {}
    zeros = (ZERO,) * implicit.stages
    nothing = Table((zeros,) * implicit.stages, zeros, implicit.c, implicit.embedded and zeros)
    return {"tables": [nothing, implicit]}


def _of_rosw(payload: Payload) -> Values:
    """The solver sums the rows itself."""
    stages = printed_stages(payload)
    lost = [] if stages.has_row_sums else ["c and d, which are the row sums there"]
    return {"linear": stages, "left_out": lost}


BRIDGES = (
    # it evaluates an explicit first stage at t, for any node
    Bridge(
        name="sundials",
        summary="C for ARKODE: ERK, DIRK, ARK pairs, SPRK",
        kinds=EVERYTHING,
        suffix=".c",
        style=c_style("SUN_RCONST"),
        stages="lower",
        several="pair",
        is_split=True,
        starts=True,
        values=_of_arkode,
        words=WORDS,
        reads_back=True,
    ),
    Bridge(
        name="petsc",
        summary="C for PETSc TS: RK, ARKIMEX, ROSW, basic symplectic",
        kinds=(*EVERYTHING, "row"),
        suffix=".c",
        style=c_style("PetscRealConstant"),
        stages="lower",
        several="pair",
        is_split=True,
        lacks=(),
        values=_of_ts,
        linear=_of_rosw,
        words=WORDS,
        reads_back=True,
    ),
)
