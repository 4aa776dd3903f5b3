"""YAML nodes to methods that are spelled out: Butcher tableaus, ``tableau``, ``ark``, ``prk``."""

from __future__ import annotations

from collections.abc import Sequence

from yaml.nodes import MappingNode, Node, SequenceNode

from garkcli.errors import counted
from garkcli.methodfile.description import (
    MAX_COLOURS,
    ArkText,
    ButcherText,
    PrkText,
    Structure,
    TableauText,
)
from garkcli.methodfile.numbers import Numbers, Row, Rows
from garkcli.methodfile.source import Source, is_null, key_nodes

_ANOTHER_METHOD = "embedded weights make another method: give it a file of its own"
_CURES = dict.fromkeys(
    ("bhat", "b_hat", "bh", "b2", "b*", "b^", "btilde", "bE", "b-hat"), _ANOTHER_METHOD
) | {
    "family": "a family is listed under methods: [{family: gauss, stages: 2}]",
    "stages": "the number of entries in b says it",
    "s": "the number of entries in b says it",
    "order": "claims go under expect: {order: 4}",
}
"""What people write into a Butcher tableau besides A, b and c."""
_EXAMPLE = "give A, b and perhaps c: {A: [[0, 0], [1/2, 0]], b: [0, 1]}"
_LEVELS = "a method of one colour has A: [[…], …] and b: […], one of two A: [[A11, A12], [A21, A22]]"


def _entries(count: int) -> str:
    return counted(count, "entry", "entries")


def _depth(node: Node) -> int:
    """How deep lists are nested; a value on its own is 0 deep."""
    if not isinstance(node, SequenceNode):
        return 0
    return 1 + max((_depth(item) for item in node.value), default=0)


def _holds_a_number(node: Node) -> bool:
    """Whether anything but null stands in nested lists."""
    if isinstance(node, SequenceNode):
        return any(_holds_a_number(item) for item in node.value)
    return not is_null(node)


class SpelledOutReader:
    """Reads matrices and rows of one file and holds their sizes against each other."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def butcher(
        self, node: Node, where: str, names: tuple[str, str, str]
    ) -> ButcherText | None:
        """A method spelled out; ``names`` are what its A, b and c are called in messages."""
        keys = ("name", "A", "b", "c")
        entries = self.source.mapping(node, where, keys, _CURES, _EXAMPLE)
        if self._lacks(node, where, entries, "give family and stages, or A and b"):
            return None
        found = self._method(entries, names)
        if found is None:
            return None
        A, b, c = found
        name = (
            self.source.scalar(entries["name"], f"{where}, name")
            if "name" in entries
            else ""
        )
        return ButcherText(node, name or "", A, b, c)

    def _method(
        self, entries: dict[str, Node], names: tuple[str, str, str]
    ) -> tuple[Rows, Row, Row | None] | None:
        """A, b and c of a method of one colour; None where they do not make one."""
        numbers = self.numbers
        A = numbers.matrix(entries["A"], names[0])
        b = numbers.row(entries["b"], names[1])
        c = numbers.row(entries["c"], names[2]) if "c" in entries else None
        if not A or not b or (c is not None and not c):
            return None
        s = len(b)
        is_square = all(len(row) == len(A) for row in A)
        if is_square and len(A) != s and (c is None or len(c) == len(A)):
            # A and c agree with each other, so the mistake is in b
            message = (
                f"{names[1]} has {_entries(s)}, {names[0]} is {len(A)} by {len(A)}"
            )
            self.source.fault(entries["b"], message, "both have one a stage")
            return None
        A = numbers.fitted(
            A, entries["A"], names[0], (s, s), f"{names[1]} has {_entries(s)}"
        )
        if c is not None and len(c) != s:
            message = f"{names[2]} has {_entries(len(c))} for {counted(s, 'stage')}"
            self.source.fault(
                entries["c"], message, "give a node a stage, or leave c out"
            )
        return A, b, c

    def _lacks(
        self, node: Node, where: str, entries: dict[str, Node], cure: str
    ) -> bool:
        """Note that A or b is missing."""
        missing = [key for key in ("A", "b") if key not in entries]
        if missing and isinstance(node, MappingNode):
            self.source.fault(node, f"{where}: {' and '.join(missing)} missing", cure)
        return bool(missing)

    def tableau(self, node: Node, linear: Node | None) -> TableauText | None:
        """The form ``tableau``; ``linear`` lists its linear colours."""
        entries = self.source.mapping(
            node, "tableau", ("c", "A", "b"), _CURES, _EXAMPLE
        )
        if self._lacks(node, "tableau", entries, _EXAMPLE):
            return None
        return self.tableau_of(entries, linear)

    def tableau_of(
        self, entries: dict[str, Node], linear: Node | None
    ) -> TableauText | None:
        """A, b and c of one colour or of several, told apart by how deep A is nested."""
        depth, of_weights = _depth(entries["A"]), _depth(entries["b"])
        one_colour = depth <= 2 and (of_weights < 2 or _holds_a_number(entries["A"]))
        if one_colour and of_weights < 2 and _holds_a_number(entries["A"]):
            found = self._method(entries, ("A", "b", "c"))
            if found is None:
                return None
            A, b, c = found
            return TableauText(((A,),), (b,), (c,), self._linear(linear, 1))
        if one_colour and _holds_a_number(entries["A"]):
            message = "A is one matrix, of one colour, and b a list of rows"
            rows = len(entries["b"].value)
            cure = "write b as one row: b: [0, 1]"
            self.source.fault(
                entries["b"], message, cure if rows == 1 else _ANOTHER_METHOD
            )
            return None
        if depth == 3 and of_weights > 1:
            message = "A is a list of matrices"
            cure = "matrices on shared stages are the form ark; " + _LEVELS
            self.source.fault(entries["A"], message, cure)
            return None
        if depth > 3 and of_weights < 2 and not isinstance(entries["b"], MappingNode):
            message = "A has blocks, as of several colours, and b is one row"
            self.source.fault(entries["b"], message, _LEVELS)
            return None
        return self._blocks(entries, linear)

    def _blocks(
        self, entries: dict[str, Node], linear: Node | None
    ) -> TableauText | None:
        """A tableau block by block."""
        b_nodes = self.source.items(entries["b"], "b")
        if self.are_too_many(b_nodes, entries["b"]):
            return None
        if isinstance(entries["b"], SequenceNode) and not b_nodes:
            self.source.fault(
                entries["b"], "b is empty", "give a row of weights a colour"
            )
        b = tuple(
            self.numbers.row(item, f"b^{{{l}}}")
            for l, item in enumerate(b_nodes, start=1)
        )
        rows = self.source.items(entries["A"], "A")
        if len(rows) != len(b):
            message = (
                f"A has {counted(len(rows), 'row')} of blocks and b {len(b)} of weights"
            )
            self.source.fault(entries["A"], message, "both have one a colour")
            return None
        A = tuple(self._block_row(l, row, b) for l, row in enumerate(rows))
        c = self._node_rows(entries.get("c"), b)
        if not b or not all(b) or any(len(row) != len(b) for row in A):
            return None
        return TableauText(A, b, c, self._linear(linear, len(b)))

    def _block_row(
        self, l: int, node: Node, b: tuple[Row, ...]
    ) -> tuple[Rows | None, ...]:
        items = self.source.items(node, f"A, row {l + 1} of blocks")
        if len(items) != len(b):
            found = f"{counted(len(items), 'block')} for {counted(len(b), 'colour')}"
            message = f"row {l + 1} of blocks has {found}"
            self.source.fault(
                node, message, "write null for a block that does not exist"
            )
        blocks: list[Rows | None] = []
        for m, item in enumerate(items[: len(b)]):
            if is_null(item):
                blocks.append(None)
                continue
            where = f"A^{{{l + 1},{m + 1}}}"
            rows = self.numbers.matrix(item, where)
            shape = (len(b[l]), len(b[m]))
            why = f"b^{{{l + 1}}} has {_entries(shape[0])} and b^{{{m + 1}}} has {shape[1]}"
            if all(shape):
                rows = self.numbers.fitted(rows, item, where, shape, why)
            blocks.append(rows)
        return tuple(blocks)

    def _node_rows(
        self, node: Node | None, b: tuple[Row, ...]
    ) -> tuple[Row | None, ...]:
        if node is None:
            return (None,) * len(b)
        items = self.source.items(node, "c")
        if len(items) != len(b):
            message = f"c has {counted(len(items), 'row')} and b {len(b)}"
            self.source.fault(node, message, "give one of each a colour")
            return (None,) * len(b)
        rows: list[Row | None] = []
        for l, item in enumerate(items):
            row = None if is_null(item) else self.numbers.row(item, f"c^{{{l + 1}}}")
            if row and b[l] and len(row) != len(b[l]):
                message = f"c^{{{l + 1}}} has {_entries(len(row))}, b^{{{l + 1}}} has {len(b[l])}"
                self.source.fault(item, message, "both have one a stage")
            rows.append(row)
        return tuple(rows)

    def are_too_many(self, colours: Sequence[Node], node: Node) -> bool:
        """Note more colours than any method has."""
        if len(colours) <= MAX_COLOURS:
            return False
        message = f"{len(colours)} colours (limit {MAX_COLOURS})"
        self.source.fault(node, message, "no method needs that many")
        return True

    def _linear(self, node: Node | None, colours: int) -> tuple[int, ...]:
        if node is None:
            return ()
        found: list[int] = []
        for item in self.source.items(node, "linear"):
            colour = self.source.whole(item, "linear", smallest=1)
            if colour is None:
                continue
            if colour > colours:
                message = f"linear: there is no colour {colour}"
                self.source.fault(item, message, f"there {_are(colours)}")
            else:
                found.append(colour - 1)
        return tuple(found)

    def ark(self, node: Node) -> ArkText | None:
        """The form ``ark``."""
        entries = self.source.mapping(node, "ark", ("c", "A", "b"), _CURES, _EXAMPLE)
        if self._lacks(node, "ark", entries, "give A, a matrix a colour, and b"):
            return None
        items = self.source.items(entries["A"], "A")
        if self.are_too_many(items, entries["A"]):
            return None
        if isinstance(entries["A"], SequenceNode) and not items:
            self.source.fault(entries["A"], "A is empty", "give a matrix a colour")
        if items and _depth(entries["A"]) == 2:
            message = "A is one matrix, and an ark has one a colour"
            self.source.fault(
                entries["A"], message, "write A: [AE, AI]; or tableau: for one colour"
            )
            return None
        A = tuple(
            self.numbers.matrix(item, f"A^{{{m}}}")
            for m, item in enumerate(items, start=1)
        )
        b = self._ark_weights(entries["b"], len(A))
        c = self.numbers.row(entries["c"], "c") if "c" in entries else None
        if len(b) != len(A):
            message = f"b has {counted(len(b), 'row')} for {counted(len(A), 'colour')}"
            self.source.fault(
                entries["b"], message, "give a row a colour, or a single shared row"
            )
            return None
        if not A or not all(A) or not all(b):
            return None
        s = len(A[0])
        A = tuple(
            self.numbers.fitted(
                rows, item, f"A^{{{m}}}", (s, s), "the colours of an ark share stages"
            )
            for m, (rows, item) in enumerate(zip(A, items, strict=True), start=1)
        )
        self._ark_lengths(entries, b, c, s)
        return ArkText(A, b, c)

    def _ark_weights(self, node: Node, colours: int) -> tuple[Row, ...]:
        """The weights of each colour; the same row for all where there is a single one."""
        items = self.source.items(node, "b")
        if not any(isinstance(item, SequenceNode) for item in items):
            return (self.numbers.row(node, "b"),) * colours
        return tuple(
            self.numbers.row(item, f"b^{{{m}}}")
            for m, item in enumerate(items, start=1)
        )

    def _ark_lengths(
        self, entries: dict[str, Node], b: tuple[Row, ...], c: Row | None, s: int
    ) -> None:
        """Note weights and nodes that are not one a stage."""
        is_shared = all(row is b[0] for row in b)
        rows = (
            {"b": b[0]}
            if is_shared
            else {f"b^{{{m}}}": row for m, row in enumerate(b, start=1)}
        )
        for name, row in rows.items():
            if len(row) != s:
                message = f"{name} has {_entries(len(row))} for {counted(s, 'stage')}"
                self.source.fault(entries["b"], message, "give a weight a stage")
        if c is not None and len(c) != s:
            message = f"c has {_entries(len(c))} for {counted(s, 'stage')}"
            self.source.fault(
                entries["c"], message, "give a node a stage, or leave c out"
            )

    def prk(self, node: Node, structure: Structure) -> PrkText | None:
        """The form ``prk``; its blocks are rectangular unless the structure is general."""
        form = "give q: {A, b} and p: {A, b}"
        entries = self.source.mapping(node, "prk", ("q", "p"), form=form)
        if set(entries) != {"q", "p"}:
            if isinstance(node, MappingNode):
                self.source.fault(node, "prk: both parts q and p are needed", form)
            return None
        q, p = self._part(entries["q"], "q"), self._part(entries["p"], "p")
        if q is None or p is None:
            return None
        s_v, s_f = len(q.b), len(p.b)
        if structure == "general" and s_v != s_f:
            message = f"prk: q has {counted(s_v, 'weight')} and p has {s_f}"
            cure = "a general problem needs one set of stages; or structure: separable"
            self.source.fault(node, message, cure)
            return None
        q = self._fitted_part(q, "q", (s_f, s_v), s_v, s_f)
        p = self._fitted_part(p, "p", (s_v, s_f), s_v, s_f)
        return PrkText(q, p)

    def _part(self, node: Node, part: str) -> ButcherText | None:
        """Q or p of a prk, its sizes not yet looked at."""
        where = f"prk, {part}"
        entries = self.source.mapping(
            node, where, ("name", "A", "b", "c"), _CURES, _EXAMPLE
        )
        if self._lacks(node, where, entries, "give A, b and perhaps c"):
            return None
        A = self.numbers.matrix(entries["A"], f"{part}.A")
        b = self.numbers.row(entries["b"], f"{part}.b")
        c = self.numbers.row(entries["c"], f"{part}.c") if "c" in entries else None
        name = (
            self.source.scalar(entries["name"], f"{where}, name")
            if "name" in entries
            else ""
        )
        return ButcherText(node, name or "", A, b, c) if A and b else None

    def _fitted_part(
        self, text: ButcherText, part: str, shape: tuple[int, int], s_v: int, s_f: int
    ) -> ButcherText:
        """A part whose matrix has the shape that the weights of both ask for."""
        keys = key_nodes(text.node)
        why = f"q.b has {_entries(s_v)} and p.b has {s_f}"
        A = self.numbers.fitted(
            text.A, keys.get("A", text.node), f"{part}.A", shape, why
        )
        if text.c is not None and len(text.c) != shape[0]:
            message = (
                f"{part}.c has {_entries(len(text.c))} for {counted(shape[0], 'node')}"
            )
            self.source.fault(keys.get("c", text.node), message, "give one of each")
        return ButcherText(text.node, text.name, A, text.b, text.c)


def _are(colours: int) -> str:
    return "is 1" if colours == 1 else f"are {colours}"
