"""``gark check --format json`` of a file with free parameters: what holds for every value."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from garkcli.exact.display import to_text
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.page.record import Field, Record
from garkcli.page.schema import COUNT, FLAG, INTEGER, POSITION, TEXT, TRUE, Schema, array, nullable
from garkcli.properties.keys import KEYS
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.check.every_facts import Fact
    from garkcli.check.every_orders import EveryOrder
    from garkcli.check.every_value import EveryValue
    from garkcli.check.outcome import Outcome
    from garkcli.exact.cells import Interval

_VALUE: Schema = {
    "type": ["boolean", "integer", "string", "array", "null"],
    "description": "The answer; null where there is none.",
}
_SPECIAL: Record[tuple[Any, Any]] = Record(
    Field("at", ALGEBRAIC, lambda x: root_data(x[0])), Field("value", _VALUE, lambda x: x[1])
)
_ELSEWHERE: Record[tuple[str, Any]] = Record(
    Field("zero", TEXT, lambda x: x[0]), Field("value", _VALUE, lambda x: x[1])
)


def _end(root: Any) -> object:
    if root is None:
        return None
    return root_data(root)


_INTERVAL: Record[Interval] = Record(
    Field("from", nullable(ALGEBRAIC), lambda x: _end(x.start)),
    Field("to", nullable(ALGEBRAIC), lambda x: _end(x.end)),
    Field("from_included", FLAG, lambda x: x.has_start),
    Field("to_included", FLAG, lambda x: x.has_end),
)


def _where(fact: Fact) -> list[dict[str, Any]] | None:
    if fact.where is None:
        return None
    return [_INTERVAL.data(x) for x in fact.where]


def _unknown(fact: Fact) -> list[object]:
    return [root_data(root) for root in fact.unknown]


FACT: Record[Fact] = Record(
    Field("decided", FLAG, lambda x: not x.is_undecided or x.differs),
    Field("every_value", FLAG, lambda x: x.is_everywhere),
    Field("value", _VALUE, lambda x: x.value),
    _SPECIAL.every("special", lambda x: x.special),
    _ELSEWHERE.every("elsewhere", lambda x: x.elsewhere),
    Field("zeros", array(TEXT), lambda x: list(x.zeros)),
    Field("open", array(TEXT), lambda x: list(x.open)),
    Field("unknown", array(ALGEBRAIC), _unknown),
    Field("where", array(_INTERVAL.schema), _where, is_optional=True),
    Field("why", TEXT, lambda x: x.why or None, is_optional=True),
)
"""An answer with the values for which it is another."""


def _witness(order: EveryOrder) -> dict[str, Any] | None:
    if order.witness is None:
        return None
    return {
        "order": order.witness.order,
        "tree": format_tree(order.witness),
        "residual": to_text(order.residual),
    }


_WITNESS: Schema = {
    "type": ["object", "null"],
    "required": ["order", "tree", "residual"],
    "properties": {"order": POSITION, "tree": TEXT, "residual": TEXT},
    "additionalProperties": False,
}
_ORDER: Record[EveryOrder] = Record(
    Field("order", COUNT, lambda x: x.order),
    Field("witness", _WITNESS, _witness),
    FACT.whole("fact", lambda x: x.fact),
    Field("dimension", nullable(INTEGER), lambda x: x.dimension),
    Field("weights", array(TEXT), lambda x: list(x.poles)),
)
"""An order; the dimension is that of the values with the next one, −1 where there are none."""


def _part(part: Callable[[Any], Any]) -> Callable[[EveryValue], object]:
    return lambda x: FACT.data(x.simplifying.of(part))


def _blocks(found: Any) -> list[list[int]]:
    numbers = []
    for l, m in found:
        numbers.append([l + 1, m + 1])
    return numbers


def _inconsistent(found: EveryValue) -> Fact:
    return found.inconsistent.of(_blocks)


def _colours(found: EveryValue) -> list[str]:
    return [colour.name for colour in found.tableau.colours]


_FACTS: Schema = FACT.schema
EVERY_FIELDS: tuple[Field[EveryValue], ...] = (
    Field("every_value", TRUE, lambda _: True),
    Field("unknowns", array(TEXT), lambda x: list(x.parameters)),
    Field("colours", array(TEXT), _colours),
    _ORDER.whole("order", lambda x: x.order),
    _ORDER.or_null("conjugate_order", lambda x: x.conjugate),
    _ORDER.or_null("pair_order", lambda x: x.pair),
    _ORDER.or_null("embedded_order", lambda x: x.embedded),
    Field("B", _FACTS, _part(lambda x: list(x.B))),
    Field("C", _FACTS, _part(lambda x: [list(row) for row in x.C])),
    Field("D", _FACTS, _part(lambda x: [list(row) for row in x.D])),
    Field("bound", _FACTS, _part(lambda x: x.bound)),
    Field("sharp_bound", _FACTS, _part(lambda x: x.sharp_bound)),
    FACT.whole("inconsistent_blocks", _inconsistent),
    FACT.whole("symplectic", lambda x: x.symplectic),
)
"""What was found of a family."""


def _verdicts(outcome: Outcome) -> dict[str, Any] | None:
    found = outcome.every
    if found is None or not outcome.wants_properties:
        return None
    return {key: FACT.data(found.verdict(key)) for key in KEYS}


EVERY_VERDICTS: Field[Outcome] = Field(
    "every_property",
    {"type": "object", "properties": dict.fromkeys(KEYS, _FACTS), "additionalProperties": False},
    _verdicts,
    is_optional=True,
)
"""All properties, where they were asked for."""
