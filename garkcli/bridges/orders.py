"""The orders in the head of an exported file, proved when it is written."""

from __future__ import annotations

from flint import fmpq

from garkcli.constructions.rosenbrock import Which, is_rosenbrock, seen
from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import nonautonomous, order_of
from garkcli.order.meant import AnyTableau, as_embedded, meant, tolerance_of
from garkcli.order.simplifying import inconsistent_blocks
from garkcli.tableau.embedded import Weights
from garkcli.tableau.tableau import Tableau


class Orders(Frozen):
    """``nonautonomous`` is the order for y' = f(t, y) if it differs, ``w_order`` that with any
    matrix for the Jacobian of a Rosenbrock method; ``tolerance`` is None if conditions hold
    exactly.
    """

    order: int
    is_lower_bound: bool = False
    embedded: int | None = None
    nonautonomous: int | None = None
    tolerance: fmpq | None = None
    embedded_tolerance: fmpq | None = None
    w_order: int | None = None

    @property
    def effective(self) -> int:
        """The order for any problem, with time or not."""
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
        if self.w_order is not None:
            text += f", order {self.w_order} with any matrix for the Jacobian"
        if self.embedded is not None:
            text += f", embedded order {self.embedded}"
            if self.embedded_tolerance != self.tolerance:
                text += f" {_how(self.embedded_tolerance)}"
        if self.nonautonomous is not None:
            text += f", order {self.nonautonomous} where f depends on t"
        if self.tolerance is None and self.embedded_tolerance is None:
            return f"{text}; every order condition decided exactly"
        return f"{text}; order conditions met {_how(self.tolerance)}"


def _how(tolerance: fmpq | None) -> str:
    return "exactly" if tolerance is None else f"within {decimal(tolerance)}"


def find_orders(tableau: Tableau, embedded: Weights | None, tolerance: fmpq | None) -> Orders:
    method = meant(tableau, tolerance)
    if is_rosenbrock(tableau):
        return _of_rosenbrock(method, embedded)
    order = order_of(method)
    timed = None
    if tableau.has_fields_alone:
        timed = nonautonomous(method, order, inconsistent_blocks(method), DEFAULT_LIMIT)
    with_nodes = None if timed is None or timed.order == order.order else timed.order
    other, near = None, tolerance
    if embedded is not None:
        changed = as_embedded(method, embedded)
        other, near = order_of(changed).order, tolerance_of(changed)
    return Orders(order.order, order.is_lower_bound, other, with_nodes, tolerance, near)


def _of_rosenbrock(method: AnyTableau, embedded: Weights | None) -> Orders:
    order = order_of(method)
    views: tuple[Which, Which] = ("with_any_matrix", "with_time")
    w_order, timed = (order_of(seen(method, x)) for x in views)
    other, near = None, tolerance_of(method)
    if embedded is not None:
        changed = as_embedded(method, embedded)
        other, near = order_of(changed).order, tolerance_of(changed)
    return Orders(
        order.order,
        order.is_lower_bound,
        other,
        None if timed.order == order.order else timed.order,
        tolerance_of(method),
        near,
        w_order.order,
    )
