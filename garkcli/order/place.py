"""One method of a box: the residuals of its conditions, and how far the box can move them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property, partial
from itertools import islice
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.exact.affine import Forms
from garkcli.exact.display import to_float
from garkcli.exact.enclosing import midpoint
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import are_few, is_admissible, twin_roots
from garkcli.order.approximate_spans import ApproximateSpans
from garkcli.order.bounded import exactly
from garkcli.order.rows import FormDefects, System, joined, may_vanish, of_tree
from garkcli.order.tree_residuals import TreeResiduals
from garkcli.tableau.box import Box, FormTableau
from garkcli.tableau.embedded import NOTHING, Further, Weights, from_colours, with_weights
from garkcli.tableau.enclosure import enclose_tableau
from garkcli.tableau.tableau import Tableau

MOST_TREES = 50_000
MOST_ROWS = 60
COARSENING = 16.0
"""Factor on the radii for conditions that are met to second order only."""

Derive: TypeAlias = Callable[[Tableau], Tableau]


@contextmanager
def arithmetic(bits: int) -> Iterator[None]:
    """Computes with ``bits`` bits inside; floats that overflow leave questions open."""
    with ctx.workprec(bits), np.errstate(all="ignore"):
        yield


class BoxPlace:
    """A method of the box by the ``shifts`` of its numbers, in units of their radii. ``slack`` is
    the part of its reach up to which a row counts as met: 0 if Newton's method converged; else rows
    are met to second order only, as where varieties cross.
    """

    def __init__(self, search: SearchedBox, shifts: Sequence[fmpq]) -> None:
        self.search = search
        self.shifts = tuple(shifts)
        self.slack = 0.0
        self._defects: dict[str, FormDefects] = {}
        self._values: dict[str, FormDefects] = {}
        self._exact: dict[str, Tableau] = {}
        self._residuals: dict[str, TreeResiduals] = {}
        self._spans: dict[str, ApproximateSpans] = {}
        self._missed: dict[tuple[str, int], list[Tree]] = {}

    def __getstate__(self) -> tuple[Any, ...]:
        # what is made around it is made again in another process
        return self.search, self.shifts, self.slack

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        search, shifts, slack = state
        BoxPlace.__init__(self, search, shifts)
        self.slack = slack

    @property
    def distance(self) -> float:
        return max((abs(to_float(x)) for x in self.shifts), default=0.0)

    @property
    def is_inside(self) -> bool:
        return all(abs(x) <= 1 for x in self.shifts)

    @cached_property
    def _made(self) -> FormTableau:
        return self.search.box.around(self.shifts)

    @cached_property
    def _method(self) -> Tableau:
        with arithmetic(self.search.bits):
            return self.search.box.at(self.shifts)

    @property
    def grain(self) -> fmpq:
        if not self.slack:
            return self.search.grain
        return max(self.search.grain, exactly(COARSENING * self.slack * self.search.radius))

    @property
    def further(self) -> Further:
        return from_colours(self._method, self.search.printed_further)[1]

    def exact(self, name: str) -> Tableau:
        if name not in self._exact:
            with arithmetic(self.search.bits):
                self._exact[name] = self.search.targets[name](self._method)
        return self._exact[name]

    def defects(self, name: str) -> FormDefects:
        """The defects of a derived tableau, as forms around this method."""
        if name not in self._defects:
            with arithmetic(self.search.bits):
                made = self.search.targets[name](self._made.made)
                self._defects[name] = FormDefects(FormTableau(made, self._made.numbers))
        return self._defects[name]

    def in_balls(self, name: str) -> Tableau:
        with arithmetic(self.search.bits):
            return self.defects(name).tableau.in_balls

    def rows(self, system: System) -> Forms:
        with arithmetic(self.search.bits):
            return joined([self.defects(name).rows(x) for name, x in system.items() if x])

    def values(self, system: System) -> list[arb]:
        """The centres of the rows, without their slopes."""
        with arithmetic(self.search.bits):
            found: list[arb] = []
            for name, chosen in system.items():
                if name not in self._values:
                    self._values[name] = FormDefects(FormTableau(self.exact(name), 0))
                found += self._values[name].rows(chosen).centres if chosen else []
            return found

    def missed(self, name: str, order: int) -> list[Tree]:
        """Trees of an order whose conditions this method misses, largest residual first."""
        key = name, order
        if key not in self._missed:
            check_time()
            self._missed[key] = self._found_missed(name, order)
        return self._missed[key]

    def _found_missed(self, name: str, order: int) -> list[Tree]:
        tableau, bits = self.exact(name), self.search.bits
        small, share = self.search.small, self.search.share(name, order)
        if not share or are_few(tableau, order, MOST_TREES):
            if name not in self._residuals:
                self._residuals[name] = TreeResiduals(tableau, enclose_tableau(tableau, bits))
            residuals = self._residuals[name]
            table = residuals.table(order)
            sizes = [(abs(x), u) for x, _, u in residuals.of_order(order, share)]
            missed = [(x, u) for x, u in sizes if not x < small]
            missed.sort(key=lambda x: float(x[0].mid()), reverse=True)
            return self._beyond_slack(name, (table.tree(u) for _, u in missed), share)
        bush = self._bush_missed(name, order)
        if bush is not None:
            return [bush]
        if name not in self._spans:
            enclosure = enclose_tableau(tableau, bits)
            self._spans[name] = ApproximateSpans(tableau, enclosure, small)
        hulls = self._spans[name].sizes(order)
        if hulls.bound < small:
            return []
        members = (tree for x, tree in hulls.members if not x < small)
        return self._beyond_slack(name, members, share)

    def _bush_missed(self, name: str, order: int) -> Tree | None:
        """Returns a bush whose condition no method of the box meets; None if there is none. These
        are cheap to test first: few methods integrate to a higher order than they have.
        """
        tableau = self.exact(name)
        for l in twin_roots(tableau):
            for m in range(tableau.size):
                leaf, colour = tableau.tree(m), tableau.colours[l]
                left = order - (colour.late or 0) - colour.kind.weight
                if left < 0 or not leaf.order or left % leaf.order:
                    continue
                bush = tableau.tree(l, (leaf,) * (left // leaf.order))
                if not is_admissible(tableau, bush):
                    continue
                if not self.search.origin.may_meet(name, bush):
                    return bush
        return None

    def _beyond_slack(self, name: str, trees: Iterable[Tree], share: int) -> list[Tree]:
        if not self.slack:
            return [*islice(trees, MOST_ROWS)]
        with arithmetic(self.search.bits):
            defects = self.defects(name)
            beyond = (u for u in trees if not self.is_met(defects.of(of_tree(u, share)), 0))
            return [*islice(beyond, MOST_ROWS)]

    def meets(self, name: str, tree: Tree) -> bool:
        with arithmetic(self.search.bits):
            return self.is_met(self._tree_row(name, tree), 0)

    def reach(self, name: str, tree: Tree) -> fmpq:
        """The largest change of the elementary weight of a tree within the box."""
        with arithmetic(self.search.bits):
            row = self._tree_row(name, tree)
        [size] = row.reach + row.remainders
        return midpoint(arb(float(size))) / tree.density

    def may_meet(self, name: str, tree: Tree) -> bool:
        with arithmetic(self.search.bits):
            return may_vanish(self._tree_row(name, tree), 0)

    def may_be_sum(self, name: str, parts: Sequence[str]) -> bool:
        """Whether within the radii the weights of a tableau may be the sums of those of others."""
        with arithmetic(self.search.bits):
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


class SearchedBox:
    """A box, with colours for its further weights; ``further`` has these as printed."""

    def __init__(self, box: Box, further: Further = NOTHING) -> None:
        self.box = box
        self.printed_further = further
        self.targets: dict[str, Derive] = {"method": partial(_own, further)}
        finest = max((-_binary_exponent(t) for t in box.radii), default=0)
        # what is of second order in the radii is no zero
        self.zero_bits = max(120, 2 * finest + 80)
        self.bits = self.zero_bits + 100
        coarsest = min((-_binary_exponent(t) for t in box.radii), default=0)
        self.goal = arb(2) ** -(self.zero_bits - max(coarsest, 0) + 40)
        self.grain = fmpq(1, 1 << self.zero_bits)
        self.small = arb(self.grain)
        self.radius = max((to_float(t) for t in box.radii), default=0.0)
        self.origin = BoxPlace(self, (fmpq(0),) * len(box.numbers))
        self.powers: dict[str, int] = {}

    def share(self, name: str, order: int) -> int:
        """The required γ(u)-fold weights of an order: 1, or 0 for another power of θ."""
        return int(self.powers.get(name, order) == order)

    def add_further(self) -> None:
        """Adds the tableaus with embedded weights, and with those of each power of θ, as b."""
        if self.printed_further.embedded is not None:
            self.with_weights("embedded", _embedded)
        for power in range(1, len(self.printed_further.powers) + 1):
            name = f"power {power}"
            self.powers[name] = power
            self.with_weights(name, partial(_power, power))

    def with_weights(self, name: str, weights: Callable[[Further], Weights]) -> None:
        self.targets.setdefault(name, partial(self._with, weights))

    def _with(self, weights: Callable[[Further], Weights], whole: Tableau) -> Tableau:
        own, further = from_colours(whole, self.printed_further)
        return with_weights(own, weights(further))


def _own(further: Further, whole: Tableau) -> Tableau:
    return from_colours(whole, further)[0]


def _embedded(further: Further) -> Weights:
    return further.embedded or ()


def _power(power: int, further: Further) -> Weights:
    return further.powers[power - 1]


def _binary_exponent(x: fmpq) -> int:
    return int(x.p.bit_length()) - int(x.q.bit_length()) + 1
