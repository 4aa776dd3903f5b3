"""Tempus of Trilinos: a parameter list in XML, of an explicit, diagonally implicit or IMEX method.

Tempus reads numbers by the stream operator of C++, for which ``1/3`` is 1: all are decimals.
"""

from __future__ import annotations

from garkcli.bridges.registry import Bridge

BRIDGES = (
    Bridge(
        name="tempus",
        summary="Tempus of Trilinos: XML, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark"),
        suffix=".xml",
        stages="lower",
        several="pair",
    ),
)
