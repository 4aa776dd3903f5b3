"""The greatest level among methods, exactly.

The level L(t) is the first y > 0 at which a condition on the signs of polynomials p(y, t), true
from 0 on, fails; it may be 0 or infinite. Between the t of ``garkcli.exact.projection`` and those
where a curve p = 0 has a horizontal tangent L is one branch of a curve, and that is monotone. So
the greatest value is reached at such a t, or it is approached there without being reached: L may
jump. At the t themselves, whatever their degree, L is that of ``garkcli.exact.fibre``.

A greatest value m of small degree is then checked without this argument: L − m has one sign between
the t at which p(m, t) = 0 for some p, and one t each decides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import groupby, pairwise
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.member import member, method_at
from garkcli.design.minimise.comparison import Minimisation
from garkcli.design.minimise.line import Constraints, Toward
from garkcli.design.minimise.objective import ORIGIN, LevelObjective, LevelSigns, Size
from garkcli.design.minimise.result import Candidate, Extent, ObjectiveLimit, Proof
from garkcli.design.parts import Part, at_root
from garkcli.design.solutions import Solution
from garkcli.design.steps import Found
from garkcli.exact.cells import Point, between, roots_of, sign_of
from garkcli.exact.fibre import Fibre, FibreRoot
from garkcli.exact.field import ZERO
from garkcli.exact.parametric import factors
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.projection import PLANE, at_y, coefficient_of, in_t, projected, resultant
from garkcli.exact.roots import FIRST_BITS, RealRoot
from garkcli.frozen import Frozen

TRIALS = 16
"""Numbers below the greatest level tried to show that another level is smaller."""
MOST_DEGREE = 6
"""Largest degree of a greatest level that is checked a second time."""
_Level: TypeAlias = "RealRoot | FibreRoot | None"
"""A level; on a fibre it is known to any number of digits."""


class HighAt(Frozen):
    """A number with the greatest level; if ``is_sample`` it stands for an interval around it."""

    t: RealRoot
    is_sample: bool = False


class Levels(Frozen):
    """The greatest level that is attained, and the places where it is attained or exceeded.
    ``attained`` are critical numbers, and one number of each interval. At ``limits`` a larger level
    is approached. ``is_decided``: the level is known at every critical number.
    """

    greatest: Size
    attained: tuple[HighAt, ...]
    limits: tuple[Toward, ...]
    is_decided: bool


def height(level: Size) -> tuple[bool, RealRoot]:
    return level is None, ORIGIN if level is None else level


def on_levels(level: Callable[[fmpq], Size], signs: LevelSigns, allowed: Constraints) -> Levels:
    """The greatest level; ``level`` is for a rational t, by the engine for one method."""
    line = _Line(level, signs, allowed)
    attained = sorted(line.attained(), key=lambda pair: pair[0].t)
    if not attained:
        return Levels(ORIGIN, (), (), line.is_decided)
    greatest, best = _greatest(attained)
    limits: tuple[Toward, ...] = ()
    if greatest is not None and line.may_exceed(greatest):
        limits = tuple(
            toward for toward in line.approached() if height(toward.value) > height(greatest)
        )
    return Levels(greatest, best, limits, line.is_decided)


class _Line:
    def __init__(
        self, level: Callable[[fmpq], Size], signs: LevelSigns, allowed: Constraints
    ) -> None:
        self.level = level
        self.signs = signs
        self.allowed = allowed
        self.curves = factors(signs.polynomials)
        critical = [*projected(self.curves, [ZERO]), *_stationary(self.curves)]
        self.critical = [*critical, *allowed.polynomials]
        self.points = roots_of(self.critical)
        self.is_decided = True

    def attained(self) -> Iterator[tuple[HighAt, _Level]]:
        """The level at every allowed critical number, and at one number of each interval. It is 0
        at irrational numbers if it is less than another one, or undecided.
        """
        irrational = []
        most: Size = ORIGIN
        for t in _in_turn(self.points):
            check_time()
            if not self.allowed.hold(t):
                continue
            is_sample = not isinstance(t, RealRoot)
            root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
            if root.exact is None:
                irrational.append(root)
                continue
            level = self.level(root.exact)
            most = max(most, level, key=height)
            yield HighAt(root, is_sample), level
        for root in irrational:
            yield HighAt(root), ORIGIN if self._is_less(root, most) else self._at(root)

    def _is_less(self, t: RealRoot, most: Size) -> bool:
        """Whether some y below ``most`` is proved to be beyond the level at a critical number."""
        if most is None:
            return True
        top = between(ORIGIN, most) if most > ORIGIN else ZERO
        for k in range(TRIALS, 0, -1):
            y = top * k / TRIALS
            signs = [sign_of(at_y(p, y), t) for p in self.signs.polynomials]
            if y and not self.signs.holds(signs):
                return True
        return False

    def _at(self, t: RealRoot) -> _Level:
        check_time()
        fibre = Fibre(t, self.curves)
        if self.signs.common and fibre.have_common_zero(self.signs.common):
            self.is_decided = False
            return ORIGIN
        level = fibre.first_failure(self.signs.polynomials, self.signs.holds)
        return RealRoot.rational(level) if isinstance(level, fmpq) else level

    def may_exceed(self, m: RealRoot) -> bool:
        """Whether levels between critical numbers may exceed the greatest attained one."""
        if m.exact is not None:
            crossing = [at_y(p, m.exact) for p in self.curves]
        elif m.polynomial.degree() > MOST_DEGREE:
            return True
        else:
            levels = PLANE.from_dict({(k, 0): fmpq(a) for k, a in enumerate(m.polynomial.coeffs())})
            crossing = [in_t(resultant(levels, p) if p.degrees()[0] else p) for p in self.curves]
        cells = _cells(roots_of([*self.critical, *crossing]))
        samples = (between(left, right) for left, right in cells)
        return any(height(self.level(t)) > height(m) for t in samples if self.allowed.hold(t))

    def approached(self) -> Iterator[Toward]:
        """The limits at the ends of intervals at which the level may not be attained."""
        for left, right in _cells(self.points):
            if not self.allowed.hold(between(left, right)):
                continue
            for end, is_right in ((left, False), (right, True)):
                is_kept = end is not None and self.signs.is_closed and self.allowed.hold(end)
                if not is_kept:
                    yield Toward(self._limit((left, right), is_right), end, is_right)

    def _limit(self, cell: tuple[RealRoot | None, RealRoot | None], is_right: bool) -> Size:
        check_time()
        end = cell[1] if is_right else cell[0]
        meeting, gaps = self._meeting(end)
        walls = [at_y(p, y) for p in self.curves for y in gaps]
        left, right = cell
        within = [
            x
            for x in roots_of(walls)
            if (left is None or left < x) and (right is None or x < right)
        ]
        ends = [left, *within, right]
        start, stop = ends[-2:] if is_right else ends[:2]
        level = self.level(between(start, stop))
        if level is None:
            return None
        below = sum(1 for y in gaps if RealRoot.rational(y) < level)
        if below == 0:
            return ORIGIN
        if below > len(meeting):
            return None
        limit = meeting[below - 1]
        return limit.exact if isinstance(limit, FibreRoot) else limit

    def _meeting(self, end: RealRoot | None) -> tuple[Sequence[RealRoot | FibreRoot], list[fmpq]]:
        """The points where curves meet the line at an end, and numbers between them."""
        if end is not None:
            fibre = Fibre(end, self.curves)
            return fibre.roots, fibre.gaps
        # at infinity the coefficients of the highest powers of t count
        highest = [in_one(coefficient_of(p, p.degrees()[1], variable=1)) for p in self.curves]
        roots = [y for y in roots_of(highest) if y > ORIGIN]
        return roots, [between(a, b) for a, b in pairwise([ORIGIN, *roots, None])]


def _greatest(attained: Sequence[tuple[HighAt, _Level]]) -> tuple[Size, tuple[HighAt, ...]]:
    """The greatest level, and one number of each run of neighbours with it."""
    exact: list[Size] = []
    most: Size = ORIGIN
    for _, level in attained:
        if isinstance(level, FibreRoot):
            # first digits show that most are smaller
            is_less = most is None or level.ball(FIRST_BITS) < most.ball(FIRST_BITS)
            level = ORIGIN if is_less else level.exact
        exact.append(level)
        most = max(most, level, key=height)
    pairs = zip((one for one, _ in attained), exact, strict=True)
    best = []
    for is_greatest, run in groupby(pairs, key=lambda pair: pair[1] == most):
        if is_greatest:
            best.append(min((one for one, _ in run), key=_length))
    return most, tuple(best)


def _stationary(of_curves: Iterable[fmpq_mpoly]) -> Iterator[Polynomial]:
    for curve in of_curves:
        by_t = curve.derivative(1)
        if by_t and curve.degrees()[0]:
            tangent = in_t(resultant(curve, by_t))
            if tangent:
                yield tangent


def _cells(points: Sequence[RealRoot]) -> list[tuple[RealRoot | None, RealRoot | None]]:
    return list(pairwise([None, *points, None]))


def _length(one: HighAt) -> tuple[bool, int]:
    """A key that sorts samples first, short ones first."""
    t = one.t.exact
    bits = 0 if t is None else int(t.p).bit_length() + int(t.q).bit_length()
    return not one.is_sample, bits


def _in_turn(points: Sequence[RealRoot]) -> Iterator[Point]:
    """A number of each cell and the points between them, in ascending order."""
    for left, right in _cells(points):
        yield between(left, right)
        if right is not None:
            yield right


class Highest(Minimisation):
    objective: LevelObjective

    def best(self, values: Sequence[Size]) -> Size:
        return max(values, key=height)

    def extent_of(self, best: Size) -> Extent:
        return "all" if best is None else self.extent

    def shown(self, value: Size) -> Size:
        return self.objective.shown(value)

    def value_of(self, solution: Solution, index: int) -> Size:
        ring = self.design.family.ring
        tableau = method_at(self.design.tableau, ring, solution, solution.real[index])
        if tableau is None:
            raise FieldTooLarge
        return self.objective.value(tableau)

    def add(
        self, solution: Solution, index: int, is_constant: bool = False, proof: Proof = "exact"
    ) -> None:
        try:
            super().add(solution, index, is_constant, proof)
        except FieldTooLarge:
            self.extent = "found"

    def over_line(self, part: Part) -> None:
        [name] = part.ring.names
        tableau, signs = self.tableau(part), self.objective.signs
        assert signs is not None  # ``exactly`` refuses others

        def level(t: fmpq) -> Size:
            return self.objective.value(member(tableau, part.ring, {name: t}))

        levels = on_levels(level, signs(tableau, part.ring), self.conditions(part))
        if not levels.is_decided:
            self.extent = "found"
        for high in levels.attained:
            method = Found(part.extended(at_root(name, high.t)), None, (high.t.number,))
            # levels are monotone between critical numbers, so a greatest one there is constant
            is_constant = high.is_sample and not levels.limits
            self.candidates.append(Candidate(levels.greatest, method, high.t.number, is_constant))
        for toward in levels.limits:
            self.limits.append(ObjectiveLimit(toward.value, name, toward))

    def over_variety(self, part: Part) -> None:
        best = self.tried(part, height)
        if best is not None:
            chart, point = best
            solution = self.at_point(part, chart, point)
            assert solution is not None
            self.add(solution, chart.index, proof="numerical")


class FieldTooLarge(Exception):
    """The engines of stability do not work in the number field."""
