"""Boost.Odeint: a header with a function that makes the stepper, of any type of state.

With embedded weights the stepper estimates errors.
"""

from __future__ import annotations

from garkcli.bridges.registry import HEADER, Bridge
from garkcli.bridges.trials import CPP_WORDS

BRIDGES = (
    Bridge(
        name="boost",
        summary="Boost.Odeint: a header of C++, explicit methods",
        suffix=".hpp",
        stages="explicit",
        words=CPP_WORDS,
        file=HEADER,
    ),
)
