"""What may be minimised, by its name: a file each."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from garkcli.design.minimise.objective import Either, Level, Objective

OBJECTIVES = (
    "error",
    "error-coupling",
    "coefficients",
    "-ssp",
    "-stability-interval",
    "-real-interval",
    "-imaginary-interval",
    "-oscillator-interval",
)
"""Every one of them, in the order of the documentation."""


@cache
def find_objective(key: str) -> Objective | Level | Either:
    """What a name means; its file is loaded when it is asked for.

    >>> find_objective("error").key
    'error'
    """
    name = key.removeprefix("-").replace("-", "_")
    found = import_module(f"garkcli.design.minimise.objectives.{name}")
    objective: Objective | Level | Either = found.OBJECTIVE
    return objective
