"""C: a header with constant arrays, for any real type.

Several vector fields have arrays ``A1_2``, ``b2`` with their numbers.
"""

from __future__ import annotations

from garkcli.bridges.numbers import c_style
from garkcli.bridges.registry import EVERYTHING, Bridge

BRIDGES = (
    Bridge(
        name="c",
        summary="a C header with constant arrays",
        kinds=EVERYTHING,
        suffix=".h",
        style=c_style("GARK_REAL_C"),
        lacks=(),
        values=lambda payload, _: {"arrays": payload.arrays()},
        reads_back=True,
    ),
)
