"""The comparison of the methods of a solution set, and the best of them."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, cast

from flint import fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.design import Design, further_of, order_of
from garkcli.design.ideal import Ideal
from garkcli.design.member import further_member, is_admissible, is_as_stable, member, not_negative
from garkcli.design.minimise.climbing import GRID, Point, climbed
from garkcli.design.minimise.line import Constraints, Within
from garkcli.design.minimise.objective import LevelObjective, Objective, ObjectiveSubject, Size
from garkcli.design.minimise.result import Candidate, Extent, Minimum, ObjectiveLimit, Proof
from garkcli.design.pairs import least_error
from garkcli.design.parts import Part, RationalChart, charts, points_of
from garkcli.design.solutions import Solution, solutions
from garkcli.design.stable_parts import is_on, stable_part
from garkcli.design.steps import Decided, Found, Solutions
from garkcli.design.want import sign_polynomial
from garkcli.errors import NotDecided
from garkcli.exact.cells import ends_of
from garkcli.exact.field import Number
from garkcli.exact.parametric import fraction
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Mutable, field, replace
from garkcli.tableau.tableau import Tableau


class Minimisation(Mutable):
    """Collects the values to compare.

    Attributes:
        extent: the methods among which the best one is best.
        gradients: coordinates with the numerators of derivatives in them.
        share: the end of the search for critical points by Gröbner bases on ``time.monotonic``.
        is_open: whether the stability of methods that may be better is undecided.
    """

    design: Design
    step: Decided
    objective: Objective | LevelObjective
    extent: Extent = "all"
    candidates: list[Candidate] = field(default_factory=list)
    limits: list[ObjectiveLimit] = field(default_factory=list)
    gradients: list[tuple[str, Polynomial]] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)
    share: float | None = None
    is_open: bool = False

    def result(self) -> Minimum:
        if not isinstance(self.step, Solutions):  # these are distinct already
            self.candidates = without_repeats(self.candidates)
        values = [x.value for x in self.candidates]
        values += [x.value for x in self.limits]
        best = self.best(values) if values else None
        minimisers = [x for x in self.candidates if x.value == best]
        limits = [x for x in self.limits if x.value == best]
        extent = self.extent_of(best) if values else self.extent
        if not self.step.is_all:
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
        """The methods among which the best value is the best."""

    def shown(self, value: Size) -> Size:
        return value

    @abstractmethod
    def value_of(self, solution: Solution, index: int) -> Size:
        """The value of one method."""

    @abstractmethod
    def over_line(self, part: Part) -> None:
        """Adds the candidates of a part with one free coordinate."""

    @abstractmethod
    def over_variety(self, part: Part) -> None:
        """Adds the candidates of a part of larger dimension."""

    def _certified(self, candidate: Candidate) -> Candidate:
        solution = candidate.found.solution
        of_method = self.design.family, self.design.whose, solution
        certified = Found(
            solution, order_of(*of_method), (candidate.index,), **further_of(*of_method)
        )
        return replace(candidate, found=certified)

    def selection(self) -> None:
        # solutions are known already
        for found in self.step.found:
            if found.order is None:
                continue
            for index in found.accepted:
                self.add(found.solution, index)

    def by_theorem(self) -> bool:
        """Adds the method with the least principal error of its pair, if a theorem gives it."""
        step, ideal, criterion = self.step, self.step.ideal, self.design.criterion_of(self.step)
        if criterion is None or not isinstance(ideal, Ideal):
            return False
        is_stable = step.known.of_stable is not None
        best = least_error(criterion, step.order, ideal, is_stable)
        for solution in () if best is None else solutions(best):
            for index, root in enumerate(solution.real):
                if self.takes(solution, root):
                    self.add(solution, index)
        return bool(self.candidates)

    def over(self, part: Part) -> None:
        if part.dimension == 0:
            for point in points_of(part):
                solution = part.extended(point)
                for index, root in enumerate(solution.real):
                    if self.takes(solution, root, part):
                        self.add(solution, index)
        elif part.is_free and part.dimension == 1 and self.is_settled(part):
            self.over_line(part)
        else:
            self.over_variety(part)

    def over_whole(self, part: Part) -> None:
        """Adds the candidates of a part of the solution set, only stable ones if wanted."""
        family = self.design.family
        parts = [part]
        if family.stable and part.dimension > 0:
            with suppress(NotDecided):
                stable = stable_part(family, self.design.whose, part)
                parts = list(stable.parts)
                if not stable.is_decided:
                    self.extent, self.is_open = "found", True
        check_time()
        for one in parts:
            self.parts.append(one)
            if not self.is_worse(one):
                self.over(one)

    def is_worse(self, part: Part) -> bool:  # noqa: ARG002
        # whether all methods of a part are known to be worse than the best one so far
        return False

    def is_settled(self, part: Part) -> bool:
        return bool(part.sets) or not self.design.family.stable

    def takes(self, solution: Solution, root: RealRoot, part: Part | None = None) -> bool:
        design = self.design
        if part is not None and not is_on(design.family, part, solution, root):
            return False
        if part is not None and self.is_settled(part):
            return True
        if not is_admissible(design.family, solution, root):
            return False
        stable = is_as_stable(design.family, design.whose, solution, root)
        if stable is None:
            self.extent, self.is_open = "found", True
        return bool(stable)

    def add(
        self, solution: Solution, index: int, is_constant: bool = False, proof: Proof = "exact"
    ) -> None:
        method = Found(solution, None, (index,))
        value = self.value_of(solution, index)
        self.candidates.append(Candidate(value, method, index, is_constant, proof))

    def subject(self, values: Mapping[str, Any]) -> ObjectiveSubject:
        family = self.design.family
        further = further_member(family.further, family.ring, values)
        tableau = member(self.design.tableau, family.ring, values)
        return ObjectiveSubject.of(family, tableau, self.step.order, further)

    def tableau(self, part: Part) -> Tableau:
        values = cast("Mapping[str, Number]", part.values)
        return member(self.design.tableau, self.design.family.ring, values)

    def tried(self, part: Part, rank: Callable[[Size], Any]) -> tuple[RationalChart, Point] | None:
        """A good method of a part by trial, with its chart and free coordinates, or None. ``rank``
        is larger for better values. Raises NotDecided if the part has no charts or too many
        coordinates, or the search takes too long.
        """
        self.extent = "found"
        all_charts = charts(part)
        if not all_charts or len(all_charts[0].names) > max(GRID):
            raise NotDecided
        best: tuple[Any, RationalChart, Point] | None = None
        for chart in all_charts:

            def ranked(point: Point, chart: RationalChart = chart) -> Any:
                solution = self.at_point(part, chart, point)
                if solution is None:
                    return None
                return (rank(self.value_of(solution, chart.index)),)

            point = climbed(ranked, len(chart.names))
            if point is not None and (best is None or ranked(point) > best[0]):
                best = ranked(point), chart, point
        return None if best is None else best[1:]

    def at_point(self, part: Part, chart: RationalChart, point: Point) -> Solution | None:
        """A method by its free coordinates; None if there is none in the comparison."""
        solution = chart.point(part, point)
        if solution is None or not self.takes(solution, solution.real[chart.index], part):
            return None
        return solution

    def edges(self, part: Part) -> Iterator[fmpq_mpoly]:
        """Polynomials that vanish at the boundary of the compared methods."""
        family = self.design.family
        for end in not_negative(family):
            yield fraction(part.expressed(end, family.ring), part.ring)[0]
        for name, intervals in part.sets:
            x = cast("Any", part.values[name])
            for polynomial in ends_of(intervals):
                yield fraction(polynomial(x), part.ring)[0]

    def conditions(self, part: Part) -> Constraints:
        family = self.design.family

        def signs(polynomials: Iterable[fmpq_mpoly]) -> list[Polynomial]:
            expressed = (part.expressed(p, family.ring) for p in polynomials)
            return [in_one(sign_polynomial(x, part.ring)) for x in expressed]

        return Constraints(
            [in_one(p) for p in part.nonzero],
            signs(family.positive),
            signs(not_negative(family)),
            [
                Within(in_one(over), in_one(under), intervals)
                for name, intervals in part.sets
                for over, under in [fraction(part.values[name], part.ring)]
            ],
        )


_STRENGTH = ("exact", "exists", "numerical")


def without_repeats(candidates: Sequence[Candidate]) -> list[Candidate]:
    """The distinct methods with the strongest proof of each, in the order of their first places."""
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
            one = candidates[place]
            coordinates = one.found.solution.real_values[one.index]
            key = tuple(coordinates[name] for name in sorted(coordinates))
            same.setdefault(key, []).append(place)
        for group in same.values():
            repeats = [candidates[k] for k in group]
            best = min(repeats, key=lambda x: _STRENGTH.index(x.proof))
            kept[group[0]] = replace(best, is_constant=any(x.is_constant for x in repeats))
    return [kept[place] for place in sorted(kept)]
