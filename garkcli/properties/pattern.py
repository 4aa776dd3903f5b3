"""Which entries of a tableau are zero, and what follows for the order of its stages.

A stage value Y_i of a stage space depends on Y_j where a block has a_ij ≠ 0. The strongly connected
components of that graph are solved one after the other: a single vertex without a loop is explicit,
one with a loop is implicit in itself, a larger one is a system of stages that are solved together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from flint import arb

from garkcli.exact.field import Number
from garkcli.graph import components
from garkcli.tableau.pointwise import Cell, entries
from garkcli.tableau.tableau import Tableau

Vertex: TypeAlias = tuple[int, int]
"""A stage value: the index of its stage space, and of its stage."""

DIGITS = 30
"""Digits of enclosures, where nodes have no simple radicals."""


@dataclass(frozen=True)
class StageGraph:
    """Which stage values look at which.

    Attributes:
        successors: for each stage value those that it depends on.
        is_certain: whether all zeros are proved; entries known by an enclosure that holds zero are
            no edges, and make it false.
    """

    successors: Mapping[Vertex, frozenset[Vertex]]
    is_certain: bool

    @property
    def systems(self) -> list[list[Vertex]]:
        """The strongly connected components, those first that others need."""
        return components(self.successors)[::-1]

    def is_loop(self, vertex: Vertex) -> bool:
        """Whether a stage value depends on itself directly."""
        return vertex in self.successors[vertex]


def stage_graph(tableau: Tableau, colours: Iterable[int] | None = None) -> StageGraph:
    """The graph of all stages, or that of some colours alone.

    Args:
        tableau: the method.
        colours: only the vector fields of these are there; None for all.
    """
    chosen = list(range(tableau.size) if colours is None else colours)
    listed = entries(tableau, DIGITS)
    successors: dict[Vertex, set[Vertex]] = {}
    is_certain = True
    for l in chosen:
        space = tableau.colours[l].space
        for i in range(tableau.spaces[space].stages):
            successors.setdefault((space, i), set())
        for m in chosen:
            block = listed.A[l][m]
            if block is None:
                continue
            for i, row in enumerate(block):
                for j, entry in enumerate(row):
                    nonzero = is_nonzero(entry)
                    is_certain = is_certain and nonzero is not None
                    if nonzero:
                        successors[space, i].add((tableau.colours[m].space, j))
    frozen = {vertex: frozenset(found) for vertex, found in successors.items()}
    return StageGraph(frozen, is_certain)


def is_nonzero(entry: Cell) -> bool | None:
    """Whether an entry is not zero; None where an enclosure cannot tell."""
    if isinstance(entry, arb):
        return None if entry.contains(0) else True
    number: Number = entry
    return bool(number)
