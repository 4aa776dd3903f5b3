"""Which methods of a solution set have the least value of an objective.

The set is taken apart (``garkcli.design.minimise.parts``). Of single points all are compared. On a
part with one coordinate the objective is a rational function of it, and everything is compared:
critical points, ends, limits. On a part of larger dimension the critical points are found; what
happens at infinity is not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from time import monotonic
from typing import cast

from flint import fmpq, fmpq_mpoly, fmpq_poly

from garkcli.design.design import (
    Design,
    Found,
    Step,
    is_admissible,
    order_of,
)
from garkcli.design.groebner import NotDecided
from garkcli.design.member import member, value_of
from garkcli.design.minimise.critical import critical_equations
from garkcli.design.minimise.line import Conditions, on_line
from garkcli.design.minimise.objective import Objective
from garkcli.design.minimise.parts import Part, parts_of, parts_within
from garkcli.design.minimise.result import (
    Candidate,
    Extent,
    Limit,
    Minimum,
)
from garkcli.design.solutions import Solution, solutions, value_at
from garkcli.errors import UsageProblem
from garkcli.exact.cells import between
from garkcli.exact.field import Number, NumberField
from garkcli.exact.parametric import fraction
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots

MOST_POINTS = 60
"""Critical points, complex ones included, that are told apart; degrees of number fields are up to
that.
"""


def step_to_minimise(design: Design) -> Step:
    """The step of the highest order that has methods.

    Raises:
        UsageProblem: none is decided.
    """
    for step in reversed(design.steps):
        if step.ideal is not None and step.may_have_methods:
            return step
    raise UsageProblem(
        "--minimise: no order is known that methods of the file have",
        "values for some unknowns, by --set, make it decidable",
    )


def minimise(
    design: Design, objective: Objective, seconds: float | None = None
) -> Minimum:
    """The methods of the highest order with the least value of an objective.

    Args:
        design: of a family.
        objective: what is to be small.
        seconds: after which it is given up; None for never.

    Raises:
        UsageProblem: the objective has no meaning for the methods, or nothing was decided.
        NotDecided: a Gröbner basis takes too long.
    """
    step = step_to_minimise(design)
    deadline = None if seconds is None else monotonic() + seconds
    comparison = _Comparison(design, step, objective)
    if step.kind == "solutions":
        comparison.selection()
    else:
        assert step.ideal is not None
        for part in parts_of(step.ideal, deadline):
            comparison.over(part)
    return comparison.result()


@dataclass
class _Comparison:
    """Collects values that are compared."""

    design: Design
    step: Step
    objective: Objective
    extent: Extent = "all"
    candidates: list[Candidate] = field(default_factory=list)
    limits: list[Limit] = field(default_factory=list)
    gradients: list[tuple[str, Polynomial]] = field(default_factory=list)

    def result(self) -> Minimum:
        """The least of what was collected."""
        values = [x.value for x in self.candidates]
        values += [x.value for x in self.limits]
        least = min(values, default=None)
        minimisers = [x for x in self.candidates if x.value == least]
        limits = [x for x in self.limits if x.value == least]
        extent = self.extent
        if self.step.ideal is not None and not self.step.ideal.is_proved:
            extent = "found"
        if least == RealRoot.rational(fmpq(0)):
            extent = "all"  # a sum of squares
        name, gradient = None, None
        if len(self.gradients) == 1:
            [(name, gradient)] = self.gradients
        return Minimum(
            objective=self.objective,
            design=self.design,
            step=self.step,
            extent=extent,
            value=least,
            minimisers=tuple(map(self._certified, minimisers)),
            limits=() if minimisers else tuple(limits),
            candidates=len(self.candidates),
            gradient=gradient,
            parameter=name,
        )

    def _certified(self, candidate: Candidate) -> Candidate:
        """With its order by the ordinary certificate."""
        solution = candidate.found.solution
        order = order_of(self.design.family, self.design.whose, solution)
        accepted = (candidate.index,)
        found = Found(solution, order, accepted)
        return Candidate(
            candidate.value, found, candidate.index, candidate.is_constant
        )

    def selection(self) -> None:
        """Finitely many solutions, which have been found already."""
        for found in self.step.found:
            if found.order is None:
                continue
            for index in found.accepted:
                self._add(found.solution, index)

    def over(self, part: Part) -> None:
        """The candidates of one part."""
        if part.dimension == 0:
            for solution in _points(part):
                self._add_admissible(self._whole(part, solution))
        elif part.is_free and part.dimension == 1:
            self._over_line(part)
        else:
            self._over_variety(part)

    def _whole(self, part: Part, solution: Solution) -> Solution:
        """A solution in the coordinates of a part as one in all unknowns."""
        values: dict[str, Number] = {}
        for name, x in part.values.items():
            over, under = fraction(x, part.ring)
            numerator = value_of(over, part.ring, solution.values)
            values[name] = numerator / value_of(
                under, part.ring, solution.values
            )
        return Solution(
            solution.modulus,
            solution.field,
            values,
            solution.multiplicity,
            solution.real,
        )

    def _add_admissible(self, solution: Solution) -> None:
        for index, root in enumerate(solution.real):
            if is_admissible(self.design.family, solution, root):
                self._add(solution, index)

    def _add(
        self, solution: Solution, index: int, is_constant: bool = False
    ) -> None:
        """A method with its value."""
        ring = self.design.family.ring
        tableau = member(self.design.tableau, ring, solution.values)
        made = self.objective.formula(tableau, self.step.order, None)
        number = made.numerator / made.denominator
        value = value_at(number, solution.real[index])
        found = Found(solution, None, (index,))
        self.candidates.append(Candidate(value, found, index, is_constant))

    def _formula(self, part: Part) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """The objective as a function of the coordinates of a part."""
        values = cast("Mapping[str, Number]", part.values)
        ring = self.design.family.ring
        tableau = member(self.design.tableau, ring, values)
        made = self.objective.formula(tableau, self.step.order, part.ring)
        quotient = part.ring.quotient(made.numerator, made.denominator)
        return fraction(quotient, part.ring)

    def _over_line(self, part: Part) -> None:
        """All candidates of a part with one free coordinate."""
        [name] = part.ring.names
        allowed = self._conditions(part)
        numerator, denominator = self._formula(part)
        N, D = in_one(numerator), in_one(denominator)
        found = on_line(N, D, allowed)
        self.gradients.append((name, found.gradient))
        if not found.gradient:
            for interval in allowed.intervals:
                t = between(interval.start, interval.end)
                root = RealRoot.rational(t)
                solution = self._whole(part, at_root(name, root))
                self._add(solution, 0, is_constant=True)
            return
        for one in found.attained:
            solution = self._whole(part, at_root(name, one.t))
            known = Found(solution, None, (one.t.number,))
            self.candidates.append(Candidate(one.value, known, one.t.number))
        for toward in found.limits:
            self.limits.append(Limit(toward.value, name, toward))

    def _conditions(self, part: Part) -> Conditions:
        """Which values of the one coordinate are allowed."""
        family = self.design.family
        positive = [*family.positive]
        not_negative = [*family.not_negative, *self._ends()]
        signs = {}
        for sign, polynomials in (
            ("positive", positive),
            ("not_negative", not_negative),
        ):
            signs[sign] = [
                in_one(_sign_of(part, p, self.design)) for p in polynomials
            ]
        nonzero = [in_one(p) for p in part.nonzero]
        return Conditions(nonzero, **signs)

    def _ends(self) -> Iterator[fmpq_mpoly]:
        """Polynomials that are not negative within the ranges of the file."""
        family = self.design.family
        for name, (least, greatest) in family.ranges.items():
            unknown = family.ring.context.gen(family.ring.names.index(name))
            if least is not None:
                yield unknown - least
            if greatest is not None:
                yield greatest - unknown

    def _over_variety(self, part: Part) -> None:
        """The critical points of a part of larger dimension, and those on its edges."""
        if self.extent == "all":
            self.extent = "critical-points"
        numerator, denominator = self._formula(part)
        critical = critical_equations(part, numerator, denominator)
        self._over_smaller(part, critical)
        for end in (*self.design.family.not_negative, *self._ends()):
            edge, _ = fraction(
                part.expressed(end, self.design.family.ring), part.ring
            )
            if not edge.is_constant():
                self._over_smaller(part, [edge])

    def _over_smaller(self, part: Part, zeros: list[fmpq_mpoly]) -> None:
        """The candidates of a subset of a part."""
        for smaller in parts_within(part, zeros):
            if smaller.dimension < part.dimension:
                self.over(smaller)
                continue
            # the objective is constant, and no method is at hand
            raise UsageProblem(
                f"--minimise {self.objective.key}: the objective is constant along a set of"
                f" dimension {smaller.dimension}",
                "choose values with --choose, which makes the set smaller",
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
        values = [
            value_of(p, part.ring, solution.values) for p in part.nonzero
        ]
        if all(values):
            yield solution


def _sign_of(part: Part, p: fmpq_mpoly, design: Design) -> fmpq_mpoly:
    """A polynomial in the coordinates with the sign of one in all unknowns."""
    over, under = fraction(part.expressed(p, design.family.ring), part.ring)
    return over * under


def in_one(p: fmpq_mpoly) -> Polynomial:
    """A polynomial in one variable."""
    powers = {int(k): fmpq(a) for (k,), a in p.to_dict().items()}
    highest = max(powers, default=-1)
    return Polynomial([powers.get(k, fmpq(0)) for k in range(highest + 1)])


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
