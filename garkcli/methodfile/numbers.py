"""The coefficients of a file, from text to expressions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from garkcli.errors import ExpressionError, LimitExceeded, counted
from garkcli.exact.expression import parse
from garkcli.exact.field import ZERO
from garkcli.exact.nodes import Expression, Literal, Name
from garkcli.exact.rewriting import Expanded, check_size, expanded, names_in
from garkcli.frozen import Frozen, Mutable, field, replace
from garkcli.grammar import spellings
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode, shortened
from garkcli.grammar.source import Entries, Source

if TYPE_CHECKING:
    from garkcli.exact.polynomial import Polynomial

UNKNOWN = "?"
_OF_MATRICES = {
    "A": "a",
    "C": "C",
    "Abar": "abar",
    "alpha": "alpha",
    "beta": "beta",
    "gamma": "gamma",
    "omega": "omega",
    "dense": "bt",
    "dense, b": "bt",
    "dense, bbar": "bbart",
    "predictor, old": "po",
    "predictor, new": "pn",
}
_OF_ROWS = {
    "b": "b",
    "bbar": "bbar",
    "c": "c",
    "d": "d",
    "m": "m",
    "e": "e",
    "embedded": "bh",
    "embedded, b": "bh",
    "embedded, bbar": "bbarh",
    "embedded, omega": "omegah",
    "embedded, gamma": "gammah",
}
_FORMS = "rosenbrock|transformed|nystrom|shu-osher|multirate|mri|mis|coupling"
_PLACE = (
    rf"(?:(?P<part>[qp])\.)?(?:(?:{_FORMS}), )*(?P<array>{'|'.join((*_OF_MATRICES, *_OF_ROWS))})"
    r"(?:\^\{(?P<colours>[0-9,]+)\}|, matrix (?P<matrix>[0-9]+))?(?:, weights)?"
    r"(?:, row (?P<row>[0-9]+))?(?:, entry (?P<entry>[0-9]+))?"
)


def name_of_place(where: str) -> str | None:
    """The name of the unknown at a place, given as in messages; None if it cannot be unknown.

    >>> name_of_place("A, row 2, entry 1"), name_of_place("A^{1,2}, row 3, entry 1")
    ('a21', 'a12_31')
    >>> name_of_place("b^{2}, entry 1"), name_of_place("q.A, row 10, entry 2")
    ('b2_1', 'q_a10_2')
    >>> name_of_place("dense, weights, row 3, entry 2"), name_of_place("dense^{2}, weights, row 1")
    ('bt32', 'bt2_11')
    >>> name_of_place("predictor, new, matrix 2, row 3, entry 1")
    'pn2_31'
    >>> name_of_place("multirate, mri, embedded, row 1, entry 2")
    'bh1_2'
    """
    match = re.fullmatch(_PLACE, where)
    if match is None:
        return None
    part, array, colours, matrix, row, entry = match.groups()
    before = colours or matrix
    # one value in place of a row of one is its only entry
    indices = [entry or "1"]
    if array in _OF_MATRICES:
        indices = [row or "1", *indices]
    else:
        before = before or row
    of_several = f"{_together(before.split(','))}_" if before else ""
    name = (_OF_MATRICES | _OF_ROWS)[array] + of_several + _together(indices)
    return f"{part}_{name}" if part else name


def is_bare_unknown(node: Node) -> bool:
    """Whether a ? is written without quotes, which YAML takes for the sign of a key."""
    if not isinstance(node, MappingNode) or len(node.value) != 1:
        return False
    return all(isinstance(x, ScalarNode) and not x.value for x in node.value[0])


def _together(indices: Sequence[str]) -> str:
    return ("_" if any(len(index) > 1 for index in indices) else "").join(indices)


MAX_DEPTH = 200
"""The deepest nesting of a coefficient, with parameters expanded."""
_SHOWN_ROWS = 5  # most further rows of another length that are reported


class Coefficient(Frozen):
    expression: Expression
    node: Node
    where: str


Row: TypeAlias = tuple[Coefficient, ...]
Rows: TypeAlias = tuple[Row, ...]


class Between(Frozen):
    """The range of a parameter: rational ends, and nonnegative polynomials for algebraic ends."""

    ranges: tuple[tuple[Coefficient, Coefficient], ...] = ()
    bounds: tuple[Polynomial, ...] = ()


class Free(Between, kw_only=True):
    """A parameter without a value; ``where`` is the place of an entry, empty for a named one."""

    node: Node
    where: str = ""

    def within(self, other: Between) -> Free:
        ranges, bounds = (*self.ranges, *other.ranges), (*self.bounds, *other.bounds)
        return replace(self, ranges=ranges, bounds=bounds)


NOTHING = Expanded(Literal(ZERO))


class Numbers(Mutable):
    """``settings`` are values of parameters from outside, as text, ``places`` the nodes of values
    of parameters, which are substituted, ``used`` the names in all coefficients.
    """

    source: Source
    parameters: dict[str, Expanded] = field(default_factory=dict)
    entries: list[Coefficient] = field(default_factory=list)
    of_parameters: dict[str, Coefficient] = field(default_factory=dict)
    settings: Mapping[str, str] = field(default_factory=dict)
    free: dict[str, Free] = field(default_factory=dict)
    places: Entries = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    _read: dict[str, Expanded] = field(default_factory=dict)

    def define(self, name: str, value: Expanded) -> None:
        self._read.clear()
        self.parameters[name] = value

    def forget(self, name: str) -> None:
        self._read.clear()
        del self.parameters[name]

    def entry(self, node: Node, where: str) -> Coefficient:
        """Reads a coefficient; a faulty one is reported and counts as zero."""
        entry = Coefficient(self._value(node, where).expression, node, where)
        self.entries.append(entry)
        return entry

    def parameter(self, name: str, node: Node, where: str) -> None:
        value = self._value(node, where)
        self.of_parameters[name] = Coefficient(value.expression, node, where)
        self.define(name, value)

    def _value(self, node: Node, where: str) -> Expanded:
        if isinstance(node, MappingNode) and is_bare_unknown(node):
            message = f"YAML reads a bare {UNKNOWN} as a key"
            cure = f'quote it: "{UNKNOWN}"'
            self.source.fault(node, message, cure, where=where, code="yaml-word")
            return NOTHING
        text = spellings.number_text(self.source, node, where)
        if text is None:
            return NOTHING
        if text == UNKNOWN:
            return self._unknown(node, where)
        try:
            return self._expression(text)
        except ExpressionError as error:
            self.source.expression_fault(node, where, *spellings.explained(error, text))
            return NOTHING

    def _unknown(self, node: Node, where: str) -> Expanded:
        """An unknown named by its place, or its value from outside."""
        name = name_of_place(where)
        if name is None:
            message = f"{UNKNOWN} stands for an entry of a tableau, or of weights beside it"
            cure = "write parameters: {tau: free} for any other unknown"
            self.source.fault(node, message, cure, where=where, code="unknown-entry-misplaced")
            return NOTHING
        if self.places.get(name) is node:  # of a row that colours share
            return self.parameters[name]
        if name in self.parameters:
            message = f"{where}: its name {name} is that of a parameter"
            self.source.fault(node, message, "call the parameter something else", code="name-taken")
            return NOTHING
        self.places[name] = node
        self.unknown(name, node, where)
        return self.parameters[name]

    def unknown(self, name: str, node: Node, where: str) -> None:
        if name in self.settings:
            self.given(name, node, where)
        else:
            self.free[name] = Free(node=node, where=where)
            self.define(name, Expanded(Name(name)))

    def given(self, name: str, node: Node, where: str) -> None:
        """Defines a parameter by its value from outside the file."""
        text = self.settings[name]
        value = NOTHING
        try:
            parsed = parse(text)
            value = expanded(parsed, {x.name: Expanded(x) for x in names_in(parsed)})
        except ExpressionError as error:
            message = f"{where} is set to {shortened(text)}: {error.message}"
            self.source.fault(node, message, error.help, code="no-value-left")
        else:
            self.of_parameters[name] = Coefficient(value.expression, node, where)
        self.define(name, value)

    def written(self, text: str, node: Node, where: str) -> Coefficient:
        entry = Coefficient(self._expression(text).expression, node, where)
        self.entries.append(entry)
        return entry

    def _expression(self, text: str) -> Expanded:
        """Returns one object for equal texts; ExpressionError, or LimitExceeded if long."""
        if text in self._read:
            return self._read[text]
        value = expanded(parse(text), self.parameters, self.used)
        check_size(value.size, text)
        if value.depth > MAX_DEPTH:
            message = f"nested more than {MAX_DEPTH} deep, with the parameters written out"
            raise LimitExceeded(message, "give the parameter its value", 0, len(text))
        self._read[text] = value
        return value

    def row(self, node: Node, where: str) -> Row:
        """Reads a row of coefficients; a single value is a row of one."""
        if spellings.is_printed(self.source, [node], where, "a row"):
            return ()
        if isinstance(node, ScalarNode):
            return (self.entry(node, where),)
        items = self.source.items(node, where)
        if not items and not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage", code="empty")
        return self._entries(items, where)

    def _entries(self, items: Sequence[Node], where: str) -> Row:
        """Reads the entries of a row; one that YAML split at a comma is reported once."""
        row: list[Coefficient] = []
        is_open = False
        for item in items:
            was_open, is_open = is_open, spellings.opens(item)
            if was_open:
                is_open = False
                continue
            place = f"{where}, entry {len(row) + 1}"
            if is_open:
                message = "a comma ends the value inside brackets"
                self.source.fault(
                    item, message, 'quote it: "root(x, n)"', where=place, code="not-a-number"
                )
                row.append(Coefficient(Literal(ZERO), item, place))
            else:
                row.append(self.entry(item, place))
        return tuple(row)

    def matrix(self, node: Node, where: str) -> Rows:
        """Reads a matrix by rows, which may still differ in length, see ``fitted``."""
        written = node.value if isinstance(node, SequenceNode) else [node]
        if spellings.is_printed(self.source, written, where, "a matrix"):
            return ()
        cure = "write it row by row: [[0, 0], [1/2, 0]]"
        items = self.source.items(node, where, cure)
        deep = spellings.first_list_in_rows(items)
        if deep is not None:
            message = f"{where}: a list in place of a coefficient"
            cure = "a matrix is a list of rows: [[0, 0], [1/2, 0]]"
            self.source.fault(deep, message, cure, code="value-expected")
            return ()
        rows = tuple(
            self._entries(item.value, f"{where}, row {i}")
            if isinstance(item, SequenceNode)
            else self.row(item, f"{where}, row {i}")
            for i, item in enumerate(items, start=1)
        )
        # [[]] is the triangle of one stage
        if any(rows) or len(rows) == 1:
            return rows
        if not self.source.faults:
            self.source.fault(node, f"{where} is empty", "every method has a stage", code="empty")
        return ()

    def fitted(self, rows: Rows, node: Node, where: str, shape: tuple[int, int], why: str) -> Rows:
        """Entries behind the diagonal, or on it, may be left out, as explicit tableaus are printed:
        they are zero. ``why`` is the reason for the shape; a wrong one is one fault.
        """
        if not rows:
            return rows
        count = len(rows)
        lengths = [len(row) for row in rows]
        stages, columns = shape
        is_square = stages == columns
        if is_square and count == stages and spellings.is_triangle(lengths):
            return self._completed(rows, node, where)
        if count == stages and set(lengths) == {columns}:
            return rows
        if len(set(lengths)) == 1:
            message = f"{where} is {count} by {lengths[0]} and should be {stages} by {columns}"
            self.source.fault(node, message, why, code="wrong-size")
            return rows
        if is_square and count + 1 == stages and spellings.is_triangle([0, *lengths]):
            message = f"{where} has {counted(count, 'row')} for {counted(stages, 'stage')}"
            cure = "begin with the empty row of the first stage: [[], [1/2], …]"
            self.source.fault(node, message, cure, code="wrong-size")
            return rows
        self._uneven(lengths, node, where, columns)
        return rows

    def rectangular(
        self, rows: Rows, node: Node, where: str, shape: tuple[int, int] | None = None
    ) -> Rows:
        lengths = [len(row) for row in rows]
        if shape == (len(rows), len(rows)) and spellings.is_triangle(lengths):
            return self._completed(rows, node, where)
        if len(set(lengths)) > 1:
            self._uneven(lengths, node, where, lengths[0])
        return rows

    def _uneven(self, lengths: Sequence[int], node: Node, where: str, columns: int) -> None:
        """Reports rows of different lengths as one fault, at the first of another length."""
        wrong = [i for i, length in enumerate(lengths, 1) if length != columns]
        first, others = wrong[0], wrong[1:]
        entries = counted(lengths[first - 1], "entry", "entries")
        message = f"{where}, row {first} has {entries} and should have {columns}"
        if others:
            noun = "row" if len(others) == 1 else "rows"
            numbers = ", ".join(map(str, others[:_SHOWN_ROWS]))
            more = ", …" if len(others) > _SHOWN_ROWS else ""
            message += f"; other lengths in {noun} {numbers}{more} too"
        place = node.value[first - 1] if isinstance(node, SequenceNode) else node
        cure = "give all rows the same length, or end each at the diagonal"
        if lengths[first - 1] > columns:
            cure += "; decimals have a point: 0.5"
        self.source.fault(place, message, cure, code="wrong-size")

    def _completed(self, rows: Rows, node: Node, where: str) -> Rows:
        whole: list[Row] = []
        for i, row in enumerate(rows, start=1):
            missing = len(rows) - len(row)
            zero = Coefficient(Literal(ZERO), node, f"{where}, row {i}")
            if missing:
                self.entries.append(zero)
            whole.append(row + (zero,) * missing)
        return tuple(whole)


class NumbersReader:
    def __init__(self, numbers: Numbers) -> None:
        self.numbers = numbers
        self.source = numbers.source
