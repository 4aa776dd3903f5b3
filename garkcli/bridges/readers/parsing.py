"""Values from tokens: numbers, lists and matrices, by recursive descent with limits.

One parser serves C, MATLAB, Julia and Mathematica: a ``Grammar`` says which brackets hold lists,
which functions pass their argument on and which signs divide. Names stand for what was assigned to
them before; no function is ever called.
"""

from __future__ import annotations

from garkcli.bridges.readers.calls import end_of_argument, passed_on, reshaped, root_value
from garkcli.bridges.readers.cursor import Cursor
from garkcli.bridges.readers.matrices import joined
from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import UNKNOWN, Value, negated, number, of_text, power, whole

_QUOTIENTS = frozenset({"/", "//", "./"})
_PRODUCTS = frozenset({"*", ".*"})
_POWERS = frozenset({"^", "**", ".^"})


class ValueParser(Cursor):
    """Reads values from a list of tokens, from a place on; see ``Cursor``."""

    def value_at(self, place: int) -> Value:
        """The value that begins at a place; ``place`` is behind it then.

        Raises:
            Unreadable: none does.
        """
        self._begin(place)
        try:
            return self._sum()
        except Unreadable:
            self.allowance.read_again(self.place - place)
            raise

    def arguments_at(self, place: int) -> list[tuple[str, Value]]:
        """The arguments of a call whose bracket is at a place, those with a name with it; what
        cannot be read is ``UNKNOWN``.

        Raises:
            Unreadable: the bracket is not closed.
        """
        self._begin(place)
        return self._arguments(is_lenient=True)

    def _sum(self) -> Value:
        value = self._product()
        while self._next.kind == "sign" and self._next.text in {"+", "-"}:
            if self._ends_item():
                break
            sign = self._next.text
            self.place += 1
            value = self.allowance.combined(sign, value, self._product())
        return value

    def _product(self) -> Value:
        value = self._factor()
        while True:
            token = self._next
            if self._ends_item():
                return value
            if token.kind == "sign" and token.text in _PRODUCTS:
                self.place += 1
                value = self.allowance.combined("*", value, self._factor())
            elif token.kind == "sign" and token.text in _QUOTIENTS:
                self.place += 1
                value = self.allowance.combined("/", value, self._factor())
            elif self.grammar.is_implicit and self._begins_factor():
                value = self.allowance.combined("*", value, self._factor())
            else:
                return value

    def _factor(self) -> Value:
        self._deeper()
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
            base = self.allowance.transposed(base)
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
        behind = self.tokens[min(self.place + 1, len(self.tokens) - 1)]
        if opener == "&" and behind.kind == "name":
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
            return self.allowance.copied(self._entry(self.names[name]))
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
        return self.allowance.copied(self.names[name])

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
        kind = self.grammar.roots.get(name.lower())
        if kind is not None:
            values = [value for _, value in self._arguments()]
            return root_value(kind, values)
        if name not in self.grammar.passed and name not in {"zeros", "reshape"}:
            raise Unreadable(f"the function {name} is not known")
        found = self._arguments(is_lenient=True)
        values = [value for _, value in found]
        if name == "zeros":
            sizes = [whole(value) for value in values]
            return self.allowance.zeros([size for size in sizes if size is not None])
        return reshaped(values) if name == "reshape" else passed_on(name, values)

    def _arguments(self, is_lenient: bool = False) -> list[tuple[str, Value]]:
        closer = self.grammar.calls[self._next.text]
        in_matrix, self._in_matrix = self._in_matrix, False
        self.place += 1
        found: list[tuple[str, Value]] = []
        self._skip_lines()
        while not self._is(closer):
            key = self._keyword()
            found.append((key, self._argument(closer, is_lenient)))
            self._to_the_next(closer)
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
            self._depth = depth
            self._in_matrix = False
            self.place = end_of_argument(self.tokens, start, self.allowance)
            return UNKNOWN

    def _list(self, closer: str) -> Value:
        self._deeper()
        in_matrix, self._in_matrix = self._in_matrix, False
        self.place += 1
        items: list[Value] = []
        self._skip_lines()
        while not self._is(closer):
            items.append(self._sum())
            self._to_the_next(closer)
        self.place += 1
        self._depth -= 1
        self._in_matrix = in_matrix
        return items

    def _matrix(self, closer: str) -> Value:
        """Rows parted by semicolons or line ends, items by blanks or commas."""
        self._deeper()
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
        return joined(rows, has_semicolons)
