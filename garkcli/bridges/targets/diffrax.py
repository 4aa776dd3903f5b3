"""diffrax: a module with a class, of explicit, diagonally implicit and implicit-explicit methods.

diffrax wants two stages at least, and nodes that are the row sums. Its cubic between steps takes
the slopes of the first and the last stage: explicit methods that have none at the end of the step
get one, whose weight is 0, and which is the first one of the next step. The program takes constant
steps; implicit stages are solved until rounding ends it.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.bridges.rounding import ball, combined
from garkcli.bridges.structure import Table, with_first_stage
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ONE, ZERO

_CLOSE = 1e-8  # as numpy.allclose has it


def values(payload: Payload, tables: Sequence[Table]) -> Values:
    """The tables with a second stage, and what the class is derived from."""
    tables = [x if x.stages > 1 else with_first_stage(x) for x in tables]
    for found in tables:
        _check_nodes(payload, found)
    is_implicit = not tables[-1].is_explicit
    bases = f"diffrax.Abstract{kind_of(tables[0])}"
    if payload.kind != "rk":
        bases = "diffrax.AbstractRungeKutta"
        bases += ", diffrax.AbstractImplicitSolver" if is_implicit else ""
    return {
        "tables": tables,
        # a stage is first sought where the one before was
        "guesses": [(*(ZERO,) * i, ONE) for i in range(tables[0].stages - 1)],
        "is_implicit": is_implicit,
        "bases": bases,
        "has_cubic": all(map(has_cubic, tables)),
    }


def kind_of(found: Table) -> str:
    """Which base class has it."""
    if found.is_explicit:
        return "ERK"
    first, *others = found.diagonal
    if len({first, *others}) == 1:
        return "SDIRK"
    return "ESDIRK" if len({*others}) == 1 and found.begins_at_start else "DIRK"


def has_cubic(found: Table) -> bool:
    """Whether the first and the last stage are the slopes at both ends."""
    return found.begins_at_start and found.A[-1] == found.b and found.c[-1] == ONE


def _check_nodes(payload: Payload, found: Table) -> None:
    """Diffrax compares the nodes with the row sums; explicit methods have 0 first.

    Raises:
        CannotExport: a node is none.
    """
    for i, (row, node) in enumerate(zip(found.A, found.c, strict=True), 1):
        rest = combined((1, node), *((-1, x) for x in row))
        if abs(ball(rest)) > _CLOSE:
            message = f"diffrax's nodes are the row sums; node {i} of {payload.name} is not"
            raise CannotExport(message, "json, numpy and matlab have any nodes")


BRIDGES = (
    Bridge(
        name="diffrax",
        summary="diffrax: a module with a class, explicit, DIRK and IMEX methods",
        kinds=EVERYTHING,
        suffix=".py",
        style=PYTHON,
        stages="lower",
        several="pair",
        ends=True,
        values=values,
        words={**WORDS, "sin": "jnp.sin", "cos": "jnp.cos", "zero": "0.0*y[0]"},
    ),
)
