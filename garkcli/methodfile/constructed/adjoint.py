"""``adjoint``: the inverse of the step with −h."""

from __future__ import annotations

from collections.abc import Sequence

from yaml.nodes import Node

from garkcli.constructions.adjoint import adjoint
from garkcli.exact.matrix import Vector
from garkcli.methodfile.coefficient_schema import Schema
from garkcli.methodfile.constructed.parts import METHOD, PartReader, tolerance_of
from garkcli.methodfile.description import ConstructionText, Structure
from garkcli.tableau.tableau import Tableau


def read(parts: PartReader, node: Node, _: Structure) -> ConstructionText | None:
    """The method whose adjoint is meant; it may have stages without simple nodes."""
    part = parts.method(node, "adjoint", why="")
    if part is None:
        return None
    return ConstructionText(node, (part,), (), _made, tolerance_of([part]))


def _made(tableaus: Sequence[Tableau], _: Vector) -> Tableau:
    (tableau,) = tableaus
    return adjoint(tableau)


def schema() -> Schema:
    """A method."""
    return {**METHOD, "description": "The adjoint of this method."}
