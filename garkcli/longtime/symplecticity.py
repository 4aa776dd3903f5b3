"""Measures symplecticity: MᵀJM − J for the Jacobian M of one step, J = (0 I; −I 0), by central
differences with so many digits that truncation and rounding are far below the round-off of floats;
doubling the perturbation shows its error. On the oscillator RᵀJR − J = (det R − 1) J exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.doing import doing
from garkcli.frozen import Frozen
from garkcli.longtime.history import State
from garkcli.order.meant import meant
from garkcli.order.simplifying import is_symplectic
from garkcli.problems.hamiltonian import FLOAT_DIGITS, Hamiltonian
from garkcli.stepping.fields import visible_tableau
from garkcli.stepping.integrator import Integrator, bind, integrate
from garkcli.tableau.tableau import Tableau

Jacobian: TypeAlias = list[list[Any]]
"""∂y₁/∂y₀ by rows, midpoints of balls, shape (2d, 2d)."""
DIGITS = 90
_DECADES = 30  # the perturbation is 10^-30, so that errors are about 10^-60
# the change when the perturbation is doubled is three errors; M occurs twice
_SAFETY = 8


class Defect(Frozen):
    """The deviation of a step from symplecticity.

    Attributes:
        time: the time of the state.
        size: the largest entry of MᵀJM − J, in absolute value.
        error: the uncertainty of ``size``; a symplectic step has ``size <= error``.
    """

    time: fmpq
    size: float
    error: float

    @property
    def is_seen(self) -> bool:
        """Whether the step is certainly not symplectic there."""
        return self.size > self.error


class Symplecticity(Frozen):
    is_proved: bool
    defects: tuple[Defect, ...] = ()


@doing("symplecticity of steps")
def symplecticity_defects(
    tableau: Tableau, problem: Hamiltonian, step: fmpq, states: Sequence[State]
) -> tuple[Defect, ...]:
    """Measures the defects of steps from pairs of time and (q, p), or raises StepFailed."""
    method = bind(tableau, problem).at(max(DIGITS, FLOAT_DIGITS + 1))
    defects = []
    for time, y in states:
        defects.append(_defect(method, step, time, [_exactly(x) for x in y]))
    return tuple(defects)


def _exactly(x: Any) -> fmpq | arb:
    if not isinstance(x, float):
        exact: fmpq | arb = x
        return exact
    numerator, denominator = x.as_integer_ratio()
    return fmpq(numerator, denominator)


def _defect(method: Integrator, step: fmpq, time: fmpq, y: Sequence[Any]) -> Defect:
    """MᵀJM − J of the step from y, with M by central differences of two widths."""
    delta = fmpq(1, 10**_DECADES)
    with ctx.workprec(method.bits):
        M = _jacobian(method, step, y, delta)
        coarse = _jacobian(method, step, y, 2 * delta)
        entries = list(chain.from_iterable(M))
        coarse_entries = chain.from_iterable(coarse)
        change = max(abs(a - b) for a, b in zip(entries, coarse_entries, strict=True))
        largest = max(map(abs, entries))
        size = sum((abs(arb(x)) for x in y), arb(1))
        # what the last digits of a step make of a difference of 10^-_DECADES
        solved = arb(10) ** (_DECADES - method.digits) * size
        # each entry of MᵀJM is a sum of as many products as M has rows
        error = _SAFETY * len(M) * largest * (change + solved)
        return Defect(time, float(_deviation(M)), float(error))


def _jacobian(method: Integrator, step: fmpq, y: Sequence[Any], delta: fmpq) -> Jacobian:
    def moved(i: int, by: fmpq) -> list[Any]:
        start = list(y)
        start[i] = arb(y[i]) + arb(by)
        return integrate(method, step, 1, start)

    columns = []
    for i in range(len(y)):
        after = moved(i, delta)
        before = moved(i, -delta)
        slopes = [(a - b) / (2 * delta) for a, b in zip(after, before, strict=True)]
        columns.append([slope.mid() for slope in slopes])
    return [list(row) for row in zip(*columns, strict=True)]


def _deviation(M: Jacobian) -> arb:
    d = len(M) // 2
    largest = arb(0)
    for i in range(2 * d):
        for j in range(i):
            form = arb(0)  # entry (i, j) of MᵀJM
            for k in range(d):
                q = M[k]
                p = M[k + d]
                form += q[i] * p[j] - p[i] * q[j]
            exact = -1 if i == j + d else 0
            largest = largest.max(abs(form - exact))
    return largest.mid()


def holds(tableau: Tableau, tolerance: fmpq | None = None) -> bool:
    """Whether b_i b_j = b_i a_ij + b_j a_ji throughout, within a tolerance if any."""
    return is_symplectic(meant(tableau, tolerance))


@doing("symplecticity")
def is_proved(tableau: Tableau, problem: Hamiltonian, tolerance: fmpq | None = None) -> bool:
    """Whether the coefficients make steps on ``problem`` symplectic, by the blocks that it sees."""
    if holds(tableau, tolerance):
        return True
    bound = bind(tableau, problem)
    tableau, fields = bound.tableau, bound.fields
    drives: dict[int, set[str]] = {}
    for l, group in fields:
        drives.setdefault(tableau.colours[l].term, set()).add(group)
    is_separable = all(len(groups) == 1 for groups in drives.values())
    if not is_separable:
        return False
    return holds(visible_tableau(tableau, fields), tolerance)
