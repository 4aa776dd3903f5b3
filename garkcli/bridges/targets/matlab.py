"""MATLAB and Octave: a function that returns a struct, and RKLab's block matrix.

One vector field has matrices, several have cells. The program solves all stages together, by
Newton's method with exact derivatives.
"""

from __future__ import annotations

from garkcli.bridges.numbers import Style
from garkcli.bridges.registry import EVERYTHING, Bridge, FileName
from garkcli.bridges.trials import WORDS

MATLAB = Style(longest=100, fraction="{p}/{q}", point=False)
"""The quotient of two whole numbers, and a decimal of any length, is rounded once."""
_NAME = FileName(
    r"[A-Za-z][A-Za-z0-9_]*(\.m)?",
    "MATLAB calls a function",
    "-o NAME.m, with letters, digits and _",
)

BRIDGES = (
    Bridge(
        name="matlab",
        summary="MATLAB and Octave: a function that returns a struct",
        kinds=EVERYTHING,
        suffix=".m",
        style=MATLAB,
        lacks=(),
        words={**WORDS, "y1": "y(1)", "y2": "y(2)", "zero": "0"},
        file=_NAME,
        reads_back=True,
    ),
    Bridge(
        name="rklab",
        summary="MATLAB: the block matrix of RKLab",
        suffix=".m",
        style=MATLAB,
        reads_back=True,
    ),
)
