"""A place in a list of tokens, and what comes next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.lexing import Token
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import Value

MAX_DEPTH = 40
"""Deepest nesting of brackets, signs and functions."""


class Cursor:
    """A place in a list of tokens, within a language.

    Args:
        tokens: with one of kind ``end`` behind them.
        grammar: of the language.
        names: what names stand for.
        allowance: of the source.

    Attributes:
        place: of the next token.
    """

    def __init__(
        self,
        tokens: Sequence[Token],
        grammar: Grammar,
        names: Mapping[str, Value],
        allowance: Allowance,
    ) -> None:
        self.tokens = tokens
        self.grammar = grammar
        self.names = names
        self.allowance = allowance
        self.place = 0
        self._depth = 0

    def _begin(self, place: int) -> None:
        self.place = place
        self._depth = 0

    @property
    def _next(self) -> Token:
        return self.tokens[self.place]

    def _is(self, sign: str) -> bool:
        token = self._next
        return token.kind == "sign" and token.text == sign

    def _skip_lines(self) -> None:
        while self._next.kind == "line":
            self.place += 1

    def _deeper(self) -> None:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")

    def _to_the_next(self, closer: str) -> None:
        """Over the sign between two items; the last one has its bracket behind it."""
        self._skip_lines()
        if self._is(",") or self._is(";"):
            self.place += 1
            self._skip_lines()
        elif not self._is(closer):
            raise Unreadable(f"{closer} is expected")

    def _close(self, closer: str) -> None:
        self._skip_lines()
        if not self._is(closer):
            raise Unreadable(f"{closer} is expected")
        self.place += 1

    def _begins_factor(self) -> bool:
        token = self._next
        if token.kind in {"name", "number"}:
            return True
        return token.kind == "sign" and token.text == "("
