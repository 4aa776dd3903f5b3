"""Runge–Kutta methods written down as they are computed: one stage value after the other.

A value y_0 + h Σ w_i f(Y_i) is a mapping of stages to weights. Equal values share a stage, and
unused stages are left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.tableau.tableau import Method, butcher

Weights: TypeAlias = Mapping[int, Number]
START: Weights = {}


def combined(terms: Iterable[tuple[Number | int, Weights]]) -> Weights:
    """Σ factor · weights, without zeros."""
    total: dict[int, Number] = {}
    for factor, weights in terms:
        times = fmpq(factor) if isinstance(factor, int) else factor
        for stage, weight in weights.items():
            total[stage] = total.get(stage, ZERO) + times * weight
    return {stage: weight for stage, weight in total.items() if weight}


class StageList:
    def __init__(self) -> None:
        self._rows: list[Weights] = []

    def slope_at(self, value: Weights) -> int:
        """The stage f(Y) at an explicit value Y; equal values share a stage."""
        for i, row in enumerate(self._rows):
            if row == value:
                return i
        self._rows.append(value)
        return len(self._rows) - 1

    def implicit_slope(self, value: Weights, diagonal: Number) -> int:
        """The stage f(Y) at Y = value + h · diagonal · f(Y)."""
        i = len(self._rows)
        self._rows.append(combined([(1, value), (1, {i: diagonal})]))
        return i

    def method(self, name: str, result: Weights) -> Method:
        """The step ends at ``result``; nodes are row sums."""
        seen: set[int] = set()
        pending = list(result)
        while pending:
            i = pending.pop()
            if i not in seen:
                seen.add(i)
                pending += self._rows[i]
        used = sorted(seen)
        A = tuple(_row(self._rows[i], used) for i in used)
        return butcher(A, _row(result, used), name=name)


def _row(weights: Weights, used: Iterable[int]) -> Vector:
    return tuple(weights.get(i, ZERO) for i in used)
