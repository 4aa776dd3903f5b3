"""C and C++ as far as tables need it: constants, arrays and calls, block by block."""

from __future__ import annotations

import re
from collections import ChainMap
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from garkcli.bridges.readers.allowance import Allowance
from garkcli.bridges.readers.c_grammar import CONSTANTS, GRAMMAR
from garkcli.bridges.readers.cells import Cells
from garkcli.bridges.readers.found import MAX_STAGES, Unreadable
from garkcli.bridges.readers.lexing import C, Token, tokens_of, without
from garkcli.bridges.readers.naming import Scope, role_of
from garkcli.bridges.readers.parsing import ValueParser
from garkcli.bridges.readers.scalars import Scalar, Value, number, whole

_NUMBERED = re.compile(
    r"(?:(?P<stem>\w{1,200}?)_)?(?P<word>A|b|c|embedded|bhat|dense)"
    r"(?P<l>[0-9]{1,2})(?:_(?P<m>[0-9]{1,2}))?"
)
"""Names of arrays with the numbers of vector fields."""
_BEFORE_VALUES = frozenset({"return", "else", "do", "case"})
MAX_MEMBERS = 10
"""Most members of a name, such as those of ``a->b->c``."""
MAX_INDICES = 4
"""Most indices of a name."""
MAX_INDEX = 20
"""Most words and signs between the brackets of an index."""
MAX_SCOPES = 60
"""Deepest nesting of blocks."""
_DEFINITION = re.compile(r"#[ \t]*define[ \t]+([A-Za-z_]\w*)[ \t]+(.+)")


@dataclass
class Block:
    """A block in braces.

    Attributes:
        scope: its arrays by what their names tell.
        line: where it begins.
        members: what is assigned to members of structures, by ``B->A`` and by indices.
    """

    scope: Scope
    line: int
    members: dict[str, dict[tuple[int, ...], Value]] = field(default_factory=dict)
    member_lines: dict[str, int] = field(default_factory=dict)
    cells: dict[str, Cells] = field(default_factory=dict)

    def put(self, name: str, value: Value, line: int) -> None:
        """Note an array of one vector field, ``rk_A1_2``, or a number, ``rk_order``."""
        found = _NUMBERED.fullmatch(name)
        told = role_of(name)
        if found:
            stem, word = found["stem"] or "", found["word"]
            indices = tuple(int(x) for x in (found["l"], found["m"]) if x)
        elif told is not None and told[1] in {"order", "embedded_order"}:
            stem, word = told
            indices = ()
        else:
            return
        cells = self.cells.setdefault(stem, Cells(line))
        cells.put(word, indices, value)


@dataclass(frozen=True)
class Call:
    """A call of a function that makes a table.

    Attributes:
        name: of the function.
        line: where it is called.
        title: of the block around it.
        arguments: what it is given.
        label: the first argument where it is a constant in capitals: ``TSRK5DP``.
    """

    name: str
    line: int
    title: str
    arguments: tuple[Value, ...]
    label: str = ""


class CSource:
    """One pass over a source.

    Args:
        text: the source.
        wanted: which functions make tables.
        closed: told of each block when it ends, with what is known there.
        allowance: of the source.
    """

    def __init__(
        self,
        text: str,
        wanted: frozenset[str],
        closed: Callable[[Block], None],
        allowance: Allowance,
    ) -> None:
        code, self._definitions = _without_directives(text)
        self._tokens = without(tokens_of(code, C), "comment", "line")
        self._wanted = wanted
        self._closed = closed
        self._names: ChainMap[str, Value] = ChainMap(dict(CONSTANTS))
        self._blocks = [Block(Scope(), 1)]
        self._title = ""
        self._parens = 0
        self._enums = 0
        self._is_enum = False
        self._allowance = allowance
        self._parser = ValueParser(self._tokens, GRAMMAR, self._names, allowance)

    def calls(self) -> Iterator[Call]:
        """The calls that make tables, in order; blocks are told as they end."""
        self._define()
        place = 0
        last = len(self._tokens) - 1
        while place < last:
            token = self._tokens[place]
            self._allowance.line = token.line
            if token.kind == "name":
                self._is_enum = self._is_enum or token.text == "enum"
                call = self._call(place)
                if call is not None:
                    yield call
                place = self._after_name(place)
                continue
            if token.kind == "sign":
                self._bracket(token)
            place += 1
        while self._blocks:
            self._closed(self._blocks.pop())

    def _define(self) -> None:
        for name, text in self._definitions:
            tokens = without(tokens_of(text, C), "comment", "line")
            parser = ValueParser(tokens, GRAMMAR, self._names, self._allowance)
            try:
                value = parser.value_at(0)
            except Unreadable:
                continue
            is_whole = tokens[parser.place].kind == "end"
            if is_whole and isinstance(value, Scalar):
                self._names[name] = self._allowance.kept(value)

    def _bracket(self, token: Token) -> None:
        if token.text == "(":
            self._parens += 1
        elif token.text == ")":
            self._parens = max(0, self._parens - 1)
        elif token.text == "{" and self._is_enum:
            # its names belong to the block around it
            self._is_enum = False
            self._enums += 1
        elif token.text == "}" and self._enums:
            self._enums -= 1
        elif token.text == "{" and len(self._blocks) < MAX_SCOPES:
            title = self._title or self._blocks[-1].scope.title
            self._blocks.append(Block(Scope(title), token.line))
            self._names.maps.insert(0, {})
        elif token.text == "}" and len(self._blocks) > 1:
            self._closed(self._blocks.pop())
            self._names.maps.pop(0)
            if len(self._blocks) == 1:
                self._title = ""

    def _call(self, place: int) -> Call | None:
        token = self._tokens[place]
        if not self._is(place + 1, "("):
            return None
        inside = self._tokens[place + 2]
        if token.text in self._wanted and not self._is_declared(place):
            try:
                found = self._parser.arguments_at(place + 1)
            except Unreadable:
                return None
            values = tuple(value for _, value in found)
            title = self._title or self._blocks[-1].scope.title
            label = inside.text if inside.text.isupper() else ""
            return Call(token.text, token.line, title, values, label)
        if len(self._blocks) == 1 and not self._parens:
            # a function, or the macro ARK_BUTCHER_TABLE(NAME, {
            self._title = token.text
            if token.text.isupper() or token.text.endswith("_TABLE"):
                self._title = inside.text if inside.kind == "name" else ""
        return None

    def _is_declared(self, place: int) -> bool:
        """Whether a function is declared or defined here: its type stands before its name."""
        if not place:
            return False
        before = self._tokens[place - 1]
        if before.kind == "sign":
            return before.text == "*"
        return before.kind == "name" and before.text not in _BEFORE_VALUES

    def _is(self, place: int, sign: str) -> bool:
        token = self._tokens[min(place, len(self._tokens) - 1)]
        return token.kind == "sign" and token.text == sign

    def _after_name(self, place: int) -> int:
        """The place behind what a name begins: an assignment, or the name alone."""
        name, indices, at = self._target(place)
        if not self._is(at, "="):
            return place + 1
        try:
            value = self._parser.value_at(at + 1)
        except Unreadable:
            return at + 1
        behind = self._parser.place
        if not any(self._is(behind, sign) for sign in (";", ",", "}")):
            return at + 1
        self._assign(name, indices, value, self._tokens[place].line)
        return behind

    def _target(self, place: int) -> tuple[str, tuple[int, ...], int]:
        """What is assigned to: its name with members, its indices, the place behind it."""
        name = self._tokens[place].text
        at = place + 1
        for _ in range(MAX_MEMBERS):
            if not (self._is(at, "->") or self._is(at, ".")):
                break
            member = self._tokens[at + 1]
            if member.kind != "name":
                break
            name += f"->{member.text}"
            at += 2
        indices: list[int] = []
        while self._is(at, "[") and len(indices) < MAX_INDICES:
            index, at = self._index(at)
            indices.append(index)
        return name, tuple(indices), at

    def _index(self, at: int) -> tuple[int, int]:
        """A number in brackets, −1 where it is none; and the place behind."""
        if self._is(at + 1, "]"):
            return -1, at + 2
        try:
            value = whole(self._parser.value_at(at + 1))
        except Unreadable:
            value = None
            self._parser.place = at + 1
        end = self._parser.place
        while not self._is(end, "]"):
            token = self._tokens[end]
            if token.kind == "end" or token.text in {";", "{", "}"} or end > at + MAX_INDEX:
                return -1, end
            end += 1
        return (-1 if value is None else value), end + 1

    def _assign(self, name: str, indices: tuple[int, ...], value: Value, line: int) -> None:
        block = self._blocks[-1]
        plain = name.rpartition("->")[2]
        is_entry = isinstance(value, Scalar) and bool(indices)
        if "->" in name or is_entry:
            entries = block.members.setdefault(name, {})
            block.member_lines.setdefault(name, line)
            if all(0 <= index < MAX_STAGES for index in indices):
                entries[indices] = value
            return
        if isinstance(value, list) and len(indices) == 2:
            value = _filled(value, indices)
        if isinstance(value, list) and len(indices) == 1:
            value = _lengthened(value, indices[0])
        self._allowance.kept(value)
        self._names[plain] = value
        block.scope.add(plain, value, line)
        block.put(plain, value, line)


def _lengthened(value: list[Value], length: int) -> Value:
    """An array as C fills it: with zeros behind what is given."""
    missing = length - len(value)
    if not 0 < missing <= MAX_STAGES * MAX_STAGES:
        return value
    zeros: list[Value] = [number("0")] * missing
    return value + zeros


def _filled(value: list[Value], indices: tuple[int, ...]) -> Value:
    """The rows of an array as C fills them: with zeros behind what is given."""
    rows, columns = indices
    is_small = 0 <= rows <= MAX_STAGES and 0 <= columns <= MAX_STAGES
    if not is_small or not all(isinstance(row, list) for row in value):
        return value
    filled: list[Value] = []
    for row in value:
        assert isinstance(row, list)
        missing = columns - len(row)
        zeros: list[Value] = [number("0")] * missing
        filled.append([*row, *zeros])
    while len(filled) < rows:
        filled.append([number("0")] * columns)
    return filled


def _without_directives(text: str) -> tuple[str, list[tuple[str, str]]]:
    """The text with directives blanked out, and the names that they define."""
    definitions: list[tuple[str, str]] = []
    lines = text.split("\n")
    kept = []
    is_directive = False
    joined = ""
    for line in lines:
        is_directive = is_directive or line.lstrip().startswith("#")
        kept.append("" if is_directive else line)
        if not is_directive:
            continue
        ended = line.rstrip("\r")
        joined += ended.removesuffix("\\")
        if ended.endswith("\\"):
            continue
        found = _DEFINITION.match(joined.strip())
        if found:
            definitions.append((found[1], found[2]))
        is_directive = False
        joined = ""
    return "\n".join(kept), definitions
