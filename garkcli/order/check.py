"""Everything known about one method, as one value: what ``gark check`` reports."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.errors import ZeroWeight
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.order.simplifying import Simplifying, consistent_blocks, simplifying
from garkcli.tableau.conjugate import conjugate, is_symplectic
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Analysis:
    """The truth about a tableau, its symplectic conjugate, and their pair.

    Attributes:
        tableau: the method.
        order: its exact order with a witness.
        simplifying: B, C, D and the paper's bound.
        inconsistent: the blocks with A^{l,m} 𝟙 ≠ c^{l}, as (l, m) counted from 0.
        symplectic: whether it is its own conjugate; for a partitioned tableau, whether its two parts are.
        conjugate: the conjugate, or None where a weight is zero; then ``obstacle`` says which.
        conjugate_order: the exact order of the conjugate.
        conjugate_inconsistent: the blocks with Â^{l,m} 𝟙 ≠ c^{l}.
        pair: the symplectic pair with 2N colours, or None.
        pair_order: the exact order of the pair.
        pair_simplifying: B, C, D and the bound for the pair.
        obstacle: why there is no conjugate; empty where there is one.
        limit: where the search for orders stopped.
    """

    tableau: Tableau
    order: Order
    simplifying: Simplifying
    inconsistent: tuple[tuple[int, int], ...]
    symplectic: bool
    conjugate: Tableau | None
    conjugate_order: Order | None
    conjugate_inconsistent: tuple[tuple[int, int], ...]
    pair: Tableau | None
    pair_order: Order | None
    pair_simplifying: Simplifying | None
    obstacle: str
    limit: int


def analyse(tableau: Tableau, limit: int = DEFAULT_LIMIT) -> Analysis:
    """Decide everything that ``gark check`` reports, exactly; no order beyond ``limit`` is looked for."""
    conjugated, both, obstacle = None, None, ""
    try:
        conjugated = conjugate(tableau)
    except ZeroWeight as error:
        obstacle = error.message
    try:
        both = pair(tableau)
    except ZeroWeight as error:
        obstacle = error.message
    same = both is not None and tableau.is_partitioned and both.blocks == tableau.blocks
    order, conditions = find_order(tableau, limit), simplifying(tableau, limit)
    pair_order = pair_conditions = None
    if both is not None:
        pair_order = order if same else find_order(both, limit)
        pair_conditions = conditions if same else simplifying(both, limit)
    return Analysis(
        tableau=tableau,
        order=order,
        simplifying=conditions,
        inconsistent=_inconsistent(tableau),
        symplectic=is_symplectic(tableau),
        conjugate=conjugated,
        conjugate_order=find_order(conjugated, limit) if conjugated is not None else None,
        conjugate_inconsistent=_inconsistent(conjugated) if conjugated is not None else (),
        pair=both,
        pair_order=pair_order,
        pair_simplifying=pair_conditions,
        obstacle=obstacle,
        limit=limit,
    )


def _inconsistent(tableau: Tableau) -> tuple[tuple[int, int], ...]:
    return tuple(edge for edge, holds in consistent_blocks(tableau).items() if not holds)
