"""The lines of the Jacobian of an implicit block, by the chain rule along its explicit part."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from garkcli.stepping.chainrule import ChainRule
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Fields, Stage, StageBlock
from garkcli.stepping.stagewriter import StageWriter

Slope: TypeAlias = dict[int, str]
"""The derivative of one number by the unknowns that it depends on, as texts."""


class JacobianWriter(StageWriter):
    """Writes derivatives.

    Attributes:
        chains: the Jacobians with too many unknowns to be written out, by the places of their
            blocks.
    """

    def __init__(
        self, graph: DependencyGraph, fields: Fields, dimension: int, is_for_balls: bool
    ) -> None:
        super().__init__(graph, fields, dimension, is_for_balls)
        self.chains: dict[int, ChainRule] = {}

    def _chain(self, block: StageBlock, index: int) -> None:
        """The Jacobian by ``ChainRule`` from the derivatives of the fields."""
        # all weights first: their places are what the chain rule knows them by
        pairs = [(stage, value) for stage in self.graph.sums for value in self.graph.sums[stage]]
        places = {pair: int(self._weight(*pair).removeprefix("w")) for pair in pairs}
        chain = self.chains[index] = ChainRule(block, self.graph, self.d, places)
        entries = []
        for value in chain.values:
            by = [(s, k) for v, s in chain.arguments if v == value for k in range(self.d)]
            rows = self._derivatives(value, by)
            for first in range(0, len(by), self.d):
                entries += [x for row in rows for x in row[first : first + self.d]]
        numbers = ", ".join("0.0" if x == "0" else x for x in entries)
        self._write(f"inverse = chain{index}([{numbers}], {'v' if self.is_for_balls else 'w'})")

    def _jacobian(self, block: StageBlock) -> list[Slope]:
        """The derivative of the image of the unknowns, row by row, from lines that are written
        here.
        """
        slopes: dict[tuple[Stage | FieldEvaluation, int], Slope] = {}
        for k, stage in enumerate(block.unknowns):
            for i in range(self.d):
                slopes[stage, i] = {k * self.d + i: "1.0"}
        for vertex in block.order:
            for i, row in enumerate(
                self._slopes_of_value(vertex, slopes)
                if isinstance(vertex, FieldEvaluation)
                else [self._slope_of_sum(vertex, i, slopes) for i in range(self.d)]
            ):
                slopes[vertex, i] = self._named(row, f"s{self.number[vertex]}_{i}_")
        return [
            self._slope_of_sum(stage, i, slopes) for stage in block.unknowns for i in range(self.d)
        ]

    def _slope_of_sum(
        self, stage: Stage, i: int, slopes: Mapping[tuple[Stage | FieldEvaluation, int], Slope]
    ) -> Slope:
        v = "v" if self.is_for_balls else ""
        return _sums(
            (v + self._weight(stage, value), slope)
            for value in self.graph.sums[stage]
            if (slope := slopes.get((value, i)))
        )

    def _slopes_of_value(
        self, value: FieldEvaluation, slopes: Mapping[tuple[Stage | FieldEvaluation, int], Slope]
    ) -> list[Slope]:
        by = [
            (stage, k)
            for stage in self.graph.arguments[value]
            for k in range(self.d)
            if (stage, k) in slopes
        ]
        rows = [
            list(zip(row, (slopes[x] for x in by), strict=True))
            for row in self._derivatives(value, by)
        ]
        return [
            _sums((entry, slope) for entry, slope in row if entry != "0" and slope) for row in rows
        ]

    def _derivatives(
        self, value: FieldEvaluation, by: Sequence[tuple[Stage, int]]
    ) -> list[list[str]]:
        """The derivatives of an evaluation by some components of its arguments, d rows."""
        field = self.fields[value.colour, value.group]
        arguments = self._arguments(value)
        if self.is_for_balls:
            prefix = f"X{self.number[value]}_"
            for k, x in enumerate(arguments):
                self._write(f"{prefix}{k} = float({x})")
            arguments = [f"{prefix}{k}" for k in range(len(arguments))]
        columns = {g: field.derivative(g) for g in field.depends}
        flat = [columns[stage.group][i][k] for i in range(self.d) for stage, k in by]
        made = self._formula(flat, value, False)
        entries = iter(self._emit(made, arguments, f"j{self.number[value]}_"))
        return [[next(entries) for _ in by] for _ in range(self.d)]

    def _named(self, row: Slope, prefix: str) -> Slope:
        """The same with composite texts given names."""
        made = {}
        for column, text in row.items():
            if not text.isidentifier() and not text.replace(".", "").isdigit():
                self._write(f"{prefix}{column} = {text}")
                text = f"{prefix}{column}"
            made[column] = text
        return made


def _sums(terms: Iterator[tuple[str, Slope]]) -> Slope:
    """Σ factor · slope, without multiplications by one."""
    total: dict[int, list[str]] = {}
    for factor, slope in terms:
        for column, text in slope.items():
            product = factor if text == "1.0" else text if factor == "1.0" else f"{factor}*{text}"
            total.setdefault(column, []).append(product)
    return {
        column: " + ".join(texts) if len(texts) > 1 else texts[0] for column, texts in total.items()
    }


def identity_minus(J: Sequence[Slope]) -> list[list[str]]:
    """I − J, all n² entries."""
    n = len(J)
    ones = [["1.0" if i == k else "0.0" for k in range(n)] for i in range(n)]
    return [
        [f"{ones[i][k]} - ({row[k]})" if k in row else ones[i][k] for k in range(n)]
        for i, row in enumerate(J)
    ]
