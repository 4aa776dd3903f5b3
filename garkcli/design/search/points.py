"""Points that solve a system: their freedom, Newton's method to any number of digits, and proofs.

Krawczyk's test in ball arithmetic proves that a solution exists. For a square system F, a point m,
a matrix Y near F'(m)⁻¹ and a box X around m:

    K(X) = m − Y F(m) + (I − Y F'(X)) (X − m).

If K(X) lies in the interior of X, F has exactly one zero in X (R. Krawczyk, 1969; R. Moore, 1977).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb, arb_mat, ctx, fmpq

from garkcli.deadline import check_time
from garkcli.design.search.rational import RationalFunction, as_ball, as_float, over_box
from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.design.search.rational import Array, System
    from garkcli.design.search.residuals import Residuals


RANK = 1e-7
"""Smaller pivots, relative to the largest, count as rounding."""
FIRST_BITS = 106


class Fixed(Frozen):
    """A function of the unknowns, such as a node, with a short rational value."""

    function: RationalFunction
    value: fmpq


class Fixings:
    """Equations, with given values for some functions, and for one more by points (``trials``)."""

    def __init__(
        self,
        conditions: Residuals | System,
        fixed: Sequence[Fixed] = (),
        function: RationalFunction | None = None,
        trials: Sequence[fmpq] = (),
    ) -> None:
        self.conditions = conditions
        self.fixed = tuple(fixed)
        self.function = function
        self.trials = tuple(trials)

    def at(self, points: Array) -> tuple[Array, Array]:
        """Values and derivatives of the conditions, then of the functions minus their values."""
        import numpy as np

        values, gradients = self.conditions.at(points)
        rows = [(one.function, [one.value]) for one in self.fixed]
        if self.function is not None:
            rows.append((self.function, list(self.trials)))
        if not rows:
            return values, gradients
        is_exact = points.dtype == object
        constant: Any = as_ball if is_exact else as_float
        more = np.full((len(rows), points.shape[1]), constant(fmpq(0)), points.dtype)
        slopes = np.full((len(rows), *gradients.shape[1:]), constant(fmpq(0)), points.dtype)
        for number, (function, wanted) in enumerate(rows):
            slope = function.at(points, constant)
            targets = np.array([constant(x) for x in wanted], points.dtype)
            more[number] = slope.value - targets
            for unknown, derivative in slope.derivatives:
                slopes[number, unknown] = derivative
        return np.concatenate([values, more]), np.concatenate([gradients, slopes])


class Rank(Frozen):
    """Rows and columns of a largest submatrix with a nonzero determinant."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.rows)


def rank(matrix: Array, grain: float = RANK) -> Rank:
    """The rank up to rounding, by elimination with the largest entry as pivot. Pivots below
    ``grain``, also relative to the largest entry, count as zero.
    """
    import numpy as np

    rest = matrix.copy()
    rows: list[int] = []
    columns: list[int] = []
    # conditions are scaled to entries about 1, so a matrix of small entries is nearly zero
    least = grain * max(1.0, float(np.max(np.abs(rest), initial=0.0)))
    for _ in range(min(rest.shape)):
        sizes = np.abs(rest)
        i, j = np.unravel_index(int(np.argmax(sizes)), rest.shape)
        if not sizes[i, j] > least:
            break
        rows.append(int(i))
        columns.append(int(j))
        factors = rest[:, j] / rest[i, j]
        rest = rest - factors[:, None] * rest[i][None, :]
        rest[i] = 0.0
        rest[:, j] = 0.0
    return Rank(tuple(rows), tuple(columns))


def balls(point: Sequence[Any]) -> Array:
    import numpy as np

    made = np.empty((len(point), 1), object)
    made[:, 0] = [arb(x) for x in point]
    return made


def polished(system: Fixings, point: Sequence[float], bits: int) -> Array | None:
    """A solution near a point to many bits, a column of balls without radius. Newton's method on as
    many equations and unknowns as the rank; the other unknowns stay. None if the other equations
    fail at the end: then no solution is near, or a degenerate one.
    """
    import numpy as np

    x = balls(point)
    _, jacobian = system.at(np.array(point)[:, None])
    chosen = rank(jacobian[:, :, 0])
    working = FIRST_BITS
    while True:
        check_time()
        with ctx.workprec(working):
            if not _newton(system, x, chosen):
                return None
            if working >= bits:
                break
        working = min(2 * working, bits)
    with ctx.workprec(bits):
        for _ in range(2):
            if largest_residual(system, x) < _small(bits):
                return x
            if not _newton(system, x, chosen):
                return None
        return x if largest_residual(system, x) < _small(bits) else None


def small_bits(bits: int) -> int:
    """The e in the bound 2^−e on residuals after a polish to so many bits."""
    return 4 * bits // 5


def _small(bits: int) -> arb:
    return arb(1) / arb(2) ** small_bits(bits)


def _newton(system: Fixings, x: Array, chosen: Rank) -> bool:
    """Makes one step in place; False if the matrix is singular or an unknown gets large."""
    if not len(chosen):
        return True
    residuals, jacobians = system.at(x)
    matrix = arb_mat([[jacobians[i, j, 0].mid() for j in chosen.columns] for i in chosen.rows])
    right = arb_mat([[residuals[i, 0].mid()] for i in chosen.rows])
    try:
        change = matrix.solve(right)
    except ZeroDivisionError:
        return False
    for number, j in enumerate(chosen.columns):
        x[j, 0] = (x[j, 0] - change[number, 0]).mid()
    return all(bool(abs(value) < 1000) for value in x[:, 0])


def largest_residual(system: Fixings, x: Array) -> arb:
    residuals, _ = system.at(x)
    largest = arb(0)
    for value in residuals[:, 0]:
        upper = abs(value).upper()
        if not upper <= largest:  # also for NaN
            largest = upper
    return largest


def is_proved(
    system: Fixings, point: Array, bits: int, nonzero: Sequence[RationalFunction] = ()
) -> bool:
    """Whether all equations have a solution within 2^(−bits/2) of ``point``, balls without radius.
    False for other than square systems, since a solution of some equations proves nothing about the
    others, or if one of ``nonzero`` may vanish.
    """
    check_time()
    with ctx.workprec(bits):
        residuals, jacobians = system.at(point)
        equations, unknowns, _ = jacobians.shape
        if equations != unknowns:
            return False
        radius = arb(1) / arb(2) ** (bits // 2)
        offsets = arb_mat([[arb(0, radius)] for _ in range(unknowns)])
        box = point.copy()
        for j in range(unknowns):
            box[j, 0] = point[j, 0] + offsets[j, 0]
        if any(over_box(function, box).contains(0) for function in nonzero):
            return False
        _, slopes = system.at(box)
        try:
            inverse = _matrix(jacobians).mid().inv().mid()
        except ZeroDivisionError:
            return False
        unit = arb_mat([[int(i == j) for j in range(unknowns)] for i in range(unknowns)])
        values = arb_mat([[value] for value in residuals[:, 0]])
        contraction = unit - inverse * _matrix(slopes)
        image = contraction * offsets - inverse * values  # K(X) − m
        return all(bool(abs(entry) < radius) for entry in image.entries())


def _matrix(jacobians: Array) -> Any:
    return arb_mat([list(row) for row in jacobians[:, :, 0]])
