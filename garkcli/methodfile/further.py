"""YAML nodes to further weights: ``embedded`` and ``dense``, which stand beside b in every form."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from yaml.nodes import Node, SequenceNode

from garkcli.errors import counted
from garkcli.methodfile.description import BESIDE, NOTHING_FURTHER, FurtherText, of_colour
from garkcli.methodfile.grammar import Found, Key, Kind, count, mapping
from garkcli.methodfile.numbers import Numbers, Row, Rows
from garkcli.methodfile.source import Entries, Source

MAX_DEGREE = 60
"""Largest degree of dense output; its order is no larger."""
FORM_OF_DENSE = "write dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}, "
FORM_OF_DENSE += "a row a stage: the coefficients of θ, θ², …"
DENSE = mapping(
    Key("degree: 2", count(1, MAX_DEGREE), "The degree of the polynomials in θ.", is_needed=True),
    Key(
        "weights: [[1, -1/2], [0, 1/2]]",
        Kind(lambda: {"type": "array", "minItems": 1}),
        "A row a stage with the coefficients of θ, θ², …; of several colours a block for each.",
        is_needed=True,
    ),
    form=FORM_OF_DENSE,
)
"""What stands under ``dense``."""


_A_ROW_A_COLOUR = "give a row a colour, each with a weight a stage"
_A_BLOCK_A_COLOUR = "give a block a colour, each with a row a stage"


def names_beside(name_of_b: str) -> tuple[str, str]:
    """What messages call embedded weights and dense output beside weights of some name.

    >>> names_beside("b^{2}"), names_beside("q.b")
    (('embedded^{2}', 'dense^{2}'), ('q.embedded', 'q.dense'))
    """
    before, _, after = name_of_b.rpartition("b")
    embedded, dense = BESIDE
    name_of_embedded = before + embedded + after
    name_of_dense = before + dense + after
    return name_of_embedded, name_of_dense


class _Colours(NamedTuple):
    """Several colours: how many stages each has, and whether one row may stand for all of them."""

    stages: Sequence[int]
    is_shared: bool


class FurtherReader:
    """Reads the further weights of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def of_method(
        self, entries: Entries, stages: int, names: tuple[str, str] = BESIDE
    ) -> FurtherText:
        """Those of one colour.

        Args:
            entries: what stands beside b.
            stages: how many weights b has.
            names: what ``embedded`` and ``dense`` are called in messages.
        """
        embedded = dense = None
        name_of_embedded, name_of_dense = names
        if "embedded" in entries:
            node = entries["embedded"]
            if not self._is_of_several(node, name_of_embedded, 2):
                embedded = self._row(node, name_of_embedded, stages)
        if "dense" in entries:
            parts = self._parts(entries["dense"], name_of_dense)
            if parts is not None:
                degree, weights = parts
                where = f"{name_of_dense}, weights"
                if not self._is_of_several(weights, where, 3):
                    dense = self._block(weights, where, stages, degree)
        return _further(entries, embedded, dense)

    def of_colours(
        self, entries: Entries, stages: Sequence[int], is_shared: bool = False
    ) -> tuple[FurtherText, ...]:
        """Those of several colours in one place.

        Args:
            entries: what stands beside b.
            stages: how many weights each colour has.
            is_shared: whether a single row, or block, may stand for every colour.
        """
        colours = _Colours(stages, is_shared)
        embedded = self._rows(entries, colours)
        dense = self._blocks(entries, colours)
        texts = []
        for row, block in zip(embedded, dense, strict=True):
            text = _further(entries, row, block)
            texts.append(text)
        return tuple(texts)

    def _rows(self, entries: Entries, colours: _Colours) -> list[Row | None]:
        """The embedded weights of each colour."""
        rows: list[Row | None] = [None] * len(colours.stages)
        if "embedded" not in entries:
            return rows
        node = entries["embedded"]
        where = "embedded"
        for l, item in self._a_colour(node, where, colours, 1):
            name = _name(node, item, where, l)
            rows[l] = self._row(item, name, colours.stages[l])
        return rows

    def _blocks(self, entries: Entries, colours: _Colours) -> list[Rows | None]:
        """The dense output of each colour."""
        blocks: list[Rows | None] = [None] * len(colours.stages)
        if "dense" not in entries:
            return blocks
        parts = self._parts(entries["dense"], "dense")
        if parts is None:
            return blocks
        degree, node = parts
        where = "dense, weights"
        for l, item in self._a_colour(node, where, colours, 2):
            name = _name(node, item, where, l)
            stages = colours.stages[l]
            blocks[l] = self._block(item, name, stages, degree)
        return blocks

    def _a_colour(
        self, node: Node, where: str, of: _Colours, depth: int
    ) -> Iterator[tuple[int, Node]]:
        """What belongs to each colour, itself ``depth`` lists deep."""
        colours = len(of.stages)
        is_one = _depth(node) == depth
        if of.is_shared and is_one:
            for l in range(colours):
                yield l, node
            return
        rows = "row" if depth == 1 else "block"
        cure = _A_ROW_A_COLOUR if depth == 1 else _A_BLOCK_A_COLOUR
        if of.is_shared:
            cure += f", or a single shared {rows}"
        items = self.source.items(node, where, cure)
        if len(items) == colours and not is_one:
            yield from enumerate(items)
        elif isinstance(node, SequenceNode):
            found = f"one {rows}" if is_one else counted(len(items), rows)
            wanted = counted(colours, "colour")
            self.source.fault(node, f"{where} has {found} for {wanted}", cure, code="wrong-size")

    def _is_of_several(self, node: Node, where: str, depth: int) -> bool:
        """Note what is written as for several colours, ``depth`` lists deep."""
        if _depth(node) != depth:
            return False
        rows = "row" if depth == 2 else "block"
        found = counted(len(node.value), rows)
        message = f"{where} has {found} in a list, for one colour"
        cure = f"write it as one {rows}, without the outer brackets"
        if len(node.value) > 1:
            cure = "a method has one of them; make another file for the other"
        self.source.fault(node, message, cure, code="wrong-size")
        return True

    def _row(self, node: Node, where: str, stages: int) -> Row | None:
        """A weight a stage."""
        row = self.numbers.row(node, where)
        if not row:
            return None
        if stages and len(row) != stages:
            found = counted(len(row), "entry", "entries")
            wanted = counted(stages, "stage")
            message = f"{where} has {found} for {wanted}"
            cure = "give a weight a stage, as in b"
            self.source.fault(node, message, cure, code="wrong-size")
        return row

    def _parts(self, node: Node, where: str) -> tuple[int, Node] | None:
        """The degree and the weights of dense output; None where one of them is missing."""
        found: Found | None = DENSE.read(self, node, where)
        if found is None or not {"degree", "weights"} <= found.keys():
            return None
        return found["degree"], found["weights"]

    def _block(self, node: Node, where: str, stages: int, degree: int) -> Rows | None:
        """A row a stage, a coefficient a power of θ."""
        rows = self.numbers.matrix(node, where)
        if not rows or not stages:
            return None
        if len(rows) != stages:
            found, wanted = counted(len(rows), "row"), counted(stages, "stage")
            message = f"{where} has {found} for {wanted}"
            cure = "give a row a stage: the coefficients of θ, θ², …"
            self.source.fault(node, message, cure, code="wrong-size")
            return None
        for i, row in enumerate(rows):
            if len(row) == degree:
                continue
            found = counted(len(row), "entry", "entries")
            message = f"{where}, row {i + 1} has {found} for degree {degree}"
            cure = "give the coefficients of θ, …, θ^degree, zeros too"
            place = node
            if isinstance(node, SequenceNode):
                place = node.value[i]
            self.source.fault(place, message, cure, code="wrong-size")
            return None
        return rows

    def refuse_partial(
        self, further: Sequence[FurtherText], names: Sequence[str], node: Node
    ) -> None:
        """Note further weights of some colours, where others have none."""
        cure = "give it in each, the weights b again where they are meant"
        for key in BESIDE:
            having: list[str] = []
            lacking: list[str] = []
            for name, text in zip(names, further, strict=True):
                is_given = getattr(text, key) is not None
                group = having if is_given else lacking
                group.append(name)
            if having and lacking:
                message = f"{key}: {having[0]} has it and {lacking[0]} does not"
                self.source.fault(node, message, cure, code="missing-key")


def _further(entries: Entries, embedded: Row | None, dense: Rows | None) -> FurtherText:
    if embedded is None and dense is None:
        return NOTHING_FURTHER
    places = [entries[key] for key in BESIDE if key in entries]
    first = places[0]
    return FurtherText(embedded, dense, first)


def _depth(node: Node) -> int:
    """How deep the lists are at their first items; a value on its own is 0 deep."""
    depth = 0
    while isinstance(node, SequenceNode) and node.value:
        depth += 1
        node = node.value[0]
    return depth


def _name(whole: Node, item: Node, where: str, l: int) -> str:
    """What the part of one colour is called; a shared one has no colour."""
    if item is whole:
        return where
    key, comma, part = where.partition(",")
    return of_colour(key, l) + comma + part
