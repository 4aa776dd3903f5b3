"""Proofs that a solution exists, by Krawczyk's test in ball arithmetic.

For a square system F, a point m, a matrix Y near F'(m)⁻¹ and a box X around m:

    K(X) = m − Y F(m) + (I − Y F'(X)) (X − m).

If K(X) lies in the interior of X, F has exactly one zero in X (R. Krawczyk, 1969; R. Moore, 1977).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb, arb_mat, ctx

from garkcli.deadline import check_time
from garkcli.design.search.rational import as_ball

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.design.search.points import Fixings
    from garkcli.design.search.rational import Array, RationalFunction


def is_proved(
    system: Fixings, point: Array, bits: int, nonzero: Sequence[RationalFunction] = ()
) -> bool:
    """Whether there is a solution of all equations within 2^(−bits/2) of a point.

    Args:
        system: as many equations as unknowns, else the answer is no: a solution of some of the
            equations proves nothing of the others.
        point: a column of balls without radius.
        bits: of the arithmetic.
        nonzero: functions that are not to be zero at the solution.
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
        if any(_may_vanish(function, box) for function in nonzero):
            return False
        _, slopes = system.at(box)
        try:
            inverse = _midpoints(_matrix(jacobians)).inv()
        except ZeroDivisionError:
            return False
        inverse = _midpoints(inverse)
        unit = arb_mat([[int(i == j) for j in range(unknowns)] for i in range(unknowns)])
        values = arb_mat([[value] for value in residuals[:, 0]])
        contraction = unit - inverse * _matrix(slopes)
        image = contraction * offsets - inverse * values  # K(X) − m
        return all(bool(abs(entry) < radius) for entry in image.entries())


def _may_vanish(function: RationalFunction, box: Array) -> bool:
    value: Any = function.at(box, as_ball).value
    return any(x.contains(0) for x in value)


def _matrix(jacobians: Array) -> Any:
    return arb_mat([list(row) for row in jacobians[:, :, 0]])


def _midpoints(matrix: Any) -> Any:
    return arb_mat([[x.mid() for x in row] for row in matrix.tolist()])
