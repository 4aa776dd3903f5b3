"""Distinguishes stages by their entries, and sorts them.

Every stage gets a class: first by its node and weights, then repeatedly by the classes of its
neighbours on both sides with their entries, until no class divides any more (colour refinement of
B. Weisfeiler and A. Lehman). Stages that a renumbering of the method maps to each other share a
class; the order of classes does not depend on numbering.
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
Classes: TypeAlias = dict[Stage, int]
_Signature: TypeAlias = tuple[Any, ...]
_Glances: TypeAlias = dict[Stage, list[tuple[int, int, int]]]
"""For each stage the colours that it sees, with the entry and the class of the other stage."""
_Ranks: TypeAlias = Mapping[Number, int]


def stage_classes(sheet: Sheet) -> Classes:
    """>>> from garkcli.conversion.sheet import sheet_of
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
    place = {signature: k for k, signature in enumerate(sorted({*signatures.values()}))}
    return {stage: place[x] for stage, x in signatures.items()}


def _first(sheet: Sheet, ranks: _Ranks) -> dict[Stage, _Signature]:
    signatures: dict[Stage, _Signature] = {}
    for k, space in enumerate(sheet.tableau.spaces):
        rows = _own_rows(sheet, k)
        for i in range(space.stages):
            signatures[k, i] = (k, *[ranks[row[i]] for row in rows])
    return signatures


def _own_rows(sheet: Sheet, space: int) -> list[Vector]:
    rows: list[Vector] = []
    for l, colour in enumerate(sheet.tableau.colours):
        if colour.space == space:
            rows.append(colour.c)
            rows.append(colour.b)
            rows += [weights[l] for weights in sheet.further.rows]
    return rows


def _sights(tableau: Tableau, classes: Classes, ranks: _Ranks) -> dict[Stage, _Signature]:
    """The class of each stage with its sorted sights in both directions."""
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

    A stage comes after those that it needs, unless they need it too; ties are broken by nodes,
    weights and entries. Two numberings of a method give the same result, unless only a search could
    distinguish their stages.
    """
    return _arranged(sheet, stage_classes(sheet))


def in_solving_order(sheet: Sheet) -> Sheet:
    """Returns the stages so that each is after those that it needs, otherwise in their order."""
    own: Classes = {stage: number for number, stage in enumerate(_stages(sheet.tableau))}
    return _arranged(sheet, own)


def _stages(tableau: Tableau) -> list[Stage]:
    stages: list[Stage] = []
    for k, space in enumerate(tableau.spaces):
        stages += [(k, i) for i in range(space.stages)]
    return stages


def _arranged(sheet: Sheet, places: Classes) -> Sheet:
    """The stages of each space in solving order, by place among those that are ready."""
    spaces: list[list[Place]] = [[] for _ in sheet.tableau.spaces]
    for stage in solving_order(_needs(sheet.tableau), places):
        k, _ = stage
        spaces[k].append(stage)
    return arranged(sheet, spaces)


def _needs(tableau: Tableau) -> dict[Stage, list[Stage]]:
    """Returns for each stage the stages that it sees with a nonzero entry."""
    needs: dict[Stage, list[Stage]] = {stage: [] for stage in _stages(tableau)}
    for (k, m), block in tableau.blocks.items():
        other = tableau.colours[m].space
        for i, row in enumerate(block):
            for j, entry in enumerate(row):
                if entry:
                    needs[k, i].append((other, j))
    return needs
