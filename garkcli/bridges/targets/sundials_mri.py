"""SUNDIALS MRIStep in C: an explicit method as the slow one of a multirate infinitesimal step.

Stage i goes on from stage i − 1: the fast equation is solved from c_{i−1} to c_i, with the constant
slow tendency Σ_j (a_{ij} − a_{i−1,j}) f_j / (c_i − c_{i−1}). The last stage is the new value.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from flint import fmpq

from garkcli.bridges.c_text import array, c_style, heading
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import Cell, nearest_float
from garkcli.bridges.structure import Rows, Table, table, vanishes
from garkcli.exact.field import ONE, ZERO
from garkcli.tableau.pointwise import Row

STYLE = c_style("SUN_RCONST")
_EMBEDDING = (
    "#if SUNDIALS_VERSION_MAJOR > 7 || (SUNDIALS_VERSION_MAJOR == 7 && "
    "SUNDIALS_VERSION_MINOR >= 2)"
)
"""From 7.2 on there is a row for the embedding."""


def write(payload: Payload) -> str:
    """A function that makes the coupling."""
    found = table(payload)
    _refuse(payload, found)
    stages, nodes = _with_value(found)
    s = len(nodes)
    nothing: Row = (ZERO,) * s
    increments = [_difference(row, before) for before, row in pairwise(stages)]
    name = f"gark_{payload.identifier}_mri"
    use = (
        "Use: MRIStepCreate(slow, NULL, ...), then "
        f"MRIStepSetCoupling(arkode_mem, {name}())."
    )
    note = (
        "The orders q and p are those with the fast equation solved exactly."
    )
    lines = heading(payload, use, note)
    lines += [
        "#include <arkode/arkode_mristep.h>",
        "#include <sundials/sundials_config.h>",
        "",
        f"MRIStepCoupling {name}(void);",
        "",
        f"MRIStepCoupling {name}(void)",
        "{",
        *array(payload, f"sunrealtype c[{s}]", (nodes,), STYLE, "  "),
        *array(
            payload,
            f"sunrealtype W[{s * s}]",
            [nothing, *increments],
            STYLE,
            "  ",
        ),
    ]
    if found.embedded is not None:
        last = stages[-2]
        padding = (ZERO,) * (s - found.stages)
        row = _difference((*found.embedded, *padding), last)
        lines += [
            _EMBEDDING,
            *array(payload, f"sunrealtype d[{s}]", (row,), STYLE, "  "),
            "#endif",
        ]
    lines += _assignments(payload, found, s)
    return "\n".join(lines) + "\n"


def _assignments(payload: Payload, found: Table, s: int) -> list[str]:
    """Entry by entry: MRIStepCoupling_Create reads embeddings with a wrong stride up to 7.9."""
    q = infinitesimal_order(found, payload.orders.effective)
    embedding: list[str] = []
    if found.embedded is not None:
        p = min(payload.orders.embedded or 0, 2)
        embedding = [
            _EMBEDDING,
            f"  C->p = {p};",
            f"  for (int j = 0; j < {s}; j++)",
            f"    C->W[0][{s}][j] = d[j];",
            "#endif",
        ]
    return [
        f"  MRIStepCoupling C = MRIStepCoupling_Alloc(1, {s}, MRISTEP_EXPLICIT);",
        "  if (C == NULL)",
        "    return NULL;",
        f"  C->q = {q};",
        "  C->p = 0;",
        f"  for (int i = 0; i < {s}; i++) {{",
        "    C->c[i] = c[i];",
        f"    for (int j = 0; j < {s}; j++)",
        f"      C->W[0][i][j] = W[{s} * i + j];",
        "  }",
        *embedding,
        "  return C;",
        "}",
    ]


def _refuse(payload: Payload, found: Table) -> None:
    """Whether the method can be the slow one.

    Raises:
        CannotExport: it is implicit, or its stages go back in time.
    """
    if not found.is_explicit:
        raise CannotExport(
            f"sundials-mri takes an explicit slow method, and {payload.name} has implicit stages",
            "sundials has it for ARKStep",
        )
    ends = zip(found.c, (*found.c[1:], ONE), strict=True)
    goes_on = all(nearest_float(x) <= nearest_float(y) for x, y in ends)
    if not vanishes(found.c[0]) or not goes_on:
        raise CannotExport(
            "a multirate infinitesimal step goes from node to node, from 0 to 1, and those of "
            f"{payload.name} do not ascend",
            "choose a method with ascending nodes, such as Ralston's of order 3",
        )


def _with_value(found: Table) -> tuple[Rows, Row]:
    """The stages with the new value as the last, padded with zeros; and their nodes."""
    if found.is_fsal:
        return found.A, found.c
    rows = [(*row, ZERO) for row in (*found.A, found.b)]
    return tuple(rows), (*found.c, ONE)


def _difference(row: Row, before: Row) -> Row:
    pairs = zip(row, before, strict=True)
    return tuple(x - y for x, y in pairs)


def infinitesimal_order(found: Table, order: int) -> int:
    """The order of the step with the fast equation solved exactly: 3 at most.

    It is 3 where Σ_i (c_i − c_{i−1}) (e_i + e_{i−1})ᵀ A c = 1/3, the new value among the stages
    (Knoth and Wolke, Applied Numerical Mathematics 28, 1998).
    """
    if order < 3:
        return order
    stages, nodes = _with_value(found)
    values = [_product(row, nodes) for row in stages]
    total: Cell = ZERO
    for i in range(1, len(nodes)):
        width = nodes[i] - nodes[i - 1]
        total = total + width * (values[i] + values[i - 1])
    return 3 if total == fmpq(1, 3) else 2


def _product(row: Sequence[Cell], nodes: Sequence[Cell]) -> Cell:
    total: Cell = ZERO
    for x, c in zip(row, nodes, strict=True):
        total = total + x * c
    return total


BRIDGES = (
    Bridge(
        name="sundials-mri",
        summary="C for MRIStep: an explicit method as the slow one",
        kinds=("rk",),
        suffix=".c",
        write=write,
    ),
)
