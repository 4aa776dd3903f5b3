"""The least value of a rational function on a part of the line, exactly.

Candidates are the zeros of the derivative, single points, ends that belong to the set, and the
limits at ends that do not. Values at algebraic numbers are algebraic numbers, compared as such.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import cast

from flint import fmpq

from garkcli.deadline import check_time
from garkcli.design.solutions import value_at
from garkcli.exact.cells import Interval, Point, ends_of, has, sign_of, where
from garkcli.exact.field import NumberField
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import Frozen


class Within(Frozen):
    """The condition that a rational function N/D of t has its value in a set."""

    numerator: Polynomial
    denominator: Polynomial
    intervals: tuple[Interval, ...]

    def holds(self, t: Point) -> bool:
        if sign_of(self.denominator, t) == 0:
            return False
        root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
        return has(self.intervals, _value(self.numerator, self.denominator)(root))

    @property
    def polynomials(self) -> list[Polynomial]:
        """Polynomials in t: between their zeros the condition holds for all t or for none."""
        N, D = self.numerator, self.denominator
        critical = [D]
        for end in ends_of(self.intervals):
            total = Polynomial([])
            for k, a in enumerate(end.coefficients):
                total += N**k * D ** (end.degree - k) * a
            critical.append(total)
        return critical


class Constraints(Frozen):
    """Signs of polynomials that allow numbers, and functions with values in ``sets`` of numbers."""

    nonzero: Sequence[Polynomial] = ()
    positive: Sequence[Polynomial] = ()
    not_negative: Sequence[Polynomial] = ()
    sets: Sequence[Within] = ()

    def hold(self, t: Point) -> bool:
        return (
            all(sign_of(p, t) for p in self.nonzero)
            and all(sign_of(p, t) > 0 for p in self.positive)
            and all(sign_of(p, t) >= 0 for p in self.not_negative)
            and all(x.holds(t) for x in self.sets)
        )

    @property
    def intervals(self) -> tuple[Interval, ...]:
        return where(self.hold, self.polynomials)

    @property
    def polynomials(self) -> list[Polynomial]:
        critical = [*self.nonzero, *self.positive, *self.not_negative]
        for x in self.sets:
            critical += x.polynomials
        return critical


class At(Frozen):
    value: RealRoot
    t: RealRoot


class Toward(Frozen):
    value: RealRoot | None
    end: RealRoot | None
    is_right: bool


class OnLine(Frozen):
    """Values at critical points and ends, and limits at ends that do not belong to the set.
    ``gradient`` is the numerator of the derivative in lowest terms, primitive; 0 for a constant.
    """

    attained: tuple[At, ...]
    limits: tuple[Toward, ...]
    gradient: Polynomial


def on_line(numerator: Polynomial, denominator: Polynomial, allowed: Constraints) -> OnLine:
    """The candidates for the least value of N/D, rational and bounded below near zeros of D."""
    common = gcd(numerator, denominator)
    N, D = numerator // common, denominator // common
    gradient = N.derivative() * D - N * D.derivative()
    if gradient:
        gradient //= gcd(gradient, D * D)
    value = _value(N, D)
    attained: dict[RealRoot, At] = {}
    limits = []
    if gradient:
        for root, _ in real_roots(gradient):
            check_time()
            if allowed.hold(root):
                attained[root] = At(value(root), root)
    for interval in allowed.intervals:
        ends = ((interval.start, interval.has_start, False), (interval.end, interval.has_end, True))
        for end, is_allowed, is_right in ends:
            if end is not None and is_allowed:
                attained[end] = At(value(end), end)
                continue
            limit = _limit(N, D, end, value)
            if limit is not None:
                limits.append(Toward(limit, end, is_right))
    return OnLine(tuple(attained.values()), tuple(limits), gradient)


def _value(N: Polynomial, D: Polynomial) -> Callable[[RealRoot], RealRoot]:
    def value(t: RealRoot) -> RealRoot:
        if t.exact is not None:
            quotient = N(t.exact) / D(t.exact)
            return RealRoot.rational(cast("fmpq", quotient))
        modulus = Polynomial.from_flint(t.polynomial).monic().to_flint()
        field = NumberField(modulus, ())
        return value_at(field.element(N.to_flint()) / field.element(D.to_flint()), t)

    return value


def _limit(
    N: Polynomial, D: Polynomial, end: RealRoot | None, value: Callable[[RealRoot], RealRoot]
) -> RealRoot | None:
    if end is not None:
        return None if sign_of(D, end) == 0 else value(end)
    if N.degree > D.degree:
        return None
    return RealRoot.rational(cast("fmpq", N[D.degree] / D.leading))
