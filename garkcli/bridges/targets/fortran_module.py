"""Fortran: a module with constant arrays, of at most 100 columns.

Several vector fields have arrays ``A_1_2``, ``b_2`` with their numbers.
"""

from __future__ import annotations

from garkcli.bridges.numbers import Style
from garkcli.bridges.registry import EVERYTHING, Bridge

STYLE = Style(digits=39, longest=80, fraction="{p}.0_wp/{q}.0_wp", decimal="{x}_wp")
"""39 digits are enough for real128; a longer number would not fit a line."""

BRIDGES = (
    Bridge(
        name="fortran",
        summary="a Fortran module with constant arrays",
        kinds=EVERYTHING,
        suffix=".f90",
        style=STYLE,
        lacks=(),
        values=lambda payload, _: {"arrays": payload.arrays("_")},
        reads_back=True,
    ),
)
