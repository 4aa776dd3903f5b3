"""torchdiffeq: a module that registers a solver, explicit methods.

Its steps take the last stage for f(t + h, y at the end), and begin with it: a method without such
a stage gets one, whose weight is 0, at no cost. Between steps it has a polynomial of degree 4
through both ends, their slopes and the middle, whose weights are ours to give. The program has
tolerances that accept every step, and steps bounded by h.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import combined
from garkcli.bridges.structure import Table
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS
from garkcli.exact.field import ONE, ZERO
from garkcli.tableau.pointwise import Row


def values(payload: Payload, tables: Sequence[Table]) -> Values:
    """The weights of the middle."""
    return {"middle": middle(payload, tables[0])}


def middle(payload: Payload, found: Table) -> Row:
    """The weights of y(t + h/2): by dense output, or those that make the quartic the cubic."""
    if payload.dense is None:
        eighths = (ONE, *(ZERO,) * (found.stages - 2), -ONE)
        pairs = zip(found.b, eighths, strict=True)
        return tuple(combined((fmpq(1, 2), x), (fmpq(1, 8), y)) for x, y in pairs)
    # the values at 1/2 of the polynomials with coefficients of θ, θ², …
    powers = [fmpq(1, 2**k) for k in range(1, len(payload.dense[0][0]) + 1)]
    weights = [combined(*zip(powers, row, strict=True)) for row in payload.dense[0]]
    return (*weights, *(ZERO,) * (found.stages - len(weights)))


BRIDGES = (
    Bridge(
        name="torchdiffeq",
        summary="torchdiffeq: a module that registers a solver, explicit methods",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        ends=True,
        lacks=(),
        values=values,
        words={**WORDS, "sin": "torch.sin", "cos": "torch.cos"},
    ),
)
