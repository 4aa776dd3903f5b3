"""Finds the block behind a failing order, and a single entry whose change would restore it.

Both are hints drawn from the failing conditions, never facts about what a source meant to print.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from flint import fmpq

from garkcli.doing import doing
from garkcli.errors import ZeroWeight
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import count_conditions
from garkcli.order.conditions import Condition, all_conditions, conditions
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, derived, printed, tolerance_of
from garkcli.order.repair import GAIN, HIGHEST_LOW, Repair, RepairedEntry
from garkcli.order.tolerance import within
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

MAX_CONDITIONS = 20_000
MAX_ENTRIES = 2_000
FEW_CHECKED = 20
NEAR = 10
"""Largest distance of a row sum from its node, in tolerances: the rounding of all entries."""
FEW_ENTRIES = 400
FEW_CONDITIONS_UNASKED = 2_000


class MissedOrder(Frozen):
    """A claimed order that the method misses; ``order`` is the first failing one, ``of`` the claim.

    With ``is_embedded`` it is about embedded weights, which alone may be wrong if they are exact.
    With ``keeps_shape`` zeros outside the pattern of a block, as on the diagonal of an explicit
    method, are right.
    """

    order: int
    claimed: int
    of: str = "order"
    is_embedded: bool = False
    keeps_shape: bool = False

    def made_of(self, method: Tableau) -> Tableau | None:
        try:
            return printed(derived(method, self.of))
        except ZeroWeight:
            return None


def repairs(
    method: AnyTableau, missed: MissedOrder, failing: Sequence[Condition]
) -> Iterator[Repair]:
    """Single entries that restore the claimed order; exact ones solve a failing condition."""
    if not isinstance(method, Tableau):
        from garkcli.order.suspects import suspects  # slopes, which exact methods do without

        judged = derived(method, missed.of)
        assert not isinstance(judged, Tableau)
        yield from suspects(judged, missed.claimed, missed.claimed)
        return
    if not failing:
        return
    few = [condition.tree for condition in failing[:FEW_CHECKED]]
    for tried, entry in enumerate(_entries(method, missed.is_embedded, missed.keeps_shape)):
        if tried >= MAX_ENTRIES:
            return
        new = _solution(method, missed, entry, failing[0])
        changed = None if new is None else missed.made_of(entry.put(method, new))
        if new is None or changed is None:
            continue
        # takes less than the order
        if not all(condition.holds for condition in conditions(changed, few)):
            continue
        if order_of(changed, missed.claimed).order >= missed.claimed:
            yield Repair(entry.l, entry.m, entry.i, entry.j, entry.old, new, missed.is_embedded)


def named_block(tableau: Tableau, edge: Edge) -> Edge:
    """(l, m) with l the first colour that shares its stages: one name for each block."""
    l, m = edge
    spaces = [colour.space for colour in tableau.colours]
    return spaces.index(spaces[l]), m


def named_blocks(tableau: Tableau) -> list[Edge]:
    return sorted({named_block(tableau, edge) for edge in tableau.edges()})


def count_entries(method: Tableau, missed: MissedOrder) -> int:
    return sum(1 for _ in _entries(method, missed.is_embedded, missed.keeps_shape))


def _entries(method: Tableau, only_weights: bool, keeps_shape: bool) -> Iterator[RepairedEntry]:
    for l, m in [] if only_weights else named_blocks(method):
        if not (_has_points(method, l) and _has_points(method, m)):
            continue
        block = method.blocks[method.colours[l].space, m]
        reach = _reach(block) if keeps_shape else len(block[0])
        for i, row in enumerate(block):
            for j, old in enumerate(row[: max(i + reach, 0)]):
                yield RepairedEntry(l, m, i, j, old)
    for l, colour in enumerate(method.colours):
        if not _has_points(method, l):
            continue
        for j, old in enumerate(colour.b):
            yield RepairedEntry(l, None, None, j, old)


def _reach(block: Matrix) -> int:
    """Entries in the first row of a block within its pattern, row i having i − 1 more."""
    for reach in (0, 1):
        if not any(any(row[i + reach :]) for i, row in enumerate(block)):
            return reach
    return len(block[0])


def _has_points(method: Tableau, l: int) -> bool:
    return isinstance(method.space(l), PointSpace)


def _solution(
    method: Tableau, missed: MissedOrder, entry: RepairedEntry, failing: Condition
) -> Number | None:
    """Returns the value at which a failing condition holds; None if constant or not linear."""
    values = [failing.value]
    for step in (ONE, ONE + ONE):
        moved = missed.made_of(entry.put(method, entry.old + step))
        if moved is None:
            return None
        values += [condition.value for condition in conditions(moved, [failing.tree])]
        if values[1] == failing.value:
            return None
    slope = values[1] - values[0]
    is_linear = values[2] - values[1] == slope
    return entry.old - failing.residual / slope if is_linear else None


class Blame(Frozen):
    """The diagnosis of the conditions of the first failing order.

    Attributes:
        in_every, in_none: the blocks (l, m) in every failing condition, and those in none.
        culprit: the block in ``in_every`` whose conditions fail most often; None if not single.
        only_coupling: whether every failing condition mixes colours.
        names: the colours of the tableau whose conditions fail.
        restores: other claims that fail, and hold with the first of ``repairs``.
        restored: without a claimed order, the order with any of the repairs.
        within: the tolerance that a remark proposes for the file, where it is assumed.
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
    restores: tuple[str, ...] = ()
    restored: int | None = None
    within: fmpq | None = None


@doing("the likely cause")
def blame_of(
    method: AnyTableau, missed: MissedOrder, known: tuple[Repair, ...] | None = None
) -> Blame | None:
    """Examines all conditions of the first failing order; None if they are too many. ``method`` has
    the entries that may be wrong, with embedded weights as b if these miss the order; ``known`` are
    its repairs, if known already.
    """
    judged = derived(method, missed.of)
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
    # the candidate whose conditions fail most often; None if several are equal
    share: dict[Edge, float] = {}
    for block in in_every:
        with_block = [x for x in of_order if block in _blocks_in(tableau, x.tree)]
        share[block] = sum(x.tree in failed for x in with_block) / len(with_block)
    found = repairs(method, missed, failing) if known is None else known
    # a row that then sums to its node says more than an entry that was zero
    likely_first = sorted(found, key=lambda x: (not _fits_node(method, x), not x.old))
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
        repairs=tuple(likely_first),
        of=missed.of,
        names=tuple(colour.name for colour in tableau.colours),
    )


@doing("which entry is wrong")
def slip_of(method: AnyTableau, missed: MissedOrder, found: AnyOrder) -> Blame | None:
    """Returns a single entry that costs a method several orders, if no order is claimed; or None.

    Some value of an entry may satisfy a condition by chance, but hardly all of two orders. One
    order is enough for an entry whose row then sums to its printed node.
    """
    order, tableau = found.order, printed(method)
    missed = replace(missed, order=order + 1, claimed=order + 1, keeps_shape=True)
    is_much = count_entries(tableau, missed) > FEW_ENTRIES
    if found.witness is None or order > HIGHEST_LOW or is_much:
        return None
    if count_conditions(tableau, order + 1) > FEW_CONDITIONS_UNASKED:
        return None
    reached = {
        repair: restored
        for repair, restored in _restoring(method, missed, found.witness.tree)
        if restored >= order + (1 if _fits_node(method, repair) else GAIN)
    }
    if not reached:
        return None
    restored = max(reached.values())
    best = tuple(repair for repair in reached if reached[repair] == restored)
    blame = blame_of(method, missed, best)
    return blame and replace(blame, restored=restored)


def _restoring(
    method: AnyTableau, missed: MissedOrder, failing: Tree
) -> Iterator[tuple[Repair, int]]:
    if not isinstance(method, Tableau):
        from garkcli.order.suspects import suspects  # slopes, which exact methods do without

        judged = derived(method, missed.of)
        assert not isinstance(judged, Tableau)
        yield from suspects(judged, missed.claimed).items()
        return
    # one condition is enough, and most methods have no such entry
    for repair in repairs(method, missed, list(conditions(method, [failing]))):
        yield repair, order_of(repair.carried_out(method)).order


def _fits_node(method: AnyTableau, repair: Repair) -> bool:
    if repair.m is None or repair.i is None:
        return False
    tableau, near = printed(method), NEAR * (tolerance_of(method) or ZERO)
    row = tableau.blocks[tableau.colours[repair.l].space, repair.m][repair.i]
    off = sum(row, ZERO) - tableau.colours[repair.l].c[repair.i]
    return not within(off, near) and within(off + repair.new - repair.old, near)


def _blocks_in(tableau: Tableau, tree: Tree) -> Counter[Edge]:
    return Counter(
        named_block(tableau, (vertex.root, branch.root))
        for vertex in tree.vertices()
        for branch in vertex.branches
    )
