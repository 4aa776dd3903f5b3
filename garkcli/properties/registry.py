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
"""Every property, in the order of the documentation, with its file in ``claimed``."""
OF_TEST_EQUATION = frozenset(
    {"a-stable", "l-stable", "p-stable", "i-stable", "real-stability", "imaginary-stability"}
)
"""Properties that R(z) decides."""


@cache
def find(key: str) -> Property:
    """The property of a claim; its file is loaded when it is requested.

    Args:
        key: one of ``KEYS``.

    >>> find("a-stable").field
    'a_stable'
    """
    found = getattr(import_module(f"garkcli.properties.claimed.{KEYS[key]}"), key.replace("-", "_"))
    assert isinstance(found, Property)
    return found


def every_property() -> list[Property]:
    """All of them."""
    return [find(key) for key in KEYS]
