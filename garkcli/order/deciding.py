"""The order of a method, exactly or within the rounding of its coefficients."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias, Union

from garkcli.order.certificate import DEFAULT_LIMIT, Order, StageSpans, find_order
from garkcli.order.meant import AnyTableau
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Edge, Tableau

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedOrder

AnyOrder: TypeAlias = Union[Order, "RoundedOrder"]


def order_of(
    method: AnyTableau, limit: int = DEFAULT_LIMIT, spans: StageSpans | None = None
) -> AnyOrder:
    """The order, at most ``limit``; ``spans`` are known stage vectors, whatever the weights."""
    if isinstance(method, Tableau):
        return find_order(method, limit, spans)
    # balls, which exact methods do without
    from garkcli.order.rounded import find_order_within

    return find_order_within(method, limit)


def nonautonomous(
    method: AnyTableau, order: AnyOrder, inconsistent: Sequence[Edge], limit: int
) -> AnyOrder | None:
    """The order for ẏ = f(t, y), which is the order itself if A^{l,m} 𝟙 = c^{l}."""
    timed = with_time(method) if isinstance(method, Tableau) else method.with_time()
    if timed is None:
        return None
    return order_of(timed, limit) if inconsistent else order
