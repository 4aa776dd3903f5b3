"""One method of a sweep: what its columns need is found once, and only where one asks for it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from flint import fmpq

from garkcli.errors import UsageProblem, ZeroWeight
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.order.constants import ErrorConstants, error_constants
from garkcli.order.simplifying import Simplifying, simplifying
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.properties.subject import Subject
from garkcli.stability.oscillator import PhaseError, oscillator_stability
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Judged:
    """A method with what is known of it.

    Attributes:
        tableau: the method, its coefficients meant exactly.
    """

    tableau: Tableau

    @cached_property
    def order(self) -> Order:
        """Its exact order."""
        return find_order(self.tableau)

    @cached_property
    def conjugate_order(self) -> Order | None:
        """That of its symplectic conjugate; None where a weight is zero."""
        try:
            return find_order(conjugate(self.tableau))
        except ZeroWeight:
            return None

    @cached_property
    def pair(self) -> Tableau | None:
        """Its symplectic pair; None where a weight is zero."""
        try:
            return pair(self.tableau)
        except ZeroWeight:
            return None

    @cached_property
    def pair_order(self) -> Order | None:
        """The exact order of the pair."""
        return None if self.pair is None else find_order(self.pair)

    @cached_property
    def simplifying(self) -> Simplifying:
        """B, C and D, and the bounds they give."""
        return simplifying(self.tableau, DEFAULT_LIMIT)

    @cached_property
    def pair_simplifying(self) -> Simplifying | None:
        """The same of the pair."""
        return None if self.pair is None else simplifying(self.pair, DEFAULT_LIMIT)

    @cached_property
    def constants(self) -> ErrorConstants | None:
        """The error constants at the first order that fails."""
        return _constants(self.tableau, self.order)

    @cached_property
    def pair_constants(self) -> ErrorConstants | None:
        """The same of the pair."""
        if self.pair is None or self.pair_order is None:
            return None
        return _constants(self.pair, self.pair_order)

    @cached_property
    def subject(self) -> Subject:
        """The method as its properties are decided."""
        return Subject(self.tableau, self.order.order, self.simplifying, DEFAULT_LIMIT)

    @cached_property
    def phase(self) -> PhaseError | None:
        """The phase error on the oscillator; None where it has no split for that."""
        problem = Oscillator.default(terms_of(self.tableau), fmpq(1))
        try:
            return oscillator_stability(self.tableau, problem).phase
        except UsageProblem:
            return None


def _constants(tableau: Tableau, order: Order) -> ErrorConstants | None:
    """None where the order is known from below only, or there are too many trees."""
    if order.is_lower_bound:
        return None
    found = error_constants(tableau, order.order + 1)
    return found if found is not None and found.is_exact else None
