"""Assignments of Mathematica, one after the other, by one walk over tokens."""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping

from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.lexing import Token
from garkcli.bridges.readers.parsing import ValueParser
from garkcli.frozen import Frozen
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import Value

MAX_MEMBERS = 10
"""Most members of a name, such as those of ``a.b.c``."""
MAX_INDICES = 12
"""Most tokens between the brackets of indices."""
_CLOSERS = {"(": ")", "[": "]", "{": "}"}


class Assigned(Frozen):
    """A name with members, such as ``m.A``, that has a value from a line on.

    Attributes:
        name: as it is written.
        indices: those behind it, from 1 as these languages count; 0 for what is no number.
        value: what it is.
        line: of the name.
    """

    name: str
    indices: tuple[int, ...]
    value: Value
    line: int


class Begun(Frozen):
    """A function, a branch or a title begins here."""

    title: str
    line: int


Event = Assigned | Begun


class Walk:
    """One walk over a source.

    Args:
        tokens: without comments, with one of kind ``end`` behind them.
        grammar: of the language.
        ends: what may stand behind a value.
        begins: the title that a token gives to what follows; empty for most.
        allowance: of the source.
    """

    def __init__(
        self,
        tokens: list[Token],
        grammar: Grammar,
        ends: frozenset[str],
        begins: Callable[[list[Token], int], str],
        allowance: Allowance,
    ) -> None:
        self._tokens = tokens
        self._ends = ends
        self._begins = begins
        self.names: MutableMapping[str, Value] = {}
        self._allowance = allowance
        self._parser = ValueParser(tokens, grammar, self.names, allowance)

    def events(self) -> Iterator[Event]:
        """What happens, in order."""
        place = 0
        last = len(self._tokens) - 1
        while place < last:
            token = self._tokens[place]
            self._allowance.line = token.line
            title = self._begins(self._tokens, place)
            if title:
                yield Begun(title, token.line)
            if token.kind == "name":
                assigned, place = self._assignment(place)
                if assigned is not None:
                    yield assigned
                continue
            place += 1

    def _is(self, place: int, *signs: str) -> bool:
        token = self._tokens[min(place, len(self._tokens) - 1)]
        return token.kind == "sign" and token.text in signs

    def _assignment(self, place: int) -> tuple[Assigned | None, int]:
        """What is assigned here, if anything is, and where to go on."""
        name = self._tokens[place].text
        at = place + 1
        for _ in range(MAX_MEMBERS):
            if not self._is(at, ".") or self._tokens[at + 1].kind != "name":
                break
            name += f".{self._tokens[at + 1].text}"
            at += 2
        indices, behind = self._indices(at)
        if not self._is(behind, "=", ":="):
            return None, place + 1
        line = self._tokens[place].line
        start = behind + 1
        while self._tokens[start].kind == "line":
            start += 1
        try:
            value = self._allowance.kept(self._parser.value_at(start))
        except Unreadable:
            self.names.pop(name, None)
            return None, start
        behind = self._parser.place
        token = self._tokens[behind]
        is_end = token.kind in {"line", "end"} or token.text in self._ends
        if not is_end:
            self.names.pop(name, None)
            return None, start
        if indices:
            _put(self.names.get(name), indices, value)
        else:
            self.names[name] = value
        return Assigned(name, indices, value, line), behind

    def _indices(self, at: int) -> tuple[tuple[int, ...], int]:
        """The indices behind a name, and the place behind them."""
        closer = _CLOSERS.get(self._tokens[at].text)
        if closer is None or self._tokens[at].kind != "sign":
            return (), at
        found: list[int] = []
        for place in range(at + 1, min(at + MAX_INDICES, len(self._tokens))):
            token = self._tokens[place]
            if token.text == closer:
                return tuple(found), place + 1
            if token.kind in {"number", "name"}:
                is_index = token.text.isdigit() and len(token.text) < 4
                found.append(int(token.text) if is_index else 0)
            elif token.text not in {",", "_", ":"}:
                break
        return (), at


def _put(array: Value | None, indices: tuple[int, ...], value: Value) -> None:
    """An entry of an array that is known; indices count from 1."""
    for index in indices[:-1]:
        if not isinstance(array, list) or not 0 < index <= len(array):
            return
        array = array[index - 1]
    last = indices[-1]
    if not isinstance(array, list) or not 0 < last <= len(array):
        return
    if isinstance(array[last - 1], list) == isinstance(value, list):
        array[last - 1] = value
