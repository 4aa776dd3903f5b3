"""Methods as compared: by entries, equal exactly or within the rounding that their files admit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from flint import arb, ctx, fmpq

from garkcli.conversion.sheet import CannotConvert, Sheet, each_its_own, in_one_field, sheet_of
from garkcli.exact.display import to_ball
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.kind import VertexKind
from garkcli.order.tolerance import within
from garkcli.tableau.embedded import Weights
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Block, Cell, Row, entries

DIGITS = 60
"""Digits of entries without simple radicals."""
CellRows: TypeAlias = tuple[Row, ...]


class Grid(Frozen):
    """A method whose colours have stages of their own; ``powers`` of θ are of dense weights."""

    A: tuple[tuple[Block, ...], ...]
    b: CellRows
    c: CellRows
    embedded: CellRows | None
    powers: tuple[CellRows, ...]
    kinds: tuple[VertexKind, ...]

    @property
    def size(self) -> int:
        return len(self.b)

    @property
    def stages(self) -> tuple[int, ...]:
        return tuple(map(len, self.b))

    @property
    def further(self) -> tuple[CellRows, ...]:
        first = () if self.embedded is None else (self.embedded,)
        return (*first, *self.powers)

    @property
    def blocks(self) -> list[Block]:
        return [block for row in self.A for block in row]

    def with_colours(self, order: Sequence[int]) -> Grid:
        def chosen(rows: CellRows) -> CellRows:
            return tuple(rows[l] for l in order)

        embedded = None if self.embedded is None else chosen(self.embedded)
        return Grid(
            A=tuple(tuple(self.A[l][m] for m in order) for l in order),
            b=chosen(self.b),
            c=chosen(self.c),
            embedded=embedded,
            powers=tuple(map(chosen, self.powers)),
            kinds=tuple(self.kinds[l] for l in order),
        )

    @property
    def of_the_step(self) -> Grid:
        return replace(self, embedded=None, powers=())


def common_sheets(one: GarkMethod, other: GarkMethod) -> tuple[Sheet, Sheet] | None:
    """Returns both methods in one field; None if nodes have no simple radicals."""
    try:
        first, second = in_one_field([sheet_of(one), sheet_of(other)])
    except CannotConvert:
        return None
    return each_its_own(first), each_its_own(second)


def grid_of(sheet: Sheet) -> Grid:
    tableau = sheet.tableau
    colours = range(tableau.size)
    return Grid(
        A=tuple(tuple(tableau.block(l, m) for m in colours) for l in colours),
        b=tuple(colour.b for colour in tableau.colours),
        c=tuple(colour.c for colour in tableau.colours),
        embedded=sheet.further.embedded,
        powers=sheet.further.powers,
        kinds=tuple(colour.kind for colour in tableau.colours),
    )


def enclosed_grid(method: GarkMethod) -> Grid:
    cells = entries(method.tableau, DIGITS).in_decimals(DIGITS)
    powers = tuple(map(_enclosed, method.further.powers))
    embedded = None if method.embedded is None else _enclosed(method.embedded)
    kinds = tuple(colour.kind for colour in method.tableau.colours)
    return Grid(cells.A, cells.b, cells.c, embedded, powers, kinds)


def _enclosed(rows: Weights) -> CellRows:
    return tuple(tuple(to_ball(x, DIGITS) for x in row) for row in rows)


def difference(one: Cell, other: Cell) -> Cell:
    if not isinstance(one, arb) and not isinstance(other, arb):
        return one - other
    with ctx.workprec(4 * DIGITS + 64):
        return _ball(one) - _ball(other)


def _ball(cell: Cell) -> arb:
    return cell if isinstance(cell, arb) else to_ball(cell, DIGITS)


class Likeness(Frozen):
    """Compares entries that rounding may have moved apart by ``allowed``."""

    allowed: fmpq = ZERO

    def cells(self, one: Cell, other: Cell) -> bool | None:
        """Returns whether two entries are equal; None if their enclosures overlap."""
        gap = difference(one, other)
        if not isinstance(gap, arb):
            return within(gap, self.allowed)
        size = abs(gap)
        if size <= self.allowed:
            return True
        return False if size > self.allowed else None

    def rows(self, one: Row, other: Row) -> bool:
        return all(self.cells(x, y) is not False for x, y in zip(one, other, strict=True))

    def blocks(self, one: Block, other: Block) -> bool:
        """Returns False if two blocks are known to differ; a missing block equals only a missing
        one.
        """
        if one is None or other is None:
            return one is other
        return all(self.rows(x, y) for x, y in zip(one, other, strict=True))

    def grids(self, one: Grid, other: Grid) -> bool:
        if not have_one_shape(one, other):
            return False
        if not all(self.rows(x, y) for x, y in zip(_all_rows(one), _all_rows(other), strict=True)):
            return False
        return all(self.blocks(x, y) for x, y in zip(one.blocks, other.blocks, strict=True))


def have_one_shape(one: Grid, other: Grid) -> bool:
    if one.stages != other.stages or one.kinds != other.kinds:
        return False
    if (one.embedded is None) != (other.embedded is None):
        return False
    return len(one.powers) == len(other.powers)


def _all_rows(grid: Grid) -> list[Row]:
    rows = [*grid.c, *grid.b]
    for weights in grid.further:
        rows += weights
    return rows
