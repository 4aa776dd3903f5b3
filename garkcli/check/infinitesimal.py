"""The analysis of a multirate infinitesimal method with exact fast solutions."""

from __future__ import annotations

from typing import Any

from garkcli.check.order_facts import OrderFacts
from garkcli.constructions.infinitesimal import slow_part
from garkcli.constructions.multirate import SLOW
from garkcli.frozen import replace
from garkcli.ntrees.tree import Tree
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, printed
from garkcli.reason import Reason
from garkcli.tableau.tableau import Tableau


class InfinitesimalAnalysis(OrderFacts, kw_only=True):
    """The orders of a multirate infinitesimal method whose fast problems are solved exactly; its
    tableau has collocation in their place.

    ``slow_order`` is that of the slow method, for a fast part 0.
    """

    slow_order: AnyOrder

    kind = "a multirate method with the exact fast part"
    no_property = Reason("a property of Runge–Kutta methods, and the fast part is solved exactly")

    @classmethod
    def besides(cls, method: AnyTableau, limit: int) -> dict[str, Any]:
        return {"slow_order": _among_all(order_of(slow_part(method), limit), printed(method))}

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """Returns the order that a claim is about and its tableau; None for other claims."""
        return (self.slow_order, self.tableau) if claim == "slow-order" else super().view(claim)

    def __repr__(self) -> str:
        return f"<InfinitesimalAnalysis order {self.order.order}, slow {self.slow_order.order}>"


def _among_all(order: AnyOrder, tableau: Tableau) -> AnyOrder:
    """Returns an order of the slow method with the colours counted after the fast one."""

    def moved(tree: Tree) -> Tree:
        return tableau.tree(tree.root + SLOW, map(moved, tree.branches))

    witness = order.witness
    if witness is None:
        return order
    return replace(order, witness=replace(witness, tree=moved(witness.tree)))
