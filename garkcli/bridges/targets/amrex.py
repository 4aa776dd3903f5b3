"""AMReX: the lines of an inputs file, read at run time; it reads no fractions."""

from __future__ import annotations

from garkcli.bridges.registry import Bridge

BRIDGES = (
    Bridge(
        name="amrex",
        summary="AMReX: lines of an inputs file, explicit methods",
        suffix=".inputs",
        stages="explicit",
    ),
)
