"""Whether solutions that are known by their ideal, which sees complex ones, are real methods.

No way decides it for all ideals. These are tried:

* real zeros of a polynomial that keeps its sign are zeros of its derivatives, so that fewer may be
  left: none, or finitely many, which are examined one by one;
* of one unknown, and of a curve in the plane of two, every cell of the line or of the plane;
* otherwise some unknowns get rational values so that finitely many solutions are left, and these
  are examined. That finds a method, or proves nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time, only_small
from garkcli.design.ideal import Ideal, rational
from garkcli.design.member import not_negative, value_of
from garkcli.design.minimise.line import Conditions
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
"""Longer polynomials are not tried whether they keep their sign."""
MOST_POINTS = 60
"""Solutions, complex ones included, of which those that are methods are picked."""
SAMPLES = 24
"""Values of unknowns that are tried."""
MOST_LARGE = 4
"""Of the steps that need a large Gröbner basis."""
PARTS = 12
"""Samples are so many parts of a range, or of 1."""


def without_complex(ideal: Ideal) -> Ideal:
    """An ideal with the same real zeros, without complex ones of polynomials that keep their sign.

    Raises:
        NotDecided: the time is not enough.
    """
    zeros: list[fmpq_mpoly] = []
    for p in ideal.without_unit:
        if len(p) <= MOST_TERMS:
            zeros += _real_zeros(p, ideal.ring)
    if not zeros:
        return ideal
    smaller = ideal.with_zeros(zeros)
    return ideal if smaller.basis == ideal.basis else without_complex(smaller)


def _real_zeros(p: fmpq_mpoly, ring: Parameters) -> list[fmpq_mpoly]:
    """Polynomials that are zero at the real zeros of p, where p has factors that keep their sign:
    their real zeros are those of their derivatives.
    """
    left = []
    is_new = False
    for factor in factors([p]):
        slopes: list[fmpq_mpoly] = []
        if kept_sign(factor) is not None:
            is_new = True
            slopes = [factor.derivative(i) for i in range(len(ring.names))]
        if not Ideal(ring).with_zeros([factor, *slopes]).is_everything:
            left.append([factor, *slopes])
    if not is_new:
        return []
    if len(left) == 1:
        return left[0]
    product = ring.constant(fmpq(1))
    for factor, *_ in left:
        product *= factor
    return [product]


def has_methods(family: Family, ideal: Ideal, real: Ideal, is_method: IsMethod) -> bool | None:
    """Whether real zeros of an ideal are methods of a family; None where that is not decided.

    Args:
        family: whose parameters they are.
        ideal: of its ring; where it is not proved that it has all of them, nothing else is.
        real: one with its real zeros, without UNIT.
        is_method: whether a real zero is a method; where stability is wanted it may be undecided,
            and is then none.

    Raises:
        NotDecided: the time is not enough.
    """
    search = _Search(family, ideal, real, is_method)
    if search.finds_one():
        return True
    is_none = search.is_complete and ideal.is_proved and not family.stable
    return False if is_none or real.is_everything else None


def has_point(family: Family, part: Part, is_method: IsMethod) -> bool:
    """Whether a method is found on a part, some of its coordinates short rational numbers."""
    there = replace(family, ring=part.ring)
    search = _Search(there, part, part.ideal, lambda x, root: is_method(part.whole(x), root))
    return search.has_method(part.ideal) if part.dimension <= 0 else search.has_sample()


class _Search:
    """Looks at real zeros of an ideal.

    Attributes:
        is_complete: whether there are none besides those that were examined.
    """

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
        """Whether one of them is a method."""
        if self.real.dimension <= 0:
            return self.has_method(self.real)
        if self.has_sample():
            return True
        self.is_complete = True
        if len(self.ring.names) == 1:
            allowed = Conditions(
                [in_one(p) for p in self.nonzero],
                [in_one(p) for p in self.family.positive],
                [in_one(p) for p in not_negative(self.family)],
            )
            return bool(allowed.intervals)
        return any(map(self.has_method, self._in_plane()))

    def has_sample(self) -> bool:
        """Whether one with short rational numbers is."""
        return any(map(self.has_method, self._slices()))

    def has_method(self, ideal: Ideal) -> bool:
        """Whether one of finitely many zeros is a method."""
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
        """The ideal with rational values for as many unknowns as its dimension, which no polynomial
        of the ideal relates.
        """
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
        """A value of an unknown: within its range, without one between 0 and 1, every fourth time
        between −2 and 2.
        """
        least, greatest = self.family.ranges.get(self.ring.names[i], (None, None))
        low, high = (fmpq(-2), fmpq(2)) if number % 4 == 3 else (fmpq(0), fmpq(1))
        if least is not None:
            low, high = least, least + 1 if greatest is None else greatest
        elif greatest is not None:
            low, high = greatest - 1, greatest
        return low + (high - low) * fmpq(draw.between(1, PARTS - 1), PARTS)

    def _in_plane(self) -> Iterator[Ideal]:
        """Finitely many points of a curve in the plane, of which one is a method if any of its
        points is: between the t at which something changes, and at these.
        """
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
    """p(t)."""
    total = t * 0
    for a in reversed(p.coefficients):
        total = total * t + cast("fmpq", a)
    return total
