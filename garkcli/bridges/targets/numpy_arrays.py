"""NumPy: a Python module with arrays of floats, each the nearest to the exact number."""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.registry import EVERYTHING, Bridge

BRIDGES = (
    Bridge(
        name="numpy",
        summary="a Python module with NumPy arrays",
        kinds=EVERYTHING,
        suffix=".py",
        style=PYTHON,
        lacks=(),
        reads_back=True,
    ),
)
