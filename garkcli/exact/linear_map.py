"""A matrix made ready to act on many vectors at once.

Over ℚ that is one product of two matrices in python-flint. Over K = ℚ(θ) of degree d the matrix is
Σ θᵏ A_k with rational A_k, vectors are Σ θʲ v_j, and

    A v = Σ_{j,k} θ^(j+k) A_k v_j:

at most d² products over ℚ, and one reduction for each entry of the result.

A product in python-flint puts every row over one denominator. Where the denominators of a row have
next to nothing in common, as in interpolation through unrelated fractions, that denominator is as
long as many entries together, and the row is summed as fractions instead.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import lcm
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz

from garkcli.deadline import check_time
from garkcli.exact.field import ZERO, Algebraic, NumberField
from garkcli.exact.matrix import Matrix, Vector, apply, apply_left, to_flint

_Parts: TypeAlias = list[tuple[int, fmpq_mat]]
"""Pairs (k, A_k)."""
_Rational: TypeAlias = Sequence[fmpq]
MIN_BITS_APART = 20_000
"""Bits of all denominators of a row from which on it is looked at how much they share."""


class LinearMap:
    """The map v ↦ A v, and that of functionals, w ↦ wᵀ A.

    Args:
        rows: the matrix A; it has a row and a column at least.
        field: the field of its entries and of the vectors; None where all of them are rational.

    >>> LinearMap(((fmpq(1), fmpq(2)), (fmpq(0), fmpq(1, 3))), None).images([(fmpq(1), fmpq(6))])
    [(13, 2)]
    """

    def __init__(self, rows: Matrix, field: NumberField | None) -> None:
        self.field = field
        self._parts = _parts(rows, field)
        self._transposed = [(k, part.transpose()) for k, part in self._parts]
        self._rows_apart: Sequence[_Rational] | None = None
        if field is None:
            self._rows_apart = _rational_rows_apart(rows)

    def images(self, vectors: Sequence[Vector]) -> list[Vector]:
        """A v for each of the vectors."""
        if self._rows_apart is not None:
            return [_image(self._rows_apart, v) for v in cast("Sequence[_Rational]", vectors)]
        return _products(vectors, self._transposed, self.field)

    def pullbacks(self, functionals: Sequence[Vector]) -> list[Vector]:
        """wᵀ A for each of the functionals."""
        return _products(functionals, self._parts, self.field)


class EntrywiseMap:
    """The same for entries that are rational functions of parameters.

    Args:
        rows: the matrix A.
    """

    def __init__(self, rows: Matrix) -> None:
        self._rows = rows

    def images(self, vectors: Sequence[Vector]) -> list[Vector]:
        """A v for each of the vectors."""
        images = []
        for v in vectors:
            check_time()
            images.append(apply(self._rows, v))
        return images

    def pullbacks(self, functionals: Sequence[Vector]) -> list[Vector]:
        """wᵀ A for each of the functionals."""
        return [apply_left(w, self._rows) for w in functionals]


def _rational_rows_apart(rows: Matrix) -> Sequence[_Rational] | None:
    """The rows, where one of them is better summed as fractions; else None."""
    rational = cast("Sequence[_Rational]", rows)
    return rational if any(map(_has_denominators_apart, rational)) else None


def _has_denominators_apart(row: _Rational) -> bool:
    denominators = [int(x.q) for x in row]
    bits = sum(q.bit_length() for q in denominators)
    if bits < MIN_BITS_APART:
        return False
    # Over one denominator the row is len(row) numbers of its length, as fractions it is as long as
    # all denominators together; summing these is Python's work, the other python-flint's.
    return len(row) * lcm(*denominators).bit_length() > 4 * bits


def _image(rows: Sequence[_Rational], vector: _Rational) -> Vector:
    return tuple(_sum([a * x for a, x in zip(row, vector, strict=True)]) for row in rows)


def _sum(terms: _Rational) -> fmpq:
    """Terms added in pairs, and pairs in pairs, as fractions that are reduced once, at the end.

    Sums of neighbours are of equal length, which is what fast multiplication needs; a reduction of
    each would take most of the time.
    """
    fractions = [(term.p, term.q) for term in terms]
    while len(fractions) > 1:
        if len(fractions) % 2:
            fractions.append((fmpz(0), fmpz(1)))
        left = fractions[::2]
        right = fractions[1::2]
        fractions = []
        for (p, q), (r, s) in zip(left, right, strict=True):
            numerator = p * s + r * q
            fractions.append((numerator, q * s))
    numerator, denominator = fractions[0]
    return fmpq(numerator, denominator)


def _products(rows: Sequence[Vector], parts: _Parts, field: NumberField | None) -> list[Vector]:
    if not rows:
        return []
    powers: dict[int, fmpq_mat] = {}
    for j, left in _parts(rows, field):
        check_time()
        for k, right in parts:
            product = left * right
            power = j + k
            if power in powers:
                powers[power] += product
            else:
                powers[power] = product
    if field is None or len(powers) == 1:  # θ⁰ is always among them
        return [tuple(row) for row in powers[0].tolist()]
    return _reduced(powers, field)


def _reduced(powers: Mapping[int, fmpq_mat], field: NumberField) -> list[Vector]:
    """The rows of Σ θⁿ P_n, entry by entry; ``powers`` has P_0, and others that are not zero."""
    constant = powers[0]
    zeros = fmpq_mat(constant.nrows(), constant.ncols())
    by_power = [powers.get(n, zeros).tolist() for n in range(max(powers) + 1)]
    found = []
    for rows in zip(*by_power, strict=True):
        row = []
        for entry in zip(*rows, strict=True):
            poly = fmpq_poly(list(entry))
            row.append(field.element(poly))
        found.append(tuple(row))
    return found


def _parts(rows: Sequence[Vector], field: NumberField | None) -> _Parts:
    """The rational matrices of Σ θᵏ A_k, those that are zero left out, but for A_0."""
    height = len(rows)
    width = len(rows[0])
    if field is None:
        return [(0, to_flint(rows, width))]
    entries: list[fmpq | fmpq_poly] = []
    for row in rows:
        entries += [x.poly if isinstance(x, Algebraic) else x for x in row]
    constants = [x[0] if isinstance(x, fmpq_poly) else x for x in entries]
    parts = [(0, fmpq_mat(height, width, constants))]
    for k in range(1, field.degree):
        coordinates = [x[k] if isinstance(x, fmpq_poly) else ZERO for x in entries]
        if any(coordinates):
            parts.append((k, fmpq_mat(height, width, coordinates)))
    return parts
