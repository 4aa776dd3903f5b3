"""The claims of a file: reading ``expect``."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from yaml.nodes import Node, ScalarNode, SequenceNode

from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.nodes import is_null
from garkcli.methodfile.source import Source
from garkcli.methodfile.words import shortened
from garkcli.properties.keys import KEYS

if TYPE_CHECKING:
    from garkcli.methodfile.measures import Measure
    from garkcli.properties.property import Kind

NUMBERS = (
    "order",
    "conjugate-order",
    "pair-order",
    "bound",
    "pair-bound",
    "sharp-bound",
    "pair-sharp-bound",
    "nonautonomous-order",
    "embedded-order",
    "embedded-nonautonomous-order",
    "dense-order",
)
TRUTHS = ("symplectic", "dense-continuous", "dense-smooth")
TABLES = ("B", "C", "D")
CLAIMS = (*NUMBERS, *TABLES, *TRUTHS, *KEYS)
"""Everything a file may claim."""
_FORM = "write for instance expect: {order: 4}"
_AT_LEAST = re.compile(r">=\s*([0-9]{1,4})")


@dataclass(frozen=True)
class AtLeast:
    """A claim ``>= least``."""

    least: int

    def __str__(self) -> str:
        return f">= {self.least}"


Wanted: TypeAlias = "int | AtLeast | bool | Measure | list[Wanted] | None"


def read(source: Source, node: Node | None) -> tuple[ClaimText, ...]:
    """The claims of ``expect``; faulty ones are noted."""
    if node is None:
        return ()
    claims = []
    for key, value_node in source.mapping(node, "expect", CLAIMS, form=_FORM).items():
        where = f"expect, {key}"
        wanted: Wanted
        if key in TABLES:
            wanted = _table(source, value_node, where, depth=1 if key == "B" else 2)
        else:
            wanted = _READERS[_kind(key)](source, value_node, where)
        claims.append(ClaimText(value_node, key, wanted))
    return tuple(claims)


def _kind(key: str) -> Kind:
    """What a claim is made with."""
    if key in NUMBERS:
        return "count"
    if key not in KEYS:
        return "truth"
    from garkcli.properties.registry import find  # few files claim properties

    return find(key).kind


def _truth(source: Source, node: Node, where: str) -> Wanted:
    return source.choice(node, where, ("true", "false")) == "true"


def _measure(source: Source, node: Node, where: str) -> Wanted:
    from garkcli.methodfile.measures import read_measure

    return read_measure(source, node, where)


def _number(source: Source, node: Node, where: str) -> Wanted:
    text = source.scalar(node, where) or ""
    at_least = _AT_LEAST.fullmatch(text)
    if at_least:
        return AtLeast(int(at_least[1]))
    if text.isascii() and text.isdigit() and len(text) < 5:
        return int(text)
    if isinstance(node, ScalarNode):
        message = f'{where}: a number or ">= n" is expected, not {shortened(text)}'
        source.fault(node, message, 'for instance order: 4, or order: ">= 4"')
    return None


_READERS: dict[Kind, Callable[[Source, Node, str], Wanted]] = {
    "truth": _truth,
    "count": _number,
    "number": _measure,
}


def _table(source: Source, node: Node, where: str, depth: int) -> Wanted:
    if not isinstance(node, SequenceNode):
        source.fault(
            node, f"{where}: a list is expected", "one number a colour, for C and D a row a colour"
        )
        return None
    if depth > 1:
        return [_table(source, item, where, depth - 1) for item in node.value]
    return [None if is_null(item) else _number(source, item, where) for item in node.value]


_OF_ORDERS = {*NUMBERS, *TABLES, "stage-order"}
"""Claims for which orders must be looked for as far as their numbers, and one further."""


def highest_order(claims: tuple[ClaimText, ...]) -> int:
    """The largest order that occurs in the claims."""
    found = [_largest(claim.value) for claim in claims if claim.key in _OF_ORDERS]
    return max(found, default=0)


def _largest(wanted: object) -> int:
    if isinstance(wanted, list):
        return max((_largest(x) for x in wanted), default=0)
    if isinstance(wanted, AtLeast):
        return wanted.least
    return wanted if isinstance(wanted, int) else 0
