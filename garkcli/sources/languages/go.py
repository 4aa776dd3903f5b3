"""Go."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable
from garkcli.sources.lowering import Lowering, counted, kinds, line_of, part, reader, unmeant

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "go"
_PACKAGE = re.compile(r"^package[ \t]+\w", re.MULTILINE)
_NUMBERS = frozenset({"float32", "float64"})
_MAKER = re.compile(r"Alloc\w*|(?:New|Make|Zero)\w*(?:Mat|Vec|Arr|Slice|Dense)\w*")
"""Functions that make arrays: Go sets all memory to zero."""
_SIZES = frozenset({"int_literal", "identifier"})


class GoLowering(Lowering):
    """Constants, composite literals, functions, slices and their entries of Go."""

    grammar = "tree_sitter_go"
    kinds = kinds(
        block="source_file block statement_list const_declaration var_declaration var_spec_list"
        " labeled_statement expression_statement ERROR",
        switch="expression_switch_statement type_switch_statement",
        case="expression_case default_case type_case",
        assignment="assignment_statement short_var_declaration",
        record="type_declaration",
        name="identifier field_identifier type_identifier package_identifier true false",
        number="int_literal float_literal",
        nothing="nil",
        text="interpreted_string_literal raw_string_literal",
        inside="parenthesized_expression literal_element",
        unary="unary_expression",
        binary="binary_expression",
        field="selector_expression",
        index="index_expression",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "const_spec" | "var_spec":
                names = [ir.Name(self.text(x)) for x in node.children_by_field_name("name")]
                values = self.exprs(self.children(part(node, "value")))
                if sizes := self._sizes(part(node, "type")):
                    # var a [3][3]float64
                    values = values or (ir.Call(ir.Name("zeros"), sizes),) * len(names)
                is_real = self.text(part(node, "type")) in _NUMBERS
                for name, value in zip(names, values, strict=False):
                    yield ir.Assign(name, value, line, is_real=is_real)
            case "function_declaration" | "method_declaration":
                yield self._function(node)
            case "for_statement":
                yield self._loop(node, inside)
            case "switch_statement":
                arms = tuple(self.case(x) for x in inside if self.is_a("case", x))
                yield ir.Branch(arms, line)
            case "call_expression" | "identifier":
                yield self._done(self.expr(node), line)

    def _done(self, value: ir.Expr, line: int) -> ir.Statement:
        match value:
            case ir.Call(ir.Field(of, "Set" | "SetVec"), (*at, entry)) if at:
                return ir.Assign(ir.Index(of, tuple(at)), entry, line)
        return ir.Do(value, line)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        if self.is_a("giving", node):
            given = [y for x in self.children(node) for y in self.children(x)]
            values = self.exprs(given)
            yield ir.Return(values[0] if len(values) == 1 else ir.Items(values), line_of(node))
        else:
            yield from super().statement(node)

    def assignment(
        self, node: Node, left: Node | None, right: Node | None, sign: str | None = None
    ) -> Iterator[ir.Statement]:
        """An assignment of as many values as targets, or of one call to several."""
        targets, values = self.children(left), self.children(right)
        if len(targets) == len(values):
            for target, value in zip(targets, values, strict=True):
                yield from super().assignment(node, target, value, sign)

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One case of a switch, by the first of its values."""
        value = next(iter(self.children(part(node, "value"))), None)
        body = self.block(x for x in node.named_children if x != part(node, "value"))
        return (ir.Scope("entry", self.title(value), body, line_of(node)),)

    def declared(self, node: Node) -> None:
        for each in self.children(node):
            fields = self.children(next(iter(self.children(part(each, "type"))), None))
            named = [x for y in fields for x in y.children_by_field_name("name")]
            self.declares(self.text(part(each, "name")), map(self.text, named))

    def _loop(self, node: Node, inside: list[Node]) -> ir.Loop:
        head = inside[0] if inside else None
        if head is not None and head.type == "range_clause":
            # for i, v := range list
            names = [self.text(x) for x in self.children(part(head, "left"))]
            over = self.expr(part(head, "right"))
            if len(names) == 1:
                count = ir.Call(ir.Name("len"), (over,))
                last = ir.Binary("-", count, ir.Literal("1", is_whole=True))
                return self.loop(node, names[0], ir.Range(ir.Literal("0", is_whole=True), last))
            return self.loop(node, names[-1] if names[:1] == ["_"] else "", over)
        start = part(head, "initializer")
        first = next(iter(self.children(part(start, "right"))), None)
        name = self.text(part(start, "left"))
        ends = first, part(head, "condition"), self.text(part(head, "update"))
        return self.loop(node, *counted(self, name, *ends))

    def _function(self, node: Node) -> ir.Scope:
        """A function; a method without parameters is a value of its type."""
        given = self.children(part(node, "parameters"))
        named = [x for y in given for x in y.children_by_field_name("name")]
        parameters, name = tuple(map(self.text, named)), self.text(part(node, "name"))
        owner = part(node, "receiver")
        body, gives = part(node, "body"), name if owner and not parameters else ""
        made = self.block([body]) if body and (gives or self.may_hold_a_table(node)) else ()
        return ir.Scope("function", name, made, line_of(node), parameters, gives=gives)

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "composite_literal":
                return self._literal(part(node, "type"), part(node, "body"))
            case "literal_value":
                return self._literal(None, node)
            case "expression_list" if len(inside) == 1:
                return self.expr(inside[0])
            case "call_expression":
                return self._called(node)
            case "func_literal":
                given = self.children(part(node, "parameters"))
                named = [x for y in given for x in y.children_by_field_name("name")]
                body = self.block([part(node, "body")])
                match body:
                    case (ir.Return(value),):
                        return ir.Lambda(tuple(map(self.text, named)), value)
        return unmeant(node)

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        if node.type == "unary_expression" and self.text(node.children[0]) in {"&", "*"}:
            return self.expr(inside[-1])
        return super().expression(node, inside)

    def _sizes(self, made: Node | None) -> tuple[ir.Expr, ...]:
        """The sizes of an array type."""
        sizes: list[ir.Expr] = []
        while made is not None and made.type == "array_type":
            sizes.append(self.expr(part(made, "length")))
            made = part(made, "element")
        return tuple(sizes)

    def _literal(self, made: Node | None, body: Node | None) -> ir.Expr:
        """A list, or the fields of a record; ``[...]float64{1: 0.5}`` sets entries."""
        inside = self.children(body)
        keyed = [x for x in inside if x.type == "keyed_element"]
        record = self.text(made) if made is not None and made.type.endswith("identifier") else ""
        if not keyed:
            values = self.exprs(inside)
            return self.call(ir.Name(record), values) if record else ir.Items(values)
        pairs = [(part(x, "key"), part(x, "value")) for x in keyed]
        if all(self.text(x).isdigit() for x, _ in pairs) and len(keyed) == len(inside):
            at = {int(self.text(x)): self.expr(y) for x, y in pairs}
            if max(at) > MAX_STAGES:
                return ir.Opaque("a long list with gaps")
            zero = ir.Literal("0", is_whole=True)
            return ir.Items(tuple(at.get(x, zero) for x in range(max(at) + 1)))
        fields = tuple((self.text(x).strip('"'), self.expr(y)) for x, y in pairs)
        if record:
            return ir.Call(ir.Name(record), (), fields)
        return ir.Fields(fields, line_of(body) if body is not None else 0)

    def _called(self, node: Node) -> ir.Expr:
        callee, given = part(node, "function"), self.children(part(node, "arguments"))
        name = self.text(part(callee, "field") or callee)
        sizes = [x for x in given if self.text(x) != "nil"]
        has_sizes_alone = len(sizes) < len(given) or {x.type for x in sizes} <= _SIZES
        if name == "make" or (_MAKER.fullmatch(name) and has_sizes_alone):
            return ir.Call(ir.Name("zeros"), self.exprs(given[1:2] if name == "make" else sizes))
        if name in _NUMBERS:
            return ir.Call(ir.Name("double"), self.exprs(given))
        if name == "NewDense" and len(given) == 3:
            return ir.Call(ir.Name("from_row_slice"), self.exprs(given))
        if name == "NewVecDense" and len(given) == 2:
            return self.expr(given[1])
        of = part(callee, "operand")
        if of is None or (of.type == "identifier" and self.text(of) == "math"):
            return self.call(ir.Name(name), self.exprs(given))
        return ir.Call(ir.Field(self.expr(of), name), self.exprs(given))


_READER = reader(
    GoLowering,
    NAME,
    "Go: constants, composite literals, slices, gonum's matrices",
    (".go",),
    base=0,
    has_whole_quotients=True,
)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Go source, which names its package; other texts may parse as Go."""
    return _READER.find(text, source) if _PACKAGE.search(text) else []


READER = replace(_READER, find=find)
