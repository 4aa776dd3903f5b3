"""Stages in an order that no numbering changes, each after those that it needs."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush

from garkcli.conversion.sheet import Place, Sheet, arranged
from garkcli.conversion.stage_classes import Classes, Stage, stage_classes
from garkcli.graph import components
from garkcli.tableau.tableau import Tableau


def in_order(sheet: Sheet) -> Sheet:
    """The method with its stages sorted.

    A stage comes after those that it needs, unless they need it too; what that leaves open is
    decided by nodes, weights and entries. Two numberings of a method give the same, unless only
    a search could tell their stages apart.
    """
    classes = stage_classes([sheet])[0]
    return _arranged(sheet, classes)


def in_solving_order(sheet: Sheet) -> Sheet:
    """The method with each stage after those that it needs, as near to its own order as can be."""
    own: Classes = {}
    for number, stage in enumerate(_stages(sheet.tableau)):
        own[stage] = number
    return _arranged(sheet, own)


def _stages(tableau: Tableau) -> list[Stage]:
    stages: list[Stage] = []
    for k, space in enumerate(tableau.spaces):
        stages += [(k, i) for i in range(space.stages)]
    return stages


def _arranged(sheet: Sheet, places: Classes) -> Sheet:
    """The stages of each space, the first place first among those that nothing holds up."""
    spaces: list[list[Place]] = [[] for _ in sheet.tableau.spaces]
    for stage in _solved(sheet.tableau, places):
        k, _ = stage
        spaces[k].append(stage)
    return arranged(sheet, spaces)


@dataclass
class _System:
    """Stages that need each other, or a single one.

    Attributes:
        stages: in their order.
        place: the least place of them, and the number of the system.
        waits_for: the systems that it needs and that are not done yet, by their numbers.
        wanted_by: those that need it.
    """

    stages: list[Stage]
    place: tuple[int, int]
    waits_for: set[int] = field(default_factory=set)
    wanted_by: list[int] = field(default_factory=list)


def _solved(tableau: Tableau, places: Classes) -> list[Stage]:
    """All stages; of the systems that wait for no other any more the first place comes first."""
    systems = _systems(tableau, places)
    ready = [system.place for system in systems if not system.waits_for]
    heapify(ready)
    ordered: list[Stage] = []
    while ready:
        _, done = heappop(ready)
        ordered += systems[done].stages
        for k in systems[done].wanted_by:
            other = systems[k]
            other.waits_for.remove(done)
            if not other.waits_for:
                heappush(ready, other.place)
    return ordered


def _systems(tableau: Tableau, places: Classes) -> list[_System]:
    """The stages in systems that are solved together, with what each of them needs."""
    needs = _needs(tableau)
    systems: list[_System] = []
    number: dict[Stage, int] = {}
    for k, stages in enumerate(components(needs)):
        stages.sort(key=lambda stage: (places[stage], stage))
        first = places[stages[0]]
        systems.append(_System(stages, (first, k)))
        for stage in stages:
            number[stage] = k
    for stage, needed in needs.items():
        own = number[stage]
        for other in needed:
            before = number[other]
            if before != own and before not in systems[own].waits_for:
                systems[own].waits_for.add(before)
                systems[before].wanted_by.append(own)
    return systems


def _needs(tableau: Tableau) -> dict[Stage, list[Stage]]:
    """For each stage those that it sees with an entry that is not zero."""
    needs: dict[Stage, list[Stage]] = {}
    for stage in _stages(tableau):
        needs[stage] = []
    for (k, m), block in tableau.blocks.items():
        other = tableau.colours[m].space
        for i, row in enumerate(block):
            for j, entry in enumerate(row):
                if entry:
                    needs[k, i].append((other, j))
    return needs
