"""The step of a Rosenbrock method: a linear system for each stage, with the exact Jacobian.

    (I − h γ_ii J) k_i = f(t + c_i h, y + h Σ_j α_ij k_j) + h d_i ∂f/∂t + h J Σ_{j<i} γ_ij k_j,
    y_1 = y + h Σ_i b_i k_i,

with J = ∂f/∂y at the beginning of the step, of the whole problem. A tableau for f' + h E takes the
derivatives at t − h, y − h f instead, like those of the step before; one for an arbitrary matrix
takes the diagonal of J, without ∂f/∂t.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from operator import sub as subtract_numbers
from typing import Any, Literal, TypeAlias

from garkcli.errors import MethodError
from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import Matrix, Vector, add, subtract
from garkcli.frozen import Frozen
from garkcli.ntrees import kind
from garkcli.problems.problem import Problem, field_of
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import TIME, Group, StateLayout
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau, butcher

Numbers: TypeAlias = "list[Any]"
Fields: TypeAlias = "Callable[..., Numbers]"
Taken: TypeAlias = Literal["exact", "old", "diagonal"]
_TAKEN: dict[tuple[kind.VertexKind, ...], Taken] = {
    (kind.NOT_ONE, kind.ONE_BRANCH): "exact",
    (kind.NOT_ONE, kind.ONE_BRANCH, kind.ERROR_OF_MATRIX): "old",
    (kind.PLAIN, kind.MATRIX): "diagonal",
}
"""The matrix by the kinds of vertices of one vector field."""


class LinearlyImplicit(Frozen):
    """``alpha`` is zero from the diagonal on; ``c`` are nodes of f, ``d`` weights of ∂f/∂t."""

    alpha: Matrix
    gamma: Matrix
    b: Vector
    c: Vector
    d: Vector
    taken: Taken = "exact"

    @staticmethod
    def of(tableau: Tableau) -> LinearlyImplicit | None:
        """Returns None for other methods; MethodError for several colours or implicit stages."""
        kinds = tuple(x.kind for x in tableau.colours if x.kind != kind.LEAF)
        taken = _TAKEN.get(tuple(dict.fromkeys(kinds)))
        if taken is None:
            return None
        if len(kinds) > len({*kinds}):
            message = "a step of Rosenbrock methods is for one vector field, this one has several"
            raise MethodError(message, "gark check knows its orders", code="cannot-construct")
        f, jacobian = tableau.colours[:2]
        alpha = tableau.blocks[f.space, 0]
        beside = tableau.blocks[jacobian.space, 0]
        gamma = beside if taken == "diagonal" else subtract(beside, alpha)
        if any(any(row[i:]) for i, row in enumerate(alpha)) or any(
            any(row[i + 1 :]) for i, row in enumerate(gamma)
        ):
            message = "a stage needs a later one, and a step solves one linear system a stage"
            cure = "gark check knows its orders"
            raise MethodError(message, cure, code="cannot-construct")
        d = jacobian.c
        if taken != "diagonal":
            d = tuple(map(subtract_numbers, d, f.c))
        return LinearlyImplicit(alpha, gamma, f.b, f.c, d, taken)

    @property
    def on_linear_problems(self) -> Tableau:
        """The Runge–Kutta method with the same steps on linear problems without t: A = α + γ."""
        return gark([butcher(add(self.alpha, self.gamma), self.b)], {})

    @property
    def coefficients(self) -> list[Number]:
        """The entries of the lower triangles of α and γ, row by row, then b, c, d and 1."""
        rows = enumerate(zip(self.alpha, self.gamma, strict=True))
        lower = [x for i, (a, g) in rows for x in (*a[:i], *g[: i + 1])]
        return [*lower, *self.b, *self.c, *self.d, ONE]


class LinearProgram(Frozen):
    """As ``Program``; a state has ``size`` numbers, time last, then their compensations."""

    method: LinearlyImplicit
    size: int
    evaluations: int
    repeated: tuple[int, ...] = ()


def program_of(method: LinearlyImplicit, layout: StateLayout) -> LinearProgram:
    groups = len([group for group in layout.groups if group != TIME])
    return LinearProgram(method, 2 * layout.total, groups * len(method.b))


def steps_of(
    program: LinearProgram, problem: Problem, is_for_balls: bool, failed: Callable[..., Exception]
) -> Any:
    """The function of ``Program.source``; ``failed`` makes its error of a step and a residual."""
    layout = problem.layout
    value, exact = _field(problem, is_for_balls)
    slopes = _TAKES[program.method.taken](value, exact)
    total, unknowns, stages = layout.total, layout.unknowns, len(program.method.b)

    def run(
        state: Numbers, w: Numbers, first: int, count: int, record: Callable[..., None] | None
    ) -> tuple[Numbers, list[int], int]:
        weights = _Weights(w, stages)
        y, lost = list(state[:total]), list(state[total:])
        for number in range(first, first + count):
            try:
                change = _increment(weights, y, unknowns, value, slopes)
            except (ArithmeticError, ValueError):
                raise failed(number, math.nan) from None
            if total > unknowns:
                change.append(weights.h)
            for i, x in enumerate(change):
                if is_for_balls:
                    y[i] = (y[i] + x).mid()
                    continue
                x += lost[i]
                moved = y[i] + x
                lost[i] = y[i] - moved + x
                y[i] = moved
            end = sum(y[1:unknowns], start=y[0])
            if not (end.is_finite() if is_for_balls else math.isfinite(end)):
                raise failed(number, math.inf)
            if record:
                record(y[:unknowns])
        return [*y, *lost], [], count

    return run


def _exactly(_value: Fields, slopes: Callable[..., Any]) -> Callable[..., Any]:
    return lambda y, _h: slopes(y)


def _at_the_step_before(value: Fields, slopes: Callable[..., Any]) -> Callable[..., Any]:
    def taken(y: Numbers, h: Any) -> Any:
        before = [x - h * slope for x, slope in zip(y, value(*y), strict=False)]
        return slopes([*before, *(t - h for t in y[len(before) :])])

    return taken


def _diagonal(_value: Fields, slopes: Callable[..., Any]) -> Callable[..., Any]:
    def taken(y: Numbers, _h: Any) -> Any:
        jacobian, _ = slopes(y)
        for i, row in enumerate(jacobian):
            row[:i] = [0 * x for x in row[:i]]
            row[i + 1 :] = [0 * x for x in row[i + 1 :]]
        return jacobian, []

    return taken


_TAKES = {"exact": _exactly, "old": _at_the_step_before, "diagonal": _diagonal}
"""Makes the function for the matrix and ∂f/∂t of a step."""


class _Weights:
    """The products of h and the coefficients, grouped by coefficient."""

    def __init__(self, w: Sequence[Any], stages: int) -> None:
        left = iter(w)
        self.alpha: list[Numbers] = []
        self.gamma: list[Numbers] = []
        for i in range(stages):
            self.alpha.append([next(left) for _ in range(i)])
            self.gamma.append([next(left) for _ in range(i + 1)])
        self.b, self.c, self.d = ([next(left) for _ in range(stages)] for _ in range(3))
        self.h = next(left)


def _increment(
    w: _Weights, y: Numbers, n: int, value: Fields, slopes: Callable[..., Any]
) -> Numbers:
    start = y[:n]
    time = y[n:]
    jacobian, by_time = slopes(y, w.h)
    k: list[Numbers] = []
    for i, (alpha, gamma) in enumerate(zip(w.alpha, w.gamma, strict=True)):
        place = [_sum(start[r], alpha, k, r) for r in range(n)]
        known = value(*place, *(t + w.c[i] for t in time))
        if by_time:
            known = [x + w.d[i] * slope for x, slope in zip(known, by_time, strict=True)]
        if i:
            zero = 0 * start[0]
            before = [_sum(zero, gamma, k, r) for r in range(n)]
            known = [
                x + sum((a * z for a, z in zip(row, before, strict=True) if a), start=zero)
                for x, row in zip(known, jacobian, strict=True)
            ]
        if gamma[i]:
            matrix = [
                [(1 if r == q else 0) - gamma[i] * x for q, x in enumerate(row)]
                for r, row in enumerate(jacobian)
            ]
            known = _solved(matrix, known)
        k.append(known)
    zero = 0 * start[0]
    return [_sum(zero, w.b, k, r) for r in range(n)]


def _sum(start: Any, weights: Sequence[Any], k: Sequence[Numbers], r: int) -> Any:
    for weight, slope in zip(weights, k, strict=False):
        if weight:
            start = start + weight * slope[r]
    return start


def _solved(matrix: list[Numbers], right: Numbers) -> Numbers:
    n = len(right)
    rows = [[*row, x] for row, x in zip(matrix, right, strict=True)]
    for k in range(n):
        chosen = max(range(k, n), key=lambda i: float(abs(rows[i][k])))
        rows[k], rows[chosen] = rows[chosen], rows[k]
        pivot = rows[k]
        for row in rows[k + 1 :]:
            if row[k]:
                factor = row[k] / pivot[k]
                for j in range(k + 1, n + 1):
                    row[j] = row[j] - factor * pivot[j]
    found: Numbers = [None] * n
    for k in reversed(range(n)):
        x = rows[k][n]
        for j in range(k + 1, n):
            x = x - rows[k][j] * found[j]
        found[k] = x / rows[k][k]
    return found


def _field(problem: Problem, is_for_balls: bool) -> tuple[Fields, Callable[..., Any]]:
    layout = problem.layout
    groups = [group for group in layout.groups if group != TIME]
    parts = [_StagePart(problem, group, is_for_balls) for group in groups]

    def value(*numbers: Any) -> Numbers:
        return [x for part in parts for x in part.value(numbers)]

    def slopes(numbers: Sequence[Any]) -> tuple[list[Numbers], Numbers]:
        jacobian: list[Numbers] = []
        by_time: Numbers = []
        for part in parts:
            for *row, last in part.slopes(numbers):
                jacobian.append(row)
                by_time.append(last)
        return jacobian, by_time if TIME in layout.groups else []

    return value, slopes


class _StagePart:
    def __init__(self, problem: Problem, group: Group, is_for_balls: bool) -> None:
        layout = problem.layout
        field = field_of(problem, 0, group)
        self._zero: Any = 0.0
        self._size = layout.size(group)
        self._width = layout.unknowns + 1
        self._places = [layout.start(x) + i for x in field.depends for i in range(layout.size(x))]
        by = [(x, i) for x in field.depends for i in range(layout.size(x))]
        self._value = function(field.components, field.arguments, is_for_balls)
        self._slopes = function(field.slopes(by), field.arguments, is_for_balls) if by else list

    def value(self, numbers: Sequence[Any]) -> Numbers:
        return self._value(*(numbers[place] for place in self._places))

    def slopes(self, numbers: Sequence[Any]) -> Iterator[Numbers]:
        """The derivatives of a component a row, by all unknowns and by time."""
        entries = iter(self._slopes(*(numbers[place] for place in self._places)))
        for _ in range(self._size):
            row = [self._zero] * self._width
            for place in self._places:
                row[min(place, self._width - 1)] = next(entries)
            yield row
