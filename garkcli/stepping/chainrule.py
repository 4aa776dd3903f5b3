"""The Jacobian of an implicit block with many unknowns, by the chain rule in matrices.

For few unknowns ``garkcli.stepping.jacobian`` writes every product out. Here the vertices of the
explicit part are gone through in layers, stage values and field evaluations in turn, each with its
derivative by all n unknowns.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, TypeAlias

from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Stage, StageBlock, Vertex

if TYPE_CHECKING:
    from garkcli.arrays import Floats


_Entry: TypeAlias = tuple[int, int, int]
"""Row, column and place of the number w of one entry of a matrix W of weights."""


@dataclass(frozen=True)
class _Layer:
    """Stage values or field evaluations that do not depend on each other."""

    stages: Sequence[Stage]
    entries: Sequence[_Entry]  # of the matrix W whose sums of w f the stages are
    evaluations: Sequence[FieldEvaluation]


class ChainRule:
    """The derivative of the image of the unknowns of a block.

    Args:
        block: with its unknowns.
        graph: that it is a part of.
        dimension: d; there are n = d · (unknown stage values) unknowns.
        weights: at which place the number w = h a of a stage and an evaluation is.

    Attributes:
        evaluations: those of the block, in their order.
        arguments: the pairs of an evaluation and a stage value whose derivatives it needs, in this
            order.
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
            layer = _Layer(stages, self._entries(stages), evaluations)
            self._layers.append(layer)
        self._image = self._entries(self.unknowns)

    def _entries(self, stages: Sequence[Stage]) -> list[_Entry]:
        """The entries of the matrix W of the sums of w f that ``stages`` are."""
        found = []
        for row, stage in enumerate(stages):
            for evaluation in self._graph.sums[stage]:
                column = self._place.get(evaluation)
                if column is not None:
                    place = self._weights[stage, evaluation]
                    found.append((row, column, place))
        return found

    def inverse(self, derivatives: Sequence[float], weights: Sequence[float]) -> Floats:
        """(I − J)⁻¹, shape (n, n).

        Args:
            derivatives: of the fields by their ``arguments``, a matrix (d, d) each, row by row.
            weights: all numbers w.
        """
        import numpy as np

        d = self.d
        n = d * len(self.unknowns)
        entries = np.array(derivatives)
        matrices = entries.reshape(-1, d, d)
        fields = dict(zip(self.arguments, matrices, strict=True))
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
                        field = fields[x, stage]
                        total = total + field @ stages[stage]
                of_fields[self._place[x]] = total
        image = _combined(len(self.unknowns), self._image, w, of_fields)
        J = image.reshape(n, n)
        unit = np.eye(n)
        inverse = np.linalg.inv(unit - J)
        return np.asarray(inverse, dtype=np.float64)


def _sorted_out(vertices: Iterable[Vertex]) -> tuple[list[Stage], list[FieldEvaluation]]:
    """Stage values, and field evaluations, each in their order."""
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
    import numpy as np

    W = np.zeros((count, len(of_fields)))
    rows, columns, numbers = np.array(entries).T
    W[rows, columns] = w[numbers]
    combined = np.tensordot(W, of_fields, axes=1)
    return np.asarray(combined, dtype=np.float64)
