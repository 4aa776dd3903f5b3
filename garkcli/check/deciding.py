"""The analysis of a tableau, exactly or within the tolerance of its file."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.analysis import Analysis, conjugate_and_pair, is_pair_of_itself
from garkcli.doing import doing
from garkcli.errors import MethodError
from garkcli.families.family import MAX_STAGES
from garkcli.frozen import replace
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, nonautonomous, order_of
from garkcli.order.meant import meant, printed
from garkcli.order.simplifying import Simplifying, inconsistent_blocks, is_symplectic, simplifying
from garkcli.order.tolerance import TINY, within
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.check.claims import AnyAnalysis
    from garkcli.check.remark import RoundingHint
    from garkcli.methodfile.build import MethodFile
    from garkcli.tableau.garkmethod import GarkMethod


def analyse_any(method: GarkMethod, limit: int = DEFAULT_LIMIT) -> AnyAnalysis:
    """Returns the analysis of a method of any kind; see ``analyse``."""
    return analyse_any_tableau(method.tableau, limit, method.tolerance, method.further)


def analyse_any_tableau(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> AnyAnalysis:
    """Returns the analysis of a tableau of any kind; see ``analyse``."""
    if tableau.is_gark:
        return analyse(tableau, limit, tolerance, further)
    from garkcli.constructions.nprk import is_nprk  # few methods need these
    from garkcli.constructions.nystrom import is_nystrom
    from garkcli.constructions.rosenbrock import is_rosenbrock

    if is_rosenbrock(tableau):
        from garkcli.check.rosenbrock import analyse_rosenbrock  # few methods are

        return analyse_rosenbrock(tableau, limit, tolerance, further)
    if is_nprk(tableau):
        from garkcli.check.nprk import analyse_nprk  # likewise

        return analyse_nprk(tableau, limit, tolerance, further)
    if is_nystrom(tableau):
        from garkcli.check.nystrom import analyse_nystrom  # likewise

        return analyse_nystrom(tableau, limit, tolerance, further)
    if tableau.uses_derivatives:
        from garkcli.check.derivatives import DerivativesAnalysis  # likewise

        return DerivativesAnalysis.with_flow(tableau, limit, tolerance, further)
    from garkcli.check.infinitesimal import InfinitesimalAnalysis  # likewise

    return InfinitesimalAnalysis.with_flow(tableau, limit, tolerance, further)


def analyse(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> Analysis:
    """Decides all that ``gark check`` reports, with orders up to ``limit``; ``tolerance`` is None
    for exact coefficients.
    """
    tableau.demand_fields("this analysis")
    if any(isinstance(x, PolynomialSpace) and x.stages > MAX_STAGES for x in tableau.spaces):
        message = f"this analysis of a family is for at most {MAX_STAGES} stages"
        cure = "gark tableau and gark export take more of gauss"
        raise MethodError(message, cure, code="too-many")
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
    )
    if not further:
        return found
    from garkcli.check.further import further_facts  # few files have them

    embedded, dense = further_facts(method, further, order, inconsistent, limit, spans)
    predictor = None
    if further.predictor is not None:
        from garkcli.order.predictor import predictor_orders  # fewer still

        predictor = predictor_orders(tableau, further.predictor, limit)
    return replace(found, embedded=embedded, dense=dense, predictor=predictor, further=further)


def looks_rounded(method: MethodFile) -> RoundingHint | None:
    """Returns the remark on the missing tolerance of a file; None if it has one, is exact or has a
    misprint.
    """
    if method.tolerance is not None:
        return None
    order = order_of(method.tableau)
    if not is_doubtful(order, None):
        return None
    from garkcli.check.remark import remark_on  # balls, which exact methods do without

    found = remark_on(method.tableau, order, None)
    return found if found is not None and found.line else None


def remark_of(method: MethodFile, analysis: Analysis) -> RoundingHint | None:
    """Returns the remark on the digits of a file: on the method or on its embedded weights."""
    asked = [("order", analysis.order)]
    if analysis.embedded is not None:
        asked.append(("embedded-order", analysis.embedded.order))
    for key, found in asked:
        if not is_doubtful(found, method.tolerance):
            continue
        from garkcli.check.remark import remark_on  # balls, which exact methods do without

        remark = remark_on(method.tableau, found, method.tolerance, key, analysis.limit)
        if remark is not None:
            return remark
    return None


def is_doubtful(found: AnyOrder, tolerance: fmpq | None) -> bool:
    """Returns whether rounding may be the reason why an order is not higher."""
    return found.witness is not None and (bool(tolerance) or within(found.witness.residual, TINY))


def _capped(
    conditions: Simplifying | None, order: AnyOrder | None, bound: Callable[[Simplifying], int]
) -> int | None:
    """Returns a bound, at most the order: within a tolerance it may exceed it."""
    return None if conditions is None or order is None else min(bound(conditions), order.order)
