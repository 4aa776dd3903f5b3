"""The analysis of a method, and the proofs of its orders."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.doing import doing
from garkcli.errors import MethodError, ZeroWeight
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT, Proof, prove
from garkcli.order.deciding import AnyOrder
from garkcli.order.meant import as_embedded, derived, meant, printed
from garkcli.order.simplifying import Simplifying, defects_of
from garkcli.reason import NO_REASON, Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.check.further import DenseFacts, EmbeddedFacts
    from garkcli.order.meant import AnyTableau
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
        symplectic: whether it is its own conjugate; for a partitioned tableau, whether its two
            parts are conjugate.
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
        tolerance: the rounding within which all of this holds; None for exact coefficients.
        nonautonomous_order: the order on problems ẏ = f(t, y) with the nodes as printed; None if
            not applicable.
        embedded: the facts about its embedded weights, or None.
        dense: the facts about its dense output, or None.
        predictor: the orders of its predictor, or None.
        further: its further weights.
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
        """The distance of the exact method that a rounded one stands for from its printed
        coefficients; None for an exact method.
        """
        method = meant(self.tableau, self.tolerance)
        if isinstance(method, Tableau):
            return None
        from garkcli.order.nearness import nearness

        return nearness(method.search, self.order.order)

    @cached_property
    def wrong_rows(self) -> tuple[WrongSum, ...]:
        """The rows whose sum differs from the node by more than rounding explains."""
        if not self.inconsistent:
            return ()
        from garkcli.order.sums import wrong_rows

        defects = defects_of(meant(self.tableau, self.tolerance))
        return tuple(wrong_rows(defects, self.inconsistent))

    @cached_property
    def wrong_weights(self) -> tuple[WrongSum, ...]:
        """The weights whose sum differs from 1 by more than rounding explains, the embedded ones
        last.
        """
        found: list[WrongSum] = []
        method = meant(self.tableau, self.tolerance)
        asked = [(method, self.order, False)]
        if self.embedded is not None and self.further.embedded is not None:
            changed = as_embedded(method, self.further.embedded)
            asked.append((changed, self.embedded.order, True))
        for tableau, order, is_embedded in asked:
            if order.order or order.witness is None:
                continue
            from garkcli.order.sums import wrong_weights

            found += wrong_weights(defects_of(tableau), is_embedded)
        return tuple(found)

    def __repr__(self) -> str:
        orders = [f"order {self.order.order}"]
        if self.conjugate_order is not None:
            orders.append(f"conjugate {self.conjugate_order.order}")
        if self.pair_order is not None:
            orders.append(f"pair {self.pair_order.order}")
        return f"<Analysis {', '.join(orders)}>"


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
    """Returns whether a partitioned method is its own pair."""
    tableau = printed(method)
    return tableau.is_partitioned and printed(both).blocks == tableau.blocks


class MethodProof(Shown, Frozen):
    """The proofs of the orders of a method.

    Attributes:
        name: the name of the method.
        method: its order.
        conjugate: that of its symplectic conjugate, or None if a weight is zero.
        pair: that of the symplectic pair, or None if a weight is zero; for a partitioned method
            only the weights of the positions count.
        obstacle: why there is no conjugate; empty if there is one.
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
    """Returns the orders of an exact method, its conjugate and its pair, with spanning trees and
    witnesses.

    Raises MethodError for rounded coefficients.
    """
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
