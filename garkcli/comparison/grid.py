"""Methods as they are compared: colour by colour, entry by entry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from flint import arb, ctx

from garkcli.conversion.sheet import (
    CannotConvert,
    Rows,
    Sheet,
    each_its_own,
    in_one_field,
    sheet_of,
)
from garkcli.exact.display import to_ball
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Block, Cell, Row, entries

DIGITS = 60
"""Digits of entries that have no simple radicals."""
CellRows: TypeAlias = tuple[Row, ...]
"""A row a colour."""


@dataclass(frozen=True)
class Grid:
    """The entries of a method, each colour with stages of its own.

    Attributes:
        A: ``A[l][m]`` is a block, or None.
        b, c: a row a colour.
        embedded: the embedded weights, or None.
        powers: what stands before θ, θ², … in the dense weights.
        linear: for each colour whether it is linear.
    """

    A: tuple[tuple[Block, ...], ...]
    b: CellRows
    c: CellRows
    embedded: CellRows | None
    powers: tuple[CellRows, ...]
    linear: tuple[bool, ...]

    @property
    def size(self) -> int:
        """The number of colours."""
        return len(self.b)

    @property
    def stages(self) -> tuple[int, ...]:
        """The number of stages of each colour."""
        return tuple(map(len, self.b))

    @property
    def further(self) -> tuple[CellRows, ...]:
        """All weights besides b."""
        first = () if self.embedded is None else (self.embedded,)
        return (*first, *self.powers)

    @property
    def blocks(self) -> list[Block]:
        """All blocks, row by row."""
        return [block for row in self.A for block in row]

    def with_colours(self, order: Sequence[int]) -> Grid:
        """The same method with its colours in another order."""

        def chosen(rows: CellRows) -> CellRows:
            return tuple(rows[l] for l in order)

        embedded = None if self.embedded is None else chosen(self.embedded)
        return Grid(
            A=tuple(tuple(self.A[l][m] for m in order) for l in order),
            b=chosen(self.b),
            c=chosen(self.c),
            embedded=embedded,
            powers=tuple(map(chosen, self.powers)),
            linear=tuple(self.linear[l] for l in order),
        )

    @property
    def of_the_step(self) -> Grid:
        """The same without further weights."""
        return replace(self, embedded=None, powers=())


def common_sheets(one: GarkMethod, other: GarkMethod) -> tuple[Sheet, Sheet] | None:
    """Both methods with exact entries from one field, each colour with stages of its own; None
    where the nodes of one have no simple radicals.
    """
    try:
        sheets = [sheet_of(one), sheet_of(other)]
        first, second = in_one_field(sheets)
    except CannotConvert:
        return None
    return each_its_own(first), each_its_own(second)


def grid_of(sheet: Sheet) -> Grid:
    """The entries of a sheet in which each colour has stages of its own."""
    tableau = sheet.tableau
    colours = range(tableau.size)
    return Grid(
        A=tuple(tuple(tableau.block(l, m) for m in colours) for l in colours),
        b=tuple(colour.b for colour in tableau.colours),
        c=tuple(colour.c for colour in tableau.colours),
        embedded=sheet.embedded,
        powers=sheet.powers,
        linear=tuple(colour.is_linear for colour in tableau.colours),
    )


def enclosed_grid(method: GarkMethod) -> Grid:
    """The entries as enclosures, good to ``DIGITS`` digits."""
    found = entries(method.tableau, DIGITS).in_decimals(DIGITS)
    powers: list[CellRows] = []
    if method.dense is not None:
        dense = method.dense
        numbers = range(1, dense.degree + 1)
        powers = [_enclosed(dense.coefficients(k)) for k in numbers]
    embedded = None
    if method.embedded is not None:
        embedded = _enclosed(method.embedded)
    linear = tuple(colour.is_linear for colour in method.tableau.colours)
    return Grid(found.A, found.b, found.c, embedded, tuple(powers), linear)


def _enclosed(rows: Rows) -> CellRows:
    return tuple(tuple(to_ball(x, DIGITS) for x in row) for row in rows)


def difference(one: Cell, other: Cell) -> Cell:
    """One entry minus another; of enclosures an enclosure."""
    if not isinstance(one, arb) and not isinstance(other, arb):
        return one - other
    with ctx.workprec(4 * DIGITS + 64):
        return _ball(one) - _ball(other)


def _ball(cell: Cell) -> arb:
    return cell if isinstance(cell, arb) else to_ball(cell, DIGITS)
