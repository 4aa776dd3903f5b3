"""Java."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.sources import ir
from garkcli.sources.lowering import (
    Lowering,
    counted,
    kinds,
    line_of,
    method_called,
    part,
    reader,
    unmeant,
)

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "java"
_WHOLE_TYPES = re.compile(r"(?:int|long|short|byte|boolean|char|var|Integer|Long)\b")
_NUMBER = re.compile(
    r"(?P<digits>[0-9][0-9_]*\.?[0-9_]*(?:[eE][-+]?[0-9]+)?|\.[0-9_]+\S*?)"
    r"(?P<suffix>[fFdDlL]?)"
)
_LISTS = frozenset({"of", "asList"})
"""Functions that return the list of their arguments."""
_GETTER = re.compile(r"get(?=[A-Z])")


class JavaLowering(Lowering):
    """Classes, fields, methods, arrays and their entries of Java."""

    grammar = "tree_sitter_java"
    kinds = kinds(
        comment="line_comment block_comment modifiers",
        block="program class_body interface_body enum_body enum_body_declarations block"
        " constructor_body static_initializer synchronized_statement labeled_statement ERROR",
        assignment="assignment_expression",
        loop="do_statement enhanced_for_statement",
        switch="switch_expression",
        case="switch_block_statement_group switch_rule",
        tried="try_statement",
        record="class_declaration enum_declaration interface_declaration record_declaration",
        name="identifier type_identifier this true false generic_type scoped_type_identifier",
        number="decimal_integer_literal decimal_floating_point_literal",
        nothing="null_literal",
        text="string_literal",
        list="array_initializer",
        inside="parenthesized_expression",
        unary="unary_expression",
        binary="binary_expression",
        field="field_access",
        index="array_access",
        either="ternary_expression",
    )

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        """The lowered form of a statement; ``return new Solver() {…}`` has a class in it."""
        declared = part(node, "declarator")
        value = part(declared, "value") or next(iter(self.children(node)), None)
        if value is not None and value.type == "object_creation_expression":
            body = next((x for x in self.children(value) if x.type == "class_body"), None)
            if body is not None:
                name = self.text(part(value, "type"))
                yield ir.Scope("class", name, self.block([body]), line_of(value))
        yield from super().statement(node)

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case _ if self.is_a("record", node):
                yield self._class(node)
            case "enum_constant" if given := part(node, "arguments"):
                # HEUN(new double[] {…}, …): one of several, by its name
                made = self.call(ir.Name(self._owner(node)), self.exprs(given.named_children))
                body = (ir.Do(made, line),)
                yield ir.Scope("entry", self.text(part(node, "name")), body, line)
            case "field_declaration" | "local_variable_declaration" | "constant_declaration":
                yield from self._declaration(node)
            case "method_declaration" | "constructor_declaration":
                yield self._function(node)
            case "for_statement":
                start = part(node, "init")
                declared = part(start, "declarator")
                first = part(declared, "value") or part(start, "right")
                name = self.text(part(declared, "name") or part(start, "left"))
                ends = first, part(node, "condition"), self.text(part(node, "update"))
                yield self.loop(node, *counted(self, name, *ends))
            case "expression_statement":
                yield from self.block(inside)
            case "method_invocation" | "object_creation_expression":
                yield ir.Do(self._invoked(node, is_statement=True), line)
            case "explicit_constructor_invocation":
                # super(a, b, c)
                args = self.exprs(self.children(part(node, "arguments")))
                yield ir.Do(ir.Call(ir.Name("super"), args), line)

    def _owner(self, node: Node) -> str:
        """The class of a constant of an enumeration."""
        while node.parent is not None and node.type != "enum_declaration":
            node = node.parent
        return self.text(part(node, "name"))

    def declared(self, node: Node) -> None:
        inner = self.children(part(node, "body"))
        inner += [y for x in inner if x.type == "enum_body_declarations" for y in self.children(x)]
        made = [node] if node.type == "record_declaration" else []
        made += [x for x in inner if x.type == "constructor_declaration"]
        for each in made:
            self.declares(self.text(part(node, "name")), self._parameters(each))

    def _class(self, node: Node) -> ir.Scope:
        name, body = self.text(part(node, "name")), part(node, "body")
        bases = tuple(self.name(x) for x in self.children(part(node, "superclass")))
        return ir.Scope("class", name, self.block([body]), line_of(node), bases=bases)

    def _parameters(self, node: Node) -> tuple[str, ...]:
        given = self.children(part(node, "parameters"))
        return tuple(filter(None, (self.text(part(x, "name")) for x in given)))

    def _function(self, node: Node) -> ir.Scope:
        """A method; one without parameters that returns a value is a property, also ``getX``."""
        name, body = self.text(part(node, "name")), part(node, "body")
        parameters, gives = self._parameters(node), ""
        if not parameters and node.type == "method_declaration":
            gives = _GETTER.sub("", name)
            gives = gives if gives == name or len(gives) < 2 else gives[0].lower() + gives[1:]
        made = self.block([body]) if body and (gives or self.may_hold_a_table(node)) else ()
        return ir.Scope("function", name, made, line_of(node), parameters, gives=gives)

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        is_real = not _WHOLE_TYPES.match(self.text(part(node, "type")))
        for each in node.children_by_field_name("declarator"):
            if value := part(each, "value"):
                name = ir.Name(self.text(part(each, "name")))
                yield ir.Assign(name, self.expr(value), line_of(each), is_real=is_real)

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One case of a switch, by its label."""
        inside = self.children(node)
        title = " ".join(map(self.text, self.children(inside[0]) if inside else ())).strip('"')
        return (ir.Scope("entry", title, self.block(inside[1:]), line_of(node)),)

    def name(self, node: Node | None) -> str:
        """A name without type arguments."""
        return self.text(node).partition("<")[0]

    def number(self, text: str) -> ir.Expr:
        match = _NUMBER.fullmatch(text)
        if not match:
            return ir.Opaque(f"the number {text[:20]}")
        digits = match["digits"]
        is_whole = digits.replace("_", "").isdigit() and match["suffix"].lower() in {"", "l"}
        return ir.Literal(digits, is_whole)

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "array_creation_expression":
                if (value := part(node, "value")) is not None:
                    return self.expr(value)
                sizes = [x for x in inside if x.type == "dimensions_expr"]
                counts = tuple(self.expr(self.children(x)[0]) for x in sizes)
                is_open = any(x.type == "dimensions" for x in inside)
                if is_open:
                    # new double[3][]: rows that come later
                    return ir.Call(ir.Name("list *"), (ir.Items((ir.Nothing(),)), *counts[:1]))
                return ir.Call(ir.Name("zeros"), counts)
            case "cast_expression":
                value_ = self.expr(part(node, "value"))
                is_whole = _WHOLE_TYPES.match(self.text(part(node, "type")))
                return value_ if is_whole else ir.Call(ir.Name("double"), (value_,))
            case "method_invocation" | "object_creation_expression":
                return self._invoked(node)
        return unmeant(node)

    def _invoked(self, node: Node, is_statement: bool = False) -> ir.Expr:
        """A call; a method of a number is an operation on it, one of a class a function."""
        args = self.exprs(self.children(part(node, "arguments")))
        of, name = part(node, "object"), self.name(part(node, "name") or part(node, "type"))
        if name in _LISTS and of is not None:
            return ir.Items(args)
        if of is None or (of.type == "identifier" and self.text(of)[:1].isupper()):
            return self.call(ir.Name(name), args)
        value = self.expr(of)
        operation = None if is_statement else method_called(value, name, args)
        return operation or ir.Call(ir.Field(value, name), args)


READER = reader(
    JavaLowering,
    NAME,
    "Java: arrays, fields, methods that give arrays, enumerations, records",
    (".java",),
    base=0,
    has_whole_quotients=True,
)
find = READER.find
