"""Explicit, diagonally implicit, fully implicit; singly diagonal with its γ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.order.tolerance import within
from garkcli.properties.pattern import StageGraph, Vertex, stage_graph
from garkcli.tableau.tableau import Tableau

Kind = Literal["explicit", "diagonally implicit", "fully implicit"]


@dataclass(frozen=True)
class Shape:
    """In which order stages are computed, and what is solved for.

    Attributes:
        kind: the kind of the stages; None where zeros are not decided.
        implicit_stages: how many stage values are solved for; None where zeros are not decided.
        systems: the stages that are solved together, two or more, as (space, stage) from 0.
        gamma: γ, where all entries a_ii^{l,l} ≠ 0 by which stages depend on themselves are γ; None
            otherwise.
        singly: ``SDIRK`` where all stages are implicit with the same γ, ``ESDIRK`` where the first
            one of each stage space is explicit and all others are; empty otherwise.
    """

    kind: Kind | None
    implicit_stages: int | None
    systems: tuple[tuple[Vertex, ...], ...]
    gamma: Number | None
    singly: Literal["SDIRK", "ESDIRK", ""]

    @property
    def name(self) -> str:
        """The usual name: explicit, SDIRK, ESDIRK, diagonally implicit, fully implicit."""
        if self.kind is None:
            return "not decided"
        return self.singly or self.kind


def shape(tableau: Tableau, colour: int | None = None, tolerance: fmpq = ZERO) -> Shape:
    """The shape of the whole tableau, or of the diagonal method of one colour.

    Args:
        tableau: the method.
        colour: counted from 0; None for the whole method.
        tolerance: the rounding of its coefficients; those that are 0 in the file are 0.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> shape(gark([diagonal_method("rk4", None)], {})).name
    'explicit'
    """
    colours = None if colour is None else [colour]
    return shape_of(stage_graph(tableau, colours, tolerance), tolerance)


def shape_of(graph: StageGraph, tolerance: fmpq = ZERO) -> Shape:
    """The shape of the stages of a graph."""
    together = [tuple(sorted(found)) for found in graph.systems if len(found) > 1]
    alone = [found[0] for found in graph.systems if len(found) == 1 and graph.is_loop(found[0])]
    count = sum(map(len, together)) + len(alone)
    implicit = count if graph.is_certain else None
    kind: Kind | None = None
    if together:
        kind = "fully implicit"
    elif graph.is_certain:
        kind = "diagonally implicit" if alone else "explicit"
    gamma = None
    if kind == "diagonally implicit":
        gamma = _gamma(graph, alone, tolerance)
    singly = "" if gamma is None else _singly(graph, alone)
    return Shape(kind, implicit, tuple(together), gamma, singly)


def _singly(graph: StageGraph, implicit: Sequence[Vertex]) -> Literal["SDIRK", "ESDIRK", ""]:
    stages = set(graph.successors)
    if set(implicit) == stages:
        return "SDIRK"
    first = {vertex for vertex in stages if vertex[1] == 0}
    see_nothing = not any(graph.successors[vertex] for vertex in first)
    return "ESDIRK" if see_nothing and set(implicit) == stages - first else ""


def _gamma(graph: StageGraph, alone: Sequence[Vertex], tolerance: fmpq) -> Number | None:
    """The number by which every implicit stage depends on itself; the first one where they are
    equal within what rounding of two coefficients explains.
    """
    found = [entry for vertex in alone for entry in graph.loops[vertex]]
    first = found[0]
    if first is None:
        return None
    for entry in found:
        if entry is None or not within(entry - first, 2 * tolerance):
            return None
    return first
