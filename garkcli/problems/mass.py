"""Velocities and the mass matrix M = ∂²L/∂q̇² of a Lagrangian."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq_mat

from garkcli.errors import NoLegendreTransform
from garkcli.frozen import Frozen
from garkcli.graph import components
from garkcli.problems.deferred import Deferred
from garkcli.problems.expr import Expr, ExprMatrix, Exprs, Place, Vector, number, rational
from garkcli.problems.straightline import function

MAX_COUPLED = 5
"""Most velocities that a position-dependent mass matrix may couple."""
WRITE_HAMILTONIAN = "write the Hamiltonian itself: hamiltonian: instead of lagrangian:"
BITS = 300


@cache
def velocities(variables: tuple[str, ...]) -> Exprs:
    """The symbols of the velocities, shape (d,): that of ``x`` is ``vx``."""
    import sympy

    return tuple(sympy.Symbol(f"v{x}", real=True) for x in variables)


class Lagrangian(Frozen):
    """L of d velocities v, ``gradient`` ∂L/∂v, shape (d,), ``M`` ∂²L/∂v², shape (d, d)."""

    L: Expr
    gradient: Vector
    M: ExprMatrix
    variables: tuple[str, ...]
    start: Place

    @property
    def is_quadratic(self) -> bool:
        moving = set(velocities(self.variables))
        entries = [x for row in self.M for x in row]
        return not any(x.free_symbols & moving for x in entries)


def differentiated(L: Expr, variables: tuple[str, ...], start: Place) -> Lagrangian:
    v = velocities(variables)
    gradient = [L.diff(x) for x in v]
    M = [[slope.diff(x) for x in v] for slope in gradient]
    return Lagrangian(L, gradient, M, variables, start)


def coupled(M: ExprMatrix) -> list[list[int]]:
    after: dict[int, list[int]] = {}
    for i, row in enumerate(M):
        after[i] = []
        for j, x in enumerate(row):
            if x != 0 or M[j][i] != 0:
                after[i].append(j)
    return sorted(sorted(block) for block in components(after))


def inverse_of(M: ExprMatrix, names: Vector, start: Place) -> tuple[list[list[Expr]], Expr]:
    """Returns adjugate and determinant, or inverse and 1; NoLegendreTransform if singular."""
    import sympy

    singular = NoLegendreTransform(
        f"the mass matrix of {', '.join(map(str, names))} is singular",
        "each velocity needs a kinetic energy of its own in this term",
    )
    if all(x.is_Rational for row in M for x in row):
        inverse = _inverse_of_numbers(M)
        if inverse is None:
            raise singular
        return inverse, sympy.Integer(1)
    if len(M) > MAX_COUPLED:
        raise NoLegendreTransform(
            f"a mass matrix of {len(M)} coupled velocities that is not constant "
            f"(limit {MAX_COUPLED})",
            WRITE_HAMILTONIAN,
        )
    minors = _Minors(M)
    det = minors.determinant()
    if det == 0:
        raise singular
    (at_start,) = enclosed([det], start)
    if at_start.contains(0):
        raise singular
    return minors.adjugate(), det


def _inverse_of_numbers(M: ExprMatrix) -> list[list[Expr]] | None:
    matrix = fmpq_mat([[number(x) for x in row] for row in M])
    if not matrix.det():
        return None
    return [[rational(x) for x in row] for row in matrix.inv().tolist()]


_Places: TypeAlias = tuple[int, ...]


class _Minors:
    def __init__(self, M: ExprMatrix) -> None:
        self._M = M
        self._every = tuple(range(len(M)))
        self._known: dict[tuple[_Places, _Places], Any] = {}

    def determinant(self) -> Expr:
        return self._of(self._every, self._every)

    def adjugate(self) -> list[list[Expr]]:
        """The determinant times the inverse; symmetric, so half of the entries are computed."""
        rows = []
        for i in self._every:
            row = []
            for j in self._every:
                low, high = min(i, j), max(i, j)
                row.append((-1) ** (i + j) * self._of(self._without(low), self._without(high)))
            rows.append(row)
        return rows

    def _of(self, rows: _Places, columns: _Places) -> Expr:
        import sympy

        if not rows:
            return sympy.Integer(1)
        if (rows, columns) not in self._known:
            first, *others = rows
            total = 0
            for k, j in enumerate(columns):
                minor = self._of(tuple(others), columns[:k] + columns[k + 1 :])
                total += (-1) ** k * self._M[first][j] * minor
            self._known[rows, columns] = total
        return self._known[rows, columns]

    def _without(self, i: int) -> _Places:
        return self._every[:i] + self._every[i + 1 :]


def enclosed(expressions: Vector, at: Place) -> list[arb]:
    """The expressions, enclosed; not finite if they have no value, or kinks."""
    return enclosed_at(expressions, tuple(at), tuple(at.values()))


def enclosed_at(expressions: Vector, names: Vector, numbers: Sequence[arb]) -> list[arb]:
    made = expressions
    if not isinstance(expressions, Deferred):
        import sympy

        made = tuple(sympy.Add(x) for x in expressions)
        if not all(map(is_smooth, made)):
            return [arb("nan")] * len(made)
    with ctx.workprec(BITS):
        try:
            return [arb(x) for x in function(made, names, True)(*numbers)]
        except (ArithmeticError, ValueError):
            return [arb("nan")] * len(made)


def is_smooth(expression: Expr) -> bool:
    """Whether an expression is real and without |x|, which sympy makes of roots of squares."""
    import sympy

    return not expression.has(sympy.Abs, sympy.sign, sympy.I, sympy.zoo, sympy.nan, sympy.oo)
