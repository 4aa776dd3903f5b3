"""Values from tokens: numbers and lists, by recursive descent with limits.

A ``Grammar`` says which brackets hold lists, which functions pass their argument on. Names stand
for what was assigned to them before; no function is ever called.
"""

from __future__ import annotations

from garkcli.bridges.readers.calls import end_of_argument, passed_on, root_value
from garkcli.bridges.readers.cursor import Cursor
from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import UNKNOWN, Value, negated, number, power

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

    def _sum(self) -> Value:
        value = self._product()
        while self._next.kind == "sign" and self._next.text in {"+", "-"}:
            sign = self._next.text
            self.place += 1
            value = self.allowance.combined(sign, value, self._product())
        return value

    def _product(self) -> Value:
        value = self._factor()
        while True:
            token = self._next
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
        if not is_power:
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
        if opener in grammar.lists:
            return self._list(grammar.lists[opener])
        if opener != "(":
            raise Unreadable("a number is expected")
        self.place += 1
        value = self._sum()
        self._close(")")
        return value

    def _named(self) -> Value:
        name = self._next.text
        self.place += 1
        token = self._next
        opens = token.kind == "sign" and token.text in self.grammar.calls
        if opens:
            return self._called(name)
        if name in self.names:
            return self.allowance.copied(self.names[name])
        if name in self.grammar.nothing:
            return None
        raise Unreadable(f"{name} has no value that is known")

    def _called(self, name: str) -> Value:
        kind = self.grammar.roots.get(name.lower())
        if kind is not None:
            values = [value for _, value in self._arguments()]
            return root_value(kind, values)
        if name not in self.grammar.passed:
            raise Unreadable(f"the function {name} is not known")
        found = self._arguments(is_lenient=True)
        values = [value for _, value in found]
        return passed_on(name, values)

    def _arguments(self, is_lenient: bool = False) -> list[tuple[str, Value]]:
        closer = self.grammar.calls[self._next.text]
        self.place += 1
        found: list[tuple[str, Value]] = []
        self._skip_lines()
        while not self._is(closer):
            key = self._keyword()
            found.append((key, self._argument(closer, is_lenient)))
            self._to_the_next(closer)
        self.place += 1
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
            self.place = end_of_argument(self.tokens, start, self.allowance)
            return UNKNOWN

    def _list(self, closer: str) -> Value:
        self._deeper()
        self.place += 1
        items: list[Value] = []
        self._skip_lines()
        while not self._is(closer):
            items.append(self._sum())
            self._to_the_next(closer)
        self.place += 1
        self._depth -= 1
        return items
