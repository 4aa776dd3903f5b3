"""The exact set of values of one or two parameters for which a family is P-, I-, A- or L-stable.

Signs of polynomials decide, in the parameters and in x, the square of hω or of the imaginary part
y. Between the zeros of a projection (``garkcli.exact.projection``) nothing changes. So a set in one
parameter t is a function on the cells of a line with values true and false, and one in two
parameters is a function of the first whose values are sets in the second, with ends on curves: one
rational point decides for an open cell, by the engine for one method or by the set on a line.

A critical t of the line is decided on its own:

* by the sign of a polynomial in t, if an x is known at which a condition is violated at t;
* A-stability beside an A-stable interval: |P| ≤ |Q| on the imaginary axis and poles that are not in
  the left half plane are kept in the limit, and a pole that moves onto the axis would contradict
  the first unless it cancels;
* I-stability beside an I-stable interval if the zeros of D and of the three conditions on the
  eigenvalues do not change: no pole and no double eigenvalue appears;
* otherwise by the engine for one method over ℚ(t), with the roots among the coefficients.

Over a critical t of the plane the line is one over ℚ(t), cut where curves meet it; it knows the
limits from both sides. An I-stable value is P-stable if all coefficients of 1 − det M in x vanish,
an A-stable one L-stable if R(∞) = 0. Both often hold at isolated points, which no sampling finds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import Any

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design import stability_kinds
from garkcli.design.fewer import LinearForm, fewest
from garkcli.design.member import TABLEAUS, Whose
from garkcli.design.stable_values import Branch, StableValues, Strip, StripPart, Wanted, has_wishes
from garkcli.errors import NotDecided, UsageProblem, ZeroWeight
from garkcli.exact import projection
from garkcli.exact.cells import Interval, Point, ends_of, has, pieces, roots_of, sign_of, where
from garkcli.exact.enclosing import midpoint
from garkcli.exact.parametric import common_denominator
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, real_roots, sign_at
from garkcli.tableau.family import OSCILLATING, Family
from garkcli.tableau.tableau import Tableau

NEAR = 32
"""Bits of a rational number beside an irrational one."""
BEYOND = ("free-parameters", "no-radicals")


def stable_set(
    family: Family,
    wanted: Wanted,
    whose: Whose = "method",
    two_springs: stability_kinds.TwoSprings | None = None,
    colour: int | None = None,
    members: stability_kinds.Members | None = None,
) -> StableValues:
    """The stable values of the free parameters that satisfy the other wants of the file.

    P- or I-stability is on the oscillator with the usual splitting, or on ``two_springs``, A- or
    L-stability with all vector fields equal, or one ``colour``. The step depends on at most two
    parameters, or linear forms of them. ``members`` may be other methods than those of the family.

    Raises UsageProblem if the stability is not applicable, there are more parameters, or roots of
    one; ZeroWeight if a weight is always zero; NotDecided too if a set over an open strip is open.
    """
    smaller, forms = (
        (family, ()) if members else _fewest(family, wanted, whose, two_springs, colour)
    )
    members = members or stability_kinds.Members(smaller, whose)
    if len(smaller.parameters) > 2:
        is_pair = whose == "pair" and bool(family.radicals)
        raise beside_roots(family, wanted, whose) if is_pair else too_many(family)
    _refuse_radicals(members, wanted, two_springs)
    tableau = TABLEAUS[whose](smaller.tableau)
    kind: stability_kinds.StabilityKind
    if wanted not in OSCILLATING:
        kind = stability_kinds.AStability(members, tableau, colour, wanted == "l-stable")
    elif two_springs is None:
        kind = stability_kinds.IStability(members, tableau, wanted == "p-stable")
    else:
        kind = stability_kinds.SpringStability(members, tableau, two_springs, wanted == "p-stable")
    found: tuple[Interval, ...]
    if len(smaller.parameters) == 1:
        found, undecided = _OnLine(kind, smaller).run()
    else:

        def on_line(x: stability_kinds.Members) -> StableValues:
            return stable_set(x.family, wanted, whose, two_springs, colour, x)

        found, undecided = _InPlane(kind, tableau, on_line).run()
    return StableValues(family, whose, wanted, found, undecided, two_springs, colour, tuple(forms))


def _fewest(
    family: Family,
    wanted: Wanted,
    whose: Whose,
    two_springs: stability_kinds.TwoSprings | None,
    colour: int | None,
) -> tuple[Family, Sequence[LinearForm]]:
    tableau = TABLEAUS[whose](family.tableau)
    is_open = all(x == (None, None) for x in family.ranges.values())
    is_without = common_denominator(tableau.entries, family.ring).is_constant()
    is_one = len(family.parameters) == 1
    if is_one or two_springs or not is_open or not is_without or has_wishes(family):
        return family, ()
    smaller, forms = fewest(family, tableau, stability_kinds.driven(tableau, wanted, colour))
    return smaller, () if len(forms) == len(family.parameters) else forms


def too_many(family: Family) -> UsageProblem:
    *_, last = family.parameters
    return UsageProblem(
        f"there are {len(family.parameters)} free parameters, and gark finds sets of at most two",
        f"give values to all but two, such as --set {last}=1/2",
        code="free-parameters",
    )


def beside_roots(family: Family, wanted: Wanted, whose: Whose) -> UsageProblem:
    message = f"there are roots among the coefficients, besides the free {family.parameters[0]}"
    cure = "name the family of the method in place of A, b and c, so that no node is written"
    if wanted in OSCILLATING and whose == "pair":
        cure = "add --order P, which takes roots"
    return UsageProblem(message, cure, code="no-radicals")


def _refuse_radicals(
    members: stability_kinds.Members, wanted: Wanted, two_springs: stability_kinds.TwoSprings | None
) -> None:
    family = members.family
    places = map(family.ring.names.index, family.parameters)
    is_number = not any(x.relation.degrees()[k] for k in places for x in family.radicals)
    is_on_springs = bool(family.radicals) and two_springs is not None
    if not is_number or is_on_springs or members.constants is None:
        raise beside_roots(family, wanted, members.whose)


def _wishes(family: Family) -> Iterator[tuple[fmpq_mpoly, frozenset[int]]]:
    """Polynomials with the signs that the file wants."""
    for polynomials, signs in (
        (family.relations, {0}),
        (family.nonzero, {-1, 1}),
        (family.positive, {1}),
        (family.not_negative, {0, 1}),
    ):
        yield from ((p, frozenset(signs)) for p in polynomials)


def _is_within(t: Point, ends: tuple[fmpq | None, fmpq | None]) -> bool:
    root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
    least, greatest = (None if x is None else RealRoot.rational(x) for x in ends)
    return not (least is not None and root < least) and not (
        greatest is not None and greatest < root
    )


class _OnLine:
    def __init__(self, kind: stability_kinds.StabilityKind, family: Family) -> None:
        self.kind, self.members, in_t = kind, kind.members, kind.step.in_t
        [self.range] = family.ranges.values()
        self.poles = [p for p in map(in_t, kind.step.poles) if p.degree > 0]
        along = self.members.flat(family.tableau).along
        self.wishes = [(along(p), signs) for p, signs in _wishes(family)]
        self.undecided: list[RealRoot] = []
        self._essential: list[Polynomial] | None = None
        self._conditions: dict[str, list[Polynomial]] = {}

    def run(self) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
        kind, in_t = self.kind, self.kind.step.in_t
        critical = [Polynomial([-x, 1]) for x in self.range if x is not None]
        known = self.members.critical
        deciding = list(map(in_t, kind.deciding)) if known is None else known
        critical += [*(p.square_free() for p in deciding if p.degree > 0), *self.poles]
        cells = pieces(self._at_rational, self._at_root, roots_of(critical))
        found = tuple(cell for cell, is_in in cells if is_in)
        still_open = tuple(filter(self._is_wanted, self.undecided))
        narrowing = [*map(in_t, kind.narrowing), *(p for p, _ in self.wishes)]
        if narrowing or self.undecided:
            ends = [*ends_of(found), *(Polynomial.from_flint(t.polynomial) for t in still_open)]
            found = where(
                lambda t: has(found, t) and self._is_wanted(t) and t not in still_open,
                [*ends, *narrowing],
            )
        return found, still_open

    def _is_wanted(self, t: Point) -> bool:
        return self.kind.keeps(t) and all(sign_of(p, t) in signs for p, signs in self.wishes)

    def _at_root(self, t: RealRoot, left: bool | None, right: bool) -> bool:
        if not self._is_wanted(t):
            return False
        if t.exact is not None:
            return self._at_rational(t.exact)
        known = self._known(t)
        if known is not None:
            return known
        if (left or right) and all(sign_at(p, t) for p in self.essential):
            return True
        if self.kind.is_refuted(t):
            return False
        try:
            return self.kind.decide(t)
        except NotDecided as error:
            if error.is_late:
                raise
        self._add_conditions(midpoint(t.ball(NEAR)))
        if self._is_violated(t):
            return False
        self.undecided.append(t)
        return True

    def _at_rational(self, t: fmpq) -> bool:
        known = self._known(t)
        if known is not None:
            return known
        is_stable = self.kind.decide(t)
        if not is_stable:
            self._add_conditions(t)
        return is_stable

    def _add_conditions(self, t: fmpq) -> None:
        """Notes what is violated at an x at which the method at a value is unstable."""
        witness = self.kind.witness(t)
        if witness is not None and str(witness) not in self._conditions:
            self._conditions[str(witness)] = self.kind.conditions(witness)

    def _is_violated(self, t: Point) -> bool:
        return any(sign_of(p, t) < 0 for p in chain.from_iterable(self._conditions.values()))

    def _known(self, t: Point) -> bool | None:
        if not self._is_method(t):
            return False
        known = self.members.known(t, self.kind.is_closed)
        if known is not None:
            return known
        return False if self._is_violated(t) else None

    def _is_method(self, t: Point) -> bool:
        return _is_within(t, self.range) and all(sign_of(p, t) for p in self.poles)

    @property
    def essential(self) -> list[Polynomial]:
        if self._essential is None:
            self._essential = list(map(self.kind.step.in_t, self.kind.essential))
        return self._essential


_Parts = tuple[StripPart, ...]


class _InPlane:
    def __init__(
        self,
        kind: stability_kinds.StabilityKind,
        tableau: Tableau,
        on_line: Callable[[stability_kinds.Members], StableValues],
    ) -> None:
        self.members, self.on_line = kind.members, on_line
        self.undecided: list[RealRoot] = []
        family = self.members.family
        self.range, second = (family.ranges[x] for x in family.parameters)
        y, t = projection.PLANE.gens()
        wishes = (self.members.flat(tableau).over(p) for p, _ in _wishes(family))
        curves = kind.step.curves([*kind.deciding, *kind.narrowing, *kind.step.poles, *wishes])
        ends = [*(y - x for x in second if x is not None)]
        ends += (t - x for x in self.range if x is not None)
        self.curves = list({str(p): p for p in (*curves, *ends)}.values())

    def run(self) -> tuple[tuple[Strip, ...], tuple[RealRoot, ...]]:
        """The strips, and the values of the first parameter over which something is undecided."""
        critical = roots_of(projection.projected(self.curves, []))
        found = pieces(self._parts, self._over, critical)
        strips = (
            Strip(x.start, x.end, x.has_start, x.has_end, parts) for x, parts in found if parts
        )
        return tuple(strips), tuple(self.undecided)

    def _stable(self, t: Point, limits: tuple[Interval, ...] | None = None) -> StableValues:
        root = projection.of_root(t if isinstance(t, RealRoot) else RealRoot.rational(t))
        resultants = [projection.resultant(p, root, "t") for p in self.curves]
        critical = tuple(map(in_one, resultants)) if all(resultants) else None
        return self.on_line(self.members.over(t, critical, limits))

    def _parts(self, t: fmpq) -> _Parts:
        """The stable parts of an open strip, from one t inside; raises NotDecided."""
        check_time()
        if not _is_within(t, self.range):
            return ()
        stable = self._stable(t)
        if stable.undecided:
            raise NotDecided
        branches: list[tuple[RealRoot, Branch]] = []
        for curve in self.curves:
            if curve.degrees()[0]:
                roots = real_roots(projection.on_line(curve, t))
                branches += [(y, Branch(curve, k, len(roots))) for k, (y, _) in enumerate(roots)]

        def end(y: RealRoot | None) -> Branch | None:
            return None if y is None else next(x for root, x in branches if root == y)

        return tuple(
            StripPart(end(x.start), end(x.end), x.has_start, x.has_end) for x in stable.found
        )

    def _over(self, t: RealRoot, left: _Parts | None, right: _Parts) -> _Parts:
        if not _is_within(t, self.range):
            return ()
        assert left is not None
        sides = [(parts, _limits(parts, t)) for parts in (left, right)]
        try:
            is_known = all(there is not None for _, there in sides)
            limits = tuple(x for _, there in sides for x in there or ())
            stable = self._stable(t, limits if is_known else None)
        except UsageProblem:  # no field of an admitted degree has it
            stable = None
        except (ZeroDivisionError, ZeroWeight):  # a pole for every value of the second
            return ()
        if stable is None or stable.undecided:
            self.undecided.append(t)
            return ()
        for parts, there in sides:
            if there == list(stable.found):
                return parts
        return tuple(StripPart(x.start, x.end, x.has_start, x.has_end) for x in stable.found)


def _limits(parts: _Parts, t: RealRoot) -> list[Interval] | None:
    """The parts of a strip over one of its ends, as limits; None if one is unknown."""
    limits: list[Any] = [part.over(t) for part in parts]
    return None if None in limits else limits
