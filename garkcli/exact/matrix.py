"""Matrices of exact numbers, as tuples of rows.

Rational matrices go through python-flint; matrices over a number field entry by entry.
``LinearMap`` is the way for one matrix and many vectors.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mat

from garkcli.exact.field import ONE, ZERO, Algebraic, Number, sum_of_products

Vector: TypeAlias = tuple[Number, ...]
Matrix: TypeAlias = tuple[Vector, ...]


class SingularMatrixError(ArithmeticError):
    """A linear system without a unique solution."""


def is_rational(rows: Iterable[Iterable[Number]]) -> bool:
    """Whether all entries are rational numbers."""
    return all(isinstance(x, fmpq) for row in rows for x in row)


def from_flint(matrix: fmpq_mat) -> Matrix:
    """The same matrix as tuples."""
    return tuple(tuple(row) for row in matrix.tolist())


def to_flint(rows: Sequence[Sequence[Number]], columns: int) -> fmpq_mat:
    """A rational matrix for python-flint; ``columns`` tells the width when there are no rows."""
    entries: list[Number] = []
    for row in rows:
        entries += row
    return fmpq_mat(len(rows), columns, cast("list[fmpq]", entries))


def identity(size: int) -> Matrix:
    """The unit matrix."""
    rows = []
    for i in range(size):
        row = [ZERO] * size
        row[i] = ONE
        rows.append(tuple(row))
    return tuple(rows)


def transpose(a: Matrix) -> Matrix:
    """Rows and columns exchanged; ``a`` has at least one row."""
    return tuple(zip(*a, strict=True))


def add(a: Matrix, b: Matrix) -> Matrix:
    """The sum a + b."""
    total = []
    for row, other in zip(a, b, strict=True):
        pairs = zip(row, other, strict=True)
        entries = [x + y for x, y in pairs]
        total.append(tuple(entries))
    return tuple(total)


def subtract(a: Matrix, b: Matrix) -> Matrix:
    """The difference a − b."""
    difference = []
    for row, other in zip(a, b, strict=True):
        pairs = zip(row, other, strict=True)
        entries = [x - y for x, y in pairs]
        difference.append(tuple(entries))
    return tuple(difference)


def scale(factor: Number, a: Matrix) -> Matrix:
    """The multiple factor · a."""
    multiple = []
    for row in a:
        entries = [factor * x for x in row]
        multiple.append(tuple(entries))
    return tuple(multiple)


def outer(u: Vector, v: Vector) -> Matrix:
    """The product u vᵀ, shape (len(u), len(v))."""
    product = []
    for x in u:
        entries = [x * y for y in v]
        product.append(tuple(entries))
    return tuple(product)


def dot(u: Sequence[Number], v: Sequence[Number]) -> Number:
    """Σ u_i v_i."""
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
    """The vector A v."""
    return tuple(dot(row, v) for row in a)


def apply_left(u: Sequence[Number], a: Matrix) -> Vector:
    """uᵀ A."""
    columns = zip(*a, strict=True)
    return tuple(dot(u, column) for column in columns)


def multiply(a: Matrix, b: Matrix) -> Matrix:
    """The product A B."""
    if is_rational(a) and is_rational(b):
        left = to_flint(a, len(b))
        right = to_flint(b, len(b[0]))
        return from_flint(left * right)
    columns = transpose(b)
    product = []
    for row in a:
        entries = [dot(row, column) for column in columns]
        product.append(tuple(entries))
    return tuple(product)


def solve(a: Matrix, b: Matrix) -> Matrix:
    """The solution A⁻¹ B of a linear system.

    Raises:
        SingularMatrixError: A is singular.

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
    pairs = zip(a, b, strict=True)
    return _eliminated([[*row, *right_side] for row, right_side in pairs])


def _eliminated(rows: list[list[Number]]) -> Matrix:
    """A⁻¹ B from the rows of (A B), by Gauss and Jordan's elimination."""
    n = len(rows)
    for k in range(n):
        candidates = (i for i in range(k, n) if rows[i][k])
        chosen = next(candidates, None)
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
            pairs = zip(row, pivot_row, strict=True)
            rows[i] = [x - factor * y if y else x for x, y in pairs]
    solutions = [tuple(row[n:]) for row in rows]
    return tuple(solutions)
