"""The value of the stability function at infinity."""

from typing import Any

from flint import fmpq

from garkcli.design.wants.want import ZERO, Asked, Meaning, Want
from garkcli.errors import MethodError
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.parametric import fraction


def _meaning(asked: Asked) -> Meaning:
    """R(z) = det(I − z(A − 𝟙bᵀ)) / det(I − zA); the denominator keeps the degree that it has for
    almost all methods of the family.
    """
    zeros: list[Any] = []
    nonzero = []
    for l in asked.colours:
        A, b = asked.diagonal(l, "R-infinity")
        below = characteristic_coefficients(A)
        above = characteristic_coefficients(_minus_rows(A, b))
        degree = max(k for k, x in enumerate(below) if x)
        if not degree:
            raise MethodError(
                "design: R-infinity: R(z) is a polynomial for every value",
                "leave it out: explicit methods have no value at infinity",
            )
        value: Any = asked.value
        zeros.append(above[degree] - value * below[degree])
        zeros += above[degree + 1 :]
        numerator, _ = fraction(below[degree], asked.ring)
        if not numerator.is_constant():
            nonzero.append(numerator)
    return Meaning(tuple(zeros), tuple(nonzero))


def _minus_rows(A: Matrix, b: Vector) -> Matrix:
    return tuple(tuple(x - y for x, y in zip(row, b, strict=True)) for row in A)


def characteristic_coefficients(A: Matrix) -> list[Any]:
    """Those of det(I − zA) = Σ c_k z^k, by Faddeev's and Le Verrier's recursion."""
    s = len(A)
    stages = range(s)
    coefficients: list[Any] = [fmpq(1)]
    M: list[list[Any]] = [[ZERO] * s for _ in stages]
    for k in range(1, s + 1):
        for i in stages:
            M[i][i] = M[i][i] + coefficients[-1]
        M = [[_dot(A[i], [M[n][j] for n in stages]) for j in stages] for i in stages]
        trace = sum((M[i][i] for i in stages), start=ZERO)
        coefficients.append(-trace / fmpq(k))
    return coefficients


def _dot(row: Vector, column: list[Any]) -> Any:
    total: Any = ZERO
    for a, x in zip(row, column, strict=True):
        if a and x:
            total = total + a * x
    return total


WANT = Want("R-infinity", "number", "the stability function at infinity", _meaning)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, sections IV.3 and IV.6."""
