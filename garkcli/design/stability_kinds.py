"""Kinds of stability of a family in one or two parameters, and decisions for one value t.

A-stability depends on E(x, t) = |Q(iy)|² − |P(iy)|² with x = y² and on the roots of Q, I-stability
on the signs of D and of 1 − det M and 1 + det M ± tr M, as polynomials in x = z² and t; of
P-stability 1 − det M is zero.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import Any, ClassVar

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_mpoly

from garkcli.design.family_step import FamilyStep, Flat, family_step
from garkcli.design.ideal import Ideal
from garkcli.design.member import MOST_DEGREE, TABLEAUS, Whose, member, restricted, shares_of
from garkcli.design.solutions import Solution, solutions, value_at
from garkcli.errors import NotDecided, UsageProblem, ZeroWeight
from garkcli.exact import projection
from garkcli.exact.cells import Interval, Point, between, contains, first_end, has, sign_of
from garkcli.exact.enclosing import value
from garkcli.exact.field import ZERO, Number, poly_of
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, number_of
from garkcli.frozen import Frozen
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.linear import imaginary_set, is_a_stable, stability_function
from garkcli.stability.oscillator import oscillator_stability
from garkcli.stability.two_frequencies import (
    eigenvalue_conditions,
    line_of_determinants,
    springs,
    two_frequencies,
    unknowns_of,
)
from garkcli.tableau.family import OSCILLATING, Family, Radical
from garkcli.tableau.tableau import Tableau

_RIGHT = "the linear test equation does not apply: some stages do not depend on every vector field"


MOST_POINTS = 60
"""Most values of all unknowns together, with their conjugates."""
BITS = 512
"""Precision of the balls in which a value of |R| above 1 is proved."""
MOST_CONSTANT = 16
"""Largest degree of roots among the coefficients."""


class Members(Frozen):
    family: Family
    whose: Whose

    @property
    def critical(self) -> tuple[Polynomial, ...] | None:
        """Polynomials between whose roots one value decides, if known."""
        return None

    def known(self, t: Point, is_closed: bool) -> bool | None:  # noqa: ARG002 -- slices know some
        """Whether t is stable, if known; ``is_closed``: limits of stable methods are stable."""
        return None

    @cached_property
    def constants(self) -> Mapping[str, Number] | None:
        """The roots among the coefficients; None if their field is too large."""
        return self._numbers({}, MOST_CONSTANT) if self.family.radicals else {}

    def at(self, t: Point) -> Tableau | None:
        """The method at a value; None if there is none, NotDecided if its field is too large."""
        rational = t.exact if isinstance(t, RealRoot) else t
        [name] = self.family.parameters
        if rational is None:
            assert isinstance(t, RealRoot)
            numbers = self._numbers({name: t}, MOST_DEGREE)
        else:
            numbers = None if self.constants is None else {name: rational, **self.constants}
        if numbers is None:
            raise NotDecided
        family = self.family
        try:
            return TABLEAUS[self.whose](member(family.tableau, family.ring, numbers))
        except (ZeroDivisionError, ZeroWeight):
            return None

    def _numbers(self, values: Mapping[str, RealRoot], most: int) -> dict[str, Number] | None:
        family = self.family
        required = dict(values)
        for radical in family.radicals:
            if radical.meant is not None:
                required[radical.name] = radical.meant
        even = [x.name for x in family.radicals if x.is_even]
        zero = RealRoot.rational(ZERO)
        for solution, root in self._conjugates(values):
            at = {key: value_at(x, root) for key, x in solution.values.items()}
            if all(at[x] == y for x, y in required.items()) and not any(at[x] < zero for x in even):
                u = number_of(root, most)
                if u is None:
                    return None
                elements = solution.values.items()
                return {key: Polynomial.from_flint(poly_of(x))(u) for key, x in elements}
        return None

    def _conjugates(self, values: Mapping[str, RealRoot]) -> Iterator[tuple[Solution, RealRoot]]:
        ring = Parameters([*values, *(x.name for x in self.family.radicals)])
        zeros = [x.relation.project_to_context(ring.context) for x in self.family.radicals]
        for name, t in values.items():
            x = ring.context.gen(ring.names.index(name))
            zeros.append(sum((x**k * fmpq(a) for k, a in enumerate(t.polynomial.coeffs())), x * 0))
        ideal = Ideal(ring).with_zeros(zeros)
        if ideal.degree <= MOST_POINTS:
            yield from ((x, root) for x in solutions(ideal) for root in x.real)

    def flat(self, tableau: Tableau) -> Flat:
        """The methods in the parameters; NotDecided if the field of the roots among the
        coefficients is too large.
        """
        if self.constants is None:
            raise NotDecided
        return Flat(tableau, self.family.ring, self.constants)

    def step(self, tableau: Tableau, fields: Sequence[Matrix]) -> FamilyStep:
        return family_step(self.flat(tableau), fields)

    def over(
        self, t: Point, critical: tuple[Polynomial, ...] | None, limits: tuple[Interval, ...] | None
    ) -> Slice:
        """The methods in two parameters at one value of the first. An irrational value is one more
        root among the coefficients.
        """
        family = self.family
        first, second = family.parameters
        radicals = [*family.radicals]
        rational = t.exact if isinstance(t, RealRoot) else t
        if rational is None:
            assert isinstance(t, RealRoot)
            radicals.append(Radical.of(first, t))
        ring = Parameters([second, *(x.name for x in radicals)])
        values: dict[str, Any] = {name: ring.parameter(name) for name in ring.names}
        values.setdefault(first, rational)
        line = restricted(family, ring, values, [second], radicals)
        return Slice(line, self.whose, critical, limits)


class Slice(Members):
    """The methods of a family in two parameters at one value of the first.

    ``critical`` polynomials vanish where curves meet the line; None if a curve contains it. Methods
    at ``limits`` are limits of stable ones. Where at most one curve meets the line, and crosses it
    once, nothing changes along the curve: there these are all stable values.
    """

    critical: tuple[Polynomial, ...] | None
    limits: tuple[Interval, ...] | None

    def known(self, t: Point, is_closed: bool) -> bool | None:
        if self.limits is None:
            return None
        is_limit = has(self.limits, t)
        if self.critical is not None:
            meeting = [p for p in self.critical if sign_of(p, t) == 0]
            if not meeting or (len(meeting) == 1 and sign_of(meeting[0].derivative(), t)):
                return is_limit
        return True if is_closed and is_limit else None


class StabilityKind(ABC):
    """A method is stable at every x ≥ 0, and perhaps meets another condition, as R(∞) = 0.

    Attributes:
        signs: polynomials in x and the parameters: if one is negative the method is unstable at x.
        narrowing: polynomials in the parameters whose zeros decide the condition besides.
        greatest: the bound on x; None if there is none.
        is_closed: whether limits of stable methods are stable.
    """

    members: Members
    step: FamilyStep
    signs: list[fmpq_mpoly]
    narrowing: list[fmpq_mpoly]
    greatest: fmpq | None = None
    is_closed: ClassVar[bool] = False

    @property
    @abstractmethod
    def deciding(self) -> list[fmpq_mpoly]:
        """Polynomials in the parameters between whose zeros one method decides."""

    @property
    def essential(self) -> list[fmpq_mpoly]:
        """Polynomials in t; at their zeros a limit of stable methods may be unstable."""
        return []

    @abstractmethod
    def holds(self, tableau: Tableau) -> bool:
        """Whether a method has it, by the engine for one method."""

    @abstractmethod
    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        """The x ≥ 0 at which a method is stable, by the engine for one method."""

    def keeps(self, t: Point) -> bool:
        """Whether a value meets the condition besides: the narrowing polynomials vanish."""
        return all(sign_of(self.step.in_t(p), t) == 0 for p in self.narrowing)

    def decide(self, t: Point) -> bool:
        """Whether the method at t has it; False if there is none. Raises NotDecided."""
        tableau = self.members.at(t)
        return tableau is not None and self.holds(tableau)

    def is_refuted(self, t: RealRoot) -> bool:  # noqa: ARG002 -- A-stability sees some
        """Whether an enclosure shows that the method at a value does not have it."""
        return False

    def witness(self, t: fmpq) -> fmpq | None:
        """An x at which the method at a value is unstable; None if none is found."""
        tableau = self.members.at(t)
        x = None if tableau is None else first_gap(self.stable(tableau))
        is_beyond = x is not None and self.greatest is not None and x > self.greatest
        return None if is_beyond else x

    def conditions(self, x: fmpq) -> list[Polynomial]:
        """Polynomials in t: if one is negative the method is not stable at x."""
        return [self.step.at_y(p, x) for p in self.signs]


def driven(tableau: Tableau, wanted: str, colour: int | None = None) -> list[Matrix]:
    """The linear problem of a stability, y ↦ L^m y for each colour; raises UsageProblem."""
    if wanted in OSCILLATING:
        problem = Oscillator.default(terms_of(tableau), fmpq(1))
        check_structure(tableau, problem)
        return [problem.matrix(colour) for colour in tableau.colours]
    if colour is None:
        colours, spaces = list(range(tableau.size)), list(range(len(tableau.spaces)))
    else:
        colours, spaces = [colour], [tableau.colours[colour].space]
    is_complete = all((k, m) in tableau.blocks for k in spaces for m in colours)
    if tableau.is_partitioned or not is_complete:
        raise UsageProblem(_RIGHT, "ask for --i-stable", code="wanted-without-meaning")
    return [((share,),) for share in shares_of(tableau, colour)]


class AStability(StabilityKind):
    """|R(z)| ≤ 1 for Re z ≤ 0; of L-stability R(∞) = 0 besides."""

    is_closed = True  # |P| ≤ |Q| on the left half plane, with continuous coefficients

    def __init__(
        self, members: Members, tableau: Tableau, colour: int | None = None, is_damped: bool = False
    ) -> None:
        self.shares = shares_of(tableau, colour)
        fields = driven(tableau, "a-stable", colour)
        self.members = members
        self.step = members.step(tableau, fields)
        self.Q = self.step.denominator
        self.P = self.step.numerators[0][0]
        self.signs = [squared_modulus(self.Q) - squared_modulus(self.P)]
        coefficients = self.step.coefficients
        self.narrowing = [*coefficients(self.P), *coefficients(self.Q)] if is_damped else []

    @property
    def deciding(self) -> list[fmpq_mpoly]:
        # a pole at infinity or on the axis, another degree of R, other lowest terms
        return [
            *self.step.seen(self.signs, [ZERO]),
            *map(projection.leading, (self.Q, self.P)),
            *self.step.meeting(*real_and_imaginary(self.Q)),
            *self.step.meeting(self.P, self.Q),
        ]

    def holds(self, tableau: Tableau) -> bool:
        return is_a_stable(stability_function(tableau, self.shares))

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return imaginary_set(stability_function(tableau, self.shares))

    def is_refuted(self, t: RealRoot) -> bool:
        """Whether |P| > |Q| is proved at one of a few z with Re z ≤ 0."""
        with ctx.workprec(BITS):
            P, Q = (
                [self.step.in_t(a).enclosed_at(t.ball(BITS)) for a in self.step.coefficients(p)]
                for p in (self.P, self.Q)
            )
            sizes = [arb(0), *(arb(fmpq(4) ** k) for k in range(-6, 7))]
            points = [acb(-x, z) for x in sizes for z in sizes]
            with suppress(ValueError):  # multiple roots
                # points near poles
                near = acb_poly([x.mid() for x in Q]).roots()
                points += [z.mid() for z in near if z.real < 0]
            return any(abs(value(P, z)) > abs(value(Q, z)) for z in points)

    def keeps(self, t: Point) -> bool:
        """Whether R(∞) = 0 if wanted; a common factor of P and Q lowers both degrees equally."""
        return not self.narrowing or self._degree_at(self.P, t) < self._degree_at(self.Q, t)

    def _degree_at(self, p: fmpq_mpoly, t: Point) -> int:
        coefficients = map(self.step.in_t, self.step.coefficients(p))
        return max((k for k, a in enumerate(coefficients) if sign_of(a, t)), default=-1)


class Oscillating(StabilityKind):
    """All powers of the step on an oscillator are bounded; of P-stability det M = 1 besides.
    ``poles`` is the denominator of the step; zeros of ``others`` count too.
    """

    poles: fmpq_mpoly
    others: list[fmpq_mpoly]

    @property
    def ends(self) -> list[fmpq]:
        return [x for x in (ZERO, self.greatest) if x is not None]

    @property
    def deciding(self) -> list[fmpq_mpoly]:
        return self.step.seen([*self.signs, *self.others], self.ends)

    @property
    def essential(self) -> list[fmpq_mpoly]:
        return self.step.seen([self.poles, *self.signs], self.ends)

    def narrowed(self, is_conservative: bool) -> list[fmpq_mpoly]:
        """The coefficients of 1 − det M, times D², if they are wanted to vanish."""
        return self.step.coefficients(self.signs[0]) if is_conservative else []


class IStability(Oscillating):
    def __init__(self, members: Members, tableau: Tableau, is_conservative: bool = False) -> None:
        self.members = members
        self.problem = Oscillator.default(terms_of(tableau), fmpq(1))
        self.step = members.step(tableau, driven(tableau, "i-stable"))
        self.signs, self.others = oscillator_curves(self.step)
        self.poles = in_square(self.step.denominator)
        self.narrowing = self.narrowed(is_conservative)

    def holds(self, tableau: Tableau) -> bool:
        return oscillator_stability(tableau, self.problem).is_i_stable

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return oscillator_stability(tableau, self.problem).stable


def oscillator_curves(step: FamilyStep) -> tuple[list[fmpq_mpoly], list[fmpq_mpoly]]:
    """The curves that decide on the oscillator, in x = z² and t. First conditions on the
    eigenvalues, not negative if these are bounded; then D, the trace, the determinant and the
    off-diagonal entries, whose zeros count.
    """
    D = step.denominator
    (a, b), (c, d) = step.numerators
    # b and c are odd in z, all others even
    z, *_ = D.context().gens()
    others = [D, a + d, a * d - b * c, z * b, z * c]
    conditions = eigenvalue_conditions(D, a, b, c, d)
    return list(map(in_square, conditions)), list(map(in_square, others))


def first_gap(intervals: Sequence[Interval]) -> fmpq | None:
    """A rational x ≥ 0 in the first open gap between intervals; None if there is none."""
    end: RealRoot | None = RealRoot.rational(ZERO)
    for interval in intervals:
        assert end is not None
        assert interval.start is not None
        if end < interval.start:
            return between(end, interval.start)
        end = interval.end
    return None if end is None else between(end, None)


def real_and_imaginary(p: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """The polynomials u and v in x = y² with p(iy) = u(y²) + i y v(y²); y is the first unknown."""
    parts: tuple[dict[tuple[int, ...], fmpq], ...] = {}, {}
    for (j, *others), a in p.to_dict().items():
        # i⁰, i¹, i², i³ = 1, i, −1, −i
        parts[j % 2][int(j) // 2, *map(int, others)] = -a if j % 4 in {2, 3} else a
    u, v = map(p.context().from_dict, parts)
    return u, v


def squared_modulus(p: fmpq_mpoly) -> fmpq_mpoly:
    """|p(iy)|² in x = y²."""
    u, v = real_and_imaginary(p)
    x, *_ = p.context().gens()
    return u * u + x * v * v


def in_square(p: fmpq_mpoly) -> fmpq_mpoly:
    """A polynomial with even powers of z only, in x = z²."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for (j, *others), a in p.to_dict().items():
        assert j % 2 == 0
        terms[int(j) // 2, *map(int, others)] = a
    return p.context().from_dict(terms)


class TwoSprings(Frozen):
    """A slow and a fast spring, by its term; ``greatest`` bounds x = (hω_f)² unless None."""

    slow: fmpq
    fast: int
    greatest: fmpq | None = None


class SpringStability(Oscillating):
    """I- and P-stability on two springs for all fast frequencies, at one slow one. The step is a
    function of x = (hω_f)² and the parameters.
    """

    def __init__(
        self, members: Members, tableau: Tableau, wanted: TwoSprings, is_conservative: bool = False
    ) -> None:
        self.members = members
        self.greatest = wanted.greatest
        self.slow = wanted.slow
        split = self.split = springs(tableau, wanted.fast)
        self.step = FamilyStep.of(
            members.flat(tableau),
            unknowns_of(tableau, split),
            lambda method: line_of_determinants(method, split, wanted.slow),
        )
        D = self.poles = self.step.denominator
        (a, b), (c, d) = self.step.numerators
        self.signs = eigenvalue_conditions(D, a, b, c, d)
        self.others = [D, a + d, a * d - b * c, b, c]
        self.narrowing = self.narrowed(is_conservative)

    def holds(self, tableau: Tableau) -> bool:
        stable = self.stable(tableau)
        if self.greatest is None:
            return first_end(stable) is None and stable[0].has_start
        ends = RealRoot.rational(ZERO), RealRoot.rational(self.greatest)
        return any(contains(x, *ends) for x in stable)

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return two_frequencies(tableau, self.split, self.slow).stable
