"""The orders that the head of an exported file names, proved when it is written."""

from __future__ import annotations

from flint import fmpq

from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.order.deciding import order_of
from garkcli.order.meant import meant
from garkcli.order.simplifying import consistent_blocks
from garkcli.tableau.forms import with_time
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


def find_orders(tableau: Tableau, embedded: Tableau | None, tolerance: fmpq | None) -> Orders:
    """Prove the orders of a method.

    Args:
        tableau: the method.
        embedded: the same with the embedded weights; None without them.
        tolerance: the rounding of its coefficients; None where they are exact.
    """

    def found(of: Tableau | None) -> int | None:
        return None if of is None else order_of(meant(of, tolerance)).order

    method = meant(tableau, tolerance)
    order = order_of(method)
    timed = None if all(consistent_blocks(method).values()) else found(with_time(tableau))
    with_nodes = None if timed == order.order else timed
    return Orders(order.order, order.is_lower_bound, found(embedded), with_nodes, tolerance)
