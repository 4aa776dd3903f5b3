"""Local coordinates of the solutions of equations near one of them.

Let the derivatives J have the rank r at x₀, and the columns of N and Y be orthonormal bases of the
kernel of J and of its complement. If r equations stay independent and the others follow from them,
each u near 0 has one solution x(u) = x₀ + N S u + Y s near x₀, with the derivatives (I − Y (J Y)⁻¹
J) N S.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

from garkcli import numpy_on_use as np

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array

    Gradient: TypeAlias = tuple[Array, Array]
    """Values, shape (m,), and derivatives by the unknowns, shape (m, unknowns)."""
    Equations: TypeAlias = Callable[[Array], Gradient]

STEPS = 12
CLOSE = 1e-12
RANK = 1e-7
"""Smaller singular values, also relative to the largest, count as zero."""


class OutsideError(Exception):
    """Newton's method finds no solution over a point."""


class Chart:
    """The solutions near one of them, x of shape (unknowns,)."""

    def __init__(self, equations: Equations, x: Array) -> None:
        _, J = equations(x)
        left, sizes, right = np.linalg.svd(J)
        rank = int(np.sum(sizes > RANK * max(1.0, float(np.max(sizes, initial=0.0)))))
        self._equations = equations
        self._independent = left[:, :rank].transpose()
        self._Y = right[:rank].transpose()
        self.tangent = right[rank:].transpose()
        self._last = np.zeros(self.dimension), x, self.tangent

    @property
    def dimension(self) -> int:
        return int(self.tangent.shape[1])

    def scale(self, matrix: Array) -> None:
        """Changes to the coordinates in which the matrix is S."""
        _, x, _ = self._last
        self.tangent = self.tangent @ matrix
        self._last = np.zeros(self.dimension), x, self.tangent

    def at(self, u: Array) -> Gradient:
        """The solution and its derivatives, of shape (unknowns, dimension), or OutsideError."""
        before, x, slopes = self._last
        x = x + slopes @ (u - before)
        for _ in range(STEPS):
            values, J = self._equations(x)
            largest = float(np.max(np.abs(values), initial=0.0))
            if not np.isfinite(largest):
                break
            JY = self._independent @ J @ self._Y
            right = np.column_stack(
                [self._independent @ values, self._independent @ J @ self.tangent]
            )
            try:
                change = self._Y @ np.linalg.solve(JY, right)
            except np.linalg.LinAlgError:
                break
            if largest < CLOSE:
                slopes = self.tangent - change[:, 1:]
                self._last = u.copy(), x, slopes
                return x, slopes
            x = x - change[:, 0]
        raise OutsideError
