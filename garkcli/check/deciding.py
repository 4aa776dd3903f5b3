"""From a tableau to its analysis, exactly or within the tolerance of its file."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.analysis import (
    Analysis,
    Units,
    conjugate_and_pair,
    inconsistent_blocks,
    is_pair_of_itself,
    nonautonomous,
)
from garkcli.doing import doing
from garkcli.frozen import replace
from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import meant, printed
from garkcli.order.simplifying import Simplifying, is_symplectic, simplifying
from garkcli.order.tolerance import TINY, within
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.order.suggestion import Misprint, Suggestion


def analyse(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    units: Units | None = None,
    further: Further = NOTHING,
) -> Analysis:
    """Decide everything that ``gark check`` reports; up to the order ``limit``.

    Args:
        tableau: the method.
        limit: where the search for orders stops.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
        units: by how much each printed value may be off, where its digits are known; asked for only
            where residuals look like rounding.
        further: its embedded weights and its dense output.
    """
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if further and method is tableau else None
    order = order_of(method, limit, spans)
    conjugated, both, obstacle = conjugate_and_pair(method)
    conjugate_order = None
    if conjugated is not None:
        with doing("conjugate"):
            conjugate_order = order_of(conjugated, limit)
    is_own_pair = both is None or is_pair_of_itself(method, both)
    pair_order, pair_conditions = None, None
    if both is not None and not is_own_pair:
        with doing("pair"):
            pair_order = order_of(both, limit)
    # all orders of a rounded method come first: each tells more of the method that it means
    if method is not tableau and order.is_lower_bound:
        order = order_of(method, limit)
    inconsistent = inconsistent_blocks(method)
    conditions = simplifying(method, limit)
    if both is not None and not is_own_pair:
        with doing("pair"):
            pair_conditions = simplifying(both, limit)
    conjugate_inconsistent = inconsistent_blocks(conjugated)
    symplectic = is_symplectic(method)
    misprint, suggestion = None, None
    if isinstance(method, Tableau):
        suggestion = _suggestion(method, order, limit)
        misprint = _misprint(tableau, order, suggestion, units)
    elif units:
        from garkcli.order.suggestion import misprint_within, suggest_wider  # balls

        suggestion = suggest_wider(method, order, units(), limit)
        misprint = None if suggestion else misprint_within(method, order, limit)
    if both is not None and pair_conditions is None:
        pair_order, pair_conditions = order, conditions
    found = Analysis(
        tableau=tableau,
        order=order,
        simplifying=conditions,
        inconsistent=inconsistent,
        symplectic=symplectic,
        conjugate=None if conjugated is None else printed(conjugated),
        conjugate_order=conjugate_order,
        conjugate_inconsistent=conjugate_inconsistent,
        pair=None if both is None else printed(both),
        pair_order=pair_order,
        pair_simplifying=pair_conditions,
        bound=min(conditions.bound, order.order),
        pair_bound=_capped(pair_conditions, pair_order, lambda x: x.bound),
        sharp_bound=min(conditions.sharp_bound, order.order),
        pair_sharp_bound=_capped(pair_conditions, pair_order, lambda x: x.sharp_bound),
        obstacle=obstacle,
        limit=limit,
        tolerance=tolerance,
        nonautonomous_order=nonautonomous(method, order, inconsistent, limit),
        suggestion=None if misprint else suggestion,
        misprint=misprint,
    )
    if not further:
        return found
    from garkcli.check.further import further_facts  # few files have them

    embedded, dense = further_facts(method, further, order, inconsistent, limit, spans)
    return replace(found, embedded=embedded, dense=dense, further=further)


def looks_rounded(method: MethodFile) -> Suggestion | None:
    """The tolerance that a file lacks; None where it has one, or is exact, or has a misprint."""
    if method.tolerance is not None:
        return None
    from garkcli.methodfile.printed import printed_units  # every check may do without

    units = printed_units(method.printed)
    if not any(units.values()):
        return None
    order = order_of(method.tableau)
    found = _suggestion(method.tableau, order, DEFAULT_LIMIT)
    return None if _misprint(method.tableau, order, found, lambda: units) else found


def _capped(
    conditions: Simplifying | None, order: AnyOrder | None, bound: Callable[[Simplifying], int]
) -> int | None:
    """A bound, as far as the order bears it out: within a tolerance it may not."""
    return None if conditions is None or order is None else min(bound(conditions), order.order)


def _misprint(
    tableau: Tableau, order: AnyOrder, suggestion: Suggestion | None, units: Units | None
) -> Misprint | None:
    """The one printed value that does not fit the others, where there is one."""
    if suggestion is None or units is None or not isinstance(order, Order):
        return None
    from garkcli.order.suggestion import find_misprint

    return find_misprint(tableau, order, suggestion, units())


def _suggestion(tableau: Tableau, order: AnyOrder, limit: int) -> Suggestion | None:
    """What to write into a file that looks rounded; only tiny residuals are examined further."""
    spelled_out = any(isinstance(space, PointSpace) for space in tableau.spaces)
    if not spelled_out or order.witness is None or not isinstance(order, Order):
        return None
    if not within(order.witness.residual, TINY):
        return None
    from garkcli.order.suggestion import suggest_tolerance

    return suggest_tolerance(tableau, order, limit)
