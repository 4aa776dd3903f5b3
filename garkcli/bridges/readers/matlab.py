"""MATLAB and Octave: matrices by their names, fields of structures, RKLab's blocks."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.bridges.readers.assignments import Assigned, Walk
from garkcli.bridges.readers.cells import Cells
from garkcli.bridges.readers.finder import Finder, tables_of
from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.lexing import MATLAB, Token, tokens_of, without
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader, Row, Rows, Unreadable
from garkcli.sources.naming import Scope
from garkcli.sources.scalars import Value, rows_of
from garkcli.sources.shaping import is_zero

NAME = "matlab"
GRAMMAR = Grammar(
    lists={"{": "}"},
    matrices={"[": "]"},
    roots={
        "sqrt": "sqrt",
        "cbrt": "cbrt",
        "nthroot": "root",
        "power": "power",
        "rdivide": "rational",
    },
    passed=frozenset({"sym", "vpa", "double", "single", "mp", "str2sym", "full", "num2cell"}),
)
_ENDS = frozenset({";", ","})
_TITLES = frozenset({"function", "case", "if", "elseif"})


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a MATLAB source."""
    tokens = without(tokens_of(text, MATLAB), "comment")
    allowance = Allowance()
    walk = Walk(tokens, GRAMMAR, {}, _ENDS, _title, allowance)
    return tables_of(walk, _Finder(source, allowance))


def _title(tokens: list[Token], place: int) -> str:
    """The name of a function, or the text that a branch compares with."""
    token = tokens[place]
    if token.kind != "name" or token.text not in _TITLES:
        return ""
    title = ""
    for behind in tokens[place + 1 : place + 20]:
        if behind.kind == "line" or behind.text == ";":
            break
        if behind.kind == "text":
            return behind.text
        if behind.kind == "name" and token.text == "function":
            title = behind.text
        if behind.text == "(" and title:
            break
    return title


class _Finder(Finder):
    """Collects the matrices of one structure, or of one branch, into tables."""

    def __init__(self, source: str, allowance: Allowance) -> None:
        super().__init__(source, allowance)
        self._cells: dict[str, Cells] = {}
        self._blocks: list[FoundTable] = []

    def end(self) -> None:
        """The tables of what has ended; those in a block are found once."""
        loose = self._allowance.tables(self._scope.tables(self._source, NAME))
        in_blocks = {(x.A, x.b) for x in self._blocks}
        self.found += self._blocks
        self.found += [x for x in loose if (x.A, x.b) not in in_blocks]
        for stem, cells in self._cells.items():
            name = self._scope.title or stem
            table = cells.table(self._source, NAME, name, self._allowance)
            if table is not None:
                self.found.append(table)
        self._cells = {}
        self._blocks = []
        self._scope = Scope(self._scope.title)

    def assigned(self, event: Assigned) -> None:
        """A matrix was assigned to a name, to a field or to a cell."""
        stem, _, field = event.name.rpartition(".")
        block = rklab(event.value)
        if block is not None and field.upper().startswith("B"):
            name = self._scope.title or event.name
            self._blocks.append(self._allowance.table(block.table(self._source, event.line, name)))
            return
        cells = self._cells.setdefault(stem, Cells(event.line))
        cells.put(field, event.indices, event.value)
        if event.indices:
            return
        name = f"{stem}_{field}" if stem and field != "name" else field
        if stem and stem == event.name.partition(".")[0] and self._scope.title:
            # m of a function that returns m
            name = field
        self._scope.add(name, event.value, event.line)


@dataclass(frozen=True)
class Block:
    """A block matrix [c A; q b; p d]."""

    order: int
    embedded_order: int | None
    c: Row
    A: Rows
    b: Row
    embedded: Row | None

    def table(self, source: str, line: int, name: str) -> FoundTable:
        """The method that it is."""
        embedded = None if self.embedded is None else (self.embedded,)
        return FoundTable(
            source,
            line,
            NAME,
            name,
            ((self.A,),),
            (self.b,),
            (self.c,),
            embedded=embedded,
            order=self.order,
            embedded_order=self.embedded_order,
        )


def rklab(value: Value) -> Block | None:
    """A block matrix [c A; q b; p d]: the orders, c, A, b and the embedded weights.

    Returns:
        None where it is none: q is a whole number and has the sum of its row to itself.
    """
    try:
        rows = rows_of(value)
    except Unreadable:
        return None
    columns = {len(row) for row in rows}
    if len(columns) != 1:
        return None
    stages = columns.pop() - 1
    has_embedded = len(rows) == stages + 2
    if not 0 < stages <= MAX_STAGES or len(rows) < stages + 1:
        return None
    if len(rows) > stages + 2:
        return None
    order = _order(rows[stages][0])
    if order is None or order < 1:
        return None
    c = tuple(row[0] for row in rows[:stages])
    A = tuple(row[1:] for row in rows[:stages])
    b = rows[stages][1:]
    embedded: Row | None = None
    embedded_order: int | None = None
    if has_embedded:
        embedded_order = _order(rows[stages + 1][0])
        if embedded_order is None:
            return None
        embedded = rows[stages + 1][1:]
        if not embedded_order and all(is_zero(x) for x in embedded):
            embedded, embedded_order = None, None
    return Block(order, embedded_order, c, A, b, embedded)


def _order(text: str) -> int | None:
    whole, point, rest = text.partition(".")
    if point and rest.strip("0"):
        return None
    return int(whole) if whole.isdigit() and len(whole) < 3 else None


READER = Reader(NAME, "MATLAB and Octave: matrices, structures, RKLab's blocks", (".m",), find)
