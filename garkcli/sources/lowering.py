"""What the languages share in lowering their syntax trees."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice

from tree_sitter import Language, Node, Parser

from garkcli.sources import ir

_NUMBER = re.compile(r"(?<![\w.])[0-9]+(?:\.[0-9]*)?")
FEWEST_NUMBERS = 5
SHORT = 300
_WORDS = re.compile(
    r"tableau|butcher|register|[abc]coefficients|\*this\)\[|(?<![A-Za-z])[^\W\d_]{1,2}_?[0-9]+(?:_?[0-9]+)?\s*(?:=|,|\))"
    r"|(?<![A-Za-z])(?:[a-z]{0,3}_)?(?:A|a|b|B|c|C|amat|rka|α|β|γ|alpha|beta|weights|nodes)\w?\w?"
    r"(?:_\w+)?\s*(?::\s*[\w.]+(?:\[[\w., ]*\])?\s*=|\[|\(|=|\{|\.=)",
    re.IGNORECASE,
)
MAX_NESTING = 60
"""Deepest nesting of what is lowered."""


TOO_DEEP = ir.Opaque("an expression that is nested too deep")


class Lowering:
    """From a syntax tree to statements.

    Args:
        text: the source.
        language: its grammar.
    """

    comments = frozenset({"comment", "line_comment", "block_comment"})

    def __init__(self, text: str, language: Language) -> None:
        self._data = text.encode(errors="replace")
        self._language = language
        self._depth = 0

    def module(self) -> ir.Body:
        """The statements of the whole source."""
        return self.block(self.parse(self._data).named_children)

    def parse(self, data: bytes) -> Node:
        """The syntax tree; what does not belong to the language is in nodes of its own."""
        return Parser(self._language).parse(data).root_node

    def text(self, node: Node | None) -> str:
        """What a node is in the source."""
        if node is None:
            return ""
        return self._data[node.start_byte : node.end_byte].decode(errors="replace")

    def children(self, node: Node | None) -> list[Node]:
        """What is in a node, without comments."""
        if node is None:
            return []
        return [x for x in node.named_children if x.type not in self.comments]

    def block(self, nodes: Iterable[Node | None]) -> ir.Body:
        """Statements one after the other."""
        found: list[ir.Statement] = []
        for node in nodes:
            if node is not None and node.type not in self.comments:
                found += self._nested(node)
        return tuple(found)

    def _nested(self, node: Node) -> list[ir.Statement]:
        if self._depth >= MAX_NESTING:
            return []
        self._depth += 1
        try:
            return list(self.statement(node))
        finally:
            self._depth -= 1

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        """What a statement is lowered to."""
        raise NotImplementedError

    def passed_over(self, node: Node) -> ir.Statement:
        """What stands for a statement that may change values in ways that are not followed."""
        return ir.Do(ir.Opaque(f"a {node.type.replace('_', ' ')}"), line_of(node))

    def may_hold_a_table(self, node: Node) -> bool:
        """Whether the text of a function has numbers and names like those of a table."""
        text = self.text(node)
        fewest = 1 if len(text) < SHORT else FEWEST_NUMBERS
        numbers = _NUMBER.finditer(text)
        has_numbers = next(islice(numbers, fewest - 1, None), None) is not None
        return has_numbers and (len(text) < SHORT or bool(_WORDS.search(text)))

    def expr(self, node: Node | None) -> ir.Expr:
        """What an expression is lowered to."""
        if node is None:
            return ir.Nothing()
        if self._depth >= MAX_NESTING:
            return TOO_DEEP
        self._depth += 1
        try:
            return self.expression(node)
        finally:
            self._depth -= 1

    def expression(self, node: Node) -> ir.Expr:
        """The same, one level deeper."""
        raise NotImplementedError

    def ends(self, node: Node) -> list[ir.Expr | None]:
        """What is between the colons of a slice."""
        found: list[ir.Expr | None] = [None]
        for part in node.children:
            if part.type == ":":
                found.append(None)
            elif part.is_named:
                found[-1] = self.expr(part)
        return found

    def exprs(self, nodes: Iterable[Node]) -> tuple[ir.Expr, ...]:
        """Several expressions, without comments."""
        return tuple(self.expr(x) for x in nodes if x.type not in self.comments)


def line_of(node: Node) -> int:
    """The line of a node, from 1."""
    return int(node.start_point[0]) + 1


def less_one(expr: ir.Expr) -> ir.Expr:
    """What is one less: the last index before an end that is not included."""
    return ir.Binary("-", expr, ir.Literal("1", is_whole=True))


def unmeant(node: Node) -> ir.Opaque:
    """What has no meaning for constants."""
    return ir.Opaque(node.type.replace("_", " "))
