"""Julia.

The grammar silently misreads some arithmetic: ``3*(2)^2`` as (3·2)², ``5^(1/2)`` as a product, ``[a
-b]`` as one entry. So the operands and operators of an expression come from the grammar, and their
precedence from Julia's own rules.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from garkcli.sources import ir
from garkcli.sources.lowering import (
    MAX_NESTING,
    TOO_DEEP,
    Lowering,
    kinds,
    line_of,
    reader,
    unmeant,
)

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "julia"
_LEVELS = {
    **dict.fromkeys(("=>", "?"), 0),
    **dict.fromkeys(("||", "&&"), 1),
    **dict.fromkeys(("==", "<", ">", "<=", ">=", "!=", "<:", "===", "in", "isa", ":", "|>"), 2),
    **dict.fromkeys(("+", "-"), 3),
    **dict.fromkeys(("*", "/", "÷", "%", "\\"), 4),
    "//": 5,
    "": 6,
    "^": 8,
}
"""Precedence of operators, the empty one between factors; a sign is below the power."""
_SIGN_LEVEL = 7
_PLAIN = {"": "*", "//": "/"}
_PASSED = frozenset(
    {
        *("@big", "@SVector", "@SMatrix", "@SArray", "@MVector", "@MMatrix", "@dd", "@df64"),
        *("@.", "@view", "@views", "@inbounds", "@fastmath"),
    }
)
"""Macros that return their argument."""
_PARTED = frozenset({"block", "tried", "branch", "assignment"})
_DEFINITIONS = frozenset({"function_definition", "struct_definition"})
_SKIPPED = frozenset({"using_statement", "import_statement", "export_statement"})
_TYPED = frozenset({"signature", "where_expression", "typed_expression"})
_GENERAL = frozenset({"Type", "Val", "Number", "Real", "Integer", "Int", "Bool", "Union", "Any"})
"""General types, which own no functions."""
_BY_COLUMNS = frozenset({"SMatrix", "MMatrix"})
"""Types with their numbers of rows and columns, with entries by columns."""
_TYPE = re.compile(r"T[0-9]?")
"""Names of arguments that are types."""
_FIELDS = frozenset({"identifier", "typed_expression"})
_ARGUMENT = ir.Name("the argument")


_ROOT = re.compile(r"(?<=[0-9)])√")


class JuliaLowering(Lowering):
    """Functions, assignments, matrices and records of Julia."""

    grammar = "tree_sitter_julia"
    kinds = kinds(
        comment="line_comment block_comment",
        block="source_file module_definition begin_block compound_statement block let_statement"
        " toplevel const_statement global_statement local_statement ERROR",
        tried="try_statement",
        assignment="assignment compound_assignment_expression",
        name="boolean_literal identifier",
        number="integer_literal",
        text="string_literal",
        inside="parametrized_type_expression where_expression typed_expression",
        field="field_expression",
        range="range_expression",
        transposed="adjoint_expression",
        either="ternary_expression",
    )

    def __init__(self, text: str) -> None:
        # the grammar lacks 2√2 and the minus sign of Unicode
        super().__init__(_ROOT.sub("*√", text).replace("−", "-"))

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "function_definition" if inside:
                yield self._function(inside[0], inside[1:], line)
            case "macrocall_expression":
                yield from self._macro(node, inside, line)
            case "struct_definition":
                made = [y for x in inside for y in (self.children(x) if x.type == "block" else [x])]
                makers = [x for x in made if x.type == "function_definition"]
                values = [x for x in made if self.is_a("assignment", x)]
                values = [x for x in values if self.children(x)[0].type in _FIELDS]
                name = self.first_name(inside[0])
                fields = [self.first_name(x) for x in made if x.type in _FIELDS or x in values]
                own = self.block(makers)
                given = [[*x.parameters] for x in own if isinstance(x, ir.Scope)]
                if not own or fields in given:
                    # a constructor with other arguments may compute the fields
                    self.declares(name, fields)
                yield from own
                if values:
                    yield ir.Scope("class", name, self.block(values), line)
            case "for_statement" if inside:
                heads = [self.children(x) for x in inside if x.type == "for_binding"]
                turns = self.block(x for x in inside if x.type != "for_binding")
                for counter, *_, over in reversed(heads):
                    counted = self.text(counter) if counter.type == "identifier" else ""
                    turns = (ir.Loop(counted, self.expr(over), turns, line),)
                yield from turns
            case kind if kind not in _SKIPPED:
                yield ir.Do(self.expr(node), line)

    def _macro(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        """A macro; one before a definition is skipped."""
        name, args = self._macro_parts(inside)
        if args and name == "@unpack":
            first = self.children(args[0])
            for part in (self.children(first[0]) if first else []) or first[:1]:
                yield ir.Assign(ir.Name(self.text(part)), _ARGUMENT, line)
        elif args and (self.kinds.get(args[-1].type) in _PARTED or args[-1].type in _DEFINITIONS):
            yield from self.block(args[-1:])
        else:
            yield ir.Do(self.expr(node), line)

    def _macro_parts(self, inside: list[Node]) -> tuple[str, list[Node]]:
        """The name of a macro without its module, and its arguments."""
        name = next((self.text(x) for x in inside if x.type == "macro_identifier"), "")
        return name, [] if inside[-1].type == "macro_identifier" else self.children(inside[-1])

    def assignment(
        self, node: Node, left: Node | None, right: Node | None, sign: str | None = None
    ) -> Iterator[ir.Statement]:
        """An assignment, or a definition of a function by one expression."""
        inside = self.children(node)
        if len(inside) < 3:
            return
        left = head = inside[0]
        right = inside[-1]
        while head.type in _TYPED and head.named_children:
            head = head.named_children[0]
        if head.type == "call_expression":
            yield self._function(left, [right], line_of(node))
        else:
            sign = self.text(inside[1]).rstrip("=")
            yield from super().assignment(node, head, right, sign)

    def target(self, node: Node) -> ir.Expr:
        """The target of an assignment, or several."""
        is_several = node.type in {"open_tuple", "tuple_expression"}
        return ir.Items(self.exprs(node.named_children)) if is_several else self.expr(node)

    def _function(self, head: Node, body: list[Node], line: int) -> ir.Scope:
        types: set[str] = set()
        while head.type in _TYPED and head.named_children:
            head, *bounds = self.children(head)
            for each in bounds:
                types |= set(map(self.first_name, self.children(each) or [each]))
        inside = self.children(head)
        name, of, given = self.text(head) if head.type == "identifier" else "", "", inside[:0]
        if head.type == "call_expression" and inside:
            name = self.text(inside[0]).partition("{")[0].rpartition(".")[2]
            given = self.children(inside[1]) if len(inside) > 1 else []
            of = self._owner(given[0], types) if given else ""
        parameters = tuple(filter(None, [self._parameter(x, types) for x in given]))
        statements = self.block(body)
        match statements[-1:]:
            case (ir.Do(value, last),) if not _is_for_effect(value):
                # the last value is returned
                statements = (*statements[:-1], ir.Return(value, last))
        return ir.Scope("function", name, statements, line, parameters, frozenset(types), of=of)

    def _owner(self, given: Node, types: set[str]) -> str:
        """The type of an argument: ``::RK4{T}``, ``alg::RK4``."""
        if given.type not in {"unary_typed_expression", "typed_expression"}:
            return ""
        name = self.text(given.named_children[-1]).partition("{")[0]
        is_general = name in types or name in _GENERAL or name.startswith("Abstract")
        return "" if is_general else name

    def _parameter(self, given: Node, types: set[str]) -> str:
        """The name of a parameter; a parameter that is a type is added to ``types``."""
        if given.type == "named_argument":
            given = given.named_children[0]
        text, known = self.text(given), self.first_name(given)
        if given.type == "unary_typed_expression":
            return ""
        if "Type" in text or _TYPE.fullmatch(text):
            types.add(known)
            return ""
        return known

    # arithmetic

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        if self._is_arithmetic(node, inside):
            return self._combined(self._leaves(node))
        return super().expression(node, inside)

    def _is_arithmetic(self, node: Node, inside: list[Node]) -> bool:
        """Whether a node consists of operands and operators; ``5^(1/2)`` has a call of ``^``."""
        match node.type:
            case "binary_expression":
                return len(inside) == 3
            case "unary_expression":
                return len(inside) == 2 and self.text(inside[0]) in {"+", "-", "√"}
            case "call_expression":
                return len(inside) == 2 and inside[0].type == "operator"
        return node.type == "juxtaposition_expression"

    def _leaves(self, node: Node) -> Iterator[Node]:
        """The operands and operators of an expression, in order; ``a (b)`` are two operands."""
        waiting = [node]
        while waiting:
            node = waiting.pop()
            inside = self.children(node)
            is_apart = (
                node.type == "call_expression"
                and len(inside) == 2
                and inside[0].end_byte < inside[1].start_byte
                and len(self.children(inside[1])) == 1
            )
            if is_apart or self._is_arithmetic(node, inside):
                waiting += reversed(inside)
            else:
                yield node

    def _sign(self, node: Node) -> str:
        """An operator; empty for an operand."""
        text = self.text(node) if node.type == "operator" else ""
        return text[1:] if text[:1] == "." and len(text) > 1 else text

    def _combined(self, leaves: Iterable[Node]) -> ir.Expr:
        """The expression of leaves; long ones count as deep."""
        waiting = deque(leaves)
        longer = len(waiting) // 4
        self._depth += longer
        ordered = self._ordered(waiting)
        self._depth -= longer
        return ordered

    def _ordered(self, leaves: deque[Node], least: int = 0) -> ir.Expr:
        """The beginning of the leaves, with operators of at least a precedence."""
        if self._depth >= MAX_NESTING:
            leaves.clear()
            return TOO_DEEP
        if not leaves:
            return ir.Opaque("an operator without an operand")
        self._depth += 1
        first = leaves.popleft()
        sign = self._sign(first)
        value: ir.Expr = ir.Opaque(f"the operator {sign} without an operand")
        if not sign:
            value = self.expr(first)
        elif sign in {"+", "-", "√"}:
            inner = self._ordered(leaves, _SIGN_LEVEL)
            value = ir.Call(ir.Name("sqrt"), (inner,)) if sign == "√" else ir.Unary(sign, inner)
        while leaves and (level := _LEVELS.get(sign := self._sign(leaves[0]), 2)) >= least:
            if sign:
                leaves.popleft()
            right = self._ordered(leaves, level if sign == "^" else level + 1)
            value = ir.Binary(_PLAIN.get(sign, sign), value, right)
        self._depth -= 1
        return value

    def _entries(self, node: Node) -> list[list[ir.Expr]]:
        """Rows of entries: ``a -b`` are two, and a new line begins a row."""
        rows: list[list[ir.Expr]] = [[]]
        entry: list[Node] = []
        for leaf in self._leaves(node):
            if entry and not self._sign(entry[-1]):
                gap = self._data[entry[-1].end_byte : leaf.start_byte]
                sign, after = self._sign(leaf), self._data[leaf.end_byte : leaf.end_byte + 1]
                is_first = not sign or (sign in {"+", "-"} and not after.isspace())
                if gap.isspace() and is_first:
                    rows[-1].append(self._combined(entry))
                    entry = []
                    rows += [[]] if b"\n" in gap else []
            entry.append(leaf)
        rows[-1].append(self._combined(entry))
        return rows

    # operands

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "float_literal":
                return ir.Literal(self.text(node).lower().replace("f0", "").replace("f", "e"))
            case "parenthesized_expression" | "argument_list" if len(inside) == 1:
                return self.expr(inside[0])
            case "argument_list":
                return ir.Items(self.exprs(inside))
            case "vector_expression" if len(inside) == 1 and self.text(node)[-2:] != ",]":
                # [1 (2)] is a row of two
                rows = self._rows([node])
                is_list = len(rows) == len(rows[0]) == 1
                return ir.Items(rows[0]) if is_list else ir.Rows(rows)
            case "matrix_expression":
                other = next((x for x in inside if x.type != "matrix_row"), None)
                return unmeant(other) if other else ir.Rows(self._rows(inside))
            case "vector_expression" | "tuple_expression" | "open_tuple":
                return self._tuple(node, inside)
            case "comprehension_expression" if len(inside) == 2:
                return self._each(node, inside[0], inside[1])
            case "call_expression" | "broadcast_call_expression" if inside:
                return self._call(inside)
            case "index_expression" if len(inside) > 1:
                return self._index(inside[0], inside[1])
            case "prefixed_string_literal" if len(inside) == 2:
                if self.text(inside[0]) in {"big", "df64", "BigFloat"}:
                    return ir.Literal(self.text(inside[1]).strip('"'))
            case "quote_expression":
                return ir.Text(self.text(node).lstrip(":"))
            case "macrocall_expression" if inside:
                name, args = self._macro_parts(inside)
                if name in _PASSED and len(args) == 1:
                    return self.expr(args[0])
                return ir.Opaque(f"the macro {name}")
        return unmeant(node)

    def _tuple(self, node: Node, inside: list[Node]) -> ir.Expr:
        named = {"named_field", "named_argument", "assignment"} & {x.type for x in inside}
        if not named and not any(x.type == ";" for x in node.children):
            return ir.Items(self.exprs(inside))
        parts = [self.children(x) or [x] for x in inside]
        return ir.Fields(tuple((self.text(x[0]), self.expr(x[-1])) for x in parts))

    def _each(self, node: Node, value: Node, over: Node) -> ir.Expr:
        """``[a[i, j] for i in 1:3, j in 1:2]``, a matrix with a row for each i."""
        element = self.expr(value)
        for binding in reversed(self.children(over)):
            inside = self.children(binding)
            if len(inside) < 2 or inside[0].type != "identifier":
                return unmeant(node)
            each = ir.Lambda((self.text(inside[0]),), element)
            element = ir.Call(ir.Name("list of each"), (each, self.expr(inside[-1])))
        return element

    def _rows(self, rows: list[Node]) -> tuple[tuple[ir.Expr, ...], ...]:
        """The entries of rows."""
        rows_of_entries: list[list[ir.Expr]] = []
        for row in rows:
            rows_of_entries.append([])
            for each in self.children(row):
                first, *more = self._entries(each)
                rows_of_entries[-1] += first
                rows_of_entries += more
        return tuple(map(tuple, rows_of_entries))

    def _index(self, of: Node, at: Node) -> ir.Expr:
        if at.type in {"matrix_expression", "comprehension_expression"}:
            # T[1 2; 3 4], T[b[i] for i in 1:3]
            return self.expr(at)
        places = tuple(
            ir.Range() if self.text(part) == ":" else self.expr(part) for part in self.children(at)
        )
        return ir.Index(self.expr(of), places) if places else ir.Items(())

    def _call(self, inside: list[Node]) -> ir.Expr:
        given = inside[1] if len(inside) > 1 else None
        parts = self.children(given)
        if given is not None and len(parts) == 2 and parts[1].type == "for_clause":
            # sum(a[i] for i in 1:3)
            return self.call(self.expr(inside[0]), (self._each(given, *parts),))
        semicolon = next(
            (x.start_byte for x in reversed(given.children if given else []) if x.type == ";"), 0
        )
        # ; name: the value of that name
        short = {x for x in parts if 0 < semicolon < x.start_byte and x.type == "identifier"}
        args, named = self.arguments(x for x in parts if x not in short)
        named += tuple((self.text(x), self.expr(x)) for x in parts if x in short)
        callee = inside[0]
        has_entries = any(isinstance(x, ir.Index) for x in args)
        if callee.type == "parametrized_type_expression" and len(args) > 1 and not has_entries:
            name, sizes = self.children(callee)[:2]
            if self.text(name) in _BY_COLUMNS:
                shape = ir.Items(self.exprs(self.children(sizes)[:2]))
                return ir.Call(ir.Name("reshape"), (ir.Items(args), shape))
        return self.call(self.expr(callee), args, named)


def _is_for_effect(value: ir.Expr) -> bool:
    """Whether a call changes its arguments, or a statement is unknown."""
    match value:
        case ir.Call(ir.Name(name) | ir.Field(name=name)):
            return name.endswith("!")
    return isinstance(value, ir.Opaque)


READER = reader(
    JuliaLowering, NAME, "Julia: matrices with //, tableaus, caches of solvers", (".jl",), base=1
)
find = READER.find
