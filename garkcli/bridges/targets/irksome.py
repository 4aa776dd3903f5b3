"""Irksome: a module with a ``ButcherTableau``, fully implicit methods among them."""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.registry import Bridge

BRIDGES = (
    Bridge(
        name="irksome",
        summary="Irksome: a module with a ButcherTableau",
        suffix=".py",
        style=PYTHON,
    ),
)
