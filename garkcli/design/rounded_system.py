"""Systems of polynomials with rounded coefficients: numbers below a given size count as zero."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.frozen import Frozen

MAX_STEPS = 40
LARGE = 1e6
"""Unknowns beyond are taken to diverge."""


class Solved(Frozen, eq=False):
    """The end of Newton's method, at a point of balls without radius. ``left`` is the largest
    residual of conditions dependent on the others. ``pivots`` are rows with the unknowns that they
    determine, each of which is in one of the reduced ``rows`` only.
    """

    point: tuple[arb, ...]
    left: arb
    pivots: tuple[tuple[int, int], ...]
    rows: tuple[tuple[arb, ...], ...]

    @property
    def free(self) -> list[int]:
        bound = {column for _, column in self.pivots}
        return [k for k in range(len(self.point)) if k not in bound]

    def slopes(self, column: int) -> dict[int, arb]:
        row = next(i for i, k in self.pivots if k == column)
        return {k: -self.rows[row][k] for k in self.free}


class RoundedSystem:
    """Equations p(x) = 0, with polynomials p ≠ 0 scaled so that no coefficient exceeds 1."""

    def __init__(self, polynomials: Sequence[fmpq_mpoly], unknowns: int, bits: int) -> None:
        self.unknowns = unknowns
        self.bits = bits
        scaled = [p / max(fmpq(1), *(abs(fmpq(a)) for a in p.coeffs())) for p in polynomials]
        self._values = [_Function(p, bits) for p in scaled]
        self._slopes = [[_Function(p.derivative(k), bits) for k in range(unknowns)] for p in scaled]

    @cached_property
    def is_linear(self) -> bool:
        return all(f.degree <= 1 for f in self._values)

    def values(self, x: Sequence[arb]) -> list[arb]:
        with ctx.workprec(self.bits):
            return [f.at(x) for f in self._values]

    def solve(self, start: Sequence[arb], zero: arb) -> Solved | None:
        """Newton's method; undetermined unknowns keep their values. None if it diverges.
        Derivatives below ``zero`` count as zero.
        """
        with ctx.workprec(self.bits):
            x = [a.mid() for a in start]
            goal = arb(2) ** (60 - self.bits)
            for _ in range(MAX_STEPS):
                check_time()
                values = self.values(x)
                rows = [
                    [*(f.at(x) for f in slopes), value]
                    for slopes, value in zip(self._slopes, values, strict=True)
                ]
                pivots = eliminate(rows, self.unknowns, zero)
                used = {i for i, _ in pivots}
                change = arb(0)
                for i, k in pivots:
                    x[k] = (x[k] - rows[i][-1]).mid()
                    change = change.max(abs(rows[i][-1]))
                left = arb(0)
                for i, row in enumerate(rows):
                    if i not in used:
                        left = left.max(abs(row[-1]))
                if self.is_linear or change < goal:
                    slopes = tuple(tuple(row[:-1]) for row in rows)
                    return Solved(tuple(x), left, tuple(pivots), slopes)
                if not all(abs(a) < LARGE for a in x):
                    return None
        return None


def eliminate(rows: list[list[arb]], columns: int, zero: arb) -> list[tuple[int, int]]:
    """Gauss–Jordan elimination in place with complete pivoting; pivots exceed ``zero``."""
    pivots: list[tuple[int, int]] = []
    left, open_ = set(range(len(rows))), set(range(columns))
    while left and open_:
        size, i, k = max((float(abs(rows[i][k]).mid()), -i, -k) for i in left for k in open_)
        i, k = -i, -k
        if not abs(rows[i][k]) > zero or not size:
            break
        pivot = rows[i][k]
        rows[i] = [(a / pivot).mid() for a in rows[i]]
        for j, row in enumerate(rows):
            factor = row[k]
            if j != i and factor:
                rows[j] = [(a - factor * b).mid() for a, b in zip(row, rows[i], strict=True)]
        pivots.append((i, k))
        left.discard(i)
        open_.discard(k)
    return pivots


class _Function:
    def __init__(self, polynomial: fmpq_mpoly, bits: int) -> None:
        with ctx.workprec(bits):
            self.terms = [
                (arb(fmpq(a)), [(k, int(e)) for k, e in enumerate(exponents) if e])
                for exponents, a in polynomial.to_dict().items()
            ]
        self.degree = max((sum(e for _, e in powers) for _, powers in self.terms), default=0)

    def at(self, x: Sequence[arb]) -> arb:
        total = arb(0)
        for factor, powers in self.terms:
            term = factor
            for k, exponent in powers:
                term = term * x[k] ** exponent
            total += term
        return total.mid()
