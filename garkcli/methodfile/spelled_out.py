"""YAML nodes to methods that are spelled out: Butcher tableaus, ``tableau``, ``ark``, ``prk``."""

from __future__ import annotations

from yaml.nodes import MappingNode, Node, SequenceNode

from garkcli.errors import counted
from garkcli.methodfile.description import ArkText, ButcherText, PrkText, Structure, TableauText
from garkcli.methodfile.numbers import Numbers, Row, Rows
from garkcli.methodfile.source import Source, is_null


def _entries(count: int) -> str:
    return counted(count, "entry", "entries")


class SpelledOutReader:
    """Reads matrices and rows of one file and holds their sizes against each other."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def butcher(
        self, node: Node, where: str, names: tuple[str, str, str], square: bool = True
    ) -> ButcherText | None:
        """A method spelled out; ``names`` are what its A, b and c are called in messages."""
        entries = self.source.mapping(node, where, ("name", "A", "b", "c"))
        missing = [key for key in ("A", "b") if key not in entries]
        if missing:
            cure = "give family and stages, or A and b" if square else "give A, b and perhaps c"
            self.source.fault(node, f"{where}: {' and '.join(missing)} missing", cure)
            return None
        A = self.numbers.matrix(entries["A"], names[0])
        b = self.numbers.row(entries["b"], names[1])
        c = self.numbers.row(entries["c"], names[2]) if "c" in entries else None
        if square:
            s = len(b)
            self.numbers.expect_shape(
                A, entries["A"], names[0], (s, s), f"{names[1]} has {_entries(s)}"
            )
            if c is not None and len(c) != s:
                self.source.fault(
                    entries["c"], f"{names[2]} has {_entries(len(c))} for {counted(s, 'stage')}"
                )
        name = self.source.scalar(entries["name"], f"{where}, name") if "name" in entries else ""
        return ButcherText(node, name or "", A, b, c) if A and b else None

    def tableau(self, node: Node, linear: Node | None) -> TableauText | None:
        """The form ``tableau``; ``linear`` lists its linear colours."""
        entries = self._required(node, "tableau")
        if entries is None:
            return None
        b_nodes = self.source.items(entries["b"], "b")
        if isinstance(entries["b"], SequenceNode) and not b_nodes:
            self.source.fault(entries["b"], "b is empty", "give a row of weights a colour")
        b = tuple(self.numbers.row(item, f"b^{{{l}}}") for l, item in enumerate(b_nodes, start=1))
        rows = self.source.items(entries["A"], "A")
        if len(rows) != len(b):
            message = f"A has {len(rows)} row(s) of blocks and b {len(b)} rows of weights"
            self.source.fault(entries["A"], message, "both have one a colour")
            return None
        A = tuple(self._block_row(l, row, b) for l, row in enumerate(rows))
        c = self._node_rows(entries.get("c"), b)
        if not b or not all(b) or any(len(row) != len(b) for row in A):
            return None
        return TableauText(A, b, c, self._linear(linear, len(b)))

    def _required(self, node: Node, where: str) -> dict[str, Node] | None:
        entries = self.source.mapping(node, where, ("c", "A", "b"))
        missing = [key for key in ("A", "b") if key not in entries]
        if missing and isinstance(node, MappingNode):
            self.source.fault(node, f"{where}: {' and '.join(missing)} missing", "give A and b")
        return None if missing else entries

    def _block_row(self, l: int, node: Node, b: tuple[Row, ...]) -> tuple[Rows | None, ...]:
        items = self.source.items(node, f"A, row {l + 1} of blocks")
        if len(items) != len(b):
            message = f"row {l + 1} of blocks has {len(items)} blocks for {len(b)} colours"
            self.source.fault(node, message, "write null for a block that does not exist")
        blocks: list[Rows | None] = []
        for m, item in enumerate(items[: len(b)]):
            where = f"A^{{{l + 1},{m + 1}}}"
            if is_null(item):
                blocks.append(None)
                continue
            rows = self.numbers.matrix(item, where)
            shape = (len(b[l]), len(b[m]))
            why = f"b^{{{l + 1}}} has {_entries(shape[0])} and b^{{{m + 1}}} has {shape[1]}"
            self.numbers.expect_shape(rows, item, where, shape, why)
            blocks.append(rows)
        return tuple(blocks)

    def _node_rows(self, node: Node | None, b: tuple[Row, ...]) -> tuple[Row | None, ...]:
        if node is None:
            return (None,) * len(b)
        items = self.source.items(node, "c")
        if len(items) != len(b):
            self.source.fault(
                node, f"c has {len(items)} rows and b {len(b)}", "give one of each a colour"
            )
            return (None,) * len(b)
        rows: list[Row | None] = []
        for l, item in enumerate(items):
            row = None if is_null(item) else self.numbers.row(item, f"c^{{{l + 1}}}")
            if row is not None and len(row) != len(b[l]):
                message = f"c^{{{l + 1}}} has {_entries(len(row))}, b^{{{l + 1}}} has {len(b[l])}"
                self.source.fault(item, message, "both have one a stage")
            rows.append(row)
        return tuple(rows)

    def _linear(self, node: Node | None, colours: int) -> tuple[int, ...]:
        if node is None:
            return ()
        found = []
        for item in self.source.items(node, "linear"):
            colour = self.source.whole(item, "linear", smallest=1)
            if colour is not None and colour > colours:
                self.source.fault(
                    item, f"linear: there is no colour {colour}", f"there are {colours}"
                )
            elif colour is not None:
                found.append(colour - 1)
        return tuple(found)

    def ark(self, node: Node) -> ArkText | None:
        """The form ``ark``."""
        entries = self._required(node, "ark")
        if entries is None:
            return None
        items = self.source.items(entries["A"], "A")
        if isinstance(entries["A"], SequenceNode) and not items:
            self.source.fault(entries["A"], "A is empty", "give a matrix a colour")
        A = tuple(self.numbers.matrix(item, f"A^{{{m}}}") for m, item in enumerate(items, start=1))
        b_items = self.source.items(entries["b"], "b")
        if any(isinstance(item, SequenceNode) for item in b_items):
            b = tuple(
                self.numbers.row(item, f"b^{{{m}}}") for m, item in enumerate(b_items, start=1)
            )
        else:
            b = (self.numbers.row(entries["b"], "b"),) * len(A)
        c = self.numbers.row(entries["c"], "c") if "c" in entries else None
        if len(b) != len(A):
            message = f"b has {len(b)} rows for {len(A)} colours"
            self.source.fault(entries["b"], message, "give a row a colour, or a single shared row")
            return None
        if not A or not all(A) or not all(b):
            return None
        s = len(A[0])
        for m, (rows, item) in enumerate(zip(A, items, strict=True), start=1):
            self.numbers.expect_shape(
                rows, item, f"A^{{{m}}}", (s, s), "the colours of an ark share stages"
            )
        shared = all(row is b[0] for row in b)
        for m, row in enumerate(b[:1] if shared else b, start=1):
            if len(row) != s:
                which = "b" if shared else f"b^{{{m}}}"
                self.source.fault(
                    entries["b"], f"{which} has {_entries(len(row))} for {counted(s, 'stage')}"
                )
        if c is not None and len(c) != s:
            self.source.fault(entries["c"], f"c has {_entries(len(c))} for {counted(s, 'stage')}")
        return ArkText(A, b, c)

    def prk(self, node: Node, structure: Structure) -> PrkText | None:
        """The form ``prk``; its blocks are rectangular unless the structure is general."""
        entries = self.source.mapping(node, "prk", ("q", "p"))
        if set(entries) != {"q", "p"}:
            if isinstance(node, MappingNode):
                self.source.fault(
                    node, "prk: both parts q and p are needed", "give q: {A, b} and p: {A, b}"
                )
            return None
        q, p = (
            self.butcher(entries[x], f"prk, {x}", (f"{x}.A", f"{x}.b", f"{x}.c"), square=False)
            for x in "qp"
        )
        if q is None or p is None:
            return None
        s_v, s_f = len(q.b), len(p.b)
        if structure == "general" and s_v != s_f:
            message = f"prk: q has {s_v} weights and p has {s_f}"
            self.source.fault(
                node, message, "a general problem needs one set of stages; or structure: separable"
            )
        for part, text, shape in (("q", q, (s_f, s_v)), ("p", p, (s_v, s_f))):
            why = f"q.b has {_entries(s_v)} and p.b has {s_f}"
            self.numbers.expect_shape(text.A, text.node, f"{part}.A", shape, why)
            if text.c is not None and len(text.c) != shape[0]:
                self.source.fault(
                    text.node,
                    f"{part}.c has {_entries(len(text.c))} for {counted(shape[0], 'node')}",
                )
        return PrkText(q, p)
