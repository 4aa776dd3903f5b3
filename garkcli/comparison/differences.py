"""Entries in which methods differ, and order conditions that only one of them fulfils."""

from __future__ import annotations

from collections.abc import Iterator

from flint import arb

from garkcli.comparison.grid import DIGITS, CellRows, Grid, Likeness, difference
from garkcli.exact.display import to_ball
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.count import Admissible, counts_of
from garkcli.ntrees.listing import trees_of
from garkcli.order.admissible import coupling_graph, twin_roots
from garkcli.order.conditions import Condition, conditions
from garkcli.order.meant import AnyTableau, printed
from garkcli.tableau.pointwise import Block, Cell


class EntryGap(Frozen):
    """An entry that differs, counted from 0; open if enclosures cannot tell the two apart."""

    row: int | None
    entry: int
    one: Cell
    other: Cell
    is_open: bool = False

    @property
    def gap(self) -> Cell:
        return difference(self.other, self.one)


class BlockGap(Frozen):
    """A block, or a row of weights or nodes, that differs.

    ``kind`` is ``A``, ``b``, ``c``, ``embedded`` or ``dense``; ``alpha``, ``beta`` or ``c + d`` of
    Rosenbrock methods; ``Abar``, ``bbar`` or ``embedded bbar`` of Nyström methods. ``colour`` is
    that of its stages, from 0, ``seen`` the second one of a block, ``power`` that of θ. Different
    ``shapes`` are in words, with 0 ``entries``.
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
        return max(self.gaps, key=_size, default=None)


def _size(gap: EntryGap) -> arb:
    difference = gap.gap
    ball = difference if isinstance(difference, arb) else to_ball(difference, DIGITS)
    size: arb = abs(ball).mid()
    return size


def block_gaps(one: Grid, other: Grid, likeness: Likeness) -> Iterator[BlockGap]:
    """Yields the differences of methods with equally many colours: blocks, weights, nodes."""
    compare = _Compare(likeness)
    colours = range(one.size)
    for l in colours:
        for m in colours:
            yield from compare.blocks(BlockGap("A", l, m), one.A[l][m], other.A[l][m])
    for kind, first, second in (
        ("b", one.b, other.b),
        ("c", one.c, other.c),
        ("embedded", one.embedded, other.embedded),
    ):
        yield from compare.weights(kind, 0, first, second)
    for k in range(max(len(one.powers), len(other.powers))):
        first_power = one.powers[k] if k < len(one.powers) else None
        other_power = other.powers[k] if k < len(other.powers) else None
        yield from compare.weights("dense", k + 1, first_power, other_power)


class _Compare:
    def __init__(self, likeness: Likeness) -> None:
        self.likeness = likeness

    def weights(
        self, kind: str, power: int, one: CellRows | None, other: CellRows | None
    ) -> Iterator[BlockGap]:
        if one is None and other is None:
            return
        for l in range(len(one or other or ())):
            first = None if one is None else (one[l],)
            second = None if other is None else (other[l],)
            yield from self.blocks(BlockGap(kind, l, power=power), first, second)

    def blocks(self, place: BlockGap, one: Block, other: Block) -> Iterator[BlockGap]:
        if one is None and other is None:
            return
        is_row = place.seen is None
        shapes = _shape(one, is_row), _shape(other, is_row)
        if one is None or other is None or shapes[0] != shapes[1]:
            yield _at(place, shapes=shapes)
            return
        gaps: list[EntryGap] = []
        for i, (first, second) in enumerate(zip(one, other, strict=True)):
            for j, (x, y) in enumerate(zip(first, second, strict=True)):
                alike = self.likeness.cells(x, y)
                if alike is not True:
                    gaps.append(EntryGap(None if is_row else i, j, x, y, alike is None))
        if gaps:
            yield _at(place, entries=sum(map(len, one)), gaps=tuple(gaps))


def _at(
    place: BlockGap,
    entries: int = 0,
    gaps: tuple[EntryGap, ...] = (),
    shapes: tuple[str, str] | None = None,
) -> BlockGap:
    return BlockGap(place.kind, place.colour, place.seen, place.power, entries, gaps, shapes)


def _shape(block: Block, is_row: bool) -> str:
    if block is None:
        return "none"
    if is_row:
        return str(len(block[0]))
    columns = len(block[0]) if block else 0
    return f"{len(block)} by {columns}"


MAX_CONDITIONS = 2000
"""Most conditions that are compared, of all orders together."""


class Met(Frozen):
    """The conditions up to ``order`` that only one method fulfils, in ``pairs`` of both methods."""

    order: int
    pairs: tuple[tuple[Condition, Condition], ...]

    @property
    def first_only(self) -> tuple[tuple[Condition, Condition], ...]:
        return tuple(x for x in self.pairs if x[0].holds)

    @property
    def second_only(self) -> tuple[tuple[Condition, Condition], ...]:
        return tuple(x for x in self.pairs if x[1].holds)


def conditions_met(one: AnyTableau, other: AnyTableau, orders: tuple[int, int]) -> Met:
    """Returns the conditions that only one fulfils, up to the first order at which both fail."""
    tableau = printed(one)
    graph = _in_both(coupling_graph(tableau), coupling_graph(printed(other)))
    # root colours, one of each group whose conditions are the same in both methods
    twins = twin_roots(tableau)
    roots = [*twins] if twins == twin_roots(printed(other)) else [*range(tableau.size)]
    pairs: list[tuple[Condition, Condition]] = []
    reached, total = 0, 0
    ends = [x.exact_to for x in (tableau, printed(other)) if x.exact_to is not None]
    for order in range(1, min([max(orders) + 1, *ends]) + 1):
        by_root = counts_of(graph, order)
        total += sum(by_root[root] for root in roots)
        if total > MAX_CONDITIONS:
            break
        reached = order
        if order <= min(orders):
            continue
        trees = list(trees_of(graph, order, roots))
        if order <= orders[0]:
            trees = [x.tree for x in conditions(other, trees) if not x.holds]
        elif order <= orders[1]:
            trees = [x.tree for x in conditions(one, trees) if not x.holds]
        for first, second in zip(conditions(one, trees), conditions(other, trees), strict=True):
            if first.holds != second.holds:
                pairs.append((first, second))
    return Met(reached, tuple(pairs))


def _in_both(one: Admissible, other: Admissible) -> Admissible:
    rows = zip(one.branches, other.branches, strict=True)
    kinds = zip(one.kinds, other.kinds, strict=True)
    return Admissible(
        one.colours,
        tuple(tuple(m for m in row if m in second) for row, second in rows),
        tuple(replace(kind, arity=kind.arity & second.arity) for kind, second in kinds),
    )
