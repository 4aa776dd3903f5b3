"""The lines of the Jacobian of an implicit block, by the chain rule along its explicit part."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from garkcli.stepping.chainrule import ChainRule
from garkcli.stepping.dependency import FieldEvaluation, Stage, StageBlock
from garkcli.stepping.stagewriter import StageWriter

Slope: TypeAlias = dict[int, str]
"""The derivative of one number by the unknowns that it depends on, as texts."""
_Slopes: TypeAlias = dict[tuple[Stage | FieldEvaluation, int], Slope]
"""Those of components of stage values and of evaluations."""


class JacobianWriter:
    """Writes derivatives.

    Args:
        stages: has written the stages, and writes the lines.

    Attributes:
        chains: the Jacobians with too many unknowns to be written out, by the places of their
            blocks.
    """

    def __init__(self, stages: StageWriter) -> None:
        self.chains: dict[int, ChainRule] = {}
        self._stages = stages
        # of the floats of the numbers w
        self._prefix = "v" if stages.is_for_balls else ""

    def by_chain_rule(self, block: StageBlock, index: int) -> None:
        """Write (I − J)⁻¹ as a call of ``ChainRule``, from the derivatives of the fields."""
        stages = self._stages
        # all weights first: their places are what the chain rule knows them by
        places = self._places_of_weights()
        chain = ChainRule(block, stages.graph, stages.d, places)
        self.chains[index] = chain
        entries: list[str] = []
        for evaluation in chain.evaluations:
            seen = [stage for x, stage in chain.arguments if x == evaluation]
            entries += self._matrices(evaluation, seen)
        floats = ["0.0" if x == "0" else x for x in entries]
        numbers = ", ".join(floats)
        weights = "v" if stages.is_for_balls else "w"
        call = f"chain{index}([{numbers}], {weights})"
        stages.lines.write(f"inverse = {call}")

    def _places_of_weights(self) -> dict[tuple[Stage, FieldEvaluation], int]:
        """Where among the numbers w that of each stage value and evaluation is."""
        stages = self._stages
        places = {}
        for stage, evaluations in stages.graph.sums.items():
            for evaluation in evaluations:
                name = stages.weight(stage, evaluation)
                places[stage, evaluation] = int(name.removeprefix("w"))
        return places

    def _matrices(self, evaluation: FieldEvaluation, seen: Sequence[Stage]) -> list[str]:
        """The entries of the derivative (d, d) by each stage value, row by row."""
        d = self._stages.d
        by = [(stage, k) for stage in seen for k in range(d)]
        rows = self._derivatives(evaluation, by)
        entries: list[str] = []
        for first in range(0, len(by), d):
            end = first + d
            for row in rows:
                entries += row[first:end]
        return entries

    def written_out(self, block: StageBlock) -> list[Slope]:
        """The derivative of the image of the unknowns, row by row, from lines that are written
        here.
        """
        d = self._stages.d
        slopes: _Slopes = {}
        column = 0
        for stage in block.unknowns:
            for i in range(d):
                slopes[stage, i] = {column: "1.0"}
                column += 1
        for vertex in block.order:
            if isinstance(vertex, FieldEvaluation):
                rows = self._slopes_of_field(vertex, slopes)
            else:
                rows = self._slopes_of_sums(vertex, slopes)
            number = self._stages.number[vertex]
            for i, row in enumerate(rows):
                prefix = f"s{number}_{i}_"
                slopes[vertex, i] = self._named(row, prefix)
        image = []
        for stage in block.unknowns:
            image += self._slopes_of_sums(stage, slopes)
        return image

    def _slopes_of_sums(self, stage: Stage, slopes: _Slopes) -> list[Slope]:
        components = range(self._stages.d)
        return [self._slope_of_sum(stage, i, slopes) for i in components]

    def _slope_of_sum(self, stage: Stage, i: int, slopes: _Slopes) -> Slope:
        terms = []
        for evaluation in self._stages.graph.sums[stage]:
            slope = slopes.get((evaluation, i))
            if not slope:
                continue
            name = self._stages.weight(stage, evaluation)
            w = self._prefix + name
            terms.append((w, slope))
        return _sums(terms)

    def _slopes_of_field(self, evaluation: FieldEvaluation, slopes: _Slopes) -> list[Slope]:
        by = []
        for stage in self._stages.graph.arguments[evaluation]:
            components = [(stage, k) for k in range(self._stages.d)]
            by += [x for x in components if x in slopes]
        found = []
        for row in self._derivatives(evaluation, by):
            terms = []
            for entry, x in zip(row, by, strict=True):
                slope = slopes[x]
                if entry != "0" and slope:
                    terms.append((entry, slope))
            found.append(_sums(terms))
        return found

    def _derivatives(
        self, evaluation: FieldEvaluation, by: Sequence[tuple[Stage, int]]
    ) -> list[list[str]]:
        """The derivatives of an evaluation by some components of its arguments, d rows."""
        stages = self._stages
        number = stages.number[evaluation]
        field = stages.fields[evaluation.colour, evaluation.group]
        arguments = stages.arguments(evaluation)
        if stages.is_for_balls:
            floats = []
            for k, x in enumerate(arguments):
                name = f"X{number}_{k}"
                stages.lines.write(f"{name} = float({x})")
                floats.append(name)
            arguments = floats
        columns = {group: field.derivative(group) for group in field.depends}
        flat: list[object] = []
        for i in range(stages.d):
            for stage, k in by:
                derivative = columns[stage.group]
                flat.append(derivative[i][k])
        code = stages.code(flat, evaluation, is_for_balls=False)
        entries = stages.emit(code, arguments, f"j{number}_")
        width = len(by)
        rows = []
        for i in range(stages.d):
            start = i * width
            rows.append(entries[start : start + width])
        return rows

    def _named(self, row: Slope, prefix: str) -> Slope:
        """The same with composite texts given names."""
        made = {}
        for column, text in row.items():
            digits = text.replace(".", "")
            is_short = text.isidentifier() or digits.isdigit()
            if is_short:
                made[column] = text
                continue
            name = f"{prefix}{column}"
            self._stages.lines.write(f"{name} = {text}")
            made[column] = name
        return made


def _sums(terms: Iterable[tuple[str, Slope]]) -> Slope:
    """Σ factor · slope, without multiplications by one."""
    total: dict[int, list[str]] = {}
    for factor, slope in terms:
        for column, text in slope.items():
            products = total.setdefault(column, [])
            products.append(_product(factor, text))
    return {column: " + ".join(texts) for column, texts in total.items()}


def _product(x: str, y: str) -> str:
    if y == "1.0":
        return x
    if x == "1.0":
        return y
    return f"{x}*{y}"


def identity_minus(J: Sequence[Slope]) -> list[list[str]]:
    """I − J, all n² entries."""
    rows = []
    for i, slope in enumerate(J):
        row = ["0.0"] * len(J)
        row[i] = "1.0"
        for k, text in slope.items():
            row[k] += f" - ({text})"
        rows.append(row)
    return rows
