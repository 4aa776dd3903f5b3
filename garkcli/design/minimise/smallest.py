"""The least value of a rational function of the coefficients."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cmp_to_key
from itertools import combinations
from typing import cast

from flint import fmpq, fmpq_mat, fmpq_mpoly, fmpz_mpoly

from garkcli.deadline import check_time, checked, seconds_left, until, within
from garkcli.design.critical import minors, slopes
from garkcli.design.ideal import UNIT
from garkcli.design.member import is_in, not_negative
from garkcli.design.minimise.comparison import Minimisation
from garkcli.design.minimise.line import on_line
from garkcli.design.minimise.objective import ORIGIN, Objective, Size
from garkcli.design.minimise.result import Candidate, Extent, ObjectiveLimit, Proof
from garkcli.design.parts import Part, RationalChart, at_root, charts, parts_within, values_on
from garkcli.design.search.points import Fixings, is_proved, polished
from garkcli.design.search.rational import System, as_float, in_decimals, polynomial_functions
from garkcli.design.solutions import Solution, value_at
from garkcli.design.steps import Found
from garkcli.design.want import sign_polynomial
from garkcli.errors import NotDecided
from garkcli.exact.cells import Interval, between, sign_of
from garkcli.exact.enclosing import midpoint
from garkcli.exact.parametric import Parameters, fraction, unknowns_of
from garkcli.exact.polynomial import in_one
from garkcli.exact.projection import Along, kept_sign
from garkcli.exact.roots import RealRoot


def critical_equations(
    part: Part, numerator: fmpq_mpoly, denominator: fmpq_mpoly
) -> list[fmpq_mpoly]:
    """Polynomials that vanish at the critical points of N/D on a part; NotDecided for many minors.

    On the zeros of f_1, …, f_m of codimension c these are the points at which the gradients of the
    function and of the f_i have rank at most c: all minors of size c + 1 vanish. Singular points of
    the set are among them. On components of a larger codimension some critical points may be
    missing.
    """
    size = len(part.ring.names)
    gradient = gradient_of(numerator, denominator, size)
    if part.is_free:
        return gradient
    rows = [gradient, *slopes(part.equations, size)]
    return minors(rows, size - part.dimension + 1)


def gradient_of(numerator: fmpq_mpoly, denominator: fmpq_mpoly, size: int) -> list[fmpq_mpoly]:
    return [
        numerator.derivative(i) * denominator - numerator * denominator.derivative(i)
        for i in range(size)
    ]


def is_of_one_dimension(part: Part) -> bool:
    """Whether all components have one dimension: as many equations as the codimension imply it (F.
    S. Macaulay, 1916).
    """
    codimension = len(part.ring.names) - part.dimension
    return part.is_free or len(part.equations) == codimension


def without_factors(p: fmpq_mpoly, denominator: fmpq_mpoly) -> fmpq_mpoly:
    while True:
        common = p.gcd(denominator)
        if common.is_constant() or not p:
            return p
        p = p // common


BITS = 256
"""Precision of Newton's method; the test encloses the point to half as many bits."""
DECIMALS = 20
NEAR = fmpq(1, 100)


def critical_point_near(
    point: Sequence[fmpq],
    gradient: Sequence[fmpq_mpoly],
    nonzero: Sequence[fmpq_mpoly],
    ring: Parameters,
) -> tuple[fmpq, ...] | None:
    """A rational point within 10^−DECIMALS of a common zero of ``gradient`` near a given point. It
    is a method as well, as the coordinates of a part are free, with the same order and, up to
    rounding, value. None if Krawczyk's test proves no zero without zeros of ``nonzero``.
    """
    system = Fixings(System(polynomial_functions(gradient, ring)))
    zero = polished(system, [as_float(x) for x in point], BITS)
    if zero is None or not is_proved(system, zero, BITS, polynomial_functions(nonzero, ring)):
        return None
    rounded = tuple(fmpq(in_decimals(x, DECIMALS), 10**DECIMALS) for x in zero[:, 0])
    if any(abs(x - y) > NEAR for x, y in zip(rounded, point, strict=True)):
        return None
    return rounded


CUTS = (fmpq(1, 2), fmpq(1, 3), fmpq(2, 3), fmpq(1), fmpq(1, 4), fmpq(3, 4))


def are_bounded(
    ring: Parameters, numbers: Iterable[object], zeros: Sequence[fmpq_mpoly | fmpz_mpoly] = ()
) -> bool:
    """Whether bounds on numbers, and polynomials that are zero, imply bounds on all unknowns.

    Without the terms in unknowns already bounded, one of them is a multiple of a power of the next
    unknown, or quadratic and definite in the next ones.

    >>> ring = Parameters(["x", "y"])
    >>> x, y = map(ring.parameter, ring.names)
    >>> are_bounded(ring, [x - 1, x * x + 2 * y]), are_bounded(ring, [x * y, y])
    (True, False)
    >>> are_bounded(ring, [x * x + y * y - 4 * x]), are_bounded(ring, [x * x + 2 * x * y + y * y])
    (True, False)
    """
    fractions = (fraction(x, ring) for x in numbers)
    polynomials = [*(p for p, q in fractions if q.is_constant()), *zeros]
    tables = [{tuple(map(int, e)): fmpq(a) for e, a in p.to_dict().items()} for p in polynomials]
    bounded: set[int] = set()
    while True:
        before = len(bounded)
        for terms in tables:
            left = {e: a for e, a in terms.items() if any(e[i] for i in {*range(len(e))} - bounded)}
            if len(left) == 1:
                bounded |= {i for e in left for i, k in enumerate(e) if k and k == sum(e)}
            bounded |= _bounded_by_quadratic(left, bounded)
        if len(bounded) == before:
            return before == len(ring.names)


def _bounded_by_quadratic(terms: Mapping[tuple[int, ...], fmpq], bounded: set[int]) -> set[int]:
    """The unknowns of a polynomial with a definite quadratic part in those not bounded yet."""
    unknowns = sorted({i for e in terms for i, k in enumerate(e) if k} - bounded)
    second = fmpq_mat(len(unknowns), len(unknowns))
    for e, a in terms.items():
        powers = [(place, e[i]) for place, i in enumerate(unknowns) if e[i]]
        degree = sum(k for _, k in powers)
        if degree > 2 or (degree == 2 and sum(e) > 2):
            return set()
        if degree == 2:
            i, j = powers[0][0], powers[-1][0]
            second[i, j] += a
            second[j, i] += a
    signs = second.charpoly().coeffs()[::-1]
    is_definite = any(all(x * sign**k > 0 for k, x in enumerate(signs)) for sign in (1, -1))
    return set(unknowns) if is_definite else set()


SLACK = fmpq(1, 10**9)
"""Relative size by which an irrational least value may be missed."""
GLANCE = 0.1
"""The part of the time for a proof that a part has nothing better."""
MOST_COORDINATES = 4
"""Most coordinates for which the objective is expanded as a function."""


def _larger_first(a: Size, b: Size) -> int:
    assert a is not None
    assert b is not None
    return (a < b) - (b < a)


class Smallest(Minimisation):
    objective: Objective

    def best(self, values: Sequence[Size]) -> Size:
        return min(x for x in values if x is not None)

    def extent_of(self, best: Size) -> Extent:
        if best == ORIGIN:
            return "all"  # objectives are sums of squares
        assert best is not None
        if self.is_open:
            return "found"
        if self.extent == "all" or (self.extent == "critical-points" and self._is_coercive):
            return "all"
        if not all(self._is_bounded(part, best) for part in self.parts):
            return self.extent
        return "all" if self._is_sharp(best) else "nearly"

    @property
    def _is_coercive(self) -> bool:
        """Whether methods with a value below any bound are in a bounded closed set. Then one of
        them has the least value, and it is a critical point of its part.
        """
        ring = self.design.family.ring
        numbers = self.objective.bounded(self.design.tableau)
        return self._is_closed and are_bounded(ring, numbers, self.step.polynomials)

    @property
    def _is_closed(self) -> bool:
        family = self.design.family
        return not (self.step.nonzero or family.positive or family.stable or family.radicals)

    def _is_bounded(self, part: Part, best: RealRoot) -> bool:
        if part.dimension == 0 or (part.is_free and part.dimension == 1):
            return self.is_settled(part)
        return self._is_above(part, self._bound(best))

    def _is_sharp(self, best: RealRoot) -> bool:
        """Whether a value is rational, and that of a critical point or a limit itself."""
        sharp = [x.value for x in self.candidates if x.proof == "exact"]
        return best.exact is not None and best in [*sharp, *(x.value for x in self.limits)]

    def _bound(self, best: RealRoot) -> fmpq:
        if best.exact is not None and self._is_sharp(best):
            return best.exact
        about = midpoint(best.ball(BITS))
        low = RealRoot.rational(about * (1 - SLACK))
        high = RealRoot.rational(about * (1 - SLACK / 2))
        return between(low, high)

    def is_worse(self, part: Part) -> bool:
        values = [x.value for x in self.candidates]
        if not values or not part.dimension:
            return False
        best = cast("RealRoot", self.best(values))
        if best == ORIGIN:
            return False  # other methods may have the value 0, too
        left = seconds_left()
        with suppress(NotDecided), within(None if left is None else GLANCE * left):
            return self._is_above(part, self._bound(best) * (1 + 3 * SLACK))
        return False

    def _is_above(self, part: Part, bound: fmpq) -> bool:
        numerator, denominator = self._formula(part)
        above = (numerator - denominator * bound) * denominator
        if not part.is_free:
            bounds = [self._is_bounded_on(part, chart, above) for chart in charts(part)]
            return bool(bounds) and all(bounds)
        if kept_sign(above) == 1:
            return True
        allowed = (self._allowed(part, place) for place in range(len(part.ring.names)))
        return any(
            all(kept_sign(above, Along(place, x)) == 1 for x in values)
            for place, values in enumerate(allowed)
            if values is not None
        )

    def _allowed(self, part: Part, place: int) -> tuple[Interval, ...] | None:
        """The values of a coordinate that the conditions on it alone allow; None if it has none."""
        family = self.design.family
        ends = (part.expressed(p, family.ring) for p in not_negative(family))
        signs = [sign_polynomial(x, part.ring) for x in ends]
        alone = [in_one(p, place) for p in signs if unknowns_of(p) == [place]]
        return values_on(part, part.ring.names[place], alone)

    def _is_bounded_on(self, part: Part, chart: RationalChart, above: fmpq_mpoly) -> bool:
        """Whether a polynomial is nowhere negative at the methods of a chart."""
        family, root, place = self.design.family, chart.root, len(chart.names)
        known = chart.one.values
        if not all(is_in(x, known[name], root) for name, x in part.sets if name in known):
            return True  # it has no method
        ring = Parameters([*chart.names, UNIT])
        images = chart.images(part, ring)
        for end in not_negative(family):
            sign = sign_polynomial(part.expressed(end, family.ring), part.ring)
            on_chart = sign.compose(*images, ctx=ring.context)
            is_alone = unknowns_of(on_chart) in ([], [place])
            if is_alone and sign_of(in_one(on_chart, place), root) < 0:
                return True
        there = above.compose(*images, ctx=ring.context)
        point = Interval(root, root, has_start=True, has_end=True)
        return kept_sign(there, Along(place, point)) == 1

    def value_of(self, solution: Solution, index: int) -> Size:
        quotient = self.objective.formula(self.subject(solution.values), None)
        return value_at(quotient.numerator / quotient.denominator, solution.real[index])

    def _formula(self, part: Part) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        quotient = self.objective.formula(self.subject(part.values), part.ring)
        return fraction(part.ring.quotient(quotient.numerator, quotient.denominator), part.ring)

    def over_line(self, part: Part) -> None:
        [name] = part.ring.names
        allowed = self.conditions(part)
        numerator, denominator = self._formula(part)
        N, D = in_one(numerator), in_one(denominator)
        values = on_line(N, D, allowed)
        self.gradients.append((name, values.gradient))
        if not values.gradient:
            for interval in allowed.intervals:
                self._over_interval(part, name, interval)
            return
        for low in values.attained:
            method = Found(part.extended(at_root(name, low.t)), None, (low.t.number,))
            self.candidates.append(Candidate(low.value, method, low.t.number))
        for toward in values.limits:
            self.limits.append(ObjectiveLimit(toward.value, name, toward))

    def _over_interval(self, part: Part, name: str, interval: Interval) -> None:
        if interval.is_point:
            assert interval.start is not None
            root = interval.start
        else:
            root = RealRoot.rational(between(interval.start, interval.end))
        self.add(part.extended(at_root(name, root)), root.number, is_constant=not interval.is_point)

    def over_variety(self, part: Part) -> None:
        """Adds the critical points of a part of larger dimension, and of its edges."""
        if not is_of_one_dimension(part):
            self.extent = "found"
        elif self.extent == "all":
            self.extent = "critical-points"
        try:
            if len(part.ring.names) > MOST_COORDINATES:
                raise NotDecided
            with until(self.share):
                numerator, denominator = self._formula(part)
                self._over_smaller(part, critical_equations(part, numerator, denominator))
        except NotDecided:
            check_time()
            self._by_trial(part)
            return
        for edge in self.edges(part):
            if edge and not edge.is_constant():
                self._over_smaller(part, [edge])

    def _by_trial(self, part: Part) -> None:
        """Adds a good method by trial, or a better one next to a critical point near it."""
        best = self.tried(part, cmp_to_key(_larger_first))
        if best is None:
            return
        chart, point = best
        names = part.ring.names
        numerator, denominator = self._formula(part)
        gradient = gradient_of(numerator, denominator, len(names))
        free = dict(zip(chart.names, point, strict=True))
        zeros = part.equations
        zeros += [
            without_factors(p, denominator)
            for name, p in zip(names, gradient, strict=True)
            if name in free
        ]
        near = [free[x] if x in free else self._about(chart, x) for x in names]
        refined = critical_point_near(near, zeros, [*part.nonzero, denominator], part.ring)
        if refined is not None:
            refined = tuple(x for name, x in zip(names, refined, strict=True) if name in free)
        for coordinates, proof in ((refined, "exists"), (point, "numerical")):
            if coordinates is None:
                continue
            solution = self.at_point(part, chart, coordinates)
            if solution is not None:
                self.add(solution, chart.index, proof=cast("Proof", proof))

    @staticmethod
    def _about(chart: RationalChart, name: str) -> fmpq:
        root = value_at(chart.one.values[name], chart.root)
        return midpoint(root.ball(BITS))

    def _over_smaller(self, part: Part, zeros: list[fmpq_mpoly]) -> None:
        for smaller in parts_within(part, zeros):
            if smaller.dimension < part.dimension:
                self.over(smaller)
                continue
            self._over_constant(smaller)

    def _over_constant(self, part: Part) -> None:
        self.extent = "found"
        names = part.ring.names
        gens = part.ring.context.gens()
        for value in CUTS:
            for chosen in checked(combinations(range(len(names)), part.dimension)):
                cuts = [gens[i] - value for i in chosen]
                before = len(self.candidates)
                for smaller in parts_within(part, cuts):
                    if smaller.dimension == 0:
                        self.over(smaller)
                if len(self.candidates) > before:
                    return
