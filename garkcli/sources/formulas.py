"""Formulas with brackets as expressions: those of Mathematica, of LaTeX, of numbers in texts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.found import TooLarge, Unreadable
from garkcli.sources.lowering import MAX_NESTING

MAX_TOKENS = 1_000_000
"""Most tokens of a source."""
SLOT = ir.Name("#")
"""The variable of a polynomial."""
CLOSERS = {"(": ")", "[": "]", "{": "}", "<|": "|>"}
_LEVELS = {"->": 1, "+": 2, "-": 2, "*": 3, "/": 3, "^": 5, "**": 5}
_SIGN_LEVEL = 4
_PATTERN = re.compile(
    r"(?P<blank>[ \t\f\v\r]+|\\\r?\n|\(\*[\s\S]*?(?:\*\)|\Z))"
    r"|(?P<line>\n)"
    r'|(?P<text>"(?:[^"\\]|\\[\s\S])*+"?+)'
    r"|(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"(?:`{1,2}[0-9.]*)?(?:\*\^(?P<power>[+-]?[0-9]{1,4}))?"
    r"|(?P<name>[^\W\d_](?:\w*[^\W_])?)"
    r"|(?P<sign><\||\|>|->|:=|==|\*\*|[\s\S])"
)


class Token(Frozen):
    """A piece of a source.

    Attributes:
        kind: ``number``, ``name``, ``text``, ``sign`` or ``line``, an end of line.
        text: as it is written; of a text what is between its quotes.
        line: from 1.
    """

    kind: str
    text: str
    line: int


def _tokens(text: str) -> Iterator[Token]:
    line = 1
    for match in _PATTERN.finditer(text):
        kind = match.lastgroup or ""
        kind = "number" if kind == "power" else kind
        shown = match[kind]
        if kind == "text":
            shown = shown.strip('"')
        if kind == "number" and match["power"]:
            shown += f"e{int(match['power'])}"
        if kind != "blank":
            yield Token(kind, shown, line)
        line += match.group().count("\n")


class Formulas:
    """The tokens of a source, and the expressions that ranges of them are.

    Brackets are matched once; what cannot be read between two of them is unknown, and the rest is
    read.

    Args:
        text: the source.
        call: the bracket around the arguments of a function.
    """

    def __init__(self, text: str, call: str = "(") -> None:
        self.tokens: list[Token] = []
        for token in _tokens(text):
            self.tokens.append(token)
            if len(self.tokens) >= MAX_TOKENS:
                raise TooLarge(f"the source has more than {MAX_TOKENS} words and signs", token.line)
        self._call = call
        self._called_kinds = (ir.Name,) if call == "(" else (ir.Name, ir.Call, ir.Index)
        self._depth = 0
        self.closes = self._matched()

    def _matched(self) -> Mapping[int, int]:
        """The place of the bracket that closes each; the end for one that nothing closes."""
        found: dict[int, int] = {}
        waiting: list[int] = []
        for place, token in enumerate(self.tokens):
            if token.kind != "sign":
                continue
            if token.text in CLOSERS:
                waiting.append(place)
            elif waiting and token.text == CLOSERS[self.tokens[waiting[-1]].text]:
                found[waiting.pop()] = place
        return found | dict.fromkeys(waiting, len(self.tokens))

    def sign(self, at: int, end: int | None = None) -> str:
        """The sign at a place; empty for what is none."""
        if not at < (len(self.tokens) if end is None else end):
            return ""
        token = self.tokens[at]
        return token.text if token.kind == "sign" else ""

    def parts(self, start: int, end: int, *signs: str) -> Iterator[tuple[int, int]]:
        """The ranges between signs that are in no bracket."""
        first = at = start
        while at < end:
            token = self.tokens[at]
            if token.kind != "text" and token.text in signs:
                yield first, at
                first = at + 1
            at = self.closes.get(at, at) + 1
        if first < end:
            yield first, end

    def expression(self, start: int = 0, end: int | None = None) -> ir.Expr:
        """What a range of tokens is; without meaning where it cannot be read."""
        end = len(self.tokens) if end is None else end
        depth = self._depth
        try:
            found, at = self._sum(start, end, 0)
            if self._over_lines(at, end) < end:
                raise Unreadable(f"{self.tokens[at].text[:20]!r} behind a value")
        except Unreadable as error:
            self._depth = depth
            return ir.Opaque(error.message)
        return found

    def _over_lines(self, at: int, end: int) -> int:
        while at < end and (self.tokens[at].kind == "line" or self.sign(at) == "&"):
            at += 1
        return at

    def _sum(self, at: int, end: int, level: int) -> tuple[ir.Expr, int]:
        """The value that begins at a place, with signs that hold at least so tightly."""
        self._depth += 1
        if self._depth > MAX_NESTING:
            raise Unreadable("an expression that is nested too deep")
        left, at = self._signed(at, end)
        while (at := self._over_lines(at, end)) < end:
            sign, step = self.sign(at), 1
            if not sign or sign in CLOSERS or sign == "#":
                sign, step = "*", 0
            own = _LEVELS.get(sign, -1)
            if own < level:
                break
            right, at = self._sum(at + step, end, own if own == _LEVELS["^"] else own + 1)
            left = ir.Binary("^" if sign == "**" else sign, left, right)
        self._depth -= 1
        return left, at

    def _signed(self, at: int, end: int) -> tuple[ir.Expr, int]:
        at = self._over_lines(at, end)
        signs = []
        while self.sign(at, end) in {"+", "-"}:
            signs.append(self.sign(at))
            at = self._over_lines(at + 1, end)
        if not signs:
            return self._atom(at, end)
        found, at = self._sum(at, end, _SIGN_LEVEL)
        return (ir.Unary("-", found) if signs.count("-") % 2 else found), at

    def _atom(self, at: int, end: int) -> tuple[ir.Expr, int]:
        if not at < end:
            raise Unreadable("a number is expected")
        token, place = self.tokens[at], at
        found: ir.Expr
        match token.kind, token.text:
            case "number", text:
                found = ir.Literal(f"0{text}" if text[0] == "." else text)
            case "text", text:
                found = ir.Text(text)
            case ("sign", "#") | ("name", "x") if token.text == "#" or self._call == "(":
                found = SLOT
            case "name", text:
                found = ir.Name(text)
            case "sign", "(":
                found = self.expression(at + 1, self.closes[at])
                place = self.closes[at]
            case "sign", "{" | "<|":
                found = self._items(at)
                place = self.closes[at]
            case _:
                raise Unreadable("a number is expected")
        at = place + 1
        while self.sign(at, end) == self._call and isinstance(found, self._called_kinds):
            found = self._called(found, at)
            at = self.closes[at] + 1
        return found, min(at, end)

    def arguments(self, at: int) -> tuple[ir.Expr, ...]:
        """What is between two brackets, with commas between."""
        return tuple(self.expression(*part) for part in self.parts(at + 1, self.closes[at], ","))

    def _called(self, callee: ir.Expr, at: int) -> ir.Expr:
        if self.sign(at + 1) == "[" and self.closes[at + 1] == self.closes[at] - 1:
            # a[[1, 2]]
            return ir.Index(callee, self.arguments(at + 1))
        args = self.arguments(at)
        if args and all(isinstance(x, ir.Text) for x in args):
            # a["b"]
            return ir.Index(callee, args)
        return ir.Call(callee, args)

    def _items(self, at: int) -> ir.Expr:
        """A list; one with rules in it is values by their names."""
        items = self.arguments(at)
        pairs = []
        for x in items:
            match x:
                case ir.Binary(sign="->", left=ir.Text(text=key) | ir.Name(name=key), right=value):
                    pairs.append((key, value))
        return ir.Fields(tuple(pairs), self.tokens[at].line) if pairs else ir.Items(items)


def formula(text: str) -> ir.Expr:
    """The number that a text is, as method files write it: ``1/2 - sqrt(3)/6``."""
    return Formulas(text).expression()
