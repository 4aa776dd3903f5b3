"""``unknown`` of a method file: a tableau that is said by its stages and its shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from yaml.nodes import Node, SequenceNode

from garkcli.errors import MethodError, did_you_mean
from garkcli.exact.nodes import Expression, Name
from garkcli.methodfile.description import (
    ArkText,
    ButcherText,
    Form,
    PrkText,
    TableauText,
    of_colour,
)
from garkcli.methodfile.numbers import Free, Numbers, Row, Rows
from garkcli.methodfile.shapes.layout import Layout, Texts
from garkcli.methodfile.shapes.registry import SHAPES, layout_of
from garkcli.methodfile.source import Source

FORM = "write unknown: {stages: 3, shape: sdirk}"
MAX_STAGES = 20
"""Most stages of a tableau of unknowns; twelve unknowns without structure are too many."""


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
    place: tuple[int, int]


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
        entries = self.source.mapping(
            node, "unknown", ("stages", "shape"), form=FORM
        )
        missing = [name for name in ("stages", "shape") if name not in entries]
        if missing:
            message = f"unknown: {' and '.join(missing)} missing"
            if not self.source.faults:
                self.source.fault(node, message, FORM)
            return None
        stages = self.source.whole(
            entries["stages"], "unknown, stages", smallest=1
        )
        names = self._names(entries["shape"])
        if stages is None or not names:
            return None
        if stages > MAX_STAGES:
            message = f"{stages} stages of unknowns (limit {MAX_STAGES})"
            self.source.fault(entries["stages"], message, "use fewer stages")
            return None
        try:
            layout = layout_of(stages, names)
        except MethodError as error:
            self.source.fault(entries["shape"], error.message, error.help)
            return None
        for name in layout.unknowns:
            self._define(name, node)
        start, end = key.start_mark.index, node.end_mark.index
        text = self.source.text[start:end].rstrip()
        place = start, start + len(text)
        return Shaped(layout.kind, self._content(layout, node), layout, place)

    def _names(self, node: Node) -> list[str]:
        """The shapes, one word or several in a list."""
        items = node.value if isinstance(node, SequenceNode) else [node]
        names: list[str] = []
        for item in items:
            word = self.source.scalar(item, "unknown, shape")
            if word is None:
                return []
            if word not in SHAPES:
                cure = did_you_mean(word, SHAPES)
                self.source.fault(
                    item, f"unknown, shape: {word} is no shape", cure
                )
                return []
            names.append(word)
        if not names:
            self.source.fault(node, "unknown, shape is empty", FORM)
        return names

    def _define(self, name: str, node: Node) -> None:
        """An unknown of the shape, or the value given for it."""
        if name in self.numbers.settings:
            value: Expression = self.numbers.given(name, node, name)
        else:
            value = Name(name)
            self.numbers.free[name] = Free(node, where=name)
        self.numbers.define(name, value)

    def _content(
        self, layout: Layout, node: Node
    ) -> TableauText | ArkText | PrkText:
        matrices: list[Rows] = []
        for colour, texts in enumerate(layout.A):
            matrices.append(self._matrix(texts, node, of_colour("A", colour)))
        weights: list[Row] = []
        for colour, row in enumerate(layout.b):
            weights.append(self._row(row, node, of_colour("b", colour)))
        if layout.kind == "prk":
            q, p = (
                ButcherText(node, "", A, b, None)
                for A, b in zip(matrices, weights, strict=True)
            )
            return PrkText(q, p)
        if layout.kind == "ark":
            return ArkText(
                tuple(matrices), (weights[0],) * len(matrices), None
            )
        return TableauText(((matrices[0],),), (weights[0],), (None,), ())

    def _matrix(self, texts: Texts, node: Node, where: str) -> Rows:
        rows = []
        for i, row in enumerate(texts, start=1):
            rows.append(self._row(row, node, f"{where}, row {i}"))
        return tuple(rows)

    def _row(self, texts: Sequence[str], node: Node, where: str) -> Row:
        entries = []
        for j, text in enumerate(texts, start=1):
            entries.append(
                self.numbers.written(text, node, f"{where}, entry {j}")
            )
        return tuple(entries)


def spelled(layout: Layout) -> str:
    """The layout as keys of a method file."""
    if layout.kind == "prk":
        parts = []
        for name, rows, weights in zip("qp", layout.A, layout.b, strict=True):
            parts.append(
                f"  {name}: {{A: {_matrix_text(rows)}, b: {_row_text(weights)}}}"
            )
        return "\n".join(["prk:", *parts])
    b = _row_text(layout.b[0])
    if layout.kind == "ark":
        matrices = ", ".join(_matrix_text(rows) for rows in layout.A)
        return f"ark:\n  A: [{matrices}]\n  b: {b}"
    return f"A: {_matrix_text(layout.A[0])}\nb: {b}"


def _matrix_text(rows: Texts) -> str:
    inside = ", ".join(map(_row_text, rows))
    return f"[{inside}]"


def _row_text(row: Sequence[str]) -> str:
    inside = ", ".join(row)
    return f"[{inside}]"
