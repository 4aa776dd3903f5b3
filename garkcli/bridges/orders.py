"""The orders that the head of an exported file names, proved when it is written."""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import order_of
from garkcli.order.simplifying import consistent_blocks
from garkcli.tableau.forms import with_time
from garkcli.tableau.meant import meant
from garkcli.tableau.tableau import Tableau


class Orders(Frozen):
    """What was proved.

    Attributes:
        order: of the method.
        is_lower_bound: whether it is known only that the order is no smaller.
        embedded: the order with the embedded weights; None without them.
        nonautonomous: the order for y' = f(t, y) with the nodes as they are, where nodes are not
            the row sums; None where it is the order, or has no meaning.
        tolerance: within which the conditions are met; None where they hold exactly.
    """

    order: int
    is_lower_bound: bool = False
    embedded: int | None = None
    nonautonomous: int | None = None
    tolerance: fmpq | None = None

    @property
    def effective(self) -> int:
        """The order on whatever problem, time in it or not: as targets name it."""
        if self.nonautonomous is None:
            return self.order
        return min(self.order, self.nonautonomous)

    def sentence(self) -> str:
        """The orders in words.

        >>> Orders(3, embedded=2).sentence()
        'order 3, embedded order 2; every order condition decided exactly'
        """
        least = "at least " if self.is_lower_bound else ""
        text = f"order {least}{self.order}"
        if self.embedded is not None:
            text += f", embedded order {self.embedded}"
        if self.nonautonomous is not None:
            text += f", order {self.nonautonomous} where f depends on t"
        if self.tolerance is None:
            return f"{text}; every order condition decided exactly"
        return f"{text}; order conditions met within {decimal(self.tolerance)}"


def find_orders(
    tableau: Tableau, embedded: Tableau | None, tolerance: fmpq | None, limit: int = DEFAULT_LIMIT
) -> Orders:
    """Prove the orders of a method.

    Args:
        tableau: the method.
        embedded: the same with the embedded weights; None without them.
        tolerance: the rounding of its coefficients; None where they are exact.
        limit: where the search stops.
    """
    order, is_lower_bound = _order(tableau, tolerance, limit)
    of_embedded = None
    if embedded is not None:
        of_embedded, _ = _order(embedded, tolerance, limit)
    timed_order = None
    timed = with_time(tableau)
    consistent = consistent_blocks(meant(tableau, tolerance)).values()
    if timed is not None and not all(consistent):
        timed_order, _ = _order(timed, tolerance, limit)
    if timed_order == order:
        timed_order = None
    return Orders(order, is_lower_bound, of_embedded, timed_order, tolerance)


def _order(tableau: Tableau, tolerance: fmpq | None, limit: int) -> tuple[int, bool]:
    """The order, and whether it is a lower bound only."""
    found = order_of(meant(tableau, tolerance), limit)
    return found.order, found.is_lower_bound
