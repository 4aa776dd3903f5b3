"""For which values of its parameters a family of methods has an order: exactly, and all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from time import monotonic
from typing import Literal, TypeAlias

from flint import fmpq_mpoly

from garkcli.design.admissible import is_admissible
from garkcli.design.conditions import FamilyConditions
from garkcli.design.groebner import NotDecided
from garkcli.design.ideal import Ideal
from garkcli.design.member import member
from garkcli.design.msolve import find_msolve
from garkcli.design.solutions import Solution, solutions
from garkcli.design.stable_solutions import is_stable, method_at
from garkcli.design.step import Found, Step
from garkcli.errors import ZeroWeight
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.family import Family
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from garkcli.upward import found

Whose: TypeAlias = Literal["method", "conjugate", "pair"]


@dataclass(frozen=True)
class Design:
    """What each order asks of the parameters of a family.

    Attributes:
        family: as it was read.
        whose: which order is meant.
        tableau: the tableau of it, its entries rational functions.
        steps: one an order, from 1 on.
    """

    family: Family
    whose: Whose
    tableau: Tableau
    steps: tuple[Step, ...]

    @property
    def last(self) -> Step:
        """The step of the highest order that was looked at."""
        return self.steps[-1]

    def reaches(self, order: int) -> bool:
        """Whether some values have the order, of a family at least complex ones."""
        return self.last.order >= order and self.last.may_have_methods

    def __repr__(self) -> str:
        reached = [step.order for step in self.steps if step.may_have_methods]
        highest = max(reached, default=0)
        return f"<Design {self.family.name}: order {highest} is reached>"

    def _repr_html_(self) -> str:
        html: str = found("report.notebook_texts", "design_html")(self)
        return html


SHARE = 0.25
"""The part of the time that python-flint has where msolve is there too: what it finds is proved."""
TABLEAUS: dict[Whose, Callable[[Tableau], Tableau]] = {
    "method": lambda tableau: tableau,
    "conjugate": conjugate,
    "pair": pair,
}
"""The tableau that is meant, from that of a file."""
CLAIMS: dict[Whose, str] = {"method": "order", "conjugate": "conjugate-order", "pair": "pair-order"}
"""What a file claims of the order found, by whose it is."""


def find_parameters(
    family: Family, order: int | None = None, whose: Whose = "method", seconds: float | None = None
) -> Design:
    """For which values of its parameters the members of a family have an order.

    Args:
        family: of methods.
        order: the order wanted; where it is not given, as far as some value reaches.
        whose: of the method, its symplectic conjugate, or its symplectic pair.
        seconds: after which what is not decided is left open; None for never.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
    """
    tableau = TABLEAUS[whose](family.tableau)
    conditions = FamilyConditions(tableau, family.ring)
    relations = [radical.relation for radical in family.radicals]
    order = order or family.order
    nonzero = (*conditions.denominators, *family.nonzero)
    now = monotonic()
    deadline = first = None
    if seconds is not None:
        has_other_engine = order is not None and find_msolve() is not None
        deadline = now + seconds
        first = now + SHARE * seconds if has_other_engine else deadline
    conditions.deadline = first
    start = Ideal(family.ring, nonzero, deadline).with_zeros(relations)
    steps: list[Step] = []
    if family.unsettled:
        step = Step(order or 1, "undecided", None)
        return Design(family, whose, tableau, (step,))
    ideal = start
    for k in range(1, (order or DEFAULT_LIMIT) + 1):
        step = _step(_Stage(conditions, start, k, family.relations, first), ideal)
        if step.kind == "undecided" and order is not None:
            step = _at_once(conditions, start, order, deadline, family.relations)
        if step.kind == "solutions":
            step = replace(step, found=_found(family, whose, step))
        steps.append(step)
        if step.ideal is None or not step.may_have_methods or step.order == order:
            break
        ideal = step.ideal
    return Design(family, whose, tableau, tuple(steps))


NO_TIME = 0.0
"""A deadline for what is small alone."""


@dataclass(frozen=True)
class _Stage:
    """What has to be decided of one order.

    Attributes:
        conditions: of the family.
        start: the ideal without any.
        order: that is asked for.
        wanted: what else has to vanish.
        deadline: until which it is tried.
    """

    conditions: FamilyConditions
    start: Ideal
    order: int
    wanted: Sequence[fmpq_mpoly]
    deadline: float | None

    @property
    def half(self) -> float | None:
        """When half of the time that is left is over."""
        if self.deadline is None:
            return None
        now = monotonic()
        return now + max(0.0, self.deadline - now) / 2

    def one_by_one(self, ideal: Ideal, deadline: float | None) -> Step:
        """The conditions of the order one after the other, beginning with the ideal of those of
        lower ones: small steps from one Gröbner basis to the next, and the first condition that
        cannot be met is known.
        """
        ideal = ideal.until(deadline)
        if self.order == 1:
            ideal = ideal.with_zeros(self.wanted)
        if ideal.is_everything:
            return Step(self.order, "none", ideal)
        for condition in self.conditions.of_order(self.order):
            ideal = ideal.with_zeros([condition.polynomial])
            if ideal.is_everything:
                return Step(self.order, "none", ideal, condition.tree)
        return self._told(ideal)

    def from_the_start(self, deadline: float | None) -> Step:
        """All conditions up to the order at once: bases in between may be larger than the last."""
        start = self.start.until(deadline)
        polynomials = list(self.wanted)
        for k in range(1, self.order):
            lower = self.conditions.of_order(k)
            polynomials += [condition.polynomial for condition in lower]
        last = self.conditions.of_order(self.order)
        added = [condition.polynomial for condition in last]
        ideal = start.with_zeros([*polynomials, *added])
        if not ideal.is_everything:
            return self._told(ideal)
        for count, condition in enumerate(last, start=1):
            part = start.with_zeros([*polynomials, *added[:count]])
            if part.is_everything:
                return Step(self.order, "none", part, condition.tree)
        raise AssertionError("the last part is the whole")

    def _told(self, ideal: Ideal) -> Step:
        ideal = ideal.until(self.start.deadline)
        if ideal.basis == self.start.basis:
            return Step(self.order, "every-value", ideal)
        if ideal.dimension > 0:
            return Step(self.order, "family", ideal)
        return Step(self.order, "solutions", ideal)


def _step(stage: _Stage, ideal: Ideal) -> Step:
    """What one order more asks of the parameters, and whatever else is wanted.

    Which way is quick is not known before: both are tried with small bases, then in the time that
    there is.
    """
    ways: tuple[Callable[[], Step], ...] = (
        lambda: stage.one_by_one(ideal, NO_TIME),
        lambda: stage.from_the_start(NO_TIME),
        lambda: stage.from_the_start(stage.half),
        lambda: stage.one_by_one(ideal, stage.deadline),
    )
    for way in ways:
        with suppress(NotDecided):
            return way()
    return Step(stage.order, "undecided", None)


def _at_once(
    conditions: FamilyConditions,
    start: Ideal,
    order: int,
    deadline: float | None,
    wanted: Sequence[fmpq_mpoly],
) -> Step:
    """All conditions up to an order in one system, by msolve."""
    polynomials = list(wanted)
    conditions.deadline = deadline
    try:
        for k in range(1, order + 1):
            polynomials += [condition.polynomial for condition in conditions.of_order(k)]
        ideal = start.with_zeros_unproved(polynomials, deadline)
    except NotDecided:
        return Step(order, "undecided", None)
    if ideal.is_everything:
        return Step(order, "undecided", ideal)
    if ideal.dimension > 0:
        return Step(order, "family", ideal)
    return Step(order, "solutions", ideal)


def _found(family: Family, whose: Whose, step: Step) -> tuple[Found, ...]:
    """The solutions of a step, each with its order by the ordinary certificate."""
    assert step.ideal is not None
    found = []
    for solution in solutions(step.ideal):
        accepted = []
        for index, root in enumerate(solution.real):
            if is_admissible(family, solution, root):
                accepted.append(index)
        order = order_of(family, whose, solution)
        one = Found(solution, order, tuple(accepted))
        if family.stable and order is not None:
            one = _stable(family, whose, one)
        found.append(one)
    return tuple(found)


def _stable(family: Family, whose: Whose, found: Found) -> Found:
    """A solution of which those real roots are accepted that are as stable as is wanted."""
    sorted_: dict[bool | None, list[int]] = {True: [], False: [], None: []}
    for index in found.accepted:
        root = found.solution.real[index]
        tableau = method_at(family, found.solution, root)
        verdict = None
        if tableau is not None:
            meant = TABLEAUS[whose](tableau)
            verdict = all(is_stable(key, meant) for key in family.stable)
        sorted_[verdict].append(index)
    accepted, unstable, left = (tuple(sorted_[key]) for key in (True, False, None))
    return replace(found, accepted=accepted, unstable=unstable, open=left)


def order_of(family: Family, whose: Whose, solution: Solution) -> Order | None:
    """The order of the method with some values, by the certificate; None where there is none."""
    try:
        tableau = member(family.tableau, family.ring, solution.values)
        return find_order(TABLEAUS[whose](tableau))
    except (ZeroDivisionError, ZeroWeight):
        return None
