"""Coefficients in a file: text to expressions, all of one file to one exact domain."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from yaml.nodes import Node, ScalarNode, SequenceNode

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue, counted
from garkcli.exact.domain import Domain
from garkcli.exact.expression import FUNCTIONS, Expression, Literal, parse
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.rewriting import depth_of, roots_in, size_of, substitute
from garkcli.methodfile.source import Source, key_nodes, shortened
from garkcli.methodfile.spellings import (
    bracketed,
    explained,
    first_list_in_rows,
    holds_several,
    is_triangle,
    only_text,
    opens,
)

_READ_DIFFERENTLY = re.compile(
    r"[-+]?(0[0-9_]+|0[xob][0-9a-f_]+|[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?|[0-9]*_[0-9_.]*)",
    re.IGNORECASE,
)
"""Plain scalars that YAML 1.1 reads as another number than they look: octal, hexadecimal, base 60,
with _.
"""
MAX_SIZE = 2_000
"""Most operations of one coefficient, those of the parameters in it written out."""
MAX_DEPTH = 200
"""How deep one coefficient may be nested, the parameters in it written out."""
_WORDS = {"bool", "null", "timestamp", "merge"}


@dataclass(frozen=True)
class Entry:
    """One coefficient: its expression and where it stands."""

    expression: Expression
    node: Node
    where: str


Row: TypeAlias = tuple[Entry, ...]
Rows: TypeAlias = tuple[Row, ...]


@dataclass
class Numbers:
    """Reads the coefficients of one file; ``parameters`` are substituted as they are read."""

    source: Source
    parameters: dict[str, Expression] = field(default_factory=dict)
    entries: list[Entry] = field(default_factory=list)
    of_parameters: list[Entry] = field(default_factory=list)
    _sizes: dict[str, int] = field(default_factory=dict)
    _depths: dict[str, int] = field(default_factory=dict)
    _read: dict[str, Expression] = field(default_factory=dict)

    def define(self, name: str, value: Expression) -> None:
        """Let ``name`` stand for ``value`` in all coefficients read from now on."""
        self._read.clear()
        self.parameters[name] = value
        self._sizes[name] = size_of(value, {})
        self._depths[name] = depth_of(value, {})

    def entry(self, node: Node, where: str) -> Entry:
        """One coefficient; a faulty one is noted and read as zero, so that reading goes on."""
        expression: Expression = Literal(ZERO)
        text = self.source.scalar(node, where)
        if text is not None and not is_misread(self.source, node, text, where):
            try:
                expression = self._expression(text)
            except ExpressionError as error:
                self.source.expression_fault(node, where, *explained(error, text))
        entry = Entry(expression, node, where)
        self.entries.append(entry)
        return entry

    def _expression(self, text: str) -> Expression:
        """What a text means; the same object for the same text, which large matrices repeat a
        lot.
        """
        if text not in self._read:
            parsed = parse(text)
            if size_of(parsed, self._sizes) > MAX_SIZE:
                message = (
                    f"more than {MAX_SIZE} operations, with the parameters written out"
                )
                raise LimitExceeded(message, "write it shorter", 0, len(text))
            if depth_of(parsed, self._depths) > MAX_DEPTH:
                message = f"nested more than {MAX_DEPTH} deep, with the parameters written out"
                raise LimitExceeded(
                    message, "give the parameter its value", 0, len(text)
                )
            self._read[text] = substitute(parsed, self.parameters)
        return self._read[text]

    def row(self, node: Node, where: str) -> Row:
        """A row of coefficients; a single value is a row of one."""
        if self._is_text([node], where, "a row"):
            return ()
        if isinstance(node, ScalarNode):
            return (self.entry(node, where),)
        items = self.source.items(node, where)
        if not items and not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage")
        return self._entries(items, where)

    def _entries(self, items: Sequence[Node], where: str) -> Row:
        """The entries of a row; one that YAML cut in two at a comma is noted, and counts once."""
        row: list[Entry] = []
        is_open = False
        for item in items:
            was_open, is_open = is_open, opens(item)
            if was_open:
                is_open = False
                continue
            place = f"{where}, entry {len(row) + 1}"
            if is_open:
                message = "a comma ends the value inside brackets"
                self.source.fault(item, message, 'quote it: "root(x, n)"', where=place)
                row.append(Entry(Literal(ZERO), item, place))
            else:
                row.append(self.entry(item, place))
        return tuple(row)

    def matrix(self, node: Node, where: str) -> Rows:
        """A matrix, row by row; the rows may still be of different lengths, see ``fitted``."""
        rows_of = node.value if isinstance(node, SequenceNode) else [node]
        if self._is_text(rows_of, where, "a matrix"):
            return ()
        items = self.source.items(
            node, where, "write it row by row: [[0, 0], [1/2, 0]]"
        )
        deep = first_list_in_rows(items)
        if deep is not None:
            message = f"{where}: a list stands where a coefficient is expected"
            self.source.fault(
                deep, message, "a matrix is a list of rows: [[0, 0], [1/2, 0]]"
            )
            return ()
        rows: list[Row] = []
        for i, item in enumerate(items, start=1):
            if isinstance(item, SequenceNode):
                rows.append(self._entries(item.value, f"{where}, row {i}"))
            else:
                rows.append(self.row(item, f"{where}, row {i}"))
        if not any(rows) and not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage")
        return tuple(rows) if any(rows) else ()

    def _is_text(self, rows: Sequence[Node], where: str, what: str) -> bool:
        """Note, once, rows that are a text of several numbers, as other programs print them."""
        texts = [only_text(row) for row in rows]
        first = next((i for i, text in enumerate(texts) if holds_several(text)), None)
        if first is None:
            return False
        message = f"{what} is a list, not the text {shortened(texts[first])}"
        example = "[0, 1/2]" if what == "a row" else "[[0, 0], [1/2, 0]]"
        cure = (
            f"put it in brackets, with commas: {bracketed(';'.join(texts)) or example}"
        )
        self.source.fault(rows[first], message, cure, where=where)
        return True

    def fitted(
        self, rows: Rows, node: Node, where: str, shape: tuple[int, int], why: str
    ) -> Rows:
        """A matrix of the given shape; note at most one fault where it has another.

        The rows of a triangular matrix may end at the diagonal or before it, as explicit tableaus
        are printed: what is left out is zero.

        Args:
            rows: as ``matrix`` read them; none where it noted a fault.
            node: the matrix in the file.
            where: what it is, for messages.
            shape: the rows and columns it should have.
            why: where this shape comes from.
        """
        if not rows:
            return rows
        lengths = [len(row) for row in rows]
        if shape[0] == shape[1] == len(rows) and is_triangle(lengths):
            return self._completed(rows, node, where)
        if len(rows) == shape[0] and set(lengths) == {shape[1]}:
            return rows
        if len(set(lengths)) == 1:
            wanted = f"{shape[0]} by {shape[1]}"
            message = f"{where} is {len(rows)} by {lengths[0]} and should be {wanted}"
            self.source.fault(node, message, why)
            return rows
        if shape[0] == shape[1] == len(rows) + 1 and is_triangle([0, *lengths]):
            message = f"{where} has {counted(len(rows), 'row')} for {counted(shape[0], 'stage')}"
            cure = "begin with the empty row of the first stage: [[], [1/2], …]"
            self.source.fault(node, message, cure)
            return rows
        self._uneven(lengths, node, where, shape[1])
        return rows

    def rectangular(self, rows: Rows, node: Node, where: str) -> None:
        """Note a matrix whose rows are not equally long, where no shape is known yet."""
        lengths = [len(row) for row in rows]
        if len(set(lengths)) > 1:
            self._uneven(lengths, node, where, lengths[0])

    def _uneven(
        self, lengths: Sequence[int], node: Node, where: str, columns: int
    ) -> None:
        """Note rows of different lengths: one fault, at the first of another length."""
        wrong = [i for i, length in enumerate(lengths) if length != columns]
        first = node.value[wrong[0]] if isinstance(node, SequenceNode) else node
        found = counted(lengths[wrong[0]], "entry", "entries")
        message = f"{where}, row {wrong[0] + 1} has {found} and should have {columns}"
        if len(wrong) > 1:
            others = ", ".join(str(i + 1) for i in wrong[1:6])
            more = ", …" if len(wrong) > 6 else ""
            message += (
                f"; other lengths in row{'s' * (len(wrong) > 2)} {others}{more} too"
            )
        cure = "give every row the same number, or end each at the diagonal"
        self.source.fault(first, message, cure)

    def _completed(self, rows: Rows, node: Node, where: str) -> Rows:
        """A triangle of rows, with the zeros above it."""
        whole: list[Row] = []
        for i, row in enumerate(rows, start=1):
            missing = len(rows) - len(row)
            zero = Entry(Literal(ZERO), node, f"{where}, row {i}")
            if missing:
                self.entries.append(zero)
            whole.append(row + (zero,) * missing)
        return tuple(whole)


def is_misread(source: Source, node: Node, text: str, where: str) -> bool:
    """Note a plain scalar that YAML itself takes for something else than the number it looks
    like.
    """
    if not isinstance(node, ScalarNode) or node.style in {"'", '"'}:
        return False
    kind = str(node.tag).rpartition(":")[2]
    message, cure = "", ""
    if kind in _WORDS:
        message = f"{text or 'nothing'!r} is no number: YAML reads it as {kind}"
        cure = "write a number, such as 1/2"
    elif _READ_DIFFERENTLY.fullmatch(text):
        message = f"{text} means different numbers to different readers of YAML"
        cure = (
            "leave out the _"
            if "_" in text
            else "write the number in plain decimal digits"
        )
    elif text.lower().lstrip("+-") in {".inf", ".nan", "nan", "inf", "infinity"}:
        message, cure = f"{text} is not a number", "coefficients are finite"
    if message:
        source.fault(node, message, cure, where=where)
    return bool(message)


class Values:
    """The exact values of all coefficients of a file, in their common domain.

    Attributes:
        printed: each different coefficient, as it is written and its value.
    """

    def __init__(self, numbers: Numbers) -> None:
        source = numbers.source
        self._values: dict[int, Number] = {}
        self.printed: tuple[tuple[Expression, Number], ...] = ()
        expressions = {
            id(entry.expression): entry.expression for entry in numbers.entries
        }
        try:
            domain = Domain(expressions.values())
        except (UndefinedValue, LimitExceeded) as error:
            self._find_culprits(numbers, error)
            return
        known: dict[int, Number] = {}
        for entry in numbers.entries:
            key = id(entry.expression)
            try:
                if key not in known:
                    known[key] = domain.evaluate(entry.expression)
                self._values[id(entry)] = known[key]
            except ExpressionError as error:
                source.expression_fault(entry.node, entry.where, error)
        self.printed = tuple((expressions[key], value) for key, value in known.items())
        _note_faults(source, numbers.of_parameters)

    def _find_culprits(self, numbers: Numbers, error: ExpressionError) -> None:
        """Note each coefficient that has no real value; failing that, what is wrong with all of
        them together.

        No field is made for any of them: there may be many, and each may be large.
        """
        before = len(numbers.source.faults)
        _note_faults(numbers.source, [*numbers.of_parameters, *numbers.entries])
        if len(numbers.source.faults) == before:
            radical = next(x for x in numbers.entries if any(roots_in(x.expression)))
            numbers.source.fault(radical.node, error.message, error.help)

    def number(self, entry: Entry) -> Number:
        """The value of a coefficient."""
        return self._values[id(entry)]

    def vector(self, row: Row) -> Vector:
        """The values of a row."""
        return tuple(self._values[id(entry)] for entry in row)

    def matrix(self, rows: Rows) -> Matrix:
        """The values of a matrix."""
        return tuple(self.vector(row) for row in rows)


def _note_faults(source: Source, entries: Iterable[Entry]) -> None:
    """Note each coefficient that has no real value; no field is made for any of them."""
    for entry in entries:
        try:
            domain = Domain([entry.expression], only_check=True)
            if not any(roots_in(entry.expression)):
                domain.evaluate(entry.expression)
        except ExpressionError as own:
            source.expression_fault(entry.node, entry.where, own)


def read_parameters(numbers: Numbers, node: Node | None) -> None:
    """Read ``parameters`` into ``numbers``; each may use those before it.

    The values are kept apart from the coefficients: one that no coefficient uses has no part in
    their domain, but a faulty one is reported where it stands.
    """
    if node is None:
        return
    source = numbers.source
    keys = key_nodes(node)
    for name, value_node in source.mapping(node, "parameters", ()).items():
        key = keys[name]
        where = f"parameters: {name}"
        value: Expression = Literal(ZERO)
        if name in FUNCTIONS:
            source.fault(key, f"{where} is a function already", "choose another name")
        elif not name.isidentifier() or not name.isascii():
            message = f"{where} cannot be the name of a parameter"
            source.fault(key, message, "use letters, digits and _")
        elif isinstance(value_node, ScalarNode) and value_node.value == "free":
            cure = "give it a value, for instance 1/2"
            source.fault(
                value_node,
                f"{where} is free; orders are decided for given values",
                cure,
            )
        else:
            value = numbers.entry(value_node, where).expression
            numbers.of_parameters.append(numbers.entries.pop())
        numbers.define(name, value)
