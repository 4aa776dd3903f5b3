"""Properties by their names."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from garkcli.properties.property import Property

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
"""Every property with its module in ``claimed``, in the order of the documentation."""
OF_TEST_EQUATION = frozenset(
    {"a-stable", "l-stable", "p-stable", "i-stable", "real-stability", "imaginary-stability"}
)
"""Properties that R(z) decides."""


@cache
def find(key: str) -> Property:
    """The property with a key, imported on demand.

    >>> find("a-stable").field
    'a_stable'
    """
    found = getattr(import_module(f"garkcli.properties.claimed.{KEYS[key]}"), key.replace("-", "_"))
    assert isinstance(found, Property)
    return found


def every_property() -> list[Property]:
    return [find(key) for key in KEYS]
