"""From a tableau to its analysis, exactly or within the tolerance of its file."""

from __future__ import annotations

from dataclasses import replace
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
from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans, find_order
from garkcli.order.simplifying import simplifying
from garkcli.order.tolerance import TINY, within
from garkcli.tableau.conjugate import is_symplectic
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.suggestion import Misprint, Suggestion


def analyse(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    units: Units | None = None,
    further: Further = NOTHING,
) -> Analysis:
    """Decide everything that ``gark check`` reports; no order beyond ``limit`` is looked for.

    Args:
        tableau: the method.
        limit: where the search for orders stops.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
        units: by how much each printed value may be off, where its digits are known; asked for only
            where residuals look like rounding.
        further: its embedded weights and its dense output.
    """
    spans = StageSpans(tableau) if further else None
    if tolerance is None:
        found = _analyse_exactly(tableau, limit, units, spans)
    else:
        # balls, which exact methods do without
        from garkcli.check.within import analyse_within

        found = analyse_within(tableau, tolerance, limit)
    if not further:
        return found
    from garkcli.check.further import further_facts  # few files have them

    facts = further_facts(
        tableau, further, found.order, found.inconsistent, limit, tolerance, spans
    )
    return replace(found, embedded=facts.embedded, dense=facts.dense)


def _analyse_exactly(
    tableau: Tableau, limit: int, units: Units | None, spans: StageSpans | None
) -> Analysis:
    conjugated, both, obstacle = conjugate_and_pair(tableau)
    order = find_order(tableau, limit, spans)
    conditions = simplifying(tableau, limit)
    conjugate_order = None
    if conjugated is not None:
        with doing("conjugate"):
            conjugate_order = find_order(conjugated, limit)
    pair_order, pair_conditions = None, None
    pair_bound, pair_sharp_bound = None, None
    if both is not None and is_pair_of_itself(tableau, both):
        pair_order, pair_conditions = order, conditions
    elif both is not None:
        with doing("pair"):
            pair_order = find_order(both, limit)
            pair_conditions = simplifying(both, limit)
    if pair_conditions is not None:
        pair_bound = pair_conditions.bound
        pair_sharp_bound = pair_conditions.sharp_bound
    inconsistent = inconsistent_blocks(tableau)
    suggestion = _suggestion(tableau, order, limit)
    misprint = _misprint(tableau, order, suggestion, units)
    timed_order = nonautonomous(
        tableau, order, inconsistent, lambda timed: find_order(timed, limit)
    )
    return Analysis(
        tableau=tableau,
        order=order,
        simplifying=conditions,
        inconsistent=inconsistent,
        symplectic=is_symplectic(tableau),
        conjugate=conjugated,
        conjugate_order=conjugate_order,
        conjugate_inconsistent=inconsistent_blocks(conjugated),
        pair=both,
        pair_order=pair_order,
        pair_simplifying=pair_conditions,
        bound=conditions.bound,
        pair_bound=pair_bound,
        sharp_bound=conditions.sharp_bound,
        pair_sharp_bound=pair_sharp_bound,
        obstacle=obstacle,
        limit=limit,
        nonautonomous_order=timed_order,
        suggestion=None if misprint else suggestion,
        misprint=misprint,
    )


def _misprint(
    tableau: Tableau, order: Order, suggestion: Suggestion | None, units: Units | None
) -> Misprint | None:
    """The one printed value that does not fit the others, where there is one."""
    if suggestion is None or units is None:
        return None
    from garkcli.order.suggestion import find_misprint

    return find_misprint(tableau, order, suggestion, units())


def _suggestion(tableau: Tableau, order: Order, limit: int) -> Suggestion | None:
    """What to write into a file that looks rounded; only tiny residuals are looked at further."""
    spelled_out = any(isinstance(space, PointSpace) for space in tableau.spaces)
    if not spelled_out or order.witness is None:
        return None
    if not within(order.witness.residual, TINY):
        return None
    from garkcli.order.suggestion import suggest_tolerance

    return suggest_tolerance(tableau, order, limit)
