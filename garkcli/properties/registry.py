"""Properties by their names."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from garkcli.properties.keys import KEYS
from garkcli.properties.property import Property


@cache
def find(key: str) -> Property:
    """The property of a claim; its file is loaded when it is asked for.

    Args:
        key: one of ``KEYS``.

    >>> find("a-stable").field
    'a_stable'
    """
    file = import_module(f"garkcli.properties.claimed.{KEYS[key]}")
    found = getattr(file, key.replace("-", "_"))
    assert isinstance(found, Property)
    return found


def every_property() -> list[Property]:
    """All of them."""
    return [find(key) for key in KEYS]
