"""Rust."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING

from garkcli.sources import ir
from garkcli.sources.lowering import (
    Lowering,
    done,
    kinds,
    less_one,
    line_of,
    method_called,
    part,
    reader,
    unmeant,
)

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "rust"
_WRAPPERS = re.compile(rb"\b(?:vec|array)!(?=\s*\[)|\blazy_static!(?=\s*\{)|(?<=\bstatic )ref\b")
"""Wrappers around lists and constants."""
_MATRICES = frozenset({"matrix", "dmatrix", "vector", "dvector"})
_NUMBER = re.compile(
    r"(?P<digits>[0-9][0-9_]*(?:\.[0-9_]*)?(?:[eE][-+]?[0-9_]+)?)_?(?P<suffix>[fiu]\w+)?"
)
_WHOLE_TYPES = re.compile(r"[iu](?:8|16|32|64|128|size)")
_ZERO = re.compile(r"0\.0*(?:_?f(?:32|64))?")
_MAKERS = frozenset({"new", "default"})
"""Functions that construct their type."""
_ENTRIES = re.compile(r"S?(?:Row)?(?:Matrix|Vector)[1-9](?:x[1-9])?")
"""Types of nalgebra with a constructor from their entries, by rows."""
_TYPE_ARGUMENTS = re.compile(r"(?:::)?<.*>", re.DOTALL)
_TESTS = re.compile(r"#\[cfg\(test\)\]")
_VALUES = ("expression", "invocation", "identifier", "literal")
"""Endings of the kinds of nodes that are values."""
_GIVING = frozenset({"expression_statement", "let_declaration", "return_expression"})
"""Ends of a block that are not its value."""


class RustLowering(Lowering):
    """Constants, structures, functions, arrays and their entries of Rust."""

    grammar = "tree_sitter_rust"
    kinds = kinds(
        comment="line_comment block_comment attribute_item inner_attribute_item"
        " visibility_modifier mutable_specifier",
        block="source_file block declaration_list unsafe_block ERROR",
        assignment="assignment_expression compound_assignment_expr",
        loop="while_expression loop_expression",
        record="struct_item impl_item trait_item mod_item",
        switch="match_expression",
        case="match_arm",
        giving="return_expression",
        branch="if_expression",
        name="identifier field_identifier type_identifier primitive_type self scoped_identifier"
        " scoped_type_identifier generic_type",
        number="integer_literal float_literal",
        text="string_literal",
        list="tuple_expression tuple_pattern",
        inside="parenthesized_expression try_expression generic_function reference_expression",
        unary="unary_expression",
        binary="binary_expression",
        field="field_expression",
        index="index_expression",
        range="range_expression",
    )

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._data = _WRAPPERS.sub(lambda x: b" " * len(x[0]), self._data)
        self._owner = ""

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "const_item" | "static_item":
                yield from self._assigned(part(node, "name"), part(node, "value"), line)
            case "let_declaration":
                yield from self._assigned(part(node, "pattern"), part(node, "value"), line)
            case "function_item":
                yield self._function(node)
            case "mod_item" if any(map(_TESTS.search, islice(self._attributes(node), 5))):
                # errors there may be on purpose
                yield ir.Do(ir.Opaque("a module of tests"), line)
            case "impl_item" | "trait_item" | "mod_item":
                yield self._scope(node)
            case "for_expression":
                name, over = part(node, "pattern"), self.expr(part(node, "value"))
                yield self.loop(node, self.text(name) if self.is_a("name", name) else "", over)
            case "expression_statement" if inside and inside[0].type == "call_expression":
                yield done(self.expr(inside[0]), line)
            case "expression_statement":
                yield from self.block(inside)
            case kind if kind.endswith(("expression", "invocation")):
                yield ir.Do(self.expr(node), line)

    def _assigned(
        self, target: Node | None, value: Node | None, line: int
    ) -> Iterator[ir.Statement]:
        if target is not None and value is not None:
            yield ir.Assign(self.target(target), self.expr(value), line)

    def _attributes(self, node: Node) -> Iterator[str]:
        """The attributes in front of an item, the last first."""
        before = node.prev_named_sibling
        while before is not None and self.is_a("comment", before):
            yield self.text(before)
            before = before.prev_named_sibling

    def declared(self, node: Node) -> None:
        inside = self.children(part(node, "body"))
        name = self.name(part(node, "type") or part(node, "name"))
        if node.type == "struct_item":
            self.declares(name, filter(None, (self.text(part(x, "name")) for x in inside)))
        for each in inside:
            if node.type == "impl_item" and self.text(part(each, "name")) == "new":
                # Tableau::new(a, b)
                self.declares(name, self._parameters(each))

    def _scope(self, node: Node) -> ir.Scope:
        """An implementation as a class; a module with its own names."""
        name = self.name(part(node, "type") or part(node, "name"))
        trait, body = self.name(part(node, "trait")), part(node, "body")
        around, self._owner = self._owner, name
        made = self.block([body])
        self._owner = around
        return ir.Scope("class", name, made, line_of(node), bases=(trait,) if trait else ())

    def _parameters(self, node: Node) -> tuple[str, ...]:
        given = (part(x, "pattern") for x in self.children(part(node, "parameters")))
        return tuple(filter(None, map(self.first_name, given)))

    def _function(self, node: Node) -> ir.Scope:
        """A function; with ``self`` as its only parameter it is a property."""
        body = part(node, "body")
        name, parameters = self.text(part(node, "name")), self._parameters(node)
        name = self._owner or name if name in _MAKERS else name
        given = self.children(part(node, "parameters"))
        gives = name if [x.type for x in given] == ["self_parameter"] else ""
        made = self._giving(body) if body and (gives or self.may_hold_a_table(node)) else ()
        types = frozenset(map(self.first_name, self._type_parameters(node)))
        return ir.Scope("function", name, made, line_of(node), parameters, types, gives=gives)

    def _type_parameters(self, node: Node) -> list[Node]:
        return [
            y
            for x in self.children(part(node, "type_parameters"))
            for y in [part(x, "name")]
            if y is not None
        ]

    def _giving(self, body: Node) -> ir.Body:
        """A block with its value, which is its last expression."""
        inside = self.children(body)
        last = inside[-1] if inside else None
        if last is None or self.is_a("branch", last) or self.is_a("switch", last):
            return self.block(inside)
        if last.type in _GIVING or not last.type.endswith(_VALUES):
            return self.block(inside)
        return (*self.block(inside[:-1]), ir.Return(self.expr(last), line_of(last)))

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One arm of a match, by its pattern."""
        pattern, value = part(node, "pattern"), part(node, "value")
        title = self.text(pattern).rpartition("::")[2]
        return (ir.Scope("entry", title, self.block([value]), line_of(node)),)

    def name(self, node: Node | None) -> str:
        """A name without type arguments, and without its own class."""
        plain = _TYPE_ARGUMENTS.sub("", self.text(node))
        return plain.removeprefix("Self::").removeprefix("self::")

    def number(self, text: str) -> ir.Expr:
        match = _NUMBER.fullmatch(text)
        if not match:
            return ir.Opaque(f"the number {text[:20]}")
        digits, suffix = match["digits"], match["suffix"] or ""
        return ir.Literal(digits, digits.replace("_", "").isdigit() and suffix[:1] != "f")

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "array_expression":
                return self._list(node, inside)
            case "struct_expression" if inside:
                name = self.name(inside[0]).rpartition("::")[2]
                fields = tuple(self._fields_of(self.children(inside[-1])))
                return ir.Call(ir.Name(self._owner if name == "Self" else name), (), fields)
            case "call_expression" if len(inside) == 2:
                return self._called(inside[0], self.exprs(inside[1].named_children))
            case "type_cast_expression":
                value = self.expr(inside[0])
                is_whole = _WHOLE_TYPES.fullmatch(self.text(part(node, "type")))
                return value if is_whole else ir.Call(ir.Name("double"), (value,))
            case "closure_expression":
                given = self.children(part(node, "parameters"))
                parameters = tuple(y for x in given for y in self._named(part(x, "pattern") or x))
                return ir.Lambda(parameters, self.expr(part(node, "body")))
            case "macro_invocation" if self.text(inside[0]) in _MATRICES:
                return self._matrix(self.text(inside[-1])[1:-1])
            case "macro_invocation" if self.text(inside[0]) == "dec":
                return self._fragment(self.text(inside[-1]))
            case "block" | "else_clause" if len(inside) == 1:
                return self.expr(inside[0])
            case "if_expression" if len(inside) == 3:
                return ir.Either((self.expr(inside[1]), self.expr(inside[2])))
        return unmeant(node)

    def _named(self, pattern: Node) -> list[str]:
        """The names in a pattern: ``((a, b), &c)``."""
        if pattern.type == "tuple_pattern":
            return [y for x in self.children(pattern) for y in self._named(x)]
        return [self.first_name(pattern)]

    def _list(self, node: Node, inside: list[Node]) -> ir.Expr:
        """A list; ``[x; n]`` repeats x."""
        size = part(node, "length")
        if size is None:
            is_repeated = any(x.type == ";" for x in node.children) and len(inside) == 2
            size = inside[1] if is_repeated else None
        if size is None:
            return ir.Items(self.exprs(inside))
        count = self.expr(size)
        if _ZERO.fullmatch(self.text(inside[0])):
            return ir.Call(ir.Name("zeros"), (count,))
        return ir.Call(ir.Name("list *"), (ir.Items((self.expr(inside[0]),)), count))

    def _fields_of(self, inside: list[Node]) -> Iterator[tuple[str, ir.Expr]]:
        for each in inside:
            match each.type:
                case "shorthand_field_initializer":
                    yield self.text(each), ir.Name(self.text(each))
                case "field_initializer":
                    yield self.text(part(each, "field")), self.expr(part(each, "value"))

    def _called(self, callee: Node, args: tuple[ir.Expr, ...]) -> ir.Expr:
        """A call; a method of a number or of a list is a function of it."""
        of = self.expr(callee)
        match of:
            case ir.Field(of=value, name=name) if self.is_a("field", callee):
                return method_called(value, name, args) or ir.Call(of, args)
            case ir.Name(name) if callee.type == "scoped_identifier" and name.endswith("new"):
                record = name.removesuffix("new").removesuffix("::")
                if _ENTRIES.fullmatch(record):
                    return ir.Items(args)
                return self.call(ir.Name(record or self._owner), args)
        return self.call(of, args)

    def _matrix(self, text: str) -> ir.Expr:
        """``matrix![a, b; c, d]``."""
        rows = [self._fragment(f"[{row}]") for row in text.split(";")]
        lists = [x.items for x in rows if isinstance(x, ir.Items)]
        if len(lists) < len(rows):
            return ir.Opaque("a matrix")
        return ir.Items(lists[0]) if len(lists) == 1 else ir.Items(tuple(map(ir.Items, lists)))

    def _fragment(self, text: str) -> ir.Expr:
        """The expression in the argument of a macro."""
        inner = RustLowering(f"const X: T = {text};")
        inner._depth = self._depth
        match inner.module():
            case (ir.Assign(value=value),) if value is not None:
                return value
        return ir.Opaque("the argument of a macro")

    def range_of(self, node: Node, first: ir.Expr | None, last: ir.Expr | None) -> ir.Range:
        """``a..b`` excludes its end, ``a..=b`` includes it."""
        is_closed = any(x.type == "..=" for x in node.children)
        return ir.Range(first, last if is_closed or last is None else less_one(last))

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        if self.is_a("range", node):
            ends: list[ir.Expr | None] = [None]
            for each in node.children:
                if each.type in {"..", "..="}:
                    ends.append(None)
                else:
                    ends[-1] = self.expr(each)
            return self.range_of(node, ends[0], ends[-1])
        if node.type == "unary_expression" and self.text(node.children[0]) == "*":
            return self.expr(inside[-1])
        if node.type == "reference_expression":
            return self.expr(part(node, "value"))
        if node.type == "scoped_identifier" and self.text(part(node, "path")) == "self":
            return ir.Name(self.name(node))
        return super().expression(node, inside)


READER = reader(
    RustLowering,
    NAME,
    "Rust: constants, structures, implementations, vec! and nalgebra's matrices",
    (".rs",),
    base=0,
    has_whole_quotients=True,
)
find = READER.find
