"""``tolerance``: the errors of the numbers of a file, for all alike or by their places."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.errors import LimitExceeded
from garkcli.exact.expression import read_decimal
from garkcli.exact.field import ZERO
from garkcli.frozen import FrozenBut
from garkcli.grammar.keys import Key, Schema, ValueKind
from garkcli.grammar.nodes import MappingNode, Node, key_nodes, shortened
from garkcli.methodfile.numbers import Coefficient
from garkcli.methodfile.parameters import NUMBER
from garkcli.methodfile.printed import coarsest_unit

DIGITS = "digits"
"""The word for decimals that are within one unit of their last digit."""
OTHERS = "others"
"""The key for all numbers without a key of their own."""
Off: TypeAlias = "fmpq | str"

_DECIMAL = r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?"
_FORM = "write for instance {others: 1e-20, embedded: 1e-12}"


class Tolerance(FrozenBut):
    """The roundings by the keys of the file; ``places`` are their nodes."""

    besides = frozenset({"places"})

    offs: Mapping[str, Off]
    places: Mapping[str, Node]

    def __hash__(self) -> int:
        return hash(frozenset(self.offs.items()))

    @property
    def is_single(self) -> bool:
        return not self.places and not self.is_of_digits

    @property
    def is_of_digits(self) -> bool:
        return DIGITS in self.offs.values()

    def largest(self, entries: Iterable[Coefficient]) -> fmpq:
        offs = [x for x in self.offs.values() if isinstance(x, fmpq)]
        if self.is_of_digits:
            offs.append(coarsest_unit([x.expression for x in entries]))
        return max(offs, default=ZERO)


def same_for_all(off: Off) -> Tolerance:
    return Tolerance({OTHERS: off}, {})


def _off(at: Any, node: Node, where: str) -> Off | None:
    """Reads a number between 0 and 1, which may not contain parameters, or the word."""
    text: str | None = at.source.scalar(node, where)
    if text is None or text == DIGITS:
        return text
    try:
        value = read_decimal(text) if re.fullmatch(_DECIMAL, text, re.ASCII) else None
    except LimitExceeded:
        value = None
    if value is not None and 0 < value < 1:
        return value
    message = f"{where}: a decimal number between 0 and 1 is expected, not {shortened(text)}"
    cure = f"for instance 1e-13; or {DIGITS}, for a unit of the last digit of each decimal"
    at.source.fault(node, message, cure, code="wrong-value")
    return None


def _read(at: Any, node: Node, where: str) -> Tolerance | None:
    if not isinstance(node, MappingNode):
        off = _off(at, node, where)
        return None if off is None else same_for_all(off)
    entries = at.source.mapping(node, where, (), form=_FORM)
    if not entries and not at.source.faults:
        at.source.fault(node, f"{where} is empty", _FORM, code="empty")
    offs = {key: _off(at, value, f"{where}, {key}") for key, value in entries.items()}
    known = {key: off for key, off in offs.items() if off is not None}
    return Tolerance(known, key_nodes(node)) if known else None


def _schema() -> Schema:
    off: Schema = {"anyOf": [NUMBER.schema(), {"const": DIGITS}]}
    named = {key.name: key.schema() for key in _INSIDE}
    by_place: Schema = {"type": "object", "minProperties": 1, "properties": named}
    return {"anyOf": [*off["anyOf"], {**by_place, "additionalProperties": off}]}


_OFF = ValueKind(lambda: {"anyOf": [NUMBER.schema(), {"const": DIGITS}]}, _off)
_INSIDE = (
    Key(
        f"{OTHERS}: 1e-20",
        _OFF,
        "The tolerance of all numbers that no other key is about; without it they are exact.",
    ),
    Key("embedded: 1e-12", _OFF, "The tolerance of embedded weights."),
    Key("dense: 1e-8", _OFF, "The tolerance of the coefficients of dense output."),
)
KIND = ValueKind(_schema, _read, lambda: _INSIDE)
