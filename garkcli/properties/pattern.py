"""The zeros of a tableau, and the order of computation that they allow.

Y_i depends on Y_j if a block has a_ij ≠ 0. The strongly connected components of that graph are
solved one after the other: a vertex without a loop is explicit, one with a loop is implicit in
itself, a larger component is a system of stages solved together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, fmpq

from garkcli.exact.display import in_digits
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.graph import components
from garkcli.order.tolerance import within
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.tableau.pointwise import Block, Cell


Vertex: TypeAlias = tuple[int, int]
"""A stage value: the indices of its stage space and of its stage."""

DIGITS = 30
"""Digits of enclosures if nodes have no simple radicals."""


class StageGraph(Frozen):
    """The dependencies between stage values; ``is_certain`` if all zeros are proved, as an entry
    that may be zero is no edge. ``loops`` has the nonzero entries by which a stage value depends on
    itself directly, one for each colour, None if not known exactly, ``fields`` their colours.
    """

    successors: Mapping[Vertex, frozenset[Vertex]]
    is_certain: bool
    loops: Mapping[Vertex, tuple[Number | None, ...]]
    fields: Mapping[Vertex, frozenset[int]]

    @property
    def systems(self) -> list[list[Vertex]]:
        """The strongly connected components in the order of computation."""
        return components(self.successors)[::-1]

    @property
    def changes_fields(self) -> bool:
        """Whether stages of one space depend on themselves through different vector fields."""
        found = {(space, fields) for (space, _), fields in self.fields.items()}
        return len(found) > len({space for space, _ in found})


def spaces_that_matter(tableau: Tableau) -> set[int]:
    """The stage spaces with weights, and those that their stages see."""
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
    """Returns the graph of stages of ``colours``, without idle spaces, unless all are idle."""
    chosen = list(range(tableau.size) if colours is None else colours)
    matters = spaces_that_matter(tableau) or set(range(len(tableau.spaces)))
    blocks: Mapping[Vertex, Block] = tableau.blocks
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        from garkcli.tableau.pointwise import entries  # for stages of families

        listed = entries(tableau, DIGITS).A
        of_points = {m for m in range(tableau.size) if isinstance(tableau.space(m), PointSpace)}
        blocks = {
            (tableau.colours[l].space, m): listed[l][m]
            for l, m in tableau.edges()
            if not {l, m} <= of_points
        }
        blocks = {**tableau.blocks, **blocks}
    successors: dict[Vertex, set[Vertex]] = {}
    loops: dict[Vertex, list[Number | None]] = {}
    fields: dict[Vertex, set[int]] = {}
    is_certain = True
    for space in dict.fromkeys(tableau.colours[l].space for l in chosen):
        if colours is None and space not in matters:
            continue
        successors |= {(space, i): set() for i in range(tableau.spaces[space].stages)}
        for m in chosen:
            for i, row in enumerate(blocks.get((space, m)) or ()):
                for j, entry in enumerate(row):
                    nonzero = is_nonzero(entry, tolerance)
                    if nonzero is None and isinstance(entry, arb):
                        from garkcli.properties.family_entries import is_nonzero_at

                        nonzero = is_nonzero_at(tableau, (space, m), i, j)
                    is_certain = is_certain and nonzero is not None
                    seer, seen = (space, i), (tableau.colours[m].space, j)
                    if nonzero:
                        successors[seer].add(seen)
                    if nonzero and seer == seen:
                        loops.setdefault(seen, []).append(None if isinstance(entry, arb) else entry)
                        fields.setdefault(seen, set()).add(m)
    return StageGraph(
        {x: frozenset(found) for x, found in successors.items()},
        is_certain,
        {x: tuple(found) for x, found in loops.items()},
        {x: frozenset(found) for x, found in fields.items()},
    )


def is_nonzero(entry: Cell, tolerance: fmpq = ZERO) -> bool | None:
    """Whether an entry is nonzero; None if an enclosure or rounding leaves it open."""
    if isinstance(entry, arb):
        return None if entry.contains(0) else True
    number: Number = entry
    if not number or not tolerance:
        return bool(number)
    return None if within(number, tolerance) else True


Kind = Literal["explicit", "diagonally implicit", "fully implicit"]


class Shape(Frozen):
    """The order in which stages are computed: one by one or in ``systems``.

    Attributes:
        kind: None, as ``implicit_stages``, if zeros are undecided.
        gamma: the common value of all a_ii^{l,l} ≠ 0; None if they differ.
        singly: ``SDIRK`` if all stages are implicit with the same γ and vector fields, ``ESDIRK``
            if all except the first of each stage space are; else empty.
    """

    kind: Kind | None
    implicit_stages: int | None
    systems: tuple[tuple[Vertex, ...], ...]
    gamma: Number | None
    singly: Literal["SDIRK", "ESDIRK", ""]

    @property
    def name(self) -> str:
        if self.kind is None:
            return "not decided"
        return self.singly or self.kind


def shape_of(graph: StageGraph, tolerance: fmpq = ZERO) -> Shape:
    together = [tuple(sorted(found)) for found in graph.systems if len(found) > 1]
    implicit_alone = [x for x, *others in graph.systems if not others and x in graph.successors[x]]
    implicit = sum(map(len, together)) + len(implicit_alone) if graph.is_certain else None
    kind: Kind | None = None
    if together:
        kind = "fully implicit"
    elif graph.is_certain:
        kind = "diagonally implicit" if implicit_alone else "explicit"
    gamma = None
    if kind == "diagonally implicit":
        gamma = _gamma(graph, implicit_alone, tolerance)
    singly = "" if gamma is None else _singly(graph, implicit_alone)
    return Shape(kind, implicit, tuple(together), gamma, singly)


def _singly(graph: StageGraph, implicit: Sequence[Vertex]) -> Literal["SDIRK", "ESDIRK", ""]:
    stages = set(graph.successors)
    if graph.changes_fields:
        return ""
    if set(implicit) == stages:
        return "SDIRK"
    first = {vertex for vertex in stages if vertex[1] == 0}
    see_nothing = not any(graph.successors[vertex] for vertex in first)
    return "ESDIRK" if see_nothing and set(implicit) == stages - first else ""


def _shown(number: Number, grain: fmpq) -> Number:
    """An entry of a rounded method to more digits than are printed; the grain has two for each."""
    digits = max(20, 3 + int((int(grain.q.bit_length()) - 80) * 0.15))
    if isinstance(number, fmpq) and number.q < 10**digits:
        return number
    return in_digits(number, digits)


def _gamma(graph: StageGraph, alone: Sequence[Vertex], tolerance: fmpq) -> Number | None:
    """The common diagonal entry of the implicit stages; None if they differ."""
    diagonal = [entry for vertex in alone for entry in graph.loops[vertex]]
    first = diagonal[0]
    if first is None:
        return None
    for entry in diagonal:
        if entry is None or not within(entry - first, 2 * tolerance):
            return None
    return _shown(first, tolerance) if tolerance else first
