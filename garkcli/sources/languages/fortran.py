"""Fortran from 1990 on."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping

import tree_sitter_fortran
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.lowering import Lowering, kinds, less_one, line_of, reader, unmeant

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
        self._lower: dict[str, tuple[ir.Expr | None, ...]] = {}
        self._spelled: dict[str, str] = {}
        self._numbers: dict[str, int] = {}

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case kind if kind in _PROCEDURES and inside:
                head = inside[0].child_by_field_name
                given = self.children(head("parameters"))
                parameters = tuple(map(self.name, given))
                around = dict(self._extents), dict(self._lower)
                body = self.block(inside[1:])
                self._extents, self._lower = around
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
                        extents = self._sized(self.name(of), self.children(sizes))
                        yield ir.Assign(self.expr(of), None, line, extents=extents, is_real=True)
            case "data_set" if len(inside) > 1:
                yield from self._data_set(inside[:-1], inside[-1], line)
            case "data_statement":
                yield from self.block(inside)
            case "subroutine_call" if len(inside) == 2:
                args = self.exprs(inside[1].named_children)
                yield ir.Do(ir.Call(self.expr(inside[0]), args), line)

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        is_real = not _WHOLE.match(self.text(node.child_by_field_name("type")))
        of_all = [
            self.children(self.children(x)[0])
            for x in node.children_by_field_name("attribute")
            if self.text(x).lower().startswith("dimension")
        ]
        for each in node.children_by_field_name("declarator"):
            value = each.child_by_field_name("right") if each.type == "init_declarator" else None
            name = self.name(self._named(each))
            sized = each.child_by_field_name("left") if value is not None else each
            own = self.children(sized)[1:2] if sized and sized.type == "sized_declarator" else []
            sizes = self.children(own[0]) if own else of_all[0] if of_all else []
            extents = self._sized(name, sizes)
            target, line = ir.Name(name), line_of(each)
            if extents:
                yield ir.Assign(target, None, line, extents=extents, is_real=is_real)
            if value is not None:
                first = self.expr(value)
                number = _number(first)
                self._numbers |= {} if is_real or number is None else {name: number}
                if extents and isinstance(first, ir.Literal) and not float(first.text):
                    # zeros that procedures may change
                    first = ir.Call(ir.Name("zeros"), extents)
                yield ir.Assign(target, first, line, ".", is_real=is_real)

    def _sized(self, name: str, sizes: list[Node]) -> tuple[ir.Expr, ...]:
        """The extents of an array; what its indices begin with is remembered."""
        found: list[ir.Expr] = []
        lower: list[ir.Expr | None] = []
        for size in self.exprs(sizes):
            first, last = (size.first, size.last) if isinstance(size, ir.Range) else (None, size)
            is_one = first is None or first == _ONE
            lower.append(None if is_one else less_one(first or _ONE))
            if last is not None:
                last = last if is_one else ir.Binary("-", last, lower[-1] or _ONE)
            found.append(ir.Opaque("an extent that is not known") if last is None else last)
        self._extents[name], self._lower[name] = tuple(found), tuple(lower)
        return tuple(found)

    def _named(self, node: Node) -> Node:
        """What a declarator names."""
        while node.type in {"init_declarator", "sized_declarator"}:
            node = node.named_children[0]
        return node

    def _data_set(self, named: list[Node], values: Node, line: int) -> Iterator[ir.Statement]:
        """``data a, x / 1.0, 3*0.0 /``: the entries of arrays by columns, or as loops have them."""
        items: list[ir.Expr] = []
        count = 1
        for i, part in enumerate(values.children):
            if values.field_name_for_child(i) == "repeat" and self.text(part).isdigit():
                count = min(int(self.text(part)), MAX_STAGES**2)
            elif part.is_named:
                items += [self.expr(part)] * count
                count = 1
        for node in named:
            name = self.name(node)
            extents = self._extents.get(name, ())
            sizes = [_number(x) for x in extents]
            if extents and (node is named[-1] or None not in sizes):
                count = len(items) if None in sizes else math.prod(x or 0 for x in sizes)
                value: ir.Expr = ir.Items(tuple(items[:count]))
                if len(extents) > 1:
                    value = ir.Call(ir.Name("reshape"), (value, ir.Items(extents)))
                pairs: list[tuple[ir.Expr, ir.Expr]] = [(ir.Name(name), value)]
            else:
                targets = [] if extents else self._looped(node, {})
                count = len(targets) if targets and None not in targets else len(items) + 1
                pairs = [(x, y) for x, y in zip(targets, items, strict=False) if x is not None]
            if count > len(items):
                # which of the numbers are whose is not known
                lost = [ir.Name(self.first_name(x)) for x in named]
                pairs = [(x, ir.Opaque("a data statement")) for x in lost]
            for target, item in pairs:
                yield ir.Assign(target, item, line, is_real=True)
            if count > len(items):
                return
            items = items[count:]

    def _looped(self, node: Node, numbers: dict[str, int]) -> list[ir.Expr | None]:
        """The places that ``((a(i, j), j = 1, 3), i = 1, 3)`` names; None for unknown ones."""
        if node.type != "implied_do_loop_expression":
            return [_with_numbers(self.expr(node), numbers)]
        *inside, control = self.children(node)
        name, *given = self.children(control)
        ends = [_number(_with_numbers(x, numbers)) for x in self.exprs(given)]
        first, last = ends if len(ends) == 2 else (None, None)
        if first is None or last is None or last - first > MAX_STAGES**2:
            return [None]
        counts = ({**numbers, self.name(name): k} for k in range(first, last + 1))
        return [y for each in counts for x in inside for y in self._looped(x, each)]

    def _loop(self, node: Node, inside: list[Node]) -> ir.Loop:
        for control in inside[0].named_children:
            parts = self.children(control)
            if control.type == "loop_control_expression" and len(parts) == 3:
                name, *ends = parts
                return self.loop(node, self.name(name), ir.Range(*map(self.expr, ends)))
        return self.loop(node, "", ir.Range())

    def name(self, node: Node | None) -> str:
        """A name in small letters, or as a matrix ``A`` is written first: case has no meaning."""
        text = self.text(node)
        plain = text.lower()
        return self._spelled.setdefault(plain, text if text[:2] in {"A", "A_"} else plain)

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
        return ir.Index(self.expr(callee), self._from_one(name, args))

    def _from_one(self, name: str, at: tuple[ir.Expr, ...]) -> tuple[ir.Expr, ...]:
        """The indices of an array as they are when it begins with 1; counters of loops over arrays
        of unknown length, which are vectors, stay as they are.
        """
        lower = self._lower.get(name, ())
        if len(lower) != len(at):
            return at
        sizes = (_number(_with_numbers(x, self._numbers)) for x in self._extents.get(name, ()))
        of_each = zip(at, lower, sizes, strict=True)
        return tuple(
            x if by is None or (size is None and isinstance(x, ir.Name)) else _less(x, by)
            for x, by, size in of_each
        )


_ONE = ir.Literal("1", is_whole=True)


def _less(expr: ir.Expr, by: ir.Expr) -> ir.Expr:
    """An index, or the ends of a slice, less a number."""
    if isinstance(expr, ir.Range):
        ends = (None if x is None else _less(x, by) for x in (expr.first, expr.last))
        return ir.Range(*ends)
    return ir.Binary("-", expr, by)


def _with_numbers(expr: ir.Expr, numbers: Mapping[str, int]) -> ir.Expr:
    """An expression with numbers for some names."""
    match expr:
        case ir.Name(name) if name in numbers:
            return ir.Literal(str(numbers[name]), is_whole=True)
        case ir.Binary(sign, left, right):
            return ir.Binary(sign, _with_numbers(left, numbers), _with_numbers(right, numbers))
        case ir.Index(of, at):
            return ir.Index(of, tuple(_with_numbers(x, numbers) for x in at))
    return expr


def _number(expr: ir.Expr) -> int | None:
    """A whole number, also as a sum or a difference of such; None for others."""
    match expr:
        case ir.Literal(text, True):
            return int(text)
        case ir.Unary("-", of):
            found = _number(of)
            return None if found is None else -found
        case ir.Binary("+" | "-" as sign, left, right):
            a, b = _number(left), _number(right)
            return None if a is None or b is None else a + b if sign == "+" else a - b
    return None


READER = reader(
    FortranLowering,
    NAME,
    "Fortran: parameters, arrays, coefficients by name",
    (".f90", ".f95", ".f03", ".f08"),
    base=1,
    has_whole_quotients=True,
)
find = READER.find
