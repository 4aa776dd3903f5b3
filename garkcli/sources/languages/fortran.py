"""Fortran: free form from 1990 on, and the older fixed form, converted to free form."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import islice, product
from typing import TYPE_CHECKING

from garkcli.deadline import checked
from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable
from garkcli.sources.lowering import (
    INCLUDED,
    Lowering,
    is_in_c,
    kinds,
    less_one,
    line_of,
    part,
    reader,
    unmeant,
)

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "fortran"
_PROCEDURES = frozenset({"subroutine", "function", "module_procedure", "program"})
_WHOLE = re.compile(r"\s*(?:integer|logical)", re.IGNORECASE)
_FUNCTIONS = frozenset(
    {
        *("real", "dble", "reshape", "transpose", "sum", "size", "spread"),
        *("sqrt", "cos", "sin", "acos", "atan"),
    }
)
_RESHAPE = ir.Name("reshape")
_UNKNOWN = ir.Opaque("a data statement")
_ONE = ir.Literal("1", is_whole=True)


class _UnknownEntry(Exception):
    """An index in a data statement is no known number."""


class FortranLowering(Lowering):
    """Declarations and assignments of Fortran; names are case-insensitive."""

    grammar = "tree_sitter_fortran"
    kinds = kinds(
        block="translation_unit module submodule internal_procedures ERROR data_statement"
        " preproc_else",
        switch="select_case_statement",
        case="case_statement",
        label="case_value_range_list default",
        passed="select_type_statement select_rank_statement where_statement forall_statement",
        name="identifier",
        number="number_literal",
        text="string_literal",
        inside="parenthesized_expression",
        unary="unary_expression",
        binary="math_expression",
        field="derived_type_member_expression",
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
                name, given = part(inside[0], "name"), part(inside[0], "parameters")
                parameters = tuple(map(self.name, self.children(given)))
                around = dict(self._extents), dict(self._lower)
                body = self.block(inside[1:])
                self._extents, self._lower = around
                yield ir.Scope("function", self.name(name), body, line, parameters)
            case "preproc_ifdef" | "preproc_if" | "preproc_elif":
                yield from self.conditional(node)
            case "variable_declaration":
                yield from self._declaration(node)
            case "derived_type_definition":
                parts = [y for x in inside for y in x.children_by_field_name("declarator")]
                name = self.children(inside[0])[-1]
                self.declares(self.name(name), map(self.first_name, parts))
            case "parameter_statement":
                for each in inside:
                    match self.exprs(self.children(each)):
                        case (ir.Name() as constant, value):
                            yield ir.Assign(constant, value, line)
            case "assignment_statement" if len(inside) == 2:
                # a number assigned to an array fills it
                sign = "" if inside[0].type == "call_expression" else "."
                yield from self.assignment(node, inside[0], inside[1], sign)
            case "do_loop" | "do_loop_statement":
                yield self._loop(node, inside)
            case "associate_statement" if inside:
                for each in self.children(inside[0]):
                    match self.exprs(each.named_children):
                        case (target, value):
                            yield ir.Assign(target, value, line)
                yield from self.block(inside[1:])
            case "allocate_statement":
                for each in inside:
                    if each.type == "sized_allocation":
                        of, sizes = self.children(each)[:2]
                        extents = self._sized(self.name(of), self.children(sizes))
                        yield ir.Assign(self.expr(of), None, line, extents=extents, is_real=True)
            case "data_set" if len(inside) > 1:
                yield from self._data_set(inside[:-1], inside[-1], line)
            case "subroutine_call" if len(inside) == 2:
                args = self.exprs(inside[1].named_children)
                yield ir.Do(ir.Call(self.expr(inside[0]), args), line)

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        is_real = not _WHOLE.match(self.text(part(node, "type")))
        attributes = node.children_by_field_name("attribute")
        shared = [x for x in attributes if self.text(x).lower().startswith("dimension")]
        for each in node.children_by_field_name("declarator"):
            initialiser, sized = part(each, "right"), part(each, "left") or each
            own = [x for x in self.children(sized)[1:] if sized.type == "sized_declarator"]
            sizes = own or [y for x in shared for y in self.children(x)]
            name, line = self.first_name(each), line_of(each)
            extents = self._sized(name, self.children(sizes[0]) if sizes else [])
            if extents:
                yield ir.Assign(ir.Name(name), None, line, extents=extents, is_real=is_real)
            if initialiser is not None:
                value = self.expr(initialiser)
                number = self._number(value)
                self._numbers |= {} if is_real or number is None else {name: number}
                digits = value.text.partition("e")[0] if isinstance(value, ir.Literal) else "1"
                if extents and not digits.strip("0."):
                    # procedures may change these zeros
                    value = ir.Call(ir.Name("zeros"), extents)
                yield ir.Assign(ir.Name(name), value, line, ".", is_real=is_real)

    def _sized(self, name: str, sizes: list[Node]) -> tuple[ir.Expr, ...]:
        """The extents of an array; the first indices are remembered."""
        extents: list[ir.Expr] = []
        lower: list[ir.Expr | None] = []
        for size in self.exprs(sizes):
            first, last = (size.first, size.last) if isinstance(size, ir.Range) else (None, size)
            by = None if first is None or first == _ONE else less_one(first)
            if last is None:
                last = ir.Opaque("an extent that is not known")
            extents.append(last if by is None else ir.Binary("-", last, by))
            lower.append(by)
        self._extents[name], self._lower[name] = tuple(extents), tuple(lower)
        return tuple(extents)

    def _data_set(self, named: list[Node], values: Node, line: int) -> Iterator[ir.Statement]:
        """``data a, x(1), (y(1, j), j = 1, 2) / 1.0, 3*0.0 /``: entries of arrays by columns;
        those of arrays of unknown size, and at unknown indices, are unknown.
        """
        items: list[ir.Expr] = []
        value: ir.Expr
        count = 1
        for i, each in enumerate(values.children):
            if values.field_name_for_child(i) == "repeat" and self.text(each).isdigit():
                count = min(int(self.text(each)), MAX_STAGES**2)
            elif each.is_named:
                items += [self.expr(each)] * count
                count = 1
        is_known, written = True, next(iter(items), _UNKNOWN)
        for node in named:
            entries = None if self.is_a("name", node) else self._entries(node, len(items))
            if is_known and entries is not None:
                for entry, value in zip(entries, items, strict=False):
                    yield ir.Assign(entry, value, line, is_real=True)
                items = items[len(entries) :]
                continue
            name = self.first_name(node)
            extents = self._extents.get(name, ())
            sizes = [self._number(x) or 0 for x in extents]
            count = math.prod(sizes)
            is_known = is_known and self.is_a("name", node) and 0 < count <= len(items)
            target: ir.Expr = ir.Name(name)
            if not is_known:
                # numbers at unknown places
                yield ir.Assign(target, written, line, ".", is_real=True)
                target, value = ir.Index(target, (_UNKNOWN,)), _UNKNOWN
            elif extents:
                value = ir.Call(_RESHAPE, (ir.Items(tuple(items[:count])), ir.Items(extents)))
            else:
                value = items[0]
            yield ir.Assign(target, value, line, is_real=True)
            items = items[count:]

    def _entries(self, node: Node, most: int) -> list[ir.Expr] | None:
        """The entries of an array in a data statement, or in a loop there; None if they are more,
        or unknown.
        """
        before = dict(self._numbers)
        try:
            found = list(islice(self._each_entry(node), most + 1))
        except _UnknownEntry:
            return None
        finally:
            # without the counters
            self._numbers = before
        return found if len(found) <= most else None

    def _each_entry(self, node: Node, levels: int = 2) -> Iterator[ir.Expr]:
        inside = self.children(node)
        if node.type == "call_expression" and len(inside) == 2:
            name, given = self.name(inside[0]), self.children(inside[1])
            sizes = [self._number(x) for x in self._extents.get(name, ())]
            ends = [None if x else n for n, x in zip(sizes, self._lower.get(name, ()), strict=True)]
            ends = ends if len(ends) == len(given) else [None] * len(given)
            at = [*map(self._indices, given, ends)]
            # the first index varies fastest
            for backwards in checked(product(*reversed(at))):
                indices = tuple(ir.Literal(str(i), is_whole=True) for i in reversed(backwards))
                yield ir.Index(ir.Name(name), self._from_one(name, indices))
            return
        control = self.children(inside[-1]) if inside else []
        bounds = [self._number(x) for x in self.exprs(control[1:])]
        bounds = [*bounds, 1] if len(bounds) == 2 else bounds
        if node.type != "implied_do_loop_expression" or len(bounds) != 3 or not levels:
            raise _UnknownEntry
        first, last, by = bounds
        if not by:
            raise _UnknownEntry
        for k in _range(first, last, by):
            self._numbers[self.name(control[0])] = k
            for each in inside[:-1]:
                yield from self._each_entry(each, levels - 1)

    def _indices(self, node: Node, size: int | None) -> range:
        """The values of an index, or those of a slice, which may end at the size of the array."""
        value = self.expr(node)
        ends = (value.first, value.last) if isinstance(value, ir.Range) else (value, value)
        # an array without a known size may begin at any index
        first, last = (
            default if x is None else self._number(x)
            for x, default in zip(ends, (size and 1, size), strict=True)
        )
        return _range(first, last)

    def _loop(self, node: Node, inside: list[Node]) -> ir.Loop:
        for control in inside[0].named_children:
            bound = self.children(control)
            if control.type == "loop_control_expression" and len(bound) == 3:
                return self.loop(node, self.name(bound[0]), ir.Range(*self.exprs(bound[1:])))
        return self.loop(node, "", ir.Range())

    def name(self, node: Node | None) -> str:
        """A name in lower case, or for a matrix ``A`` as first written: case has no meaning."""
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
        return unmeant(node)

    def _called(self, callee: Node, given: Node) -> ir.Expr:
        """A call, or an entry of an array: both have parentheses."""
        args, named = self.arguments(self.children(given))
        name = self.name(callee)
        if name in _FUNCTIONS:
            wanted = args[:1] if name in {"real", "dble"} else args
            return ir.Call(ir.Name(name), wanted, named)
        if self.made(name, args) or (named and not args):
            return self.call(ir.Name(name), args, named)
        match args:
            case (ir.Name(of),) if name == "shape" and of in self._extents:
                return ir.Items(self._extents[of])
        return ir.Index(self.expr(callee), self._from_one(name, args))

    def _from_one(self, name: str, at: tuple[ir.Expr, ...]) -> tuple[ir.Expr, ...]:
        """The indices of an array counted from 1; counters of loops over vectors of unknown length
        are unchanged.
        """
        lower = self._lower.get(name, ())
        if len(lower) != len(at):
            return at
        sizes = map(self._number, self._extents.get(name, ()))
        return tuple(
            x if by is None or (size is None and isinstance(x, ir.Name)) else _less(x, by)
            for x, by, size in zip(at, lower, sizes, strict=True)
        )

    def _number(self, expr: ir.Expr) -> int | None:
        """An integer, also by its name, as a sum or a difference; None for others."""
        match expr:
            case ir.Literal(text, True):
                return int(text)
            case ir.Name(name):
                return self._numbers.get(name)
            case ir.Unary("-", of):
                value = self._number(of)
                return None if value is None else -value
            case ir.Binary("+" | "-" as sign, left, right):
                a, b = self._number(left), self._number(right)
                return None if a is None or b is None else a + b if sign == "+" else a - b
        return None


def _range(first: int | None, last: int | None, by: int = 1) -> range:
    """The numbers from the first to the last one, few enough for the entries of a method."""
    if first is None or last is None or abs(last - first) >= MAX_STAGES * abs(by):
        raise _UnknownEntry
    return range(first, last + (1 if by > 0 else -1), by)


def _less(expr: ir.Expr, by: ir.Expr) -> ir.Expr:
    """An index, or the ends of a slice, minus a number."""
    if isinstance(expr, ir.Range):
        ends = (None if x is None else _less(x, by) for x in (expr.first, expr.last))
        return ir.Range(*ends)
    return ir.Binary("-", expr, by)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Fortran source."""
    is_fixed = source.lower().endswith(_FIXED)
    if source.lower().endswith(INCLUDED):
        if is_in_c(text):
            return []
        is_fixed = _IN_FIXED_FORM.fullmatch(text) is not None
    return _READER.find(_free(text) if is_fixed else text, source)


def _free(text: str) -> str:
    """A source in fixed form converted to free form, line by line: comments have a letter in column
    1, continuation lines a sign in column 6.
    """
    lines = text.split("\n")
    last = -1
    for i, line in enumerate(lines):
        if line[:1] in set("cCdD*!"):
            lines[i] = f"!{line[1:]}"
        elif not line[:5].strip() and line[5:6] not in {"", " ", "0", "\t"}:
            lines[i] = f"     &{line[6:]}"
            if last >= 0:
                code = _CODE.match(lines[last])
                lines[last] = f"{code[0] if code else lines[last]} &"
        if lines[i].strip() and not lines[i].lstrip().startswith(("!", "#")):
            last = i
    return "\n".join(_with_ends(lines))


def _with_ends(lines: list[str]) -> list[str]:
    """Loops up to a label, ``do 10 i = 1, n``, with ``end do`` after the labelled statement."""
    open_loops: list[str] = []
    ended = 0
    for i, line in enumerate(lines):
        if line.startswith("!"):
            continue
        if begun := _TO_LABEL.match(line):
            open_loops.append(begun["label"])
            lines[i] = f"{begun['head']}do {begun['rest']}"
        elif (labelled := _LABEL.match(line)) and labelled["label"] in open_loops:
            while open_loops and open_loops[-1] == labelled["label"]:
                open_loops.pop()
                ended += 1
            lines[i] = f"      {labelled['rest']}"
        if ended and not lines[i].rstrip().endswith("&"):
            lines[i] += " ; end do" * ended
            ended = 0
    return lines


_TO_LABEL = re.compile(
    r"(?P<head>[ 0-9]*)do\s+(?P<label>\d+)\s*,?\s*(?P<rest>\w+\s*=.*)", re.IGNORECASE
)
_LABEL = re.compile(r" {0,4}(?P<label>\d+)\s+(?P<rest>\S.*)")
_CODE = re.compile(r"(?:[^!'\"]|'[^']*'|\"[^\"]*\")*")
"""A line without its comment."""
_IN_FIXED_FORM = re.compile(r"(?:(?:[cCdD*!#\t][^\n]*|[ 0-9]{5}[^\n]*|\s*)(?:\n|\Z))*")
"""Lines with comments, labels or blanks only in their first five columns."""
_FIXED = (".f", ".for", ".f77", ".ftn")
_READER = reader(
    FortranLowering,
    NAME,
    "Fortran: parameters, arrays, coefficients by name",
    (".f90", ".f95", ".f03", ".f08", *_FIXED, INCLUDED),
    base=1,
    has_whole_quotients=True,
)
READER = replace(_READER, find=find)
