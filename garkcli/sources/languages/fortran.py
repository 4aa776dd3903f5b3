"""Fortran from 1990 on."""

from __future__ import annotations

import re
from collections.abc import Iterator

import tree_sitter_fortran
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import Lowering, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "fortran"
FORTRAN = Language(tree_sitter_fortran.language())
_PROCEDURES = frozenset({"subroutine", "function", "module_procedure", "program"})
_BLOCKS = frozenset({"translation_unit", "module", "submodule", "internal_procedures", "ERROR"})
_WHOLE = re.compile(r"\s*(?:integer|logical)", re.IGNORECASE)


class FortranLowering(Lowering):
    """Declarations and assignments of Fortran; names have no case."""

    def __init__(self, text: str) -> None:
        super().__init__(text, FORTRAN)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        inside = self.children(node)
        line = line_of(node)
        match node.type:
            case kind if kind in _PROCEDURES and inside:
                yield self._procedure(inside, line)
            case "variable_declaration":
                yield from self._declaration(node)
            case "assignment_statement" if len(inside) == 2:
                # a number that is assigned to an array fills it
                is_whole = inside[0].type == "identifier"
                sign = "." if is_whole else ""
                yield ir.Assign(self.expr(inside[0]), self.expr(inside[1]), line, sign)
            case "if_statement":
                yield self._if(inside, line)
            case "do_loop" | "do_loop_statement":
                yield self._loop(inside, line)
            case "associate_statement" if inside:
                for each in self.children(inside[0]):
                    parts = self.children(each)
                    if len(parts) == 2:
                        yield ir.Assign(self.expr(parts[0]), self.expr(parts[1]), line)
                yield from self.block(inside[1:])
            case "subroutine_call" if len(inside) == 2:
                given = self.exprs(inside[1].named_children)
                yield ir.Do(ir.Call(self.expr(inside[0]), given), line)
            case kind if kind in _BLOCKS:
                yield from self.block(inside)
            case kind if kind.startswith(("select_", "where_", "forall_")):
                yield self.passed_over(node)

    def _procedure(self, inside: list[Node], line: int) -> ir.Scope:
        head = inside[0]
        name = self._name(head.child_by_field_name("name"))
        given = self.children(head.child_by_field_name("parameters"))
        parameters = tuple((self._name(x), None) for x in given)
        return ir.Scope("function", name, self.block(inside[1:]), line, parameters)

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        is_real = not _WHOLE.match(self.text(node.child_by_field_name("type")))
        for each in node.children_by_field_name("declarator"):
            value: Node | None = None
            named: Node | None = each
            if each.type == "init_declarator":
                named, value = each.child_by_field_name("left"), each.child_by_field_name("right")
            extents: tuple[ir.Expr | None, ...] = ()
            if named is not None and named.type == "sized_declarator":
                parts = self.children(named)
                extents = self.exprs(parts[1].named_children)
                named = parts[0]
            if value is None and not extents:
                continue
            is_filled = value is not None
            yield ir.Assign(
                ir.Name(self._name(named)),
                self.expr(value) if is_filled else None,
                line_of(each),
                extents=() if is_filled else extents,
                is_real=is_real,
            )

    def _if(self, inside: list[Node], line: int) -> ir.Statement:
        arms: list[ir.Body] = [()]
        is_total = False
        for part in inside[1:]:
            if part.type in {"else_clause", "elseif_clause"}:
                arms.append(self.block(part.named_children))
                is_total = is_total or part.type == "else_clause"
            else:
                arms[0] += self.block([part])
        return ir.Branch((), tuple(arms), line, is_total)

    def _loop(self, inside: list[Node], line: int) -> ir.Statement:
        control = [x for x in inside[0].named_children if x.type == "loop_control_expression"]
        name, over = "", ir.Range()
        if control:
            parts = self.children(control[0])
            if len(parts) == 3:
                name = self._name(parts[0])
                over = ir.Range(self.expr(parts[1]), self.expr(parts[2]))
        return ir.Loop(name, over, self.block(inside[1:]), line)

    def _name(self, node: Node | None) -> str:
        """A name in the case that its first letter has for a matrix, and else in small letters."""
        text = self.text(node)
        return text if text[:2] in {"A", "A_"} else text.lower()

    def expression(self, node: Node) -> ir.Expr:
        inside = self.children(node)
        match node.type:
            case "number_literal":
                text = self.text(node).partition("_")[0].lower().replace("d", "e")
                return ir.Literal(text, is_whole=text.isdigit())
            case "identifier":
                return ir.Name(self._name(node))
            case "parenthesized_expression" if inside:
                return self.expr(inside[0])
            case "math_expression" if len(inside) == 2:
                sign = self.text(node.child_by_field_name("operator"))
                sign = "^" if sign == "**" else sign
                return ir.Binary(sign, self.expr(inside[0]), self.expr(inside[1]))
            case "unary_expression" if inside:
                sign = self.text(node.child_by_field_name("operator"))
                return ir.Unary(sign, self.expr(inside[-1]))
            case "array_literal":
                return ir.Rows(tuple((self.expr(x),) for x in inside))
            case "call_expression" if len(inside) > 1:
                return self._called(inside[0], inside[1])
            case "extent_specifier":
                ends = self.ends(node)
                return ir.Range(ends[0], ends[-1])
            case "string_literal":
                return ir.Text(self.text(node).strip("'\""))
            case "derived_type_member_expression" if len(inside) == 2:
                return ir.Field(self.expr(inside[0]), self._name(inside[1]))
        return unmeant(node)

    def _called(self, callee: Node, given: Node) -> ir.Expr:
        """A call, or an entry of an array: both are written with round brackets."""
        args: list[ir.Expr] = []
        named: list[tuple[str, ir.Expr]] = []
        for part in self.children(given):
            if part.type == "keyword_argument":
                name = self.text(part.child_by_field_name("name")).lower()
                named.append((name, self.expr(part.child_by_field_name("value"))))
            else:
                args.append(self.expr(part))
        name_ = self._name(callee)
        if name_ in _FUNCTIONS:
            wanted = args[:1] if name_ in {"real", "dble"} else args
            return ir.Call(ir.Name(name_), tuple(wanted), tuple(named))
        return ir.Index(self.expr(callee), tuple(args))


_FUNCTIONS = frozenset({"real", "dble", "sqrt", "reshape", "transpose", "sum", "size", "spread"})


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Fortran source."""
    return tables_in(
        text, source, NAME, lambda x: FortranLowering(x).module(), base=1, has_whole_quotients=True
    )


SUFFIXES = (".f90", ".f95", ".f03", ".f08")
READER = Reader(NAME, "Fortran: parameters, arrays, coefficients by name", SUFFIXES, find)
