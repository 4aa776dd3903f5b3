"""Conditions on the unknowns of a family near rounded numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.design.conditions import FamilyConditions
from garkcli.design.member import TABLEAUS, Whose, member
from garkcli.design.rounded_system import RoundedSystem
from garkcli.exact.field import Number
from garkcli.exact.parametric import fraction
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau


class RoundedConditions:
    """Conditions on the unknowns of a family: those of its order, and all others."""

    def __init__(self, family: Family, whose: Whose) -> None:
        self.family = family
        self.whose = whose
        self._conditions = FamilyConditions(TABLEAUS[whose](family.tableau), family.ring)

    @cached_property
    def _relations(self) -> list[fmpq_mpoly]:
        roots = [x.relation for x in self.family.radicals]
        return [p for p in (*roots, *self.family.relations) if p]

    @cached_property
    def _known(self) -> dict[int, list[Any]]:
        return {}

    def _of(self, order: int) -> list[Any]:
        if order not in self._known:
            self._known[order] = [x for x in self._conditions.of_order(order) if x.polynomial]
        return self._known[order]

    def of_order(self, order: int) -> list[fmpq_mpoly]:
        residuals = [x.polynomial for k in range(1, order + 1) for x in self._of(k)]
        return [*self._relations, *residuals]

    def of_known_numbers(self, order: int) -> Iterator[Tree]:
        """The trees up to an order whose conditions fail and have no unknowns."""
        for k in range(1, order + 1):
            yield from (x.tree for x in self._of(k) if x.polynomial.is_constant())

    def orders(self, values: Mapping[str, Number], grain: fmpq) -> tuple[int, int | None]:
        """The orders of the method with some values and of its embedded weights, None if it has
        none.

        Args:
            values: of all unknowns.
            grain: residuals below it count as zero.

        Raises:
            VanishingDenominator: no method has these values.
        """
        family, weights = self.family, self.family.further.embedded
        method = TABLEAUS[self.whose](member(family.tableau, family.ring, values))
        if weights is None or self.whose != "method":
            return _order_of(method, grain), None
        embedded = member(with_weights(family.tableau, weights), family.ring, values)
        return _order_of(method, grain), _order_of(embedded, grain)

    def admits(self, point: Sequence[arb], small: arb) -> bool:
        """Whether a point has the wanted ranges and signs, within its radii and ``small``."""
        family = self.family
        values = dict(zip(family.ring.names, point, strict=True))
        for name, (low, high) in family.ranges.items():
            if low is not None and values[name] < arb(low) - small:
                return False
            if high is not None and values[name] > arb(high) + small:
                return False

        def at(polynomials: Sequence[fmpq_mpoly]) -> list[arb]:
            system = RoundedSystem([p for p in polynomials if p], len(point), ctx.prec)
            return system.values(point)

        even = [x.name for x in family.radicals if x.is_even]
        roots = [family.ring.parameter(name).numerator for name in even]
        nonzero = at([*family.nonzero, *self._conditions.denominators])
        return (
            all(abs(x) > small for x in nonzero)
            and all(x > small for x in at(family.positive))
            and all(x > -small for x in at(family.not_negative))
            and all(x > -small for x in at(roots))
        )


def _order_of(tableau: Tableau, grain: fmpq) -> int:
    """The order of a method if residuals below ``grain`` count as zero."""
    from garkcli.order.rounded import tree_missed  # it imports numpy

    failing = (k for k in range(1, DEFAULT_LIMIT + 1) if tree_missed(tableau, k, 1, grain))
    return next(failing, DEFAULT_LIMIT + 1) - 1


class GenericWeights:
    """The elementary weights of a family whose known numbers are indeterminates."""

    def __init__(self, family: Family, whose: Whose) -> None:
        self.tableau = TABLEAUS[whose](family.tableau)
        self.ring = family.ring
        unknown = {*family.parameters, *(x.name for x in family.radicals)}
        self.unknowns = [k for k, name in enumerate(family.ring.names) if name in unknown]

    def are_known(self, tree: Tree) -> bool:
        """Whether the weight of a tree does not depend on the unknowns."""
        parts = fraction(elementary_weight(self.tableau, tree), self.ring)
        return not any(part.degrees()[k] > 0 for part in parts for k in self.unknowns)
