"""Whether the zeros of an ideal, complex ones included, contain a real method.

No procedure decides it for all ideals. gark tries:

* real zeros of a polynomial with constant sign are zeros of its derivatives too, so there may be
  none, or finitely many, which are examined one by one;
* for one unknown, and for a curve in the plane of two, every cell of the line or of the plane;
* otherwise rational values of some unknowns that leave finitely many solutions, which are examined.
  That finds a method, or proves nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time, only_small
from garkcli.design.ideal import Ideal, rational
from garkcli.design.member import not_negative, value_of
from garkcli.design.minimise.line import Constraints
from garkcli.design.parts import Part
from garkcli.design.solutions import Solution, solutions
from garkcli.errors import NotDecided
from garkcli.exact.cells import between_roots
from garkcli.exact.parametric import Parameters, factors
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.projection import MOST_DEGREE, in_plane, kept_sign, projected
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.problems.draw import Draw
from garkcli.tableau.family import Family

IsMethod: TypeAlias = Callable[[Solution, RealRoot], bool]
MOST_TERMS = 60
MOST_POINTS = 60
SAMPLES = 24
MOST_LARGE = 4
PARTS = 12
"""Samples are multiples of a range, or of 1, divided by this."""


def without_complex(ideal: Ideal) -> Ideal:
    """An ideal with the same real zeros, without complex ones of polynomials of one sign."""
    zeros: list[fmpq_mpoly] = []
    for p in ideal.without_unit:
        if len(p) <= MOST_TERMS:
            zeros += _real_zeros(p, ideal.ring)
    if not zeros:
        return ideal
    smaller = ideal.with_zeros(zeros)
    return ideal if smaller.basis == ideal.basis else without_complex(smaller)


def _real_zeros(p: fmpq_mpoly, ring: Parameters) -> list[fmpq_mpoly]:
    """Polynomials with the real zeros of p: derivatives of its factors with constant sign."""
    zeros_of_factors = []
    is_new = False
    for factor in factors([p]):
        slopes: list[fmpq_mpoly] = []
        if kept_sign(factor) is not None:
            is_new = True
            slopes = [factor.derivative(i) for i in range(len(ring.names))]
        if not Ideal(ring).with_zeros([factor, *slopes]).is_everything:
            zeros_of_factors.append([factor, *slopes])
    if not is_new:
        return []
    if len(zeros_of_factors) == 1:
        return zeros_of_factors[0]
    product = ring.constant(fmpq(1))
    for factor, *_ in zeros_of_factors:
        product *= factor
    return [product]


def has_methods(family: Family, ideal: Ideal, real: Ideal, is_method: IsMethod) -> bool | None:
    """Whether some real zero of an ideal is a method of a family; None if undecided. ``real`` is an
    ideal with its real zeros, without UNIT. ``is_method`` is False too if stability is undecided.
    """
    search = _MethodSearch(family, ideal, real, is_method)
    if search.finds_one():
        return True
    is_none = search.is_complete and ideal.is_proved and not family.stable
    return False if is_none or real.is_everything else None


def has_point(family: Family, part: Part, is_method: IsMethod) -> bool:
    """Whether a method is found on a part, with short rational numbers for some coordinates."""
    there = replace(family, ring=part.ring)
    search = _MethodSearch(
        there, part, part.ideal, lambda x, root: is_method(part.extended(x), root)
    )
    return search.has_method(part.ideal) if part.dimension <= 0 else search.has_sample()


class _MethodSearch:
    """Searches the real zeros of an ideal; ``is_complete`` if all of them were examined."""

    def __init__(
        self, family: Family, ideal: Ideal | Part, real: Ideal, is_method: IsMethod
    ) -> None:
        self.family = family
        self.ring = family.ring
        self.nonzero = ideal.nonzero
        self.real = real
        self.is_method = is_method
        self.is_complete = True

    def finds_one(self) -> bool:
        if self.real.dimension <= 0:
            return self.has_method(self.real)
        if self.has_sample():
            return True
        self.is_complete = True
        if len(self.ring.names) == 1:
            allowed = Constraints(
                [in_one(p) for p in self.nonzero],
                [in_one(p) for p in self.family.positive],
                [in_one(p) for p in not_negative(self.family)],
            )
            return bool(allowed.intervals)
        return any(map(self.has_method, self._in_plane()))

    def has_sample(self) -> bool:
        return any(map(self.has_method, self._slices()))

    def has_method(self, ideal: Ideal) -> bool:
        check_time()
        if ideal.is_everything:
            return False
        if ideal.dimension > 0 or ideal.degree > MOST_POINTS:
            self.is_complete = False
            return False
        return any(
            self.is_method(solution, root)
            for solution in solutions(ideal)
            if all(value_of(p, self.ring, solution.values) for p in self.nonzero)
            for root in solution.real
        )

    def _slices(self) -> Iterator[Ideal]:
        """The ideal with rational values for as many unknowns as its dimension."""
        chosen = self.real.independent
        if chosen is None:
            return
        draw = Draw(0)
        large: list[dict[int, fmpq]] = []
        for number in range(SAMPLES):
            values = {i: self._sample(i, draw, number) for i in chosen}
            ideal = None
            if len(large) < MOST_LARGE:
                with suppress(NotDecided), only_small():
                    ideal = self.real.with_values(values)
            if ideal is None:
                large.append(values)
            else:
                yield ideal
        for values in large[:MOST_LARGE]:
            yield self.real.with_values(values)

    def _sample(self, i: int, draw: Draw, number: int) -> fmpq:
        """A value of an unknown in its range, else in [0, 1], every fourth time in [−2, 2]."""
        least, greatest = self.family.ranges.get(self.ring.names[i], (None, None))
        low, high = (fmpq(-2), fmpq(2)) if number % 4 == 3 else (fmpq(0), fmpq(1))
        if least is not None:
            low, high = least, least + 1 if greatest is None else greatest
        elif greatest is not None:
            low, high = greatest - 1, greatest
        return low + (high - low) * fmpq(draw.between(1, PARTS - 1), PARTS)

    def _in_plane(self) -> Iterator[Ideal]:
        """Points of a plane curve: one is a method if any point of the curve is."""
        closure = self.real.closure
        if len(self.ring.names) > 2 or len(closure.basis) != 1:
            self.is_complete = False
            return
        [curve] = closure.basis
        signs = [*self.nonzero, *self.family.positive, *not_negative(self.family)]
        for factor in factors([rational(curve, self.ring)]):
            # the line follows the last unknown of the factor
            along = 1 if factor.degrees()[1] else 0
            deciding = factors([in_plane(p, along, 1 - along) for p in (factor, *signs)])
            if any(p.total_degree() > MOST_DEGREE for p in deciding):
                self.is_complete = False
                continue
            part = Ideal(self.ring).with_zeros([factor])
            t = self.ring.context.gen(1 - along)
            critical = [p for p in projected(deciding, []) if p.degree > 0]
            for value in between_roots(critical):
                yield part.with_zeros([t - value])
            for p in critical:
                yield part.with_zeros([_at(p, t)])


def _at(p: Polynomial, t: fmpq_mpoly) -> fmpq_mpoly:
    total = t * 0
    for a in reversed(p.coefficients):
        total = total * t + cast("fmpq", a)
    return total
