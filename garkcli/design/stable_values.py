"""For which values of its parameter a family is P-stable, A-stable or L-stable: the exact set.

What decides are signs of polynomials in the parameter t and in x, the square of hω or of the
imaginary part y. Between the critical t of ``garkcli.exact.projection`` nothing changes, so that
one rational t decides by the ordinary engine. A critical t is decided by itself:

* where some x is known for which a condition is violated at t, by the sign of a polynomial in t;
* A-stability at the end of an interval of it: |P| ≤ |Q| on the imaginary axis and poles that are
  not in the left half plane are kept in the limit, and a pole that moves onto the axis would
  contradict the first unless it cancels;
* P-stability at the end of an interval of it where the zeros of D and of the three conditions on
  the eigenvalues stay as they are: no pole and no double eigenvalue appears;
* otherwise by the ordinary engine over ℚ(t).

P-stability often holds at isolated points, which no sampling finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.design.design import TABLEAUS, Whose
from garkcli.design.member import member
from garkcli.design.step_plane import StepPlane, step_plane
from garkcli.errors import UsageProblem, ZeroWeight
from garkcli.exact.cells import Interval, Point, between, sign_of, where
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import (
    PLANE,
    at_y,
    coefficient_of,
    curves,
    in_t,
    leading,
    projected,
)
from garkcli.exact.root_number import number_of
from garkcli.exact.roots import RealRoot, sign_at
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.linear import (
    imaginary_set,
    is_a_stable,
    stability_function,
)
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau

Wanted: TypeAlias = Literal["p-stable", "a-stable", "l-stable"]

MOST_DEGREE = 6
"""Critical values of a larger degree are not decided over their number field."""
_RIGHT = "the linear test equation has no meaning for it: some stages do not see every vector field"


@dataclass(frozen=True)
class StableValues:
    """The values of a parameter for which a family has a kind of stability.

    Attributes:
        family: as it was read.
        whose: which method is meant.
        wanted: which stability.
        found: the set, in ascending order; points of ``undecided`` are not in it.
        undecided: single values that are left open.
    """

    family: Family
    whose: Whose
    wanted: Wanted
    found: tuple[Interval, ...]
    undecided: tuple[RealRoot, ...]

    @property
    def parameter(self) -> str:
        """The name of the parameter."""
        return self.family.parameters[0]

    @property
    def is_everything(self) -> bool:
        """Whether every real number belongs to it."""
        if len(self.found) != 1:
            return False
        return self.found[0].start is None and self.found[0].end is None


def stable_values(
    family: Family, wanted: Wanted, whose: Whose = "method"
) -> StableValues:
    """The set of values of the one free parameter.

    Args:
        family: of methods, with one free parameter and rational coefficients otherwise.
        wanted: P-stability on the oscillator that is split as usual, A-stability or L-stability
            with all vector fields equal.
        whose: of the method, its symplectic conjugate, or its symplectic pair.

    Raises:
        UsageProblem: the stability has no meaning for the method, there are several parameters, or
            coefficients are irrational.
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
    """
    _refuse_others(family)
    tableau = TABLEAUS[whose](family.tableau)
    members = _Members(family, whose)
    if wanted == "p-stable":
        found, undecided = _decided(family, _PStability(members, tableau))
        return StableValues(family, whose, wanted, found, undecided)
    kind = _AStability(members, tableau)
    found, undecided = _decided(family, kind)
    if wanted == "l-stable":
        found = _damped(kind, found)
        undecided = tuple(t for t in undecided if kind.is_damped(t))
    return StableValues(family, whose, wanted, found, undecided)


def _decided(
    family: Family, kind: _Kind
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The set, and the values that are left open."""
    decision = _Decision(family, kind)
    found = decision.run()
    undecided = tuple(decision.undecided)
    kept = [x for x in found if not (x.is_point and x.start in undecided)]
    return tuple(_trimmed(interval, undecided) for interval in kept), undecided


def _damped(kind: _AStability, found: Sequence[Interval]) -> tuple[Interval, ...]:
    """The values out of a set with R(∞) = 0."""
    critical = list(kind.critical)
    for interval in found:
        ends = [end for end in (interval.start, interval.end) if end is not None]
        critical += [Polynomial.from_flint(end.polynomial) for end in ends]
    return where(lambda t: _holds_at(found, t) and kind.is_damped(t), critical)


def _refuse_others(family: Family) -> None:
    name, *others = family.parameters
    if others:
        raise UsageProblem(
            f"there are {1 + len(others)} free parameters, and the set of one is found",
            f"give values to all but one, such as --set {others[-1]}=1/2",
        )
    if family.radicals:
        raise UsageProblem(
            f"there are roots among the coefficients, beside {name}",
            "write the method as a family by name, whose nodes are not needed",
        )


def _trimmed(interval: Interval, undecided: Sequence[RealRoot]) -> Interval:
    """An interval without those of its ends that are not decided."""
    return Interval(
        interval.start,
        interval.end,
        interval.has_start and interval.start not in undecided,
        interval.has_end and interval.end not in undecided,
    )


@dataclass(frozen=True)
class _Members:
    """The methods of a family."""

    family: Family
    whose: Whose

    def at(self, value: Number) -> Tableau | None:
        """The method for a value; None where a weight or a denominator is zero."""
        family = self.family
        try:
            tableau = member(family.tableau, family.ring, {family.ring.names[0]: value})
            return TABLEAUS[self.whose](tableau)
        except (ZeroDivisionError, ZeroWeight):
            return None


class _Kind(Protocol):
    """A kind of stability of a family.

    Attributes:
        plane: the step of the family.
        critical: polynomials between whose roots one t decides.
        essential: polynomials of which one is zero where the limit of methods that have it may not
            have it.
    """

    plane: StepPlane
    critical: list[Polynomial]
    essential: list[Polynomial]

    def __init__(self, members: _Members, tableau: Tableau) -> None: ...

    def decide(self, value: Number) -> bool:
        """By the ordinary engine."""

    def witness(self, value: fmpq) -> fmpq | None:
        """An x at which a condition is violated for a value that has been decided in vain."""

    def conditions(self, x: fmpq) -> list[Polynomial]:
        """Polynomials in t: where one is negative the method is not stable at x."""


class _AStability:
    """|R(z)| ≤ 1 for Re z ≤ 0."""

    def __init__(self, members: _Members, tableau: Tableau) -> None:
        colours, spaces = range(tableau.size), range(len(tableau.spaces))
        is_complete = all((k, m) in tableau.blocks for k in spaces for m in colours)
        if tableau.is_partitioned or not is_complete:
            raise UsageProblem(_RIGHT, "ask for --p-stable")
        self.members = members
        fields: list[Matrix] = [((ONE,),)] * tableau.size
        self.plane = step_plane(tableau, members.family.ring, fields)
        self.Q = self.plane.denominator
        self.P = self.plane.numerators[0][0]
        self.E = _squared_modulus(self.Q) - _squared_modulus(self.P)
        u, v = _real_and_imaginary(self.Q)
        self.essential: list[Polynomial] = []
        self.critical = projected(curves([self.E]), [ZERO])
        # a pole at infinity or on the axis, another degree of R, other lowest terms
        self.critical += [in_t(leading(self.Q)), in_t(leading(self.P))]
        self.critical += [
            in_t(u.resultant(v, "y")),
            in_t(self.P.resultant(self.Q, "y")),
        ]

    def decide(self, value: Number) -> bool:
        tableau = self.members.at(value)
        return tableau is not None and is_a_stable(stability_function(tableau))

    def witness(self, value: fmpq) -> fmpq | None:
        tableau = self.members.at(value)
        if tableau is None:
            return None
        found = imaginary_set(stability_function(tableau))
        return _first_gap(found)

    def conditions(self, x: fmpq) -> list[Polynomial]:
        return [at_y(self.E, x)]

    def is_damped(self, t: Point) -> bool:
        """Whether R(∞) = 0; common factors of P and Q change both degrees alike."""
        return _degree_at(self.P, t) < _degree_at(self.Q, t)


class _PStability:
    """All powers of the step matrix on the oscillator are bounded for every step size."""

    def __init__(self, members: _Members, tableau: Tableau) -> None:
        self.members = members
        self.problem = Oscillator.default(terms_of(tableau), fmpq(1))
        check_structure(tableau, self.problem)
        fields = [self.problem.matrix(colour) for colour in tableau.colours]
        self.plane = step_plane(tableau, members.family.ring, fields)
        (a, b), (c, d) = self.plane.numerators
        whole = self.plane.denominator**2
        trace, area = (a + d) * self.plane.denominator, a * d - b * c
        # b and c are odd in z, all others even
        self.signs = [
            _in_square(p)
            for p in (whole - area, whole + area - trace, whole + area + trace)
        ]
        z, _ = PLANE.gens()
        D = _in_square(self.plane.denominator)
        self.essential = projected(curves([D, *self.signs]), [ZERO])
        others = [self.plane.denominator, a + d, area, z * b, z * c]
        deciding = [*self.signs, *map(_in_square, others)]
        self.critical = projected(curves(deciding), [ZERO])

    def decide(self, value: Number) -> bool:
        tableau = self.members.at(value)
        if tableau is None:
            return False
        return oscillator_stability(tableau, self.problem).is_p_stable

    def witness(self, value: fmpq) -> fmpq | None:
        tableau = self.members.at(value)
        if tableau is None:
            return None
        return _first_gap(oscillator_stability(tableau, self.problem).stable)

    def conditions(self, x: fmpq) -> list[Polynomial]:
        return [at_y(p, x) for p in self.signs]


class _Decision:
    """One decomposition of the line of a parameter."""

    def __init__(self, family: Family, kind: _Kind) -> None:
        (ends,) = family.ranges.values()
        self.ends = ends
        self.kind = kind
        self.undecided: list[RealRoot] = []
        self._known: dict[str, bool] = {}
        self._witnesses: list[fmpq] = []
        self._inside: tuple[Interval, ...] = ()

    def run(self) -> tuple[Interval, ...]:
        """The set; open intervals first, as they tell about their ends."""
        at_ends = [Polynomial([-end, 1]) for end in self.ends if end is not None]
        poles = [p for p in self.kind.plane.poles if p.degree > 0]
        critical = [p.square_free() for p in self.kind.critical if p.degree > 0]
        critical += at_ends + poles
        self._inside = where(self._holds_between, critical)
        return where(self._holds, critical)

    def _holds_between(self, t: Point) -> bool:
        return not isinstance(t, RealRoot) and self._at_rational(t)

    def _holds(self, t: Point) -> bool:
        if not isinstance(t, RealRoot):
            return self._at_rational(t)
        return self._at_rational(t.exact) if t.exact is not None else self._at_root(t)

    def _is_outside(self, t: Point) -> bool:
        least, greatest = self.ends
        below = least is not None and sign_of(Polynomial([-least, 1]), t) < 0
        above = greatest is not None and sign_of(Polynomial([-greatest, 1]), t) > 0
        return below or above

    def _at_rational(self, t: fmpq) -> bool:
        if self._is_outside(t):
            return False
        key = str(t)
        if key not in self._known:
            self._known[key] = self.kind.decide(t)
            if not self._known[key]:
                witness = self.kind.witness(t)
                if witness is not None and witness not in self._witnesses:
                    self._witnesses.append(witness)
        return self._known[key]

    def _at_root(self, t: RealRoot) -> bool:
        if self._is_outside(t) or any(not sign_at(p, t) for p in self.kind.plane.poles):
            return False
        for x in self._witnesses:
            if any(sign_at(p, t) < 0 for p in self.kind.conditions(x)):
                return False
        is_limit = any(t in (x.start, x.end) for x in self._inside)
        if is_limit and all(sign_at(p, t) for p in self.kind.essential):
            return True
        number = number_of(t, MOST_DEGREE)
        if number is None:
            self.undecided.append(t)
            return True
        return self.kind.decide(number)


def _holds_at(intervals: Sequence[Interval], t: Point) -> bool:
    """Whether a number belongs to a set."""
    root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
    for interval in intervals:
        start, end = interval.start, interval.end
        behind = start is None or start < root or (interval.has_start and start == root)
        before = end is None or root < end or (interval.has_end and end == root)
        if behind and before:
            return True
    return False


def _first_gap(intervals: Sequence[Interval]) -> fmpq | None:
    """A rational x ≥ 0 in the first open gap of a set of intervals; None where there is none."""
    end: RealRoot | None = RealRoot.rational(ZERO)
    for interval in intervals:
        assert end is not None
        assert interval.start is not None
        if end < interval.start:
            return between(end, interval.start)
        end = interval.end
    return None if end is None else between(end, None)


def _degree_at(p: fmpq_mpoly, t: Point) -> int:
    """The degree in y of p(y, t)."""
    for k in range(p.degrees()[0], -1, -1):
        coefficient = in_t(coefficient_of(p, k))
        if sign_of(coefficient, t):
            return k
    return -1


def _real_and_imaginary(p: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """The polynomials u and v in x = y² with p(iy) = u(y²) + i y v(y²)."""
    parts: tuple[dict[tuple[int, ...], fmpq], ...] = ({}, {})
    for (j, k), a in p.to_dict().items():
        sign = -1 if j % 4 in {2, 3} else 1
        parts[j % 2][j // 2, k] = a * sign
    return PLANE.from_dict(parts[0]), PLANE.from_dict(parts[1])


def _squared_modulus(p: fmpq_mpoly) -> fmpq_mpoly:
    """|p(iy)|² in x = y²."""
    u, v = _real_and_imaginary(p)
    x, _ = PLANE.gens()
    return u * u + x * v * v


def _in_square(p: fmpq_mpoly) -> fmpq_mpoly:
    """A polynomial with even powers of z only, in x = z²."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for (j, k), a in p.to_dict().items():
        assert j % 2 == 0
        terms[j // 2, k] = a
    return PLANE.from_dict(terms)
