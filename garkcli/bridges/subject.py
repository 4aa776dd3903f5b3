"""A table as an audit checks it: its method, and what several checks need once."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from garkcli.bridges.judging import Judged, digits_of, judged
from garkcli.exact.display import to_ball, to_decimal, to_text
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.methodfile.build import MethodFile
from garkcli.order.simplifying import RoundedDefects
from garkcli.sources.found import FoundTable
from garkcli.tableau.forms import with_time
from garkcli.tableau.rounded import RoundedTableau
from garkcli.tableau.tableau import Tableau

SLIGHT = 1e-10
"""Nodes that are off by less are no misprints: coefficients of ten digits and more are rounded."""


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
    def rounded(self) -> RoundedTableau:
        """The method with what its digits leave open."""
        return digits_of(self.method, self.tableau)

    @property
    def wrong_rows(self) -> tuple[str, ...]:
        """The nodes that are no row sums, beyond what rounding explains, in words."""
        return tuple(self._wrong)

    @property
    def is_slightly_off(self) -> bool:
        """Whether these nodes differ by so little that fractions may be cut short."""
        return bool(self._wrong) and all(abs(to_ball(x)) < SLIGHT for x in self._wrong.values())

    @cached_property
    def _wrong(self) -> Mapping[str, Number]:
        """These nodes in words, with by how much they are off."""
        defects = RoundedDefects(self.rounded)
        found: dict[str, Number] = {}
        for l, m in self.tableau.edges():
            block = self.tableau.block(l, m) or ()
            nodes = self.tableau.colours[l].c
            rows = zip(block, nodes, defects.C(l, m, 1), strict=True)
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
        return judged(self.method, timed, self.table.order)

    @property
    def misses_order(self) -> bool:
        """Whether the order is lower than declared, and known to be."""
        declared = self.table.order
        if declared is None or self.order.order >= declared:
            return False
        return not self.order.is_open


def _row_text(i: int, total: Number, node: Number) -> str:
    sums = f"row {i} has the sum {short(total)}"
    return f"{sums}, its node is {short(node)}"


def short(number: Number) -> str:
    """A number as people read it: exactly where that is short."""
    text = to_text(number)
    if len(text) <= 24:
        return text
    return to_decimal(number, 12)
