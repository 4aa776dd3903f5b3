"""NumPy: a Python module with arrays of floats, each the nearest to the exact number."""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON
from garkcli.bridges.registry import Bridge

BRIDGES = (
    Bridge(
        name="numpy",
        summary="a Python module with NumPy arrays",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".py",
        style=PYTHON,
        reads_back=True,
    ),
)
