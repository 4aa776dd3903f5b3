"""Julia: a named tuple of any method, and the input of its packages of Runge-Kutta methods."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.linear_stages import program_stages
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.radicals import Radicals
from garkcli.bridges.registry import DENSE, EMBEDDED, EVERYTHING, Bridge
from garkcli.bridges.structure import Table
from garkcli.bridges.texts import Values
from garkcli.constructions.registers import in_two_registers
from garkcli.exact.field import ZERO, Algebraic
from garkcli.exact.nodes import Literal, Root
from garkcli.tableau.pointwise import Cell

_LARGEST = 2**63 - 1  # of Int64
_BIG = 77  # digits of a BigFloat, which has 256 bits


class _Big(Radicals):
    def rational(self, x: fmpq) -> str:
        return f"big({x.p})" if x.q == 1 else f"(big({x.p})//{x.q})"

    def root(self, radicand: str, _index: int) -> str:
        return f"sqrt({radicand})"


class _Exact(Style):
    """Fractions with //, square roots of BigFloat; otherwise decimals."""

    def text(self, x: Cell, digits: int | None = None) -> str:
        if digits is None and isinstance(x, fmpq):
            if max(abs(int(x.p)), int(x.q)) <= _LARGEST:
                return f"{x.p}//{x.q}"
            return f'big"{x.p}"//big"{x.q}"'
        if digits is None and isinstance(x, Algebraic) and has_square_roots_alone(x):
            return _Big().text(x)
        return super().text(x, digits)


def has_square_roots_alone(x: Algebraic) -> bool:
    """Whether a number is a sum of multiples of square roots of rational numbers."""
    radicals = [x.field.radicals[i][0] for _, word in x.terms() for i in word]
    return all(
        isinstance(radical, Root) and radical.index == 2 and isinstance(radical.radicand, Literal)
        for radical in radicals
    )


JULIA = _Exact(digits=_BIG, decimal='big"{x}"')


def low_storage(payload: Payload, tables: Sequence[Table]) -> Values:
    (only_table,) = tables
    message = (
        f"climatimesteppers has methods in Williamson's 2N form, which {payload.name} has"
        " exactly or not at all; its numbers are of several fields"
    )
    if payload.is_exact:
        form = in_two_registers(only_table.A, only_table.b, payload.tolerance or 0)
        if not isinstance(form, int):
            A, B = form
            return {"rows": [tuple(fmpq(x) if x == 0 else x for x in A), tuple(B), only_table.c]}
        message = (
            f"climatimesteppers has methods in Williamson's 2N form; {payload.name} has none: from"
            f" one stage to the next the slopes of stages {form} and {form + 1} do not enter in one"
            " ratio"
        )
    raise CannotExport(message, "julia and ordinarydiffeq have all explicit methods")


_ROWS_OF_H = 4


def _rodas(payload: Payload) -> Values:
    """The coefficients of a RodasTableau, with at least two rows of the interpolant, or none."""
    program = program_stages(payload)
    rows, zeros = program.interpolant, (ZERO,) * len(program.c)
    lost = [DENSE] if payload.dense and (rows is None or len(rows) > _ROWS_OF_H) else []
    if rows is None or lost:
        rows = ()
    elif len(rows) < 2:
        rows = (*rows, *[zeros] * (2 - len(rows)))
    return {"program": program, "interpolant": rows, "left_out": lost}


BRIDGES = (
    Bridge(
        name="julia",
        summary="Julia: a named tuple, fractions and square roots exact",
        kinds=EVERYTHING,
        suffix=".jl",
        style=JULIA,
        reads_back=True,
    ),
    Bridge(
        name="ordinarydiffeq",
        summary="Julia: ExplicitRKTableau and RodasTableau of OrdinaryDiffEq",
        kinds=("rk", "row"),
        linear=_rodas,
        suffix=".jl",
        style=JULIA,
        stages="explicit",
        reads_back=True,
    ),
    Bridge(
        name="rootedtrees",
        summary="Julia: the method of RootedTrees, with any number of vector fields",
        kinds=EVERYTHING,
        suffix=".jl",
        style=JULIA,
        several="shared",
        lacks=(EMBEDDED, DENSE),
    ),
    Bridge(
        name="rungekutta-jl",
        summary="Julia: the table in tabs of RungeKutta.jl",
        suffix=".tsv",
        reads_back=True,
    ),
    Bridge(
        name="climatimesteppers",
        summary="Julia: Williamson's 2N form for ClimaTimeSteppers, where a method has it",
        suffix=".jl",
        style=JULIA,
        stages="explicit",
        lacks=(EMBEDDED, DENSE),
        values=low_storage,
        reads_back=True,
    ),
    Bridge(
        name="geometricintegrators",
        summary="Julia: splitting coefficients of GeometricIntegrators",
        kinds=("prk",),
        suffix=".jl",
        style=JULIA,
        stages="explicit",
        is_split=True,
    ),
)
