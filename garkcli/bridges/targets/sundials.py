"""SUNDIALS ARKODE in C: ERK, DIRK, an ARK pair, SPRK."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.bridges.c_text import array, c_style, heading
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.structure import Table, composition, no_composition, shared, table, vanishes
from garkcli.bridges.sundials_driver import driver

STYLE = c_style("SUN_RCONST")


@dataclass(frozen=True)
class Pair:
    """An explicit and a diagonally implicit table on the same stages.

    Attributes:
        explicit: the colour that is explicit.
        implicit: the other.
        tables: of both, by their colours.
    """

    explicit: int
    implicit: int
    tables: Sequence[Table]


def write(payload: Payload) -> str:
    """A function that makes the table, and one that gives it to an integrator."""
    if payload.kind == "rk":
        return _one(payload)
    if payload.kind == "prk":
        return _sprk(payload)
    return _pair(payload)


def _function(payload: Payload) -> str:
    return f"gark_{payload.stem}"


def _one(payload: Payload) -> str:
    """An explicit or a diagonally implicit method."""
    found = table(payload)
    name = _function(payload)
    check_diagonal(payload, [found], "sundials")
    _check_first(payload, [found])
    stepper = "ERKStep" if for_erkstep(found) else "ARKStep"
    use = f"Use: {stepper}Create, then {name}_set(arkode_mem)."
    lines = heading(payload, use, *_notes(payload))
    header = stepper.lower()
    lines += [
        f"#include <arkode/arkode_{header}.h>",
        "",
        f"ARKodeButcherTable {name}(void);",
        f"int {name}_set(void *arkode_mem);",
        "",
        *_table_function(payload, name, found),
        "",
    ]
    call = f"ERKStepSetTable(arkode_mem, {name}_table)"
    if stepper == "ARKStep":
        q, p = _orders(payload)
        both = f"NULL, {name}_table" if found.is_explicit else f"{name}_table, NULL"
        call = f"ARKStepSetTables(arkode_mem, {q}, {p}, {both})"
    return _joined(lines + _setter(name, [f"{name}_table"], [name], call))


def for_erkstep(found: Table) -> bool:
    """Whether ERKStep of every version steps with it as it is.

    Before 6.6.1 it takes each method whose last node is 1 for one whose last stage is the first
    of the next step, and is of another order then, in silence.
    """
    ends_at_one = found.c[-1] == fmpq(1)
    return found.is_explicit and (found.is_fsal or not ends_at_one)


def _pair(payload: Payload) -> str:
    """An explicit and an implicit method, the implicit one first where both are given."""
    pair = pair_of(payload, "sundials")
    _check_first(payload, pair.tables)
    name = _function(payload)
    names = [f"{name}_implicit", f"{name}_explicit"]
    fields = f"fe is f{pair.explicit + 1}, fi is f{pair.implicit + 1}"
    use = f"Use: ARKStepCreate(fe, fi, ...) where {fields}, then {name}_set(arkode_mem)."
    lines = heading(payload, use, *_notes(payload))
    lines += ["#include <arkode/arkode_arkstep.h>", ""]
    lines += [f"ARKodeButcherTable {x}(void);" for x in names]
    lines += [f"int {name}_set(void *arkode_mem);", ""]
    for function, colour in zip(names, (pair.implicit, pair.explicit), strict=True):
        lines += _table_function(payload, function, pair.tables[colour])
        lines.append("")
    q, p = _orders(payload)
    call = f"ARKStepSetTables(arkode_mem, {q}, {p}, Bi, Be)"
    return _joined(lines + _setter(name, ["Bi", "Be"], names, call))


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
    raise CannotExport(
        f"sundials evaluates an explicit first stage at t, and the first node is {node}",
        "where f does not depend on t, set the first node to 0",
    )


def _notes(payload: Payload) -> list[str]:
    if payload.embedded is None:
        return ["No embedded weights (d is NULL): for fixed steps alone."]
    return []


def _orders(payload: Payload) -> tuple[int, int]:
    """The orders q and p; p is 0 without embedded weights."""
    orders = payload.orders
    return orders.effective, orders.embedded or 0


def _table_function(payload: Payload, function: str, found: Table) -> list[str]:
    """A function that makes a table."""
    s = found.stages
    q, p = _orders(payload)
    lines = [f"ARKodeButcherTable {function}(void)", "{"]
    arrays = [(f"A[{s * s}]", found.A), (f"b[{s}]", (found.b,))]
    arrays.append((f"c[{s}]", (found.c,)))
    if found.embedded is not None:
        arrays.append((f"d[{s}]", (found.embedded,)))
    for name, rows in arrays:
        lines += array(payload, f"sunrealtype {name}", rows, STYLE, "  ")
    d = "NULL" if found.embedded is None else "d"
    call = f"ARKodeButcherTable_Create({s}, {q}, {p}, c, A, b, {d})"
    return [*lines, f"  return {call};", "}"]


def _setter(name: str, variables: Sequence[str], functions: Sequence[str], call: str) -> list[str]:
    """A function that gives tables, which are copied, to an integrator."""
    lines = [f"int {name}_set(void *arkode_mem)", "{", "  int flag = ARK_MEM_FAIL;"]
    for variable, function in zip(variables, functions, strict=True):
        lines.append(f"  ARKodeButcherTable {variable} = {function}();")
    condition = " && ".join(f"{x} != NULL" for x in variables)
    lines += [f"  if ({condition})", f"    flag = {call};"]
    lines += [f"  ARKodeButcherTable_Free({x});" for x in variables]
    return [*lines, "  return flag;", "}"]


def _sprk(payload: Payload) -> str:
    """A symplectic partitioned method, from SUNDIALS 7."""
    found = composition(payload)
    if found is None:
        raise no_composition(payload, "SPRKStep")
    name = _function(payload)
    use = (
        f"Use: SPRKStepCreate(f1, f2, ...) where f1 gives p' = g(q), f2 gives q' = f(p); then "
        f"SPRKStepSetMethod(arkode_mem, {name}()). From SUNDIALS 6.6 on."
    )
    s = len(found.kicks)
    lines = heading(payload, use)
    lines += [
        "#include <arkode/arkode_sprk.h>",
        "",
        f"ARKodeSPRKTable {name}(void);",
        "",
        f"ARKodeSPRKTable {name}(void)",
        "{",
        *array(payload, f"sunrealtype a[{s}]", (found.drifts,), STYLE, "  "),
        *array(payload, f"sunrealtype ahat[{s}]", (found.kicks,), STYLE, "  "),
        f"  return ARKodeSPRKTable_Create({s}, {payload.orders.order}, a, ahat);",
        "}",
    ]
    return _joined(lines)


def _joined(lines: Sequence[str]) -> str:
    return "\n".join(lines) + "\n"


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program that takes fixed steps with ERKStep, ARKStep or SPRKStep."""
    name = _function(payload)
    if payload.kind == "prk":
        return driver(payload, file, name, "sprk", (0, 1))
    if payload.kind == "rk":
        found = table(payload)
        kind = "explicit" if found.is_explicit else "dirk"
        if for_erkstep(found):
            kind = "erk"
        return driver(payload, file, name, kind, (0,))
    pair = pair_of(payload, "sundials")
    return driver(payload, file, name, "ark", (pair.explicit, pair.implicit))


BRIDGES = (
    Bridge(
        name="sundials",
        summary="C for ARKODE: ERK, DIRK, ARK pairs, SPRK",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".c",
        write=write,
        test_driver=test_driver,
        reads_back=True,
    ),
)
