"""deSolve of R: a method for ``rk``, always with variable steps.

With ``varstep = FALSE`` deSolve reads only the entries right below the diagonal of A. Its program
takes steps from each of the times to the next.
"""

from __future__ import annotations

from garkcli.bridges.numbers import Style
from garkcli.bridges.registry import Bridge
from garkcli.bridges.trials import WORDS

R = Style(fraction="{p}/{q}", point=False)
"""R reads decimals through long double, which rounds some twice: those of floats come back."""

BRIDGES = (
    Bridge(
        name="desolve",
        summary="deSolve of R: a method for rk, explicit methods",
        suffix=".R",
        style=R,
        stages="explicit",
        words={**WORDS, "y1": "y[1]", "y2": "y[2]"},
    ),
)
