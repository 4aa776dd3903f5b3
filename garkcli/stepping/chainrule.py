"""The Jacobian of an implicit block with many unknowns, by the chain rule in matrices.

For few unknowns ``garkcli.stepping.jacobian`` writes every product out. Here the vertices of the
explicit part are gone through in layers, stage values and field evaluations in turn, each with its
derivative by all n unknowns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, TypeAlias

from garkcli.stepping.dependency import DependencyGraph, FieldEvaluation, Stage, StageBlock

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]


class ChainRule:
    """The derivative of the image of the unknowns of a block.

    Args:
        block: with its unknowns.
        graph: that it is a part of.
        dimension: d; there are n = d · (unknown stage values) unknowns.
        weights: at which place the number w = h a of a stage and a value is.

    Attributes:
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
        self.d, self.unknowns = dimension, block.unknowns
        self.values = [x for x in block.order if isinstance(x, FieldEvaluation)]
        inside = {*self.unknowns, *(x for x in block.order if isinstance(x, Stage))}
        self.arguments = tuple(
            (v, s) for v in self.values for s in graph.arguments[v] if s in inside
        )
        self._graph, self._weights = graph, weights
        self._place = {value: i for i, value in enumerate(self.values)}
        layers = [
            list(layer)
            for _, layer in groupby(block.order, lambda x: isinstance(x, FieldEvaluation))
        ]
        self._layers = [
            (layer, self._entries([x for x in layer if isinstance(x, Stage)])) for layer in layers
        ]
        self._image = self._entries(self.unknowns)

    def _entries(self, stages: Sequence[Stage]) -> list[tuple[int, int, int]]:
        """Row, column and number of each entry of the matrix W of the sums of w f that ``stages``
        are.
        """
        return [
            (i, self._place[value], self._weights[stage, value])
            for i, stage in enumerate(stages)
            for value in self._graph.sums[stage]
            if value in self._place
        ]

    def inverse(self, derivatives: Sequence[float], weights: Sequence[float]) -> Floats:
        """(I − J)⁻¹, shape (n, n).

        Args:
            derivatives: of the fields by their ``arguments``, a matrix (d, d) each, row by row.
            weights: all numbers w.
        """
        import numpy as np

        d, n = self.d, self.d * len(self.unknowns)
        fields = dict(zip(self.arguments, np.array(derivatives).reshape(-1, d, d), strict=True))
        stages: dict[Stage, Floats] = {s: np.eye(d, n, i * d) for i, s in enumerate(self.unknowns)}
        of_values = np.zeros((len(self.values), d, n))
        w = np.array(weights)
        for layer, entries in self._layers:
            if entries:
                stages.update(zip(layer, _combined(len(layer), entries, w, of_values), strict=True))  # type: ignore[arg-type]
            for x in layer:
                if isinstance(x, FieldEvaluation):
                    terms = (
                        fields[x, s] @ stages[s] for s in self._graph.arguments[x] if s in stages
                    )
                    of_values[self._place[x]] = sum(terms, np.zeros((d, n)))
        J = _combined(len(self.unknowns), self._image, w, of_values).reshape(n, n)
        return np.asarray(np.linalg.inv(np.eye(n) - J), dtype=np.float64)


def _combined(
    count: int, entries: Sequence[tuple[int, int, int]], w: Floats, of_values: Floats
) -> Floats:
    """The derivatives of ``count`` sums of w f, shape (count, d, n)."""
    import numpy as np

    W = np.zeros((count, len(of_values)))
    rows, columns, numbers = np.array(entries).T
    W[rows, columns] = w[numbers]
    return np.asarray(np.tensordot(W, of_values, axes=1), dtype=np.float64)
