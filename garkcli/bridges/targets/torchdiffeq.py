"""torchdiffeq: a module that registers a solver, explicit methods.

Its steps take the last stage for f(t + h, y at the end), and begin with it: a method without such
a stage gets one, whose weight is 0, at no cost. Between steps it has a polynomial of degree 4
through both ends, their slopes and the middle, whose weights are ours to give.
"""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import Table
from garkcli.bridges.tables import (
    below_diagonal,
    difference,
    ends_with_value,
    error_or_zero,
    scaled,
)
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ZERO
from garkcli.tableau.pointwise import Row


def values(payload: Payload) -> Values:
    """The table with its last stage, the weights of the error and of the middle."""
    found = ends_with_value(payload, "torchdiffeq")
    return {
        "table": found,
        "lower": below_diagonal(found),
        "error": error_or_zero(found),
        "middle": middle(payload, found),
    }


def middle(payload: Payload, found: Table) -> Row:
    """The weights of y(t + h/2): by dense output, or those that make the quartic the cubic."""
    if payload.dense is None:
        eighth = fmpq(1, 8)
        halves = [scaled(x, fmpq(1, 2)) for x in found.b]
        halves[0] = difference(halves[0], -eighth)
        halves[-1] = difference(halves[-1], eighth)
        return tuple(halves)
    weights = [_at_middle(x) for x in payload.dense[0]]
    further = found.stages - len(weights)
    return (*weights, *(ZERO,) * further)


def _at_middle(coefficients: Row) -> Cell:
    """The value at 1/2 of the polynomial with these coefficients of θ, θ², …"""
    total: Cell = ZERO
    for power, x in enumerate(coefficients, 1):
        total = difference(total, scaled(x, fmpq(-1, 2**power)))
    return total


def program(payload: Payload, _file: str) -> Values:
    """For tolerances that accept every step, and steps bounded by h."""
    words = {**WORDS, "sin": "torch.sin", "cos": "torch.cos"}
    return {"sides": trial_of(payload).formulas(0, words)}


BRIDGES = (
    Bridge(
        name="torchdiffeq",
        summary="torchdiffeq: a module that registers a solver, explicit methods",
        kinds=("rk",),
        suffix=".py",
        style=PYTHON,
        values=values,
        program=program,
    ),
)
