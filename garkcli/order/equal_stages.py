"""Stages that are equal for every problem (W. H. Hundsdorfer, M. N. Spijker, BIT 21, 1981): the
coarsest partition in which the stages of a class have equal sums of weights over each class.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.order.tolerance import within
from garkcli.tableau.tableau import Tableau


def sums_over(row: Vector, classes: Sequence[Sequence[int]]) -> Vector:
    sums: list[Number] = []
    for members in classes:
        total: Number = ZERO
        for j in members:
            if row[j]:  # most are zero
                total = total + row[j] if total else row[j]
        sums.append(total)
    return tuple(sums)


def equal_stages(tableau: Tableau, tolerance: fmpq) -> list[list[list[int]]]:
    numbers = range(len(tableau.spaces))
    classes = [[list(range(space.stages))] for space in tableau.spaces]
    while True:
        finer = [_split(tableau, k, classes, tolerance) for k in numbers]
        if list(map(len, finer)) == list(map(len, classes)):
            return finer
        classes = finer


def _split(
    tableau: Tableau, k: int, classes: list[list[list[int]]], tolerance: fmpq
) -> list[list[int]]:
    def are_equal(seen: list[Any], sight: list[Any]) -> bool:
        if not tolerance:
            return seen == sight
        pairs = zip(_numbers(seen), _numbers(sight), strict=True)
        return all(within(x - y, tolerance) for x, y in pairs)

    found: list[list[int]] = []
    blocks = [(tableau.blocks.get((k, m)), x.space) for m, x in enumerate(tableau.colours)]
    for members in classes[k]:
        if len(members) == 1:
            found.append(members)
            continue
        by_sight: list[tuple[list[Any], list[int]]] = []
        for i in members:
            # what the stage sees: its node, and the sums of its entries over each class
            sight: list[Any] = [tableau.spaces[k].nodes[i]]
            sight += [sums_over(A[i], classes[space]) for A, space in blocks if A is not None]
            # compared, not hashed: that of a fraction is slow to be had first
            alike = next((x for seen, x in by_sight if are_equal(seen, sight)), None)
            if alike is None:
                by_sight.append((sight, [i]))
            else:
                alike.append(i)
        found += [alike for _, alike in by_sight]
    return sorted(found)


def _numbers(sight: list[Any]) -> list[Number]:
    node, *rows = sight
    return [node, *(x for row in rows for x in row)]
