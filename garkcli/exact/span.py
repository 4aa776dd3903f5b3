"""Spans over ℚ, grown by exact elimination, and pivot columns of matrices.

With vectors (1, point), a point joins a span if it is no affine combination of those before.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mat

from garkcli.deadline import check_time


def pivot_columns(matrix: fmpq_mat) -> list[int]:
    reduced, _ = matrix.rref()
    return leading_columns(reduced)


def leading_columns(reduced: fmpq_mat) -> list[int]:
    columns = []
    for row in reduced.tolist():
        first = next((j for j, x in enumerate(row) if x), None)
        if first is not None:
            columns.append(first)
    return columns


class Span:
    """The span of the vectors inserted so far, in ℚⁿ with n = ``dimension``.

    >>> span = Span(3)
    >>> one = fmpq(1)
    >>> span.insert([[one, 0 * one, one], [one, one, one], [one, 2 * one, one]])
    [0, 1]
    >>> span.is_full
    False
    """

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self._echelon = fmpq_mat(0, dimension)
        self._pivots: list[int] = []

    def __len__(self) -> int:
        return len(self._pivots)

    @property
    def is_full(self) -> bool:
        return len(self) == self.dimension

    def insert(self, vectors: Sequence[Sequence[fmpq]]) -> list[int]:
        """The indices of vectors, from left to right, with which the span grows."""
        check_time()
        if not vectors or self.is_full:
            return []
        candidates = fmpq_mat(vectors)
        remainders = self._reduce(candidates).tolist()
        outside = [i for i, row in enumerate(remainders) if any(row)]
        if not outside:
            return []
        directions = fmpq_mat([remainders[i] for i in outside])
        chosen = [outside[i] for i in pivot_columns(directions.transpose())]
        added = [remainders[i] for i in chosen]
        self._echelon, _ = fmpq_mat([*self._echelon.tolist(), *added]).rref()
        self._pivots = leading_columns(self._echelon)
        return chosen

    def _reduce(self, candidates: fmpq_mat) -> fmpq_mat:
        if not self._pivots:
            return candidates
        at_pivots = [[row[p] for p in self._pivots] for row in candidates.tolist()]
        return candidates - fmpq_mat(at_pivots) * self._echelon
