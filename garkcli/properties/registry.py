"""The names of properties, and the modules that decide them."""

from __future__ import annotations

_FILES = (
    ("solving", "explicit diagonally-implicit sdirk esdirk gamma fully-implicit implicit-stages"),
    (
        "stages",
        "stiffly-accurate fsal symmetric reducible stage-order weak-stage-order "
        "nodes-in-unit-interval positive-weights",
    ),
    ("stability", "a-stable l-stable p-stable i-stable"),
    ("stages", "algebraically-stable"),
    ("stability", "ssp-coefficient real-stability imaginary-stability"),
)
KEYS = {key: file for file, keys in _FILES for key in keys.split()}
"""Properties with their modules in ``claimed``, in the order of the documentation."""
OF_TEST_EQUATION = frozenset(
    {"a-stable", "l-stable", "p-stable", "i-stable", "real-stability", "imaginary-stability"}
)
