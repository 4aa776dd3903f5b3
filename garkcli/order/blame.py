"""Which block is to blame for a failing order, and which single entry, changed, would restore it.

Both are hints drawn from the failing conditions, never facts about what a source meant to print.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from flint import fmpq

from garkcli.doing import doing
from garkcli.errors import ZeroWeight
from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.conditions import Condition, all_conditions, conditions, count_conditions
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, derived, meant, printed
from garkcli.order.tolerance import within
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

MAX_CONDITIONS = 20_000
"""Most conditions that are evaluated to find a culprit."""
MAX_ENTRIES = 2_000
"""Most entries that are tried."""
FEW_CONDITIONS = 4
"""So many failing conditions are solved for an entry of rounded coefficients; the best is kept."""
FEW_CHECKED = 20
"""So many failing conditions are examined before the order is found."""
FAR = 1_000_000
"""Rounding explains no residual of so many tolerances."""
NEWTON_STEPS = 3
"""Steps of the simplified Newton's method; each squares a small misprint, nearly."""
GAIN = 2
"""Of a method that claims no order an entry is named that restores so many. Of published methods
many are one entry away from the next order, and none of the catalogue from the next but one.
"""
HIGHEST_LOW = 4
"""A wrong entry leaves no more than this order: beyond it none is sought without a claim."""
FEW_ENTRIES = 400
"""Most entries that are tried without a claim."""
FEW_ROUNDED = 200
"""The same of rounded coefficients."""
FEW_CONDITIONS_UNASKED = 2_000
"""Most conditions that are evaluated without a claim."""


class Entry(Frozen):
    """One entry of a method.

    ``l, m`` are the block's colours, or ``m`` is None for the weights b^{l}; ``i, j`` the entry
    (``j`` of the weights; then ``i`` is None). All count from 0.
    """

    l: int
    m: int | None
    i: int | None
    j: int
    old: Number

    def put(self, method: Tableau, value: Number) -> Tableau:
        """The method with another value there.

        Weights are changed together with those that are the same row: of colours with the same
        stages.
        """
        if self.m is None or self.i is None:
            old = method.colours[self.l]
            b = _with_value(old.b, self.j, value)
            colours = (
                replace(x, b=b) if x.space == old.space and x.b == old.b else x
                for x in method.colours
            )
            return replace(method, colours=tuple(colours))
        key = method.colours[self.l].space, self.m
        block = list(method.blocks[key])
        block[self.i] = _with_value(block[self.i], self.j, value)
        return replace(method, blocks={**method.blocks, key: tuple(block)})


class Repair(Entry):
    """An entry that restores the claimed order when it is changed alone.

    ``is_embedded`` tells embedded weights from b.
    """

    new: Number
    is_embedded: bool = False

    def carried_out(self, method: Tableau) -> Tableau:
        """The method with this entry changed."""
        return self.put(method, self.new)


class Missed(Frozen):
    """A claimed order that is missed, and how conditions are judged.

    Attributes:
        order: the first failing order.
        claimed: the order that was meant.
        of: what claims it, as it is called in a file.
        which: ``conjugate`` or ``pair`` where it is claimed of that; empty for the method.
        tolerance: the rounding of the coefficients; conditions fail beyond what it explains.
        near: the rounding with which they are restored: more than ``tolerance`` where coefficients
            are rounded, as the entry that is changed carries the rounding of all others.
        is_embedded: whether it is claimed of embedded weights: only one of these may be wrong.
        keeps_shape: whether an entry outside the pattern of its block, such as one on the diagonal
            of an explicit method, is right as it is.
    """

    order: int
    claimed: int
    of: str = "order"
    which: str = ""
    tolerance: fmpq = ZERO
    near: fmpq = ZERO
    is_embedded: bool = False
    keeps_shape: bool = False

    def judged(self, method: Tableau) -> AnyTableau:
        """What the order is claimed of, as its conditions fail.

        Raises:
            ZeroWeight: there is no such thing.
        """
        return derived(meant(method, self.tolerance), self.which)

    def restored(self, method: Tableau) -> AnyTableau | None:
        """The same, as its conditions are restored; None where there is no such thing, or rounding
        may leave none.
        """
        try:
            made = derived(meant(method, self.near), self.which)
        except ZeroWeight:
            return None
        return made


def repairs(method: Tableau, missed: Missed, failing: list[Condition]) -> Iterator[Repair]:
    """Entries whose change restores what is claimed: each must solve a failing condition.

    Of exact coefficients one condition tells as much as all; of rounded ones the entry that solves
    it carries their rounding, so that the condition that depends on it most is solved.
    """
    solved = failing[:1]
    if missed.tolerance:
        solved = sorted(failing, key=lambda x: _size(x.residual), reverse=True)[:FEW_CONDITIONS]
    if not solved:
        return
    for tried, entry in enumerate(_entries(method, missed.is_embedded, missed.keeps_shape)):
        if tried >= MAX_ENTRIES:
            return
        new = _solution(method, missed, entry, solved)
        if new is None or within(new - entry.old, missed.tolerance):
            continue  # no misprint is as small as the rounding
        changed = missed.restored(entry.put(method, new))
        if changed is None:
            continue
        # takes less than the order
        few = [condition.tree for condition in failing[:FEW_CHECKED]]
        few += _bushes(printed(changed), missed.claimed)
        if _is_hopeless(printed(changed), few, FAR * missed.near):
            continue
        if not all(condition.holds for condition in conditions(changed, few)):
            continue
        if order_of(changed, missed.claimed).order >= missed.claimed:
            yield Repair(entry.l, entry.m, entry.i, entry.j, entry.old, new, missed.is_embedded)


def _bushes(tableau: Tableau, order: int) -> Iterator[Tree]:
    """The trees of orders from 3 on whose branches are leaves, of one colour each."""
    for l, colour in enumerate(tableau.colours):
        m = next((m for m in range(tableau.size) if tableau.block(l, m) is not None), None)
        if m is not None and not colour.is_linear:
            yield from (Tree(l, (Tree(m),) * (k - 1)) for k in range(3, order + 1))


def _is_hopeless(tableau: Tableau, trees: Sequence[Tree], far: fmpq) -> bool:
    """Whether a condition is missed by more than ``far``; never where ``far`` is 0."""
    return bool(far) and any(not within(x.residual, far) for x in conditions(tableau, trees))


def named_block(tableau: Tableau, edge: Edge) -> Edge:
    """The edge named after the first colour that has these stages: one name for each block."""
    l, m = edge
    spaces = [colour.space for colour in tableau.colours]
    return spaces.index(spaces[l]), m


def named_blocks(tableau: Tableau) -> list[Edge]:
    """The names of all blocks, in order."""
    return sorted({named_block(tableau, edge) for edge in tableau.edges()})


def _size(number: Number) -> float:
    """|number|, to compare by: the choice is then verified exactly."""
    return float(abs(to_ball(number, 20)))


def count_entries(method: Tableau, missed: Missed) -> int:
    """How many entries may be wrong."""
    return sum(1 for _ in _entries(method, missed.is_embedded, missed.keeps_shape))


def _entries(method: Tableau, only_weights: bool, keeps_shape: bool) -> Iterator[Entry]:
    """The entries that are entries of stages: those of stage spaces of points."""
    for l, m in [] if only_weights else named_blocks(method):
        if not (_has_points(method, l) and _has_points(method, m)):
            continue
        block = method.blocks[method.colours[l].space, m]
        reach = _reach(block) if keeps_shape else len(block[0])
        for i, row in enumerate(block):
            for j, old in enumerate(row[: max(i + reach, 0)]):
                yield Entry(l, m, i, j, old)
    for l, colour in enumerate(method.colours):
        if not _has_points(method, l):
            continue
        for j, old in enumerate(colour.b):
            yield Entry(l, None, None, j, old)


def _reach(block: Matrix) -> int:
    """How many entries of its first row a block has for its shape, row i then i − 1 more: 0 of a
    strictly lower triangular one, 1 of a lower triangular one, all of a full one.
    """
    for reach in (0, 1):
        if not any(any(row[i + reach :]) for i, row in enumerate(block)):
            return reach
    return len(block[0])


def _has_points(method: Tableau, l: int) -> bool:
    return isinstance(method.space(l), PointSpace)


def _solution(
    method: Tableau, missed: Missed, entry: Entry, failing: Sequence[Condition]
) -> Number | None:
    """The value with which a failing condition holds; None where none depends on the entry.

    Of exact coefficients only conditions that are linear in the entry are solved, by their values
    at the entry and one beyond; of rounded ones all by a few steps of a simplified Newton's method,
    as a misprint is a small change.
    """
    step = missed.near if missed.near else ONE
    trees = [condition.tree for condition in failing]
    beyond = _weights(missed, entry.put(method, entry.old + step), trees)
    if beyond is None:
        return None
    slopes: list[Number] = []
    for moved, condition in zip(beyond, failing, strict=True):
        slopes.append((moved - condition.value) / step)
    sizes = [_size(slope) for slope in slopes]
    best = sizes.index(max(sizes))
    condition, slope = failing[best], slopes[best]
    if not slope:
        return None
    value = entry.old - condition.residual / slope
    if missed.near:
        # the root of a condition near ``value``
        grid = missed.near / 100
        for _ in range(NEWTON_STEPS):
            if isinstance(value, fmpq):
                value = (value / grid).floor() * grid
            weights = _weights(missed, entry.put(method, value), [condition.tree])
            if weights is None:
                break
            value = value - (weights[0] - condition.required) / slope
        return value
    twice = _weights(missed, entry.put(method, entry.old + step + step), [condition.tree])
    if twice is None:
        return None
    is_linear = twice[0] - beyond[best] == slope
    return value if is_linear else None


def _weights(missed: Missed, method: Tableau, trees: Sequence[Tree]) -> list[Number] | None:
    """The elementary weights of some trees, as printed; None where the changed method has none."""
    try:
        made = printed(derived(method, missed.which))
    except ZeroWeight:
        return None
    return [condition.value for condition in conditions(made, trees)]


def _with_value(row: Vector, j: int, value: Number) -> Vector:
    changed = list(row)
    changed[j] = value
    return tuple(changed)


class Blame(Frozen):
    """What the conditions of the first failing order tell.

    Attributes:
        order: the first failing order.
        failing: how many conditions of it fail.
        total: how many there are.
        in_every: the blocks (l, m) that take part in every failing condition.
        in_none: the blocks that take part in none.
        culprit: among ``in_every``, the block whose conditions fail most often; None where there is
            none, or where several are equally likely.
        only_coupling: whether every failing condition mixes colours, so that the diagonal methods
            are right.
        repairs: single entries of the method that restore the claimed order.
        of: the claim that is missed, as it is called in a file.
        names: the colours of the tableau whose conditions fail.
        tolerance: what coefficients are rounded by; 0 where they are exact.
        restores: other claims that fail, and hold with the first of ``repairs``: consequences of
            the same fault.
        restored: the order with each of the repairs where none is claimed; None where one is.
    """

    order: int
    failing: int
    total: int
    in_every: tuple[Edge, ...]
    in_none: tuple[Edge, ...]
    culprit: Edge | None
    only_coupling: bool
    repairs: tuple[Repair, ...]
    of: str = "order"
    names: tuple[str, ...] = ()
    tolerance: fmpq = ZERO
    restores: tuple[str, ...] = ()
    restored: int | None = None


@doing("what is to blame")
def blame_of(
    method: Tableau, missed: Missed, known: tuple[Repair, ...] | None = None
) -> Blame | None:
    """Look at all conditions of the first failing order of a method, its conjugate or their pair.

    Args:
        method: the tableau whose entries may be wrong.
        missed: what it was meant to have.
        known: its repairs, where they are known.

    Returns:
        None where there are more than ``MAX_CONDITIONS`` conditions.
    """
    judged = missed.judged(method)
    tableau = printed(judged)
    if count_conditions(tableau, missed.order) > MAX_CONDITIONS:
        return None
    of_order = list(all_conditions(judged, missed.order))
    missing = [condition for condition in of_order if not condition.holds]
    # what rounding explains alone says nothing of an entry, but where all is explained so
    failing = [x for x in missing if not within(x.residual, x.allowed)] or missing
    failed = {x.tree for x in failing}
    used = [_blocks_in(tableau, condition.tree) for condition in failing]
    in_every: list[Edge] = []
    in_none: list[Edge] = []
    for block in named_blocks(tableau):
        uses = sum(block in blocks for blocks in used)
        if uses == 0:
            in_none.append(block)
        elif uses == len(used):
            in_every.append(block)
    # the candidate whose conditions fail most often; None where several do alike
    share: dict[Edge, float] = {}
    for block in in_every:
        with_block = [x for x in of_order if block in _blocks_in(tableau, x.tree)]
        share[block] = sum(x.tree in failed for x in with_block) / len(with_block)
    most = max(share.values(), default=0.0)
    best = [block for block in in_every if share[block] == most]
    culprit = best[0] if len(best) == 1 else None
    return Blame(
        order=missed.order,
        failing=len(failing),
        total=len(of_order),
        in_every=tuple(in_every),
        in_none=tuple(in_none),
        culprit=culprit,
        only_coupling=all(condition.is_coupling for condition in failing),
        repairs=tuple(repairs(method, missed, failing)) if known is None else known,
        of=missed.of,
        names=tuple(colour.name for colour in tableau.colours),
        tolerance=missed.tolerance,
    )


@doing("which entry is wrong")
def slip_of(method: Tableau, missed: Missed, found: AnyOrder) -> Blame | None:
    """Which single entry costs a method of which no order is claimed several orders.

    One entry has one value, so that it satisfies a condition by chance, but hardly all of two
    orders. Where the nodes are printed, one order is enough for an entry whose row then sums to its
    node.

    Args:
        method: the tableau whose entries may be wrong.
        missed: how conditions are judged; its orders are not looked at.
        found: the order of the method, judged so.

    Returns:
        None where there is no such entry, or where looking takes long.
    """
    order = found.order
    missed = replace(missed, order=order + 1, claimed=order + 1, keeps_shape=True)
    most = FEW_ROUNDED if missed.near else FEW_ENTRIES
    is_much = count_entries(method, missed) > most
    if found.witness is None or order > HIGHEST_LOW or is_much:
        return None
    if count_conditions(method, order + 1) > FEW_CONDITIONS_UNASKED:
        return None
    # of exact coefficients one condition is enough, and most methods have no such entry
    judged = missed.judged(method)
    if missed.near:
        failing = [x for x in all_conditions(judged, order + 1) if not x.holds]
    else:
        failing = [*conditions(judged, [found.witness.tree])]
    reached: dict[Repair, int] = {}
    for repair in repairs(method, missed, failing):
        changed = missed.restored(repair.carried_out(method))
        assert changed is not None  # as it is a repair
        restored = order_of(changed).order
        if restored >= order + (1 if _fits_node(method, missed, repair) else GAIN):
            reached[repair] = restored
    if not reached:
        return None
    restored = max(reached.values())
    best = tuple(repair for repair in reached if reached[repair] == restored)
    blame = blame_of(method, missed, best)
    return blame and replace(blame, restored=restored)


def _fits_node(method: Tableau, missed: Missed, repair: Repair) -> bool:
    """Whether the row of an entry sums to its node when it is changed, and does not as it is."""
    if repair.m is None or repair.i is None:
        return False
    row = method.blocks[method.colours[repair.l].space, repair.m][repair.i]
    off = sum(row, ZERO) - method.colours[repair.l].c[repair.i]
    near = missed.near
    return not within(off, near) and within(off + repair.new - repair.old, near)


def _blocks_in(tableau: Tableau, tree: Tree) -> Counter[Edge]:
    """The blocks that the elementary weight of ``tree`` multiplies by, with how often."""
    return Counter(
        named_block(tableau, (vertex.root, branch.root))
        for vertex in tree.vertices()
        for branch in vertex.branches
    )
