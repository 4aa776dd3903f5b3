"""Formulas with brackets as expressions: of Mathematica, of LaTeX, of numbers in texts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.found import TooLarge, Unreadable
from garkcli.sources.lowering import MAX_NESTING

MAX_TOKENS = 1_000_000
"""Most tokens of a source."""
SLOT = ir.Name("#")
"""The variable of a polynomial."""
_JOINING = frozenset({"=", ":=", "+", "-", "*", "/", "^", ",", "->", "\n"})
"""Signs after which a line continues."""
CLOSERS = {"(": ")", "[": "]", "{": "}", "<|": "|>"}
_LEVELS = {"->": 1, "+": 2, "-": 2, "*": 3, "/": 3, "^": 5, "**": 5}
_SIGN_LEVEL = 4
_PATTERN = re.compile(
    r"(?P<blank>[ \t\f\v\r&]+|\\\r?\n|\(\*[\s\S]*?(?:\*\)|\Z))"
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
        kind: ``number``, ``name``, ``text``, ``sign`` or ``line``, the end of a line in no bracket.
        text: as written; for a text without its quotes.
        line: from 1.
    """

    kind: str
    text: str
    line: int


class Formulas:
    """The tokens of a source, and the expressions of ranges of them.

    Brackets are matched once; an unreadable part between two brackets is unknown, and the rest is
    read.

    Args:
        text: the source.
        call: the bracket around the arguments of a function.
    """

    def __init__(self, text: str, call: str = "(") -> None:
        self.tokens: list[Token] = []
        self.closes: dict[int, int] = {}
        """The place of the closing bracket of each; the end of the source if it is never closed."""
        self._call = call
        self._called_kinds = (ir.Name,) if call == "(" else (ir.Name, ir.Call, ir.Index)
        self._depth = 0
        waiting: list[int] = []
        line, before = 1, "\n"
        for match in _PATTERN.finditer(text):
            power = match["power"]
            kind = "number" if power else match.lastgroup or ""
            shown = match[kind].strip('"') + (f"e{int(power)}" if power else "")
            if kind == "sign" and shown in CLOSERS:
                waiting.append(len(self.tokens))
            elif kind == "sign" and waiting and shown == CLOSERS[self.tokens[waiting[-1]].text]:
                self.closes[waiting.pop()] = len(self.tokens)
            is_within = kind == "line" and (waiting or before in _JOINING)
            if kind != "blank" and not is_within:
                self.tokens.append(Token(kind, shown, line))
                before = shown
            if len(self.tokens) >= MAX_TOKENS:
                raise TooLarge(f"the source has more than {MAX_TOKENS} words and signs", line)
            line += match.group().count("\n")
        self.closes |= dict.fromkeys(waiting, len(self.tokens))

    def sign(self, at: int, end: int | None = None) -> str:
        """The sign at a place; empty for other tokens."""
        if not at < (len(self.tokens) if end is None else end):
            return ""
        token = self.tokens[at]
        return token.text if token.kind == "sign" else ""

    def parts(self, start: int, end: int, *signs: str) -> Iterator[tuple[int, int]]:
        """The ranges between signs outside all brackets."""
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
        """The expression of a range of tokens; Opaque if it cannot be read."""
        end = len(self.tokens) if end is None else end
        depth = self._depth
        try:
            value, at = self._sum(start, end, 0)
            if at < end:
                raise Unreadable(f"{self.tokens[at].text[:20]!r} behind a value")
        except Unreadable as error:
            self._depth = depth
            return ir.Opaque(error.message)
        return value

    def _sum(self, at: int, end: int, level: int) -> tuple[ir.Expr, int]:
        """The value that begins at a place, with operators of at least a precedence."""
        self._depth += 1
        if self._depth > MAX_NESTING:
            raise Unreadable("an expression that is nested too deep")
        sign = self.sign(at, end)
        if sign in {"+", "-"}:
            left, at = self._sum(at + 1, end, _SIGN_LEVEL)
            left = ir.Unary(sign, left)
        else:
            left, at = self._atom(at, end)
        while at < end:
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

    def _atom(self, at: int, end: int) -> tuple[ir.Expr, int]:
        if not at < end:
            raise Unreadable("a number is expected")
        token, place = self.tokens[at], self.closes.get(at, at)
        atom: ir.Expr
        match token.kind, token.text:
            case "number", text:
                atom = ir.Literal(f"0{text}" if text[0] == "." else text)
            case "text", text:
                atom = ir.Text(text)
            case ("sign", "#") | ("name", "x") if token.text == "#" or self._call == "(":
                atom = SLOT
            case "name", text:
                atom = ir.Name(text)
            case "sign", "(":
                atom = self.expression(at + 1, place)
            case "sign", "{" | "<|":
                atom = self._items(at)
            case _:
                raise Unreadable("a number is expected")
        at = place + 1
        while self.sign(at, end) == self._call and isinstance(atom, self._called_kinds):
            atom = self._called(atom, at)
            at = self.closes[at] + 1
        return atom, min(at, end)

    def arguments(self, at: int) -> tuple[ir.Expr, ...]:
        """The arguments between two brackets, separated by commas."""
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
        """A list; with rules in it, values by their names."""
        items = self.arguments(at)
        pairs = []
        for x in items:
            match x:
                case ir.Binary(sign="->", left=ir.Text(text=key) | ir.Name(name=key), right=value):
                    pairs.append((key, value))
        return ir.Fields(tuple(pairs), self.tokens[at].line) if pairs else ir.Items(items)


def formula(text: str) -> ir.Expr:
    """The number in a text in the notation of method files: ``1/2 - sqrt(3)/6``."""
    return Formulas(text).expression()
