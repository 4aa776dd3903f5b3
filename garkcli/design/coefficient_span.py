"""Linear spans over ℚ of vectors of polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heapify, heappop, heappush
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time

Polynomials: TypeAlias = tuple[fmpq_mpoly, ...]
_Place: TypeAlias = tuple[int, tuple[int, ...]]
"""A coordinate and the exponents of a monomial, negative: the largest comes first."""
_Row: TypeAlias = dict[_Place, fmpq]


class CoefficientSpan:
    """The ℚ-span of vectors of polynomials, each taken as the vector of all of its coefficients.

    A span over the field of rational functions would be smaller, and lose the values of the
    parameters for which it grows.
    """

    def __init__(self) -> None:
        self._rows: dict[_Place, _Row] = {}

    def __len__(self) -> int:
        return len(self._rows)

    def insert(self, vector: Polynomials) -> bool:
        """Insert a vector; whether it enlarged the span.

        Raises:
            NotDecided: the time is not enough.
        """
        row = self._reduced(_coefficients(vector))
        if not row:
            return False
        pivot = min(row)
        leading = row[pivot]
        self._rows[pivot] = {place: a / leading for place, a in row.items()}
        return True

    def _reduced(self, row: _Row) -> _Row:
        """The row minus its part along those before; its smallest place is no pivot of theirs."""
        settled: _Row = {}
        waiting = list(row)
        heapify(waiting)
        while waiting:
            check_time()
            place = heappop(waiting)
            factor = row.pop(place, None)
            if factor is None:  # it became zero
                continue
            known = self._rows.get(place)
            if known is None:
                if factor:
                    settled[place] = factor
                continue
            for other, a in known.items():
                if other == place:
                    continue
                if other not in row:
                    heappush(waiting, other)
                changed = row.get(other, fmpq(0)) - factor * a
                if changed:
                    row[other] = changed
                else:
                    row.pop(other, None)
        return settled


def _coefficients(vector: Sequence[fmpq_mpoly]) -> _Row:
    row: _Row = {}
    for coordinate, polynomial in enumerate(vector):
        if not polynomial:  # maybe the number 0
            continue
        for exponents, a in polynomial.to_dict().items():
            row[-coordinate, tuple(-int(e) for e in exponents)] = a
    return row
