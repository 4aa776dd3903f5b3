"""The greatest level that a method has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.design.member import member
from garkcli.design.minimise.comparison import Comparison, at_root
from garkcli.design.minimise.levels import MOST_DEGREE, height, on_levels
from garkcli.design.minimise.objective import Level, Size
from garkcli.design.minimise.parts import Part
from garkcli.design.minimise.result import Candidate, Extent, Limit, Proof
from garkcli.design.solutions import Solution
from garkcli.design.step import Found
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import number_of


@dataclass
class Highest(Comparison):
    """Levels at critical values and at samples between them."""

    objective: Level

    def best(self, values: Sequence[Size]) -> Size:
        return max(values, key=height)

    def extent_of(self, best: Size) -> Extent:
        return "all" if best is None else self.extent

    def shown(self, value: Size) -> Size:
        return self.objective.shown(value)

    def value_of(self, solution: Solution, index: int) -> Size:
        values = _embedded(solution, index)
        if values is None:
            raise TooLarge
        ring = self.design.family.ring
        return self.objective.value(member(self.design.tableau, ring, values))

    def add(
        self, solution: Solution, index: int, is_constant: bool = False, proof: Proof = "exact"
    ) -> None:
        """A method with its value; those of number fields that are too large are left out."""
        try:
            super().add(solution, index, is_constant, proof)
        except TooLarge:
            self.extent = "found"

    def over_line(self, part: Part) -> None:
        """All candidates of a part with one free coordinate."""
        [name] = part.ring.names
        tableau = self.tableau(part)

        def level(t: fmpq) -> Size:
            return self.objective.value(member(tableau, part.ring, {name: t}))

        signs = self.objective.signs(tableau, part.ring)
        found = on_levels(level, signs, self.conditions(part))
        if not found.is_decided:
            self.extent = "found"
        for one in found.attained:
            solution = self.whole(part, at_root(name, one.t))
            known = Found(solution, None, (one.t.number,))
            # between critical numbers levels are monotone: the greatest is one of a constant
            is_constant = one.is_sample and not found.limits
            candidate = Candidate(found.greatest, known, one.t.number, is_constant)
            self.candidates.append(candidate)
        for toward in found.limits:
            self.limits.append(Limit(toward.value, name, toward))

    def over_variety(self, part: Part) -> None:
        """A good method by trial."""
        point = self.tried(part, height)
        if point is not None:
            solution = self.at_point(part, point)
            assert solution is not None
            self.add(solution, 0, proof="numerical")


class TooLarge(Exception):
    """A number field is too large for the engines of stability."""


def _embedded(solution: Solution, index: int) -> dict[str, Number] | None:
    """The values of one method as real numbers; None where their field is too large."""
    u = number_of(solution.real[index], MOST_DEGREE)
    if u is None:
        return None
    values: dict[str, Number] = {}
    for name, x in solution.values.items():
        if isinstance(x, Algebraic):
            values[name] = Polynomial.from_flint(x.poly)(u)
        else:
            values[name] = x
    return values
