"""The methods of a solution set with the stability that a family wants, part by part.

On a part (``garkcli.design.parts``) whose step depends on one coordinate x alone the stable methods
are those with x in a set. The set is found on a line with rational values of the other coordinates;
if the part has an equation p(x) = 0, the roots of p are decided one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import islice, product
from typing import Any

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time, checked
from garkcli.design.family_step import FamilyStep, Flat
from garkcli.design.fewer import step_polynomials
from garkcli.design.ideal import UNIT
from garkcli.design.member import (
    MOST_DEGREE,
    TABLEAUS,
    Whose,
    is_admissible,
    is_as_stable,
    is_in,
    is_stable,
    member,
    not_negative,
    restricted,
    value_of,
)
from garkcli.design.parts import (
    Part,
    RationalChart,
    at_root,
    charts,
    diagonal_unknowns,
    parts_within,
    points_of,
    values_on,
    what_is_asked,
)
from garkcli.design.solutions import Solution, value_at
from garkcli.design.stability_kinds import Members, driven
from garkcli.design.stable_set import BEYOND, stable_set
from garkcli.design.stable_values import StableValues
from garkcli.errors import NotDecided, UsageProblem, ZeroWeight
from garkcli.exact import projection
from garkcli.exact.cells import Interval, Point, between, ends_of, has, sign_of, where
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, number_of, real_roots
from garkcli.frozen import Frozen, replace
from garkcli.tableau.family import Family, Radical, RequiredStability
from garkcli.tableau.tableau import Tableau

VALUES = [
    fmpq(*x) for x in ((1, 2), (1, 3), (3, 4), (1, 4), (2, 3), (1, 1), (3, 5), (6, 5), (0, 1))
]
MOST_POINTS = 300


class StablePart(Frozen):
    """The stable methods of a part, with sets of its coordinates. For each kind of stability
    ``kinds`` has stable values of the coordinate on which it depends, ``attained`` all of its
    values in the part.
    """

    part: Part
    kinds: tuple[StableValues, ...]
    attained: tuple[tuple[Interval, ...], ...]

    @property
    def parts(self) -> Iterator[Part]:
        """The part; or if only single values of a coordinate are stable, its parts at these."""
        name, values = self.part.sets[-1]
        place = self.part.ring.names.index(name)
        if not values or what_is_asked(self.part, name) or not all(x.is_point for x in values):
            yield from [self.part] if values else []
            return
        x = self.part.ring.context.gen(place)
        for p in ends_of(values):
            terms: Any = p.coefficients
            zero = sum((x**k * a for k, a in enumerate(terms)), start=x * 0)
            yield from parts_within(self.part, [zero])

    @property
    def is_decided(self) -> bool:
        return not any(x.undecided for x in self.kinds)


def stable_part(family: Family, whose: Whose, part: Part) -> StablePart:
    """The stable methods of a part; raises UsageProblem for a stability that is not applicable.
    Raises NotDecided if the step depends on several coordinates, or on one that is not free.
    """
    if family.radicals:
        raise NotDecided
    if not part.dimension:
        return _stable_points(family, whose, part)
    kinds, attained = [], []
    for wanted in dict.fromkeys(family.stable):
        line = _PartLine(family.tested(wanted), whose, part, wanted)
        found, undecided = line.values()
        shown, attained_by_line = line.in_unknown(found, undecided)
        kinds.append(shown)
        attained.append(attained_by_line)
        values = {**part.values, line.name: part.ring.parameter(line.name)}
        part = replace(part, values=values, sets=(*part.sets, (line.name, found)))
    return StablePart(part, tuple(kinds), tuple(attained))


def _stable_points(family: Family, whose: Whose, part: Part) -> StablePart:
    """The stable methods among finitely many, by their values of an unknown on a diagonal."""
    name = next(iter(diagonal_unknowns(family.tableau, family.ring)), family.parameters[0])
    family_of_one = replace(
        family, ring=Parameters([name]), parameters=(name,), ranges={name: (None, None)}
    )
    methods = [(x, root) for x in map(part.extended, points_of(part)) for root in x.real]
    kinds = []
    for wanted in dict.fromkeys(family.stable):
        single_want = replace(family, stable=(wanted,))
        values: dict[bool | None, list[RealRoot]] = {True: [], False: [], None: []}
        for solution, root in methods:
            value = value_at(solution.values[name], root)
            values[is_as_stable(single_want, whose, solution, root)].append(value)
        kind: Any = wanted.kind
        stable_values = tuple(map(point_of, sorted(set(values[True]))))
        undecided = tuple(set(values[None]) - set(values[True]))
        stable = StableValues(family_of_one, whose, kind, stable_values, undecided)
        kinds.append(_told_of(stable, wanted))
    attained = tuple(map(point_of, sorted({value_at(x.values[name], t) for x, t in methods})))
    return StablePart(part, tuple(kinds), (attained,) * len(kinds))


def _told_of(values: StableValues, wanted: RequiredStability) -> StableValues:
    return replace(values, colour=wanted.colour, is_embedded=wanted.is_embedded)


class _PartLine:
    def __init__(self, family: Family, whose: Whose, part: Part, wanted: RequiredStability) -> None:
        self.family, self.whose, self.part, self.wanted = family, whose, part, wanted
        values: Any = part.values
        self.tableau = member(family.tableau, family.ring, values)
        derived = TABLEAUS[whose](self.tableau)
        fields = driven(derived, wanted.kind, wanted.colour)
        denominator, numerators = step_polynomials(derived, part.ring, fields)
        for name in part.ring.names:
            root = what_is_asked(part, name)
            if root is None and not part.is_free:
                continue
            if self._is_enough(name, denominator, numerators, root):
                self.name, self.root = name, root
                return
        raise NotDecided

    def _is_enough(
        self, name: str, D: fmpq_mpoly, numerators: Sequence[fmpq_mpoly], root: fmpq_mpoly | None
    ) -> bool:
        """Whether N/D depends on one coordinate x alone, on the zeros of ``root`` if given. N(x, y)
        D(x, y') = N(x, y') D(x, y) for some numbers y' in place of the others.
        """
        check_time()
        context = D.context()
        place = 1 + self.part.ring.names.index(name)
        gens = context.gens()
        for others in points(len(gens) - 2):
            rest = iter(others)
            at = [x if k in {0, place} else x * 0 + next(rest) for k, x in enumerate(gens)]
            below = D.compose(*at)
            if below:
                break
        else:
            return False
        modulus = None if root is None else root.compose(gens[place], ctx=context)
        for N in numerators:
            difference = N * below - N.compose(*at) * D
            if modulus is not None:
                difference = divmod(difference, modulus)[1]
            if difference:
                return False
        return True

    @property
    def members(self) -> PartMembers:
        return PartMembers(self.family, self.whose, self.part, self.name, self.tableau)

    def values(self) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
        members = self.members
        if self.root is None:
            kind: Any = self.wanted.kind
            values = stable_set(
                members.in_coordinate, kind, self.whose, colour=self.wanted.colour, members=members
            )
            return values.found, values.undecided
        stable, undecided = [], []
        for t, _ in real_roots(in_one(self.root)):
            if number_of(t, MOST_DEGREE) is None:
                undecided.append(t)
                continue
            tableau = members.at(t)
            if tableau is not None and is_stable(self.wanted, tableau):
                stable.append(point_of(t))
        return tuple(stable), tuple(undecided)

    def in_unknown(
        self, found: tuple[Interval, ...], undecided: tuple[RealRoot, ...]
    ) -> tuple[StableValues, tuple[Interval, ...]]:
        """The stable values of an unknown a x + b on a diagonal, and all its values in the part."""
        is_same = not found or found == (Interval(None, None),)
        name, a, b = self._shown(is_same)
        kind: Any = self.wanted.kind
        family = replace(self.members.in_coordinate, parameters=(name,))

        def moved(x: RealRoot) -> RealRoot:
            return value_at(at_root(self.name, x).values[self.name] * a + b, x)

        def moved_part(x: Interval) -> Interval:
            ends = [(x.start and moved(x.start), x.has_start), (x.end and moved(x.end), x.has_end)]
            (start, has_start), (end, has_end) = ends if a > 0 else ends[::-1]
            return Interval(start, end, has_start, has_end)

        step = 1 if a > 0 else -1
        shown = tuple(map(moved_part, found[::step]))
        attained = tuple(map(moved_part, self._attained[::step]))
        if not a:
            attained = (point_of(RealRoot.rational(b)),)
            shown = attained if found else ()
        open_values = tuple(map(moved, undecided))
        shown_values = StableValues(family, self.whose, kind, shown, open_values)
        return _told_of(shown_values, self.wanted), attained

    @property
    def _attained(self) -> tuple[Interval, ...]:
        if self.root is not None:
            return tuple(point_of(t) for t, _ in real_roots(in_one(self.root)))
        left_out = [content_in(p, self.part.ring, self.name) for p in self.part.nonzero]
        return where(lambda t: all(sign_of(p, t) for p in left_out), left_out)

    def _shown(self, is_same: bool) -> tuple[str, fmpq, fmpq]:
        """An unknown a x + b with a and b; a = 0 is allowed if all methods are equally stable."""
        ring = self.part.ring
        place = ring.names.index(self.name)
        for name in diagonal_unknowns(self.family.tableau, self.family.ring):
            over, under = fraction(self.part.values[name], ring)
            degrees = [int(k) for k in over.degrees()]
            is_multiple = sum(degrees) == degrees[place] == 1
            if under.is_constant() and (is_multiple or (is_same and over.is_constant())):
                line = in_one(over / under.leading_coefficient(), place)
                slope, at_zero = line[1], line[0]
                assert isinstance(slope, fmpq)
                assert isinstance(at_zero, fmpq)
                return name, slope, at_zero
        return self.name, fmpq(1), fmpq(0)


def point_of(x: RealRoot) -> Interval:
    return Interval(x, x, has_start=True, has_end=True)


class PartMembers(Members):
    """A part on a line along one coordinate, or on another line if that has no method."""

    part: Part
    name: str
    tableau: Tableau

    def at(self, t: Point) -> Tableau | None:
        """A method at a value; None if there is none. Raises NotDecided if no tried point gives
        one.
        """
        value = number_of(t, MOST_DEGREE) if isinstance(t, RealRoot) else t
        if value is None:
            raise NotDecided
        if not all(p(value) for p in self.poles):
            return None
        others = len(self.part.ring.names) - 1
        for point in points(others):
            with suppress(ZeroDivisionError, ZeroWeight):
                values = self._with(value, point)
                return TABLEAUS[self.whose](member(self.tableau, self.part.ring, values))
        if others:
            raise NotDecided
        return None

    @property
    def in_coordinate(self) -> Family:
        ring = Parameters([self.name])
        for others in points(len(self.part.ring.names) - 1):
            with suppress(ZeroDivisionError, ZeroWeight):
                values: Any = self._with(ring.parameter(self.name), others)
                tableau = member(self.tableau, self.part.ring, values)
                TABLEAUS[self.whose](tableau)
                return Family(
                    name=self.family.name,
                    tableau=tableau,
                    ring=ring,
                    parameters=ring.names,
                    ranges={self.name: (None, None)},
                    radicals=(),
                )
        raise NotDecided

    def flat(self, tableau: Tableau) -> Flat:
        return Flat(tableau, Parameters([self.name]))

    def step(self, tableau: Tableau, fields: Sequence[Matrix]) -> FamilyStep:
        poles = (projection.across(p.coefficients) for p in self.poles)
        return replace(super().step(tableau, fields), poles=tuple(poles))

    def _with(self, value: Any, others: Sequence[fmpq]) -> dict[str, Any]:
        names = [name for name in self.part.ring.names if name != self.name]
        return {**dict(zip(names, others, strict=True)), self.name: value}

    @property
    def poles(self) -> tuple[Polynomial, ...]:
        """A polynomial that vanishes if no line has a method there."""
        common = common_denominator(self.tableau.entries, self.part.ring)
        return (content_in(common, self.part.ring, self.name),)


def content_in(p: fmpq_mpoly, ring: Parameters, name: str) -> Polynomial:
    """The greatest common divisor of the coefficients of a polynomial in the other unknowns. At its
    zeros in one unknown the polynomial vanishes for all values of the others.
    """
    place = ring.names.index(name)
    univariate = Parameters([name])
    slices: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for e, a in p.to_dict().items():
        others = tuple(int(k) for i, k in enumerate(e) if i != place)
        slices.setdefault(others, {})[(int(e[place]),)] = a
    content = univariate.constant(fmpq(0))
    for terms in slices.values():
        content = content.gcd(univariate.context.from_dict(dict(terms)))
    return in_one(content)


def points(size: int) -> Iterator[tuple[fmpq, ...]]:
    return checked(islice(product(VALUES, repeat=size), MOST_POINTS))


def methods_on(family: Family, whose: Whose, part: Part) -> Iterator[tuple[Solution, RealRoot]]:
    """Stable methods of a part, at short rational numbers if coordinates are free."""
    if not part.dimension:
        for solution_of_all in map(part.extended, points_of(part)):
            for root in solution_of_all.real:
                is_method = is_admissible(family, solution_of_all, root)
                if is_method and is_as_stable(family, whose, solution_of_all, root):
                    yield solution_of_all, root
        return
    for chart in _sampled(part) if part.is_free else charts(part):
        for point in points(len(chart.names)):
            solution = chart.point(part, point)
            if solution is not None and is_on(family, part, solution, chart.root):
                yield solution, chart.root


def _sampled(part: Part) -> Iterator[RationalChart]:
    names = part.ring.names
    *_, name = [names[0], *(x for x, _ in part.sets if x in names)]
    values = values_on(part, name)
    for x in (Interval(None, None),) if values is None else values:
        t = x.start if x.is_point else RealRoot.rational(between(x.start, x.end))
        assert t is not None
        yield RationalChart(at_root(name, t), t.number, tuple(key for key in names if key != name))


def is_on(family: Family, part: Part, solution: Solution, root: RealRoot) -> bool:
    """Whether a real solution is a method of a family and in the sets of a part."""
    if not is_admissible(family, solution, root):
        return False
    return all(is_in(x, solution.values[name], root) for name, x in part.sets)


def joined(family: Family, parts: Sequence[StablePart]) -> tuple[StableValues, ...]:
    """The stable values of one unknown within its range, of all parts together, for each kind.
    Empty if parts depend on different unknowns, or if a single point and another part with the same
    value differ in stability.
    """
    together = []
    for place, same in enumerate(zip(*(x.kinds for x in parts), strict=True)):
        [name] = same[0].names
        ranged = {key for key, ends in family.ranges.items() if ends != (None, None)} - {name}
        is_apart = bool(ranged or family.positive or family.not_negative)
        if {x.names for x in same} != {(name,)}:
            return ()
        start, end = (
            None if x is None else RealRoot.rational(x)
            for x in family.ranges.get(name, (None, None))
        )
        admitted = (Interval(start, end, start is not None, end is not None),)
        sets = [x.found for x in same]
        if _differ(sets, [x.attained[place] for x in parts], [x.part for x in parts]):
            return ()
        critical = [p for x in (*sets, admitted) for p in ends_of(x)]
        found = where(partial(_is_in_one, sets, admitted), critical)
        undecided = dict.fromkeys(t for x in same for t in x.undecided)
        undecided_left = tuple(t for t in undecided if has(admitted, t) and not has(found, t))
        together.append(replace(same[0], found=found, undecided=undecided_left, is_apart=is_apart))
    return tuple(together)


def _differ(
    stable: Sequence[tuple[Interval, ...]],
    attained: Sequence[tuple[Interval, ...]],
    parts: Sequence[Part],
) -> bool:
    """Whether a value of a single point is stable there and not in another part, or conversely."""
    for own, values, part in zip(stable, attained, parts, strict=True):
        for t in (x.start for x in values if not part.dimension):
            assert t is not None
            for others, all_of_them in zip(stable, attained, strict=True):
                if has(all_of_them, t) and has(others, t) is not has(own, t):
                    return True
    return False


def _is_in_one(
    sets: Sequence[tuple[Interval, ...]], admitted: tuple[Interval, ...], t: Point
) -> bool:
    return has(admitted, t) and any(has(x, t) for x in sets)


def has_stable_method(family: Family, whose: Whose, parts: Sequence[StablePart]) -> bool | None:
    if any(True for x in parts for _ in methods_on(family, whose, x.part)):
        return True
    is_none = all(x.is_decided and not all(y.found for y in x.kinds) for x in parts)
    return False if is_none else None


def on_charts(family: Family, whose: Whose, part: Part) -> list[tuple[StableValues, ...]]:
    """The stable values of free coordinates for each wanted stability, at all values of the others.
    Raises NotDecided if the others have infinitely many values, or the step depends on more than
    two free coordinates; UsageProblem for a stability that is not applicable.
    """
    found = charts(part)
    if not found:
        raise NotDecided
    sets = []
    for chart in found:
        with suppress(ZeroDivisionError, ZeroWeight):  # there is no method
            if _is_meant(family, part, chart):
                kinds = (
                    _on_chart(family.tested(wanted), whose, part, chart, wanted)
                    for wanted in dict.fromkeys(family.stable)
                )
                sets.append(tuple(x for x in kinds if x is not None))
    return [kinds for kinds in sets if kinds]


def _is_meant(family: Family, part: Part, chart: RationalChart) -> bool:
    """Whether radicals are those that are meant; NotDecided if one depends on free coordinates."""
    places = [part.ring.names.index(x) for x in chart.names]
    fixed = {**chart.one.values, **dict.fromkeys(chart.names, fmpq(0))}
    for radical in family.radicals:
        parts = fraction(part.values[radical.name], part.ring)
        if any(p.degrees()[k] for p in parts for k in places):
            raise NotDecided
        over, under = (value_of(p, part.ring, fixed) for p in parts)
        value = value_at(over / under, chart.root)
        if radical.meant not in (None, value):
            return False
    return True


def _on_chart(
    family: Family, whose: Whose, part: Part, chart: RationalChart, wanted: RequiredStability
) -> StableValues | None:
    """The stable values of free coordinates; None if no value is admissible."""
    known = tuple(chart.one.values) if len(chart.one.values) < 2 else (UNIT,)
    ring, root = Parameters([*chart.names, *known]), chart.root
    one = ring.constant(fmpq(1))
    images = (ring.quotient(x, one) for x in chart.images(part, ring))
    coordinates: Any = dict(zip(part.ring.names, images, strict=True))
    others = {x: ends for x, ends in family.ranges.items() if x not in chart.names}
    family = replace(family, not_negative=tuple(not_negative(replace(family, ranges=others))))
    radicals = [Radical.of(name, root) for name in known]
    on_chart = restricted(family, ring, part.at(coordinates), chart.names, radicals)

    def is_free(p: fmpq_mpoly) -> bool:
        return any(p.degrees()[: len(chart.names)])

    for least, polynomials in ((1, on_chart.positive), (0, on_chart.not_negative)):
        fixed = (in_one(p, len(ring.names) - 1) for p in polynomials if not is_free(p))
        if any(sign_of(p, root) < least for p in fixed):
            return None
    nonzero = (fraction(value_of(p, part.ring, coordinates), ring)[0] for p in part.nonzero)
    on_chart = replace(
        on_chart,
        relations=(),
        nonzero=tuple(nonzero),
        positive=tuple(filter(is_free, on_chart.positive)),
        not_negative=tuple(filter(is_free, on_chart.not_negative)),
    )
    kind: Any = wanted.kind
    try:
        found_values = stable_set(on_chart, kind, whose, colour=wanted.colour)
    except UsageProblem as error:
        if error.code in BEYOND:
            raise NotDecided from None
        raise
    # that a part leaves out others is not a want of the file
    return replace(_told_of(found_values, wanted), family=replace(found_values.family, nonzero=()))


def has_values_of_all(kinds: Sequence[StableValues]) -> bool | None:
    verdicts = [x.has_values for x in kinds]
    if False in verdicts:
        return False
    return True if verdicts == [True] else None
