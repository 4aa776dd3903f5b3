"""SUNDIALS ARKODE in C: ERK, DIRK, an ARK pair, SPRK."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import c_style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table, composition, no_composition, shared, table, vanishes
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.frozen import Frozen


class Pair(Frozen):
    """An explicit and a diagonally implicit table on the same stages.

    Attributes:
        explicit: the colour that is explicit.
        implicit: the other.
        tables: of both, by their colours.
    """

    explicit: int
    implicit: int
    tables: Sequence[Table]


def values(payload: Payload) -> Values:
    """The integrator that has it, and its tables."""
    if payload.kind == "prk":
        steps = composition(payload)
        if steps is None:
            raise no_composition(payload, "SPRKStep")
        return {"form": "sprk", "kicks": steps.kicks, "drifts": steps.drifts}
    if payload.kind == "rk":
        found = table(payload)
        check_diagonal(payload, [found], "sundials")
        _check_first(payload, [found])
        form = "explicit" if found.is_explicit else "dirk"
        return {"form": "erk" if for_erkstep(found) else form}
    pair = pair_of(payload, "sundials")
    _check_first(payload, pair.tables)
    return {
        "form": "ark",
        "tables": [pair.tables[pair.implicit], pair.tables[pair.explicit]],
        "implicit": pair.implicit + 1,
        "explicit": pair.explicit + 1,
    }


def for_erkstep(found: Table) -> bool:
    """Whether ERKStep of every version steps with it as it is.

    Before 6.6.1 it takes each method whose last node is 1 for one whose last stage is the first
    of the next step, and is of another order then, in silence.
    """
    ends_at_one = found.c[-1] == fmpq(1)
    return found.is_explicit and (found.is_fsal or not ends_at_one)


def pair_of(payload: Payload, target: str) -> Pair:
    """A method for two vector fields as such a pair.

    Raises:
        CannotExport: it is none.
    """
    if payload.tableau.is_partitioned or payload.size != 2:
        raise CannotExport(
            f"{target} adds two vector fields, an explicit and an implicit one, and "
            f"{payload.name} has {payload.size}",
            "json, c, fortran and numpy hold any number",
        )
    tables = shared(payload)
    check_diagonal(payload, tables, target)
    explicit = [m for m, x in enumerate(tables) if x.is_explicit]
    if not explicit:
        raise CannotExport(
            f"{target} pairs an explicit with an implicit method, and both of {payload.name} are "
            "implicit",
            "json, c, fortran and numpy hold it",
        )
    # of two explicit ones the second takes the implicit place
    first = explicit[0]
    return Pair(first, 1 - first, tables)


def check_diagonal(payload: Payload, tables: Sequence[Table], target: str) -> None:
    """Whether stages can be computed one after the other.

    Raises:
        CannotExport: some are solved together.
    """
    if all(x.is_diagonally_implicit for x in tables):
        return
    raise CannotExport(
        f"{target} computes stages one after the other, and some of {payload.name} are solved "
        "together",
        "json, c, fortran and numpy hold it",
    )


def _check_first(payload: Payload, tables: Sequence[Table]) -> None:
    """ARKODE takes f at t for the first stage where that is explicit, whatever its node is.

    Raises:
        CannotExport: that would be another method.
    """
    is_explicit = all(vanishes(x.A[0][0]) for x in tables)
    if not is_explicit or all(vanishes(x.c[0]) for x in tables):
        return
    node = payload.number(tables[0].c[0])
    message = f"sundials evaluates an explicit first stage at t, and the first node is {node}"
    raise CannotExport(message, "where f does not depend on t, set the first node to 0")


def program(payload: Payload, _file: str) -> Values:
    """For fixed steps; the right-hand sides, the explicit one first."""
    trial = trial_of(payload)
    found = values(payload)
    if payload.kind == "prk":
        return {**found, "parts": trial.formulas(0, {**WORDS, "y1": "v[0]", "y2": "v[1]"})}
    if payload.kind == "rk":
        return {**found, "sides": [trial.formulas(0, WORDS)]}
    pair = pair_of(payload, "sundials")
    sides = [trial.formulas(l, WORDS) for l in (pair.explicit, pair.implicit)]
    return {**found, "sides": sides}


BRIDGES = (
    Bridge(
        name="sundials",
        summary="C for ARKODE: ERK, DIRK, ARK pairs, SPRK",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".c",
        style=c_style("SUN_RCONST"),
        values=values,
        program=program,
        reads_back=True,
    ),
)
