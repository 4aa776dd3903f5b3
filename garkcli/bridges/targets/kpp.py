"""KPP: a subroutine with the coefficients of its Rosenbrock integrators, in Fortran."""

from __future__ import annotations

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.linear_stages import program_stages
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import DENSE, Bridge
from garkcli.bridges.texts import Values

MOST_STAGES = 6


def values(payload: Payload) -> Values:
    """The coefficients; KPP forms the matrix of all stages with the first entry of d."""
    program = program_stages(payload)
    if len(program.c) > MOST_STAGES:
        message = f"the arrays of KPP hold {MOST_STAGES} stages, {payload.name} has more"
        raise CannotExport(message, "--to c or ordinarydiffeq holds any number")
    if program.d[0] != program.gamma:
        message = f"KPP takes d_1 for γ, and those of {payload.name} differ"
        raise CannotExport(message, "leave out d, or write γ there")
    order = payload.orders.effective
    local = 1 + min(order, order if payload.orders.embedded is None else payload.orders.embedded)
    return {"program": program, "local_order": local}


BRIDGES = (
    Bridge(
        name="kpp",
        summary="KPP: a subroutine for its Rosenbrock integrators in Fortran",
        suffix=".f90",
        kinds=("row",),
        style=Style(digits=36, longest=80, fraction="{p}.0_dp/{q}.0_dp", decimal="{x}_dp"),
        lacks=(DENSE,),
        linear=values,
    ),
)
