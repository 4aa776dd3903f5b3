"""Which block is to blame for a failing order.

It is a hint drawn from the failing conditions, never a fact about what a source meant to print.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.doing import doing
from garkcli.exact.field import ZERO
from garkcli.order.conditions import Condition
from garkcli.order.listing import all_conditions, count_conditions
from garkcli.order.repairs import Missed, Repair, named_block, named_blocks, repairs
from garkcli.tableau.meant import printed
from garkcli.tableau.tableau import Edge, Tableau
from garkcli.trees.tree import Tree

MAX_CONDITIONS = 20_000
"""Most conditions that are evaluated to find a culprit."""


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
        repairs: single entries of the method that restore the claimed order.
        of: the claim that is missed, as it is called in a file.
        names: the colours of the tableau whose conditions fail.
        tolerance: what coefficients are rounded by; 0 where they are exact.
        restores: other claims that fail, and hold with the first of ``repairs``: consequences of
            the same fault.
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


def find_blame(tableau: Tableau, order: int, claimed: int) -> Blame | None:
    """Look at all conditions of ``order``, the first failing one, of exact coefficients.

    Args:
        tableau: the tableau.
        order: its exact order plus one.
        claimed: the order it was meant to have.

    Returns:
        None where there are more than ``MAX_CONDITIONS`` conditions.
    """
    return blame_of(tableau, Missed(order, claimed))


@doing("what is to blame")
def blame_of(method: Tableau, missed: Missed) -> Blame | None:
    """Look at all conditions of the first failing order of a method, its conjugate or their pair.

    Args:
        method: the tableau whose entries may be wrong.
        missed: what it was meant to have.

    Returns:
        None where there are more than ``MAX_CONDITIONS`` conditions.
    """
    judged = missed.judged(method)
    tableau = printed(judged)
    if count_conditions(tableau, missed.order) > MAX_CONDITIONS:
        return None
    found = list(all_conditions(judged, missed.order))
    failing = [condition for condition in found if not condition.holds]
    used = [_blocks_in(tableau, condition.tree) for condition in failing]
    in_every: list[Edge] = []
    in_none: list[Edge] = []
    for block in named_blocks(tableau):
        uses = sum(block in blocks for blocks in used)
        if uses == 0:
            in_none.append(block)
        elif uses == len(used):
            in_every.append(block)
    return Blame(
        order=missed.order,
        failing=len(failing),
        total=len(found),
        in_every=tuple(in_every),
        in_none=tuple(in_none),
        culprit=_culprit(tableau, found, in_every),
        only_coupling=all(condition.is_coupling for condition in failing),
        repairs=tuple(repairs(method, missed, failing)),
        of=missed.of,
        names=tuple(colour.name for colour in tableau.colours),
        tolerance=missed.tolerance,
    )


def _blocks_in(tableau: Tableau, tree: Tree) -> Counter[Edge]:
    """The blocks that the elementary weight of ``tree`` multiplies by, with how often."""
    return Counter(
        named_block(tableau, (vertex.root, branch.root))
        for vertex in tree.vertices()
        for branch in vertex.branches
    )


def _culprit(tableau: Tableau, found: list[Condition], candidates: Sequence[Edge]) -> Edge | None:
    """The candidate whose conditions fail most often; None where several do alike."""
    share: dict[Edge, float] = {}
    for block in candidates:
        with_block = [x for x in found if block in _blocks_in(tableau, x.tree)]
        failing = [x for x in with_block if not x.holds]
        share[block] = len(failing) / len(with_block)
    most = max(share.values(), default=0.0)
    best = [block for block in candidates if share[block] == most]
    if len(best) != 1:
        return None
    return best[0]
