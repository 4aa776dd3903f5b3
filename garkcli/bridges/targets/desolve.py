"""deSolve of R: a method for ``rk``, always with variable steps.

With ``varstep = FALSE`` deSolve reads only the entries right below the diagonal of A.
"""

from __future__ import annotations

import json

from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import explicit_table, is_first_same_as_last
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import WORDS, trial_of

R = Style(fraction="{p}/{q}", point=False)
"""R reads decimals through long double, which rounds some twice: those of floats come back."""


def values(payload: Payload) -> Values:
    """Whether the last stage is the first of the next step."""
    return {"is_first_same_as_last": is_first_same_as_last(explicit_table(payload, "desolve"))}


def program(payload: Payload, file: str) -> Values:
    """For steps from each of the times to the next."""
    words = {**WORDS, "y1": "y[1]", "y2": "y[2]"}
    quoted = json.dumps(file, ensure_ascii=False)
    return {"quoted": quoted, "sides": trial_of(payload).formulas(0, words)}


BRIDGES = (
    Bridge(
        name="desolve",
        summary="deSolve of R: a method for rk, explicit methods",
        kinds=("rk",),
        suffix=".R",
        style=R,
        values=values,
        program=program,
    ),
)
