"""torchode: a module with a class of explicit methods.

Its cubic between steps takes the slopes of the first and the last stage: a method that has none at
the end of the step gets one, whose weight is 0, and which is the first one of the next step.
"""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import ends_with_value, error_or_zero
from garkcli.bridges.texts import Values


def values(payload: Payload) -> Values:
    """The table with its last stage, and the weights of the error."""
    found = ends_with_value(payload, "torchode")
    return {"table": found, "error": error_or_zero(found)}


BRIDGES = (
    Bridge(
        name="torchode",
        summary="torchode: a module with a class, explicit methods",
        kinds=("rk",),
        suffix=".py",
        style=PYTHON,
        values=values,
    ),
)
