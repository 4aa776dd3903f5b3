"""Where the entries of two methods differ, and by how much."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from flint import arb

from garkcli.comparison.grid import DIGITS, CellRows, Grid, difference
from garkcli.comparison.likeness import Likeness
from garkcli.exact.display import to_ball
from garkcli.tableau.pointwise import Block, Cell


@dataclass(frozen=True)
class EntryGap:
    """One entry that differs.

    Attributes:
        row: its row from 0; None in weights and nodes.
        entry: its place in the row from 0.
        one, other: the entries.
        is_open: whether enclosures cannot tell them apart.
    """

    row: int | None
    entry: int
    one: Cell
    other: Cell
    is_open: bool = False

    @property
    def gap(self) -> Cell:
        """The second minus the first."""
        return difference(self.other, self.one)


@dataclass(frozen=True)
class BlockGap:
    """A block, or a row of weights or nodes, that differs.

    Attributes:
        kind: ``A``, ``b``, ``c``, ``embedded`` or ``dense``.
        colour: the colour whose stages it belongs to, from 0.
        seen: of a block the colour that they see, from 0; None otherwise.
        power: of dense weights the power of θ; 0 otherwise.
        entries: how many entries it has; 0 where the shapes differ.
        gaps: the entries that differ.
        shapes: the shapes where these differ, in words; empty otherwise.
    """

    kind: str
    colour: int
    seen: int | None = None
    power: int = 0
    entries: int = 0
    gaps: tuple[EntryGap, ...] = ()
    shapes: tuple[str, str] | None = None

    @property
    def largest(self) -> EntryGap | None:
        """The entry with the largest difference, the first of several alike."""
        return max(self.gaps, key=_size, default=None)


def _size(gap: EntryGap) -> arb:
    found = gap.gap
    ball = found if isinstance(found, arb) else to_ball(found, DIGITS)
    size: arb = abs(ball).mid()
    return size


def block_gaps(one: Grid, other: Grid, likeness: Likeness) -> Iterator[BlockGap]:
    """Everything that differs between methods with the same number of colours: blocks, weights,
    nodes, further weights.
    """
    compare = _Compare(likeness)
    colours = range(one.size)
    for l in colours:
        for m in colours:
            place = BlockGap("A", l, m)
            yield from compare.blocks(place, one.A[l][m], other.A[l][m])
    for kind, first, second in (
        ("b", one.b, other.b),
        ("c", one.c, other.c),
        ("embedded", one.embedded, other.embedded),
    ):
        yield from compare.weights(kind, 0, first, second)
    degree = max(len(one.powers), len(other.powers))
    for k in range(degree):
        first_power = one.powers[k] if k < len(one.powers) else None
        other_power = other.powers[k] if k < len(other.powers) else None
        yield from compare.weights("dense", k + 1, first_power, other_power)


class _Compare:
    """Comparison of single blocks and rows."""

    def __init__(self, likeness: Likeness) -> None:
        self.likeness = likeness

    def weights(
        self, kind: str, power: int, one: CellRows | None, other: CellRows | None
    ) -> Iterator[BlockGap]:
        """Weights or nodes of all colours, which one of the methods may lack."""
        if one is None and other is None:
            return
        colours = range(len(one or other or ()))
        for l in colours:
            first = None if one is None else (one[l],)
            second = None if other is None else (other[l],)
            place = BlockGap(kind, l, power=power)
            yield from self.blocks(place, first, second)

    def blocks(self, place: BlockGap, one: Block, other: Block) -> Iterator[BlockGap]:
        """One block; nothing where it is the same in both."""
        if one is None and other is None:
            return
        is_row = place.seen is None
        shapes = _shape(one, is_row), _shape(other, is_row)
        if one is None or other is None or shapes[0] != shapes[1]:
            yield _at(place, shapes=shapes)
            return
        gaps: list[EntryGap] = []
        pairs = zip(one, other, strict=True)
        for i, (first, second) in enumerate(pairs):
            entries = zip(first, second, strict=True)
            for j, (x, y) in enumerate(entries):
                alike = self.likeness.cells(x, y)
                if alike is not True:
                    row = None if is_row else i
                    gaps.append(EntryGap(row, j, x, y, alike is None))
        if gaps:
            count = sum(map(len, one))
            yield _at(place, entries=count, gaps=tuple(gaps))


def _at(
    place: BlockGap,
    entries: int = 0,
    gaps: tuple[EntryGap, ...] = (),
    shapes: tuple[str, str] | None = None,
) -> BlockGap:
    return BlockGap(place.kind, place.colour, place.seen, place.power, entries, gaps, shapes)


def _shape(block: Block, is_row: bool) -> str:
    """A shape in words."""
    if block is None:
        return "none"
    if is_row:
        return str(len(block[0]))
    columns = len(block[0]) if block else 0
    return f"{len(block)} by {columns}"
