"""Everything known about one multirate infinitesimal method with the exact fast solution."""

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
    """The truth about a multirate infinitesimal method whose fast problems are solved exactly;
    its tableau has collocation in place of the exact solutions.

    Attributes:
        slow_order: where the fast part is 0: that of its slow method.
    """

    slow_order: AnyOrder

    kind = "a multirate method with the exact fast part"
    no_property = Reason("a property of Runge–Kutta methods, and the fast part is solved exactly")

    @classmethod
    def besides(cls, method: AnyTableau, limit: int) -> dict[str, Any]:
        """The order of the slow method."""
        return {"slow_order": _among_all(order_of(slow_part(method), limit), printed(method))}

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """The order that a claim is on, with the tableau that has it; None for other claims."""
        return (self.slow_order, self.tableau) if claim == "slow-order" else super().view(claim)

    def __repr__(self) -> str:
        return f"<InfinitesimalAnalysis order {self.order.order}, slow {self.slow_order.order}>"


def _among_all(order: AnyOrder, tableau: Tableau) -> AnyOrder:
    """An order of the slow method, its colours counted after the fast one."""

    def moved(tree: Tree) -> Tree:
        return tableau.tree(tree.root + SLOW, map(moved, tree.branches))

    witness = order.witness
    if witness is None:
        return order
    return replace(order, witness=replace(witness, tree=moved(witness.tree)))
