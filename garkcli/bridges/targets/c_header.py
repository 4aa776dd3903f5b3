"""C: a header with constant arrays, for any real type.

Several vector fields have arrays ``A1_2``, ``b2`` with their numbers.
"""

from __future__ import annotations

from garkcli.bridges.numbers import c_style
from garkcli.bridges.registry import Bridge
from garkcli.bridges.tables import named_arrays

BRIDGES = (
    Bridge(
        name="c",
        summary="a C header with constant arrays",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".h",
        style=c_style("GARK_REAL_C"),
        values=lambda payload: {"arrays": named_arrays(payload)},
        reads_back=True,
    ),
)
