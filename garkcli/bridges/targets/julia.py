"""Julia: a named tuple of any method, and what its packages of Runge-Kutta methods take."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.radicals import Words, has_square_roots_alone
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import composition, shared, vanishes
from garkcli.bridges.tables import explicit_table, is_first_same_as_last
from garkcli.bridges.texts import Values
from garkcli.conversion.registers import in_two_registers
from garkcli.exact.field import Algebraic
from garkcli.exact.nodes import AlgebraicRoot

_LARGEST = 2**63 - 1  # of Int64
_BIG = 77  # digits of a BigFloat, which has 256 bits


def _coefficient(x: fmpq) -> str:
    """A rational factor of a root, exact."""
    return f"big({x.p})" if x.q == 1 else f"(big({x.p})//{x.q})"


def _root(radicand: str, _index: int) -> str:
    return f"sqrt({radicand})"


def _no_root(root: AlgebraicRoot) -> str:
    raise TypeError(f"no square root: {root!r}")


WORDS = Words(_coefficient, _root, _no_root, "^")


class _Exact(Style):
    """Exact where Julia has it: fractions with //, square roots of BigFloat; else decimals."""

    def text(self, x: Cell, digits: int | None = None) -> str:
        """The number."""
        if digits is None and isinstance(x, fmpq):
            if max(abs(int(x.p)), int(x.q)) <= _LARGEST:
                return f"{x.p}//{x.q}"
            return f'big"{x.p}"//big"{x.q}"'
        if digits is None and isinstance(x, Algebraic) and has_square_roots_alone(x):
            return WORDS.text(x)
        return super().text(x, digits)


JULIA = _Exact(digits=_BIG, decimal='big"{x}"')


def ordinarydiffeq(payload: Payload) -> Values:
    """For a function that makes the ``ExplicitRKTableau`` of any type of numbers."""
    found = explicit_table(payload, "ordinarydiffeq")
    return {"is_first_same_as_last": is_first_same_as_last(found)}


def rootedtrees(payload: Payload) -> Values:
    """Several tables have the same stages, padded with zeros."""
    return {} if payload.kind == "rk" else {"tables": shared(payload)}


def splitting(payload: Payload) -> Values:
    """The coefficients of GeometricIntegrators: q for a[1], p for b[1], q for a[2], …"""
    found = composition(payload)
    if found is None:
        raise CannotExport(
            "geometricintegrators has compositions of the flows of q' = f(p) and p' = g(q);"
            f" {payload.name} is none",
            "json, numpy, matlab and julia have every method for a pair (q, p)",
        )
    drifts, kicks = found.drift_first
    pairs = len(drifts)
    while vanishes(drifts[pairs - 1]) and vanishes(kicks[pairs - 1]):
        pairs -= 1
    return {"drifts": drifts[:pairs], "kicks": kicks[:pairs]}


def low_storage(payload: Payload) -> Values:
    """A, B and c of the 2N form."""
    found = explicit_table(payload, "climatimesteppers")
    if not payload.is_exact:
        raise CannotExport(
            f"climatimesteppers has methods in Williamson's 2N form, which {payload.name} has"
            " exactly or not at all; its numbers are of several fields",
            "julia and ordinarydiffeq have all explicit methods",
        )
    form = in_two_registers(found.A, found.b, payload.tolerance or 0)
    if isinstance(form, int):
        raise CannotExport(
            f"climatimesteppers has methods in Williamson's 2N form; {payload.name} has none: from"
            f" one stage to the next the slopes of stages {form} and {form + 1} do not enter in one"
            " ratio",
            "julia and ordinarydiffeq have all explicit methods",
        )
    A, B = form
    rows = {"A": tuple(fmpq(x) if x == 0 else x for x in A), "B": tuple(B), "C": found.c}
    return {"class": payload.class_name("julia"), "rows": rows}


BRIDGES = (
    Bridge(
        name="julia",
        summary="Julia: a named tuple, fractions and square roots exact",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".jl",
        style=JULIA,
        reads_back=True,
    ),
    Bridge(
        name="ordinarydiffeq",
        summary="Julia: ExplicitRKTableau of OrdinaryDiffEq, explicit methods",
        kinds=("rk",),
        suffix=".jl",
        style=JULIA,
        values=ordinarydiffeq,
        reads_back=True,
    ),
    Bridge(
        name="rootedtrees",
        summary="Julia: the method of RootedTrees, with any number of vector fields",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".jl",
        style=JULIA,
        values=rootedtrees,
    ),
    Bridge(
        name="rungekutta-jl",
        summary="Julia: the table in tabs of RungeKutta.jl",
        kinds=("rk",),
        suffix=".tsv",
        reads_back=True,
    ),
    Bridge(
        name="climatimesteppers",
        summary="Julia: Williamson's 2N form for ClimaTimeSteppers, where a method has it",
        kinds=("rk",),
        suffix=".jl",
        style=JULIA,
        values=low_storage,
        reads_back=True,
    ),
    Bridge(
        name="geometricintegrators",
        summary="Julia: splitting coefficients of GeometricIntegrators",
        kinds=("prk",),
        suffix=".jl",
        style=JULIA,
        values=splitting,
    ),
)
