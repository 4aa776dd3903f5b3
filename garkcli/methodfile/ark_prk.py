"""YAML nodes to the forms ``ark`` and ``prk``, whose colours share stages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeAlias

from yaml.nodes import Node, SequenceNode

from garkcli.errors import counted
from garkcli.methodfile.description import ArkText, ButcherText, PrkText, Structure, of_colour
from garkcli.methodfile.further import FurtherReader, names_beside
from garkcli.methodfile.grammar import Found, Key, Kind, defined, mapping
from garkcli.methodfile.nodes import key_nodes
from garkcli.methodfile.numbers import Numbers, Row, Rows
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.spelled_out import (
    BUTCHER,
    EXAMPLE,
    Weights,
    are_too_many,
    depth_of_lists,
    entries_in,
    rows_of,
    with_coefficients,
)

Matrices: TypeAlias = tuple[Rows, ...]
"""A matrix a colour."""
_FORM_OF_PRK = "give q: {A, b} and p: {A, b}"
_ROW = defined("row").schema()
_ROWS = Kind(lambda: {"anyOf": [_ROW, {"type": "array", "items": _ROW}]})
ARK = with_coefficients(
    Key(
        "A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]]",
        Kind(lambda: rows_of(defined("matrix").schema())),
        "One matrix a colour, all of the same size.",
    ),
    Key("b: [0, 1]", _ROWS, "The weights: one row a colour, or a single shared row."),
    Key(
        "c: [0, 1]",
        defined("row"),
        "The nodes, which all colours share; the row sums of the first matrix where left out.",
    ),
    Key("embedded: [1, 0]", _ROWS, "Embedded weights: one row a colour, or a single shared row."),
    Key(
        "dense: {degree: 1, weights: [[[0], [1]], [[0], [1]]]}",
        defined("dense"),
        "Dense output: a block of polynomials a colour.",
    ),
    form=EXAMPLE,
)
"""An additive method: its colours share their stages."""
PRK = mapping(
    Key(
        "q: {A: [[0], [1]], b: [1]}",
        defined("butcher"),
        "The tableau of the positions: A has a row for each node at which the force is taken and "
        "a column for each velocity, b weighs the velocities.",
        is_needed=True,
    ),
    Key(
        "p: {A: [[1/2, 0]], b: [1/2, 1/2]}",
        defined("butcher"),
        "The tableau of the momenta: A has a row for each velocity and a column for each force, "
        "b weighs the forces.",
        is_needed=True,
    ),
    form=_FORM_OF_PRK,
)
"""A partitioned method: a tableau for the positions, one for the momenta."""


class ArkReader:
    """Reads an additive method of one file: a matrix a colour on one set of stages."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers
        self.further = FurtherReader(source, numbers)

    def read(self, node: Node) -> ArkText | None:
        """The form ``ark``; None where it does not make a method."""
        source = self.source
        entries: Found | None = ARK.read(self, node, "ark")
        if entries is None or not {"A", "b"} <= entries.keys():
            return None
        matrices = self._matrices(entries["A"])
        if matrices is None:
            return None
        colours = len(matrices)
        b = self._weights(entries["b"], colours)
        c = None
        if "c" in entries:
            c = self.numbers.row(entries["c"], "c")
        if len(b) != colours:
            found = counted(len(b), "row")
            wanted = counted(colours, "colour")
            message = f"b has {found} for {wanted}"
            cure = "give a row a colour, or a single shared row"
            source.fault(entries["b"], message, cure, code="wrong-size")
            return None
        if not matrices or not all(matrices) or not all(b):
            return None
        stages = len(matrices[0])
        A = self._fitted(matrices, entries["A"], stages)
        self._check_lengths(entries, b, c, stages)
        everywhere = [stages] * colours
        beside = self.further.of_colours(entries, everywhere, is_shared=True)
        return ArkText(A, b, c, beside)

    def _matrices(self, node: Node) -> Matrices | None:
        """The matrices as they stand; None where A is no list of matrices."""
        source = self.source
        items = source.items(node, "A")
        if are_too_many(source, items, node):
            return None
        if isinstance(node, SequenceNode) and not items:
            source.fault(node, "A is empty", "give a matrix a colour", code="empty")
        if items and depth_of_lists(node) == 2:
            message = "A is one matrix, and an ark has one a colour"
            cure = "write A: [AE, AI]; or tableau: for one colour"
            source.fault(node, message, cure, code="wrong-size")
            return None
        matrices: list[Rows] = []
        for m, item in enumerate(items):
            matrices.append(self.numbers.matrix(item, of_colour("A", m)))
        return tuple(matrices)

    def _fitted(self, matrices: Matrices, node: Node, stages: int) -> Matrices:
        """The matrices, each as large as the first."""
        shape = (stages, stages)
        why = "the colours of an ark share stages"
        items = node.value
        fitted: list[Rows] = []
        for m, rows in enumerate(matrices):
            where = of_colour("A", m)
            A = self.numbers.fitted(rows, items[m], where, shape, why)
            fitted.append(A)
        return tuple(fitted)

    def _weights(self, node: Node, colours: int) -> Weights:
        """The weights of each colour; the same row for all where there is a single one."""
        items = self.source.items(node, "b")
        if not any(isinstance(item, SequenceNode) for item in items):
            return (self.numbers.row(node, "b"),) * colours
        rows: list[Row] = []
        for m, item in enumerate(items):
            rows.append(self.numbers.row(item, of_colour("b", m)))
        return tuple(rows)

    def _check_lengths(self, entries: Entries, b: Weights, c: Row | None, stages: int) -> None:
        """Note weights and nodes that are not one a stage."""
        wanted = counted(stages, "stage")
        for name, row in _rows_of_weights(b):
            if len(row) != stages:
                found = entries_in(len(row))
                message = f"{name} has {found} for {wanted}"
                cure = "give a weight a stage"
                self.source.fault(entries["b"], message, cure, code="wrong-size")
        if c is not None and len(c) != stages:
            found = entries_in(len(c))
            message = f"c has {found} for {wanted}"
            cure = "give a node a stage, or leave c out"
            self.source.fault(entries["c"], message, cure, code="wrong-size")


def _rows_of_weights(b: Weights) -> Iterator[tuple[str, Row]]:
    """The rows of weights with what they are called; a shared row once."""
    is_shared = all(row is b[0] for row in b)
    if is_shared:
        yield "b", b[0]
        return
    for m, row in enumerate(b):
        yield of_colour("b", m), row


class PrkReader:
    """Reads a partitioned method of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers
        self.further = FurtherReader(source, numbers)

    def read(self, node: Node, structure: Structure) -> PrkText | None:
        """The form ``prk``; its blocks are rectangular unless the structure is general."""
        source = self.source
        entries: Found | None = PRK.read(self, node, "prk")
        if entries is None or len(entries) < 2:
            return None
        q = self._part(entries["q"], "q")
        p = self._part(entries["p"], "p")
        if q is None or p is None:
            return None
        # the velocity stages belong to the weights of q, the force stages to those of p
        s_v, s_f = len(q.b), len(p.b)
        if structure == "general" and s_v != s_f:
            found = counted(s_v, "weight")
            message = f"prk: q has {found} and p has {s_f}"
            cure = "a general problem needs one set of stages; or structure: separable"
            source.fault(node, message, cure, code="wrong-size")
            return None
        why = f"q.b has {entries_in(s_v)} and p.b has {s_f}"
        both = (q.further, p.further)
        self.further.refuse_partial(both, ("q", "p"), node)
        q = self._fitted(q, "q", (s_f, s_v), why)
        p = self._fitted(p, "p", (s_v, s_f), why)
        return PrkText(q, p)

    def _part(self, node: Node, part: str) -> ButcherText | None:
        """Q or p of a prk, its sizes not yet looked at."""
        entries: Found | None = BUTCHER.read(self, node, f"prk, {part}")
        if entries is None or not {"A", "b"} <= entries.keys():
            return None
        A = self.numbers.matrix(entries["A"], f"{part}.A")
        b = self.numbers.row(entries["b"], f"{part}.b")
        c = None
        if "c" in entries:
            c = self.numbers.row(entries["c"], f"{part}.c")
        if not A or not b:
            return None
        names = names_beside(f"{part}.b")
        beside = self.further.of_method(entries, len(b), names)
        return ButcherText(node, entries.get("name", ""), A, b, c, beside)

    def _fitted(
        self, text: ButcherText, part: str, shape: tuple[int, int], why: str
    ) -> ButcherText:
        """A part whose matrix has the shape that the weights of both ask for."""
        keys = key_nodes(text.node)
        place = keys.get("A", text.node)
        where = f"{part}.A"
        A = self.numbers.fitted(text.A, place, where, shape, why)
        rows, _ = shape
        if text.c is not None and len(text.c) != rows:
            found = entries_in(len(text.c))
            message = f"{part}.c has {found} for {counted(rows, 'node')}"
            place = keys.get("c", text.node)
            self.source.fault(place, message, "give one of each", code="wrong-size")
        return replace(text, A=A)
