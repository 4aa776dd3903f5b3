"""diffrax: a module with a class, of explicit, diagonally implicit and implicit-explicit methods.

diffrax wants two stages at least, and nodes that are the row sums. Its cubic between steps takes
the slopes of the first and the last stage: explicit methods that have none at the end of the step
get one, whose weight is 0, and which is the first one of the next step.
"""

from __future__ import annotations

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table, shared
from garkcli.bridges.tables import (
    ball,
    begins_at_start,
    below_diagonal,
    diagonal,
    difference,
    error_or_zero,
    imex_tables,
    lower_table,
    with_first_stage,
    with_last_stage,
)
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ONE, ZERO

_CLOSE = 1e-8  # as numpy.allclose has it
_SINGLE = {
    "explicit": "diffrax.AbstractERK",
    "DIRK": "diffrax.AbstractDIRK",
    "SDIRK": "diffrax.AbstractSDIRK",
    "ESDIRK": "diffrax.AbstractESDIRK",
}


def values(payload: Payload) -> Values:
    """The tables, the explicit one of two first, and what the class is derived from."""
    found = _tables(payload)
    is_implicit = not found[-1].is_explicit
    if payload.kind == "rk":
        bases = _SINGLE[kind_of(found[0])]
    else:
        bases = "diffrax.AbstractRungeKutta"
        bases += ", diffrax.AbstractImplicitSolver" if is_implicit else ""
    cubic = all(map(has_cubic, found))
    return {
        "tables": [_arrays(payload, x) for x in found],
        "is_implicit": is_implicit,
        "bases": bases,
        "has_cubic": cubic,
        "between": "the cubic through both ends and their slopes" if cubic else "linear",
    }


def _tables(payload: Payload) -> tuple[Table, ...]:
    if payload.kind == "rk":
        return (_with_stages(lower_table(payload, "diffrax")),)
    pair = imex_tables(payload, "diffrax")
    return pair if pair[0].stages > 1 else tuple(map(with_first_stage, pair))


def _with_stages(found: Table) -> Table:
    """A table that diffrax takes: explicit ones with a stage at the end."""
    if found.is_explicit:
        has_end = begins_at_start(found) and found.is_fsal
        return found if has_end else with_last_stage(found)
    return found if found.stages > 1 else with_first_stage(found)


def kind_of(found: Table) -> str:
    """Which base class has it."""
    if found.is_explicit:
        return "explicit"
    entries = diagonal(found)
    if len(set(entries)) == 1:
        return "SDIRK"
    is_single = len(set(entries[1:])) == 1
    return "ESDIRK" if is_single and begins_at_start(found) else "DIRK"


def has_cubic(found: Table) -> bool:
    """Whether the first and the last stage are the slopes at both ends."""
    return begins_at_start(found) and found.A[-1] == found.b and found.c[-1] == ONE


def _arrays(payload: Payload, found: Table) -> Values:
    """The arguments of a ``ButcherTableau``; a stage is first sought where the one before was."""
    _check_nodes(payload, found)
    rows = below_diagonal(found)
    guesses = [(*(ZERO,) * (len(row) - 1), ONE) for row in rows]
    return {
        "table": found,
        "lower": rows,
        "error": error_or_zero(found),
        "diagonal": diagonal(found),
        "guesses": guesses,
    }


def _check_nodes(payload: Payload, found: Table) -> None:
    """Diffrax compares the nodes with the row sums; explicit methods have 0 first.

    Raises:
        CannotExport: a node is none.
    """
    for i, (row, node) in enumerate(zip(found.A, found.c, strict=True), 1):
        rest = node
        for x in row:
            rest = difference(rest, x)
        if abs(ball(rest)) > _CLOSE:
            message = f"diffrax's nodes are the row sums; node {i} of {payload.name} is not"
            raise CannotExport(message, "json, numpy and matlab have any nodes")


def program(payload: Payload, _file: str) -> Values:
    """For constant steps; implicit stages are solved until rounding ends it."""
    sides = (0,) if payload.kind == "rk" else _roles(payload)
    is_implicit = values(payload)["is_implicit"]
    return {"sides": [_side(payload, side) for side in sides], "is_implicit": is_implicit}


def _side(payload: Payload, side: int) -> tuple[str, str]:
    """A right-hand side of the problem; of a pair (q, p) each has one of the two."""
    trial = trial_of(payload)
    if payload.kind != "prk":
        return trial.formulas(side, _WORDS)
    first, second = trial.formulas(0, _WORDS)
    return (first, "0.0*y[1]") if side == 0 else ("0.0*y[0]", second)


_WORDS = {**WORDS, "sin": "jnp.sin", "cos": "jnp.cos"}


def _roles(payload: Payload) -> tuple[int, int]:
    """Which vector fields are the explicit and the implicit one."""
    first, _ = shared(payload)
    return (0, 1) if first.is_explicit else (1, 0)


BRIDGES = (
    Bridge(
        name="diffrax",
        summary="diffrax: a module with a class, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".py",
        style=PYTHON,
        values=values,
        program=program,
    ),
)
