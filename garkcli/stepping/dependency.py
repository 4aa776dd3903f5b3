"""The order of computation of stages, and which of them are implicit.

A directed graph has a vertex for each stage value (positions or momenta of one stage) that some
vector field uses, and one for each evaluation of a field. Its strongly connected components are
computed one after the other; in larger ones, stage values become unknowns until the rest has no
cycle. Newton's method solves for these only: the rectangular method has one.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from itertools import chain
from typing import Any, TypeAlias, TypeVar

from garkcli.frozen import Frozen
from garkcli.graph import components
from garkcli.problems.vectorfield import Group
from garkcli.stepping.fields import Fields
from garkcli.tableau.pointwise import Entries, numeric_entries
from garkcli.tableau.tableau import Tableau

DIGITS = 60
"""Coefficients that agree to so many digits are equal."""
T = TypeVar("T", bound=Hashable)


class Stage(Frozen):
    space: int
    index: int
    group: Group


class FieldEvaluation(Frozen):
    """The vector field of ``colour`` that drives ``group``, at its stage ``index``."""

    colour: int
    index: int
    group: Group


Vertex: TypeAlias = Stage | FieldEvaluation


class StageBlock(Frozen):
    """Vertices that are computed together: stage values to solve for, then the others in order."""

    unknowns: tuple[Stage, ...]
    order: tuple[Vertex, ...]


class DependencyGraph(Frozen):
    """The computations of a method; ``coefficients`` of stage None are weights."""

    evaluations: tuple[FieldEvaluation, ...]
    arguments: Mapping[FieldEvaluation, tuple[Stage, ...]]
    sums: Mapping[Stage, tuple[FieldEvaluation, ...]]
    coefficients: Mapping[tuple[Stage | None, FieldEvaluation], str]

    def blocks(self) -> tuple[StageBlock, ...]:
        """The components in the order of computation."""
        after = self._successors()
        found = []
        for component in components(after):
            if len(component) == 1:
                found.append(StageBlock((), tuple(component)))
                continue
            cut = self._cut([x for x in component if isinstance(x, Stage)])
            known = {x for x in component if x not in cut}
            rest = {x: [y for y in after[x] if y in known] for x in component if x in known}
            order = list(chain.from_iterable(components(rest)))
            unknowns = [stage for stage in self.sums if stage in cut]
            found.append(StageBlock(tuple(unknowns), tuple(order)))
        return tuple(found)

    def _successors(self) -> dict[Vertex, list[Vertex]]:
        after: dict[Vertex, list[Vertex]] = {stage: [] for stage in self.sums}
        after |= {evaluation: [] for evaluation in self.evaluations}
        for evaluation, stages in self.arguments.items():
            for stage in stages:
                after[stage].append(evaluation)
        for stage, evaluations in self.sums.items():
            for evaluation in evaluations:
                after[evaluation].append(stage)
        return after

    def _cut(self, stages: Sequence[Stage]) -> set[Stage]:
        """Stage values without which no cycle is left, found greedily."""
        before = self._predecessors(stages)
        cut = {s for s in stages if s in before[s]}
        while True:
            rest = [s for s in stages if s not in cut]
            after: dict[Stage, list[Stage]] = {}
            for s in rest:
                after[s] = [t for t in rest if s in before[t]]
            cycles = [x for x in components(after) if len(x) > 1]
            if not cycles:
                return cut
            for component in cycles:
                within = set(component)
                ways = {}  # from a neighbour through the stage value to a neighbour
                for s in component:
                    into = before[s] & within
                    ways[s] = len(into) * len(within.intersection(after[s]))
                cut.add(max(component, key=ways.__getitem__))

    def _predecessors(self, stages: Sequence[Stage]) -> dict[Stage, set[Stage]]:
        """For each of ``stages`` those among them that its evaluations use."""
        inside = set(stages)
        before: dict[Stage, set[Stage]] = {}
        for stage in stages:
            seen: set[Stage] = set()
            for evaluation in self.sums[stage]:
                seen |= inside.intersection(self.arguments[evaluation])
            before[stage] = seen
        return before


def dependency_graph(tableau: Tableau, fields: Fields) -> DependencyGraph:
    """Coefficients count as zero or equal to ``DIGITS`` digits."""
    entries = numeric_entries(tableau, DIGITS + 5)
    arguments: dict[FieldEvaluation, tuple[Stage, ...]] = {}
    for (m, group), field in fields.items():
        space = tableau.colours[m].space
        for j in range(tableau.space(m).stages):
            seen = tuple(Stage(space, j, g) for g in field.depends)
            arguments[FieldEvaluation(m, j, group)] = seen
    sums: dict[Stage, tuple[FieldEvaluation, ...]] = {}
    coefficients: dict[tuple[Stage | None, FieldEvaluation], str] = {}
    needed: dict[Stage, None] = {}  # in the order in which they are met
    for stages in arguments.values():
        needed |= dict.fromkeys(stages)
    for stage in needed:
        found = []
        for evaluation in arguments:
            if evaluation.group != stage.group:
                continue
            a = entry(tableau, entries, stage, evaluation)
            if a != 0 and not a.contains(0):
                found.append(evaluation)
                coefficients[stage, evaluation] = _text(a)
        sums[stage] = tuple(found)
    for evaluation in arguments:
        coefficients[None, evaluation] = _text(entry(tableau, entries, None, evaluation))
    return DependencyGraph(tuple(arguments), arguments, sums, coefficients)


def entry(tableau: Tableau, entries: Entries, stage: Stage | None, value: FieldEvaluation) -> Any:
    """The coefficient of an evaluation in a stage; its weight for stage None."""
    if stage is None:
        return entries.b[value.colour][value.index]
    for l, colour in enumerate(tableau.colours):
        block = entries.A[l][value.colour]
        if colour.space == stage.space and block is not None:
            return block[stage.index][value.index]
    return 0


def _text(x: Any) -> str:
    return str(x.str(DIGITS, radius=False))
