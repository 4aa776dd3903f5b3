"""Constructions by their keys: a module of the same name each, loaded when a file has it."""

from __future__ import annotations

from importlib import import_module
from typing import Protocol, cast

from yaml.nodes import Node

from garkcli.methodfile.coefficient_schema import Schema
from garkcli.methodfile.constructed.parts import PartReader
from garkcli.methodfile.description import ConstructionText, Structure


class Construction(Protocol):
    """What the module of a construction has."""

    def read(self, parts: PartReader, node: Node, structure: Structure) -> ConstructionText | None:
        """What stands under its key; None, with faults noted, where that makes no method."""

    def schema(self) -> Schema:
        """The JSON Schema of that."""


def construction(key: str) -> Construction:
    """The module of a construction."""
    found: object = import_module(f"garkcli.methodfile.constructed.{key}")
    return cast("Construction", found)
