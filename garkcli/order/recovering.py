"""Finds one method within the rounding of a print that meets the conditions its digits suggest.

Conditions that hold within the radii of the printed numbers, one by one, need not hold together.
So Newton's method on affine rows searches for a method that meets them, to hundreds of digits:
first the conditions of its shape (B, C stage by stage, D, symplecticity, equal rows), then its
order conditions. A combination of the rows that is nonzero in the whole box excludes all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from functools import cached_property
from typing import Any

from flint import arb, fmpq

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.exact.affine import Affine
from garkcli.exact.enclosing import midpoint
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order import bounded
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.place import BoxPlace, SearchedBox, arithmetic
from garkcli.order.recovered import as_data, key_of, recovered_of
from garkcli.order.rows import Chosen, Label, System, may_vanish, of_tree
from garkcli.order.shape import NATURAL, candidates, less, weak_rows
from garkcli.tableau.box import Box
from garkcli.tableau.embedded import NOTHING, Further

COARSE = 1e-6
"""Slopes are renewed while radii and residuals are larger."""
MOST_WEAK = 6
MOST_RUNS = 40
MAX_STEPS = 25
MAX_SHIFT = 50.0
LOWEST_FLOOR = 1e-16


class RecoveryFailure(Frozen, eq=False):
    """Why no method of the box meets some rows, the heaviest first; ``is_proved`` if none does."""

    is_proved: bool
    labels: tuple[tuple[str, Label], ...] = ()

    @property
    def trees(self) -> list[Tree]:
        return [label.tree for _, label in self.labels if label.tree is not None]


class Recovery(SearchedBox):
    def __init__(self, box: Box, further: Further = NOTHING) -> None:
        super().__init__(box, further)
        self.place = self.origin
        self._dense: tuple[int, RecoveryFailure | None] = 0, None
        self.shape: System = {}
        self.system: System = {}
        self._orders: dict[str, tuple[int, RecoveryFailure | None, list[Tree], int]] = {}
        self._places: dict[str, BoxPlace] = {}
        self._reached: dict[str, int] = {}
        self._runs = 0
        self._has_shape = self._is_settled = False

    @property
    def settled(self) -> BoxPlace:
        """The method that the box is taken to mean, with the orders of its own weights at least."""
        if not self._is_settled:
            self._is_settled = True
            if not self._has_shape:
                self._has_shape = True
                self._recover_shape_and_orders()
            self.order_of("method", DEFAULT_LIMIT)
            self._recover_weak()
            self.add_further()
            if self.printed_further.embedded is not None:
                self.order_of("embedded", DEFAULT_LIMIT)
            if self.printed_further.dense is not None:
                self._dense = self.recover_dense(DEFAULT_LIMIT)
        return self.place

    @property
    def kept(self) -> tuple[str, dict[str, Any]]:
        """The key of the printed numbers, and the start of a later search, if any."""
        place, key = self.settled, key_of(self.box)
        if place.slack or place is self.origin:
            return key, {}
        return key, as_data(place.shifts, self.shape, self.system)

    @property
    def wanted(self) -> System:
        return _both(self.shape, self.system)

    def largest_in(self, name: str) -> fmpq:
        """The largest radius of the numbers that a tableau depends on; 0 if it is exact."""
        made = self.origin.defects(name).tableau.made
        rows = [row for colour in made.colours for row in (colour.b, colour.c)]
        rows += [row for block in made.blocks.values() for row in block]
        entries: Iterator[object] = (x for row in rows for x in row)
        forms = (x for x in entries if isinstance(x, Affine))
        found = {k for x in forms for k, slope in x.slopes.items() if slope}
        return max((self.box.radii[k] for k in found), default=fmpq(0))

    def finer(self, bits: int) -> Recovery:
        other = copy(self)
        other.bits = max(self.bits, bits)
        return other

    def aside(self) -> Recovery:
        """A copy that moves a method of its own."""
        other = copy(self)
        for name in ("_orders", "_places", "_reached", "powers"):
            setattr(other, name, dict(getattr(self, name)))
        other._runs = 0
        return other

    def of_orders(self) -> Recovery:
        """A new search for orders alone, whatever shape the digits suggest."""
        other = Recovery(self.box, self.printed_further)
        other.targets = dict(self.targets)
        other.add_further()
        other._has_shape = other._is_settled = True
        return other

    def missed_at(self, place: BoxPlace) -> dict[str, list[Tree]]:
        other = copy(self)
        other.place = place
        return other._missed(self._reached)

    def recover_dense(self, limit: int) -> tuple[int, RecoveryFailure | None]:
        """Moves to the largest order of dense output; returns why there is no larger one."""
        dense = self.printed_further.dense
        assert dense is not None
        self.add_further()
        for order in range(1, min(limit, dense.degree) + 1):
            failure = self._try(dict.fromkeys(self.powers, order))
            if failure is not None:
                return order - 1, failure
        return min(limit, dense.degree), None

    def excludes_dense(self, order: int) -> bool:
        self.settled  # noqa: B018 -- it looks for that
        reached, failure = self._dense
        if order > len(self.printed_further.powers):
            return True  # there is no coefficient of such a power
        return order == reached + 1 and failure is not None and failure.is_proved

    def note(self, name: str, order: int, missed: Tree) -> bool:
        """Records an order that printed digits reach; no method of the box meets the tree
        ``missed``. Returns False, without a record, if the method found so far is below that order.
        """
        if self.place is not self.origin and name not in self._reached:
            with np.errstate(all="ignore"):
                if any(self.place.missed(name, q) for q in range(1, order + 1)):
                    return False
        failure = RecoveryFailure(True, ((name, of_tree(missed)),))
        self._orders.setdefault(name, (order, failure, [missed], order + 1))
        self._reached.setdefault(name, order)
        return True

    def order_of(self, name: str, limit: int) -> tuple[int, RecoveryFailure | None, list[Tree]]:
        with np.errstate(all="ignore"):  # numbers beyond floats leave all open
            return self._order_of(name, limit)

    def _order_of(self, name: str, limit: int) -> tuple[int, RecoveryFailure | None, list[Tree]]:
        if not self._has_shape:
            self._has_shape = True
            self._recover_shape_and_orders()
        order, failure, missed, searched = self._orders.get(name, (0, None, [], 0))
        is_open = failure is not None and not failure.is_proved
        if is_open and self.place is not self._places.get(name):
            # the method is another one since, which may have the order
            searched = 0
        if not searched or (failure is None and searched < limit):
            order, failure, missed = self.recover_order(name, limit)
            self._orders[name] = order, failure, missed, limit
            self._places[name] = self.place
        if order > limit:
            return limit, None, []
        return order, failure, missed

    # what gives a method its shape

    def _recover_shape_and_orders(self) -> None:
        if self._start_at_recovered():
            return
        self.recover_shape()
        if self._try({}) is not None:
            self.place, self.shape = self.origin, {}

    def _start_at_recovered(self) -> bool:
        stored = recovered_of(self.box, self.origin.exact("method").known)
        if stored is None:
            return False
        self.add_further()
        place = BoxPlace(self, stored.shifts)
        sizes = [abs(x) for x in place.values(stored.shape)]
        if not place.is_inside or not all(x < self.small for x in sizes):
            return False
        self.place, self.shape, self.system = place, stored.shape, stored.system
        return True

    def recover_shape(self) -> None:
        chosen = candidates(self.origin)
        for _ in range(12):
            if not chosen:
                return
            if not np.isfinite(self.origin.rows({"method": chosen}).slopes).all():
                return
            place = self._newton({"method": chosen}, self.origin)
            # one that meets fewer conditions to all digits is better than to second order
            if place is not None and not (place.slack and self.shape):
                self.place, self.shape = place, {"method": chosen}
            if place is not None and not place.slack:
                return
            chosen = less(self.origin, chosen)

    def _recover_weak(self) -> None:
        found: Chosen = {}
        for k in range(1, MOST_WEAK + 1):
            fresh = {x: [0] for x in weak_rows(self.place, k)}
            with arithmetic(self.bits):
                rows = self.origin.rows({"method": fresh}) if fresh else None
            if rows is None or not all(
                may_vanish(rows, i) and rows.reach[i] < NATURAL for i in range(len(rows))
            ):
                return
            found |= fresh
            if all(self.place.is_met(self.place.rows({"method": {x: [0]}}), 0) for x in fresh):
                continue
            before = self.place, self.shape, self.system
            shape = _both(self.shape, {"method": found})
            if self.move(_both(shape, self.system)) is None:
                self.shape = shape
            if self.shape is not shape or self._reach(self._reached) is not None:
                self.place, self.shape, self.system = before
                return

    # orders

    def recover_order(
        self, name: str, limit: int
    ) -> tuple[int, RecoveryFailure | None, list[Tree]]:
        """Moves to a method of the largest order that earlier results leave possible. Returns the
        order, why the next one fails, and the trees that it misses.
        """
        # the nodes and weights of s stages are a quadrature formula of order 2s at most; further
        # conditions, explained by large radii alone, fail one order at a time, which is fast
        most = 2 * max((space.stages for space in self.origin.exact(name).spaces), default=limit)
        reachable, unmet = self.explained(name, min(limit, most))
        if reachable > 1 and self._try({name: reachable}) is None and reachable == limit:
            return limit, None, []
        for order in range(self._reached.get(name, 0) + 1, limit + 1):
            if unmet is not None and order > reachable:
                failure: RecoveryFailure | None = RecoveryFailure(True, ((name, of_tree(unmet)),))
            else:
                failure = self._try({name: order})
            if failure is not None:
                return order - 1, failure, self.place.missed(name, order)
        return limit, None, []

    def explained(self, name: str, limit: int) -> tuple[int, Tree | None]:
        """Returns the order to which radii explain each residual, and a tree of the next that no
        method of the box meets.
        """
        for order in range(1, limit + 1):
            for tree in self.place.missed(name, order):
                if not self.origin.may_meet(name, tree):
                    return order - 1, tree
        return limit, None

    def _try(self, orders: Mapping[str, int]) -> RecoveryFailure | None:
        before = self.place, self.shape, self.system
        failure = self._reach({**self._reached, **orders})
        if failure is None:
            self._reached.update(orders)
        else:
            self.place, self.shape, self.system = before
        return failure

    def _reach(self, orders: Mapping[str, int]) -> RecoveryFailure | None:
        for _ in range(8):
            missed = self._missed(orders)
            if not missed:
                return None
            failure = self._meet(missed)
            if failure is not None:
                return failure
        return RecoveryFailure(is_proved=False)

    def _missed(self, orders: Mapping[str, int]) -> dict[str, list[Tree]]:
        found = {
            name: [u for q in range(1, order + 1) for u in self.place.missed(name, q)]
            for name, order in orders.items()
        }
        return {name: trees for name, trees in found.items() if trees}

    def _meet(self, missed: Mapping[str, Sequence[Tree]]) -> RecoveryFailure | None:
        fresh: System = {
            name: {of_tree(u, self.share(name, u.order)): [0] for u in trees}
            for name, trees in missed.items()
        }
        wanted = _both(self.system, self.independent(fresh, self.place))
        if wanted == self.system:
            wanted = _both(self.system, fresh)
        if wanted == self.system:
            return RecoveryFailure(is_proved=False)
        failure = self.move(_both(self.shape, wanted))
        if failure is not None and self.shape:
            # an order that needs another shape is taken, and one that the shape excludes may hold
            failure = self.move(wanted)
            if failure is None:
                self.shape = {}
        if failure is None:
            self.system = wanted
        return failure

    def independent(self, fresh: System, place: BoxPlace) -> System:
        """Rows independent of those recovered and of each other, to first order."""
        known = _both(self.shape, self.system)
        if not any(fresh.values()):
            return {}
        rows = place.rows(fresh).slopes
        if not np.isfinite(rows).all():
            return fresh
        basis = np.zeros((0, rows.shape[1]))
        if any(known.values()) and place is not self.origin:
            basis = bounded.orthonormal(place.rows(known).slopes)
        rest = rows / np.maximum(np.linalg.norm(rows, axis=1), 1e-300)[:, None]
        rest = rest - (rest @ basis.T) @ basis
        labels = [(name, label) for name, chosen in fresh.items() for label in chosen]
        kept: dict[str, Chosen] = {}
        while True:
            sizes = np.linalg.norm(rest, axis=1)
            i = int(np.argmax(sizes))
            if sizes[i] < bounded.INDEPENDENT:
                return kept
            q = rest[i] / sizes[i]
            rest = rest - np.outer(rest @ q, q)
            name, label = labels[i]
            kept.setdefault(name, {})[label] = [0]

    def move(self, system: System) -> RecoveryFailure | None:
        """Moves to a method that meets all rows of a system; returns why there is none."""
        rows = self.origin.rows(system)
        labels = [
            (name, label)
            for name, chosen in system.items()
            for label, which in chosen.items()
            for _ in which
        ]
        is_finite = [bool(np.isfinite(row).all()) for row in rows.slopes]
        for i, label in enumerate(labels):
            if is_finite[i] and not may_vanish(rows, i):
                return RecoveryFailure(True, (label,))
        if not all(is_finite):
            return RecoveryFailure(is_proved=False)  # numbers beyond floats
        place = self._newton(system, self.place)
        if place is None and np.isfinite(rows.remainders).all():
            c, G, scale = bounded.scaled(rows)
            start = bounded.bounded_least_squares(G, c)
            miss = c + G @ start
            if np.abs(miss).max(initial=0) > 1e-12 and bounded.excludes(rows, miss / scale):
                heavy = np.argsort(-np.abs(miss))
                return RecoveryFailure(True, tuple(labels[i] for i in heavy))
            place = self._newton(system, BoxPlace(self, [bounded.dyadic(x, 60) for x in start]))
        if place is None:
            return RecoveryFailure(is_proved=False)
        self.place = place
        return None

    def _newton(self, system: System, place: BoxPlace) -> BoxPlace | None:
        """Returns a method of the box where all rows vanish, or None; equal digits first move
        together.
        """
        self._runs += 1
        if self._runs > MOST_RUNS:
            return None
        best = None
        for groups in self._groups:
            found = self._iterate(system, place, groups)
            if found is not None and not found.slack:
                if found.is_inside:
                    return found
                # the rows are those of a method beyond the box: what meets them to second order
                # is near it, and no method
                best = None
            elif best is None:
                best = found
        return best

    @cached_property
    def _groups(self) -> list[list[int]]:
        first: dict[object, int] = {}
        printed = zip(self.box.numbers, self.box.radii, strict=True)
        tied = [
            first.setdefault((x, t) if isinstance(x, fmpq) else k, len(first))
            for k, (x, t) in enumerate(printed)
        ]
        singles = list(range(len(tied)))
        return [singles] if tied == singles else [tied, singles]

    def _iterate(self, system: System, place: BoxPlace, groups: Sequence[int]) -> BoxPlace | None:
        """Returns a method at which all rows vanish, or a method of the box where they do to second
        order; None if neither is found. The first steps go to the method nearest to the print, to
        first order.
        """
        floor, cut = bounded.FLOOR, max(bounded.FLOOR, 30 * self.radius)
        best: arb | None = None
        champion: tuple[arb, BoxPlace] | None = None
        solver: bounded.Solver | None = None
        with arithmetic(self.bits):
            for step in range(MAX_STEPS):
                check_time()
                if solver is None:
                    solver = bounded.Solver(place.rows(system), self.radius, groups)
                    centres = solver.rows.centres
                else:
                    centres = place.values(system)
                parts = [x / scale for x, scale in zip(centres, solver.balls, strict=True)]
                worst = max((abs(x).abs_upper() for x in parts), default=arb(0))
                is_bounded = all(x.is_finite() for x in parts)
                if not is_bounded or not np.isfinite(solver.slopes).all():
                    break  # it divides by what may be zero
                if worst < self.goal:
                    return place
                if place.is_inside and (champion is None or worst < champion[0]):
                    champion = worst, place
                relative = float(worst)
                if step:
                    cut = max(floor, min(cut, 30 * self.radius * relative))
                if step < 4 and not worst < 1e-9:
                    near = solver.nearest(parts, place.shifts, cut)
                    if near is not None:
                        place = BoxPlace(self, [bounded.dyadic(x, 50) for x in near])
                        if self.radius > COARSE:
                            solver = None
                        continue
                if best is not None and step > 3 and not worst < 0.3 * best:
                    if floor <= LOWEST_FLOOR and step > 9:
                        break
                    floor = LOWEST_FLOOR
                    solver = bounded.Solver(place.rows(system), self.radius, groups, solver.fixed)
                best = worst if best is None else best.min(worst)
                change = solver.step(parts, worst, cut)
                if not np.isfinite(change).all():
                    break
                unit = midpoint(worst)
                moved = [
                    x + unit * bounded.dyadic(y, 50)
                    for x, y in zip(place.shifts, change, strict=True)
                ]
                place = BoxPlace(self, [_rounded(x, self.bits) for x in moved])
                if place.distance > MAX_SHIFT:
                    break
                if relative > COARSE and self.radius > COARSE:
                    solver = bounded.Solver(place.rows(system), self.radius, groups, solver.fixed)
        if champion is None or not champion[0] < min(1e-2, 100 * self.radius):
            return None
        worst, place = champion
        # the place may be that of a search before, which knows what it misses without slack
        found = BoxPlace(self, place.shifts)
        found.slack = 4 * float(worst)
        return found


def _both(one: System, other: System) -> System:
    return {name: {**one.get(name, {}), **other.get(name, {})} for name in {**one, **other}}


def _rounded(x: fmpq, bits: int) -> fmpq:
    return fmpq((x * fmpq(1 << bits)).floor(), 1 << bits)
