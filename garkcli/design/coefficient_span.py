"""Linear spans over ℚ of vectors of polynomials."""

from __future__ import annotations

from bisect import insort
from collections.abc import Sequence
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.exact.field import ZERO

Polynomials: TypeAlias = tuple[fmpq_mpoly, ...]
_Place: TypeAlias = tuple[int, tuple[int, ...]]
"""A coordinate and the exponents of a monomial."""
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
        """Insert a vector; whether it enlarged the span."""
        row = self._reduced(_coefficients(vector))
        if not row:
            return False
        pivot = max(row)
        leading = row[pivot]
        self._rows[pivot] = {place: a / leading for place, a in row.items()}
        return True

    def _reduced(self, row: _Row) -> _Row:
        """The row minus its part along those before; its largest place is no pivot of theirs."""
        settled: _Row = {}
        places = sorted(row)
        while places:
            place = places.pop()
            factor = row.pop(place)
            known = self._rows.get(place)
            if known is None:
                if factor:
                    settled[place] = factor
                continue
            for other, a in known.items():
                if other == place or not factor:
                    continue
                if other not in row:
                    insort(places, other)
                row[other] = row.get(other, ZERO) - factor * a
        return settled


def _coefficients(vector: Sequence[fmpq_mpoly]) -> _Row:
    row: _Row = {}
    for coordinate, polynomial in enumerate(vector):
        for exponents, a in polynomial.to_dict().items():
            row[coordinate, exponents] = a
    return row
