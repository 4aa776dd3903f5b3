"""Explicit, diagonally implicit, fully implicit; singly diagonal with its γ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from garkcli.exact.field import Number
from garkcli.properties.pattern import StageGraph, Vertex, stage_graph
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau

Kind = Literal["explicit", "diagonally implicit", "fully implicit"]


@dataclass(frozen=True)
class Shape:
    """In which order stages are computed, and what is solved for.

    Attributes:
        kind: the kind of the stages; None where zeros are not decided.
        implicit_stages: how many stage values are solved for; None where zeros are not decided.
        systems: the stages that are solved together, two or more, as (space, stage) from 0.
        gamma: γ, where all implicit stages have the same a_ii; None otherwise.
        starts_explicit: whether the first stage is explicit: with γ an ESDIRK method.
    """

    kind: Kind | None
    implicit_stages: int | None
    systems: tuple[tuple[Vertex, ...], ...]
    gamma: Number | None
    starts_explicit: bool

    @property
    def name(self) -> str:
        """The usual name: explicit, SDIRK, ESDIRK, diagonally implicit, fully implicit."""
        if self.kind is None:
            return "not decided"
        if self.kind != "diagonally implicit" or self.gamma is None:
            return self.kind
        return "ESDIRK" if self.starts_explicit else "SDIRK"


def shape(tableau: Tableau, colour: int | None = None) -> Shape:
    """The shape of the whole tableau, or of the diagonal method of one colour.

    Args:
        tableau: the method.
        colour: counted from 0; None for the whole method.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> shape(gark([diagonal_method("rk4", None)], {})).name
    'explicit'
    """
    graph = stage_graph(tableau, None if colour is None else [colour])
    together = [tuple(sorted(found)) for found in graph.systems if len(found) > 1]
    loops = [
        found[0]
        for found in graph.systems
        if len(found) == 1 and graph.is_loop(found[0])
    ]
    implicit = sum(map(len, together)) + len(loops)
    starts_explicit = _starts_explicit(graph)
    if together:
        return Shape(
            "fully implicit",
            implicit if graph.is_certain else None,
            tuple(together),
            None,
            starts_explicit,
        )
    if not graph.is_certain:
        return Shape(None, None, (), None, starts_explicit)
    if not loops:
        return Shape("explicit", 0, (), None, starts_explicit)
    gamma = (
        None
        if colour is None and tableau.size > 1
        else _gamma(tableau, colour or 0, loops)
    )
    return Shape("diagonally implicit", implicit, (), gamma, starts_explicit)


def _starts_explicit(graph: StageGraph) -> bool:
    first = [vertex for vertex in graph.successors if vertex[1] == 0]
    return all(not graph.successors[vertex] for vertex in first)


def _gamma(tableau: Tableau, colour: int, loops: list[Vertex]) -> Number | None:
    """The entry on the diagonal that all implicit stages of a colour share."""
    exact = in_points(tableau)
    block = None if exact is None else exact.block(colour, colour)
    if block is None:
        return None
    found = {block[i][i] for _, i in loops}
    return found.pop() if len(found) == 1 else None
