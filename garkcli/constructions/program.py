"""Methods of several colours written down as they are computed: one stage value after the other.

A value is y_0 + h Σ w f, with a weight for stages of each colour; colours in one space are
evaluated at the same values.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau

Slope: TypeAlias = tuple[int, int]
"""A stage of a colour, both counted from 0."""
Value: TypeAlias = Mapping[Slope, Number]
"""How much of each slope is in a value."""
START: Value = {}
"""The value at the beginning of the step."""


def summed(*values: Value) -> Value:
    """The sum of combinations of slopes."""
    total: dict[Slope, Number] = {}
    for value in values:
        for slope, weight in value.items():
            total[slope] = total.get(slope, ZERO) + weight
    return total


def of_slopes(colour: int, stages: Iterable[int], weights: Iterable[Number]) -> Value:
    """Weights for stages of one colour."""
    pairs = zip(stages, weights, strict=True)
    return {(colour, i): weight for i, weight in pairs}


class Program:
    """The stages of a method, space by space.

    Args:
        spaces: for each colour the space of its stages.
    """

    def __init__(self, spaces: Sequence[int]) -> None:
        self.spaces = tuple(spaces)
        count = max(spaces) + 1
        self._rows: list[list[Value]] = [[] for _ in range(count)]
        self._nodes: list[list[Number]] = [[] for _ in range(count)]

    def count(self, space: int) -> int:
        """How many stages a space has so far."""
        return len(self._rows[space])

    def add(self, space: int, value: Value, node: Number) -> None:
        """One stage more."""
        self._rows[space].append(value)
        self._nodes[space].append(node)

    def tableau(self, result: Value) -> Tableau:
        """The method whose step ends at a value; every colour sees every other."""
        colours = []
        blocks: dict[Edge, Matrix] = {}
        for m, space in enumerate(self.spaces):
            b = self._row(result, m)
            nodes = tuple(self._nodes[space])
            colours.append(Colour(str(m + 1), space, b, nodes, m))
            for k, rows in enumerate(self._rows):
                blocks[k, m] = tuple(self._row(row, m) for row in rows)
        spaces = tuple(PointSpace(tuple(nodes)) for nodes in self._nodes)
        return Tableau(spaces, tuple(colours), blocks)

    def _row(self, value: Value, colour: int) -> Vector:
        stages = range(self.count(self.spaces[colour]))
        return tuple(value.get((colour, i), ZERO) for i in stages)
