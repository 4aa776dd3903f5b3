"""Matrices of exact numbers, as tuples of rows.

Rational matrices go through python-flint; matrices over a number field entry by entry.
For one matrix and many vectors use ``LinearMap``. Determinants of I − z W are polynomials.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import lcm
from typing import Any, TypeAlias, cast

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz

from garkcli.deadline import check_time
from garkcli.exact.field import ONE, ZERO, Algebraic, Number, NumberField, sum_of_products

Vector: TypeAlias = tuple[Number, ...]
Matrix: TypeAlias = tuple[Vector, ...]


class SingularMatrixError(ArithmeticError):
    """A linear system has no unique solution."""


def is_rational(rows: Iterable[Iterable[Number]]) -> bool:
    return all(isinstance(x, fmpq) for row in rows for x in row)


def from_flint(matrix: fmpq_mat) -> Matrix:
    return tuple(tuple(row) for row in matrix.tolist())


def to_flint(rows: Sequence[Sequence[Number]], columns: int) -> fmpq_mat:
    entries: list[Number] = []
    for row in rows:
        entries += row
    return fmpq_mat(len(rows), columns, cast("list[fmpq]", entries))


def identity(size: int) -> Matrix:
    return tuple(tuple(ONE if i == j else ZERO for j in range(size)) for i in range(size))


def transpose(a: Matrix) -> Matrix:
    return tuple(zip(*a, strict=True))


def add(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(x + y for x, y in zip(u, v, strict=True)) for u, v in zip(a, b, strict=True))


def subtract(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(x - y for x, y in zip(u, v, strict=True)) for u, v in zip(a, b, strict=True))


def scale(factor: Number, a: Matrix) -> Matrix:
    return tuple(tuple(factor * x for x in row) for row in a)


def outer(u: Vector, v: Vector) -> Matrix:
    return tuple(tuple(x * y for y in v) for x in u)


def dot(u: Sequence[Number], v: Sequence[Number]) -> Number:
    total = ZERO
    irrational = []
    for x, y in zip(u, v, strict=True):
        if x and y:
            if isinstance(x, Algebraic) or isinstance(y, Algebraic):
                irrational.append((x, y))
            else:
                total = total + x * y
    if irrational:
        return total + sum_of_products(irrational)
    return total


def apply(a: Matrix, v: Sequence[Number]) -> Vector:
    return tuple(dot(row, v) for row in a)


def apply_left(u: Sequence[Number], a: Matrix) -> Vector:
    return tuple(dot(u, column) for column in zip(*a, strict=True))


def multiply(a: Matrix, b: Matrix) -> Matrix:
    if is_rational(a) and is_rational(b):
        return from_flint(to_flint(a, len(b)) * to_flint(b, len(b[0])))
    columns = transpose(b)
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def solve(a: Matrix, b: Matrix) -> Matrix:
    """A⁻¹ B; raises SingularMatrixError.

    >>> solve(((fmpq(2), fmpq(0)), (fmpq(0), fmpq(4))), ((fmpq(1),), (fmpq(1),)))
    ((1/2,), (1/4,))
    """
    if is_rational(a) and is_rational(b):
        left = to_flint(a, len(a))
        right = to_flint(b, len(b[0]))
        try:
            return from_flint(left.solve(right))
        except ZeroDivisionError:
            raise SingularMatrixError from None
    return _eliminated([[*row, *right_side] for row, right_side in zip(a, b, strict=True)])


def is_singular(a: Matrix) -> bool:
    try:
        solve(a, tuple((ZERO,) for _ in a))
    except SingularMatrixError:
        return True
    return False


def _eliminated(rows: list[list[Number]]) -> Matrix:
    # A⁻¹ B from the rows of (A B), by Gauss-Jordan elimination
    n = len(rows)
    for k in range(n):
        chosen = next((i for i in range(k, n) if rows[i][k]), None)
        if chosen is None:
            raise SingularMatrixError
        row = rows[chosen]
        rows[chosen] = rows[k]
        inverse = ONE / row[k]
        pivot_row = [x * inverse if x else x for x in row]
        rows[k] = pivot_row
        for i, row in enumerate(rows):
            factor = row[k]
            if i == k or not factor:
                continue
            rows[i] = [x - factor * y if y else x for x, y in zip(row, pivot_row, strict=True)]
    return tuple(tuple(row[n:]) for row in rows)


def characteristic_coefficients(A: Matrix) -> list[Any]:
    """The c_k of det(I − zA) = Σ c_k z^k, by the Faddeev-LeVerrier recursion."""
    stages = range(len(A))
    coefficients: list[Any] = [ONE]
    M: list[list[Any]] = [[ZERO for _ in stages] for _ in stages]
    for k in stages:
        for i in stages:
            M[i][i] = M[i][i] + coefficients[-1]
        columns = list(zip(*M, strict=True))
        M = [[dot(row, column) for column in columns] for row in A]
        trace = sum((M[i][i] for i in stages), start=ZERO)
        coefficients.append(-trace / fmpq(k + 1))
    return coefficients


_Parts: TypeAlias = list[tuple[int, fmpq_mat]]
_Rational: TypeAlias = Sequence[fmpq]
MIN_BITS_APART = 20_000
"""Rows with fewer bits in all denominators are never summed as fractions."""


class LinearMap:
    """The maps v ↦ A v and w ↦ wᵀ A of a matrix that is not empty, prepared for many vectors.

    Over K = ℚ(θ) of degree d the matrix is Σ θᵏ A_k with rational A_k, vectors are Σ θʲ v_j, and
    A v = Σ_{j,k} θ^(j+k) A_k v_j: at most d² products over ℚ, and one reduction of each entry.

    python-flint puts every row of a product over one denominator, which is very long if those of
    the row share few factors: such a row is summed as fractions instead.

    >>> LinearMap(((fmpq(1), fmpq(2)), (fmpq(0), fmpq(1, 3))), None).images([(fmpq(1), fmpq(6))])
    [(13, 2)]
    """

    def __init__(self, rows: Matrix, field: NumberField | None) -> None:
        self.field = field
        self._parts = _parts(rows, field)
        self._transposed = [(k, part.transpose()) for k, part in self._parts]
        self._rows_apart: Sequence[_Rational] | None = None
        if field is None:
            rational = cast("Sequence[_Rational]", rows)
            self._rows_apart = rational if any(map(_has_denominators_apart, rational)) else None

    def images(self, vectors: Sequence[Vector]) -> list[Vector]:
        if self._rows_apart is not None:
            return [_image(self._rows_apart, v) for v in cast("Sequence[_Rational]", vectors)]
        return _products(vectors, self._transposed, self.field)

    def pullbacks(self, functionals: Sequence[Vector]) -> list[Vector]:
        return _products(functionals, self._parts, self.field)


class EntrywiseMap:
    """The map v ↦ A v for entries that are rational functions of parameters."""

    def __init__(self, rows: Matrix) -> None:
        self._rows = rows

    def images(self, vectors: Sequence[Vector]) -> list[Vector]:
        images = []
        for v in vectors:
            check_time()
            images.append(apply(self._rows, v))
        return images

    def pullbacks(self, functionals: Sequence[Vector]) -> list[Vector]:
        return [apply_left(w, self._rows) for w in functionals]


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
    """The sum, added in pairs and reduced once: fast multiplication needs equal lengths."""
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
    [(numerator, denominator)] = fractions
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
    constant = powers[0]
    zeros = fmpq_mat(constant.nrows(), constant.ncols())
    by_power = [powers.get(n, zeros).tolist() for n in range(max(powers) + 1)]
    reduced = []
    for rows in zip(*by_power, strict=True):
        row = [field.element(fmpq_poly(list(entry))) for entry in zip(*rows, strict=True)]
        reduced.append(tuple(row))
    return reduced


def _parts(rows: Sequence[Vector], field: NumberField | None) -> _Parts:
    """The nonzero rational matrices A_k of Σ θᵏ A_k, and A_0 always."""
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
