"""Everything known about one method, as one value: what ``gark check`` reports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias, Union

from flint import fmpq

from garkcli.errors import ZeroWeight
from garkcli.exact.field import ZERO
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.order.closeness import within
from garkcli.order.defects import is_symplectic_within
from garkcli.order.simplifying import Simplifying, consistent_blocks, simplifying
from garkcli.tableau.conjugate import conjugate, is_symplectic
from garkcli.tableau.forms import pair
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedOrder
    from garkcli.order.suggestion import Suggestion

AnyOrder: TypeAlias = Union[Order, "RoundedOrder"]
"""An order found exactly, or within a tolerance: both have ``order``, ``witness`` and
``is_lower_bound``.
"""


@dataclass(frozen=True)
class Analysis:
    """The truth about a tableau, its symplectic conjugate, and their pair.

    Attributes:
        tableau: the method.
        order: its exact order with a witness.
        simplifying: B, C, D and the paper's bound.
        inconsistent: the blocks with A^{l,m} 𝟙 ≠ c^{l}, as (l, m) counted from 0.
        symplectic: whether it is its own conjugate; for a partitioned tableau, whether its two
            parts are.
        conjugate: the conjugate, or None where a weight is zero; then ``obstacle`` says which.
        conjugate_order: the exact order of the conjugate.
        conjugate_inconsistent: the blocks with Â^{l,m} 𝟙 ≠ c^{l}.
        pair: the symplectic pair with 2N colours, or None.
        pair_order: the exact order of the pair.
        pair_simplifying: B, C, D and the bound for the pair.
        obstacle: why there is no conjugate; empty where there is one.
        limit: where the search for orders stopped.
        tolerance: the rounding within which all of this holds; None where it holds exactly.
        suggestion: for a method that is exact by its word, the tolerance that its residuals
            suggest.
    """

    tableau: Tableau
    order: AnyOrder
    simplifying: Simplifying
    inconsistent: tuple[tuple[int, int], ...]
    symplectic: bool
    conjugate: Tableau | None
    conjugate_order: AnyOrder | None
    conjugate_inconsistent: tuple[tuple[int, int], ...]
    pair: Tableau | None
    pair_order: AnyOrder | None
    pair_simplifying: Simplifying | None
    obstacle: str
    limit: int
    tolerance: fmpq | None = None
    suggestion: Suggestion | None = None


def analyse(
    tableau: Tableau, limit: int = DEFAULT_LIMIT, tolerance: fmpq | None = None
) -> Analysis:
    """Decide everything that ``gark check`` reports; no order beyond ``limit`` is looked for.

    Args:
        tableau: the method.
        limit: where the search for orders stops.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
    """
    near = ZERO if tolerance is None else tolerance
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
    order, conditions = _order(tableau, limit, tolerance), simplifying(tableau, limit, near)
    pair_order = pair_conditions = None
    if both is not None:
        pair_order = order if same else _order(both, limit, tolerance)
        pair_conditions = conditions if same else simplifying(both, limit, near)
    return Analysis(
        tableau=tableau,
        order=order,
        simplifying=conditions,
        inconsistent=_inconsistent(tableau, near),
        symplectic=is_symplectic(tableau)
        if tolerance is None
        else is_symplectic_within(tableau, near),
        conjugate=conjugated,
        conjugate_order=_order(conjugated, limit, tolerance) if conjugated is not None else None,
        conjugate_inconsistent=_inconsistent(conjugated, near) if conjugated is not None else (),
        pair=both,
        pair_order=pair_order,
        pair_simplifying=pair_conditions,
        obstacle=obstacle,
        limit=limit,
        tolerance=tolerance,
        suggestion=_suggestion(tableau, order, limit) if tolerance is None else None,
    )


def _order(tableau: Tableau, limit: int, tolerance: fmpq | None) -> AnyOrder:
    if tolerance is None:
        return find_order(tableau, limit)
    from garkcli.order.rounded import find_order_within

    return find_order_within(tableau, tolerance, limit)


def _inconsistent(tableau: Tableau, tolerance: fmpq) -> tuple[tuple[int, int], ...]:
    return tuple(edge for edge, holds in consistent_blocks(tableau, tolerance).items() if not holds)


def _suggestion(tableau: Tableau, order: AnyOrder, limit: int) -> Suggestion | None:
    """What to write into a file that looks rounded; only tiny residuals are looked at further."""
    spelled_out = any(isinstance(space, PointSpace) for space in tableau.spaces)
    if not spelled_out or not isinstance(order, Order) or order.witness is None:
        return None
    if not within(order.witness.residual, fmpq(1, 10**6)):
        return None
    from garkcli.order.suggestion import suggest_tolerance

    return suggest_tolerance(tableau, order, limit)
