"""What methods of a solution set are compared by, and the best of them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, cast

from flint import fmpq, fmpq_mpoly, fmpq_poly

from garkcli.design.design import Design, Found, Step, order_of
from garkcli.design.member import is_admissible, member, not_negative, value_of
from garkcli.design.minimise.climbing import GRID, climbed
from garkcli.design.minimise.line import Conditions
from garkcli.design.minimise.objective import Level, Objective, Size
from garkcli.design.minimise.parts import Part
from garkcli.design.minimise.result import Candidate, Extent, Limit, Minimum, Proof
from garkcli.design.pairs import least_error
from garkcli.design.solutions import Solution, solutions, value_at
from garkcli.design.want import sign_polynomial
from garkcli.errors import NotDecided
from garkcli.exact.field import Number, NumberField
from garkcli.exact.parametric import fraction
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import Mutable, field, replace
from garkcli.tableau.tableau import Tableau

MOST_POINTS = 60
"""Critical points, complex ones included, that are told apart; degrees of number fields are up to
that.
"""


class Comparison(Mutable):
    """Collects values that are compared.

    Attributes:
        design: of a family.
        step: whose methods are compared.
        extent: among what the best is the best.
        candidates: methods with their values.
        limits: values that are approached.
        gradients: the numerators of derivatives, by the coordinate.
        parts: of the solution set.
        share: the reading of ``time.monotonic`` until which critical points are looked for by
            Gröbner bases; None for no limit.
    """

    design: Design
    step: Step
    objective: Objective | Level
    extent: Extent = "all"
    candidates: list[Candidate] = field(default_factory=list)
    limits: list[Limit] = field(default_factory=list)
    gradients: list[tuple[str, Polynomial]] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)
    share: float | None = None

    def result(self) -> Minimum:
        """The best of what was collected."""
        if self.step.kind != "solutions":  # these are different already
            self.candidates = without_repeats(self.candidates)
        values = [x.value for x in self.candidates]
        values += [x.value for x in self.limits]
        best = self.best(values) if values else None
        minimisers = [x for x in self.candidates if x.value == best]
        limits = [x for x in self.limits if x.value == best]
        extent = self.extent_of(best) if values else self.extent
        if self.step.ideal is not None and not self.step.ideal.is_proved:
            extent = "found"
        name, gradient = None, None
        if len(self.gradients) == 1 and len(self.parts) == 1:
            [(name, gradient)] = self.gradients
        return Minimum(
            objective=self.objective,
            design=self.design,
            step=self.step,
            extent=extent,
            value=self.shown(best),
            minimisers=tuple(map(self._certified, minimisers)),
            limits=() if minimisers else tuple(limits),
            candidates=len(self.candidates),
            gradient=gradient,
            parameter=name,
            is_infinite=bool(values) and best is None,
        )

    @abstractmethod
    def best(self, values: Sequence[Size]) -> Size:
        """The best of some values."""

    @abstractmethod
    def extent_of(self, best: Size) -> Extent:
        """Among what the best value is the best."""

    def shown(self, value: Size) -> Size:
        """What people mean by a value."""
        return value

    @abstractmethod
    def value_of(self, solution: Solution, index: int) -> Size:
        """The value of one method."""

    @abstractmethod
    def over_line(self, part: Part) -> None:
        """The candidates of a part with one free coordinate."""

    @abstractmethod
    def over_variety(self, part: Part) -> None:
        """The candidates of a part of larger dimension."""

    def _certified(self, candidate: Candidate) -> Candidate:
        """With its order by the ordinary certificate."""
        solution = candidate.found.solution
        order = order_of(self.design.family, self.design.whose, solution)
        return replace(candidate, found=Found(solution, order, (candidate.index,)))

    def selection(self) -> None:
        """Finitely many solutions, which have been found already."""
        for found in self.step.found:
            if found.order is None:
                continue
            for index in found.accepted:
                self.add(found.solution, index)

    def by_theorem(self) -> bool:
        """The method with the least principal error of its pair, where a theorem knows it; whether
        it does.
        """
        criterion, ideal = self.step.criterion, self.step.ideal
        if criterion is None or ideal is None:
            return False
        best = least_error(criterion, self.step.order, ideal)
        for solution in () if best is None else solutions(best):
            for index, root in enumerate(solution.real):
                if is_admissible(self.design.family, solution, root):
                    self.add(solution, index)
        return bool(self.candidates)

    def over(self, part: Part) -> None:
        """The candidates of one part."""
        if part.dimension == 0:
            for point in _points(part):
                solution = self.whole(part, point)
                for index, root in enumerate(solution.real):
                    if is_admissible(self.design.family, solution, root):
                        self.add(solution, index)
        elif part.is_free and part.dimension == 1:
            self.over_line(part)
        else:
            self.over_variety(part)

    def whole(self, part: Part, solution: Solution) -> Solution:
        """A solution in the coordinates of a part as one in all unknowns."""
        values: dict[str, Number] = {}
        for name, x in part.values.items():
            over, under = fraction(x, part.ring)
            numerator = value_of(over, part.ring, solution.values)
            values[name] = numerator / value_of(under, part.ring, solution.values)
        return Solution(
            solution.modulus, solution.field, values, solution.multiplicity, solution.real
        )

    def add(
        self, solution: Solution, index: int, is_constant: bool = False, proof: Proof = "exact"
    ) -> None:
        """A method with its value."""
        method = Found(solution, None, (index,))
        value = self.value_of(solution, index)
        self.candidates.append(Candidate(value, method, index, is_constant, proof))

    def tableau(self, part: Part) -> Tableau:
        """The tableau with the coordinates of a part."""
        values = cast("Mapping[str, Number]", part.values)
        return member(self.design.tableau, self.design.family.ring, values)

    def tried(self, part: Part, rank: Callable[[Size], Any]) -> tuple[fmpq, ...] | None:
        """The coordinates of a good method of a part with several free ones, which proves nothing
        of others; None where none is found.

        Args:
            part: where there is one.
            rank: larger for better values.

        Raises:
            NotDecided: it has more coordinates than are tried, it is curved, or it takes too long.
        """
        self.extent = "found"
        names = part.ring.names
        if not part.is_free or len(names) > max(GRID):
            raise NotDecided

        def ranked(point: tuple[fmpq, ...]) -> Any:
            solution = self.at_point(part, point)
            if solution is None:
                return None
            return (rank(self.value_of(solution, 0)),)

        return climbed(ranked, len(names))

    def at_point(self, part: Part, point: tuple[fmpq, ...]) -> Solution | None:
        """The method at rational coordinates; None where there is none within the ranges."""
        values: dict[str, Number] = dict(zip(part.ring.names, point, strict=True))
        if not all(value_of(p, part.ring, values) for p in part.nonzero):
            return None
        origin = RealRoot.rational(fmpq(0))
        solution = self.whole(part, Solution(fmpq_poly([0, 1]), None, values, 1, (origin,)))
        if not is_admissible(self.design.family, solution, origin):
            return None
        return solution

    def conditions(self, part: Part) -> Conditions:
        """Which values of the one coordinate are allowed."""
        family = self.design.family

        def signs(polynomials: Iterable[fmpq_mpoly]) -> list[Polynomial]:
            expressed = (part.expressed(p, family.ring) for p in polynomials)
            return [in_one(sign_polynomial(x, part.ring)) for x in expressed]

        return Conditions(
            [in_one(p) for p in part.nonzero], signs(family.positive), signs(not_negative(family))
        )


def _points(part: Part) -> Iterator[Solution]:
    """The solutions of a part of dimension 0."""
    if not part.ring.names:
        origin = RealRoot.rational(fmpq(0))
        yield Solution(fmpq_poly([0, 1]), None, {}, 1, (origin,))
        return
    if part.ideal.degree > MOST_POINTS:
        raise NotDecided
    for solution in solutions(part.ideal):
        if all(value_of(p, part.ring, solution.values) for p in part.nonzero):
            yield solution


def at_root(name: str, root: RealRoot) -> Solution:
    """A real number as the value of an unknown, in the field that it generates."""
    monic = Polynomial.from_flint(root.polynomial).monic()
    modulus = monic.to_flint()
    value: Number
    if root.exact is not None:
        number_field, value = None, root.exact
    else:
        number_field = NumberField(modulus, ())
        value = number_field.from_coordinates([fmpq(0), fmpq(1)])
    roots = tuple(x for x, _ in real_roots(monic))
    return Solution(modulus, number_field, {name: value}, 1, roots)


_STRENGTH = ("exact", "exists", "numerical")


def without_repeats(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Each method once, with the most that is known of it, in the order of their first places."""
    by_value: dict[RealRoot | None, list[int]] = {}
    for place, candidate in enumerate(candidates):
        by_value.setdefault(candidate.value, []).append(place)
    kept: dict[int, Candidate] = {}
    for places in by_value.values():
        if len(places) == 1:
            kept[places[0]] = candidates[places[0]]
            continue
        same: dict[tuple[RealRoot, ...], list[int]] = {}
        for place in places:
            same.setdefault(_coordinates(candidates[place]), []).append(place)
        for group in same.values():
            kept[group[0]] = _joined([candidates[k] for k in group])
    return [kept[place] for place in sorted(kept)]


def _coordinates(candidate: Candidate) -> tuple[RealRoot, ...]:
    """The unknowns of a method, as real numbers."""
    solution = candidate.found.solution
    root = solution.real[candidate.index]
    return tuple(value_at(solution.values[name], root) for name in sorted(solution.values))


def _joined(same: Sequence[Candidate]) -> Candidate:
    """What is known of one method."""
    best = min(same, key=lambda x: _STRENGTH.index(x.proof))
    return replace(best, is_constant=any(x.is_constant for x in same))
