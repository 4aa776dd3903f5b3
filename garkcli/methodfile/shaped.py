"""``unknown`` of a method file: a tableau that is said by its stages and its shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from yaml.nodes import Node

from garkcli.errors import MethodError, did_you_mean
from garkcli.exact.nodes import Expression, Name
from garkcli.methodfile.description import (
    NOTHING_FURTHER,
    ArkText,
    ButcherText,
    Form,
    PrkText,
    TableauText,
    of_colour,
)
from garkcli.methodfile.grammar import Found, Key, Kind, count, mapping, one_or_more, word
from garkcli.methodfile.nodes import Extent, extent
from garkcli.methodfile.numbers import Free, Numbers, Row, Rows
from garkcli.methodfile.shapes import SHAPES, Layout, Texts, layout_of
from garkcli.methodfile.source import Source
from garkcli.methodfile.words import shortened

FORM = "write unknown: {stages: 3, shape: sdirk}"
MAX_STAGES = 20
"""Most stages of a tableau of unknowns; twelve unknowns without structure are too many."""


def _shape(at: Any, node: Node, where: str) -> str | None:
    name: str | None = at.source.scalar(node, where)
    if name is None or name in SHAPES:
        return name
    at.source.fault(
        node,
        f"{where}: {shortened(name)} is no shape",
        did_you_mean(name, SHAPES),
        code="unknown-word",
    )
    return None


_SHAPE = Kind(word(lambda: {name: x.summary for name, x in SHAPES.items()}).schema, _shape)
UNKNOWN = mapping(
    Key(
        "stages: 3",
        Kind(count(1, MAX_STAGES).schema, count(1).read),
        "How many stages the tableau of unknowns has.",
        is_needed=True,
    ),
    Key(
        "shape: [dirk, stiffly-accurate]",
        one_or_more(_SHAPE),
        "Which entries are unknown and how they hang together: a shape, or several that go "
        "together.",
        is_needed=True,
    ),
    form=FORM,
)
"""How many stages, and which shape."""


@dataclass(frozen=True)
class Shaped:
    """What ``unknown`` stands for.

    Attributes:
        form: of the method file that says the same.
        content: its coefficients.
        layout: the same as text.
        place: from where to where in the file ``unknown: …`` stands.
    """

    form: Form
    content: TableauText | ArkText | PrkText
    layout: Layout
    place: Extent


class ShapeReader:
    """Reads ``unknown`` of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def read(self, key: Node, node: Node) -> Shaped | None:
        """The tableau of unknowns; None, with faults noted, where there is none.

        Args:
            key: the word ``unknown`` in the file.
            node: its value.
        """
        found: Found | None = UNKNOWN.read(self, node, "unknown")
        if found is None or not found.is_right:
            return None
        if found["stages"] > MAX_STAGES:
            message = f"{found['stages']} stages of unknowns (limit {MAX_STAGES})"
            self.source.fault(found.nodes["stages"], message, "use fewer stages", code="too-many")
            return None
        try:
            layout = layout_of(found["stages"], found["shape"])
        except MethodError as error:
            self.source.fault(found.nodes["shape"], error.message, error.help, code=error.code)
            return None
        for name in layout.unknowns:
            self._define(name, node)
        place = extent(self.source.text, key, node)
        return Shaped(layout.kind, self._content(layout, node), layout, place)

    def _define(self, name: str, node: Node) -> None:
        """An unknown of the shape, or the value given for it."""
        if name in self.numbers.settings:
            value: Expression = self.numbers.given(name, node, name)
        else:
            value = Name(name)
            self.numbers.free[name] = Free(node, where=name)
        self.numbers.define(name, value)

    def _content(self, layout: Layout, node: Node) -> TableauText | ArkText | PrkText:
        matrices: list[Rows] = []
        for colour, texts in enumerate(layout.A):
            where = of_colour("A", colour)
            matrices.append(self._matrix(texts, node, where))
        weights: list[Row] = []
        for colour, row in enumerate(layout.b):
            where = of_colour("b", colour)
            weights.append(self._row(row, node, where))
        A, b = matrices[0], weights[0]
        if layout.kind == "prk":
            q = ButcherText(node, "", A, b, None)
            p = ButcherText(node, "", matrices[1], weights[1], None)
            return PrkText(q, p)
        if layout.kind == "ark":
            shared = (b,) * len(matrices)
            further = (NOTHING_FURTHER,) * len(matrices)
            return ArkText(tuple(matrices), shared, None, further)
        return TableauText(((A,),), (b,), (None,), (), (NOTHING_FURTHER,))

    def _matrix(self, texts: Texts, node: Node, where: str) -> Rows:
        rows = []
        for i, row in enumerate(texts, start=1):
            place = f"{where}, row {i}"
            rows.append(self._row(row, node, place))
        return tuple(rows)

    def _row(self, texts: Sequence[str], node: Node, where: str) -> Row:
        entries = []
        for j, text in enumerate(texts, start=1):
            place = f"{where}, entry {j}"
            entries.append(self.numbers.written(text, node, place))
        return tuple(entries)


def spelled(layout: Layout) -> str:
    """The layout as keys of a method file."""
    matrices = [_matrix_text(rows) for rows in layout.A]
    weights = [_row_text(row) for row in layout.b]
    A, b = matrices[0], weights[0]
    if layout.kind == "prk":
        lines = ["prk:"]
        for part, A, b in zip("qp", matrices, weights, strict=True):
            lines.append(f"  {part}: {{A: {A}, b: {b}}}")
        return "\n".join(lines)
    if layout.kind == "ark":
        inside = ", ".join(matrices)
        return f"ark:\n  A: [{inside}]\n  b: {b}"
    return f"A: {A}\nb: {b}"


def _matrix_text(rows: Texts) -> str:
    inside = ", ".join(map(_row_text, rows))
    return f"[{inside}]"


def _row_text(row: Sequence[str]) -> str:
    inside = ", ".join(row)
    return f"[{inside}]"
