"""torchode: a module with a class of explicit methods.

Its cubic between steps takes the slopes of the first and the last stage: a method that has none at
the end of the step gets one, whose weight is 0, and which is the first one of the next step.
"""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.registry import Bridge

BRIDGES = (
    Bridge(
        name="torchode",
        summary="torchode: a module with a class, explicit methods",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        ends=True,
    ),
)
