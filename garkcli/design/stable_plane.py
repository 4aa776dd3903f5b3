"""The values of two parameters for which a family is A-stable: cells of the plane.

What decides are curves in the plane of the parameters (t, y): over each region between them the
zeros of E(x) = |Q(iy)|² − |P(iy)|² and the poles of R keep their number and order. The curves are
projected once more, onto t. Between two critical t nothing changes but where the curves are, so
that one rational t decides a strip, by the set of values of the one parameter that is left; its
ends are branches of the curves.

The engine for one parameter decides over each t, an irrational one too: in ℚ(t), between the points
where curves meet the line. It knows of the limits from both sides, which are A-stable, as that is
|P| ≤ |Q| on the left half plane with coefficients that are polynomials in the parameters.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.fewer import fewest
from garkcli.design.member import TABLEAUS, Whose, member, shares_of
from garkcli.design.stability_functions import FamilyFunction, function_of, joined
from garkcli.design.stability_kinds import Slice, TwoSprings, driven, real_and_imaginary
from garkcli.design.stable_values import (
    StableValues,
    Wanted,
    beside_roots,
    has_wishes,
    stable_values,
    too_many,
)
from garkcli.errors import NotDecided, UsageProblem
from garkcli.exact import projection
from garkcli.exact.cells import Interval, Point, between, roots_of
from garkcli.exact.parametric import Parameters, common_denominator, evaluated, factors
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, real_roots, sign_at
from garkcli.frozen import Frozen, replace
from garkcli.tableau.family import Family, Radical
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown


class Branch(Frozen, eq=False):
    """A branch of a curve p(y, t) = 0 as a function of t: one of its roots in y, numbered from
    below.

    Attributes:
        curve: p.
        number: of the root, from 0.
        count: the number of real roots.
    """

    curve: fmpq_mpoly
    number: int
    count: int

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Branch)
            and str(self.curve) == str(other.curve)
            and (self.number, self.count) == (other.number, other.count)
        )

    __hash__ = None  # type: ignore[assignment]

    def formula(self) -> tuple[Polynomial, Polynomial] | None:
        """Numerator and denominator if the branch is a rational function of t."""
        if self.curve.degrees()[0] > 1:
            return None
        return -projection.in_t(projection.coefficient_of(self.curve, 0)), projection.in_t(
            projection.coefficient_of(self.curve, 1)
        )

    def at(self, t: RealRoot) -> RealRoot | None:
        """The value at a number or at an end of the strip, as a limit; None if roots meet or escape
        to infinity there.
        """
        degree = self.curve.degrees()[0]
        critical = [
            projection.leading(self.curve),
            *([projection.discriminant(self.curve)] if degree > 1 else []),
        ]
        if any(sign_at(projection.in_t(p), t) == 0 for p in critical):
            return None
        candidates = [
            y
            for y, _ in real_roots(
                in_one(projection.resultant(self.curve, projection.of_root(t), "t"))
            )
        ]
        bits = 64
        while len(candidates) > self.count:
            check_time()
            with ctx.workprec(2 * bits):
                x = t.ball(bits)
                candidates = [
                    y for y in candidates if _value(self.curve, [y.ball(bits), x]).overlaps(arb(0))
                ]
            bits *= 2
        return candidates[self.number]


End: TypeAlias = "Branch | RealRoot | None"
"""An end of a set of y: a function of t, a number over a single t, or None for infinity."""


class StripPart(Frozen):
    """An interval of y over a strip.

    Attributes:
        start, end: its ends.
        has_start, has_end: whether the ends belong to it.
    """

    start: End
    end: End
    has_start: bool
    has_end: bool

    def over(self, t: RealRoot) -> Interval | None:
        """The interval over one t; None if an end is unknown there."""
        ends: list[RealRoot | None] = []
        for end in (self.start, self.end):
            value = end.at(t) if isinstance(end, Branch) else end
            if end is not None and value is None:
                return None
            ends.append(value)
        return Interval(ends[0], ends[1], self.has_start, self.has_end)


class Strip(Frozen):
    """An interval of the first parameter, and the values of the second over it.

    Attributes:
        base: the interval of the first.
        parts: the values of the second, from below.
    """

    base: Interval
    parts: tuple[StripPart, ...]


class StablePlane(Shown, Frozen):
    """The values of two parameters for which a family is A-stable.

    Attributes:
        family: as read from the file.
        strips: all of them, from the left.
        undecided: values of the first parameter over which something is undecided; they are in no
            strip.
        colour: the colour with λ ≠ 0, counted from 0; None for all colours.
    """

    family: Family
    strips: tuple[Strip, ...]
    undecided: tuple[RealRoot, ...]
    colour: int | None = None

    @property
    def has_values(self) -> bool | None:
        """Whether there are such values; None if undecided."""
        if self.strips:
            return True
        return None if self.undecided else False


def stable_set(
    family: Family,
    wanted: Wanted,
    whose: Whose = "method",
    two_springs: TwoSprings | None = None,
    colour: int | None = None,
) -> StableValues | StablePlane:
    """The stable values of one parameter, of one linear form if the step depends on no more, or of
    two parameters for A-stability.

    Args:
        family: of methods.
        wanted: the kind of stability.
        whose: of the method, its symplectic conjugate, or its symplectic pair.
        two_springs: the springs for P- or I-stability; None for one oscillator.
        colour: A- or L-stability of this colour only, counted from 0.

    Raises:
        UsageProblem: the stability is not applicable, there are other parameters, or roots among
            the coefficients.
        ZeroWeight: a weight is zero for every value, so there is no conjugate.
        NotDecided: the time limit has passed.
    """
    along_one = values_of_one(family, wanted, whose, two_springs, colour)
    if along_one is not None:
        return along_one
    if family.radicals:
        raise beside_roots(family, wanted, whose)
    is_plane = len(family.parameters) == 2 and wanted == "a-stable" and whose == "method"
    if is_plane and _is_plain(family, family.tableau):
        return stable_plane(family, colour)
    raise too_many(family)


def values_of_one(
    family: Family,
    wanted: Wanted,
    whose: Whose,
    two_springs: TwoSprings | None = None,
    colour: int | None = None,
) -> StableValues | None:
    """The stable values of one parameter, or of one linear form in several; None if the step
    depends on more, or there are other wants, radicals, or denominators.
    """
    if len(family.parameters) == 1:
        return stable_values(family, wanted, whose, two_springs, colour)
    tableau = TABLEAUS[whose](family.tableau)
    if two_springs or family.radicals or not _is_plain(family, tableau):
        return None
    smaller, forms = fewest(family, tableau, driven(tableau, wanted, colour))
    if len(forms) > 1:
        return None
    along_form = stable_values(smaller, wanted, whose, colour=colour)
    return replace(along_form, family=family, form=forms[0])


def _is_plain(family: Family, tableau: Tableau) -> bool:
    """Whether parameters have neither ranges nor other wants, and coefficients no denominators."""
    is_open = all(x == (None, None) for x in family.ranges.values())
    is_without = common_denominator(tableau.entries, family.ring).is_constant()
    return is_open and is_without and not has_wishes(family)


def stable_plane(family: Family, colour: int | None = None) -> StablePlane:
    """The A-stable values of two parameters without ranges, for coefficients without denominators.

    Raises:
        UsageProblem: A-stability is not applicable.
        NotDecided: the time limit has passed.
    """
    return _Plane(family, colour).run()


class _Plane:
    """The decomposition of the plane for one family."""

    def __init__(self, family: Family, colour: int | None) -> None:
        self.family, self.colour = family, colour
        driven(family.tableau, "a-stable", colour)
        R = function_of(family.tableau, family.ring, "", shares_of(family.tableau, colour))
        self.curves = _deciding(R, family.ring)
        self.undecided: list[RealRoot] = []

    def run(self) -> StablePlane:
        critical = roots_of(projection.projected(self.curves, []))
        ends: list[RealRoot | None] = [None, *critical, None]
        opened = [
            Strip(Interval(left, right), self._parts(between(left, right)))
            for left, right in pairwise(ends)
        ]
        strips = [opened[0]]
        for t, following in zip(critical, opened[1:], strict=True):
            check_time()
            strips += [self._over(t, strips[-1], following), following]
        return StablePlane(self.family, tuple(_joined(strips)), tuple(self.undecided), self.colour)

    def _stable(self, t: Point, limits: tuple[Interval, ...] | None = None) -> StableValues:
        """The stable values of the second parameter at one of the first, with the limits there if
        known.
        """
        first, second = self.family.parameters
        rational = t.exact if isinstance(t, RealRoot) else t
        ring = Parameters([second])
        radicals: tuple[Radical, ...] = ()
        values: dict[str, Any] = {first: rational}
        if rational is None:
            assert isinstance(t, RealRoot)
            ring = Parameters([second, first])
            relation = ring.context.from_dict(
                {(0, k): fmpq(a) for k, a in enumerate(t.polynomial.coeffs()) if a}
            )
            radicals = (Radical(first, relation, meant=t),)
        values |= {name: ring.parameter(name) for name in ring.names}
        line = replace(
            self.family,
            tableau=member(self.family.tableau, self.family.ring, values),
            ring=ring,
            parameters=(second,),
            ranges={second: (None, None)},
            radicals=radicals,
        )
        members = Slice(line, "method", self._critical(t), limits)
        return stable_values(line, "a-stable", colour=self.colour, members=members)

    def _critical(self, t: Point) -> tuple[Polynomial, ...] | None:
        """Polynomials that vanish where curves meet the line over t; None if a curve contains the
        line.
        """
        root = projection.of_root(t if isinstance(t, RealRoot) else RealRoot.rational(t))
        resultants = [projection.resultant(p, root, "t") for p in self.curves]
        return tuple(map(in_one, resultants)) if all(resultants) else None

    def _parts(self, t: fmpq) -> tuple[StripPart, ...]:
        """The stable parts of an open strip, from one t inside.

        Raises:
            NotDecided: some values are undecided.
        """
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

    def _over(self, t: RealRoot, left: Strip, right: Strip) -> Strip:
        """The stable parts over a critical t."""
        base = Interval(t, t, has_start=True, has_end=True)
        sides = [(side, _over(side, t)) for side in (left, right)]
        try:
            is_known = all(parts is not None for _, parts in sides)
            limits = tuple(x for _, parts in sides for x in parts or ())
            stable = self._stable(t, limits if is_known else None)
        except UsageProblem:  # no field of an admitted degree has it
            stable = None
        if stable is None or stable.undecided:
            self.undecided.append(t)
            return Strip(base, ())
        for side, parts in sides:
            if parts == list(stable.found):
                return Strip(base, side.parts)
        parts_here = (StripPart(x.start, x.end, x.has_start, x.has_end) for x in stable.found)
        return Strip(base, tuple(parts_here))


def _deciding(R: FamilyFunction, ring: Parameters) -> list[fmpq_mpoly]:
    """The irreducible curves in the plane of the parameters at which stability may change."""
    P, Q, E = (
        joined(x, common_denominator(list(x), ring), ring)
        for x in (R.numerator, R.denominator, R.e_polynomial or (fmpq(0),))
    )
    curves = [*projection.seen_along(factors([E]), [fmpq(0)]), *map(projection.leading, (P, Q))]
    for p, q in ((P, Q), real_and_imaginary(Q)):
        if p and q and (p.degrees()[0] or q.degrees()[0]):
            curves.append(projection.resultant(p, q))
    return factors(projection.in_plane(p, y=2, t=1) for p in curves)


def _over(strip: Strip, t: RealRoot) -> list[Interval] | None:
    """The parts of a strip over one of its ends, as limits; None if one is unknown."""
    found = [part.over(t) for part in strip.parts]
    return None if None in found else [x for x in found if x is not None]


def _joined(strips: Sequence[Strip]) -> list[Strip]:
    """Strips with adjacent ones of the same parts joined, and empty ones left out."""
    joined: list[Strip] = []
    for strip in strips:
        if joined and joined[-1].parts == strip.parts:
            last = joined[-1].base
            base = Interval(last.start, strip.base.end, last.has_start, strip.base.has_end)
            joined[-1] = Strip(base, strip.parts)
        else:
            joined.append(strip)
    return [strip for strip in joined if strip.parts]


def _value(x: Any, at: Sequence[arb]) -> arb:
    """The value in balls of a polynomial, or of the numerator of a number."""
    if isinstance(x, fmpq):
        return arb(x)
    return arb(evaluated(x if isinstance(x, fmpq_mpoly) else x.numerator, at))
