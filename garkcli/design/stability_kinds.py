"""Kinds of stability of a family of one parameter t: what decides, and what one value has.

A-stability depends on E(x, t) = |Q(iy)|² − |P(iy)|² with x = y² and on where the roots of Q are,
I-stability on the signs of D and of 1 − det M and 1 + det M ± tr M, as polynomials in x = z² and t;
of P-stability 1 − det M is zero.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_mpoly

from garkcli.design.ideal import Ideal
from garkcli.design.member import MOST_DEGREE, TABLEAUS, Whose, member, shares_of
from garkcli.design.solutions import Solution, solutions, value_at
from garkcli.design.step_plane import Line, StepPlane, step_plane
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
from garkcli.tableau.family import OSCILLATING, Family
from garkcli.tableau.tableau import Tableau

_RIGHT = "the linear test equation does not apply: some stages do not depend on every vector field"


MOST_POINTS = 60
"""Values of all unknowns together, with their conjugates, among which those meant are sought."""
BITS = 512
"""Precision of the balls in which a value of |R| above 1 is proved."""
MOST_CONSTANT = 16
"""Roots among the coefficients of a larger degree are not taken."""


class Members(Frozen):
    """The methods of a family of one parameter; roots among its coefficients are numbers."""

    family: Family
    whose: Whose

    @property
    def critical(self) -> tuple[Polynomial, ...] | None:
        """Polynomials between whose roots one value decides on A-stability, if they are known."""
        return None

    def known(self, t: Point) -> bool | None:  # noqa: ARG002 -- slices know some
        """Whether a value is A-stable where that is known without a computation."""
        return None

    @cached_property
    def constants(self) -> Mapping[str, Number] | None:
        """The roots among the coefficients; None where no field that is small enough has them."""
        return self._numbers({}, MOST_CONSTANT) if self.family.radicals else {}

    def at(self, t: Point) -> Tableau | None:
        """The method for a value; None where a weight or a denominator is zero.

        Raises:
            NotDecided: its field is too large.
        """
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
        """The roots among the coefficients and other values as numbers of one field; None where
        that is too large.
        """
        family = self.family
        meant = dict(values)
        for radical in family.radicals:
            if radical.meant is not None:
                meant[radical.name] = radical.meant
        even = [x.name for x in family.radicals if x.is_even]
        zero = RealRoot.rational(ZERO)
        for solution, root in self._conjugates(values):
            at = {key: value_at(x, root) for key, x in solution.values.items()}
            if all(at[x] == y for x, y in meant.items()) and not any(at[x] < zero for x in even):
                u = number_of(root, most)
                if u is None:
                    return None
                elements = solution.values.items()
                return {key: Polynomial.from_flint(poly_of(x))(u) for key, x in elements}
        return None

    def _conjugates(self, values: Mapping[str, RealRoot]) -> Iterator[tuple[Solution, RealRoot]]:
        """The values and roots with all that are conjugate to them."""
        ring = Parameters([*values, *(x.name for x in self.family.radicals)])
        zeros = [x.relation.project_to_context(ring.context) for x in self.family.radicals]
        for name, t in values.items():
            x = ring.context.gen(ring.names.index(name))
            zeros.append(sum((x**k * fmpq(a) for k, a in enumerate(t.polynomial.coeffs())), x * 0))
        ideal = Ideal(ring).with_zeros(zeros)
        if ideal.degree <= MOST_POINTS:
            yield from ((x, root) for x in solutions(ideal) for root in x.real)

    def line(self, tableau: Tableau) -> Line:
        """They, or others made of them, along the parameter.

        Raises:
            NotDecided: the field of the roots among the coefficients is too large.
        """
        if self.constants is None:
            raise NotDecided
        return Line(tableau, self.family.ring, self.constants)

    def plane(self, tableau: Tableau, fields: Sequence[Matrix]) -> StepPlane:
        """Their step for every value."""
        return step_plane(self.line(tableau), fields)


class Slice(Members):
    """The methods over one value of a parameter of two.

    Attributes:
        critical: polynomials that are zero where curves meet the line; None where it is a curve.
        limits: values whose methods are limits of A-stable ones, and so A-stable; of those between
            curves all that are.
    """

    critical: tuple[Polynomial, ...] | None
    limits: tuple[Interval, ...] | None

    def known(self, t: Point) -> bool | None:
        if self.limits is None:
            return None
        if has(self.limits, t):
            return True
        is_between = self.critical and all(sign_of(p, t) for p in self.critical)
        return False if is_between else None


class Kind(ABC):
    """A kind of stability of a family: for each method a set of x ≥ 0 that is to be everything.

    Attributes:
        members: the methods.
        plane: the step of the family.
        signs: polynomials in x and t: where one is negative the method is not stable at x.
        critical: polynomials between whose roots one t decides.
        essential: polynomials of which one is zero where the limit of methods that have it may not
            have it.
        greatest: the bound on x; None where there is none.
    """

    members: Members
    plane: StepPlane
    signs: list[fmpq_mpoly]
    critical: list[Polynomial]
    essential: list[Polynomial]
    greatest: fmpq | None = None

    @abstractmethod
    def holds(self, tableau: Tableau) -> bool:
        """Whether a method has it, by the ordinary engine."""

    @abstractmethod
    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        """The x ≥ 0 at which a method is stable, by the ordinary engine."""

    def decide(self, t: Point) -> bool:
        """Whether the method for a value has it; not where there is none.

        Raises:
            NotDecided: the field of the method is too large.
        """
        tableau = self.members.at(t)
        return tableau is not None and self.holds(tableau)

    def is_refuted(self, t: RealRoot) -> bool:  # noqa: ARG002 -- A-stability sees some
        """Whether the method for a value is seen not to have it, in balls."""
        return False

    def witness(self, t: fmpq) -> fmpq | None:
        """An x at which a condition is violated for a value that has been decided in vain."""
        tableau = self.members.at(t)
        x = None if tableau is None else first_gap(self.stable(tableau))
        is_beyond = x is not None and self.greatest is not None and x > self.greatest
        return None if is_beyond else x

    def conditions(self, x: fmpq) -> list[Polynomial]:
        """Polynomials in t: where one is negative the method is not stable at x."""
        return [self.plane.at_y(p, x) for p in self.signs]


def driven(tableau: Tableau, wanted: str, colour: int | None = None) -> list[Matrix]:
    """The linear problem that a kind of stability is about: y ↦ L^m y for each colour.

    Raises:
        UsageProblem: it has no meaning for the method.
    """
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


class AStability(Kind):
    """|R(z)| ≤ 1 for Re z ≤ 0, of all colours alike or of one alone."""

    def __init__(self, members: Members, tableau: Tableau, colour: int | None = None) -> None:
        self.shares = shares_of(tableau, colour)
        fields = driven(tableau, "a-stable", colour)
        self.members = members
        self.plane = members.plane(tableau, fields)
        self.Q = self.plane.denominator
        self.P = self.plane.numerators[0][0]
        self.signs = [squared_modulus(self.Q) - squared_modulus(self.P)]
        u, v = real_and_imaginary(self.Q)
        self.essential = []
        # a pole at infinity or on the axis, another degree of R, other lowest terms
        self.critical = list(members.critical or ())
        if members.critical is None:
            self.critical = [
                *self.plane.projected(self.signs, [ZERO]),
                *(self.plane.in_t(projection.leading(p)) for p in (self.Q, self.P)),
                *self.plane.meeting(u, v),
                *self.plane.meeting(self.P, self.Q),
            ]

    def holds(self, tableau: Tableau) -> bool:
        return is_a_stable(stability_function(tableau, self.shares))

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return imaginary_set(stability_function(tableau, self.shares))

    def is_refuted(self, t: RealRoot) -> bool:
        """Whether |P| > |Q| for a simple z, Re z ≤ 0."""
        with ctx.workprec(BITS):
            P, Q = (
                [a.enclosed_at(t.ball(BITS)) for a in self.plane.coefficients(p)]
                for p in (self.P, self.Q)
            )
            sizes = [arb(0), *(arb(fmpq(4) ** k) for k in range(-6, 7))]
            points = [acb(-x, z) for x in sizes for z in sizes]
            with suppress(ValueError):  # multiple roots
                # next to a pole too
                near = acb_poly([x.mid() for x in Q]).roots()
                points += [z.mid() for z in near if z.real < 0]
            return any(abs(value(P, z)) > abs(value(Q, z)) for z in points)

    def is_damped(self, t: Point) -> bool:
        """Whether R(∞) = 0; common factors of P and Q change both degrees alike."""
        return self._degree_at(self.P, t) < self._degree_at(self.Q, t)

    def _degree_at(self, p: fmpq_mpoly, t: Point) -> int:
        """The degree in y of p(y, t)."""
        coefficients = self.plane.coefficients(p)
        return max((k for k, a in enumerate(coefficients) if sign_of(a, t)), default=-1)


class IStability(Kind):
    """All powers of the step matrix on the oscillator are bounded for every step size."""

    def __init__(self, members: Members, tableau: Tableau) -> None:
        self.members = members
        self.problem = Oscillator.default(terms_of(tableau), fmpq(1))
        self.plane = members.plane(tableau, driven(tableau, "i-stable"))
        self.signs, others = oscillator_curves(self.plane)
        poles = in_square(self.plane.denominator)
        self.essential = self.plane.projected([poles, *self.signs], [ZERO])
        self.critical = self.plane.projected([*self.signs, *others], [ZERO])

    def holds(self, tableau: Tableau) -> bool:
        return oscillator_stability(tableau, self.problem).is_i_stable

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return oscillator_stability(tableau, self.problem).stable


def oscillator_curves(plane: StepPlane) -> tuple[list[fmpq_mpoly], list[fmpq_mpoly]]:
    """What decides on the oscillator, in x = z² and t.

    Returns:
        the conditions on the eigenvalues, not negative where they are bounded; the denominator, the
        trace, the determinant and the entries off the diagonal, as far as they vanish.
    """
    D = plane.denominator
    (a, b), (c, d) = plane.numerators
    # b and c are odd in z, all others even
    z, *_ = D.context().gens()
    others = [D, a + d, a * d - b * c, z * b, z * c]
    conditions = eigenvalue_conditions(D, a, b, c, d)
    return list(map(in_square, conditions)), list(map(in_square, others))


def first_gap(intervals: Sequence[Interval]) -> fmpq | None:
    """A rational x ≥ 0 in the first open gap of a set of intervals; None where there is none."""
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
    """Which springs are meant.

    Attributes:
        slow: (hω_s)² ≥ 0.
        fast: the term of the fast spring, counted from 0.
        greatest: the bound on x = (hω_f)²; None where there is none.
    """

    slow: fmpq
    fast: int
    greatest: fmpq | None = None


class SpringStability(Kind):
    """All powers of the step matrix on a slow and a fast spring are bounded for all fast
    frequencies: for one slow frequency the step is a function of x = (hω_f)² and of t.
    """

    def __init__(self, members: Members, tableau: Tableau, wanted: TwoSprings) -> None:
        self.members = members
        self.greatest = wanted.greatest
        self.slow = wanted.slow
        split = self.split = springs(tableau, wanted.fast)
        self.plane = StepPlane.of(
            members.line(tableau),
            unknowns_of(tableau, split),
            lambda method: line_of_determinants(method, split, wanted.slow),
        )
        D = self.plane.denominator
        (a, b), (c, d) = self.plane.numerators
        self.signs = eigenvalue_conditions(D, a, b, c, d)
        ends = [x for x in (ZERO, wanted.greatest) if x is not None]
        self.essential = self.plane.projected([D, *self.signs], ends)
        deciding = [*self.signs, D, a + d, a * d - b * c, b, c]
        self.critical = self.plane.projected(deciding, ends)

    def holds(self, tableau: Tableau) -> bool:
        found = self.stable(tableau)
        if self.greatest is None:
            return first_end(found) is None and found[0].has_start
        ends = RealRoot.rational(ZERO), RealRoot.rational(self.greatest)
        return any(contains(x, *ends) for x in found)

    def stable(self, tableau: Tableau) -> tuple[Interval, ...]:
        return two_frequencies(tableau, self.split, self.slow).stable
