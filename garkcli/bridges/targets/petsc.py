"""PETSc TS in C: RK, ARKIMEX for pairs and diagonally implicit methods, basic symplectic."""

from __future__ import annotations

from garkcli.bridges.numbers import c_style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import Table, composition, no_composition, table
from garkcli.bridges.targets.sundials import check_diagonal, pair_of
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ZERO


def values(payload: Payload) -> Values:
    """What PETSc calls the method, and its tables, the implicit one first."""
    method = f"gark-{payload.stem.replace('_', '-')}"
    if payload.kind == "rk":
        found = table(payload)
        check_diagonal(payload, [found], "petsc")
        form = "rk" if found.is_explicit else "arkimex"
        tables = [found] if found.is_explicit else [found, _nothing(found)]
        return {"method": method, "form": form, "tables": tables}
    if payload.kind == "prk":
        steps = composition(payload)
        if steps is None:
            raise no_composition(payload, "basicsymplectic")
        return {
            "method": method,
            "form": "basicsymplectic",
            "tables": [],
            "kicks": steps.kicks,
            "drifts": steps.drifts,
            "drift_first": steps.drift_first,
        }
    pair = pair_of(payload, "petsc")
    return {
        "method": method,
        "form": "arkimex",
        "tables": [pair.tables[pair.implicit], pair.tables[pair.explicit]],
        "implicit": pair.implicit + 1,
        "explicit": pair.explicit + 1,
    }


def _nothing(found: Table) -> Table:
    """The explicit half of a method that has none: it is never used."""
    zeros = (ZERO,) * found.stages
    embedded = None if found.embedded is None else zeros
    return Table((zeros,) * found.stages, zeros, found.c, embedded)


def program(payload: Payload, _file: str) -> Values:
    """For fixed steps with TS; the right-hand sides, the explicit one first."""
    trial = trial_of(payload)
    found = values(payload)
    if payload.kind == "prk":
        parts = trial.formulas(0, {**WORDS, "y2": "y[0]"})
        return {**found, "parts": parts}
    if payload.kind == "rk":
        form = "rk" if table(payload).is_explicit else "dirk"
        return {**found, "form": form, "sides": [trial.formulas(0, WORDS)]}
    pair = pair_of(payload, "petsc")
    sides = [trial.formulas(l, WORDS) for l in (pair.explicit, pair.implicit)]
    return {**found, "sides": sides}


BRIDGES = (
    Bridge(
        name="petsc",
        summary="C for PETSc TS: RK, ARKIMEX, basic symplectic",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".c",
        style=c_style("PetscRealConstant"),
        values=values,
        program=program,
        reads_back=True,
    ),
)
