"""C#."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.found import FoundTable
from garkcli.sources.lowering import (
    Lowering,
    counted,
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

NAME = "csharp"
_NUMBER = re.compile(
    r"(?P<digits>[0-9][0-9_]*(?:\.[0-9_]+)?(?:[eE][-+]?[0-9]+)?|\.[0-9_]+\S*?)"
    r"(?P<suffix>[fFdDmMlLuU]*)"
)
_REAL = frozenset("fFdDmM")
_REAL_TYPES = frozenset({"double", "float", "decimal"})
_MAKERS = frozenset({"parameter_list", "constructor_declaration"})
"""Nodes with the parameters of a constructor."""
_TYPES = re.compile(r"\b(?:class|struct|record|namespace|using)\s+\w")
_MATRIX = re.compile(r"\b(?:OfArray|DenseOfArray|Dense|OfRowArrays|DenseOfRowArrays)\b")
"""Functions of Math.NET that return the matrix or vector of their array."""


class CSharpLowering(Lowering):
    """Classes, fields, properties, methods, arrays and their entries of C#."""

    grammar = "tree_sitter_c_sharp"
    kinds = kinds(
        comment="modifier attribute_list preproc_region preproc_endregion",
        block="compilation_unit declaration_list block field_declaration global_statement"
        " local_declaration_statement expression_statement using_statement checked_statement"
        " unsafe_statement lock_statement ERROR",
        assignment="assignment_expression",
        loop="do_statement",
        switch="switch_statement",
        case="switch_section",
        tried="try_statement",
        record="class_declaration struct_declaration record_declaration interface_declaration"
        " namespace_declaration",
        name="identifier this base boolean_literal predefined_type qualified_name",
        number="integer_literal real_literal",
        nothing="null_literal",
        text="string_literal verbatim_string_literal",
        list="initializer_expression collection_expression tuple_expression tuple_pattern",
        inside="parenthesized_expression argument expression_element collection_element"
        " checked_expression",
        unary="prefix_unary_expression",
        binary="binary_expression",
        either="conditional_expression",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "class_declaration" | "struct_declaration" | "record_declaration":
                yield self._class(node, inside)
            case "namespace_declaration":
                yield from self.block([part(node, "body")])
            case "variable_declaration":
                yield from self._declaration(node, inside)
            case "property_declaration":
                yield from self._property(node, line)
            case "method_declaration" | "constructor_declaration" | "local_function_statement":
                yield self._function(node)
            case "for_statement":
                start = part(node, "initializer")
                declared = next(iter(self.children(start)[1:]), None)
                first = part(start, "right") or self._value(declared)
                name = self.text(part(start, "left") or part(declared, "name"))
                ends = first, part(node, "condition"), self.text(part(node, "update"))
                yield self.loop(node, *counted(self, name, *ends))
            case "foreach_statement":
                name = self.text(part(node, "left"))
                yield self.loop(node, name, self.expr(part(node, "right")))
            case "invocation_expression" | "object_creation_expression":
                yield ir.Do(self._invoked(node, is_statement=True), line)

    def declared(self, node: Node) -> None:
        name = self.text(part(node, "name"))
        inside = [*self.children(node), *self.children(part(node, "body"))]
        for each in (x for x in inside if x.type in _MAKERS):
            self.declares(name, self._parameters(each))

    def _class(self, node: Node, inside: list[Node]) -> ir.Scope:
        name, body = self.text(part(node, "name")), part(node, "body")
        given = next((x for x in inside if x.type == "base_list"), None)
        bases = tuple(self.name(x) for x in self.children(given)[:1])
        return ir.Scope("class", name, self.block([body]), line_of(node), bases=bases)

    def _value(self, node: Node | None) -> Node | None:
        """The value of a declarator, behind its name."""
        return next(iter(self.children(node)[1:]), None)

    def _declaration(self, node: Node, inside: list[Node]) -> Iterator[ir.Statement]:
        is_real = self.text(part(node, "type")) in _REAL_TYPES
        for each in inside:
            if each.type == "variable_declarator" and (value := self._value(each)):
                # var x = …; var (x, y) = …
                name = self.target(self.children(each)[0])
                if value.type == "lambda_expression" and self._statements(value):
                    yield self._function(value, self.text(part(each, "name")))
                else:
                    yield ir.Assign(name, self.expr(value), line_of(each), is_real=is_real)

    def _statements(self, node: Node) -> bool:
        return self.is_a("block", part(node, "body"))

    def _property(self, node: Node, line: int) -> Iterator[ir.Statement]:
        """A property with its value, or the value that its ``get`` returns."""
        name, value = self.text(part(node, "name")), part(node, "value")
        if value is not None:
            body = value.children[-1] if value.type == "arrow_expression_clause" else value
            yield ir.Assign(ir.Name(name), self.expr(body), line)
            return
        for each in self.children(part(node, "accessors")):
            if inner := part(each, "body"):
                yield ir.Scope("function", name, self._body(inner), line, gives=name)
                return

    def _body(self, body: Node) -> ir.Body:
        if body.type == "arrow_expression_clause":
            # ``this`` is a token without a name
            return (ir.Return(self.expr(body.children[-1]), line_of(body)),)
        return self.block([body])

    def _parameters(self, node: Node) -> tuple[str, ...]:
        given = node if node.type == "parameter_list" else part(node, "parameters")
        if given is not None and given.type == "implicit_parameter":
            return (self.text(given),)
        return tuple(filter(None, (self.text(part(x, "name")) for x in self.children(given))))

    def _function(self, node: Node, name: str = "") -> ir.Scope:
        """A method; one without parameters that returns a value is a property."""
        name, body = name or self.text(part(node, "name")), part(node, "body")
        parameters = self._parameters(node)
        gives = name if not parameters and node.type == "method_declaration" else ""
        made = self._body(body) if body and (gives or self.may_hold_a_table(node)) else ()
        for each in self.children(node):
            if each.type == "constructor_initializer":
                # : base(a, b, c)
                args, named = self._arguments(self.children(each)[0])
                made = (ir.Do(ir.Call(ir.Name("base"), args, named), line_of(each)), *made)
        return ir.Scope("function", name, made, line_of(node), parameters, gives=gives)

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One case of a switch, by its label."""
        inside = self.children(node)
        is_label = inside and inside[0].type.endswith("pattern")
        title = self.text(inside[0]).strip('"').rpartition(".")[2] if is_label else ""
        title = f"case {title}" if title.isdigit() else title
        return (ir.Scope("entry", title, self.block(inside[1:]), line_of(node)),)

    def name(self, node: Node | None) -> str:
        """A name without type arguments."""
        return self.text(node).partition("<")[0].lstrip("@")

    def number(self, text: str) -> ir.Expr:
        match = _NUMBER.fullmatch(text)
        if not match:
            return ir.Opaque(f"the number {text[:20]}")
        digits = match["digits"]
        is_whole = digits.replace("_", "").isdigit() and not _REAL & {*match["suffix"]}
        return ir.Literal(digits, is_whole)

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "array_creation_expression":
                return self._array(node, inside)
            case "implicit_array_creation_expression" | "arrow_expression_clause" if inside:
                return self.expr(inside[-1])
            case "declaration_expression":
                return ir.Name(self.text(part(node, "name")))
            case "cast_expression":
                value = self.expr(part(node, "value"))
                is_real = self.text(part(node, "type")) in _REAL_TYPES
                return ir.Call(ir.Name("double"), (value,)) if is_real else value
            case "lambda_expression" if not self._statements(node):
                return ir.Lambda(self._parameters(node), self.expr(part(node, "body")))
            case "member_access_expression":
                of, name = part(node, "expression"), self.name(part(node, "name"))
                return ir.Name(name) if of is None else ir.Field(self.expr(of), name)
            case "element_access_expression":
                at = self.exprs(self.children(part(node, "subscript")))
                return ir.Index(self.expr(part(node, "expression")), at)
            case "invocation_expression" | "object_creation_expression":
                return self._invoked(node)
            case "implicit_object_creation_expression":
                return self._made("", node, inside)
        return unmeant(node)

    def _array(self, node: Node, inside: list[Node]) -> ir.Expr:
        """``new double[] {…}``, ``new double[2, 2]``; rows of ``new double[3][]`` come later."""
        if inside[-1].type == "initializer_expression":
            return self.expr(inside[-1])
        made = part(node, "type")
        rows = self.exprs(self.children(part(made, "type", "rank")))
        if rows:
            return ir.Call(ir.Name("list *"), (ir.Items((ir.Nothing(),)), *rows[:1]))
        return ir.Call(ir.Name("zeros"), self.exprs(self.children(part(made, "rank"))))

    def _made(self, record: str, node: Node, inside: list[Node]) -> ir.Expr:
        """An object from its arguments, or from the fields behind them."""
        kinds_of = {x.type: x for x in inside}
        args, named = self._arguments(kinds_of.get("argument_list"))
        behind = kinds_of.get("initializer_expression")
        fields = self._given(behind)
        if fields is None:
            return self.call(ir.Name(record), args, named) if record else ir.Items(args)
        if not record or record == "Dictionary":
            return ir.Fields(fields, line_of(node))
        if not fields:
            # new List<double> { … }
            return self.expr(behind)
        return ir.Call(ir.Name(record), args, fields)

    def _given(self, node: Node | None) -> tuple[tuple[str, ir.Expr], ...] | None:
        """The pairs of an initialiser; None without one."""
        if node is None:
            return None
        pairs: list[tuple[str, ir.Expr]] = []
        for each in self.children(node):
            inside = self.children(each)
            if self.is_a("assignment", each):
                key = self.text(part(each, "left")).strip('[]"')
                pairs.append((key, self.expr(part(each, "right"))))
            elif len(inside) == 2 and self.is_a("text", inside[0]):
                pairs.append((self.text(inside[0]).strip('"'), self.expr(inside[1])))
        return tuple(pairs)

    def _arguments(
        self, node: Node | None
    ) -> tuple[tuple[ir.Expr, ...], tuple[tuple[str, ir.Expr], ...]]:
        args: list[ir.Expr] = []
        named: list[tuple[str, ir.Expr]] = []
        for each in self.children(node):
            name, value = part(each, "name"), self.expr(next(iter(self.children(each)[-1:]), None))
            if name is None:
                args.append(value)
            else:
                named.append((self.text(name), value))
        return tuple(args), tuple(named)

    def _invoked(self, node: Node, is_statement: bool = False) -> ir.Expr:
        """A call; a method of a number is an operation on it, one of a class a function."""
        if node.type == "object_creation_expression":
            return self._made(self.name(part(node, "type")), node, self.children(node))
        args, named = self._arguments(part(node, "arguments"))
        callee = part(node, "function")
        of, name = part(callee, "expression"), self.name(part(callee, "name") or callee)
        if of is not None and len(args) == 1 and _MATRIX.search(name):
            return args[0]
        if of is None or (of.type == "identifier" and self.text(of)[:1].isupper()):
            return self.call(ir.Name(name), args, named)
        value = self.expr(of)
        operation = with_counter(value, name, args)
        operation = operation or (None if is_statement else method_called(value, name, args))
        return operation or ir.Call(ir.Field(value, name), args, named)


_READER = reader(
    CSharpLowering,
    NAME,
    "C#: fields, properties, arrays, classes, methods",
    (".cs",),
    base=0,
    has_whole_quotients=True,
)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a C# source, which declares types; other texts may parse as C#."""
    return _READER.find(text, source) if _TYPES.search(text) else []


READER = replace(_READER, find=find)
