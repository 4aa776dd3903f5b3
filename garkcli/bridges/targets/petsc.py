"""PETSc TS in C: RK, ARKIMEX for pairs and diagonally implicit methods, basic symplectic."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.c_text import array, c_style, heading
from garkcli.bridges.payload import Payload
from garkcli.bridges.petsc_driver import driver
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.structure import Table, composition, no_composition, table
from garkcli.bridges.targets.sundials import check_diagonal, pair_of
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row

STYLE = c_style("PetscRealConstant")


def write(payload: Payload) -> str:
    """A function that registers the method."""
    if payload.kind == "rk":
        found = table(payload)
        check_diagonal(payload, [found], "petsc")
        if found.is_explicit:
            return _rk(payload, found)
        return _arkimex(payload, found, _nothing(found))
    if payload.kind == "prk":
        return _symplectic(payload)
    pair = pair_of(payload, "petsc")
    tables = pair.tables
    return _arkimex(payload, tables[pair.implicit], tables[pair.explicit])


def method_name(payload: Payload) -> str:
    """What PETSc calls the method."""
    return f"gark-{payload.stem.replace('_', '-')}"


def _nothing(found: Table) -> Table:
    """The explicit half of a method that has none: it is never used."""
    zeros = (ZERO,) * found.stages
    embedded = None if found.embedded is None else zeros
    return Table((zeros,) * found.stages, zeros, found.c, embedded)


def _rk(payload: Payload, found: Table) -> str:
    s = found.stages
    order = payload.orders.effective
    arrays: list[tuple[str, Sequence[Row]]] = [
        (f"A[{s * s}]", found.A),
        (f"b[{s}]", (found.b,)),
        (f"c[{s}]", (found.c,)),
    ]
    embedded, interpolation = "NULL", "0, NULL"
    if found.embedded is not None:
        arrays.append((f"bembed[{s}]", (found.embedded,)))
        embedded = "bembed"
    if found.dense is not None:
        degree = len(found.dense[0])
        arrays.append((f"binterp[{s * degree}]", found.dense))
        interpolation = f"{degree}, binterp"
    name = method_name(payload)
    call = f'TSRKRegister("{name}", {order}, {s}, A, b, c, {embedded}, {interpolation})'
    use = f"-ts_type rk -ts_rk_type {name}"
    return _file(payload, use, arrays, call)


def _arkimex(payload: Payload, implicit: Table, explicit: Table) -> str:
    s = implicit.stages
    order = payload.orders.effective
    arrays: list[tuple[str, Sequence[Row]]] = []
    tables = (("t", implicit), ("", explicit))
    for letter, found in tables:
        arrays += [
            (f"A{letter}[{s * s}]", found.A),
            (f"b{letter}[{s}]", (found.b,)),
            (f"c{letter}[{s}]", (found.c,)),
        ]
        if found.embedded is not None:
            arrays.append((f"bembed{letter}[{s}]", (found.embedded,)))
    embedded = "bembedt, bembed"
    if implicit.embedded is None:
        embedded = "NULL, NULL"
    name = method_name(payload)
    call = (
        f'TSARKIMEXRegister("{name}", {order}, {s}, At, bt, ct, A, b, c, {embedded}, 0, NULL, NULL)'
    )
    use = f"-ts_type arkimex -ts_arkimex_type {name}"
    if payload.kind == "rk":
        note = "; the whole problem is the IFunction, and there is no RHSFunction"
        return _file(payload, use + note, arrays, call)
    pair = pair_of(payload, "petsc")
    note = f"; f{pair.implicit + 1} is in the IFunction, f{pair.explicit + 1} the RHSFunction"
    return _file(payload, use + note, arrays, call)


def _symplectic(payload: Payload) -> str:
    found = composition(payload)
    if found is None:
        raise no_composition(payload, "basicsymplectic")
    name = method_name(payload)
    order = payload.orders.order
    lines = ["#if PETSC_VERSION_LT(3, 20, 0) /* kicks with c, then drifts with d */"]
    lines += _steps(payload, found.kicks, found.drifts)
    lines += ["#else /* drifts with c, then kicks with d */"]
    lines += _steps(payload, *found.drift_first)
    lines += ["#endif"]
    size = "(PetscInt)(sizeof(c) / sizeof(c[0]))"
    call = f'TSBasicSymplecticRegister("{name}", {order}, {size}, c, d)'
    use = f"-ts_type basicsymplectic -ts_basicsymplectic_type {name}"
    return _function(payload, use, lines, call)


def _steps(payload: Payload, c: Row, d: Row) -> list[str]:
    """The coefficients of a composition."""
    lines: list[str] = []
    for letter, row in (("c", c), ("d", d)):
        declaration = f"PetscReal {letter}[{len(row)}]"
        lines += array(payload, declaration, (row,), STYLE, "  ")
    return lines


def _file(
    payload: Payload, use: str, arrays: Sequence[tuple[str, Sequence[Row]]], call: str
) -> str:
    """The function with its arrays and its one call."""
    lines: list[str] = []
    for name, rows in arrays:
        lines += array(payload, f"PetscReal {name}", rows, STYLE, "  ")
    return _function(payload, use, lines, call)


def _function(payload: Payload, use: str, body: Sequence[str], call: str) -> str:
    """The function that registers the method."""
    function = f"gark_{payload.stem}_register"
    note = f"Use: call {function} after PetscInitialize, then {use}"
    lines = heading(payload, note)
    lines += [
        "#include <petscts.h>",
        "",
        f"PetscErrorCode {function}(void);",
        "",
        f"PetscErrorCode {function}(void)",
        "{",
        *body,
        "  PetscFunctionBegin;",
        f"  PetscCall({call});",
        "  PetscFunctionReturn(0);",
        "}",
    ]
    return "\n".join(lines) + "\n"


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program that takes fixed steps with TS."""
    name = method_name(payload)
    if payload.kind == "prk":
        return driver(payload, file, name, "basicsymplectic", (0, 1))
    if payload.kind == "rk":
        if table(payload).is_explicit:
            return driver(payload, file, name, "rk", (0,))
        return driver(payload, file, name, "dirk", (0,))
    pair = pair_of(payload, "petsc")
    sides = (pair.explicit, pair.implicit)
    return driver(payload, file, name, "arkimex", sides)


BRIDGES = (
    Bridge(
        name="petsc",
        summary="C for PETSc TS: RK, ARKIMEX, basic symplectic",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".c",
        write=write,
        test_driver=test_driver,
        reads_back=True,
    ),
)
