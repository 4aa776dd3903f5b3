"""``tolerance``: the errors of the numbers of a file, for all alike or by their places."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.errors import LimitExceeded, did_you_mean
from garkcli.exact.expression import read_decimal
from garkcli.exact.field import ZERO
from garkcli.exact.nodes import Expression
from garkcli.frozen import FrozenBut
from garkcli.grammar.keys import Key, Schema, ValueKind
from garkcli.grammar.nodes import MappingNode, Node, key_nodes, shortened
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import Coefficient, Row, Rows
from garkcli.methodfile.parameters import NUMBER
from garkcli.methodfile.printed import coarsest_unit, fewest_digits, unit_of

DIGITS = "digits"
"""Each decimal is within one unit of its last digit."""
OTHERS = "others"
"""The key for all numbers without a key of their own."""
Off: TypeAlias = "fmpq | str"
"""A tolerance: a number, or ``DIGITS``."""

_DECIMAL = r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?"
_FORM = "write for instance {others: 1e-20, embedded: 1e-12}"


class Tolerance(FrozenBut):
    """The tolerances of a file by the places of its numbers.

    The keys are ``others``, ``embedded``, ``dense``, and colours by number or name; ``places`` are
    their nodes, none for one tolerance for all.
    """

    besides = frozenset({"places"})

    offs: Mapping[str, Off]
    places: Mapping[str, Node]

    def __hash__(self) -> int:
        return hash(frozenset(self.offs.items()))

    @property
    def is_single(self) -> bool:
        """Whether there is one number for the whole file."""
        return not self.places and not self.is_of_digits

    @property
    def is_of_digits(self) -> bool:
        """Whether some tolerances depend on the last digits."""
        return DIGITS in self.offs.values()


def same_for_all(off: Off) -> Tolerance:
    return Tolerance({OTHERS: off}, {})


def largest(tolerance: Tolerance, entries: Iterable[Coefficient]) -> fmpq:
    """Returns the largest tolerance of some entries."""
    offs = [x for x in tolerance.offs.values() if isinstance(x, fmpq)]
    if tolerance.is_of_digits:
        offs.append(coarsest_unit([x.expression for x in entries]))
    return max(offs, default=ZERO)


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


class NumberTolerances:
    """The tolerances of the numbers of a file.

    A number has the tolerance of embedded weights or of dense output, if it is one; otherwise that
    of its colour; otherwise that of the others; otherwise it is exact.

    ``largest`` is the largest of them.
    """

    def __init__(
        self, tolerance: Tolerance, content: d.Content, entries: Sequence[Coefficient]
    ) -> None:
        self.tolerance = tolerance
        self.names = _names(content)
        self._kinds: dict[int, str] = {}
        self._keys: dict[int, str] = {}
        for kind, l, entry in _places(content):
            self._kinds[id(entry)] = kind
            own = [kind, *self.names[l]] if l is not None else [kind]
            self._keys[id(entry)] = next((x for x in own if x in tolerance.offs), OTHERS)
        self._fewest = fewest_digits(x.expression for x in entries) if tolerance.is_of_digits else 0
        self.largest = largest(tolerance, entries)

    def kind_of(self, entry: Coefficient) -> str:
        """Returns whether a number is in embedded weights or in dense output; empty for A, b and
        c.
        """
        return self._kinds.get(id(entry), "")

    def key_of(self, entry: Coefficient) -> str:
        """Returns the key of ``tolerance`` that applies to a number."""
        return self._keys.get(id(entry), OTHERS)

    def radius(self, entry: Coefficient, part: Expression) -> fmpq:
        """Returns the tolerance of a number in an entry; 0 if it is exact."""
        off = self.tolerance.offs.get(self.key_of(entry), ZERO)
        if isinstance(off, fmpq):
            return off
        return unit_of(part, self._fewest)

    def refusals(self, used: Iterable[str]) -> Iterator[tuple[Node | None, str, str, str]]:
        """Yields the faults of the keys: node, message, cure and kind of fault.

        ``used`` has the keys that apply to some rounded number.
        """
        known = [OTHERS, *d.BESIDE, *(name for names in self.names for name in names)]
        for key, node in self.tolerance.places.items():
            if key not in known:
                message = f"tolerance: the method has no part {shortened(key)}"
                yield node, message, did_you_mean(key, known), "unknown-key"
            elif l := self._named_like(key):
                message = f"tolerance: {key} may mean colour {l}, whose method has this name"
                yield node, message, "give the method another name", "name-taken"
            elif key in self.tolerance.offs and key not in used:
                message = f"tolerance: {key} has no rounded number"
                yield node, message, "leave it out: short fractions and roots are exact", "empty"
        if self.tolerance.offs == {OTHERS: DIGITS} and OTHERS not in used:
            message = "tolerance: digits is about decimals, and the file has none"
            yield None, message, "leave it out, or write a number such as 1e-13", "empty"

    def _named_like(self, key: str) -> int | None:
        """Returns the colour, counted from 1, whose name is a key with another meaning."""
        taken = {OTHERS, *d.BESIDE, *(x for names in self.names for x in names[:1])}
        named = (l for l, names in enumerate(self.names, start=1) if key in names[1:])
        return next((l for l in named if key in taken and key != str(l)), None)


def _names(content: d.Content) -> list[tuple[str, ...]]:
    """Returns the names of each colour in the file: its number, and its name if it has one."""
    match content:
        case d.MethodsText(methods=methods):
            names = [x.name if isinstance(x, d.ButcherText) else "" for x in methods]
        case d.PrkText():
            names = ["q", "p"]
        case d.TableauText(b=b) | d.ArkText(b=b):
            names = [""] * len(b)
        case d.RosenbrockText(b=b) if len(b) > 1:
            names = [""] * len(b)
        case d.RegistersText() | d.RosenbrockText() | d.NystromText():
            return [()]
        case d.NprkText() | d.DerivativesText():
            return [()]
        case _:
            return []
    return [(str(l), name) if name else (str(l),) for l, name in enumerate(names, start=1)]


_Place: TypeAlias = tuple[str, "int | None", Coefficient]
"""A number: ``embedded``, ``dense`` or empty; its colour from 0, or None; its entry."""


def _places(content: d.Content) -> Iterator[_Place]:
    """Yields the numbers that belong to a colour, or to further weights.

    A^{l,m} belongs to colour l, but A^{m} of colours with shared stages to colour m.
    """
    match content:
        case d.MethodsText(methods=methods, transfer=transfer):
            for l, method in enumerate(methods):
                if isinstance(method, d.ButcherText):
                    yield from _of_butcher(method, l)
                else:
                    yield from _of_rows([method.numbers], l)
                    yield from _of_further(method.further, l)
            for (l, _), block in transfer.blocks.items():
                if isinstance(block, d.MatrixText):
                    yield from _of_rows(block.rows, l)
        case d.PrkText(q=q, p=p):
            yield from _of_butcher(q, 0)
            yield from _of_butcher(p, 1)
        case d.TableauText():
            for l, blocks in enumerate(content.A):
                for block_rows in blocks:
                    yield from _of_rows(block_rows or (), l)
                yield from _of_rows([content.b[l], content.c[l] or ()], l)
        case d.ArkText():
            for m, rows in enumerate(content.A):
                yield from _of_rows([*rows, content.b[m]], m)
        case d.RosenbrockText(b=weights, error=error):
            yield from _of_rows([error or ()], 0, "embedded")
            for l in range(len(weights) if len(weights) > 1 else 0):
                for of_colours in (content.alpha, content.gamma):
                    yield from _of_rows(chain.from_iterable(of_colours[l]), l)
                others = (x[l] for x in (content.c, content.d) if x is not None)
                yield from _of_rows([weights[l], *others], l)
        case d.NprkText() | d.DerivativesText():
            yield from _of_rows(content.embedded or (), 0, "embedded")
        case d.NystromText():
            for row in content.embedded or ():
                yield from _of_rows([row or ()], 0, "embedded")
            for polynomials in content.dense or ():
                yield from _of_rows(polynomials or (), 0, "dense")
    if isinstance(content, d.TableauText | d.ArkText | d.RegistersText | d.RosenbrockText):
        for l, further in enumerate(content.further):
            yield from _of_further(further, l)


def _of_butcher(text: d.ButcherText, l: int) -> Iterator[_Place]:
    yield from _of_rows([*text.A, text.b, text.c or ()], l)
    yield from _of_further(text.further, l)


def _of_rows(rows: Iterable[Row], l: int, kind: str = "") -> Iterator[_Place]:
    for row in rows:
        for entry in row:
            yield kind, l, entry


def _of_further(text: d.FurtherText, l: int) -> Iterator[_Place]:
    dense: Rows = text.dense or ()
    yield from _of_rows([text.embedded or ()], l, "embedded")
    yield from _of_rows(dense, l, "dense")
