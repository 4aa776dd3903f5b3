"""Methods of an order by search, each with its proof."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.design import member as members
from garkcli.design.design import order_of
from garkcli.design.minimise import objective as aims
from garkcli.design.search.goals import levels_of, objective_on, terms_of
from garkcli.design.search.least_squares import least_squares
from garkcli.design.search.optimum import Optimisation, Optimum
from garkcli.design.search.points import Fixings, is_proved, polished
from garkcli.design.search.rational import (
    RationalFunction,
    as_float,
    in_decimals,
    over_box,
    polynomial_functions,
)
from garkcli.design.search.recognise import RecognisedNumbers, recognised
from garkcli.design.search.residuals import Generators, Residuals
from garkcli.design.search.snap import fixed_nearby, float_at, nodes_of, snapped, unknowns_of
from garkcli.design.solutions import Solution, value_at
from garkcli.design.steps import Found
from garkcli.design.want import Asked, numerators
from garkcli.errors import NotDecided
from garkcli.exact.field import ZERO, Number
from garkcli.exact.polynomial_text import root_decimal
from garkcli.exact.roots import RealRoot, square_root
from garkcli.frozen import Frozen, replace
from garkcli.order.certificate import find_order
from garkcli.problems.draw import Draw
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.family import Family

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array


Answer: TypeAlias = Literal["yes", "open", "no"]
ROUNDING = 1e-9
"""Floats whose size is less may be zero."""


class Signs:
    """Ranges and signs of a family; answers hold for all numbers within 2^(−bits/2) of a point."""

    def __init__(self, family: Family, bits: int) -> None:
        self.family = family
        self.bits = bits
        self.nonzero = polynomial_functions(family.nonzero, family.ring)
        self.positive = polynomial_functions(family.positive, family.ring)
        self.not_negative = polynomial_functions(members.not_negative(family), family.ring)

    def seem_kept(self, x: Array) -> bool:
        """Whether they hold in floats, up to rounding if zero is allowed; x is (unknowns, 1)."""
        return all(float_at(f, x) > ROUNDING for f in self.positive) and all(
            float_at(f, x) > -ROUNDING for f in self.not_negative
        )

    def decided(self, x: Array) -> Answer:
        """Whether numbers near x have them; ``open`` if a function wanted ≥ 0 may be 0."""
        with ctx.workprec(self.bits):
            box = x + arb(0, arb(1) / arb(2) ** (self.bits // 2))
            values = dict(zip(self.family.ring.names, box[:, 0], strict=True))
            for radical in self.family.radicals:
                meant = radical.meant
                if meant is None:
                    continue
                if not meant.ball(self.bits // 2).overlaps(values[radical.name]):
                    return "no"
            if any(over_box(f, box).contains(0) for f in self.nonzero):
                return "no"
            if not all(over_box(f, box) > 0 for f in self.positive):
                return "no"
            signs = [over_box(f, box) for f in self.not_negative]
            if any(value < 0 for value in signs):
                return "no"
            return "yes" if all(value >= 0 for value in signs) else "open"


Proof: TypeAlias = Literal["exact", "exists", "numerical"]
"""The proof of a find: of its exact order, of the existence of such a method, or small residuals
only.
"""
BITS = 1024
MANY_BITS = 4 * BITS
"""Precision of an optimum whose numbers are not recognised at the lower one."""
ERRORS = ("error", "A")
"""Objectives that vanish if a method has one order more."""
SHORT = 12
FEW_DIGITS = 6
DECIMALS = 40
"""Decimals of numbers that are not known exactly."""
FEW_BITS = 212
"""Precision that distinguishes a solution from a point with small residuals."""
USUAL = (0.0, 1.0)
WIDE = (-2.0, 2.0)
"""Start intervals of unknowns without a range."""
MEMORY = 48 * 2**20
"""Approximate bytes for the derivatives of one batch."""
MOST_STARTS = 1024


class Find(Frozen):
    """A method that was found.

    Attributes:
        start: the number of the start that led to it, from 1.
        order: its exact order if known; otherwise the order of the solved conditions.
        found: the exact numbers, if known.
        digits: otherwise the values to many digits, balls without radius.
        is_stable: whether it is known to have the wanted stability.
    """

    start: int
    proof: Proof
    order: int
    found: Found | None
    digits: Mapping[str, arb]
    is_stable: bool = True


class Search:
    """A search for methods of an order among those of a family; ZeroWeight without a conjugate."""

    def __init__(
        self,
        family: Family,
        order: int,
        whose: members.Whose = "method",
        objective: str | None = None,
    ) -> None:
        self.family = family if whose != "method" else _damped(family)
        self.order = order
        self.whose = whose
        self.tableau = members.TABLEAUS[whose](family.tableau)
        self.text = objective
        self.objective = None if objective is None else objective_on(objective, self.tableau)

    @cached_property
    def conditions(self) -> Residuals:
        return Residuals(self.tableau, self.family.ring, self.order, self._relations)

    @cached_property
    def batch(self) -> int:
        largest = self.conditions.numbers_a_point * 8
        return max(8, min(MOST_STARTS, MEMORY // largest))

    def starts(
        self, seed: int, count: int, first: list[float] | None = None
    ) -> Iterator[list[float]]:
        """Random values in the ranges, else in [0, 1], in every fourth start in [−2, 2]. ``first``
        replaces the first of them.
        """
        ends = {
            name: (as_float(least), as_float(greatest))
            for name, (least, greatest) in self.family.ranges.items()
            if least is not None and greatest is not None  # a range has both
        }
        draw = Draw(seed)
        for number in range(count):
            usual = WIDE if number % 4 == 3 else USUAL
            start: list[float] = []
            for name in self.family.ring.names:
                low, high = ends.get(name, usual)
                # a word has 64 bits, a float 53
                start.append(low + (high - low) * ((draw.word() >> 11) / 2**53))
            yield start if number or first is None else first

    def solve(self, starts: list[list[float]]) -> list[tuple[int, list[float]]]:
        """The starts of a batch that succeed, by their numbers, with solutions in floats."""
        import numpy as np

        columns = np.ascontiguousarray(np.array(starts).transpose())
        minima = least_squares(self.conditions.at, columns)
        return [
            (int(k), [float(x) for x in minima.points[:, k]])
            for k in np.flatnonzero(minima.succeeded)
            if self._is_within(minima.points[:, k])
        ]

    def _is_within(self, point: Array) -> bool:
        """Whether parameters are in their ranges and even roots not negative, up to rounding."""
        values = dict(zip(self.family.ring.names, map(float, point), strict=True))
        for name, (least, greatest) in self.family.ranges.items():
            if least is not None and values[name] < as_float(least) - ROUNDING:
                return False
            if greatest is not None and values[name] > as_float(greatest) + ROUNDING:
                return False
        roots = [values[radical.name] for radical in self.family.radicals if radical.is_even]
        return all(value >= -ROUNDING for value in roots)

    @cached_property
    def program(self) -> Optimisation:
        """The minimisation; UsageProblem without SciPy, or if the objective does not apply."""
        assert self.objective is not None
        return Optimisation(self.family, self.conditions, self.objective)

    def best(self, start: int, optimum: Optimum) -> Find | None:
        """An optimum with short numbers, and its proof; None if it is no method."""
        is_error = self.objective is not None and self.objective.key in ERRORS
        if is_error and self.program.is_none(optimum):
            # the errors are the conditions of the next order
            higher = Search(self.family, self.order + 1, self.whose).find(
                start, list(optimum.point)
            )
            if higher is not None and higher.found is not None and higher.is_stable:
                return higher
        optimum = self.program.settled(optimum)
        system, near = self.program.shortened(optimum, self._preferences[0])
        x = polished(system, list(near.point), BITS)
        if x is None:
            system = Fixings(self.conditions)
            x = polished(system, list(optimum.point), BITS)
        if x is None:
            return None
        exact = self._exact(start, x)
        if exact is None:
            # the optimum has fixed short numbers; others in their field may be long
            longer = polished(system, [float(a) for a in x[:, 0]], MANY_BITS)
            exact = None if longer is None else self._exact(start, longer, MANY_BITS)
        return exact or self._inexact(start, system, x)

    def value(self, find: Find) -> str:
        """The objective of a method as a decimal, or ``infinity``.

        A level is computed from the exact numbers; if these are unknown, or their field is too
        large, from floats, to fewer digits and at most ``HIGHEST``, since further digits of the
        numbers would decide it.
        """
        assert self.objective is not None
        if self.objective.key in ERRORS and find.order > self.order:
            return "0"
        terms = [
            (w, self._size(one, find, k))
            for k, (w, one) in enumerate(terms_of(self.objective, self.tableau))
        ]
        if not isinstance(self.objective, aims.WeightedSum):
            [(_, size)] = terms
            if isinstance(size, RealRoot):
                return root_decimal(size, SHORT)
            return "infinity" if size is None else f"{size:.{FEW_DIGITS}g}"
        if any(size is None for _, size in terms):
            return "-infinity"
        digits = FEW_DIGITS if any(isinstance(size, float) for _, size in terms) else SHORT
        with ctx.workprec(FEW_BITS):
            total = sum((arb(w) * _ball(size) for w, size in terms if size is not None), arb(0))
        return f"{float(total):.{digits}g}"

    def _size(self, one: aims.Single, find: Find, place: int) -> RealRoot | float | None:
        """The value of the objective at a place, for a find; None for infinity."""
        import numpy as np

        names, ring = self.family.ring.names, self.family.ring
        if isinstance(one, aims.LevelObjective) and find.found is not None:
            solution = find.found.solution
            with suppress(NotDecided):
                method = members.method_at(self.tableau, ring, solution, solution.real[0])
                if method is not None:
                    return one.measured(one.value(method))
        values: dict[str, Number] = {}
        digits = find.digits
        if find.found is not None:
            values = dict(find.found.solution.values)
            digits = _digits_of(find.found.solution)
        is_rational = all(isinstance(values.get(name), fmpq) for name in names)
        if isinstance(one, aims.LevelObjective) and not is_rational:
            return self.program.level(place, np.array([float(digits[x].mid()) for x in names]))
        if not is_rational:
            with ctx.workprec(BITS):
                values = {x: fmpq(in_decimals(digits[x], DECIMALS), 10**DECIMALS) for x in names}
        tableau = members.member(self.tableau, ring, values)
        if isinstance(one, aims.LevelObjective):
            return one.measured(one.value(tableau))
        further = members.further_member(self.family.further, ring, values)
        subject = aims.ObjectiveSubject.of(self.family, tableau, self.order, further)
        if isinstance(one, aims.SearchMeasure):
            return square_root(RealRoot.rational(one.squared(subject)))
        quotient = one.formula(subject, None)
        return RealRoot.rational(quotient.numerator / quotient.denominator)

    def embedded_order(self, find: Find) -> int | None:
        """The order of the embedded weights, by the certificate for exact numbers; None if not
        wanted.
        """
        wanted, embedded = self.family.embedded_order, self.family.further.embedded
        if wanted is None or embedded is None or self.whose != "method" or find.found is None:
            return wanted if self.whose == "method" else None
        tableau = with_weights(self.family.tableau, embedded)
        values = find.found.solution.values
        return find_order(members.member(tableau, self.family.ring, values)).order

    def find(self, start: int, point: list[float]) -> Find | None:
        """A solution in floats with its proof; None if it is no solution after all."""
        import numpy as np

        free = Fixings(self.conditions)
        if polished(free, point, FEW_BITS) is None:
            # the conditions are degenerate at this solution
            import numpy as np

            fixed = fixed_nearby(self.conditions, self._preferences[0], np.array(point)[:, None])
            x = polished(Fixings(self.conditions, fixed), point, BITS)
            if x is None:
                return None
            return self._exact(start, x)
        best: Find | None = None
        system, x = free, None
        for wanted in self._preferences:
            keeps = self._signs.seem_kept
            tried, near = snapped(self.conditions, wanted, np.array(point), keeps)
            made = polished(tried, [float(a) for a in near], BITS)
            if made is None:
                continue
            system, x = tried, made
            find = self._exact(start, made)
            if find is not None and (best is None or _worth(find) < _worth(best)):
                best = find
            if best is not None and _worth(best) == (False, 1):
                break
        if best is not None:
            return best
        find = None if x is None else self._inexact(start, system, x)
        if find is not None:
            return find
        # short numbers may violate signs that the point satisfies
        x = polished(free, point, BITS)
        return None if x is None else self._inexact(start, free, x)

    def _inexact(self, start: int, system: Fixings, x: Array) -> Find | None:
        """A find whose numbers are not known exactly; None if it violates a sign."""
        answer = self._signs.decided(x)
        if answer == "no":
            return None
        proving = Fixings(self._generators, system.fixed)
        proof: Proof = "numerical"
        if answer == "yes" and is_proved(proving, x, BITS, self._generators.denominators):
            proof = "exists"
        digits = dict(zip(self.family.ring.names, x[:, 0], strict=True))
        is_open = bool(self.family.stable or self.family.levels)
        return Find(start, proof, self.order, None, digits, is_stable=not is_open)

    @cached_property
    def _signs(self) -> Signs:
        return Signs(self.family, BITS)

    @cached_property
    def _generators(self) -> Generators:
        return Generators(self.tableau, self.family.ring, self.order, self._relations)

    @property
    def _relations(self) -> list[fmpq_mpoly]:
        relations = [radical.relation for radical in self.family.radicals]
        return [*relations, *self.family.relations]

    def _exact(self, start: int, x: Array, bits: int = BITS) -> Find | None:
        """The method with the exact numbers of these digits, if it has the order."""
        digits = dict(zip(self.family.ring.names, x[:, 0], strict=True))
        guess = recognised(digits, bits)
        return None if guess is None else self._certified(start, guess)

    @cached_property
    def _preferences(self) -> list[list[RationalFunction]]:
        """The unknowns to shorten, in two orders: one alone may lead to rational numbers."""
        nodes = list(nodes_of(self.tableau, self.family.ring))
        names = unknowns_of(self.family.ring)
        return [nodes + names, nodes + names[::-1]]

    def _certified(self, start: int, guess: RecognisedNumbers) -> Find | None:
        """The method with these numbers, if the certificate confirms the order."""
        field = next((x.field for x in guess.values.values() if not isinstance(x, fmpq)), None)
        solution = Solution(guess.modulus, field, dict(guess.values), 1, (guess.root,))
        ring = self.family.ring
        if any(members.value_of(x, ring, solution.values) for x in self._relations):
            return None
        if not all(members.value_of(p, ring, solution.values) for p in self.family.nonzero):
            return None
        if not members.is_admissible(self.family, solution, guess.root):
            return None
        order = order_of(self.family, self.whose, solution)
        if order is None or order.order < self.order:
            return None
        stable = members.is_as_stable(self.family, self.whose, solution, guess.root)
        is_meant = bool(stable) and self._has_levels(solution)
        return Find(start, "exact", order.order, Found(solution, order, (0,)), {}, is_meant)

    def _has_levels(self, solution: Solution) -> bool:
        """Whether a method is known to reach the wanted levels."""
        wanted = levels_of(self.family)
        if not wanted:
            return True
        with suppress(NotDecided):
            method = members.method_at(self.tableau, self.family.ring, solution, solution.real[0])
            if method is not None:
                return all(level.reaches(level.value(method), bound) for level, bound in wanted)
        return False


def _ball(number: RealRoot | float) -> arb:
    return arb(number) if isinstance(number, float) else number.ball(FEW_BITS)


def _digits_of(solution: Solution) -> Mapping[str, arb]:
    """The values at the first real root, to many digits."""
    root = solution.real[0]
    return {name: value_at(value, root).ball(BITS) for name, value in solution.values.items()}


def _damped(family: Family) -> Family:
    """The family with R(∞) = 0, which random methods never meet, if L-stable ones are wanted."""
    from garkcli.design.wants import at_infinity

    for wanted in family.stable:
        linear = family.tested(wanted)
        colours = range(linear.tableau.size) if wanted.colour is None else (wanted.colour,)
        if wanted.kind == "l-stable" and len(colours) == 1:
            meaning = at_infinity(Asked(linear.tableau, family.ring, ZERO, tuple(colours)))
            zeros = numerators(meaning.zeros, family.ring)
            family = replace(
                family,
                relations=(*family.relations, *zeros),
                nonzero=(*family.nonzero, *meaning.nonzero),
            )
    return family


def _worth(find: Find) -> tuple[bool, int]:
    """A key: smaller for better finds, stable ones first, then by the degree of their field."""
    return not find.is_stable, 0 if find.found is None else find.found.solution.degree
