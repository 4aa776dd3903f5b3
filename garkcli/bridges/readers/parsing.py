"""Values from tokens: numbers, lists and matrices, by recursive descent with limits.

One parser serves C, MATLAB, Julia and Mathematica: a ``Grammar`` says which brackets hold lists,
which functions pass their argument on and which signs divide. Names stand for what was assigned to
them before; no function is ever called.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from garkcli.bridges.readers.found import Unreadable
from garkcli.bridges.readers.lexing import Token
from garkcli.bridges.readers.scalars import (
    ROOTS,
    UNKNOWN,
    Scalar,
    Value,
    combined,
    negated,
    number,
    of_text,
    power,
    real_root,
    rooted,
    transposed,
    whole,
    zeros,
)

MAX_DEPTH = 40
"""Deepest nesting of brackets, signs and functions."""


@dataclass(frozen=True)
class Grammar:
    """How values are written in a language.

    Attributes:
        lists: brackets around lists with commas between the items.
        matrices: brackets around rows with semicolons or line ends, items with blanks between.
        calls: brackets around the arguments of a function.
        roots: names of functions that are roots; in lower letters.
        passed: functions that pass on their last argument: types, roundings, wrappers.
        nothing: names of what is no value.
        is_implicit: whether two factors side by side are a product.
        has_indices: whether ``A[0]`` is an entry of A.
        commas_join: whether a comma in a matrix joins blocks, as a blank does.
    """

    lists: Mapping[str, str] = field(default_factory=dict)
    matrices: Mapping[str, str] = field(default_factory=dict)
    calls: Mapping[str, str] = field(default_factory=lambda: {"(": ")"})
    roots: Mapping[str, str] = field(default_factory=lambda: ROOTS)
    passed: frozenset[str] = frozenset()
    nothing: frozenset[str] = frozenset()
    is_implicit: bool = False
    has_indices: bool = False
    commas_join: bool = True


_QUOTIENTS = frozenset({"/", "//", "./"})
_PRODUCTS = frozenset({"*", ".*"})
_POWERS = frozenset({"^", "**", ".^"})


class ValueParser:
    """Reads values from a list of tokens, from a place on.

    Args:
        tokens: with one of kind ``end`` behind them.
        grammar: of the language.
        names: what names stand for.

    Attributes:
        place: of the next token.
    """

    def __init__(
        self,
        tokens: Sequence[Token],
        grammar: Grammar,
        names: Mapping[str, Value],
    ) -> None:
        self.tokens = tokens
        self.grammar = grammar
        self.names = names
        self.place = 0
        self._depth = 0
        self._in_matrix = False

    def value_at(self, place: int) -> Value:
        """The value that begins at a place; ``place`` is behind it then.

        Raises:
            Unreadable: none does.
        """
        self.place = place
        self._depth = 0
        self._in_matrix = False
        return self._sum()

    def arguments_at(self, place: int) -> list[tuple[str, Value]]:
        """The arguments of a call whose bracket is at a place, those with a name with it; what
        cannot be read is ``UNKNOWN``.

        Raises:
            Unreadable: the bracket is not closed.
        """
        self.place = place
        self._depth = 0
        self._in_matrix = False
        return self._arguments(is_lenient=True)

    @property
    def _next(self) -> Token:
        return self.tokens[self.place]

    def _is(self, sign: str) -> bool:
        token = self._next
        return token.kind == "sign" and token.text == sign

    def _skip_lines(self) -> None:
        while self._next.kind == "line":
            self.place += 1

    def _ends_item(self) -> bool:
        """Whether a new item of a row of a matrix begins here: blanks part them."""
        token = self._next
        if not self._in_matrix or not token.is_spaced:
            return False
        if token.kind != "sign" or token.text in self._openers:
            return True
        behind = self.tokens[self.place + 1]
        return token.text in "+-" and not behind.is_spaced

    @property
    def _openers(self) -> frozenset[str]:
        grammar = self.grammar
        return frozenset({"(", *grammar.lists, *grammar.matrices})

    def _sum(self) -> Value:
        value = self._product()
        while self._next.kind == "sign" and self._next.text in {"+", "-"}:
            if self._ends_item():
                break
            sign = self._next.text
            self.place += 1
            value = combined(sign, value, self._product())
        return value

    def _product(self) -> Value:
        value = self._factor()
        while True:
            token = self._next
            if self._ends_item():
                return value
            if token.kind == "sign" and token.text in _PRODUCTS:
                self.place += 1
                value = combined("*", value, self._factor())
            elif token.kind == "sign" and token.text in _QUOTIENTS:
                self.place += 1
                value = combined("/", value, self._factor())
            elif self.grammar.is_implicit and self._begins_factor():
                value = combined("*", value, self._factor())
            else:
                return value

    def _begins_factor(self) -> bool:
        token = self._next
        if token.kind in {"name", "number"}:
            return True
        return token.kind == "sign" and token.text == "("

    def _factor(self) -> Value:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")
        try:
            if self._is("-"):
                self.place += 1
                return negated(self._factor())
            if self._is("+"):
                self.place += 1
                return self._factor()
            return self._power()
        finally:
            self._depth -= 1

    def _power(self) -> Value:
        base = self._atom()
        while self._is("'") and not self._next.is_spaced:
            self.place += 1
            base = transposed(base)
        token = self._next
        is_power = token.kind == "sign" and token.text in _POWERS
        if not is_power or self._ends_item():
            return base
        self.place += 1
        return power(base, self._factor())

    def _atom(self) -> Value:
        token = self._next
        if token.kind == "number":
            self.place += 1
            return number(token.text)
        if token.kind == "text":
            self.place += 1
            return token.text
        if token.kind == "name":
            return self._named()
        if token.kind == "sign":
            return self._bracketed(token.text)
        raise Unreadable("a number is expected")

    def _bracketed(self, opener: str) -> Value:
        grammar = self.grammar
        if opener == "&" and self.tokens[self.place + 1].kind == "name":
            return self._address()
        if opener in grammar.matrices:
            return self._matrix(grammar.matrices[opener])
        if opener in grammar.lists:
            return self._list(grammar.lists[opener])
        if opener != "(":
            raise Unreadable("a number is expected")
        in_matrix, self._in_matrix = self._in_matrix, False
        self.place += 1
        value = self._sum()
        self._close(")")
        self._in_matrix = in_matrix
        if value is None and self._begins_factor():
            # (double) 1: the type is passed over
            return self._factor()
        return value

    def _close(self, closer: str) -> None:
        self._skip_lines()
        if not self._is(closer):
            raise Unreadable(f"{closer} is expected")
        self.place += 1

    def _named(self) -> Value:
        name = self._next.text
        self.place += 1
        token = self._next
        opens = token.kind == "sign" and token.text in self.grammar.calls
        if opens and not self._ends_item():
            return self._called(name)
        if token.kind == "text" and not token.is_spaced:
            # big"0.1" of Julia
            self.place += 1
            return of_text(token.text)
        if name in self.names:
            return self._entry(self.names[name])
        if name in self.grammar.nothing:
            return None
        if name in self.grammar.passed:
            return self._typed()
        raise Unreadable(f"{name} has no value that is known")

    def _address(self) -> Value:
        """The array of ``&A[0][0]``."""
        self.place += 1
        name = self._next.text
        self.place += 1
        for _ in range(2):
            if self._is("["):
                self.place += 1
                self._sum()
                self._close("]")
        if name not in self.names:
            raise Unreadable(f"{name} has no value that is known")
        return self.names[name]

    def _entry(self, value: Value) -> Value:
        """The value, or the entry of it that indices from 0 name."""
        while self.grammar.has_indices and self._is("["):
            self.place += 1
            index = whole(self._sum())
            self._close("]")
            if not isinstance(value, list) or index is None:
                raise Unreadable("an entry of what is no list")
            if not 0 <= index < len(value):
                raise Unreadable("an entry that is not there")
            value = value[index]
        return value

    def _typed(self) -> Value:
        """What stands behind the name of a type: the list of Float64[1, 2]."""
        token = self._next
        is_list = token.kind == "sign" and token.text in self.grammar.matrices
        return self._bracketed(token.text) if is_list else None

    def _called(self, name: str) -> Value:
        plain = name.lower()
        if plain in self.grammar.roots:
            values = [value for _, value in self._arguments()]
            return _root(self.grammar.roots[plain], values)
        is_zeros = name == "zeros"
        is_shape = is_zeros or name == "reshape"
        if name not in self.grammar.passed and not is_shape:
            raise Unreadable(f"the function {name} is not known")
        found = self._arguments(is_lenient=True)
        if name == "reshape":
            return _reshaped([value for _, value in found])
        if is_zeros:
            sizes = [whole(value) for _, value in found]
            return zeros([x for x in sizes if x is not None])
        values = [value for _, value in found if isinstance(value, Scalar)]
        lists = [value for _, value in found if isinstance(value, list)]
        if lists:
            return lists[-1]
        if values:
            return values[0]
        words = [value for _, value in found if isinstance(value, str)]
        if words:
            return of_text(words[0])
        raise Unreadable(f"{name} of what is no number")

    def _arguments(self, is_lenient: bool = False) -> list[tuple[str, Value]]:
        closer = self.grammar.calls[self._next.text]
        in_matrix, self._in_matrix = self._in_matrix, False
        self.place += 1
        found: list[tuple[str, Value]] = []
        self._skip_lines()
        while not self._is(closer):
            key = self._keyword()
            found.append((key, self._argument(closer, is_lenient)))
            self._skip_lines()
            if self._is(",") or self._is(";"):
                self.place += 1
                self._skip_lines()
            elif not self._is(closer):
                raise Unreadable(f"{closer} is expected")
        self.place += 1
        self._in_matrix = in_matrix
        return found

    def _keyword(self) -> str:
        """The name before = that an argument may have."""
        behind = self.tokens[min(self.place + 1, len(self.tokens) - 1)]
        is_sign = behind.kind == "sign" and behind.text == "="
        if self._next.kind != "name" or not is_sign:
            return ""
        name = self._next.text
        self.place += 2
        return name

    def _argument(self, closer: str, is_lenient: bool) -> Value:
        start = self.place
        depth = self._depth
        try:
            self._skip_lines()
            value = self._sum()
            self._skip_lines()
            if self._is(",") or self._is(";") or self._is(closer):
                return value
            raise Unreadable("one value is expected")
        except Unreadable:
            if not is_lenient:
                raise
            self.place = start
            self._depth = depth
            self._in_matrix = False
            self._skip_argument()
            return UNKNOWN

    def _skip_argument(self) -> None:
        """To the comma or bracket behind what cannot be read."""
        open_brackets = 0
        while self._next.kind != "end":
            token = self._next
            if token.kind == "sign" and token.text in ("(", "[", "{"):
                open_brackets += 1
            elif token.kind == "sign" and token.text in (")", "]", "}"):
                open_brackets -= 1
                if open_brackets < 0:
                    return
            elif not open_brackets and token.text in (",", ";"):
                return
            self.place += 1
        raise Unreadable("a bracket is not closed")

    def _list(self, closer: str) -> Value:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")
        in_matrix, self._in_matrix = self._in_matrix, False
        self.place += 1
        items: list[Value] = []
        self._skip_lines()
        while not self._is(closer):
            items.append(self._sum())
            self._skip_lines()
            if self._is(","):
                self.place += 1
                self._skip_lines()
            elif not self._is(closer):
                raise Unreadable(f"{closer} is expected")
        self.place += 1
        self._depth -= 1
        self._in_matrix = in_matrix
        return items

    def _matrix(self, closer: str) -> Value:
        """Rows parted by semicolons or line ends, items by blanks or commas."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")
        in_matrix, self._in_matrix = self._in_matrix, True
        self.place += 1
        rows: list[list[Value]] = [[]]
        has_semicolons = False
        is_list = False
        while not self._is(closer):
            if self._is(";") or self._next.kind == "line":
                has_semicolons = has_semicolons or self._is(";")
                if rows[-1]:
                    rows.append([])
                self.place += 1
            elif self._is(","):
                is_list = not self.grammar.commas_join
                self.place += 1
                self._skip_lines()
            elif self._next.kind == "end":
                raise Unreadable(f"{closer} is expected")
            else:
                rows[-1].append(self._sum())
        self.place += 1
        self._depth -= 1
        self._in_matrix = in_matrix
        if is_list:
            return [item for row in rows for item in row]
        return _joined(rows, has_semicolons)


def _reshaped(values: Sequence[Value]) -> Value:
    """``reshape(list, rows, columns)``: the list has the columns one after the other."""
    if len(values) != 3 or not isinstance(values[0], list):
        raise Unreadable("reshape of what is no list")
    rows, columns = whole(values[1]), whole(values[2])
    entries = values[0]
    if rows is None or columns is None or rows * columns != len(entries):
        raise Unreadable("a shape that does not fit")
    return [
        [entries[j * rows + i] for j in range(columns)] for i in range(rows)
    ]


def _root(kind: str, values: Sequence[Value]) -> Value:
    if kind == "sqrt" and len(values) == 1:
        return rooted(values[0], 2)
    if kind == "cbrt" and len(values) == 1:
        return rooted(values[0], 3)
    if kind == "power" and len(values) == 2:
        return power(values[0], values[1])
    if kind == "rational" and len(values) == 2:
        return combined("/", values[0], values[1])
    if kind == "root" and len(values) == 2:
        index = whole(values[1])
        if index is not None and index > 1:
            return rooted(values[0], index)
    if kind == "algebraic" and len(values) == 2:
        return real_root(values[0], values[1])
    raise Unreadable("a function with other arguments than it has")


def _joined(rows: list[list[Value]], has_semicolons: bool) -> Value:
    """The matrix of rows, whose items may be rows and blocks themselves."""
    if rows and not rows[-1]:
        rows = rows[:-1]
    has_lists = any(isinstance(x, list) for row in rows for x in row)
    if len(rows) == 1 and not has_lists:
        return list(rows[0])
    if not has_lists:
        return [list(row) for row in rows]
    if len(rows) == 1 and not has_semicolons:
        return _side_by_side(rows[0])
    blocks: list[Value] = []
    for row in rows:
        beside = _side_by_side(row)
        if isinstance(beside, list) and any(
            isinstance(x, list) for x in beside
        ):
            blocks += beside
        else:
            blocks.append(beside)
    return blocks


def _side_by_side(items: list[Value]) -> Value:
    """Columns and blocks beside each other; a list of lists stays as it is."""
    if all(isinstance(x, Scalar) for x in items):
        return list(items)
    has_matrix = any(
        isinstance(x, list) and any(isinstance(y, list) for y in x)
        for x in items
    )
    lists = [x for x in items if isinstance(x, list)]
    if has_matrix and len(lists) == len(items):
        heights = {len(x) for x in lists}
        if len(heights) == 1:
            return _beside(lists)
    if len(lists) == len(items):
        return list(items)
    # a row: [q, b]
    row: list[Value] = []
    for item in items:
        row += item if isinstance(item, list) else [item]
    return row


def _beside(blocks: Sequence[list[Value]]) -> Value:
    joined: list[Value] = []
    for parts in zip(*blocks, strict=True):
        row: list[Value] = []
        for part in parts:
            row += part if isinstance(part, list) else [part]
        joined.append(row)
    return joined
