"""The order of a family for all values, and the values with a higher order."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.check.every_facts import FamilyFact
from garkcli.check.every_family import EveryFamily
from garkcli.deadline import within
from garkcli.design.conditions import FamilyConditions
from garkcli.design.design import order_of
from garkcli.design.ideal import Ideal
from garkcli.design.member import TABLEAUS, Whose, is_admissible
from garkcli.design.solutions import solutions, value_at
from garkcli.errors import NotDecided
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, replace
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import Witness
from garkcli.tableau.tableau import Tableau

SECONDS = 10.0
"""Seconds for the values with the next order; then they are undecided."""


class EveryOrder(Frozen):
    """An order of a family, higher at the common zeros of ``fact.zeros``. The complex values for
    the next order have ``dimension``: −1 if there are none, None if undecided.
    """

    tableau: Tableau
    fact: FamilyFact
    witness: Witness | None
    dimension: int | None
    poles: tuple[str, ...]

    @property
    def order(self) -> int:
        value = self.fact.value
        assert isinstance(value, int)
        return value


def every_order(family: EveryFamily, whose: Whose, limit: int) -> EveryOrder:
    """Returns the order for all values; ZeroWeight if no value has a conjugate."""
    ring = family.ring
    tableau = TABLEAUS[whose](family.tableau)
    conditions = FamilyConditions(tableau, ring)
    apart = (*conditions.denominators, *family.family.nonzero)
    start = Ideal(ring, apart).with_zeros(family.relations)
    lost = [] if whose == "method" else family.lost
    poles = tuple(map(ring.text, lost))
    for k in range(1, limit + 1):
        missed = [
            condition
            for condition in conditions.of_order(k)
            if not start.contains(condition.polynomial)
        ]
        if not missed:
            continue
        zeros = [condition.polynomial for condition in missed]
        fact, dimension = _higher(family, whose, k - 1, start, zeros)
        fact = _without(family, fact, lost)
        tree = missed[0].tree
        witness = Witness(tree, elementary_weight(tableau, tree), fmpq(1, tree.density))
        return EveryOrder(tableau, fact, witness, dimension, poles)
    fact = _without(family, FamilyFact(limit), lost)
    return EveryOrder(tableau, fact, None, None, poles)


def _without(family: EveryFamily, fact: FamilyFact, lost: Sequence[fmpq_mpoly]) -> FamilyFact:
    """Returns the order, with None at the zeros of polynomials, where there is no such method."""
    if not family.has_one:
        texts = [family.ring.text(p) for p in lost]
        return replace(fact, elsewhere=tuple((x, None) for x in texts))
    roots = family.roots(lost)
    kept = [x for x in fact.special if x[0] not in roots]
    none = [(root, None) for root in roots]
    return replace(fact, special=tuple(sorted([*kept, *none], key=_place)))


def _place(special: tuple[RealRoot, object]) -> RealRoot:
    return special[0]


def _higher(
    family: EveryFamily, whose: Whose, order: int, start: Ideal, zeros: list[fmpq_mpoly]
) -> tuple[FamilyFact, int | None]:
    try:
        with within(SECONDS):
            ideal = start.with_zeros(zeros)
            dimension = ideal.dimension
            if dimension < 0:
                return FamilyFact(order), dimension
            if dimension == 0:
                real_values = _real(family, whose, ideal)
                if family.has_one or not real_values:
                    return FamilyFact(order, tuple(real_values)), dimension
            return FamilyFact(order, zeros=family.common_zeros(ideal.polynomials)), dimension
    except NotDecided:
        return FamilyFact(order, zeros=family.common_zeros(zeros)), None


def _real(family: EveryFamily, whose: Whose, ideal: Ideal) -> list[tuple[RealRoot, int | None]]:
    real_values = []
    for solution in solutions(ideal):
        order = order_of(family.family, whose, solution)
        for root in solution.real:
            values = {
                name: value_at(solution.values[name], root) for name in family.family.parameters
            }
            if is_admissible(family.family, solution, root):
                least = None if order is None else order.order
                real_values.append((next(iter(values.values())), least))
    return sorted(real_values, key=_place)
