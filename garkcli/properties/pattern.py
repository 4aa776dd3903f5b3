"""Which entries of a tableau are zero, and what follows for the order of its stages.

A stage value Y_i of a stage space depends on Y_j where a block has a_ij ≠ 0. The strongly connected
components of that graph are solved one after the other: a single vertex without a loop is explicit,
one with a loop is implicit in itself, a larger one is a system of stages that are solved together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.graph import components
from garkcli.order.tolerance import within
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.tableau.pointwise import Block, Cell, Row


Vertex: TypeAlias = tuple[int, int]
"""A stage value: the index of its stage space, and of its stage."""

DIGITS = 30
"""Digits of enclosures, where nodes have no simple radicals."""


class StageGraph(Frozen):
    """Which stage values look at which.

    Attributes:
        successors: for each stage value those that it depends on.
        is_certain: whether all zeros are proved; entries that may be zero are no edges, and make it
            false.
        loops: for each stage value that depends on itself directly the entries ≠ 0 by which it
            does, one a colour; None for one that is not known exactly.
    """

    successors: Mapping[Vertex, frozenset[Vertex]]
    is_certain: bool
    loops: Mapping[Vertex, tuple[Number | None, ...]]

    @property
    def systems(self) -> list[list[Vertex]]:
        """The strongly connected components, those first that others need."""
        return components(self.successors)[::-1]

    def is_loop(self, vertex: Vertex) -> bool:
        """Whether a stage value depends on itself directly."""
        return vertex in self.successors[vertex]


def spaces_that_matter(tableau: Tableau) -> set[int]:
    """The stage spaces with weights, and those that stages of these see: no step depends on the
    others.
    """
    matters: set[int] = set()
    reached = {colour.space for colour in tableau.colours if any(colour.b)}
    while reached:
        matters |= reached
        seen = {
            tableau.colours[m].space
            for (k, m), block in tableau.blocks.items()
            if k in reached and any(any(row) for row in block)
        }
        reached = seen - matters
    return matters


def stage_graph(
    tableau: Tableau, colours: Iterable[int] | None = None, tolerance: fmpq = ZERO
) -> StageGraph:
    """The graph of all stages that matter, or that of some colours alone.

    Args:
        tableau: the method.
        colours: only the vector fields of these are there; None for all.
        tolerance: the rounding of its coefficients; those that are 0 in the file are 0.
    """
    chosen = list(range(tableau.size) if colours is None else colours)
    matters = spaces_that_matter(tableau)
    graph = _Graph(tableau, tolerance)
    for l in chosen:
        space = tableau.colours[l].space
        if colours is None and space not in matters:
            continue
        graph.add_stages(space)
        for m in chosen:
            graph.add_block(l, m)
    return graph.finished()


class _Graph:
    """A stage graph that grows; colours that share stages are looked at once."""

    def __init__(self, tableau: Tableau, tolerance: fmpq) -> None:
        self.tableau = tableau
        self.tolerance = tolerance
        self.successors: dict[Vertex, set[Vertex]] = {}
        self.loops: dict[Vertex, list[Number | None]] = {}
        self.is_certain = True
        self.added: set[tuple[int, int]] = set()

    def add_stages(self, space: int) -> None:
        for i in range(self.tableau.spaces[space].stages):
            self.successors.setdefault((space, i), set())

    def add_block(self, l: int, m: int) -> None:
        space, other = (self.tableau.colours[l].space, self.tableau.colours[m].space)
        if (space, m) in self.added:
            return
        self.added.add((space, m))
        for i, row in enumerate(self._entries(l, m)):
            for j, entry in enumerate(row):
                self._add_entry(entry, (space, i), (other, j), m)

    def _entries(self, l: int, m: int) -> tuple[Row, ...]:
        block = self.tableau.block(l, m)
        if block is None or all(isinstance(x, PointSpace) for x in self.tableau.spaces):
            return block or ()
        return self._listed[l][m] or ()

    @cached_property
    def _listed(self) -> tuple[tuple[Block, ...], ...]:
        from garkcli.tableau.pointwise import entries  # for stages of families

        return entries(self.tableau, DIGITS).A

    def _add_entry(self, entry: Cell, seer: Vertex, seen: Vertex, m: int) -> None:
        nonzero = is_nonzero(entry, self.tolerance)
        if nonzero is None and isinstance(entry, arb):
            from garkcli.properties.family_entries import is_nonzero_at

            nonzero = is_nonzero_at(self.tableau, (seer[0], m), seer[1], seen[1])
        if nonzero is None:
            self.is_certain = False
        if not nonzero:
            return
        self.successors[seer].add(seen)
        if seer == seen:
            exact = None if isinstance(entry, arb) else entry
            self.loops.setdefault(seen, []).append(exact)

    def finished(self) -> StageGraph:
        successors = {x: frozenset(found) for x, found in self.successors.items()}
        loops = {x: tuple(found) for x, found in self.loops.items()}
        return StageGraph(successors, self.is_certain, loops)


def is_nonzero(entry: Cell, tolerance: fmpq = ZERO) -> bool | None:
    """Whether an entry is not zero; None where an enclosure or its rounding cannot tell."""
    if isinstance(entry, arb):
        return None if entry.contains(0) else True
    number: Number = entry
    if not number or not tolerance:
        return bool(number)
    return None if within(number, tolerance) else True


Kind = Literal["explicit", "diagonally implicit", "fully implicit"]


class Shape(Frozen):
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
    implicit = sum(map(len, together)) + len(alone) if graph.is_certain else None
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
