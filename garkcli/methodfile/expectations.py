"""The claims under ``expect``, including those on real numbers."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.errors import ExpressionError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.grammar.keys import FLAG, Key, ValueKind, mapping
from garkcli.grammar.nodes import Node, ScalarNode, SequenceNode, is_null, shortened
from garkcli.grammar.source import Source
from garkcli.methodfile.description import ClaimText
from garkcli.properties.definitions import ORDERS, definition, every_definition
from garkcli.properties.registry import KEYS

if TYPE_CHECKING:
    from garkcli.exact.roots import RealRoot

INFINITY = "infinity"
_DECIMAL = r"[0-9]*\.(?P<places>[0-9]*)(?:[eE](?P<exponent>[+-]?[0-9]{1,3}))?"
_LEAST = r">=\s*(.*)"


class ClaimedNumber(Frozen):
    """``number`` is None for ∞; ``half_unit``, of a decimal's last place, is 0 if exact."""

    text: str
    number: Number | None
    half_unit: fmpq = ZERO
    is_least: bool = False

    def __str__(self) -> str:
        return self.text

    def agrees(self, root: RealRoot | None, rounding: fmpq = ZERO) -> bool:
        """Whether the claim is true of a number, None for ∞, with error at most ``rounding``."""
        if self.number is None:
            return root is None
        if root is None:
            return self.is_least
        if self.is_least:
            return _root(self.number - rounding) <= root
        off = self.half_unit + rounding
        return _root(self.number - off) <= root <= _root(self.number + off)


def _root(number: Number) -> RealRoot:
    from garkcli.exact.polynomial import Polynomial
    from garkcli.exact.roots import real_roots

    ((root, _),) = real_roots(Polynomial([-number, 1]))
    return root


def read_measure(source: Source, node: Node, where: str) -> ClaimedNumber | None:
    text = source.scalar(node, where)
    if text is None:
        return None
    least = re.fullmatch(_LEAST, text, re.DOTALL)
    body = (least[1] if least else text).strip()
    if body == INFINITY:
        return ClaimedNumber(text, None)
    try:
        expression = parse(body)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        cure = error.help or "write a number such as 2*sqrt(2) or 2.785, or infinity"
        source.fault(node, f"{where}: {error.message}", cure, code=error.code)
        return None
    return ClaimedNumber(text, number, _half_unit(body), least is not None)


def _half_unit(text: str) -> fmpq:
    decimal = re.fullmatch(_DECIMAL, text)
    if decimal is None:
        return ZERO
    exponent = int(decimal["exponent"] or 0) - len(decimal["places"])
    return fmpq(10) ** exponent / 2


CLAIMS = (*ORDERS, *KEYS)
_FORM = "write for instance expect: {order: 4}"
_AT_LEAST = r">=\s*([0-9]{1,4})"


class AtLeast(Frozen):
    least: int

    def __str__(self) -> str:
        return f">= {self.least}"


Wanted: TypeAlias = "int | AtLeast | bool | ClaimedNumber | list[Wanted] | None"


def _number(at: Any, node: Node, where: str) -> Wanted:
    text = at.source.scalar(node, where) or ""
    if at_least := re.fullmatch(_AT_LEAST, text):
        return AtLeast(int(at_least[1]))
    if text.isascii() and text.isdigit() and len(text) < 5:
        return int(text)
    if isinstance(node, ScalarNode):
        message = f'{where}: a number or ">= n" is expected, not {shortened(text)}'
        at.source.fault(
            node, message, 'for instance order: 4, or order: ">= 4"', code="wrong-value"
        )
    return None


def _table(item: ValueKind) -> ValueKind:
    def read(at: Any, node: Node, where: str) -> Wanted:
        if isinstance(node, SequenceNode):
            return [item.read(at, x, where) for x in node.value]
        cure = "one number per colour, for C and D a row per colour"
        at.source.fault(node, f"{where}: a list is expected", cure, code="list-expected")
        return None

    return ValueKind(lambda: {"type": "array", "items": item.schema()}, read)


_COUNTS = (
    {"type": "integer", "minimum": 0},
    {"type": "string", "pattern": "^(>=\\s*)?[0-9]{1,4}$"},
)
_COUNT = ValueKind(lambda: {"anyOf": [*_COUNTS]}, _number)
_ROW = _table(
    ValueKind(
        lambda: {"anyOf": [*_COUNTS, {"type": "null"}]},
        lambda at, node, where: None if is_null(node) else _number(at, node, where),
    )
)
_REAL = ValueKind(
    lambda: {"type": ["number", "string"], "pattern": r"^(>=\s*)?[-+*/^(),.\sA-Za-z0-9_]+$"},
    lambda at, node, where: read_measure(at.source, node, where),
)
_KINDS = {"truth": FLAG, "count": _COUNT, "number": _REAL, "row": _ROW, "table": _table(_ROW)}
_EXAMPLES = {
    "B": "[4, 4]",
    "C": "[[2, 3], [3, 3]]",
    "D": "[[2, 1], [1, 1]]",
    "gamma": "1 - sqrt(2)/2",
    "ssp-coefficient": '">= 1"',
    "real-stability": "infinity",
    "imaginary-stability": "2*sqrt(2)",
}


def claims() -> Iterator[Key]:
    for claim in every_definition():
        example = _EXAMPLES.get(claim.key, "4" if claim.kind == "count" else "true")
        text = f"{claim.text} It is claimed as {claim.values.replace('`', '')}."
        yield Key(f"{claim.key}: {example}", _KINDS[claim.kind], text, is_listed=False)


def _read(at: Any, node: Node, where: str) -> tuple[ClaimText, ...]:
    entries = at.source.mapping(node, where, CLAIMS, form=_FORM)
    return tuple(
        ClaimText(value, key, _KINDS[definition(key).kind].read(at, value, f"{where}, {key}"))
        for key, value in entries.items()
    )


EXPECT = ValueKind(mapping(more=claims).schema, _read, claims)


OF_ORDERS = {
    *(key for key, x in ORDERS.items() if x.kind != "truth"),
    "stage-order",
    "weak-stage-order",
}
"""Claims for which the search for orders goes one beyond their numbers."""


def highest_order(claims: tuple[ClaimText, ...], keys: Collection[str] = OF_ORDERS) -> int:
    return max([_largest(claim.value) for claim in claims if claim.key in keys], default=0)


def _largest(wanted: object) -> int:
    if isinstance(wanted, list):
        return max(map(_largest, wanted), default=0)
    least = wanted.least if isinstance(wanted, AtLeast) else wanted
    return least if isinstance(least, int) else 0
