"""``adjoint``: the inverse of the step with −h."""

from __future__ import annotations

from yaml.nodes import Node

from garkcli.constructions.composition import adjoint
from garkcli.methodfile.constructed.parts import PartReader
from garkcli.methodfile.description import ConstructionText
from garkcli.methodfile.grammar import Kind, defined


def _read(at: PartReader, node: Node, where: str) -> ConstructionText | None:
    """The method whose adjoint is meant; it may have stages without simple nodes."""
    part = at.method(node, where, why="")
    if part is None:
        return None
    return at.made(node, lambda tableau_of, _: adjoint(tableau_of(part)))


KIND = Kind(defined("part").schema, _read)
