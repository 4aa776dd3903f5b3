"""Low-storage schemes as tableaus: 2N, 3S*, van der Houwen, Shu–Osher; Nyström methods as pairs.

Every scheme is executed with its registers as combinations of the value at the beginning of the
step and the slopes so far. The numbers may be exact, or balls around the printed ones.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.errors import MethodError, counted
from garkcli.exact.display import to_ball, to_decimal
from garkcli.exact.field import ONE, Algebraic
from garkcli.exact.matrix import Vector
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen
from garkcli.order.tolerance import within
from garkcli.tableau.tableau import Method, butcher

Numbers: TypeAlias = Sequence[Any]


class Steps(Frozen):
    """An executed method; ``starts`` are the coefficients of the initial value in the stages and in
    the final value, 1 for a method.
    """

    A: Sequence[Numbers]
    b: Numbers
    starts: Numbers


class _Registers:
    """Registers, each a row: the coefficient of the initial value, then those of the slopes."""

    def __init__(self, stages: int) -> None:
        self._size = stages + 1
        self._seen: list[Numbers] = []
        self.y = self._unit(0)
        self.nothing: Numbers = [0] * self._size

    def _unit(self, place: int) -> Numbers:
        return [int(i == place) for i in range(self._size)]

    def slope(self, value: Numbers) -> Numbers:
        self._seen.append(value)
        return self._unit(len(self._seen))

    def steps(self, end: Numbers) -> Steps:
        starts = [x[0] for x in (*self._seen, end)]
        return Steps([x[1:] for x in self._seen], end[1:], starts)


def _sum(*terms: tuple[Any, Numbers]) -> Numbers:
    columns = zip(*(register for _, register in terms), strict=True)
    return [sum(x * y for (x, _), y in zip(terms, column, strict=True)) for column in columns]


def _full_row(row: Numbers, stages: int, first: int) -> Numbers:
    """Adds ``first`` to a row that lacks it; MethodError for other lengths."""
    full = [first, *row] if len(row) == stages - 1 else row
    if len(full) != stages:
        message = f"a row of {len(row)} for {counted(stages, 'stage')}"
        raise MethodError(message, code="cannot-convert")
    return full


def two_registers(A: Numbers, B: Numbers) -> Steps:
    """Williamson's 2N: dy ← A_i dy + h f(y), y ← y + B_i dy.

    >>> from flint import fmpq
    >>> A, B = [0, fmpq(-5, 9), fmpq(-153, 128)], [fmpq(1, 3), fmpq(15, 16), fmpq(8, 15)]
    >>> two_registers(A, B).b
    [1/6, 3/10, 8/15]
    """
    A = _full_row(A, len(B), 0)
    made = _Registers(len(B))
    y, dy = made.y, made.nothing
    for a, b in zip(A, B, strict=True):
        dy = _sum((a, dy), (1, made.slope(y)))
        y = _sum((1, y), (b, dy))
    return made.steps(y)


def in_two_registers(
    A: Sequence[Numbers], b: Numbers, tolerance: Any = 0
) -> tuple[list[Any], list[Any]] | int:
    """A and B of Williamson's 2N for an explicit method; if there is no such form, a stage, from 1,
    whose slope has no ratio to the next one.

    The differences of successive rows of A and b have the form d_mj = B_m A_{j+1} ⋯ A_m. So B is
    their diagonal, and the form exists if and only if each column is A_i times the next one, from
    its diagonal on. For rounded coefficients the ratios are those of the largest entries, and the
    form reproduces the entries within ``tolerance``.

    >>> from flint import fmpq
    >>> in_two_registers([[0, 0], [fmpq(2, 3), 0]], [fmpq(1, 4), fmpq(3, 4)])
    ([0, -5/9], [2/3, 3/4])
    """
    stages = len(b)
    rows = [*A, b]
    differences = [[y - x for x, y in zip(*rows[m : m + 2], strict=True)] for m in range(stages)]
    factors: list[Any] = [0]
    for i in range(1, stages):
        pairs = [(row[i - 1], row[i]) for row in differences[i:]]
        ratios = [pair for pair in pairs if pair[1]]
        if tolerance:
            ratios.sort(key=lambda pair: -abs(float(to_ball(pair[1]))))
        factor = ratios[0][0] / ratios[0][1] if ratios else 0
        if not tolerance and any(x - factor * y for x, y in pairs):
            return i
        factors.append(factor)
    weights = [row[i] for i, row in enumerate(differences)]
    if tolerance:
        made = two_registers(factors, weights)
        # a column that is right makes the one before it
        for i in reversed(range(stages)):
            columns = [(x[i], y[i]) for x, y in zip(rows, [*made.A, made.b], strict=True)]
            if not all(within(x - y, tolerance) for x, y in columns):
                return i + 1
    return factors, weights


def minus_two_registers(A: Numbers, B: Numbers) -> Steps:
    """2N with dy ← h f(y) − A_i dy."""
    return two_registers([-x for x in A], B)


def three_registers(
    gamma1: Numbers, gamma2: Numbers, gamma3: Numbers, delta: Numbers, beta: Numbers
) -> Steps:
    """Ketcheson's 3S*: S₂ ← S₂ + δ_i S₁, S₁ ← γ₁ S₁ + γ₂ S₂ + γ₃ S₃ + β_i h f(S₁), with S₃ the
    initial value; 2S has γ₃ = 0.
    """
    stages = len(beta)
    known = ((gamma1, 0), (gamma2, 1), (gamma3, 0), (delta, 1))
    rows = [_full_row(row[:stages], stages, first) for row, first in known]
    made = _Registers(stages)
    y, other = made.y, made.nothing
    for g1, g2, g3, d, b in zip(*rows, beta, strict=True):
        other = _sum((1, other), (d, y))
        y = _sum((g1, y), (g2, other), (g3, made.y), (b, made.slope(y)))
    return made.steps(y)


def van_der_houwen(b: Numbers, *diagonals: Numbers) -> Steps:
    """2R with one diagonal below the main one; every entry outside of the diagonals is the weight
    of its column. Each diagonal has an entry per row, from the second row on.
    """
    stages = len(b)
    rows = [_full_row(x, stages, 0) for x in diagonals]
    A = []
    for i in range(stages):
        row = [b[j] if j < i else 0 for j in range(stages)]
        for below, diagonal in enumerate(rows, start=1):
            if i >= below:
                row[i - below] = diagonal[i]
        A.append(row)
    return Steps(A, b, [1] * (stages + 1))


def ahead(b: Numbers, A: Numbers) -> Steps:
    """2C: y ← y + B_i h f, with f evaluated at y + A_i h f for the previous f."""
    A = _full_row(A, len(b), 0)
    return van_der_houwen(b, [0, *(x + y for x, y in zip(A[1:], b, strict=False))])


def shu_osher(alpha: Sequence[Numbers], beta: Sequence[Numbers]) -> Steps:
    """Y_i = v_i y + Σ α_ij Y_j + h Σ β_ij f(Y_j) with v_i = 1 − Σ α_ij. A row of zeros may precede
    those of the stages after the first and of the final value. MethodError if a value needs a later
    one.
    """
    if alpha and beta and all(x == 0 for x in (*alpha[0], *beta[0])):
        alpha, beta = alpha[1:], beta[1:]
    stages = len(alpha)
    if len(beta) != stages:
        message = f"alpha has {counted(stages, 'row')}, beta has {len(beta)}"
        raise MethodError(message, code="cannot-convert")
    made = _Registers(stages)
    values, slopes = [made.y], [made.slope(made.y)]
    for i, rows in enumerate(zip(alpha, beta, strict=True), start=1):
        if any(x != 0 for row in rows for x in row[i:]):
            message = "a value needs a later one: the method is implicit"
            raise MethodError(message, code="cannot-convert")
        a, b = ([*row[:i], *[0] * (i - len(row))] for row in rows)
        terms = [*zip(a, values, strict=True), *zip(b, slopes, strict=True)]
        values.append(_sum((1 - sum(a), made.y), *terms))
        if i < stages:
            slopes.append(made.slope(values[i]))
    return made.steps(values[-1])


def diagonals(A: Sequence[Any], b: Numbers) -> Steps:
    """2R, 3R, … as printed: the diagonals below the main one; one may be a plain row."""
    rows = A if isinstance(A[0], Sequence) else [A]
    full = []
    for below, row in enumerate(rows, start=1):
        if len(row) not in (len(b) - below, len(b)):
            entries, stages = counted(len(row), "entry", "entries"), counted(len(b), "stage")
            message = f"diagonal {below} has {entries} for {stages}"
            raise MethodError(message, f"give {len(b) - below}", code="wrong-size")
        full.append([*[0] * (len(b) - len(row)), *row])
    return van_der_houwen(b, *full)


def two_s(gamma1: Numbers, gamma2: Numbers, delta: Numbers, beta: Numbers) -> Steps:
    """3S* without the initial value."""
    return three_registers(gamma1, gamma2, [0] * len(beta), delta, beta)


OF_FILES: Mapping[str, Callable[..., Steps]] = {
    "shu-osher": shu_osher,
    "2N": two_registers,
    "2C": lambda A, b: ahead(b, A),
    **dict.fromkeys(("2R", "3R", "4R", "5R"), diagonals),
    "2S": two_s,
    "3S*": three_registers,
}


def as_butcher(
    scheme: str, numbers: Sequence[Any], c: Vector | None = None, grain: Any = 0
) -> Method:
    """Returns the Runge–Kutta method of a scheme in ``OF_FILES``.

    ``c`` is None for the row sums; ``grain`` is the rounding of the nodes. Raises MethodError if
    the numbers are no method, or a stage does not begin at the initial value.
    """
    made = OF_FILES[scheme](*numbers)
    for i, start in enumerate(made.starts, start=1):
        off = start - ONE
        is_free = isinstance(off, Parametric) and bool(off)
        if is_free or (isinstance(off, fmpq | Algebraic) and not within(off, 100 * grain)):
            where = f"stage {i}" if i <= len(made.b) else "the step"
            multiple = f"({start})" if is_free else to_decimal(start, 8)
            message = f"{where} begins at {multiple} y, not at y"
            cure = "the factors of the registers belong to another scheme, or one is misprinted"
            raise MethodError(message, cure, code="cannot-construct")

    def row(numbers: Numbers) -> Vector:
        return tuple(fmpq(x) if isinstance(x, int) else x for x in numbers)

    return butcher(tuple(map(row, made.A)), row(made.b), c)


FORMS: Mapping[str, Callable[[Numbers, Numbers], Steps]] = {
    "2N": two_registers,
    "2N with -A": minus_two_registers,
    "van der Houwen": lambda A, b: van_der_houwen(b, A),
    "2C": lambda A, b: ahead(b, A),
}


def nystrom(A: Sequence[Numbers], b: Numbers, c: Numbers) -> tuple[list[Numbers], Numbers]:
    """Returns the weights of velocities for a pair (q, p): one more than there are forces. ``A`` is
    Ā and ``b`` is b̄.
    """
    first = [node - sum(row) for node, row in zip(c, A, strict=True)]
    return [[x, *row] for x, row in zip(first, A, strict=True)], [1 - sum(b), *b]
