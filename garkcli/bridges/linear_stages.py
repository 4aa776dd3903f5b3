"""Rosenbrock methods for targets: stage after stage, printed or transformed."""

from __future__ import annotations

from operator import sub
from typing import Any

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.structure import Rows
from garkcli.constructions.rosenbrock import Rosenbrock, Stored, stored
from garkcli.errors import MethodError
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.frozen import Frozen
from garkcli.stepping.linearly_implicit import LinearlyImplicit
from garkcli.tableau.embedded import DenseOutput, Further
from garkcli.tableau.pointwise import Row


class LinearStages(LinearlyImplicit, kw_only=True):
    """``dense`` has the coefficients of θ, θ², … of each b_i(θ)."""

    embedded: Row | None
    dense: Rows | None
    has_row_sums: bool


def printed_stages(payload: Payload) -> LinearStages:
    """A Rosenbrock method in printed form; CannotExport if a stage depends on a later one."""
    method = _of(payload)
    alpha, gamma = method.alpha[0][0], method.gamma[0][0]
    stages = range(len(alpha))
    if any(any(alpha[i][i:]) or any(gamma[i][i + 1 :]) for i in stages):
        message = f"a stage of {payload.name} needs a later one, and programs solve one at a time"
        raise CannotExport(message, "--to json has any method")
    (c,), (d,) = method.nodes
    plain = method.without_row_sums
    return LinearStages(
        alpha,
        gamma,
        method.b[0],
        c,
        d,
        embedded=None if payload.embedded is None else payload.embedded[0],
        dense=None if payload.dense is None else payload.dense[0],
        has_row_sums=plain.c is None and plain.d is None,
    )


class StoredProgram(Frozen):
    """A method in stored form, with one γ for all stages; ``d`` are the weights of ∂f/∂t.

    ``error`` is m − m̂; ``interpolant`` has rows H_1, H_2, … with b(θ) = θ m + θ (1 − θ) (H_1 + θ
    H_2 + …), None if dense output does not end at m; ``is_new`` stages evaluate f at another point.
    """

    stored: Stored
    gamma: Number
    c: Vector
    d: Vector
    error: Vector | None
    interpolant: Rows | None
    is_new: tuple[bool, ...]

    @property
    def lower_A(self) -> list[tuple[int, int, Number]]:  # noqa: N802 -- A is the usual letter
        """The entries of A below the diagonal with their places from 1, row by row."""
        return _lower(self.stored.A)

    @property
    def lower_C(self) -> list[tuple[int, int, Number]]:  # noqa: N802 -- C is the usual letter
        return _lower(self.stored.C)


def program_stages(payload: Payload) -> StoredProgram:
    """A Rosenbrock method in stored form; CannotExport if it has none, or several γ_ii."""
    printed_stages(payload)
    payload_of_numbers: Any = payload  # without parameters all weights are numbers
    dense = None if payload.dense is None else DenseOutput(payload_of_numbers.dense)
    try:
        form = stored(_of(payload), Further(payload_of_numbers.embedded, dense))
    except MethodError as error:
        raise CannotExport(error.message, _OTHERS) from None
    if len(set(form.gamma)) > 1:
        message = f"{payload.name} has several γ_ii, and this code factors one matrix"
        raise CannotExport(message, _OTHERS)
    embedded = form.further.embedded
    (c,), (d,) = _of(payload).nodes
    is_new = [
        i == 0 or (tuple(row[:i]), c[i]) != (tuple(form.A[i - 1][:i]), c[i - 1])
        for i, row in enumerate(form.A)
    ]
    return StoredProgram(
        form,
        form.gamma[0],
        c,
        d,
        None if embedded is None else tuple(map(sub, form.m, embedded[0])),
        _interpolant(form),
        tuple(is_new),
    )


_OTHERS = "--to numpy, c and json have any Rosenbrock method"


def _of(payload: Payload) -> Rosenbrock:
    assert payload.rosenbrock is not None
    return payload.rosenbrock


def _lower(matrix: Matrix) -> list[tuple[int, int, Number]]:
    rows = enumerate(matrix, start=1)
    return [(i, j, x) for i, row in rows for j, x in enumerate(row[: i - 1], start=1)]


def _interpolant(found: Stored) -> Rows | None:
    """The dense output minus θ m, divided by θ (1 − θ)."""
    if found.further.dense is None:
        return None
    powers = [*zip(*found.further.dense.weights[0], strict=True)]
    total: Vector = tuple(-x for x in found.m)
    rows = []
    for power in powers:
        total = tuple(x + y for x, y in zip(total, power, strict=True))
        rows.append(total)
    if any(rows.pop()):
        return None
    while rows and not any(rows[-1]):
        rows.pop()
    return tuple(rows)
