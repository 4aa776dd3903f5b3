"""Stages in an order that no numbering changes, each after those that it needs."""

from __future__ import annotations

from heapq import heapify, heappop, heappush

from garkcli.conversion.sheet import Place, Sheet, regrouped
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
    stages = _stages(sheet.tableau)
    own = {stage: number for number, stage in enumerate(stages)}
    return _arranged(sheet, own)


def _stages(tableau: Tableau) -> list[Stage]:
    numbered = enumerate(tableau.spaces)
    return [(k, i) for k, space in numbered for i in range(space.stages)]


def _arranged(sheet: Sheet, places: Classes) -> Sheet:
    """The stages of each space, the first place first among those that nothing holds up."""
    ordered = _solved(sheet.tableau, places)
    count = len(sheet.tableau.spaces)
    spaces: list[list[Place]] = [[] for _ in range(count)]
    for stage in ordered:
        spaces[stage[0]].append(stage)
    homes = [colour.space for colour in sheet.tableau.colours]
    return regrouped(sheet, spaces, homes)


def _solved(tableau: Tableau, places: Classes) -> list[Stage]:
    """All stages; of the systems whose stages need no other any more the first place comes
    first.
    """
    needs = _needs(tableau)
    systems = components(needs)
    number = {x: k for k, system in enumerate(systems) for x in system}
    waiting: list[set[int]] = []
    needed_by: list[list[int]] = [[] for _ in systems]
    for k, system in enumerate(systems):
        others = {number[x] for stage in system for x in needs[stage]} - {k}
        waiting.append(others)
        for other in others:
            needed_by[other].append(k)

    def place(k: int) -> tuple[int, int]:
        return min(places[stage] for stage in systems[k]), k

    ready = [place(k) for k, others in enumerate(waiting) if not others]
    heapify(ready)
    ordered: list[Stage] = []
    while ready:
        _, done = heappop(ready)
        ordered += sorted(systems[done], key=lambda x: (places[x], x))
        for k in needed_by[done]:
            waiting[k].remove(done)
            if not waiting[k]:
                heappush(ready, place(k))
    return ordered


def _needs(tableau: Tableau) -> dict[Stage, list[Stage]]:
    """For each stage those that it sees with an entry that is not zero."""
    needs: dict[Stage, list[Stage]] = {x: [] for x in _stages(tableau)}
    for (k, m), block in tableau.blocks.items():
        other = tableau.colours[m].space
        for i, row in enumerate(block):
            needs[k, i] += [(other, j) for j, entry in enumerate(row) if entry]
    return needs
