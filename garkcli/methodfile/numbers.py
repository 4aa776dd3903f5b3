"""Coefficients in a file: text to expressions, all of one file to one exact domain."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TypeAlias

from yaml.nodes import Node, ScalarNode

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact.domain import Domain
from garkcli.exact.expression import FUNCTIONS, Expression, Literal, parse
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.rewriting import depth_of, roots_in, size_of, substitute
from garkcli.methodfile.source import Source

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
                self.source.expression_fault(node, where, explained(error, text, node))
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
                message = f"more than {MAX_SIZE} operations, with the parameters written out"
                raise LimitExceeded(message, "write it shorter", 0, len(text))
            if depth_of(parsed, self._depths) > MAX_DEPTH:
                message = f"nested more than {MAX_DEPTH} deep, with the parameters written out"
                raise LimitExceeded(message, "give the parameter its value", 0, len(text))
            self._read[text] = substitute(parsed, self.parameters)
        return self._read[text]

    def row(self, node: Node, where: str) -> Row:
        """A row of coefficients; a single value is a row of one."""
        if isinstance(node, ScalarNode):
            return (self.entry(node, where),)
        items = self.source.items(node, where)
        if not items and not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage")
        return tuple(
            self.entry(item, f"{where}, entry {j}") for j, item in enumerate(items, start=1)
        )

    def matrix(self, node: Node, where: str) -> Rows:
        """A matrix, row by row, with every row equally long."""
        rows = tuple(
            self.row(item, f"{where}, row {i}")
            for i, item in enumerate(self.source.items(node, where), 1)
        )
        for i, row in enumerate(rows[1:], start=2):
            if len(row) != len(rows[0]):
                item = node.value[i - 1]
                message = f"{where}, row {i} has {len(row)} entries, row 1 has {len(rows[0])}"
                self.source.fault(item, message, "give every row the same number")
        if not rows and not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage")
        return rows

    def expect_shape(
        self, rows: Rows, node: Node, where: str, shape: tuple[int, int], why: str
    ) -> None:
        """Note a matrix that does not have the given shape."""
        found = (len(rows), len(rows[0]) if rows else 0)
        if found != shape and all(len(row) == found[1] for row in rows):
            message = f"{where} is {found[0]} by {found[1]} and should be {shape[0]} by {shape[1]}"
            self.source.fault(node, message, why)


def is_misread(source: Source, node: Node, text: str, where: str) -> bool:
    """Note a plain scalar that YAML itself takes for something else than the number it looks
    like.
    """
    if not isinstance(node, ScalarNode) or node.style in {"'", '"'}:
        return False
    kind = str(node.tag).rpartition(":")[2]
    if kind in _WORDS:
        message = f"{where}: {text or 'nothing'!r} is no number: YAML reads it as {kind}"
        source.fault(node, message, "write a number, such as 1/2")
        return True
    if _READ_DIFFERENTLY.fullmatch(text):
        cure = "leave out the _" if "_" in text else "write the number in plain decimal digits"
        source.fault(
            node, f"{where}: {text} means different numbers to different readers of YAML", cure
        )
        return True
    if text.lower().lstrip("+-") in {".inf", ".nan", "nan", "inf", "infinity"}:
        source.fault(node, f"{where}: {text} is not a number", "coefficients are finite")
        return True
    return False


def explained(error: ExpressionError, text: str, node: Node) -> ExpressionError:
    """The cure for what YAML cut in two: root(x, n) without quotes inside brackets."""
    plain = isinstance(node, ScalarNode) and node.style not in {"'", '"'}
    if plain and "root(" in text and text.count("(") > text.count(")"):
        cure = 'inside brackets YAML ends a value at a comma: quote it, "root(x, n)"'
        return ExpressionError(error.message, cure, error.start, error.end)
    return error


class Values:
    """The exact values of all coefficients of a file, in their common domain."""

    def __init__(self, numbers: Numbers) -> None:
        source = numbers.source
        self._values: dict[int, Number] = {}
        expressions = {id(entry.expression): entry.expression for entry in numbers.entries}
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

    def _find_culprits(self, numbers: Numbers, error: ExpressionError) -> None:
        """Note each coefficient that has no real value; failing that, what is wrong with all of
        them together.

        No field is made for any of them: there may be many, and each may be large.
        """
        before = len(numbers.source.faults)
        for entry in numbers.entries:
            try:
                domain = Domain([entry.expression], only_check=True)
                if not any(roots_in(entry.expression)):
                    domain.evaluate(entry.expression)
            except ExpressionError as own:
                numbers.source.expression_fault(entry.node, entry.where, own)
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


def read_parameters(numbers: Numbers, node: Node | None) -> None:
    """Read ``parameters`` into ``numbers``; each may use those before it.

    The values join the coefficients of the file, so that a faulty one is reported where it stands.
    """
    if node is None:
        return
    source = numbers.source
    for name, value_node in source.mapping(node, "parameters", ()).items():
        where = f"parameters: {name}"
        value: Expression = Literal(ZERO)
        if name in FUNCTIONS:
            source.fault(value_node, f"{where} is a function already", "choose another name")
        elif not name.isidentifier() or not name.isascii():
            source.fault(
                value_node,
                f"{where} cannot be the name of a parameter",
                "use letters, digits and _",
            )
        elif isinstance(value_node, ScalarNode) and value_node.value == "free":
            cure = "give it a value, for instance 1/2"
            source.fault(value_node, f"{where} is free; orders are decided for given values", cure)
        else:
            value = numbers.entry(value_node, where).expression
        numbers.define(name, value)
