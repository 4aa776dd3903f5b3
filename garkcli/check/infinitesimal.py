"""Everything known about one multirate infinitesimal method with the exact fast solution."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

from flint import fmpq

from garkcli.check.analysis import inconsistent_blocks, nonautonomous
from garkcli.check.further import EmbeddedFacts, further_facts
from garkcli.constructions.infinitesimal import slow_part
from garkcli.constructions.multirate import SLOW
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import DEFAULT_LIMIT, StageSpans
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import meant
from garkcli.properties.property import NoProperties
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

_NO_PROPERTY = Reason("a property of Runge–Kutta methods, and the fast part is solved exactly")


class InfinitesimalAnalysis(Shown, Frozen):
    """The truth about a multirate infinitesimal method whose fast problems are solved exactly.

    Attributes:
        tableau: with collocation in place of the exact solutions.
        order: its order.
        slow_order: where the fast part is 0: that of its slow method.
        nonautonomous_order: on problems ẏ = f(t, y), with the nodes of the file.
        limit: where the search for orders stopped.
        tolerance: the rounding within which all of this holds; None where it holds exactly.
        embedded: the truth about its embedded weights; None where it has none.
        further: these weights.
    """

    tableau: Tableau
    order: AnyOrder
    slow_order: AnyOrder
    nonautonomous_order: AnyOrder | None
    limit: int
    tolerance: fmpq | None = None
    embedded: EmbeddedFacts | None = None
    further: Further = NOTHING

    kind: ClassVar[str] = "a multirate method with the exact fast part"

    @property
    def dense(self) -> None:
        """It has no dense output."""

    @cached_property
    def subject(self) -> NoProperties:
        """It has no properties."""
        return NoProperties(self.tolerance or fmpq(0), _NO_PROPERTY)

    def view(self, claim: str) -> tuple[AnyOrder, Tableau] | None:
        """The order that a claim is on, with the tableau that has it; None for other claims."""
        found: AnyOrder | None = None
        tableau: Tableau | None = self.tableau
        if claim.startswith("embedded-") and self.embedded is not None:
            tableau = self.embedded.tableau
            if claim == "embedded-order":
                found = self.embedded.order
            elif claim == "embedded-nonautonomous-order":
                found, tableau = self.embedded.nonautonomous_order, with_time(tableau)
        elif claim == "order":
            found = self.order
        elif claim == "slow-order":
            found = self.slow_order
        elif claim == "nonautonomous-order":
            found, tableau = self.nonautonomous_order, with_time(self.tableau)
        return None if found is None or tableau is None else (found, tableau)

    def __repr__(self) -> str:
        return f"<InfinitesimalAnalysis order {self.order.order}, slow {self.slow_order.order}>"


def analyse_infinitesimal(
    tableau: Tableau,
    limit: int = DEFAULT_LIMIT,
    tolerance: fmpq | None = None,
    further: Further = NOTHING,
) -> InfinitesimalAnalysis:
    """Decide everything that ``gark check`` reports of a method with ``fast: exact``.

    Args:
        tableau: with collocation in place of the exact solutions.
        limit: where the search for orders stops; also where collocation would change conditions.
        tolerance: the rounding of its coefficients; None for coefficients that are meant exactly.
        further: its embedded weights.
    """
    limit = min(limit, tableau.exact_to or limit)
    method = meant(tableau, tolerance, further)
    spans = StageSpans(tableau) if further and method is tableau else None
    order = order_of(method, limit, spans)
    slow = _among_all(order_of(slow_part(method), limit), tableau)
    inconsistent = inconsistent_blocks(method)
    timed = nonautonomous(method, order, inconsistent, limit)
    embedded, _ = further_facts(method, further, order, inconsistent, limit, spans)
    return InfinitesimalAnalysis(tableau, order, slow, timed, limit, tolerance, embedded, further)


def _among_all(order: AnyOrder, tableau: Tableau) -> AnyOrder:
    """An order of the slow method, its colours counted after the fast one."""

    def moved(tree: Tree) -> Tree:
        return tableau.tree(tree.root + SLOW, map(moved, tree.branches))

    witness = order.witness
    if witness is None:
        return order
    return replace(order, witness=replace(witness, tree=moved(witness.tree)))
