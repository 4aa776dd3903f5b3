"""MATLAB and Octave."""

from __future__ import annotations

from collections.abc import Iterator

import tree_sitter_matlab
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import Lowering, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "matlab"
MATLAB = Language(tree_sitter_matlab.language())
_BLOCKS = frozenset({"source_file", "block", "try_statement", "ERROR"})


class MatlabLowering(Lowering):
    """Functions, matrices, cells and structures of MATLAB."""

    comments = frozenset({"comment", "line_continuation"})

    def __init__(self, text: str) -> None:
        super().__init__(text, MATLAB)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        line = line_of(node)
        field = node.child_by_field_name
        inside = self.children(node)
        match node.type:
            case "function_definition":
                name = self.text(field("name"))
                given = [
                    x
                    for part in inside
                    if part.type == "function_arguments"
                    for x in self.children(part)
                ]
                parameters = tuple((self.text(x), None) for x in given)
                body = self.block(x for x in inside if x.type == "block")
                yield ir.Scope("function", name, body, line, parameters)
            case "assignment":
                left = field("left")
                target = self.expr(left)
                if left is not None and left.type == "multioutput_variable":
                    target = ir.Items(self.exprs(left.named_children))
                if isinstance(target, ir.Call):
                    # A(2, 1) = …
                    target = ir.Index(target.callee, target.args)
                yield ir.Assign(target, self.expr(field("right")), line)
            case "if_statement":
                yield self._if(inside, line)
            case "switch_statement":
                arms = tuple(self._case(x) for x in inside if x.type.endswith("_clause"))
                yield ir.Branch((), arms, line)
            case "for_statement":
                bound = self.children(inside[0]) if inside else []
                name = self.text(bound[0]) if len(bound) == 2 else ""
                over = self.expr(bound[1]) if name else ir.Nothing()
                yield ir.Loop(name, over, self.block(inside[1:]), line)
            case "while_statement":
                yield ir.Loop("", ir.Nothing(), self.block(inside[1:]), line)
            case kind if kind in _BLOCKS:
                if kind == "try_statement":
                    yield self.passed_over(node)
                yield from self.block(inside)
            case "function_call" | "field_expression":
                yield ir.Do(self.expr(node), line)

    def _case(self, node: Node) -> ir.Body:
        """A case as a scope of its own, named by its first text."""
        condition = node.child_by_field_name("condition")
        inside = self.block(x for x in self.children(node) if x != condition)
        return (ir.Scope("entry", self._first_text(condition), inside, line_of(node)),)

    def _first_text(self, node: Node | None) -> str:
        if node is None:
            return ""
        if node.type == "string":
            return self.text(node).strip("'\"")
        found = (self._first_text(x) for x in node.named_children)
        return next(filter(None, found), "")

    def _if(self, inside: list[Node], line: int) -> ir.Statement:
        """Branches on texts are named by them."""
        arms: list[ir.Body] = []
        is_total = False
        names: list[str] = []
        first: list[Node] = []
        for part in inside[1:]:
            if part.type == "elseif_clause":
                parts = self.children(part)
                arms.append(self.block(parts[1:]))
                names.append(self._first_text(parts[0]) if parts else "")
            elif part.type == "else_clause":
                arms.append(self.block(self.children(part)))
                names.append("")
                is_total = True
            else:
                first.append(part)
        arms.insert(0, self.block(first))
        names.insert(0, self._first_text(inside[0]) if inside else "")
        if any(names):
            scopes = zip(names, arms, strict=True)
            arms = [(ir.Scope("entry", name, arm, line),) for name, arm in scopes]
        return ir.Branch((), tuple(arms), line, is_total)

    def expression(self, node: Node) -> ir.Expr:
        field = node.child_by_field_name
        inside = self.children(node)
        match node.type:
            case "number":
                return ir.Literal(self.text(node))
            case "identifier" | "boolean":
                return ir.Name(self.text(node))
            case "end_keyword":
                return ir.Name("end")
            case "parenthesis" if inside:
                return self.expr(inside[0])
            case "matrix":
                rows = tuple(self.exprs(x.named_children) for x in inside if x.type == "row")
                if not rows:
                    return ir.Items(())
                return ir.Rows(rows, is_row_a_matrix=False)
            case "cell":
                rows = tuple(self.exprs(x.named_children) for x in inside if x.type == "row")
                if len(rows) == 1:
                    return ir.Items(rows[0])
                return ir.Items(tuple(ir.Items(row) for row in rows))
            case "binary_operator":
                sign = self.text(next(x for x in node.children if not x.is_named)).lstrip(".")
                return ir.Binary(sign, self.expr(field("left")), self.expr(field("right")))
            case "unary_operator":
                sign = self.text(node.children[0])
                return ir.Unary(sign, self.expr(field("operand")))
            case "postfix_operator":
                return ir.Transposed(self.expr(field("operand")))
            case "function_call":
                return self._called(self.expr(field("name")), node)
            case "field_expression":
                return self._field(self.expr(field("object")), self.children(node)[1:])
            case "string":
                return ir.Text(self.text(node).strip("'\""))
            case "range" if len(inside) == 2:
                return ir.Range(self.expr(inside[0]), self.expr(inside[1]))
            case "spread_operator":
                return ir.Range()
        return unmeant(node)

    def _field(self, of: ir.Expr, parts: list[Node]) -> ir.Expr:
        """``m.A`` and ``m.A{1,2}``, where the call is on the field."""
        for part in parts:
            if part.type == "function_call":
                of = self._called(ir.Field(of, self.text(part.child_by_field_name("name"))), part)
            else:
                of = ir.Field(of, self.text(part))
        return of

    def _called(self, callee: ir.Expr, node: Node) -> ir.Expr:
        """A call, or an entry of an array: both are written with round brackets."""
        args = [
            x
            for part in node.named_children
            if part.type == "arguments"
            for x in self.children(part)
        ]
        values = self.exprs(args)
        is_cell = any(x.type == "{" for x in node.children)
        if is_cell or isinstance(callee, ir.Field) or any(isinstance(x, ir.Range) for x in values):
            return ir.Index(callee, values)
        return ir.Call(callee, values)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a MATLAB source."""
    return tables_in(
        text, source, NAME, lambda x: MatlabLowering(x).module(), base=1, is_growing=True
    )


READER = Reader(NAME, "MATLAB and Octave: matrices, structures, RKLab's blocks", (".m",), find)
