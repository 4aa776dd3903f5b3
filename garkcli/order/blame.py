"""Which block is to blame for a failing order, and which single entry, changed, would restore it.

Both are hints drawn from the failing conditions, never facts about what a source meant to print.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import Matrix
from garkcli.order.certificate import find_order
from garkcli.order.conditions import Condition, elementary_weight
from garkcli.order.listing import all_conditions, count_conditions
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree

MAX_CONDITIONS = 20_000
"""Most conditions that are evaluated to find a culprit."""
MAX_ENTRIES = 2_000
"""Most entries that are tried."""


@dataclass(frozen=True)
class Repair:
    """An entry that restores the claimed order when it is changed alone.

    ``l, m`` are the block's colours, or ``m`` is None for the weights b^{l}; ``i, j`` the entry
    (``j`` of the weights; then ``i`` is None). All count from 0.
    """

    l: int
    m: int | None
    i: int | None
    j: int
    old: Number
    new: Number


@dataclass(frozen=True)
class Blame:
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
        repairs: single entries that restore the claimed order.
    """

    order: int
    failing: int
    total: int
    in_every: tuple[tuple[int, int], ...]
    in_none: tuple[tuple[int, int], ...]
    culprit: tuple[int, int] | None
    only_coupling: bool
    repairs: tuple[Repair, ...]


def find_blame(tableau: Tableau, order: int, claimed: int) -> Blame | None:
    """Look at all conditions of ``order``, the first failing one.

    Args:
        tableau: the tableau.
        order: its exact order plus one.
        claimed: the order it was meant to have.

    Returns:
        None where there are more than ``MAX_CONDITIONS`` conditions.
    """
    if count_conditions(tableau, order) > MAX_CONDITIONS:
        return None
    found = list(all_conditions(tableau, order))
    failing = [condition for condition in found if not condition.holds]
    used = [_blocks_in(tableau, condition.tree) for condition in failing]
    blocks = sorted({_canonical(tableau, edge) for edge in tableau.edges()})
    in_every = tuple(block for block in blocks if all(block in use for use in used))
    return Blame(
        order=order,
        failing=len(failing),
        total=len(found),
        in_every=in_every,
        in_none=tuple(block for block in blocks if not any(block in use for use in used)),
        culprit=_culprit(tableau, found, in_every),
        only_coupling=all(condition.is_coupling for condition in failing),
        repairs=tuple(_repairs(tableau, failing, claimed)),
    )


def _canonical(tableau: Tableau, edge: tuple[int, int]) -> tuple[int, int]:
    """The edge named after the first colour that has these stages: one name for each block."""
    rows = tableau.colours[edge[0]].space
    first = next(l for l, colour in enumerate(tableau.colours) if colour.space == rows)
    return first, edge[1]


def _blocks_in(tableau: Tableau, tree: Tree) -> Counter[tuple[int, int]]:
    """The blocks that the elementary weight of ``tree`` multiplies by, with how often."""
    return Counter(
        _canonical(tableau, (vertex.root, branch.root))
        for vertex in tree.vertices()
        for branch in vertex.branches
    )


def _culprit(
    tableau: Tableau, found: list[Condition], candidates: tuple[tuple[int, int], ...]
) -> tuple[int, int] | None:
    share: dict[tuple[int, int], float] = {}
    for block in candidates:
        with_block = [x for x in found if block in _blocks_in(tableau, x.tree)]
        share[block] = sum(not x.holds for x in with_block) / len(with_block)
    best = [block for block in candidates if share[block] == max(share.values())]
    return best[0] if len(best) == 1 else None


def _repairs(tableau: Tableau, failing: list[Condition], claimed: int) -> Iterator[Repair]:
    """Entries whose change restores ``claimed``: each must solve a failing condition it occurs in
    once.
    """
    tried = 0
    for condition in sorted(failing, key=lambda x: x.tree.order)[:1]:
        for repair, changed in _solved(tableau, condition):
            tried += 1
            if tried > MAX_ENTRIES:
                return
            if find_order(changed, claimed).order >= claimed:
                yield repair


def _solved(tableau: Tableau, condition: Condition) -> Iterator[tuple[Repair, Tableau]]:
    """Each entry that occurs linearly in ``condition``, changed such that the condition holds."""
    counts = _blocks_in(tableau, condition.tree)
    for (l, m), count in counts.items():
        k = tableau.colours[l].space
        pointwise = isinstance(tableau.spaces[k], PointSpace) and isinstance(
            tableau.space(m), PointSpace
        )
        block = tableau.blocks[k, m]
        for i, row in enumerate(block if pointwise and count == 1 else ()):
            for j, old in enumerate(row):
                shifted = _with_entry(tableau, (k, m), i, j, old + ONE)
                new = _root(condition, old, elementary_weight(shifted, condition.tree))
                if new is not None:
                    yield Repair(l, m, i, j, old, new), _with_entry(tableau, (k, m), i, j, new)
    root = condition.tree.root
    b = tableau.colours[root].b
    for j, old in enumerate(b if isinstance(tableau.space(root), PointSpace) else ()):
        shifted = _with_weight(tableau, root, j, old + ONE)
        new = _root(condition, old, elementary_weight(shifted, condition.tree))
        if new is not None:
            yield Repair(root, None, None, j, old, new), _with_weight(tableau, root, j, new)


def _root(condition: Condition, old: Number, shifted: Number) -> Number | None:
    """Where the condition, linear in the entry, vanishes: from its values at the entry and one
    beyond.
    """
    slope = shifted - condition.value
    return old - condition.residual / slope if slope else None


def _with_entry(tableau: Tableau, key: tuple[int, int], i: int, j: int, value: Number) -> Tableau:
    block: list[list[Number]] = [list(row) for row in tableau.blocks[key]]
    block[i][j] = value
    changed: Matrix = tuple(tuple(row) for row in block)
    return replace(tableau, blocks={**tableau.blocks, key: changed})


def _with_weight(tableau: Tableau, l: int, j: int, value: Number) -> Tableau:
    """b^{l} changed, together with the weights that are the same row: those of colours with these
    stages.
    """
    old = tableau.colours[l]
    b = (*old.b[:j], value, *old.b[j + 1 :])
    colours = (
        replace(x, b=b) if (x.space, x.b) == (old.space, old.b) else x for x in tableau.colours
    )
    return replace(tableau, colours=tuple(colours))
