"""Embedded weights and dense output, for machines: fields of ``gark check --format json``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.exact.display import to_text
from garkcli.page.record import Field, Record, inside
from garkcli.page.schema import COUNT, EXACT, FLAG, POSITION, TEXT, TRUE, array, nullable
from garkcli.report.hints_json import CONSTANTS
from garkcli.report.order_json import order_fields
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.further import DenseFacts
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseWitness
    from garkcli.order.estimator import Estimator


def _sums(found: Estimator) -> list[str]:
    return [to_text(x) for x in found.sums]


_ESTIMATE: Record[Estimator] = Record(
    Field("order", nullable(POSITION), lambda x: x.order),
    Field("zero", FLAG, lambda x: x.is_zero),
    Field("sums", array(EXACT), _sums),
    CONSTANTS.or_null("leading_term", lambda x: x.constants),
)
_WITNESS: Record[DenseWitness] = Record(
    Field("order", POSITION, lambda x: x.witness.tree.order),
    Field("tree", TEXT, lambda x: format_tree(x.witness.tree)),
    Field("power", POSITION, lambda x: x.power),
    Field("value", EXACT, lambda x: to_text(x.witness.value)),
    Field("required", EXACT, lambda x: to_text(x.witness.required)),
    Field("residual", EXACT, lambda x: to_text(x.witness.residual)),
)
_DENSE: Record[DenseFacts] = Record(
    Field("degree", POSITION, lambda x: x.degree),
    _WITNESS.or_null("witness", lambda x: x.order.witness),
    Field("continuous", FLAG, lambda x: x.ends_at_step),
    Field("smooth", nullable(FLAG), lambda x: x.is_smooth),
    Field("slope_at_start", nullable(FLAG), lambda x: x.slopes.at_start),
    Field("slope_at_end", nullable(FLAG), lambda x: x.slopes.at_end),
    Field("order_is_lower_bound", TRUE, lambda x: x.order.is_lower_bound or None, is_optional=True),
    Field("order_undecided", TRUE, lambda x: x.order.undecided or None, is_optional=True),
)


def _embedded(found: Analysis) -> AnyOrder | None:
    if found.embedded is None:
        return None
    return found.embedded.order


def _with_time(found: Analysis) -> AnyOrder | None:
    if found.embedded is None:
        return None
    return found.embedded.nonautonomous_order


def _estimator(found: Analysis) -> Estimator | None:
    if found.embedded is None:
        return None
    return found.embedded.estimator


def _dense_order(found: Analysis) -> int | None:
    if found.dense is None:
        return None
    return found.dense.order.order


FURTHER_FIELDS: tuple[Field[Analysis], ...] = (
    *inside(_embedded, order_fields("embedded_")),
    *inside(_with_time, order_fields("embedded_nonautonomous_")),
    _ESTIMATE.or_null("error_estimate", _estimator),
    Field("dense_order", nullable(COUNT), _dense_order),
    _DENSE.or_null("dense", lambda x: x.dense),
)
"""The orders of further weights, the estimate of the error, what dense output is like."""
