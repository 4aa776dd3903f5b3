"""Orders, and B, C and D, for machines: fields of ``gark check --format json``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.exact.display import decimal, to_text
from garkcli.order.certificate import Order
from garkcli.page.record import Field, Record
from garkcli.page.schema import (
    COUNT,
    EXACT,
    INTEGER,
    POSITION,
    SIZE,
    TEXT,
    TRUE,
    Schema,
    array,
    nullable,
)
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.order.certificate import Witness
    from garkcli.order.deciding import AnyOrder

_WITNESS: Record[Witness] = Record(
    Field("order", POSITION, lambda x: x.tree.order),
    Field("tree", TEXT, lambda x: format_tree(x.tree)),
    Field("value", EXACT, lambda x: to_text(x.value)),
    Field("required", EXACT, lambda x: to_text(x.required)),
    Field("residual", EXACT, lambda x: to_text(x.residual)),
)


def order_fields(prefix: str = "") -> tuple[Field[AnyOrder], ...]:
    """An order with its witness.

    Args:
        prefix: whose order it is, before the names of the fields. The method always has one,
            whose prefix is empty; others may have none.
    """
    number = nullable(COUNT) if prefix else COUNT
    is_bound = f"{prefix}order_is_lower_bound"
    largest = f"{prefix}order_largest_residual"
    return (
        Field(f"{prefix}order", number, lambda x: x.order),
        _WITNESS.or_null(f"{prefix}witness", lambda x: x.witness),
        Field(is_bound, TRUE, _is_bound, is_optional=True),
        Field(largest, SIZE, _residual, is_optional=True),
        Field(f"{prefix}order_tolerance", TEXT, _tolerance, is_optional=True),
        Field(f"{prefix}order_undecided", TRUE, _undecided, is_optional=True),
    )


def _is_bound(order: AnyOrder) -> bool | None:
    return order.is_lower_bound or None


def _residual(order: AnyOrder) -> float | None:
    """The largest residual of an order within a tolerance."""
    if isinstance(order, Order):
        return None
    bound = order.largest_residual.upper()
    return float(bound)


def _tolerance(order: AnyOrder) -> str | None:
    if isinstance(order, Order):
        return None
    return decimal(order.tolerance)


def _undecided(order: AnyOrder) -> bool | None:
    """True where the next order is left open."""
    if isinstance(order, Order):
        return None
    return bool(order.undecided) or None


_TABLE: Schema = array(array(nullable(INTEGER)))
"""A number for each block, null where the block does not exist."""


def _reached_limit(found: Analysis) -> int | None:
    """Where the search stopped, if a number reached it."""
    conditions = found.simplifying
    return conditions.limit if conditions.is_open(conditions.limit) else None


SIMPLIFYING: Record[Analysis] = Record(
    Field("B", array(COUNT), lambda x: list(x.simplifying.B)),
    Field("C", _TABLE, lambda x: [list(row) for row in x.simplifying.C]),
    Field("D", _TABLE, lambda x: [list(row) for row in x.simplifying.D]),
    Field("r", COUNT, lambda x: x.simplifying.r),
    Field("eta", COUNT, lambda x: x.simplifying.eta),
    Field("zeta", COUNT, lambda x: x.simplifying.zeta),
    Field("xi", COUNT, lambda x: x.simplifying.xi),
    Field("chi", COUNT, lambda x: x.simplifying.chi),
    Field("bound", COUNT, lambda x: x.bound),
    Field("limit", COUNT, _reached_limit, is_optional=True),
)
"""B, C and D of a method, and the order they guarantee."""
