"""Shapes by their names: a file each."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import import_module

from garkcli.methodfile.shapes.layout import Layout, Shape, full_layout, refuse_shape, with_nodes

SHAPES = (
    "full",
    "explicit",
    "dirk",
    "sdirk",
    "esdirk",
    "symplectic-dirk",
    "imex",
    "splitting",
    "stiffly-accurate",
    "palindromic",
)
"""Every shape, in the order of the documentation; a file each."""


@cache
def find_shape(name: str) -> Shape:
    """The shape of a name; its file is loaded when it is asked for.

    >>> find_shape("sdirk").summary
    'zero above the diagonal, gamma on it'
    """
    module = f"garkcli.methodfile.shapes.{name.replace('-', '_')}"
    found = import_module(module).SHAPE
    assert isinstance(found, Shape)
    return found


def layout_of(stages: int, names: Sequence[str]) -> Layout:
    """The tableau of unknowns that has some shapes, one applied after the other.

    Raises:
        MethodError: they do not go together.

    >>> layout_of(2, ["sdirk"]).A
    ((('gamma', '0'), ('c2 - gamma', 'gamma')),)
    """
    layout = full_layout(stages)
    for place, name in enumerate(names):
        shape = find_shape(name)
        if shape.begins and place:
            raise refuse_shape(f"{name} stands after {names[0]}", f"begin with {name}")
        layout = shape.applied(layout)
    return with_nodes(layout)
