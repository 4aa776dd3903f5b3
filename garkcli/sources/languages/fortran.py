"""Fortran from 1990 on."""

from __future__ import annotations

import re
from collections.abc import Iterator

import tree_sitter_fortran
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.lowering import Lowering, kinds, line_of, reader, unmeant

NAME = "fortran"
_PROCEDURES = frozenset({"subroutine", "function", "module_procedure", "program"})
_WHOLE = re.compile(r"\s*(?:integer|logical)", re.IGNORECASE)
_FUNCTIONS = frozenset({"real", "dble", "sqrt", "reshape", "transpose", "sum", "size", "spread"})
_SELECTED = ("select_case_statement", "select_type_statement", "select_rank_statement")


class FortranLowering(Lowering):
    """Declarations and assignments of Fortran; names have no case."""

    grammar = Language(tree_sitter_fortran.language())
    blocks = frozenset({"translation_unit", "module", "submodule", "internal_procedures", "ERROR"})
    passed = frozenset({*_SELECTED, "where_statement", "forall_statement"})
    expressions = kinds(
        name="identifier",
        number="number_literal",
        text="string_literal",
        inside="parenthesized_expression",
        unary="unary_expression",
        binary="math_expression",
    )

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._extents: dict[str, tuple[ir.Expr, ...]] = {}

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case kind if kind in _PROCEDURES and inside:
                head = inside[0].child_by_field_name
                given = self.children(head("parameters"))
                parameters = tuple(map(self.name, given))
                body = self.block(inside[1:])
                yield ir.Scope("function", self.name(head("name")), body, line, parameters)
            case "variable_declaration":
                yield from self._declaration(node)
            case "derived_type_definition":
                parts = [y for x in inside for y in x.children_by_field_name("declarator")]
                name = self.children(inside[0])[-1]
                self.declares(self.name(name), (self.name(self._named(x)) for x in parts))
            case "assignment_statement" if len(inside) == 2:
                # a number that is assigned to an array fills it
                sign = "" if inside[0].type == "call_expression" else "."
                yield ir.Assign(self.expr(inside[0]), self.expr(inside[1]), line, sign)
            case "do_loop" | "do_loop_statement":
                yield self._loop(node, inside)
            case "associate_statement" if inside:
                for each in self.children(inside[0]):
                    parts = self.children(each)
                    if len(parts) == 2:
                        yield ir.Assign(self.expr(parts[0]), self.expr(parts[1]), line)
                yield from self.block(inside[1:])
            case "allocate_statement":
                for each in inside:
                    if each.type == "sized_allocation":
                        of, sizes = self.children(each)[:2]
                        extents = self.exprs(self.children(sizes))
                        yield ir.Assign(self.expr(of), None, line, extents=extents, is_real=True)
            case "data_set" if len(inside) == 2:
                yield self._data_set(*inside)
            case "data_statement":
                yield from self.block(inside)
            case "subroutine_call" if len(inside) == 2:
                args = self.exprs(inside[1].named_children)
                yield ir.Do(ir.Call(self.expr(inside[0]), args), line)

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        is_real = not _WHOLE.match(self.text(node.child_by_field_name("type")))
        for each in node.children_by_field_name("declarator"):
            field = each.child_by_field_name
            value = field("right") if each.type == "init_declarator" else None
            named = field("left") if each.type == "init_declarator" else each
            extents: tuple[ir.Expr, ...] = ()
            if named is not None and named.type == "sized_declarator":
                named, sizes = self.children(named)[:2]
                extents = self._extents[self.name(named)] = self.exprs(sizes.named_children)
            if value is not None:
                filled, extents = self.expr(value), ()
            elif not extents:
                continue
            yield ir.Assign(
                ir.Name(self.name(named)),
                None if value is None else filled,
                line_of(each),
                extents=extents,
                is_real=is_real,
            )

    def _named(self, node: Node) -> Node:
        """What a declarator names."""
        while node.type in {"init_declarator", "sized_declarator"}:
            node = node.named_children[0]
        return node

    def _data_set(self, named: Node, values: Node) -> ir.Statement:
        """``data a / 1.0, 3*0.0 /``: the entries by columns."""
        items: list[ir.Expr] = []
        count = 1
        for i, part in enumerate(values.children):
            if values.field_name_for_child(i) == "repeat" and self.text(part).isdigit():
                count = min(int(self.text(part)), MAX_STAGES**2)
            elif part.is_named:
                items += [self.expr(part)] * count
                count = 1
        extents = self._extents.get(self.name(named), ())
        value: ir.Expr = ir.Items(tuple(items)) if extents else items[0]
        if len(extents) > 1:
            value = ir.Call(ir.Name("reshape"), (value, ir.Items(extents)))
        return ir.Assign(self.expr(named), value, line_of(named), is_real=True)

    def _loop(self, node: Node, inside: list[Node]) -> ir.Loop:
        for control in inside[0].named_children:
            parts = self.children(control)
            if control.type == "loop_control_expression" and len(parts) == 3:
                name, *ends = parts
                return self.loop(node, self.name(name), ir.Range(*map(self.expr, ends)))
        return self.loop(node, "", ir.Range())

    def name(self, node: Node | None) -> str:
        """A name in the case that its first letter has for a matrix, and else in small letters."""
        text = self.text(node)
        return text if text[:2] in {"A", "A_"} else text.lower()

    def number(self, text: str) -> ir.Expr:
        return super().number(text.partition("_")[0].lower().replace("d", "e"))

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "array_literal":
                return ir.Rows(tuple((self.expr(x),) for x in inside))
            case "call_expression" if len(inside) > 1:
                return self._called(inside[0], inside[1])
            case "extent_specifier":
                ends = self.ends(node)
                return ir.Range(ends[0], ends[-1])
            case "derived_type_member_expression" if len(inside) == 2:
                return ir.Field(self.expr(inside[0]), self.name(inside[1]))
        return unmeant(node)

    def _called(self, callee: Node, given: Node) -> ir.Expr:
        """A call, or an entry of an array: both are written with round brackets."""
        args, named = self.arguments(self.children(given))
        name = self.name(callee)
        if name in _FUNCTIONS:
            wanted = args[:1] if name in {"real", "dble"} else args
            return ir.Call(ir.Name(name), wanted, named)
        if self.made(name, args):
            return self.call(ir.Name(name), args)
        match args:
            case (ir.Name(of),) if name == "shape" and of in self._extents:
                return ir.Items(self._extents[of])
        return ir.Index(self.expr(callee), args)


READER = reader(
    FortranLowering,
    NAME,
    "Fortran: parameters, arrays, coefficients by name",
    (".f90", ".f95", ".f03", ".f08"),
    base=1,
    has_whole_quotients=True,
)
find = READER.find
