"""The half line y > 0 over an algebraic number t_0 of any degree, in the plane.

On it p(y, t) is a polynomial in y over ℚ(t_0). Greatest common divisors over that field decide
multiplicities and common roots exactly; balls locate the roots; the sign at a rational y is that of
a polynomial in t at t_0. So no field combines the degrees of y and t_0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import pairwise
from typing import TypeAlias

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.exact.cells import sign_of
from garkcli.exact.enclosing import value
from garkcli.exact.field import Number, NumberField, poly_of
from garkcli.exact.polynomial import Polynomial, gcd, in_one
from garkcli.exact.projection import at_y, coefficient_of, in_t, of_root, resultant
from garkcli.exact.roots import FIRST_BITS, RealRoot, root_within, sign_at
from garkcli.frozen import Frozen, replace

Holds: TypeAlias = Callable[[Sequence[int]], bool]
"""Decides a property from the signs of polynomials."""


class FibreRoot(Frozen, eq=False):
    """A number y > 0 at which curves meet the line. ``polynomial`` is in y over ℚ(t_0) and has y as
    a simple root, the only one in [``low``, ``high``], which is a point if y is rational and known.
    ``curves`` are indices.
    """

    fibre: Fibre
    polynomial: Polynomial
    low: fmpq
    high: fmpq
    curves: frozenset[int]

    def refined(self, bits: int) -> FibreRoot:
        """The root with ``high − low`` ≤ 2^−bits."""
        low, high = self.low, self.high
        if high - low <= fmpq(1, 1 << bits):
            return self
        left = self.fibre.sign_on(self.polynomial, low)
        while high - low > fmpq(1, 1 << bits):
            check_time()
            middle = (low + high) / 2
            sign = self.fibre.sign_on(self.polynomial, middle)
            if sign == 0:
                low = high = middle
            elif sign == left:
                low = middle
            else:
                high = middle
        return replace(self, low=low, high=high)

    def ball(self, bits: int) -> arb:
        finer = self.refined(bits)
        with ctx.workprec(2 * bits):
            return arb(finer.low).union(arb(finer.high))

    @property
    def exact(self) -> RealRoot:
        curve = self.fibre.curves[min(self.curves)]
        return root_within(in_one(resultant(curve, of_root(self.fibre.t), "t")), self.ball)


class Fibre:
    """The intersections of distinct irreducible curves with the line t = t_0, y > 0."""

    def __init__(self, t: RealRoot, curves: Sequence[fmpq_mpoly]) -> None:
        self.t = t
        self.curves = curves
        self._monic = Polynomial.from_flint(t.polynomial).monic().to_flint()
        self._field = NumberField(self._monic, ())
        self._signs: dict[tuple[Polynomial, fmpq], int] = {}

    def polynomial(self, p: fmpq_mpoly) -> Polynomial:
        rows = (in_t(coefficient_of(p, k)).to_flint() for k in range(p.degrees()[0] + 1))
        return Polynomial([self._field.element(row) for row in rows])

    def sign_on(self, p: Polynomial, y: fmpq) -> int:
        key = p, y
        if key not in self._signs:
            number = p(y)
            self._signs[key] = sign_at(Polynomial.from_flint(poly_of(number)), self.t)
        return self._signs[key]

    @cached_property
    def roots(self) -> list[FibreRoot]:
        roots: list[FibreRoot] = []
        for place, curve in enumerate(self.curves):
            p = self.polynomial(curve)
            if p.degree > 0:
                simple = p.square_free()
                ends = self._isolated(simple)
                roots += [FibreRoot(self, simple, *x, frozenset({place})) for x in ends]
        bits = FIRST_BITS
        while True:
            roots = sorted((root.refined(bits) for root in roots), key=lambda x: (x.low, x.high))
            together: list[FibreRoot] = []
            for root in roots:
                for place, other in enumerate(together):
                    same = self._common(other, root)
                    if same is not None:
                        together[place] = same
                        break
                else:
                    together.append(root)
            if all(a.high < b.low for a, b in pairwise(together)):
                return together
            roots = together
            bits *= 2

    def _common(self, a: FibreRoot, b: FibreRoot) -> FibreRoot | None:
        low, high = max(a.low, b.low), min(a.high, b.high)
        if low > high or a.curves & b.curves:
            return None
        check_time()
        p = gcd(a.polynomial, b.polynomial)
        if p.degree < 1 or self.sign_on(p, low) * self.sign_on(p, high) > 0:
            return None
        return FibreRoot(self, p, low, high, a.curves | b.curves)

    def _isolated(self, p: Polynomial) -> Iterator[tuple[fmpq, fmpq]]:
        """Disjoint bounds of the positive roots of a square-free polynomial."""
        bits = FIRST_BITS
        while True:
            try:
                yield from list(self._halved(p, bits))
            except _NotFineEnough:
                bits *= 2
            else:
                return

    def _halved(self, p: Polynomial, bits: int) -> Iterator[tuple[fmpq, fmpq]]:
        """Halves intervals until p or its derivative has no zero there."""
        values = self._enclosed(p, bits)
        slopes = self._enclosed(p.derivative(), bits)
        waiting = [(fmpq(0), _bound(values, bits))]
        while waiting:
            check_time()
            low, high = waiting.pop()
            with ctx.workprec(bits):
                interval = arb(low).union(arb(high))
                if not value(values, interval).contains(0):
                    continue
                is_monotone = not value(slopes, interval).contains(0)
            if is_monotone:
                if self.sign_on(p, low) * self.sign_on(p, high) < 0:
                    yield low, high
                continue
            if high - low < fmpq(1, 1 << bits // 2):
                raise _NotFineEnough
            middle = (low + high) / 2
            if self.sign_on(p, middle) == 0:
                yield middle, middle
            waiting += [(middle, high), (low, middle)]

    def _enclosed(self, p: Polynomial, bits: int) -> list[arb]:
        t = self.t.ball(bits)
        with ctx.workprec(bits):
            return [_ball(a, t) for a in p.coefficients]

    @cached_property
    def gaps(self) -> list[fmpq]:
        """A rational number below, between and above the roots."""
        if not self.roots:
            return [fmpq(1)]
        between = [(a.high + b.low) / 2 for a, b in pairwise(self.roots)]
        first, bits = self.roots[0], FIRST_BITS
        while first.low <= 0:
            first = first.refined(bits)
            bits *= 2
        return [first.low / 2, *between, self.roots[-1].high + 1]

    def first_failure(
        self, polynomials: Sequence[fmpq_mpoly], holds: Holds
    ) -> FibreRoot | fmpq | None:
        """Returns the smallest y at which a property fails; 0 if it fails at once, None if never.

        ``polynomials``, whose signs decide it, are products of curves and of factors without a zero
        on the line.
        """
        divisors = [
            frozenset(k for k, curve in enumerate(self.curves) if p and not p % curve)
            for p in polynomials
        ]
        if not holds([self._sign(p, self.gaps[0]) for p in polynomials]):
            return fmpq(0)
        for root, gap in zip(self.roots, self.gaps[1:], strict=True):
            behind = [self._sign(p, gap) for p in polynomials]
            there = [0 if root.curves & x else s for x, s in zip(divisors, behind, strict=True)]
            if not holds(there) or not holds(behind):
                return root
        return None

    def have_common_zero(self, polynomials: Sequence[fmpq_mpoly]) -> bool:
        common = Polynomial([])
        for p in polynomials:
            common = gcd(common, self.polynomial(p))
        return common.degree > 0

    def _sign(self, p: fmpq_mpoly, y: fmpq) -> int:
        return sign_of(at_y(p, y), self.t)


class _NotFineEnough(Exception):
    """Balls are too wide."""


def _ball(a: Number, t: arb) -> arb:
    return Polynomial.from_flint(poly_of(a)).enclosed_at(t)


def _bound(coefficients: Sequence[arb], bits: int) -> fmpq:
    """A power of 2 above all roots (Cauchy); _NotFineEnough if the leading coefficient may be 0."""
    with ctx.workprec(bits):
        *lower, leading = coefficients
        if leading.contains(0):
            raise _NotFineEnough
        bound = fmpq(2)
        while not all(abs(a / leading) < arb(bound) - 1 for a in lower):
            bound *= 2
        return bound
