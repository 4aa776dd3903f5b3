"""MATLAB and Octave: a function that returns a struct, and RKLab's block matrix.

One vector field has matrices, several have cells. The program solves all stages together, by
Newton's method with exact derivatives.
"""

from __future__ import annotations

import re

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.texts import Values
from garkcli.bridges.trials import trial_of

MATLAB = Style(longest=100, fraction="{p}/{q}", point=False)
"""The quotient of two whole numbers, and a decimal of any length, is rounded once."""
_WORDS = {"y1": "y(1)", "y2": "y(2)", "t": "t", "sin": "sin", "cos": "cos"}


def program(payload: Payload, file: str) -> Values:
    """The function of the file, and the vector field of each colour; of q and p a component each.

    Raises:
        CannotExport: the name of the file is no name of a function.
    """
    stem = file.removesuffix(".m")
    if not re.fullmatch("[A-Za-z][A-Za-z0-9_]*", stem):
        message = f"MATLAB calls a function by the name of its file, and {file} is none"
        raise CannotExport(message, "-o NAME.m, with letters, digits and _")
    trial = trial_of(payload)
    if payload.kind != "prk":
        sides = [trial.formulas(l, _WORDS) for l in range(payload.size)]
    else:
        first, second = trial.formulas(0, _WORDS)
        sides = [(first, "0"), ("0", second)]
    return {"function": stem, "sides": sides}


BRIDGES = (
    Bridge(
        name="matlab",
        summary="MATLAB and Octave: a function that returns a struct",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".m",
        style=MATLAB,
        program=program,
        reads_back=True,
    ),
    Bridge(
        name="rklab",
        summary="MATLAB: the block matrix of RKLab",
        kinds=("rk",),
        suffix=".m",
        style=MATLAB,
        reads_back=True,
    ),
)
