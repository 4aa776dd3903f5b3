"""The order that a family has for every value, and the values for which it has a higher one."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.check.every_facts import Fact
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
from garkcli.order.certificate import Witness
from garkcli.order.conditions import elementary_weight
from garkcli.tableau.tableau import Tableau

SECONDS = 10.0
"""After so many it is undecided for which values the next order is reached."""


class EveryOrder(Frozen):
    """An order of a family.

    Attributes:
        tableau: whose order it is, for every value.
        fact: the order for every value, with the single values that have another; ``zeros`` are
            the polynomials whose common zeros have a higher one.
        witness: a tree whose condition is not met by every value, its elementary weight a rational
            function of the parameters; None where the limit was reached.
        dimension: of the set of values, real and complex, with the next order; −1 where it is
            empty, None where that was not decided.
        poles: polynomials: where one is zero a weight is, and there is no conjugate.
    """

    tableau: Tableau
    fact: Fact
    witness: Witness | None
    dimension: int | None
    poles: tuple[str, ...]

    @property
    def order(self) -> int:
        """The order for every value."""
        found = self.fact.value
        assert isinstance(found, int)
        return found


def every_order(family: EveryFamily, whose: Whose, limit: int) -> EveryOrder:
    """The order for every value, of the method, its conjugate or its pair.

    Args:
        family: of methods.
        whose: which order.
        limit: the order at which to stop.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
    """
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
    fact = _without(family, Fact(limit), lost)
    return EveryOrder(tableau, fact, None, None, poles)


def _without(family: EveryFamily, fact: Fact, lost: Sequence[fmpq_mpoly]) -> Fact:
    """The order where there is no such method with a zero of one of some polynomials."""
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
) -> tuple[Fact, int | None]:
    """The order with the values that have a higher one, and how many dimensions these have."""
    try:
        with within(SECONDS):
            ideal = start.with_zeros(zeros)
            dimension = ideal.dimension
            if dimension < 0:
                return Fact(order), dimension
            if dimension == 0:
                found = _real(family, whose, ideal)
                if family.has_one or not found:
                    return Fact(order, tuple(found)), dimension
            return Fact(order, zeros=family.common_zeros(ideal.polynomials)), dimension
    except NotDecided:
        return Fact(order, zeros=family.common_zeros(zeros)), None


def _real(family: EveryFamily, whose: Whose, ideal: Ideal) -> list[tuple[RealRoot, int | None]]:
    """The real solutions that the file admits, each with its order.

    Each is known by the value of its first parameter.
    """
    found = []
    for solution in solutions(ideal):
        order = order_of(family.family, whose, solution)
        for root in solution.real:
            values = {
                name: value_at(solution.values[name], root) for name in family.family.parameters
            }
            if is_admissible(family.family, solution, root):
                least = None if order is None else order.order
                found.append((next(iter(values.values())), least))
    return sorted(found, key=_place)
