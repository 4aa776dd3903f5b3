"""The one way up: what a value answers or shows of itself by the rooms above its own.

``method.order`` is an attribute of data at the bottom, the search for orders lies above it. What is
used is looked up by its name when it is asked for, so no room imports one above.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any


def found(room: str, name: str) -> Any:
    """What is called ``name`` in ``garkcli.room``.

    >>> found("errors", "counted")(2, "stage")
    '2 stages'
    """
    return getattr(import_module(f"garkcli.{room}"), name)
