"""The tolerance of each number of a file, by its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import did_you_mean
from garkcli.exact.field import ZERO
from garkcli.exact.nodes import Expression
from garkcli.grammar.nodes import Node, shortened
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import Coefficient, Row, Rows
from garkcli.methodfile.printed import fewest_digits, unit_of
from garkcli.methodfile.tolerance import DIGITS, OTHERS, Tolerance


class NumberTolerances:
    """The tolerances of the numbers of a file.

    A number has the tolerance of embedded weights or of dense output, if it is one; otherwise that
    of its colour; otherwise that of the others; otherwise it is exact.
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
