"""MATLAB and Octave."""

from __future__ import annotations

from collections.abc import Iterator

import tree_sitter_matlab
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.lowering import Lowering, kinds, line_of, reader, unmeant

NAME = "matlab"
_SQUARE = frozenset({"zeros", "ones"})
"""What a single number makes square."""


class MatlabLowering(Lowering):
    """Functions, matrices, cells and structures of MATLAB."""

    grammar = Language(tree_sitter_matlab.language())
    comments = frozenset({"comment", "line_continuation"})
    blocks = frozenset({"source_file", "block", "try_statement", "ERROR"})
    passed = frozenset({"try_statement"})
    expressions = kinds(
        name="identifier boolean",
        number="number",
        text="string",
        inside="parenthesis",
        unary="unary_operator",
        binary="binary_operator",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        field = node.child_by_field_name
        match node.type:
            case "function_definition":
                given = [
                    y for x in inside if x.type == "function_arguments" for y in self.children(x)
                ]
                parameters = tuple(map(self.text, given))
                body = self.block(x for x in inside if x.type == "block")
                yield ir.Scope("function", self.text(field("name")), body, line, parameters)
            case "assignment":
                left = field("left")
                target = self.expr(left)
                if left is not None and left.type == "multioutput_variable":
                    target = ir.Items(self.exprs(left.named_children))
                if isinstance(target, ir.Call):
                    # A(2, 1) = …
                    target = ir.Index(target.callee, target.args)
                yield ir.Assign(target, self.expr(field("right")), line)
            case "switch_statement":
                arms = (self._case(x) for x in inside if x.type.endswith("_clause"))
                yield ir.Branch(tuple(arms), line)
            case "for_statement":
                bound = self.children(inside[0]) if inside else []
                name = self.text(bound[0]) if len(bound) == 2 else ""
                yield self.loop(node, name, self.expr(bound[1]) if name else ir.Nothing())
            case "function_call" | "field_expression":
                yield ir.Do(self.expr(node), line)

    def way(self, condition: list[Node], inside: list[Node]) -> ir.Body:
        """A branch on a text is named by it."""
        body, name = self.block(inside), self._first_text(condition)
        return (ir.Scope("entry", name, body, line_of(condition[0])),) if name else body

    def _case(self, node: Node) -> ir.Body:
        """A case as a scope of its own."""
        condition = node.child_by_field_name("condition")
        inside = self.block(x for x in self.children(node) if x != condition)
        name = self._first_text([] if condition is None else [condition])
        return (ir.Scope("entry", name, inside, line_of(node)),)

    def _first_text(self, nodes: list[Node]) -> str:
        for node in nodes:
            is_text = node.type == "string"
            found = (
                self.text(node).strip("'\"") if is_text else self._first_text(node.named_children)
            )
            if found:
                return found
        return ""

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        field = node.child_by_field_name
        match node.type:
            case "end_keyword":
                return ir.Name("end")
            case "matrix" | "cell":
                rows = tuple(self.exprs(x.named_children) for x in inside if x.type == "row")
                if node.type == "matrix" and rows:
                    return ir.Rows(rows, is_row_a_matrix=False)
                return ir.Items(rows[0] if len(rows) == 1 else tuple(map(ir.Items, rows)))
            case "postfix_operator":
                return ir.Transposed(self.expr(field("operand")))
            case "function_call":
                return self._called(self.expr(field("name")), node)
            case "field_expression":
                # m.A and m.A{1,2}, where the call is on the field
                of = self.expr(field("object"))
                for part in inside[1:]:
                    name = part.child_by_field_name("name")
                    entry = ir.Field(of, self.text(name or part))
                    of = entry if name is None else self._called(entry, part)
                return of
            case "range" if len(inside) == 2:
                return ir.Range(self.expr(inside[0]), self.expr(inside[1]))
            case "spread_operator":
                return ir.Range()
        return unmeant(node)

    def _called(self, callee: ir.Expr, node: Node) -> ir.Expr:
        """A call, or an entry of an array: both are written with round brackets."""
        given = (y for x in node.named_children if x.type == "arguments" for y in self.children(x))
        values = self.exprs(given)
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
