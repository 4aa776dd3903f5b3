"""Tableaus whose coefficients are rounded, and their order.

Each number of a file may be off by a radius of its own. All verdicts are about one method within
these radii (``order.recovering``). An order fails if provably no such method has it; else it is
undecided.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial

from flint import arb, ctx, fmpq

from garkcli.doing import doing
from garkcli.exact.display import decimal
from garkcli.exact.enclosing import bits_for, midpoint
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen, FrozenBut, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import are_few, count_conditions, elementary_weight
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import DEFAULT_LIMIT, Order, Witness, find_order, required_of
from garkcli.order.defects import BoxDefects, Defects
from garkcli.order.place import Derive
from garkcli.order.recovering import Recovery, RecoveryFailure
from garkcli.order.tolerance import NOT_FOUND
from garkcli.order.tree_residuals import TreeResiduals
from garkcli.tableau.box import Box, plain_box
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import NOTHING, Further, as_colours, with_weights
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.forms import pair, with_time
from garkcli.tableau.tableau import Edge, Tableau
from garkcli.upward import Shown


class Near(Frozen, eq=False):
    """A method on point stages, known to many bits; numbers below ``grain`` count as zero."""

    near: Tableau
    grain: fmpq


class RoundedTableau(Frozen, eq=False):
    """A rounded tableau with the method that it means; ``tolerance`` holds for most numbers."""

    tableau: Tableau
    tolerance: fmpq
    search: Recovery
    name: str = "method"

    @staticmethod
    def of(tableau: Tableau, tolerance: fmpq, box: Box, further: Further) -> RoundedTableau:
        """The rounded tableau of a box. If a construction joins stages with equal printed numbers,
        but not in all methods of the box, each coefficient counts as a printed number.
        """
        search = Recovery(box, further)
        made = search.origin.defects("method").tableau.made, search.origin.exact("method")
        if any(_shape(x) != _shape(tableau) for x in made):
            return RoundedTableau.within(tableau, tolerance, further)
        return RoundedTableau(tableau, tolerance, search)

    @staticmethod
    def within(tableau: Tableau, tolerance: fmpq, further: Further = NOTHING) -> RoundedTableau:
        return _around(tableau, further, tolerance, lambda _: tolerance)

    @staticmethod
    def printed(tableau: Tableau, units: Mapping[Number, fmpq]) -> RoundedTableau:
        """Every coefficient is off by its unit, or the largest if it is made of printed numbers."""
        largest = max(units.values(), default=fmpq(0))
        return _around(tableau, NOTHING, largest, lambda x: units.get(x, largest))

    @property
    def near(self) -> Tableau:
        """The method that it is taken to mean, to many bits."""
        return self.search.settled.exact(self.name)

    @property
    def widest(self) -> fmpq | None:
        """The largest error of an entry of b and A; None if a divisor may be 0."""
        whole = self.search.origin.in_balls(self.name)
        rows = [colour.b for colour in whole.colours]
        rows += [row for block in whole.blocks.values() for row in block]
        entries: Iterator[object] = (x for row in rows for x in row)
        radii = [x.rad() for x in entries if isinstance(x, arb)]
        if not all(x.is_finite() for x in radii):
            return None
        return max(map(midpoint, radii), default=ZERO)

    @property
    def further(self) -> Further:
        return self.search.settled.further

    @property
    def grain(self) -> fmpq:
        return self.search.settled.grain

    @property
    def off(self) -> fmpq:
        """The largest shift of a number of the method found so far."""
        search = self.search
        shifts = zip(search.place.shifts, search.box.radii, strict=True)
        return max((abs(x) * t for x, t in shifts), default=fmpq(0))

    @property
    def defects(self) -> Defects:
        return BoxDefects(self.tableau, self.search.origin.in_balls(self.name), self.search.bits)

    def meets(self, tree: Tree) -> bool:
        return self.search.settled.meets(self.name, tree)

    def allowed(self, tree: Tree) -> fmpq:
        return self.search.origin.reach(self.name, tree)

    def explains(self, tree: Tree) -> bool:
        """Whether some method that it may mean satisfies the condition of a tree."""
        is_rounded = bool(self.search.box.numbers)
        return is_rounded and self.search.origin.may_meet(self.name, tree)

    def conjugate(self) -> RoundedTableau:
        return self.derive("conjugate", conjugate)

    def pair(self) -> RoundedTableau:
        return self.derive("pair", pair)

    def with_time(self) -> RoundedTableau | None:
        """The tableau with time as last colour, whose blocks are the nodes; None if undefined."""
        timed = with_time(self.tableau)
        if timed is None:
            return None

        return self.derive("with time", _with_time)

    def with_embedded(self) -> RoundedTableau | None:
        """The method with the embedded weights as b; None if no rounded number is in it."""
        self.search.settled  # noqa: B018 -- it adds the tableau
        tolerance = self.search.largest_in("embedded")
        if not tolerance:
            return None
        printed = with_weights(self.tableau, self.search.printed_further.embedded or ())
        return RoundedTableau(printed, tolerance, self.search, "embedded")

    def with_dense(self) -> RoundedTableau | None:
        """The method with the rounding of dense output; None if no rounded number is in it."""
        powers = range(1, len(self.search.printed_further.powers) + 1)
        self.search.settled  # noqa: B018 -- it adds the tableaus
        tolerance = max(self.search.largest_in(f"power {power}") for power in powers)
        return replace(self, tolerance=tolerance) if tolerance else None

    def aside(self) -> RoundedTableau:
        """The tableau with a search of its own: further orders move another method."""
        return replace(self, search=self.search.aside())

    def of_orders(self) -> RoundedTableau:
        """The tableau for questions about orders alone, which take less time."""
        return replace(self, search=self.search.of_orders())

    def one_by_one(self, limit: int) -> RoundedOrder:
        """The order up to which rounding explains each condition alone; no method need meet all."""
        order, tree = self.search.explained(self.name, limit)
        witness = None if tree is None else _witness(self, tree)
        return RoundedOrder(order, self.tolerance, witness, rounded=self)

    def derive(self, kind: str, make: Derive) -> RoundedTableau:
        name, search = f"{kind} of {self.name}", self.search
        derived = make(self.tableau)
        base = search.targets[self.name]
        search.targets.setdefault(name, partial(_made_of, make, base))
        return RoundedTableau(derived, self.tolerance, search, name)


def _with_time(tableau: Tableau) -> Tableau:
    return with_time(tableau) or tableau


def _made_of(make: Derive, base: Derive, whole: Tableau) -> Tableau:
    return make(base(whole))


def _shape(tableau: Tableau) -> tuple[list[int], set[Edge]]:
    return [space.stages for space in tableau.spaces], set(tableau.blocks)


def _around(
    tableau: Tableau, further: Further, tolerance: fmpq, radius_of: Callable[[Number], fmpq]
) -> RoundedTableau:
    whole = as_colours(tableau, further)
    box = plain_box(whole, radius_of, tableau.size)
    return RoundedTableau(tableau, tolerance, Recovery(box, further))


FEW_TREES = 50_000
"""Most trees whose residuals are bounded one by one; those of more by spans."""
FEW_WITNESSES = 2_000
"""Most trees among which the witness is the one with the largest residual."""


class RoundedOrder(Shown, FrozenBut):
    """An order within ``tolerance``: one method there meets every condition up to ``order``.

    Attributes:
        order: the largest such order, a lower bound if there is no witness.
        tolerance: t > 0, the rounding of the coefficients.
        witness: a tree of the next order; no method within the tolerance meets its condition, or
            not together with the others. Its value is that of the printed digits.
        undecided: why the next order is undecided; empty if it is decided, or the search stopped.
        exact: the order up to which the printed digits meet all conditions exactly.
        rounded: the method.

    >>> from garkcli import find_order
    >>> order = find_order("ark-324")
    >>> order
    <RoundedOrder 3 within 1e-25>
    >>> order.order, order.exact
    (3, 0)
    """

    besides = frozenset({"rounded"})

    order: int
    tolerance: fmpq
    witness: Witness | None
    undecided: str = ""
    exact: int = 0
    rounded: RoundedTableau | None = None

    def __repr__(self) -> str:
        least = "at least " if self.is_lower_bound else ""
        return f"<RoundedOrder {least}{self.order} within {decimal(self.tolerance)}>"

    @property
    def is_lower_bound(self) -> bool:
        """Whether nothing is known to fail."""
        return self.witness is None

    @cached_property
    def sizes(self) -> tuple[arb, ...]:
        """A bound on |residual| for the printed digits at each order 1, 2, …"""
        zeros = (arb(0),) * min(self.exact, self.order)
        if self.rounded is None or self.order <= self.exact:
            return zeros
        tableau = self.rounded.tableau
        enclosure = enclose_tableau(tableau, self.rounded.search.bits)
        trees = TreeResiduals(tableau, enclosure) if tableau.is_listed else None
        sizes = []
        for order in range(self.exact + 1, self.order + 1):
            if trees and are_few(tableau, order, FEW_TREES):
                sizes.append(trees.sizes(order).bound)
            else:
                spans = ApproximateSpans(tableau, enclosure, arb(self.tolerance))
                sizes.append(spans.sizes(order).bound)
        return (*zeros, *sizes)

    @property
    def largest_residual(self) -> arb:
        """A bound on all |residuals| up to ``order``."""
        bound = arb(0)
        for size in self.sizes:
            bound = bound.max(size)
        return bound


@doing("order within the tolerance")
def find_order_within(
    rounded: RoundedTableau, limit: int = DEFAULT_LIMIT, exact: Order | None = None
) -> RoundedOrder:
    """The largest r ≤ ``limit`` for which one method within the rounding has order r. It also meets
    all that it was asked to meet before.
    """
    exact = exact or find_order(rounded.tableau, limit)
    limit = min(limit, rounded.tableau.exact_to or limit)
    if exact.witness is None:
        return RoundedOrder(exact.order, rounded.tolerance, None, "", exact.order, rounded)
    if not rounded.explains(exact.witness.tree) and rounded.search.note(
        rounded.name, exact.order, exact.witness.tree
    ):
        worst = _worst(rounded, exact.witness)
        return RoundedOrder(exact.order, rounded.tolerance, worst, "", exact.order, rounded)
    order, failure, missed = rounded.search.order_of(rounded.name, limit)
    if failure is None or not failure.is_proved:
        undecided = "" if failure is None else NOT_FOUND
        return RoundedOrder(order, rounded.tolerance, None, undecided, exact.order, rounded)
    tree = _most_telling(rounded, order + 1, failure, missed)
    witness = replace(_witness(rounded, tree), is_joint=rounded.explains(tree))
    return RoundedOrder(order, rounded.tolerance, witness, "", exact.order, rounded)


def _most_telling(
    rounded: RoundedTableau, order: int, failure: RecoveryFailure, missed: Sequence[Tree]
) -> Tree:
    """A tree that no method of the box meets, or the heaviest in the proof that none meets all."""
    unmet = next((u for u in missed if not rounded.explains(u)), None)
    if unmet is not None:
        return unmet
    return next((u for u in failure.trees if u.order == order), missed[0])


def _witness(rounded: RoundedTableau, tree: Tree) -> Witness:
    value = elementary_weight(rounded.tableau, tree)
    return Witness(tree, value, required_of(tree))


def _worst(rounded: RoundedTableau, witness: Witness) -> Witness:
    """The condition with the largest residual, or the witness if there are many."""
    order, tableau = witness.tree.order, rounded.tableau
    if not rounded.search.box.numbers or not tableau.is_listed:
        return witness
    if count_conditions(tableau, order) > FEW_WITNESSES:
        return witness
    missed = rounded.search.origin.missed(rounded.name, order)
    worst = next((u for u in missed if not rounded.explains(u)), None)
    return witness if worst is None else _witness(rounded, worst)


def tree_missed(tableau: Tableau, order: int, share: int, grain: fmpq) -> Tree | None:
    bits = bits_for(grain)
    trees = TreeResiduals(tableau, enclose_tableau(tableau, bits))
    with ctx.workprec(bits):
        sizes = [(abs(x), u) for x, _, u in trees.of_order(order, share)]
        missed = [(float(x.mid()), u) for x, u in sizes if not x < grain]
    return trees.table(order).tree(max(missed)[1]) if missed else None
