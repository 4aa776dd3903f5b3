"""The analysis of a method, exactly or within its tolerance, and the proofs of its orders."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.doing import doing
from garkcli.errors import MethodError, ZeroWeight
from garkcli.families.family import MAX_STAGES
from garkcli.frozen import Frozen, replace
from garkcli.order.certificate import DEFAULT_LIMIT, Proof, StageSpans, prove
from garkcli.order.deciding import AnyOrder, nonautonomous, order_of
from garkcli.order.meant import AnyTableau, as_embedded, derived, meant, printed
from garkcli.order.simplifying import (
    Simplifying,
    defects_of,
    inconsistent_blocks,
    is_symplectic,
    simplifying,
)
from garkcli.order.tolerance import small, within
from garkcli.reason import NO_REASON, Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.check.nystrom import NystromAnalysis
    from garkcli.check.order_facts import DenseFacts, EmbeddedFacts
    from garkcli.check.rare_kinds import DerivativesAnalysis, InfinitesimalAnalysis, NprkAnalysis
    from garkcli.check.remark import RoundingHint
    from garkcli.check.rosenbrock import RosenbrockAnalysis
    from garkcli.methodfile.build import MethodFile
    from garkcli.order.nearness import Nearness
    from garkcli.order.predictor import PredictorOrders
    from garkcli.order.sums import WrongSum
    from garkcli.properties.subject import Subject


class Analysis(Shown, Frozen):
    """The orders and conditions of a method, its symplectic conjugate and its pair.

    Attributes:
        tableau: the method.
        order: its order with a witness.
        simplifying: B, C, D and their bounds of the order.
        inconsistent: the blocks with A^{l,m} 𝟙 ≠ c^{l}, as (l, m) counted from 0.
        symplectic: whether it is its own conjugate, or the two parts of a partitioned one are.
        conjugate: the conjugate, or None if a weight is zero, which ``obstacle`` names.
        conjugate_order: the order of the conjugate.
        conjugate_inconsistent: the blocks with Â^{l,m} 𝟙 ≠ c^{l}.
        pair: the symplectic pair with 2N colours, or None.
        pair_order: the order of the pair.
        pair_simplifying: B, C, D and the bounds for the pair.
        bound: the paper's lower bound of the order; within a tolerance at most the order.
        pair_bound: the same for the pair.
        sharp_bound: the sharper bound of docs/sharper-bound.md, likewise.
        pair_sharp_bound: the same for the pair.
        obstacle: why there is no conjugate; empty if there is one.
        limit: where the search for orders stopped.
        tolerance: the rounding of all results; None for exact coefficients.
        nonautonomous_order: on problems ẏ = f(t, y) with printed nodes; None if not applicable.
        embedded: the facts about embedded weights, or None.
        dense: the facts about dense output, or None.
        predictor: the orders of the predictor, or None.
        further: its further weights.

    >>> from garkcli import analyse
    >>> found = analyse("heun")
    >>> found.order, found.conjugate_order, found.symplectic
    (<Order 2>, <Order 2>, False)
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
    bound: int
    pair_bound: int | None
    sharp_bound: int
    pair_sharp_bound: int | None
    obstacle: Reason
    limit: int
    tolerance: fmpq | None = None
    nonautonomous_order: AnyOrder | None = None
    embedded: EmbeddedFacts | None = None
    dense: DenseFacts | None = None
    predictor: PredictorOrders | None = None
    further: Further = NOTHING

    @cached_property
    def subject(self) -> Subject:
        """The method as its properties are decided."""
        from garkcli.properties.subject import Subject

        method = meant(self.tableau, self.tolerance)
        order = self.order.order
        return Subject.read(method, order, self.simplifying, self.limit, self.further)

    @cached_property
    def nearness(self) -> Nearness | None:
        """The distance of the method that rounded coefficients stand for from the printed one."""
        method = meant(self.tableau, self.tolerance)
        if isinstance(method, Tableau):
            return None
        from garkcli.order.nearness import nearness

        return nearness(method.search, self.order.order)

    @cached_property
    def wrong_rows(self) -> tuple[WrongSum, ...]:
        """The rows whose sum differs from the node by more than rounding."""
        if not self.inconsistent:
            return ()
        from garkcli.order.sums import wrong_rows

        defects = defects_of(meant(self.tableau, self.tolerance))
        return tuple(wrong_rows(defects, self.inconsistent))

    @cached_property
    def wrong_weights(self) -> tuple[WrongSum, ...]:
        """The weights whose sum is wrong beyond rounding, the embedded ones last."""
        wrong: list[WrongSum] = []
        method = meant(self.tableau, self.tolerance)
        asked = [(method, self.order, False)]
        if self.embedded is not None and self.further.embedded is not None:
            changed = as_embedded(method, self.further.embedded)
            asked.append((changed, self.embedded.order, True))
        for tableau, order, is_embedded in asked:
            if order.order or order.witness is None:
                continue
            from garkcli.order.sums import wrong_weights

            wrong += wrong_weights(defects_of(tableau), is_embedded)
        return tuple(wrong)

    def __repr__(self) -> str:
        orders = [f"order {self.order.order}"]
        if self.conjugate_order is not None:
            orders.append(f"conjugate {self.conjugate_order.order}")
        if self.pair_order is not None:
            orders.append(f"pair {self.pair_order.order}")
        return f"<Analysis {', '.join(orders)}>"


AnyAnalysis: TypeAlias = (
    "Analysis | RosenbrockAnalysis | NystromAnalysis | NprkAnalysis | DerivativesAnalysis"
    " | InfinitesimalAnalysis"
)


@doing("conjugate and pair")
def conjugate_and_pair(method: AnyTableau) -> tuple[AnyTableau | None, AnyTableau | None, Reason]:
    """Returns the conjugate and the symplectic pair, or None for both and the reason."""
    conjugated, both, obstacle = None, None, NO_REASON
    if not printed(method).has_fields_alone or printed(method).exact_to is not None:
        return None, None, Reason("it is not a GARK method")
    try:
        conjugated = derived(method, "conjugate")
    except ZeroWeight as error:
        obstacle = error.reason
    try:
        both = derived(method, "pair")
    except ZeroWeight as error:
        obstacle = error.reason
    return conjugated, both, obstacle


def is_pair_of_itself(method: AnyTableau, both: AnyTableau) -> bool:
    tableau = printed(method)
    return tableau.is_partitioned and printed(both).blocks == tableau.blocks


class MethodProof(Shown, Frozen):
    """The proofs of the orders of a method.

    Attributes:
        name: the name of the method.
        method: its order.
        conjugate: that of its symplectic conjugate, or None if a weight is zero.
        pair: that of the symplectic pair, or None if a weight, of the positions if partitioned, is
            zero.
        obstacle: why there is no conjugate; empty if there is one.

    >>> from garkcli import prove_method
    >>> proof = prove_method("heun")
    >>> proof.method.order, proof.pair.order
    (<Order 2>, <Order 2>)
    """

    name: str
    method: Proof
    conjugate: Proof | None
    pair: Proof | None
    obstacle: Reason

    def __repr__(self) -> str:
        proofs = {"conjugate": self.conjugate, "pair": self.pair}
        orders = [f"order {self.method.order.order}"]
        for label, proof in proofs.items():
            if proof is not None:
                orders.append(f"{label} {proof.order.order}")
        return f"<MethodProof {', '.join(orders)}>"


@doing("proof")
def prove_method(method: GarkMethod, limit: int = DEFAULT_LIMIT) -> MethodProof:
    """Proves the orders of a method, its conjugate and its pair; MethodError if it is rounded."""
    if method.tolerance is not None:
        message = "the coefficients are rounded: an order within a tolerance has no exact proof"
        cure = "prove_method_exists proves that a method within it exists"
        raise MethodError(message, cure, code="rounded")
    conjugated, both, obstacle = conjugate_and_pair(method.tableau)
    return MethodProof(
        name=method.name,
        method=prove(method.tableau, limit),
        conjugate=None if conjugated is None else prove(printed(conjugated), limit),
        pair=None if both is None else prove(printed(both), limit),
        obstacle=obstacle,
    )


def analyse_any(method: GarkMethod, limit: int = DEFAULT_LIMIT) -> AnyAnalysis:
    return analyse_any_tableau(method.tableau, limit, method.tolerance, method.further)


def analyse_any_tableau(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> AnyAnalysis:
    if tableau.is_gark:
        return analyse(tableau, limit, tolerance, further)
    from garkcli.constructions.nprk import is_nprk  # few methods need these
    from garkcli.constructions.nystrom import is_nystrom
    from garkcli.constructions.rosenbrock import is_rosenbrock

    if is_rosenbrock(tableau):
        from garkcli.check.rosenbrock import analyse_rosenbrock  # few methods are

        return analyse_rosenbrock(tableau, limit, tolerance, further)
    if is_nprk(tableau):
        from garkcli.check.rare_kinds import analyse_nprk  # likewise

        return analyse_nprk(tableau, limit, tolerance, further)
    if is_nystrom(tableau):
        from garkcli.check.nystrom import analyse_nystrom  # likewise

        return analyse_nystrom(tableau, limit, tolerance, further)
    if tableau.uses_derivatives:
        from garkcli.check.rare_kinds import DerivativesAnalysis  # likewise

        return DerivativesAnalysis.with_flow(tableau, limit, tolerance, further)
    from garkcli.check.rare_kinds import InfinitesimalAnalysis  # likewise

    return InfinitesimalAnalysis.with_flow(tableau, limit, tolerance, further)


def analyse(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> Analysis:
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
    analysis = Analysis(
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
        return analysis
    from garkcli.check.order_facts import further_facts  # few files have them

    embedded, dense = further_facts(method, further, order, inconsistent, limit, spans)
    predictor = None
    if further.predictor is not None:
        from garkcli.order.predictor import predictor_orders  # fewer still

        predictor = predictor_orders(tableau, further.predictor, limit)
    return replace(analysis, embedded=embedded, dense=dense, predictor=predictor, further=further)


def looks_rounded(method: MethodFile, order: AnyOrder | None = None) -> RoundingHint | None:
    """Returns the remark on a missing tolerance; None if it has one, is exact or has a misprint."""
    if method.tolerance is not None:
        return None
    order = order or order_of(method.tableau)
    if not is_doubtful(order, None):
        return None
    from garkcli.check.remark import remark_on  # balls, which exact methods do without

    remark = remark_on(method.tableau, order, None)
    return remark if remark is not None and remark.line else None


def remark_of(method: MethodFile, analysis: Analysis) -> RoundingHint | None:
    asked = [("order", analysis.order)]
    if analysis.embedded is not None:
        asked.append(("embedded-order", analysis.embedded.order))
    for key, order in asked:
        if not is_doubtful(order, method.tolerance):
            continue
        from garkcli.check.remark import remark_on  # balls, which exact methods do without

        remark = remark_on(method.tableau, order, method.tolerance, key, analysis.limit)
        if remark is not None:
            return remark
    return None


def is_doubtful(order: AnyOrder, tolerance: fmpq | None) -> bool:
    """Returns whether rounding may be the reason why an order is not higher."""
    missed = order.witness
    if missed is None:
        return False
    return bool(tolerance) or within(missed.residual, small(order.order + 1))


def _capped(
    conditions: Simplifying | None, order: AnyOrder | None, bound: Callable[[Simplifying], int]
) -> int | None:
    """Returns a bound, at most the order, which it may exceed within a tolerance."""
    return None if conditions is None or order is None else min(bound(conditions), order.order)
