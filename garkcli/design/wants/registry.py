"""What may be wanted, by its name: a file each."""

from functools import cache
from importlib import import_module

from garkcli.design.wants.want import Want

WANTS = (
    "pair-order",
    "symplectic",
    "stiffly-accurate",
    "R-infinity",
    "stage-order",
    "consistent",
    "positive-weights",
    "nodes-in-unit-interval",
    "a-stable",
    "l-stable",
    "p-stable",
)
"""Every one of them, in the order of the documentation."""


@cache
def find_want(key: str) -> Want:
    """What a key of ``design`` means; its file is loaded when it is asked for.

    >>> find_want("stage-order").kind
    'count'
    """
    name = key.replace("-", "_").lower()
    found = import_module(f"garkcli.design.wants.{name}").WANT
    assert isinstance(found, Want)
    return found
