"""MATLAB and Octave."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.sources import ir
from garkcli.sources.lowering import Lowering, kinds, line_of, part, reader, unmeant

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "matlab"
_SQUARE = frozenset({"zeros", "ones"})
"""Functions that make a square matrix from a single number."""
_KEPT = re.compile(r"^[ \t]*(?:persistent|global)[ \t]+(?=\w+[ \t]*=)", re.MULTILINE)
"""A value of a name that stays, ``persistent a = 1``."""
_OCTAVE = re.compile(r"^[ \t]*(?:#|end_?(?:if|for|function|while|switch)\b)", re.MULTILINE)
_COMMENT = re.compile(r"^([^\n\"']*?(?<![^\s;,)\]]))#", re.MULTILINE)
_CODE = re.compile(r"^[^\n\"'%]*", re.MULTILINE)
"""A line before texts and comments."""
_NOT = re.compile(r"!(?=[ \t]*[(=\w])")
_END = re.compile(r"\bend(_?(?:if|for|function|while|switch))\b")


def as_matlab(text: str) -> str:
    """A source without the words that only Octave has, each character at its place."""
    text = _KEPT.sub(lambda x: " " * len(x[0]), text)
    if not _OCTAVE.search(text):
        return text
    text = _END.sub(lambda x: "end" + " " * len(x[1]), _COMMENT.sub(r"\1%", text))
    return _CODE.sub(lambda x: _NOT.sub("~", x[0]), text)


class MatlabLowering(Lowering):
    """Functions, matrices, cells and structures of MATLAB."""

    grammar = "tree_sitter_matlab"
    kinds = kinds(
        comment="line_continuation",
        block="source_file block ERROR methods properties",
        tried="try_statement",
        assignment="assignment",
        switch="switch_statement",
        case="case_clause otherwise_clause",
        name="identifier boolean",
        number="number",
        text="string",
        list="multioutput_variable",
        inside="parenthesis default_value",
        unary="unary_operator",
        binary="binary_operator",
        range="range",
        transposed="postfix_operator",
    )

    def __init__(self, text: str, grammar: str | None = None) -> None:
        super().__init__(as_matlab(text), grammar)

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "function_definition":
                given = [x.named_children for x in inside if x.type == "function_arguments"]
                parameters = tuple(self.text(x) for each in given for x in each)
                name, body = self.text(part(node, "name")), self.block(inside[-1:])
                gives = self._return_value(node) if len(parameters) == 1 else ""
                if gives:
                    # get.A(this) of a class returns the property A
                    body += (ir.Return(ir.Name(gives), line),)
                yield ir.Scope(
                    "function", name, body, line, parameters, gives=name if gives else ""
                )
            case "class_definition":
                name, body = self.text(part(node, "name") or inside[0]), self.block(inside[1:])
                yield ir.Scope("class", name, body, line)
            case "property" if len(inside) > 1:
                yield ir.Assign(self.expr(inside[0]), self.expr(inside[-1]), line)
            case "for_statement":
                bound = self.children(inside[0]) if inside else []
                counter, over = bound if len(bound) == 2 else (None, None)
                yield self.loop(node, self.text(counter), self.expr(over))
            case "function_call" | "field_expression":
                yield ir.Do(self.expr(node), line)

    def _return_value(self, node: Node) -> str:
        """The only return value of a method of a class; empty for other functions."""
        is_method = node.parent is not None and node.parent.type == "methods"
        output = next((x for x in node.named_children if x.type == "function_output"), None)
        names = [self.text(x) for x in self.children(output) if self.is_a("name", x)]
        return names[0] if is_method and len(names) == 1 else ""

    def way(self, condition: list[Node], inside: list[Node]) -> ir.Body:
        """An arm of an ``if``, named by the text in its condition."""
        body, name = self.block(inside), "".join(map(self.title, condition))
        return (ir.Scope("entry", name, body, line_of(condition[0])),) if name else body

    def title(self, node: Node | None) -> str:
        """The first text in a value."""
        if self.is_a("text", node):
            return self.text(node).strip("'\"")
        return next(filter(None, map(self.title, self.children(node))), "")

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "end_keyword":
                return ir.Name("end")
            case "matrix" | "cell":
                rows = tuple(self.exprs(x.named_children) for x in inside if x.type == "row")
                if node.type == "matrix" and rows:
                    return ir.Rows(rows, is_row_a_matrix=False)
                return ir.Items(rows[0] if len(rows) == 1 else tuple(map(ir.Items, rows)))
            case "function_call":
                # this@Base(…) constructs the base class
                base = next((x for x in inside if x.type == "superclass"), None)
                if base is not None:
                    return self._called(ir.Name(self.text(base).rpartition(".")[2]), node)
                return self._called(self.expr(part(node, "name")), node)
            case "field_expression":
                # m.A and m.A{1,2}, where the call is on the field
                of = self.expr(part(node, "object"))
                for each in inside[1:]:
                    name = part(each, "name")
                    entry = ir.Field(of, self.text(name or each))
                    of = entry if name is None else self._called(entry, each)
                return of
            case "spread_operator":
                return ir.Range()
        return unmeant(node)

    def _called(self, callee: ir.Expr, node: Node) -> ir.Expr:
        """A call, or an entry of an array: both have parentheses."""
        arguments = (
            y for x in node.named_children if x.type == "arguments" for y in self.children(x)
        )
        values = self.exprs(arguments)
        if isinstance(callee, ir.Name) and callee.name in _SQUARE and len(values) == 1:
            values *= 2
        is_cell = any(x.type == "{" for x in node.children)
        if is_cell or isinstance(callee, ir.Field) or any(isinstance(x, ir.Range) for x in values):
            return ir.Index(callee, values)
        return ir.Call(callee, values)


READER = reader(
    MatlabLowering,
    NAME,
    "MATLAB and Octave: matrices, structures, RKLab's blocks",
    (".m",),
    base=1,
    is_growing=True,
)
find = READER.find
