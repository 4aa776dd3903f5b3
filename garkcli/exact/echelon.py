"""Row echelon forms of rational matrices: where their pivots are."""

from __future__ import annotations

from flint import fmpq_mat


def pivot_columns(matrix: fmpq_mat) -> list[int]:
    """The columns that are independent of those to their left."""
    reduced, _ = matrix.rref()
    return leading_columns(reduced)


def leading_columns(reduced: fmpq_mat) -> list[int]:
    """Where each row of a reduced echelon form that is not zero has its first entry."""
    columns = []
    for row in reduced.tolist():
        entries = (j for j, x in enumerate(row) if x)
        first = next(entries, None)
        if first is not None:
            columns.append(first)
    return columns
