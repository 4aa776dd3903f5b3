"""The forms that methods can be brought into, by name: one file a form in ``targets``."""

from __future__ import annotations

from importlib import import_module

from garkcli.conversion.target import Target

TARGETS = ("spelled-out", "gark", "ark", "prk", "pair", "canonical")
"""Every form; the module of the same name in ``targets`` has it."""


def target(name: str) -> Target:
    """The form of that name, one of ``TARGETS``."""
    module = name.replace("-", "_")
    found = import_module(f"garkcli.conversion.targets.{module}").TARGET
    assert isinstance(found, Target)
    return found
