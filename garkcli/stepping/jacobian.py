"""Writes the Jacobian of an implicit block, by the chain rule along its explicit part."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, TypeAlias

from garkcli import numpy_on_use as np
from garkcli.frozen import Frozen
from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Stage, StageBlock, Vertex
from garkcli.stepping.stagewriter import StageWriter

if TYPE_CHECKING:
    from garkcli.arrays import Floats


_Entry: TypeAlias = tuple[int, int, int]
"""Row and column of an entry of a matrix of weights, and the index of its number w."""


class _Layer(Frozen):
    """Stage values or field evaluations that do not depend on each other."""

    stages: Sequence[Stage]
    entries: Sequence[_Entry]  # of the matrix W whose sums of w f the stages are
    evaluations: Sequence[FieldEvaluation]


class ChainRule:
    """The derivative of the image of n = ``dimension`` · (unknown stage values) unknowns.
    ``arguments`` has the pairs of evaluation and stage value whose derivatives are needed,
    ``weights`` indices of w = h a.
    """

    def __init__(
        self,
        block: StageBlock,
        graph: DependencyGraph,
        dimension: int,
        weights: Mapping[tuple[Stage, FieldEvaluation], int],
    ) -> None:
        self.d = dimension
        self.unknowns = block.unknowns
        stages, self.evaluations = _sorted_out(block.order)
        self._place = {x: i for i, x in enumerate(self.evaluations)}
        self._graph = graph
        self._weights = weights

        inside = {*stages, *self.unknowns}
        arguments = []
        for evaluation in self.evaluations:
            seen = [stage for stage in graph.arguments[evaluation] if stage in inside]
            arguments += [(evaluation, stage) for stage in seen]
        self.arguments = tuple(arguments)

        self._layers = []
        for _, group in groupby(block.order, type):
            stages, evaluations = _sorted_out(group)
            self._layers.append(_Layer(stages, self._entries(stages), evaluations))
        self._image = self._entries(self.unknowns)

    def _entries(self, stages: Sequence[Stage]) -> list[_Entry]:
        found = []
        for row, stage in enumerate(stages):
            for evaluation in self._graph.sums[stage]:
                column = self._place.get(evaluation)
                if column is not None:
                    found.append((row, column, self._weights[stage, evaluation]))
        return found

    def inverse(self, derivatives: Sequence[float], weights: Sequence[float]) -> Floats:
        """(I − J)⁻¹, shape (n, n), of (d, d) Jacobians by ``arguments``, row by row, and all w."""
        d = self.d
        n = d * len(self.unknowns)
        fields = dict(zip(self.arguments, np.array(derivatives).reshape(-1, d, d), strict=True))
        stages: dict[Stage, Floats] = {}
        for i, stage in enumerate(self.unknowns):
            stages[stage] = np.eye(d, n, i * d)
        of_fields = np.zeros((len(self.evaluations), d, n))
        w = np.array(weights)
        for layer in self._layers:
            if layer.entries:
                found = _combined(len(layer.stages), layer.entries, w, of_fields)
                stages.update(zip(layer.stages, found, strict=True))
            for x in layer.evaluations:
                total = np.zeros((d, n))
                for stage in self._graph.arguments[x]:
                    if stage in stages:
                        total = total + fields[x, stage] @ stages[stage]
                of_fields[self._place[x]] = total
        J = _combined(len(self.unknowns), self._image, w, of_fields).reshape(n, n)
        return np.asarray(np.linalg.inv(np.eye(n) - J), dtype=np.float64)


def _sorted_out(vertices: Iterable[Vertex]) -> tuple[list[Stage], list[FieldEvaluation]]:
    stages: list[Stage] = []
    evaluations: list[FieldEvaluation] = []
    for vertex in vertices:
        if isinstance(vertex, Stage):
            stages.append(vertex)
        else:
            evaluations.append(vertex)
    return stages, evaluations


def _combined(count: int, entries: Sequence[_Entry], w: Floats, of_fields: Floats) -> Floats:
    """The derivatives of ``count`` sums of w f, shape (count, d, n)."""
    W = np.zeros((count, len(of_fields)))
    rows, columns, numbers = np.array(entries).T
    W[rows, columns] = w[numbers]
    return np.asarray(np.tensordot(W, of_fields, axes=1), dtype=np.float64)


Slope: TypeAlias = dict[int, str]
"""The derivative of one number by the unknowns that it depends on, as texts."""
_Slopes: TypeAlias = dict[tuple[Stage | FieldEvaluation, int], Slope]


class JacobianWriter:
    """Writes derivatives; ``chains`` has Jacobians too large to be written, by blocks."""

    def __init__(self, stages: StageWriter) -> None:
        self.chains: dict[int, ChainRule] = {}
        self._stages = stages
        # of the floats of the numbers w
        self._prefix = "v" if stages.is_for_balls else ""

    def by_chain_rule(self, block: StageBlock, index: int) -> None:
        """Writes (I − J)⁻¹ as a call of ``ChainRule``, from the derivatives of the fields."""
        stages = self._stages
        # all weights first: their places are what the chain rule knows them by
        chain = ChainRule(block, stages.graph, stages.d, self._places_of_weights())
        self.chains[index] = chain
        entries: list[str] = []
        for evaluation in chain.evaluations:
            seen = [stage for x, stage in chain.arguments if x == evaluation]
            entries += self._matrices(evaluation, seen)
        numbers = ", ".join(["0.0" if x == "0" else x for x in entries])
        weights = "v" if stages.is_for_balls else "w"
        call = f"chain{index}([{numbers}], {weights})"
        stages.lines.write(f"inverse = {call}")

    def _places_of_weights(self) -> dict[tuple[Stage, FieldEvaluation], int]:
        stages = self._stages
        places = {}
        for stage, evaluations in stages.graph.sums.items():
            for evaluation in evaluations:
                places[stage, evaluation] = int(stages.weight(stage, evaluation).removeprefix("w"))
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
        """Writes the derivative of the image of the unknowns and returns its rows."""
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
                slopes[vertex, i] = self._named(row, f"s{number}_{i}_")
        image = []
        for stage in block.unknowns:
            image += self._slopes_of_sums(stage, slopes)
        return image

    def _slopes_of_sums(self, stage: Stage, slopes: _Slopes) -> list[Slope]:
        return [self._slope_of_sum(stage, i, slopes) for i in range(self._stages.d)]

    def _slope_of_sum(self, stage: Stage, i: int, slopes: _Slopes) -> Slope:
        terms = []
        for evaluation in self._stages.graph.sums[stage]:
            slope = slopes.get((evaluation, i))
            if not slope:
                continue
            terms.append((self._prefix + self._stages.weight(stage, evaluation), slope))
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
        if not by:
            return [[] for _ in range(stages.d)]
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
        slopes = field.slopes([(stage.group, k) for stage, k in by])
        code = stages.code(slopes, evaluation, is_for_balls=False)
        entries = stages.emit(code, arguments, f"j{number}_")
        width = len(by)
        rows = []
        for i in range(stages.d):
            start = i * width
            rows.append(entries[start : start + width])
        return rows

    def _named(self, row: Slope, prefix: str) -> Slope:
        made = {}
        for column, text in row.items():
            is_short = text.isidentifier() or text.replace(".", "").isdigit()
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
            total.setdefault(column, []).append(_product(factor, text))
    return {column: " + ".join(texts) for column, texts in total.items()}


def _product(x: str, y: str) -> str:
    if y == "1.0":
        return x
    if x == "1.0":
        return y
    return f"{x}*{y}"


def identity_minus(J: Sequence[Slope]) -> list[list[str]]:
    rows = []
    for i, slope in enumerate(J):
        row = ["0.0"] * len(J)
        row[i] = "1.0"
        for k, text in slope.items():
            row[k] += f" - ({text})"
        rows.append(row)
    return rows
