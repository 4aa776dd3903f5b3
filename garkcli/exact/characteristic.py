"""Determinants of I − z W as polynomials in z, over ℚ or a number field."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, is_rational, multiply, to_flint
from garkcli.exact.polynomial import Polynomial
from garkcli.graph import components


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
        rows = [W[i] for i in component]
        block = [tuple(row[j] for j in component) for row in rows]
        result = result * _dense(tuple(block))
    return result


def _dense(W: Matrix) -> Polynomial:
    """The same of one component."""
    size = len(W)
    if size == 1:
        [[entry]] = W
        return Polynomial([ONE, -entry])
    if is_rational(W):
        characteristic = to_flint(W, size).charpoly()
        from_lowest = Polynomial.from_flint(characteristic)
        return from_lowest.reversed(size)
    coefficients = _from_traces(_traces(W))
    return Polynomial(coefficients)


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
            trace = traces[j - 1]
            total = total + trace * coefficients[k - j]
        coefficients.append(total * fmpq(-1, k))
    return coefficients
