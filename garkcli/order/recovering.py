"""One method within the rounding of a printed one, with as much as possible of what its digits say.

Conditions that hold within the radii of the printed numbers, one by one, need not hold together.
So one method is sought that meets them, by Newton's method on affine rows, to hundreds of digits:
first what gives a method its shape (B, C stage by stage, D, symplecticity, equal rows), then its
order conditions. Where there is none, a combination of the rows that is zero nowhere in the box
proves it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import copy
from functools import cached_property, partial
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from flint import arb, ctx, fmpq

from garkcli.deadline import check_time
from garkcli.exact.affine import UNIT, Affine, Forms
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.ntrees.count import counts_upto
from garkcli.ntrees.kind import ONE_BRANCH
from garkcli.ntrees.tree import Tree
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.conditions import coupling_graph, is_admissible, twin_roots
from garkcli.order.rows import Chosen, FormDefects, Label, joined, may_vanish, of_tree
from garkcli.order.tree_residuals import TreeResiduals
from garkcli.tableau.box import Box, FormTableau
from garkcli.tableau.conjugate import are_opposite
from garkcli.tableau.embedded import NOTHING, Further, Weights, from_colours, with_weights
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.tableau import Edge, Tableau

if TYPE_CHECKING:
    from garkcli.exact.affine import Floats

NATURAL = 1e-3
"""A condition that rounding can miss by more says nothing: many hold by chance."""
NOISE = 1e-3
"""Slopes of so many radii are what floats leave of zeros."""
MOST_TREES = 50_000
"""Up to so many trees of an order all are evaluated."""
MOST_ROWS = 60
"""Rows that one order adds at a time."""
INDEPENDENT = 1e-6
"""Rows that others give but for such a part add nothing to these."""
COARSE = 1e-6
"""Slopes are renewed while radii, and what rows are missed by, are larger."""
MOST_WEAK = 6
"""The search for a weak stage order ends there."""
MOST_RUNS = 40
"""Runs of Newton's method until the search for more is given up."""
COARSENING = 16.0
"""By so many times the radii a condition moves, where it is met to second order only."""
MAX_STEPS = 25
MAX_SHIFT = 50.0
END = 1 - 1e-8
"""How far numbers are moved by first order: the rest is for what is of second order."""
WEIGHTS = {"B": 100.0, "stiff": 10.0}
"""What a compromise keeps first: orders need B, and a last row that is b is seldom chance."""
RIDGE = 1e-3
"""What a shift by its radius costs, in the compromise between rows that exclude each other."""
MISS = 1e-9
"""Rows that are missed by no more count as met to first order: small slopes were dropped."""
FLOOR = 1e-10
LOWEST_FLOOR = 1e-16

SYMMETRIC = ("symmetric", "palindrome")
WHOLE = {"symplectic": ("symplectic",), **dict.fromkeys(SYMMETRIC, SYMMETRIC)}
"""Conditions that say something only all together: with one of a kind go those of these kinds."""

Derive: TypeAlias = Callable[[Tableau], Tableau]
"""A tableau from that of the box: its own colours, the conjugate, the pair, …"""
System: TypeAlias = "Mapping[str, Chosen]"
"""Rows by the name of the tableau that they are of."""


@contextmanager
def _arithmetic(bits: int) -> Iterator[None]:
    """Balls of so many bits; what is beyond floats leaves all open."""
    with ctx.workprec(bits), np.errstate(all="ignore"):
        yield


class Place:
    """A method of the box, and all that is made around it.

    Args:
        search: for the box and the tableaus made from it.
        shifts: by how much its numbers are off, in units of their radii.

    Attributes:
        slack: up to which part of what the radii can do a row counts as met: 0 where Newton's
            method converged; else rows are met to second order only, as where varieties cross.
    """

    def __init__(self, search: Recovery, shifts: Sequence[fmpq]) -> None:
        self.search = search
        self.shifts = tuple(shifts)
        self.slack = 0.0
        self._defects: dict[str, FormDefects] = {}
        self._values: dict[str, FormDefects] = {}
        self._exact: dict[str, Tableau] = {}
        self._residuals: dict[str, TreeResiduals] = {}
        self._spans: dict[str, ApproximateSpans] = {}
        self._missed: dict[tuple[str, int], list[Tree]] = {}

    @property
    def distance(self) -> float:
        """By how much a number is off at most, in units of its radius."""
        return max((abs(to_float(x)) for x in self.shifts), default=0.0)

    @property
    def is_inside(self) -> bool:
        """Whether all its numbers are within their radii."""
        return all(abs(x) <= 1 for x in self.shifts)

    @cached_property
    def _made(self) -> FormTableau:
        return self.search.box.around(self.shifts)

    @cached_property
    def _method(self) -> Tableau:
        with _arithmetic(self.search.bits):
            return self.search.box.at(self.shifts)

    @property
    def grain(self) -> fmpq:
        """What counts as zero of numbers that are made of its own."""
        if not self.slack:
            return self.search.grain
        return max(self.search.grain, exactly(COARSENING * self.slack * self.search.radius))

    @property
    def further(self) -> Further:
        """Its embedded weights and its dense output."""
        return from_colours(self._method, self.search.printed_further)[1]

    def exact(self, name: str) -> Tableau:
        """A tableau of this method."""
        if name not in self._exact:
            with _arithmetic(self.search.bits):
                self._exact[name] = self.search.targets[name](self._method)
        return self._exact[name]

    def defects(self, name: str) -> FormDefects:
        """The defects of a tableau made from forms around this method."""
        if name not in self._defects:
            with _arithmetic(self.search.bits):
                made = self.search.targets[name](self._made.made)
                self._defects[name] = FormDefects(FormTableau(made, self._made.numbers))
        return self._defects[name]

    def in_balls(self, name: str) -> Tableau:
        """A tableau with all its numbers within the radii around this method as balls."""
        with _arithmetic(self.search.bits):
            return self.defects(name).tableau.in_balls

    def rows(self, system: System) -> Forms:
        """The rows of a system."""
        with _arithmetic(self.search.bits):
            return joined([self.defects(name).rows(x) for name, x in system.items() if x])

    def values(self, system: System) -> list[arb]:
        """The centres of the rows of a system, which take less time than the rows."""
        with _arithmetic(self.search.bits):
            found: list[arb] = []
            for name, chosen in system.items():
                if name not in self._values:
                    self._values[name] = FormDefects(FormTableau(self.exact(name), 0))
                found += self._values[name].rows(chosen).centres if chosen else []
            return found

    def missed(self, name: str, order: int) -> list[Tree]:
        """Trees of an order whose conditions this method does not meet, by most first; none where
        it meets all.
        """
        key = name, order
        if key not in self._missed:
            check_time()
            self._missed[key] = self._found_missed(name, order)
        return self._missed[key]

    def _found_missed(self, name: str, order: int) -> list[Tree]:
        tableau, bits = self.exact(name), self.search.bits
        admissible = coupling_graph(tableau)
        small, share = self.search.small, self.search.share(name, order)
        if not share or sum(counts_upto(admissible, order)[-1]) <= MOST_TREES:
            if name not in self._residuals:
                self._residuals[name] = TreeResiduals(tableau, enclose_tableau(tableau, bits))
            residuals = self._residuals[name]
            table = residuals.table(order)
            sizes = [(abs(x), u) for x, _, u in residuals.of_order(order, share)]
            missed = [(x, u) for x, u in sizes if not x < small]
            missed.sort(key=lambda x: float(x[0].mid()), reverse=True)
            trees = [table.tree(u) for _, u in missed]
            return self._beyond_slack(name, trees, share)[:MOST_ROWS]
        bush = self._bush_missed(name, order)
        if bush is not None:
            return [bush]
        if name not in self._spans:
            enclosure = enclose_tableau(tableau, bits)
            self._spans[name] = ApproximateSpans(tableau, enclosure, small)
        hulls = self._spans[name].sizes(order)
        if hulls.bound < small:
            return []
        members = [tree for x, tree in hulls.members if not x < small]
        return self._beyond_slack(name, members, share)[:MOST_ROWS]

    def _bush_missed(self, name: str, order: int) -> Tree | None:
        """A quadrature condition that no method of the box meets: one vertex with leaves of one
        colour. Methods of high order seldom integrate better.
        """
        tableau = self.exact(name)
        for l in twin_roots(tableau):
            for m in range(tableau.size):
                leaf = tableau.tree(m)
                leaves, rest = divmod(order - tableau.colours[l].kind.weight, leaf.order)
                bush = tableau.tree(l, (leaf,) * leaves)
                if rest or not is_admissible(tableau, bush):
                    continue
                if not self.search.origin.may_meet(name, bush):
                    return bush
        return None

    def _beyond_slack(self, name: str, trees: list[Tree], share: int) -> list[Tree]:
        if not self.slack:
            return trees
        with _arithmetic(self.search.bits):
            defects = self.defects(name)
            return [u for u in trees if not self.is_met(defects.of(of_tree(u, share)), 0)]

    def meets(self, name: str, tree: Tree) -> bool:
        """Whether this method meets the condition of a tree."""
        with _arithmetic(self.search.bits):
            return self.is_met(self._tree_row(name, tree), 0)

    def reach(self, name: str, tree: Tree) -> fmpq:
        """How far the numbers of the box move the elementary weight of a tree at most."""
        with _arithmetic(self.search.bits):
            row = self._tree_row(name, tree)
        return _exact(arb(float(row.reach[0] + row.remainders[0]))) / tree.density

    def may_meet(self, name: str, tree: Tree) -> bool:
        """Whether the radii explain that a tree is missed."""
        with _arithmetic(self.search.bits):
            return may_vanish(self._tree_row(name, tree), 0)

    def may_be_sum(self, name: str, parts: Sequence[str]) -> bool:
        """Whether the radii let the weights of a tableau be the sums of those of others."""
        with _arithmetic(self.search.bits):
            rows: list[Forms] = self.defects(name).tableau.b
            for part_name in parts:
                others = self.defects(part_name).tableau.b
                rows = [x.minus(y, fmpq(1)) for x, y in zip(rows, others, strict=True)]
            return all(may_vanish(row, i) for row in rows for i in range(len(row)))

    def _tree_row(self, name: str, tree: Tree) -> Forms:
        return self.defects(name).of(of_tree(tree))

    def is_met(self, forms: Forms, i: int) -> bool:
        """Whether a form is zero here, as far as the method is known."""
        size = abs(forms.centres[i])
        least = 1e-12 * self.search.radius
        return bool(
            size < self.search.small or size < self.slack * max(float(forms.reach[i]), least)
        )


class Failure(Frozen, eq=False):
    """Why no method of the box meets some rows.

    Attributes:
        is_proved: whether there is none; else none was found.
        labels: the rows that exclude each other, those that weigh most first.
    """

    is_proved: bool
    labels: tuple[tuple[str, Label], ...] = ()

    @property
    def trees(self) -> list[Tree]:
        """The trees among them."""
        return [label.tree for _, label in self.labels if label.tree is not None]


class Recovery:
    """The search for one method of a box.

    Args:
        box: of the method, with colours for further weights.
        further: these as they are printed.
    """

    def __init__(self, box: Box, further: Further = NOTHING) -> None:
        self.box = box
        self.printed_further = further
        self.targets: dict[str, Derive] = {"method": lambda whole: from_colours(whole, further)[0]}
        finest = max((-_binary_exponent(t) for t in box.radii), default=0)
        # what is of second order in the radii is no zero
        self.zero_bits = max(120, 2 * finest + 80)
        self.bits = self.zero_bits + 100
        coarsest = min((-_binary_exponent(t) for t in box.radii), default=0)
        self.goal = arb(2) ** -(self.zero_bits - max(coarsest, 0) + 40)
        self.grain = fmpq(1, 1 << self.zero_bits)
        self.small = arb(self.grain)
        self.radius = max((to_float(t) for t in box.radii), default=0.0)
        self.origin = Place(self, (fmpq(0),) * len(box.numbers))
        self.place = self.origin
        self._dense: tuple[int, Failure | None] = 0, None
        self.shape: System = {}
        self.system: System = {}
        self._orders: dict[str, tuple[int, Failure | None, list[Tree], int]] = {}
        self._places: dict[str, Place] = {}
        self._reached: dict[str, int] = {}
        self._powers: dict[str, int] = {}
        self._runs = 0
        self._has_shape = self._is_settled = False

    @property
    def settled(self) -> Place:
        """The method that the box is taken to be, with the orders of its own weights at least."""
        if not self._is_settled:
            self._is_settled = True
            if not self._has_shape:
                self._has_shape = True
                self._recover_shape_and_orders()
            self.order_of("method", DEFAULT_LIMIT)
            self._recover_weak()
            if self.printed_further.embedded is not None:
                self.with_weights("embedded", _embedded)
                self.order_of("embedded", DEFAULT_LIMIT)
            if self.printed_further.dense is not None:
                self._dense = self.recover_dense(DEFAULT_LIMIT)
        return self.place

    @property
    def wanted(self) -> System:
        """All rows that the method meets by the search."""
        return _both(self.shape, self.system)

    def largest_in(self, name: str) -> fmpq:
        """The largest radius of the numbers that a tableau depends on; 0 for an exact one."""
        made = self.origin.defects(name).tableau.made
        rows = [row for colour in made.colours for row in (colour.b, colour.c)]
        rows += [row for block in made.blocks.values() for row in block]
        entries: Iterator[object] = (x for row in rows for x in row)
        forms = (x for x in entries if isinstance(x, Affine))
        found = {k for x in forms for k, slope in x.slopes.items() if slope}
        return max((self.box.radii[k] for k in found), default=fmpq(0))

    def finer(self, bits: int) -> Recovery:
        """The same search with at least so many bits."""
        other = copy(self)
        other.bits = max(self.bits, bits)
        return other

    def missed_at(self, place: Place) -> dict[str, list[Tree]]:
        """The trees of all orders that were reached whose conditions a method misses, by the name
        of the tableau.
        """
        other = copy(self)
        other.place = place
        return other._missed(self._reached)

    def share(self, name: str, order: int) -> int:
        """What γ(u)-fold elementary weights of an order should be: 1, or 0 where the weights are
        those of another power of θ in dense output.
        """
        return int(self._powers.get(name, order) == order)

    def recover_dense(self, limit: int) -> tuple[int, Failure | None]:
        """Move to a method whose dense output has the largest order; why it has no larger one."""
        dense = self.printed_further.dense
        assert dense is not None
        for power in range(1, dense.degree + 1):
            name = f"power {power}"
            self._powers[name] = power
            self.with_weights(name, partial(_power, power))
        for order in range(1, min(limit, dense.degree) + 1):
            failure = self._try(dict.fromkeys(self._powers, order))
            if failure is not None:
                return order - 1, failure
        return min(limit, dense.degree), None

    def excludes_dense(self, order: int) -> bool:
        """Whether it is proved that dense output has a smaller order."""
        self.settled  # noqa: B018 -- it looks for that
        reached, failure = self._dense
        if order > len(self.printed_further.powers):
            return True  # there is no coefficient of such a power
        return order == reached + 1 and failure is not None and failure.is_proved

    def with_weights(self, name: str, weights: Callable[[Further], Weights]) -> None:
        """Add the tableau with some of its further weights for b."""
        self.targets.setdefault(name, partial(self._with, weights))

    def _with(self, weights: Callable[[Further], Weights], whole: Tableau) -> Tableau:
        own, further = from_colours(whole, self.printed_further)
        return with_weights(own, weights(further))

    def note(self, name: str, order: int, missed: Tree) -> None:
        """Keep the order of a tableau whose digits meet all conditions up to there as they are
        printed, and a tree of the next order that no method of the box meets.
        """
        failure = Failure(True, ((name, of_tree(missed)),))
        self._orders.setdefault(name, (order, failure, [missed], order + 1))
        self._reached.setdefault(name, order)

    def order_of(self, name: str, limit: int) -> tuple[int, Failure | None, list[Tree]]:
        """The order of a tableau, as ``recover_order`` has it; each is found once."""
        with np.errstate(all="ignore"):  # numbers beyond floats leave all open
            return self._order_of(name, limit)

    def _order_of(self, name: str, limit: int) -> tuple[int, Failure | None, list[Tree]]:
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
        """The shape, with the orders that are known already."""
        self.recover_shape()
        if self._try({}) is not None:
            self.place, self.shape = self.origin, {}

    def recover_shape(self) -> None:
        """Move to a method with the simplifying conditions that the digits speak for."""
        chosen = self._candidates()
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
            chosen = self._less(chosen)

    def _candidates(self) -> Chosen:
        """Conditions that hold within the radii one by one, and not by chance."""
        defects = self.origin.defects("method")
        made = defects.tableau.made
        edges = list(made.edges())
        if not made.has_fields_alone:  # on linear problems they are Runge–Kutta methods
            edges = [(l, l) for l, colour in enumerate(made.colours) if colour.kind == ONE_BRANCH]
        chosen: Chosen = {}

        def take(label: Label, alive: set[int]) -> set[int]:
            """Which of the places alive still hold; those that say something are taken."""
            forms = defects.of(label)
            holds = [i for i in sorted(alive) if may_vanish(forms, i)]
            is_natural = label.kind in WHOLE or (label.kind in "BC" and label.k == 1)
            says = [
                i
                for i in holds
                if is_natural or forms.reach[i] < NATURAL or not float(abs(forms.centres[i]))
            ]
            telling = [
                i
                for i in says
                if NOISE * self.radius < forms.reach[i] and np.isfinite(forms.remainders[i])
            ]
            if telling:
                chosen[label] = telling
            return set(says)

        with _arithmetic(self.bits):
            series: list[tuple[Label, int]] = []
            if made.has_fields_alone:
                series += [(Label("B", l), 1) for l in range(made.size)]
                series += [(Label("C", l, m), len(defects.tableau.b[l])) for l, m in edges]
                series += [(Label("D", l, m), len(defects.tableau.b[m])) for l, m in edges]
            for first, count in series:
                alive, k = set(range(count)), 0
                # of so many numbers quadrature of no more has all conditions
                sees = len(defects.tableau.b[first.m if first.kind == "C" else first.l])
                most = max(sees, count) if first.kind == "D" else 2 * sees
                while alive and k < most:
                    k += 1
                    alive = take(Label(first.kind, first.l, first.m, k), alive)
            labels = [
                label
                for label in self._equalities(edges)
                if all(may_vanish(defects.of(label), i) for i in self._of_diagonal(label, defects))
            ]
            labels += [Label("damping", l, k=defects.degree(l)) for l, m in edges if l == m]
            if made.has_fields_alone:
                labels += [Label("node", l, k=k) for l in range(made.size) for k in (0, 1)]
            else:
                labels += [of_tree(u) for l, _ in edges for u in _tall(made, l)]
            for label in labels:
                take(label, set(range(len(defects.of(label)))))
            if not made.has_fields_alone:
                return chosen
            for whole in (self._symplectic(defects), self._symmetric(defects)):
                if all(
                    may_vanish(forms, i)
                    for forms in map(defects.of, whole)
                    for i in range(len(forms))
                ):
                    for label in whole:
                        take(label, set(range(len(defects.of(label)))))
        return chosen

    def _equalities(self, edges: Sequence[Edge]) -> Iterator[Label]:
        """Rows of numbers that may be equal: a stage that is the step, one diagonal."""
        printed = self.origin.exact("method")
        for l, m in edges:
            for i in range(len(printed.block(l, m) or ())):
                yield Label("stiff", l, m, i)
        for l in [l for l, m in edges if l == m]:
            block = printed.block(l, l)
            diagonal = [row[i] for i, row in enumerate(block or ())]
            first = next((i for i, x in enumerate(diagonal) if x), None)
            if first is not None and all(diagonal[first:]):
                yield Label("diagonal", l, l, first)

    def _of_diagonal(self, label: Label, defects: FormDefects) -> range:
        """Which places of an equality have to hold: of a diagonal those of implicit stages."""
        return range(label.k if label.kind == "diagonal" else 0, len(defects.of(label)))

    def _symplectic(self, defects: FormDefects) -> list[Label]:
        """Symplecticity, row by row; none where a block has no opposite."""
        made = defects.tableau.made
        labels = []
        for l, m in made.edges():
            if not are_opposite(made.colours[l], made.colours[m]):
                continue
            if made.block(m, l) is None:
                return []
            if l <= m:
                labels += [Label("symplectic", l, m, i) for i in range(len(defects.tableau.b[l]))]
        return labels

    def _symmetric(self, defects: FormDefects) -> list[Label]:
        """That the method with its stages in reverse is its own adjoint, row by row."""
        b = defects.tableau.b
        labels = [Label("palindrome", l) for l in range(len(b))]
        for l, m in defects.tableau.made.edges():
            labels += [Label("symmetric", l, m, i) for i in range((len(b[l]) + 1) // 2)]
        return labels

    def _recover_weak(self) -> None:
        """Move to a method of the weak stage order that the digits speak for."""
        found: Chosen = {}
        for k in range(1, MOST_WEAK + 1):
            fresh = {x: [0] for x in self._weak_rows(k)}
            with _arithmetic(self.bits):
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

    def _weak_rows(self, k: int) -> list[Label]:
        """The conditions of weak stage order k for as many words b A ⋯ A of each last colour as
        there are stages: more are combinations of these, for one colour by the theorem of Cayley
        and Hamilton.
        """
        made = self.place.defects("method").tableau.made
        edges = list(made.edges())
        stages = sum(space.stages for space in made.spaces)
        counts = dict.fromkeys(range(made.size), 0)
        waiting: list[tuple[int, ...]] = [(l,) for l in range(made.size)]
        labels: list[Label] = []
        for path in waiting:  # it grows
            l = path[-1]
            if counts[l] == stages:
                continue
            counts[l] += 1
            labels += [Label("weak", l, m, k, path=path) for p, m in edges if p == l]
            waiting += [(*path, m) for p, m in edges if p == l]
        return labels

    def _less(self, chosen: Chosen) -> Chosen:
        """The rows without those that the others exclude, as far as first order tells: the one
        that a compromise of all misses by most, and what builds on it.
        """
        rows = self.origin.rows({"method": chosen})
        c, G, _ = scaled(rows)
        places = [(label, i) for label, which in chosen.items() for i in which]
        weights = np.array([WEIGHTS.get(label.kind, 1.0) for label, _ in places])
        miss = _compromise(weights[:, None] * G, weights * c) / weights
        most = np.abs(miss).max()
        worst, place = places[int(np.argmax(np.abs(miss)))]
        label = min(
            (
                x
                for (x, i), off in zip(places, np.abs(miss), strict=True)
                if (x.kind, x.l, x.m, i) == (worst.kind, worst.l, worst.m, place)
                and off >= most / 10
            ),
            key=lambda x: x.k,
        )
        less: Chosen = {}
        for other, which in chosen.items():
            is_same = (other.kind, other.l, other.m) == (label.kind, label.l, label.m)
            kept = which
            if other.kind in WHOLE and label.kind in WHOLE[other.kind]:
                kept = []
            elif is_same and other.k >= label.k:
                kept = [i for i in which if i != place]
            if kept:
                less[other] = kept
        return less

    # orders

    def recover_order(self, name: str, limit: int) -> tuple[int, Failure | None, list[Tree]]:
        """Move to a method of the largest order that some method of the box has with all that is
        recovered before.

        Returns:
            the order, why the next one fails, and the trees that it misses; no reason where the
            limit is reached.
        """
        at_once = self._explained(name, limit)
        if at_once > 1 and self._try({name: at_once}) is None and at_once == limit:
            return limit, None, []
        for order in range(self._reached.get(name, 0) + 1, limit + 1):
            failure = self._try({name: order})
            if failure is not None:
                return order - 1, failure, self.place.missed(name, order)
        return limit, None, []

    def _explained(self, name: str, limit: int) -> int:
        """The largest order up to which the radii explain each condition that is missed."""
        for order in range(1, limit + 1):
            missed = self.place.missed(name, order)
            if not all(self.origin.may_meet(name, u) for u in missed):
                return order - 1
        return limit

    def _try(self, orders: Mapping[str, int]) -> Failure | None:
        """Move to a method of some orders more; where there is none, why, and nothing moves."""
        before = self.place, self.shape, self.system
        failure = self._reach({**self._reached, **orders})
        if failure is None:
            self._reached.update(orders)
        else:
            self.place, self.shape, self.system = before
        return failure

    def _reach(self, orders: Mapping[str, int]) -> Failure | None:
        """Move to a method of some orders, by the name of the tableau; why there is none."""
        for _ in range(8):
            missed = self._missed(orders)
            if not missed:
                return None
            failure = self._meet(missed)
            if failure is not None:
                return failure
        return Failure(is_proved=False)

    def _missed(self, orders: Mapping[str, int]) -> dict[str, list[Tree]]:
        """The trees up to some orders that the method misses now, by the name of the tableau."""
        found = {
            name: [u for q in range(1, order + 1) for u in self.place.missed(name, q)]
            for name, order in orders.items()
        }
        return {name: trees for name, trees in found.items() if trees}

    def _meet(self, missed: Mapping[str, Sequence[Tree]]) -> Failure | None:
        """Move to a method that meets the conditions of more trees; why there is none."""
        fresh: System = {
            name: {of_tree(u, self.share(name, u.order)): [0] for u in trees}
            for name, trees in missed.items()
        }
        wanted = _both(self.system, self.independent(fresh, self.place))
        if wanted == self.system:
            wanted = _both(self.system, fresh)
        if wanted == self.system:
            return Failure(is_proved=False)
        failure = self.move(_both(self.shape, wanted))
        if failure is not None and self.shape:
            # an order that needs another shape is taken, and one that the shape excludes may hold
            failure = self.move(wanted)
            if failure is None:
                self.shape = {}
        if failure is None:
            self.system = wanted
        return failure

    def independent(self, fresh: System, place: Place) -> System:
        """Rows that no combination of those recovered before gives, nor of each other, to first
        order around a method.
        """
        known = _both(self.shape, self.system)
        if not any(fresh.values()):
            return {}
        rows = place.rows(fresh).slopes
        if not np.isfinite(rows).all():
            return fresh
        basis = np.zeros((0, rows.shape[1]))
        if any(known.values()) and place is not self.origin:
            basis = orthonormal(place.rows(known).slopes)
        rest = rows / np.maximum(np.linalg.norm(rows, axis=1), 1e-300)[:, None]
        rest = rest - (rest @ basis.T) @ basis
        labels = [(name, label) for name, chosen in fresh.items() for label in chosen]
        kept: dict[str, Chosen] = {}
        while True:
            sizes = np.linalg.norm(rest, axis=1)
            i = int(np.argmax(sizes))
            if sizes[i] < INDEPENDENT:
                return kept
            q = rest[i] / sizes[i]
            rest = rest - np.outer(rest @ q, q)
            name, label = labels[i]
            kept.setdefault(name, {})[label] = [0]

    def move(self, system: System) -> Failure | None:
        """Move to a method that meets all rows of a system; why there is none."""
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
                return Failure(True, (label,))
        if not all(is_finite):
            return Failure(is_proved=False)  # numbers beyond floats
        place = self._newton(system, self.place)
        if place is None and np.isfinite(rows.remainders).all():
            c, G, scale = scaled(rows)
            start = bounded_least_squares(G, c)
            miss = c + G @ start
            if np.abs(miss).max(initial=0) > 1e-12 and excludes(rows, miss / scale):
                heavy = np.argsort(-np.abs(miss))
                return Failure(True, tuple(labels[i] for i in heavy))
            place = self._newton(system, Place(self, [_dyadic(x, 60) for x in start]))
        if place is None:
            return Failure(is_proved=False)
        self.place = place
        return None

    def _newton(self, system: System, place: Place) -> Place | None:
        """A method of the box where all rows vanish; None where none is found. Equal digits move
        together first, as they do in most methods, which leaves fewer numbers.
        """
        self._runs += 1
        if self._runs > MOST_RUNS:
            return None
        best = None
        for groups in self._groups:
            found = self._iterate(system, place, groups)
            if found is not None and not found.slack:
                return found
            best = best or found
        return best

    @cached_property
    def _groups(self) -> list[list[int]]:
        """Of each number its group: those of equal digits, and then each number alone."""
        first: dict[object, int] = {}
        printed = zip(self.box.numbers, self.box.radii, strict=True)
        tied = [
            first.setdefault((x, t) if isinstance(x, fmpq) else k, len(first))
            for k, (x, t) in enumerate(printed)
        ]
        alone = list(range(len(tied)))
        return [alone] if tied == alone else [tied, alone]

    def _iterate(self, system: System, place: Place, groups: Sequence[int]) -> Place | None:
        """A method of the box where all rows vanish, by Newton's method; None where it finds none.

        The first steps go to the method nearest to the print, as far as first order tells.
        """
        floor, cut = FLOOR, max(FLOOR, 30 * self.radius)
        best: arb | None = None
        champion: tuple[arb, Place] | None = None
        solver: _Solver | None = None
        with _arithmetic(self.bits):
            for step in range(MAX_STEPS):
                check_time()
                if solver is None:
                    solver = _Solver(place.rows(system), self.radius, groups)
                    centres = solver.rows.centres
                else:
                    centres = place.values(system)
                parts = [x / scale for x, scale in zip(centres, solver.balls, strict=True)]
                worst = max((abs(x).abs_upper() for x in parts), default=arb(0))
                is_bounded = all(x.is_finite() for x in parts)
                if not is_bounded or not np.isfinite(solver.slopes).all():
                    break  # it divides by what may be zero
                if worst < self.goal:
                    return place if place.is_inside else None
                if place.is_inside and (champion is None or worst < champion[0]):
                    champion = worst, place
                relative = float(worst)
                if step:
                    cut = max(floor, min(cut, 30 * self.radius * relative))
                if step < 4 and not worst < 1e-9:
                    near = solver.nearest(parts, place.shifts, cut)
                    if near is not None:
                        place = Place(self, [_dyadic(x, 50) for x in near])
                        if self.radius > COARSE:
                            solver = None
                        continue
                if best is not None and step > 3 and not worst < 0.3 * best:
                    if floor <= LOWEST_FLOOR and step > 9:
                        break
                    floor = LOWEST_FLOOR
                    solver = _Solver(place.rows(system), self.radius, groups, solver.fixed)
                best = worst if best is None else best.min(worst)
                change = solver.step(parts, worst, cut)
                if not np.isfinite(change).all():
                    break
                unit = _exact(worst)
                moved = [
                    x + unit * _dyadic(y, 50) for x, y in zip(place.shifts, change, strict=True)
                ]
                place = Place(self, [_rounded(x, self.bits) for x in moved])
                if place.distance > MAX_SHIFT:
                    break
                if relative > COARSE and self.radius > COARSE:
                    solver = _Solver(place.rows(system), self.radius, groups, solver.fixed)
        if champion is None or not champion[0] < min(1e-2, 100 * self.radius):
            return None
        worst, place = champion
        # the place may be that of a search before, which knows what it misses without slack
        found = Place(self, place.shifts)
        found.slack = 4 * float(worst)
        return found


class _Solver:
    """Steps of Newton's method with the slopes at one method.

    Args:
        rows: there.
        radius: of the printed numbers, the largest.
        groups: of each number the group whose numbers move together.
        fixed: which groups stay where they are.
    """

    def __init__(
        self, rows: Forms, radius: float, groups: Sequence[int], fixed: Floats | None = None
    ) -> None:
        self.rows = rows
        self.groups = np.array(groups, int)
        scale = np.maximum(rows.reach, 1e-12 * radius)
        self.balls = [arb(float(x)) for x in scale]
        self.alone = rows.slopes / scale[:, None]
        self.slopes = together(self.alone, self.groups)
        self.fixed = np.zeros(self.slopes.shape[1], bool) if fixed is None else fixed
        self._inverse: Floats | None = None
        self._cut = 0.0

    def nearest(self, parts: Sequence[arb], shifts: Sequence[fmpq], cut: float) -> Floats | None:
        """The shifts of the method nearest to the print, as far as first order tells; those that
        reach an end are fixed there.
        """
        here = np.array([to_float(x) for x in shifts])
        floats = np.array([float(x.mid()) for x in parts])
        near = nearest(self.slopes, floats - self.alone @ here, cut)
        if near is None:
            return None
        self.fixed = np.abs(near) >= END
        self._inverse = None
        each: Floats = near[self.groups]
        return each

    def step(self, parts: Sequence[arb], unit: arb, cut: float) -> Floats:
        """The least change that makes all rows zero to first order, in some unit."""
        if self._inverse is None or cut < 1e-3 * self._cut:
            self._inverse = _pseudo_inverse(np.where(self.fixed, 0.0, self.slopes), cut)
            self._cut = cut
        change = -(self._inverse @ np.array([float((x / unit).mid()) for x in parts]))
        change[self.fixed] = 0.0  # exactly
        each: Floats = change[self.groups]
        return each


def together(slopes: Floats, groups: Floats) -> Floats:
    """The slopes of groups of numbers that move together: sums of columns."""
    count = int(groups.max(initial=-1)) + 1
    if count == slopes.shape[1]:
        return slopes
    sums = np.zeros((slopes.shape[0], count))
    for k, group in enumerate(groups):
        sums[:, group] += slopes[:, k]
    return sums


def orthonormal(rows: Floats) -> Floats:
    """An orthonormal basis of the span of rows, without directions that are rounding."""
    norms = np.maximum(np.linalg.norm(rows, axis=1), 1e-300)
    _, s, v = np.linalg.svd(rows / norms[:, None], full_matrices=False)
    basis: Floats = v[: int((s > INDEPENDENT).sum())]
    return basis


def _embedded(further: Further) -> Weights:
    return further.embedded or ()


def _power(power: int, further: Further) -> Weights:
    return further.powers[power - 1]


def _tall(tableau: Tableau, l: int) -> Iterator[Tree]:
    """The trees of linear problems: a leaf, and below it vertices of colour l with one branch."""
    term = tableau.colours[l].term
    tree = tableau.tree(next(m for m, x in enumerate(tableau.colours) if x.term == term))
    for _ in range(tableau.spaces[tableau.colours[l].space].stages):
        tree = tableau.tree(l, [tree])
        yield tree


def _both(one: System, other: System) -> System:
    return {name: {**one.get(name, {}), **other.get(name, {})} for name in {**one, **other}}


def scaled(rows: Forms) -> tuple[Floats, Floats, Floats]:
    """Centres and slopes in units of what the slopes can do, and these units."""
    scale = np.maximum(rows.reach + rows.remainders, 1e-300)
    return rows.middle / scale, rows.slopes / scale[:, None], scale


def excludes(rows: Forms, y: Floats) -> bool:
    """Whether y · rows is zero nowhere in the box: a proof that no method meets them all."""
    count = len(rows)
    with ctx.workprec(200):
        centre = abs(sum((arb(float(a)) * x for a, x in zip(y, rows.centres, strict=True)), arb(0)))
    sizes = np.abs(y)
    slope = np.abs(y @ rows.slopes).sum() + sizes @ rows.remainders
    lost = (
        (count + rows.slopes.shape[1] + 8) * UNIT * (sizes @ rows.reach + sizes @ rows.remainders)
    )
    return bool(centre > (slope + lost) * (1 + UNIT))


def _compromise(G: Floats, c: Floats) -> Floats:
    """By how much rows c + G x are missed where the sum of |misses| is about least, and x_k beyond
    ±1 is punished: least squares with weights from the step before.
    """
    misses, shifts = np.ones(len(c)), np.zeros(G.shape[1])
    for _ in range(12):
        check_time()
        loose = 1 / np.maximum(1, np.abs(shifts)) ** 4
        allowed = RIDGE * np.maximum(np.abs(misses), 1e-6)
        gram = (G * loose) @ G.T
        gram[np.diag_indices_from(gram)] += allowed
        forces = np.linalg.solve(gram, c)
        misses, shifts = allowed * forces, -loose * (G.T @ forces)
    return misses


def bounded_least_squares(G: Floats, c: Floats) -> Floats:
    """The x with |x_k| ≤ 1 for which |c + G x| is least, by active sets (P. Stark, R. Parker,
    *Bounded-variable least-squares*, 1995).
    """
    count = G.shape[1]
    if len(G) > count:  # the same sums of squares, but for a constant
        q, G = np.linalg.qr(G)
        c = q.T @ c
    x: Floats = np.clip(np.linalg.lstsq(G, -c, rcond=1e-12)[0], -1, 1)
    bound = np.where(np.abs(x) == 1, x, 0).astype(int)  # −1, 1: at that end
    for _ in range(3 * count + 10):
        check_time()
        free = bound == 0
        if free.any():
            right = -(c + G[:, ~free] @ x[~free])
            wanted = np.linalg.lstsq(G[:, free], right, rcond=1e-12)[0]
            step = wanted - x[free]
            room = np.where(step > 0, 1 - x[free], -1 - x[free])
            with np.errstate(all="ignore"):
                share = np.where(step != 0, room / step, np.inf)
            least = float(share.min(initial=np.inf))
            if least < 1:
                x[free] += max(least, 0.0) * step
                places = np.flatnonzero(free)
                for k in places[share <= least]:
                    bound[k] = 1 if step[np.searchsorted(places, k)] > 0 else -1
                    x[k] = bound[k]
                continue
            x[free] = wanted
        slope = (G.T @ (c + G @ x)) * bound
        worst = int(np.argmax(slope))
        if slope[worst] <= 1e-13:
            break
        bound[worst] = 0
    return x


def nearest(J: Floats, c: Floats, cut: float) -> Floats | None:
    """The least x with |x_k| ≤ 1 for which c + J x = 0, up to rounding; None where it is not found.

    Entries beyond an end are held close to it, or at it where that is too little: numbers that lie
    halfway between two decimals are rounded by their radius. They are let go where the others pull
    them back.
    """
    for end, miss in ((END, 1e-4 * (1 - END)), (1.0, MISS), (END, MISS)):
        x = _nearest(J, c, cut, end, miss)
        if x is not None:
            return np.where(np.abs(x) < END, x, np.sign(x)) if end == 1 else x
    return None


def _nearest(J: Floats, c: Floats, cut: float, end: float, miss: float) -> Floats | None:
    """The same with |x_k| ≤ ``end``, where rows count as met that are missed by no more."""
    count = J.shape[1]
    held = np.zeros(count)
    for _ in range(count + 20):
        free = held == 0
        if not free.any():
            return None
        inverse = _pseudo_inverse(J[:, free], cut)
        x = held.copy()
        x[free] = -(inverse @ (c + J @ held))
        if np.abs(c + J @ x).max(initial=0) > miss:
            return None
        beyond = np.abs(x) > end
        if beyond.any():
            held[beyond] = end * np.sign(x[beyond])
            continue
        pull = J.T @ (inverse.T @ x[free]) * np.sign(held)
        loose = (held != 0) & (pull < end * (1 - 1e-9))
        if not loose.any():
            return x
        held[int(np.argmin(np.where(loose, pull, np.inf)))] = 0
    return None


def _pseudo_inverse(J: Floats, cut: float) -> Floats:
    """J⁺ without singular values that are a smaller part of the largest."""
    u, s, v = np.linalg.svd(J, full_matrices=False)
    rank = int((s > cut * s[0]).sum())
    inverse: Floats = (v[:rank].T / s[:rank]) @ u[:, :rank].T
    return inverse


def exactly(x: float) -> fmpq:
    """A float as a fraction."""
    return fmpq(*x.as_integer_ratio())


def _dyadic(x: float, bits: int) -> fmpq:
    return fmpq(int(x * 2.0**bits), 1 << bits)


def _exact(ball: arb) -> fmpq:
    mantissa, exponent = ball.mid().man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


def _rounded(x: fmpq, bits: int) -> fmpq:
    return fmpq((x * fmpq(1 << bits)).floor(), 1 << bits)


def _binary_exponent(x: fmpq) -> int:
    """The least e with x < 2^e, or one more."""
    return int(x.p.bit_length()) - int(x.q.bit_length()) + 1
