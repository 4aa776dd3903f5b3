"""YAML nodes to methods that are spelled out: Butcher tableaus and the form ``tableau``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from yaml.nodes import MappingNode, Node, SequenceNode

from garkcli.errors import counted
from garkcli.methodfile import further
from garkcli.methodfile.description import (
    MAX_COLOURS,
    ButcherText,
    TableauText,
    block_name,
    of_colour,
)
from garkcli.methodfile.further import DENSE, FurtherReader
from garkcli.methodfile.grammar import TEXT, Found, Key, Kind, Schema, defined, mapping
from garkcli.methodfile.nodes import is_null
from garkcli.methodfile.numbers import Numbers, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW
from garkcli.methodfile.source import Entries, Home, Source

Weights: TypeAlias = tuple[Row, ...]
"""A row a colour."""
NodeRows: TypeAlias = tuple[Row | None, ...]
"""The same of nodes, None where they are left out."""
BlockRow: TypeAlias = tuple[Rows | None, ...]
"""The blocks A^{l,m} of one colour l, None for absent ones."""
Names: TypeAlias = tuple[str, str, str]
"""What A, b and c are called in messages."""
_SAID_BY_B = dict.fromkeys(("stages", "s"), "the number of entries in b says it")
EXAMPLE = "give A, b and perhaps c: {A: [[0, 0], [1/2, 0]], b: [0, 1]}"
_LEVELS = (
    "a method of one colour has A: [[…], …] and b: […], one of two A: [[A11, A12], [A21, A22]]"
)


_PAGE = "docs/method-file.md#embedded-and-dense-further-weights"


def _all_of(*kinds: Schema) -> Kind:
    """One of several schemas; what stands there is read where the number of colours is known."""
    return Kind(lambda: {"anyOf": list(kinds)})


def rows_of(item: Schema) -> Schema:
    """A list that is not empty."""
    return {"type": "array", "minItems": 1, "items": item}


_MATRIX, _ROW = MATRIX.schema(), ROW.schema()
_BLOCKS = rows_of({"anyOf": [_MATRIX, {"type": "null"}]})
_DENSE = defined("dense")
TABLEAU_KEYS = (
    Key(
        "A: [[0, 0], [1/2, 0]]",
        _all_of(_MATRIX, rows_of(_BLOCKS)),
        "The matrix of a Butcher tableau, row by row; rows may end at the diagonal or before it. "
        "Of several colours rows of blocks A^{l,m}, null where colour l does not see colour m.",
        page="docs/method-file.md#a-b-c-a-butcher-tableau",
        also=("matrix", "coefficients"),
    ),
    Key(
        "b: [0, 1]",
        _all_of(_ROW, rows_of(_ROW)),
        "The weights, one a stage; of several colours a row each.",
        also=("weights", "weight"),
    ),
    Key(
        "c: [0, 1/2]",
        _all_of(_ROW, rows_of({"anyOf": [_ROW, {"type": "null"}]})),
        "The nodes, one a stage; of several colours a row each. Where they are left out they are "
        "the row sums of A. Order conditions do not depend on them, B, C, D and the "
        "non-autonomous order do.",
        also=("nodes", "abscissae", "abscissas"),
    ),
    Key(
        "embedded: [1, 0]",
        _all_of(_ROW, rows_of(_ROW)),
        "Embedded weights, one a stage; of several colours a row each. They stand beside b.",
        page=_PAGE,
        also=(
            *("bhat", "b_hat", "b-hat", "bh", "b2", "b*", "b^", "btilde", "be"),
            *("b_embedded", "bembed", "embedding"),
        ),
    ),
    Key(
        "dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}",
        Kind(_DENSE.schema, inside=DENSE.inside),
        "Dense output: weights that are polynomials in θ without constant terms. It stands beside "
        "b.",
        page=_PAGE,
        also=("bi", "binterp", "b_theta"),
    ),
)
"""What a Butcher tableau has, wherever it stands."""


def with_coefficients(*keys: Key, form: str) -> Kind:
    """A mapping with these keys, of which it needs A and b; called as at the top of a file."""
    also = {key.name: key.also for key in TABLEAU_KEYS}
    needed = [
        replace(key, is_needed=key.name in {"A", "b"}, also=also.get(key.name, ())) for key in keys
    ]
    return mapping(*needed, form=form, cures=_elsewhere)


def _elsewhere() -> Mapping[str, str | Home]:
    """What to do about keys that stand in a Butcher tableau and belong elsewhere."""
    from garkcli.methodfile.file_keys import elsewhere  # which has this tableau in it

    return {**elsewhere(), **_SAID_BY_B}


TABLEAU = with_coefficients(
    *(replace(key, page="") for key in TABLEAU_KEYS[:-1]),
    replace(TABLEAU_KEYS[-1], kind=_DENSE, page=""),
    form=EXAMPLE,
)
"""The form ``tableau``."""
BUTCHER_KEYS = (
    Key("name: my method", TEXT, "What people call this diagonal method."),
    Key(
        "A: [[0, 0], [1/2, 1/2]]",
        defined("matrix"),
        "The matrix of this diagonal method, row by row.",
    ),
    Key("b: [1/2, 1/2]", defined("row"), "The weights of this diagonal method, one a stage."),
    Key(
        "c: [0, 1]",
        defined("row"),
        "The nodes of this diagonal method; the row sums of A where they are left out.",
    ),
    Key(
        "embedded: [1, 0]", defined("row"), "Embedded weights of this diagonal method, one a stage."
    ),
    Key(
        "dense: {degree: 1, weights: [[1/2], [1/2]]}",
        _DENSE,
        "Dense output of this diagonal method.",
    ),
)
_METHOD = with_coefficients(*BUTCHER_KEYS, form="give family and stages, or A and b")
BUTCHER = with_coefficients(*BUTCHER_KEYS, form=EXAMPLE)
"""One diagonal method, or a part of a pair."""


def entries_in(count: int) -> str:
    """``1 entry``, ``2 entries``."""
    return counted(count, "entry", "entries")


def depth_of_lists(node: Node) -> int:
    """How deep lists are nested; a value on its own is 0 deep."""
    if not isinstance(node, SequenceNode):
        return 0
    inside = map(depth_of_lists, node.value)
    return 1 + max(inside, default=0)


def _holds_a_number(node: Node) -> bool:
    """Whether anything but null stands in nested lists."""
    if isinstance(node, SequenceNode):
        return any(map(_holds_a_number, node.value))
    return not is_null(node)


def are_too_many(source: Source, colours: Sequence[Node], node: Node) -> bool:
    """Note more colours than any method has."""
    count = len(colours)
    if count <= MAX_COLOURS:
        return False
    message = f"{count} colours (limit {MAX_COLOURS})"
    source.fault(node, message, "no method needs that many", code="too-many")
    return True


class SpelledOutReader:
    """Reads matrices and rows of one file and holds their sizes against each other."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers
        self.further = FurtherReader(source, numbers)

    def butcher(self, node: Node, where: str, names: Names) -> ButcherText | None:
        """A method spelled out; ``names`` are what its A, b and c are called in messages."""
        entries: Found | None = _METHOD.read(self, node, where)
        if entries is None or not {"A", "b"} <= entries.keys():
            return None
        found = self._method(entries, names)
        if found is None:
            return None
        letters = further.names_beside(names[1])
        beside = self.further.of_method(entries, len(found[1]), letters)
        return ButcherText(node, entries.get("name", ""), *found, beside)

    def _method(self, entries: Entries, names: Names) -> tuple[Rows, Row, Row | None] | None:
        """A, b and c of a method of one colour; None where they do not make one."""
        numbers = self.numbers
        name_of_A, name_of_b, name_of_c = names
        A = numbers.matrix(entries["A"], name_of_A)
        b = numbers.row(entries["b"], name_of_b)
        c = None
        if "c" in entries:
            c = numbers.row(entries["c"], name_of_c)
        if not A or not b or c == ():
            return None
        stages, rows = len(b), len(A)
        is_square = all(len(row) == rows for row in A)
        c_agrees = c is None or len(c) == rows
        if is_square and rows != stages and c_agrees:
            # A and c agree with each other, so the mistake is in b
            message = f"{name_of_b} has {entries_in(stages)}, "
            message += f"{name_of_A} is {rows} by {rows}"
            self.source.fault(entries["b"], message, "both have one a stage", code="wrong-size")
            return None
        shape = (stages, stages)
        why = f"{name_of_b} has {entries_in(stages)}"
        A = numbers.fitted(A, entries["A"], name_of_A, shape, why)
        if c is not None and len(c) != stages:
            wanted = counted(stages, "stage")
            message = f"{name_of_c} has {entries_in(len(c))} for {wanted}"
            cure = "give a node a stage, or leave c out"
            self.source.fault(entries["c"], message, cure, code="wrong-size")
        return A, b, c

    def tableau(self, node: Node, linear: Node | None) -> TableauText | None:
        """The form ``tableau``; ``linear`` lists its linear colours."""
        entries: Found | None = TABLEAU.read(self, node, "tableau")
        if entries is None or not {"A", "b"} <= entries.keys():
            return None
        return self.tableau_of(entries, linear)

    def tableau_of(self, entries: Entries, linear: Node | None) -> TableauText | None:
        """A, b and c of one colour or of several, told apart by how deep A is nested."""
        A, b = entries["A"], entries["b"]
        depth, depth_of_weights = depth_of_lists(A), depth_of_lists(b)
        is_one_row = depth_of_weights < 2
        # [[null]] may be a row of blocks as well
        is_one_matrix = depth <= 2 and _holds_a_number(A)
        if is_one_matrix and is_one_row:
            return self._one_colour(entries, linear)
        if is_one_matrix:
            message = "A is one matrix, of one colour, and b a list of rows"
            cure = "write the second row as embedded: […], beside b"
            if len(b.value) == 1:
                cure = "write b as one row: b: [0, 1]"
            elif all(isinstance(x, SequenceNode) and len(x.value) == 1 for x in b.value):
                cure = "b is a column here: write it as one row, [0, 1]"
            self.source.fault(b, message, cure, code="wrong-size")
            return None
        if depth == 3 and not is_one_row:
            message = "A is a list of matrices"
            cure = "matrices on shared stages are the form ark; " + _LEVELS
            self.source.fault(A, message, cure, code="list-expected")
            return None
        if depth > 3 and is_one_row and not isinstance(b, MappingNode):
            message = "A has blocks, as of several colours, and b is one row"
            self.source.fault(b, message, _LEVELS, code="wrong-size")
            return None
        return self._blocks(entries, linear)

    def _one_colour(self, entries: Entries, linear: Node | None) -> TableauText | None:
        """A tableau of a single block."""
        found = self._method(entries, ("A", "b", "c"))
        if found is None:
            return None
        A, b, c = found
        linear_colours = self._linear(linear, 1)
        beside = self.further.of_method(entries, len(b))
        return TableauText(((A,),), (b,), (c,), linear_colours, (beside,))

    def _blocks(self, entries: Entries, linear: Node | None) -> TableauText | None:
        """A tableau block by block."""
        b = self._weights(entries["b"])
        if b is None:
            return None
        colours = len(b)
        rows = self.source.items(entries["A"], "A")
        if not isinstance(entries["A"], SequenceNode):
            return None  # said above
        if len(rows) != colours:
            found = counted(len(rows), "row")
            message = f"A has {found} of blocks and b {colours} of weights"
            self.source.fault(entries["A"], message, "both have one a colour", code="wrong-size")
            return None
        A: list[BlockRow] = []
        for l, row in enumerate(rows):
            A.append(self._block_row(l, row, b))
        c = self._node_rows(entries.get("c"), b)
        if not b or not all(b):
            return None
        if any(len(row) != colours for row in A):
            return None
        linear_colours = self._linear(linear, colours)
        stages = [len(row) for row in b]
        beside = self.further.of_colours(entries, stages)
        return TableauText(tuple(A), b, c, linear_colours, beside)

    def _weights(self, node: Node) -> Weights | None:
        """The weights of each colour; None where there are too many colours."""
        items = self.source.items(node, "b")
        if are_too_many(self.source, items, node):
            return None
        if isinstance(node, SequenceNode) and not items:
            cure = "give a row of weights a colour"
            self.source.fault(node, "b is empty", cure, code="empty")
        rows: list[Row] = []
        for l, item in enumerate(items):
            rows.append(self.numbers.row(item, of_colour("b", l)))
        return tuple(rows)

    def _block_row(self, l: int, node: Node, b: Weights) -> BlockRow:
        """The blocks A^{l,m} of one colour l."""
        colours = len(b)
        where = f"row {l + 1} of blocks"
        items = self.source.items(node, f"A, {where}")
        if len(items) != colours:
            found = counted(len(items), "block")
            wanted = counted(colours, "colour")
            message = f"{where} has {found} for {wanted}"
            cure = "write null for a block that does not exist"
            self.source.fault(node, message, cure, code="wrong-size")
        blocks: list[Rows | None] = []
        for m, item in enumerate(items[:colours]):
            blocks.append(self._block(item, l, m, b))
        return tuple(blocks)

    def _block(self, node: Node, l: int, m: int, b: Weights) -> Rows | None:
        """The block A^{l,m}, a row for each weight of l, a column for each of m; None for null."""
        if is_null(node):
            return None
        where = block_name(l, m)
        block = self.numbers.matrix(node, where)
        shape = len(b[l]), len(b[m])
        if 0 in shape:
            return block
        rows, columns = shape
        why = f"{of_colour('b', l)} has {entries_in(rows)}"
        why += f" and {of_colour('b', m)} has {columns}"
        return self.numbers.fitted(block, node, where, shape, why)

    def _node_rows(self, node: Node | None, b: Weights) -> NodeRows:
        """The nodes of each colour, None where they are left out."""
        colours = len(b)
        if node is None:
            return (None,) * colours
        items = self.source.items(node, "c")
        if len(items) != colours:
            message = f"c has {counted(len(items), 'row')} and b {colours}"
            self.source.fault(node, message, "give one of each a colour", code="wrong-size")
            return (None,) * colours
        rows: list[Row | None] = []
        for l, item in enumerate(items):
            rows.append(self._node_row(item, l, len(b[l])))
        return tuple(rows)

    def _node_row(self, node: Node, l: int, stages: int) -> Row | None:
        """The nodes of one colour, as many as it has weights."""
        if is_null(node):
            return None
        where = of_colour("c", l)
        row = self.numbers.row(node, where)
        if row and stages and len(row) != stages:
            found = entries_in(len(row))
            weights = of_colour("b", l)
            message = f"{where} has {found}, {weights} has {stages}"
            self.source.fault(node, message, "both have one a stage", code="wrong-size")
        return row

    def _linear(self, node: Node | None, colours: int) -> tuple[int, ...]:
        """The colours that are linear, numbered from 0."""
        if node is None:
            return ()
        found: list[int] = []
        for item in self.source.items(node, "linear"):
            colour = self.source.whole(item, "linear", smallest=1)
            if colour is None:
                continue
            if colour > colours:
                message = f"linear: there is no colour {colour}"
                self.source.fault(item, message, f"there {_are(colours)}", code="wrong-value")
            else:
                found.append(colour - 1)
        return tuple(found)


def _are(colours: int) -> str:
    return "is 1" if colours == 1 else f"are {colours}"
