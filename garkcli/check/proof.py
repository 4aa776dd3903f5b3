"""The orders of a method, of its conjugate and of its pair with what decides them."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.check.analysis import conjugate_and_pair
from garkcli.doing import doing
from garkcli.errors import MethodError
from garkcli.order.certificate import DEFAULT_LIMIT, Proof, prove
from garkcli.reason import Reason
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.meant import printed
from garkcli.upward import Shown


@dataclass(frozen=True)
class MethodProof(Shown):
    """What decides the orders of a method.

    Attributes:
        name: of the method.
        method: its order.
        conjugate: that of its symplectic conjugate, or None where a weight is zero.
        pair: that of the symplectic pair, or None likewise; of a partitioned method it needs the
            weights of the positions alone.
        obstacle: why there is no conjugate; empty where there is one.
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
    """The orders of a method, its conjugate and its pair, with spanning trees and witnesses.

    Args:
        method: as it was loaded; its coefficients are exact.
        limit: the order at which to stop.

    Raises:
        MethodError: the coefficients are rounded.
    """
    if method.tolerance is not None:
        raise MethodError(
            "the coefficients are rounded: an order within a tolerance has no exact proof",
            "give them exactly, without a tolerance",
            code="rounded",
        )
    conjugated, both, obstacle = conjugate_and_pair(method.tableau)
    return MethodProof(
        name=method.name,
        method=prove(method.tableau, limit),
        conjugate=None if conjugated is None else prove(printed(conjugated), limit),
        pair=None if both is None else prove(printed(both), limit),
        obstacle=obstacle,
    )
