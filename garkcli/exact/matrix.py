"""Matrices of exact numbers, as tuples of rows.

Rational matrices go through python-flint; matrices over a number field entry by entry.
``LinearMap`` is the way for one matrix and many vectors. Determinants of I − z W are polynomials.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mat

from garkcli.exact.field import ONE, ZERO, Algebraic, Number, sum_of_products
from garkcli.exact.polynomial import Polynomial
from garkcli.graph import components

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
    return tuple(tuple(ONE if i == j else ZERO for j in range(size)) for i in range(size))


def transpose(a: Matrix) -> Matrix:
    """Rows and columns exchanged; ``a`` has at least one row."""
    return tuple(zip(*a, strict=True))


def add(a: Matrix, b: Matrix) -> Matrix:
    """The sum a + b."""
    return tuple(tuple(x + y for x, y in zip(u, v, strict=True)) for u, v in zip(a, b, strict=True))


def subtract(a: Matrix, b: Matrix) -> Matrix:
    """The difference a − b."""
    return tuple(tuple(x - y for x, y in zip(u, v, strict=True)) for u, v in zip(a, b, strict=True))


def scale(factor: Number, a: Matrix) -> Matrix:
    """The multiple factor · a."""
    return tuple(tuple(factor * x for x in row) for row in a)


def outer(u: Vector, v: Vector) -> Matrix:
    """The product u vᵀ, shape (len(u), len(v))."""
    return tuple(tuple(x * y for y in v) for x in u)


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
    return tuple(dot(u, column) for column in zip(*a, strict=True))


def multiply(a: Matrix, b: Matrix) -> Matrix:
    """The product A B."""
    if is_rational(a) and is_rational(b):
        left = to_flint(a, len(b))
        right = to_flint(b, len(b[0]))
        return from_flint(left * right)
    columns = transpose(b)
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


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
    return _eliminated([[*row, *right_side] for row, right_side in zip(a, b, strict=True)])


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
            rows[i] = [x - factor * y if y else x for x, y in zip(row, pivot_row, strict=True)]
    return tuple(tuple(row[n:]) for row in rows)


def reciprocal_characteristic(W: Matrix) -> Polynomial:
    """det(I − z W), the characteristic polynomial of W read backwards.

    The strongly connected components of the graph of W are taken one by one: an explicit method
    has none but single vertices, and a diagonally implicit one the entries of its diagonal.

    Args:
        W: square, exact.

    >>> half = fmpq(1, 2)
    >>> reciprocal_characteristic(((half, half), (half, half)))
    Polynomial([1, -1])
    """
    neighbours: dict[int, list[int]] = {}
    for i, row in enumerate(W):
        neighbours[i] = [j for j, w in enumerate(row) if w]
    result = Polynomial([1])
    for component in components(neighbours):
        result = result * _dense(tuple(tuple(W[i][j] for j in component) for i in component))
    return result


def _dense(W: Matrix) -> Polynomial:
    """The same of one component."""
    size = len(W)
    if size == 1:
        [[entry]] = W
        return Polynomial([ONE, -entry])
    if is_rational(W):
        return Polynomial.from_flint(to_flint(W, size).charpoly()).reversed(size)
    return Polynomial(_from_traces(_traces(W)))


def _traces(W: Matrix) -> list[Number]:
    """The traces of W, W², …, W^n."""
    power = W
    traces = []
    for _ in W:
        trace: Number = ZERO
        for i, row in enumerate(power):
            trace = trace + row[i]
        traces.append(trace)
        power = multiply(power, W)
    return traces


def _from_traces(traces: Sequence[Number]) -> list[Number]:
    """The coefficients e_k of det(I − z W) by Newton's identities, k e_k = −Σ_j t_j e_{k−j}."""
    coefficients: list[Number] = [ONE]
    for k in range(1, len(traces) + 1):
        total: Number = ZERO
        for j in range(1, k + 1):
            total = total + traces[j - 1] * coefficients[k - j]
        coefficients.append(total * fmpq(-1, k))
    return coefficients
