"""Affine spans over ℚ, grown by exact elimination.

A point joins the span when it is not an affine combination of the members: when the vector (1,
point) is linearly independent of those before. Elimination is done for many candidates at once in
python-flint.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mat

from garkcli.deadline import check_time
from garkcli.exact.echelon import leading_columns, pivot_columns
from garkcli.exact.field import ONE


class AffineSpan:
    """The affine hull of the points inserted so far, in ℚⁿ with n = ``dimension``.

    >>> span = AffineSpan(2)
    >>> span.insert([[fmpq(0), fmpq(0)], [fmpq(1), fmpq(1)], [fmpq(2), fmpq(2)]])
    [0, 1]
    >>> span.is_full
    False
    """

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self._echelon = fmpq_mat(0, dimension + 1)
        self._pivots: list[int] = []

    def __len__(self) -> int:
        """The number of members: one more than the affine dimension."""
        return len(self._pivots)

    @property
    def is_full(self) -> bool:
        """Whether every point of ℚⁿ is in the span."""
        return len(self) == self.dimension + 1

    def insert(self, points: Sequence[Sequence[fmpq]]) -> list[int]:
        """Insert ``points`` from left to right; the indices of those that enlarged the span."""
        check_time()
        if not points or self.is_full:
            return []
        candidates = fmpq_mat([[ONE, *point] for point in points])
        remainders = self._reduce(candidates).tolist()
        outside = [i for i, row in enumerate(remainders) if any(row)]
        if not outside:
            return []
        directions = fmpq_mat([remainders[i] for i in outside])
        independent = pivot_columns(directions.transpose())
        chosen = [outside[i] for i in independent]
        added = [remainders[i] for i in chosen]
        grown = fmpq_mat([*self._echelon.tolist(), *added])
        self._echelon, _ = grown.rref()
        self._pivots = leading_columns(self._echelon)
        return chosen

    def _reduce(self, candidates: fmpq_mat) -> fmpq_mat:
        """Candidates minus their part along the echelon rows: zero exactly for points of the
        span.
        """
        if not self._pivots:
            return candidates
        rows = candidates.tolist()
        at_pivots = [[row[p] for p in self._pivots] for row in rows]
        along = fmpq_mat(at_pivots)
        return candidates - along * self._echelon
