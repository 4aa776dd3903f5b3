"""A table as an audit checks it: its method, and what several checks need once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

from garkcli.bridges.importing import digits_of
from garkcli.bridges.judging import Digits, Judged, judged
from garkcli.exact.display import to_ball, to_decimal, to_text
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.methodfile.build import MethodFile
from garkcli.order.simplifying import RoundedDefects
from garkcli.sources.found import FoundTable
from garkcli.tableau.forms import with_time
from garkcli.tableau.rounded import RoundedTableau
from garkcli.tableau.tableau import Tableau

NEAR = 1e-3
"""Row sums and nodes that differ by less are meant to be the same."""


class Subject(Frozen):
    """A table as it is checked.

    Attributes:
        table: as it was found.
        method: as it is read.
        order: of the method.
        embedded_order: with the embedded weights; None without them.
    """

    table: FoundTable
    method: MethodFile
    order: Judged
    embedded_order: Judged | None

    @property
    def tableau(self) -> Tableau:
        """The method."""
        return self.method.tableau

    @cached_property
    def digits(self) -> Digits:
        """How exactly the coefficients are written."""
        return digits_of(self.method, self.table)

    @cached_property
    def rounded(self) -> RoundedTableau:
        """The method with what its digits leave open."""
        return self.digits.of(self.tableau)

    @cached_property
    def wrong_rows(self) -> tuple[str, ...]:
        """The nodes that are no row sums, beyond what rounding explains, in words."""
        return tuple(self._off(self.rounded))

    @property
    def careless_rows(self) -> tuple[str, ...]:
        """The nodes that are no sums of numbers which are off by one unit of their last place."""
        return tuple(self._off(self.digits.of(self.tableau, slack=1)))

    @cached_property
    def misprinted_rows(self) -> Mapping[str, Number]:
        """Those that no careless rounding explains either, with by how much they are off."""
        return self._off(self.digits.careless(self.tableau))

    @property
    def is_misprinted(self) -> bool:
        """Whether a row sum is next to its node, and no rounding explains that it is not the node:
        nodes that are meant to be others are further away.
        """
        return any(abs(to_ball(x)) < NEAR for x in self.misprinted_rows.values())

    @property
    def is_slightly_off(self) -> bool:
        """Whether a sum is not what it should be: that of a row, or that of the weights; or a
        condition fails by little.
        """
        witness = self.order.witness
        is_near = witness is not None and bool(abs(to_ball(witness.residual)) < NEAR)
        return not self.order.order or is_near or bool(self.wrong_rows)

    def _off(self, rounded: RoundedTableau) -> dict[str, Number]:
        """The nodes that are no row sums within a rounding, in words, with by how much."""
        defects = RoundedDefects(rounded)
        found: dict[str, Number] = {}
        # parts of shared stages with times of their own: each has its own row sums for nodes
        has_own_times = len(self.table.A) > 1 and len(set(self.table.A)) == 1
        for l, m in self.tableau.edges():
            if has_own_times and l != m:
                continue
            block = self.tableau.block(l, m) or ()
            rows = zip(block, self.tableau.colours[l].c, defects.C(l, m, 1), strict=True)
            for i, (row, node, defect) in enumerate(rows, start=1):
                if not defects.vanish([defect]):
                    total = sum(row, ZERO)
                    found[_row_text(i, total, node)] = total - node
        return found

    @cached_property
    def nonautonomous(self) -> Judged | None:
        """The order where f depends on t, with the nodes as they are."""
        timed = with_time(self.tableau)
        if timed is None:
            return None
        if not self.wrong_rows:
            return self.order
        return judged(self.digits, timed, self.table.order, max(self.order.order, 1))

    @property
    def misses_order(self) -> bool:
        """Whether the order is lower than declared, and known to be."""
        declared = self.table.order
        if declared is None or self.order.is_limited or self.order.order >= declared:
            return False
        return not self.order.is_open


def _row_text(i: int, total: Number, node: Number) -> str:
    sums, given, off = short(total), short(node), total - node
    if sums == given:
        return f"row {i} has the sum {sums}, off its node by {to_decimal(off, 2)}"
    text = f"row {i} has the sum {sums}, its node is {given}"
    return f"{text}, off by {to_decimal(off, 2)}" if abs(to_ball(off)) < NEAR else text


def sum_text(weights: Iterable[Number]) -> str:
    """The sum of weights as people read it: its distance from 1 where it is next to it."""
    total = sum(weights, ZERO)
    off = to_decimal(total - 1, 2)
    if total == 1 or abs(to_ball(total - 1)) >= NEAR:
        return short(total)
    return f"1 - {off[1:]}" if off.startswith("-") else f"1 + {off}"


def short(number: Number) -> str:
    """A number as people read it: exactly where that is short."""
    text = to_text(number)
    if len(text) <= 24:
        return text
    return to_decimal(number, 12)
