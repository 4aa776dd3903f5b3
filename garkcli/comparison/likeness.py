"""When two entries count as the same: exactly, or within the rounding that their files admit."""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, fmpq

from garkcli.comparison.grid import Grid, difference
from garkcli.exact.field import ZERO
from garkcli.order.tolerance import within
from garkcli.tableau.pointwise import Block, Cell, Row


@dataclass(frozen=True)
class Likeness:
    """Equality of entries.

    Attributes:
        allowed: how far rounding may have moved two equal entries apart; 0 where both are exact.
    """

    allowed: fmpq = ZERO

    def cells(self, one: Cell, other: Cell) -> bool | None:
        """Whether two entries are alike; None where enclosures leave it open."""
        gap = difference(one, other)
        if not isinstance(gap, arb):
            return within(gap, self.allowed)
        size = abs(gap)
        if size <= self.allowed:
            return True
        return False if size > self.allowed else None

    def rows(self, one: Row, other: Row) -> bool:
        """Whether rows of one length may be alike, entry by entry."""
        pairs = zip(one, other, strict=True)
        return all(self.cells(x, y) is not False for x, y in pairs)

    def blocks(self, one: Block, other: Block) -> bool:
        """Whether blocks may be alike: both missing, or alike entry by entry."""
        if one is None or other is None:
            return one is other
        pairs = zip(one, other, strict=True)
        return all(self.rows(x, y) for x, y in pairs)

    def grids(self, one: Grid, other: Grid) -> bool:
        """Whether methods may be alike, stage by stage."""
        if not have_one_shape(one, other):
            return False
        rows = zip(_all_rows(one), _all_rows(other), strict=True)
        if not all(self.rows(x, y) for x, y in rows):
            return False
        pairs = zip(one.blocks, other.blocks, strict=True)
        return all(self.blocks(x, y) for x, y in pairs)


def have_one_shape(one: Grid, other: Grid) -> bool:
    """Whether methods have the same colours, stages and kinds of weights."""
    if one.stages != other.stages or one.linear != other.linear:
        return False
    if (one.embedded is None) != (other.embedded is None):
        return False
    return len(one.powers) == len(other.powers)


def _all_rows(grid: Grid) -> list[Row]:
    """Nodes and weights of all kinds."""
    rows = [*grid.c, *grid.b]
    for weights in grid.further:
        rows += weights
    return rows
