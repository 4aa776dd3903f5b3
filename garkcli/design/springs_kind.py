"""Stability of a family of one parameter on a slow and a fast spring, as P-stability is decided.

For one slow frequency the step is a function of x = (hω_f)² and of the parameter t; stable means
that all powers of the step matrix are bounded for every x ≥ 0, or for every x up to a bound.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpq

from garkcli.design.stability_kinds import Members, eigenvalue_conditions, first_gap
from garkcli.design.step_plane import Step, through_members
from garkcli.exact.cells import Interval
from garkcli.exact.field import ZERO, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import at_y, curves, projected
from garkcli.exact.roots import RealRoot
from garkcli.stability.two_frequencies import (
    SplitSprings,
    line_of_determinants,
    springs,
    two_frequencies,
    unknowns_of,
)
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class TwoSprings:
    """Which springs are meant.

    Attributes:
        slow: (hω_s)² ≥ 0.
        fast: the term of the fast spring, counted from 0.
        greatest: the bound on x = (hω_f)²; None where there is none.
    """

    slow: fmpq
    fast: int
    greatest: fmpq | None = None


class SpringStability:
    """All powers of the step matrix on two springs are bounded for all fast frequencies."""

    def __init__(self, members: Members, tableau: Tableau, wanted: TwoSprings) -> None:
        self.members = members
        self.wanted = wanted
        split = self.split = springs(tableau, wanted.fast)
        unknowns = unknowns_of(tableau, split)

        def step(method: Tableau) -> Step:
            return _step(method, split, wanted.slow)

        self.plane = through_members(tableau, members.family.ring, unknowns, step)
        D = self.plane.denominator
        (a, b), (c, d) = self.plane.numerators
        self.signs = eigenvalue_conditions(self.plane)
        ends = [ZERO]
        if wanted.greatest is not None:
            ends.append(wanted.greatest)
        self.essential = projected(curves([D, *self.signs]), ends)
        deciding = [*self.signs, D, a + d, a * d - b * c, b, c]
        self.critical = projected(curves(deciding), ends)

    def decide(self, value: Number) -> bool:
        return any(self._is_enough(x) for x in self._stable(value))

    def witness(self, value: fmpq) -> fmpq | None:
        x = first_gap(self._stable(value))
        greatest = self.wanted.greatest
        if x is not None and greatest is not None and x > greatest:
            return None
        return x

    def conditions(self, x: fmpq) -> list[Polynomial]:
        return [at_y(p, x) for p in self.signs]

    def _stable(self, value: Number) -> tuple[Interval, ...]:
        tableau = self.members.at(value)
        if tableau is None:
            return ()
        return two_frequencies(tableau, self.split, self.wanted.slow).stable

    def _is_enough(self, interval: Interval) -> bool:
        """Whether all fast frequencies in question are in it."""
        if interval.start != RealRoot.rational(ZERO) or not interval.has_start:
            return False
        if interval.end is None:
            return True
        if self.wanted.greatest is None:
            return False
        greatest = RealRoot.rational(self.wanted.greatest)
        is_end = interval.has_end and greatest == interval.end
        return is_end or greatest < interval.end


def _step(method: Tableau, split: SplitSprings, slow: fmpq) -> Step:
    denominator, *entries = line_of_determinants(method, split, slow)
    return denominator, tuple(entries)
