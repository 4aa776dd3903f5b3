"""The order of a method, exactly or within the rounding of its coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, Union

from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans, find_order
from garkcli.order.meant import AnyTableau
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedOrder

AnyOrder: TypeAlias = Union[Order, "RoundedOrder"]
"""An order found exactly, or within a tolerance; both have ``order``, ``witness`` and
``is_lower_bound``.
"""


def order_of(
    method: AnyTableau, limit: int = DEFAULT_LIMIT, spans: StageSpans | None = None
) -> AnyOrder:
    """Returns the order of an exact or a rounded tableau, at most ``limit``.

    ``spans`` are its stage vectors, if some are known; they do not depend on weights.
    """
    if isinstance(method, Tableau):
        return find_order(method, limit, spans)
    # balls, which exact methods do without
    from garkcli.order.rounded import find_order_within

    return find_order_within(method, limit)
