"""Solvers in Python: ``solve_ivp`` of SciPy, torchdiffeq, Dedalus, diffrax."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import DENSE, EMBEDDED, EVERYTHING, Bridge
from garkcli.bridges.rounding import ball, combined
from garkcli.bridges.structure import Table, vanishes, with_first_stage, with_last_stage
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ONE, ZERO
from garkcli.tableau.pointwise import Row

_CLOSE = 1e-8  # of numpy.allclose, used by diffrax
HERMITE = ((0, 3, -2), (1, -2, 1), (0, -1, 1))
"""The cubic Hermite polynomial: factors of b_i, first and last slope, by θ, θ², θ³."""


def _of_scipy(_: Payload, tables: Sequence[Table]) -> Values:
    """The class without a last stage at the new value; errors are b̂ − b, with the sign of SciPy."""
    (only_table,) = tables
    kept = only_table.stages - only_table.is_fsal
    last = () if only_table.is_fsal else (ZERO,)
    return {
        "kept": kept,
        "errors": (*(combined((-1, x)) for x in only_table.error), *last),
        "between": _dense(only_table, kept),
    }


def _dense(found: Table, kept: int) -> Sequence[Row]:
    """The coefficients of θ, θ², … for the stages, and for f at the new value."""
    if found.dense is not None:
        nothing = (ZERO,) * len(found.dense[0])
        return found.dense if found.is_fsal else (*found.dense, nothing)
    of_value, of_first, of_last = HERMITE
    rows = [tuple(b * k for k in of_value) for b in found.b[:kept]]
    rows[0] = tuple(x + k for x, k in zip(rows[0], of_first, strict=True))
    last: Row = tuple(map(fmpq, of_last))
    return [*rows, last]


def _of_torchdiffeq(payload: Payload, tables: Sequence[Table]) -> Values:
    """The weights of the middle.

    torchdiffeq takes the last stage for f(t + h, y at the end), and the next step begins with it: a
    method without such a stage gets one of weight 0, at no cost. Between steps it uses a polynomial
    of degree 4 through both ends, their slopes and the middle, with weights given here. The program
    has tolerances that accept every step, and steps bounded by h.
    """
    return {"middle": middle(payload, tables[0])}


def middle(payload: Payload, found: Table) -> Row:
    """The weights of y(t + h/2): by dense output, or those that make the quartic a cubic."""
    if payload.dense is None:
        eighths = (ONE, *(ZERO,) * (found.stages - 2), -ONE)
        pairs = zip(found.b, eighths, strict=True)
        return tuple(combined((fmpq(1, 2), x), (fmpq(1, 8), y)) for x, y in pairs)
    # the values at 1/2 of the polynomials with coefficients of θ, θ², …
    powers = [fmpq(1, 2**k) for k in range(1, len(payload.dense[0][0]) + 1)]
    weights = [combined(*zip(powers, row, strict=True)) for row in payload.dense[0]]
    return (*weights, *(ZERO,) * (found.stages - len(weights)))


def _of_dedalus(_: Payload, tables: Sequence[Table]) -> Values:
    """The tables with the required stages: H is the implicit method, A the explicit one.

    The last rows of its matrices are the weights, so both methods must end with a stage at the new
    value, and the first stage must be explicit: missing stages are added with weight 0.
    """
    if not all(vanishes(x) for found in tables for x in found.A[0]):
        tables = [*map(with_first_stage, tables)]
    # a single stage is also the first
    ends = all(x.stages > 1 and x.A[-1] == x.b and x.c[-1] == ONE for x in tables)
    return {"tables": tables if ends else [*map(with_last_stage, tables)], "is_put_in": not ends}


def _of_diffrax(payload: Payload, tables: Sequence[Table]) -> Values:
    """The tables and the base classes.

    diffrax requires two stages, and nodes that are the row sums. Its cubic between steps uses the
    slopes of the first and the last stage: explicit methods without a stage at the end of the step
    get one of weight 0. The program takes constant steps and solves implicit stages to rounding.
    """
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
        # each stage starts from the one before
        "guesses": [(*(ZERO,) * i, ONE) for i in range(tables[0].stages - 1)],
        "is_implicit": is_implicit,
        "bases": bases,
        "has_cubic": all(map(has_cubic, tables)),
    }


def kind_of(found: Table) -> str:
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
    """Raises CannotExport if a node is not the row sum: diffrax compares them."""
    for i, (row, node) in enumerate(zip(found.A, found.c, strict=True), 1):
        rest = combined((1, node), *((-1, x) for x in row))
        if abs(ball(rest)) > _CLOSE:
            message = f"diffrax's nodes are the row sums; node {i} of {payload.name} is not"
            raise CannotExport(message, "json, numpy and matlab have any nodes")


BRIDGES = (
    Bridge(
        name="scipy",
        summary="a method of scipy.integrate.solve_ivp, explicit",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        lacks=(),
        values=_of_scipy,
        words=WORDS,
    ),
    Bridge(
        name="torchdiffeq",
        summary="torchdiffeq: a module that registers a solver, explicit methods",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        ends=True,
        lacks=(),
        values=_of_torchdiffeq,
        words={**WORDS, "sin": "torch.sin", "cos": "torch.cos"},
    ),
    Bridge(
        name="dedalus",
        summary="Dedalus 3: a class, IMEX methods",
        kinds=("ark", "prk", "gark"),
        suffix=".py",
        style=PYTHON,
        stages="lower",
        several="pair",
        lacks=(EMBEDDED, DENSE),
        values=_of_dedalus,
    ),
    Bridge(
        name="diffrax",
        summary="diffrax: a module with a class, explicit, DIRK and IMEX methods",
        kinds=EVERYTHING,
        suffix=".py",
        style=PYTHON,
        stages="lower",
        several="pair",
        ends=True,
        values=_of_diffrax,
        words={**WORDS, "sin": "jnp.sin", "cos": "jnp.cos", "zero": "0.0*y[0]"},
    ),
)
