"""Stages told apart by their entries, whatever their numbers are, and put in an order.

Every stage gets a class: first by its node and its weights, then again and again by the classes of
its neighbours on both sides, with which entries, until no class divides any more (the
refinement of colours of graphs by B. Weisfeiler and A. Lehman). Stages that a renumbering of a
method turns into each other are in one class; classes have an order that no numbering changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cmp_to_key
from typing import Any, TypeAlias

from garkcli.conversion.sheet import Place, Sheet, all_rows, arranged
from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector
from garkcli.exact.roots import sign
from garkcli.graph import solving_order
from garkcli.tableau.tableau import Tableau

Stage: TypeAlias = tuple[int, int]
"""A stage: its space, and its number there."""
Classes: TypeAlias = dict[Stage, int]
_Signature: TypeAlias = tuple[Any, ...]
"""What tells stages apart; those of one round can be sorted."""
_Glances: TypeAlias = dict[Stage, list[tuple[int, int, int]]]
"""For each stage the colours that it sees, with which entry, at a stage of which class."""
_Ranks: TypeAlias = Mapping[Number, int]


def stage_classes(sheet: Sheet) -> Classes:
    """The classes of the stages of a method.

    >>> from garkcli.conversion.sheet import sheet_of
    >>> from garkcli.methodfile.load import loads
    >>> stage_classes(sheet_of(loads("{A: [[0, 1], [0, 0]], b: [1/2, 1/2]}")))
    {(0, 0): 1, (0, 1): 0}
    """
    different = {number for row in all_rows(sheet) for number in row}
    ordered = sorted(different, key=cmp_to_key(_compared))
    ranks = {number: k for k, number in enumerate(ordered)}
    classes = _numbered(_first(sheet, ranks))
    while True:
        finer = _numbered(_sights(sheet.tableau, classes, ranks))
        if len({*finer.values()}) == len({*classes.values()}):
            return classes
        classes = finer


def _compared(x: Number, y: Number) -> int:
    return sign(x - y)


def _numbered(signatures: Mapping[Stage, _Signature]) -> Classes:
    """The places of signatures in ascending order."""
    place = {signature: k for k, signature in enumerate(sorted({*signatures.values()}))}
    return {stage: place[x] for stage, x in signatures.items()}


def _first(sheet: Sheet, ranks: _Ranks) -> dict[Stage, _Signature]:
    """What a stage has by itself: its space, its nodes and its weights of every colour."""
    signatures: dict[Stage, _Signature] = {}
    for k, space in enumerate(sheet.tableau.spaces):
        rows = _own_rows(sheet, k)
        for i in range(space.stages):
            signatures[k, i] = (k, *[ranks[row[i]] for row in rows])
    return signatures


def _own_rows(sheet: Sheet, space: int) -> list[Vector]:
    """Nodes and weights of all colours at the stages of a space."""
    rows: list[Vector] = []
    for l, colour in enumerate(sheet.tableau.colours):
        if colour.space == space:
            rows.append(colour.c)
            rows.append(colour.b)
            rows += [weights[l] for weights in sheet.further.rows]
    return rows


def _sights(tableau: Tableau, classes: Classes, ranks: _Ranks) -> dict[Stage, _Signature]:
    """The class of a stage with what it sees, and with what sees it, both in ascending order."""
    seen: _Glances = {}
    seeing: _Glances = {}
    for stage in classes:
        seen[stage] = []
        seeing[stage] = []
    for (k, m), block in tableau.blocks.items():
        other = tableau.colours[m].space
        for i, row in enumerate(block):
            for j, entry in enumerate(row):
                rank = ranks[entry]
                seen[k, i].append((m, rank, classes[other, j]))
                seeing[other, j].append((m, rank, classes[k, i]))
    signatures: dict[Stage, _Signature] = {}
    for stage, number in classes.items():
        sees = tuple(sorted(seen[stage]))
        is_seen = tuple(sorted(seeing[stage]))
        signatures[stage] = (number, sees, is_seen)
    return signatures


def in_order(sheet: Sheet) -> Sheet:
    """The method with its stages sorted.

    A stage comes after those that it needs, unless they need it too; what that leaves open is
    decided by nodes, weights and entries. Two numberings of a method give the same, unless only
    a search could tell their stages apart.
    """
    return _arranged(sheet, stage_classes(sheet))


def in_solving_order(sheet: Sheet) -> Sheet:
    """The method with each stage after those that it needs, as near to its own order as can be."""
    own: Classes = {stage: number for number, stage in enumerate(_stages(sheet.tableau))}
    return _arranged(sheet, own)


def _stages(tableau: Tableau) -> list[Stage]:
    stages: list[Stage] = []
    for k, space in enumerate(tableau.spaces):
        stages += [(k, i) for i in range(space.stages)]
    return stages


def _arranged(sheet: Sheet, places: Classes) -> Sheet:
    """The stages of each space, the first place first among those that nothing holds up."""
    spaces: list[list[Place]] = [[] for _ in sheet.tableau.spaces]
    for stage in solving_order(_needs(sheet.tableau), places):
        k, _ = stage
        spaces[k].append(stage)
    return arranged(sheet, spaces)


def _needs(tableau: Tableau) -> dict[Stage, list[Stage]]:
    """For each stage those that it sees with an entry that is not zero."""
    needs: dict[Stage, list[Stage]] = {stage: [] for stage in _stages(tableau)}
    for (k, m), block in tableau.blocks.items():
        other = tableau.colours[m].space
        for i, row in enumerate(block):
            for j, entry in enumerate(row):
                if entry:
                    needs[k, i].append((other, j))
    return needs
