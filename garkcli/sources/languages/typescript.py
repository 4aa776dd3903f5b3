"""JavaScript and TypeScript: one grammar reads both."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.sources import ir
from garkcli.sources.lowering import (
    Lowering,
    counted,
    done,
    kinds,
    line_of,
    method_called,
    part,
    reader,
    unmeant,
    with_counter,
)

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "typescript"
_LISTS = frozenset({"from", "of"})
"""Functions that return the list of their argument or arguments."""
_MADE = frozenset({"Array", "Float64Array", "Float32Array"})
_FUNCTIONS = frozenset({"arrow_function", "function_expression"})
_ITSELF = frozenset({"freeze", "seal", "Object.freeze", "Object.seal"})
"""Functions that return their argument."""


class TypeScriptLowering(Lowering):
    """Constants, objects, classes, functions, arrays and their entries."""

    grammar = "tree_sitter_typescript.language_typescript"
    kinds = kinds(
        comment="decorator accessibility_modifier type_annotation type_arguments",
        block="program statement_block class_body export_statement expression_statement"
        " class_static_block else_clause ERROR",
        assignment="assignment_expression augmented_assignment_expression",
        loop="do_statement",
        switch="switch_statement",
        case="switch_case switch_default",
        tried="try_statement",
        record="class_declaration abstract_class_declaration interface_declaration",
        name="identifier property_identifier private_property_identifier type_identifier this"
        " super true false shorthand_property_identifier",
        number="number",
        nothing="null undefined",
        text="string template_string",
        list="array array_pattern",
        inside="parenthesized_expression as_expression satisfies_expression non_null_expression",
        unary="unary_expression",
        binary="binary_expression",
        field="member_expression",
        index="subscript_expression",
        either="ternary_expression",
    )

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._owner = ""

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "class_declaration" | "abstract_class_declaration" | "class":
                yield self._class(node, inside)
            case "public_field_definition" | "field_definition" | "variable_declarator":
                name, value = part(node, "name") or part(node, "property"), part(node, "value")
                if name is not None and value is not None:
                    yield from self._named(name, value, line)
            case "lexical_declaration" | "variable_declaration":
                yield from self.block(inside)
            case "function_declaration" | "method_definition":
                title = self.name(part(node, "name"))
                yield self._function(node, self._owner if title == "constructor" else title)
            case "for_statement":
                start = part(node, "initializer")
                declared = next(iter(self.children(start)), None)
                first = part(start, "right") or part(declared, "value")
                counter = self.text(part(start, "left") or part(declared, "name"))
                ends = first, part(node, "condition"), self.text(part(node, "increment"))
                yield self.loop(node, *counted(self, counter, *ends))
            case "for_in_statement":
                each = self.text(part(node, "left"))
                yield self.loop(node, each, self.expr(part(node, "right")))
            case "internal_module":
                yield from self.block([part(node, "body")])
            case "call_expression" if bodies := list(self._run_at_once(node)):
                yield from self.block(bodies)
            case "parenthesized_expression" | "unary_expression":
                yield from self.block(inside)
            case "call_expression":
                yield done(self.expr(node), line)
            case "object" | "new_expression" | "identifier":
                yield ir.Do(self.expr(node), line)

    def _run_at_once(self, node: Node) -> Iterator[Node]:
        """The bodies of functions without a name that a call runs, ``(function () { … }())``."""
        callee = part(node, "function")
        while callee is not None and callee.type == "parenthesized_expression":
            callee = next(iter(self.children(callee)), None)
        for each in (callee, *self.children(part(node, "arguments"))):
            body = part(each, "body") if each is not None and each.type in _FUNCTIONS else None
            if body is not None and self.is_a("block", body):
                yield body

    def _named(self, name: Node, value: Node, line: int) -> Iterator[ir.Statement]:
        """A value with its name; a function of several statements is one of that name, those in an
        object have their own ones.
        """
        if value.type == "object":
            for each in self.children(value):
                held = each if each.type == "method_definition" else part(each, "value")
                if held is not None and self.is_a("block", part(held, "body")):
                    yield self._function(
                        held, self.name(part(each, "name") or part(each, "key")).strip("'\"")
                    )
        made = value
        while made.type in _FUNCTIONS and (body := part(made, "body")) is not None:
            # f => (t, y) => { … }
            if self.is_a("block", body):
                yield self._function(made, self.name(name))
                return
            made = body
        yield ir.Assign(self.target(name), self.expr(value), line)

    def assignment(
        self, node: Node, left: Node | None, right: Node | None, sign: str | None = None
    ) -> Iterator[ir.Statement]:
        if left is not None and right is not None and right.type in (*_FUNCTIONS, "object"):
            yield from self._named(left, right, line_of(node))
        else:
            yield from super().assignment(node, left, right, sign)

    def declared(self, node: Node) -> None:
        for each in self.children(part(node, "body")):
            if self.text(part(each, "name")) == "constructor":
                self.declares(self.text(part(node, "name")), self._parameters(each))

    def _class(self, node: Node, inside: list[Node]) -> ir.Scope:
        name, body = self.text(part(node, "name")), part(node, "body")
        around, self._owner = self._owner, name
        made = self.block([body])
        self._owner = around
        heritage = next((x for x in inside if x.type == "class_heritage"), None)
        bases = tuple(self.first_name(x) for x in self.children(heritage)[:1])
        return ir.Scope("class", name, made, line_of(node), bases=bases)

    def _parameters(self, node: Node) -> tuple[str, ...]:
        given = self.children(part(node, "parameters"))
        alone = part(node, "parameter")
        return tuple(filter(None, map(self.first_name, [alone] if alone else given)))

    def _function(self, node: Node, name: str) -> ir.Scope:
        """A function; one without parameters is a value of its class."""
        parameters, body = self._parameters(node), part(node, "body")
        is_method = node.type == "method_definition"
        gives = name if is_method and not parameters and name != self._owner else ""
        made = self.block([body]) if body and (gives or self.may_hold_a_table(node)) else ()
        return ir.Scope("function", name, made, line_of(node), parameters, gives=gives)

    def name(self, node: Node | None) -> str:
        return self.text(node).lstrip("#")

    def number(self, text: str) -> ir.Expr:
        return ir.Literal(text) if text[-1:] != "n" else ir.Opaque(f"the number {text[:20]}")

    def title(self, node: Node | None) -> str:
        """The title of a case by its value, ``Method.RK4``."""
        return super().title(node).rpartition(".")[2]

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "object":
                return ir.Fields(tuple(self._pairs(inside)), line_of(node))
            case "arrow_function" | "function_expression":
                body = part(node, "body")
                given = self.children(body)
                if self.is_a("block", body) and len(given) == 1:
                    # x => { return …; }
                    body = given[0] if not self.is_a("giving", given[0]) else None
                    body = body or next(iter(self.children(given[0])), None)
                return ir.Lambda(self._parameters(node), self.expr(body))
            case "type_assertion" if inside:
                return self.expr(inside[-1])
            case "call_expression" | "new_expression":
                return self._invoked(node)
        return unmeant(node)

    def _pairs(self, inside: list[Node]) -> Iterator[tuple[str, ir.Expr]]:
        for each in inside:
            key, value = part(each, "key"), part(each, "value")
            if each.type == "shorthand_property_identifier":
                yield self.text(each), ir.Name(self.text(each))
            elif key is not None and value is not None:
                yield self.text(key).strip("'\""), self.expr(value)

    def _invoked(self, node: Node) -> ir.Expr:
        """A call; a method of a number or a list is an operation on it, one of a class a
        function.
        """
        args = self.exprs(self.children(part(node, "arguments")))
        callee = part(node, "function") or part(node, "constructor")
        of, name = part(callee, "object"), self.name(part(callee, "property") or callee)
        is_of_class = of is None or (of.type == "identifier" and self.text(of)[:1].isupper())
        if self.text(of) in _MADE and name in _LISTS:
            return args[0] if name == "from" and len(args) == 1 else ir.Items(args)
        if node.type == "new_expression" and name in _MADE:
            is_list = len(args) == 1 and isinstance(args[0], ir.Items)
            return args[0] if is_list else ir.Call(ir.Name("zeros"), args)
        if name in _ITSELF and len(args) == 1:
            return args[0]
        if is_of_class or of is None:
            return self.call(ir.Name(name), args)
        value = self.expr(of)
        made = with_counter(value, name, args) or method_called(value, name, args)
        return made or ir.Call(ir.Field(value, name), args)


READER = reader(
    TypeScriptLowering,
    NAME,
    "JavaScript, TypeScript: arrays, objects, classes, functions",
    (".js", ".mjs", ".cjs", ".ts", ".mts"),
    base=0,
)
find = READER.find
