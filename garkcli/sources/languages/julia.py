"""Julia.

The grammar misreads some arithmetic without saying so: ``3*(2)^2`` is (3·2)² to it, ``5^(1/2)`` a
product, ``[a -b]`` one entry. So the operands and signs of an expression are taken from it, and
their order from Julia's own rules.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator

import tree_sitter_julia
from tree_sitter import Language, Node

from garkcli.frozen import Frozen, replace
from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import MAX_NESTING, TOO_DEEP, Lowering, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "julia"
JULIA = Language(tree_sitter_julia.language())
TIMES = "juxtaposed"
_LEVELS = {
    **dict.fromkeys(("=>", "?"), 0),
    **dict.fromkeys(("||", "&&"), 1),
    **dict.fromkeys(("==", "<", ">", "<=", ">=", "!=", "<:", "===", "in", "isa", ":", "|>"), 2),
    **dict.fromkeys(("+", "-"), 3),
    **dict.fromkeys(("*", "/", "÷", "%", "\\"), 4),
    "//": 5,
    TIMES: 6,
    "^": 8,
}
"""How tightly operators hold; a sign is between the product and the power."""
_SIGN_LEVEL = 7
_PASSED = frozenset(
    {
        *("@big", "@SVector", "@SMatrix", "@SArray", "@MVector", "@MMatrix", "@dd", "@df64"),
        *("@.", "@view", "@views", "@inbounds", "@fastmath"),
    }
)
"""Macros that give what they get."""
_BLOCKS = frozenset(
    {
        *("source_file", "module_definition", "begin_block", "compound_statement", "block"),
        *("let_statement", "toplevel", "const_statement", "global_statement"),
        *("local_statement", "try_statement", "ERROR"),
    }
)
_DEFINITIONS = frozenset(
    {"function_definition", "struct_definition", "assignment", "if_statement", *_BLOCKS}
)
_SKIPPED = frozenset({"using_statement", "import_statement", "export_statement"})

_GENERAL = frozenset({"Type", "Val", "Number", "Real", "Integer", "Int", "Bool", "Union", "Any"})
"""Types that say nothing of what a function belongs to."""


class Token(Frozen):
    """An operand or a sign of an expression.

    Attributes:
        sign: empty for an operand.
        start, end: its bytes.
        operand: what it is.
        is_prefix: whether the sign is before a value.
    """

    sign: str
    start: int
    end: int
    operand: ir.Expr = ir.Nothing()
    is_prefix: bool = False


_TYPE = re.compile(r"T[0-9]?")
"""Arguments that are types, by their names."""


class JuliaLowering(Lowering):
    """Functions, assignments, matrices and records of Julia."""

    def __init__(self, text: str) -> None:
        super().__init__(text, JULIA)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        line = line_of(node)
        inside = self.children(node)
        match node.type:
            case "function_definition" if inside:
                yield self._function(inside[0], inside[1:], line)
            case "macrocall_expression":
                yield from self._macro(node)
            case "struct_definition":
                yield self._record(inside, line)
            case "assignment" if len(inside) > 2:
                yield from self._assignment(inside[0], inside[-1], line)
            case "compound_assignment_expression":
                sign = self.text(inside[1]).rstrip("=")
                yield ir.Assign(self.expr(inside[0]), self.expr(inside[-1]), line, sign)
            case "return_statement":
                yield ir.Return(self.expr(inside[0] if inside else None), line)
            case "if_statement":
                yield self._if(node)
            case "for_statement" if inside:
                bound = self.children(inside[0])
                name = self.text(bound[0]) if bound and bound[0].type == "identifier" else ""
                yield ir.Loop(name, self.expr(bound[-1]), self.block(inside[1:]), line)
            case "while_statement":
                yield ir.Loop("", ir.Nothing(), self.block(inside[1:]), line)
            case kind if kind in _BLOCKS:
                if kind == "try_statement":
                    yield self.passed_over(node)
                yield from self.block(inside)
            case kind if kind not in _SKIPPED:
                yield ir.Do(self.expr(node), line)

    def _macro(self, node: Node) -> Iterator[ir.Statement]:
        """A macro before a definition is passed over."""
        inside = self.children(node)
        args = self.children(inside[1]) if len(inside) > 1 else []
        is_taken_apart = self.text(inside[0]) == "@unpack"
        if args and args[-1].type in _DEFINITIONS and not is_taken_apart:
            yield from self.block(args[-1:])
            return
        if is_taken_apart and args:
            parts = self.children(self.children(args[0])[0]) if self.children(args[0]) else []
            for part in parts or self.children(args[0])[:1]:
                yield ir.Assign(ir.Name(self.text(part)), ir.Name(_ARGUMENT), line_of(node))
            return
        yield ir.Do(self.expr(node), line_of(node))

    def _record(self, inside: list[Node], line: int) -> ir.Scope:
        fields = []
        for part in inside[1:]:
            for each in [part] if part.type != "block" else self.children(part):
                name: Node | None = each
                while name is not None and name.type != "identifier":
                    name = next(iter(self.children(name)), None)
                if name is not None:
                    fields.append((self.text(name), None))
        head: Node | None = inside[0]
        while head is not None and head.type != "identifier":
            head = next(iter(self.children(head)), None)
        parts = [y for x in inside for y in (self.children(x) if x.type == "block" else [x])]
        made = self.block(x for x in parts if x.type == "function_definition")
        return ir.Scope("record", self.text(head), made, line, tuple(fields))

    def _assignment(self, left: Node, right: Node, line: int) -> Iterator[ir.Statement]:
        head = left
        while head.type in {"where_expression", "typed_expression"} and head.named_children:
            head = head.named_children[0]
        if head.type == "call_expression":
            yield self._function(left, [right], line)
            return
        if right.type == "assignment":
            # a = b = 0
            yield from self.block([right])
            right = self.children(right)[0]
        target = self.expr(head)
        if head.type in {"open_tuple", "tuple_expression"}:
            target = ir.Items(self.exprs(head.named_children))
        yield ir.Assign(target, self.expr(right), line)

    def _function(self, head: Node, body: list[Node], line: int) -> ir.Scope:
        types: set[str] = set()
        if head.type == "signature" and head.named_children:
            head = head.named_children[0]
        while head.type in {"where_expression", "typed_expression"}:
            parts = self.children(head)
            if head.type == "where_expression":
                types |= {x for part in parts[1:] for x in self._type_names(part)}
            head = parts[0]
        parameters = []
        name = of = ""
        inside = self.children(head)
        if head.type == "call_expression" and inside:
            name = self.text(inside[0]).partition("{")[0].rpartition(".")[2]
            given_all = self.children(inside[1]) if len(inside) > 1 else []
            of = self._owner(given_all[0], types) if given_all else ""
            for given in given_all:
                known = self._parameter(given, types)
                if known:
                    parameters.append((known, None))
        elif head.type == "identifier":
            name = self.text(head)
        statements = self.block(body)
        match statements[-1:]:
            case (ir.Do(value=value, line=last),):
                # the last value is what the function gives
                statements = (*statements[:-1], ir.Return(value, last))
        return ir.Scope(
            "function", name, statements, line, tuple(parameters), frozenset(types), of=of
        )

    def _owner(self, given: Node, types: set[str]) -> str:
        """The type of an argument: ``::RK4{T}``, ``alg::RK4``."""
        if given.type not in {"unary_typed_expression", "typed_expression"}:
            return ""
        node = given.named_children[-1]
        if node.type == "parametrized_type_expression" and node.named_children:
            node = node.named_children[0]
        name = self.text(node)
        is_general = name in types or name in _GENERAL or name.startswith("Abstract")
        return "" if is_general else name

    def _parameter(self, given: Node, types: set[str]) -> str:
        """The name of a parameter; one that is a type is put among these."""
        if given.type == "named_argument":
            given = given.named_children[0]
        text = self.text(given)
        name = given
        while name.type != "identifier" and name.named_children:
            name = name.named_children[0]
        known = self.text(name)
        if given.type == "unary_typed_expression":
            return ""
        if "Type" in text or _TYPE.fullmatch(text):
            types.add(known)
            return ""
        return known

    def _type_names(self, node: Node) -> list[str]:
        if node.type == "identifier":
            return [self.text(node)]
        inside = self.children(node)
        if node.type == "binary_expression":
            inside = inside[:1]
        return [x for part in inside for x in self._type_names(part)]

    def _if(self, node: Node) -> ir.Statement:
        conditions: list[ir.Expr] = []
        arms: list[ir.Body] = []
        is_total = False
        parts: list[Node] = []
        for part in self.children(node):
            if part.type == "elseif_clause":
                inside = self.children(part)
                conditions.append(self.expr(inside[0]))
                arms.append(self.block(inside[1:]))
            elif part.type == "else_clause":
                arms.append(self.block(part.named_children))
                is_total = True
            else:
                parts.append(part)
        first = self.block(parts[1:])
        test = self.expr(parts[0]) if parts else ir.Nothing()
        return ir.Branch((test, *conditions), (first, *arms), line_of(node), is_total)

    # arithmetic

    def expression(self, node: Node) -> ir.Expr:
        if node.type in {"binary_expression", "juxtaposition_expression"} or self._is_signed(node):
            return _ordered(deque(self._tokens(node)))
        return self._operand(node)

    def _is_signed(self, node: Node) -> bool:
        inside = node.named_children
        is_unary = node.type == "unary_expression" and len(inside) == 2
        return is_unary and self.text(inside[0]) in {"+", "-"}

    def _tokens(self, node: Node) -> list[Token]:
        """The operands and signs of an expression, in order."""
        if self._depth >= MAX_NESTING:
            return [Token("", node.start_byte, node.end_byte, TOO_DEEP)]
        self._depth += 1
        try:
            return self._parted(node)
        finally:
            self._depth -= 1

    def _parted(self, node: Node) -> list[Token]:
        inside = self.children(node)
        kind = node.type
        if kind == "binary_expression" and len(inside) == 3:
            return [*self._tokens(inside[0]), self._sign(inside[1]), *self._tokens(inside[2])]
        if self._is_signed(node):
            return [replace(self._sign(inside[0]), is_prefix=True), *self._tokens(inside[-1])]
        if kind == "juxtaposition_expression" and inside:
            found = self._tokens(inside[0])
            for part in inside[1:]:
                tokens = self._tokens(part)
                if not tokens[0].sign or tokens[0].is_prefix:
                    found.append(Token(TIMES, part.start_byte, part.start_byte))
                found += tokens
            return found
        if kind == "call_expression" and len(inside) == 2:
            args = inside[1]
            if inside[0].type == "operator":
                # 5^(1/2)
                return [self._sign(inside[0]), self._bracket(args)]
            if inside[0].end_byte < args.start_byte and len(self.children(args)) == 1:
                # a (b)
                times = Token(TIMES, args.start_byte, args.start_byte)
                return [*self._tokens(inside[0]), times, self._bracket(args)]
        return [Token("", node.start_byte, node.end_byte, self._operand(node))]

    def _sign(self, node: Node) -> Token:
        text = self.text(node)
        plain = text[1:] if text[:1] == "." and len(text) > 1 else text
        return Token(plain, node.start_byte, node.end_byte)

    def _bracket(self, args: Node) -> Token:
        inner = self.exprs(args.named_children)
        value = inner[0] if len(inner) == 1 else ir.Items(inner)
        return Token("", args.start_byte, args.end_byte, value)

    def _entries(self, node: Node) -> list[list[ir.Expr]]:
        """Rows of entries: ``a -b`` are two, and a new line begins a row."""
        rows: list[list[ir.Expr]] = [[]]
        part: deque[Token] = deque()
        end = node.start_byte
        for token in self._tokens(node):
            gap = self._data[end : token.start]
            after = self._data[token.end : token.end + 1]
            end = token.end
            is_gap = bool(gap) and gap.isspace()
            is_sign = token.sign in {"+", "-"} and not token.is_prefix and not after.isspace()
            if part and is_gap and (token.sign == TIMES or is_sign):
                rows[-1].append(_ordered(part))
                part = deque()
                if b"\n" in gap:
                    rows.append([])
                if token.sign != TIMES:
                    part.append(replace(token, is_prefix=True))
                continue
            part.append(token)
        rows[-1].append(_ordered(part))
        return rows

    # operands

    def _operand(self, node: Node) -> ir.Expr:
        inside = self.children(node)
        match node.type:
            case "integer_literal":
                return ir.Literal(self.text(node), is_whole=True)
            case "float_literal":
                return ir.Literal(self.text(node).lower().replace("f0", "").replace("f", "e"))
            case "boolean_literal" | "identifier":
                return ir.Name(self.text(node))
            case "parenthesized_expression" if len(inside) == 1:
                return self.expr(inside[0])
            case "vector_expression" if len(inside) == 1 and self.text(node)[-2:] != ",]":
                # [1 (2)] is a row of two
                rows = self._entries(inside[0])
                is_list = len(rows) == len(rows[0]) == 1
                return ir.Items(tuple(rows[0])) if is_list else ir.Rows(tuple(map(tuple, rows)))
            case "vector_expression" | "tuple_expression" | "open_tuple":
                return self._tuple(node, inside)
            case "matrix_expression":
                return self._matrix(inside)
            case "unary_expression" if len(inside) == 2 and self.text(inside[0]) == "√":
                return ir.Call(ir.Name("sqrt"), (self.expr(inside[1]),))
            case "call_expression" | "broadcast_call_expression" if inside:
                return self._call(inside)
            case "field_expression" if len(inside) > 1:
                return ir.Field(self.expr(inside[0]), self.text(inside[-1]))
            case "index_expression" if len(inside) > 1:
                return self._index(inside[0], inside[1])
            case "range_expression" if len(inside) == 2:
                return ir.Range(self.expr(inside[0]), self.expr(inside[1]))
            case "adjoint_expression" if inside:
                return ir.Transposed(self.expr(inside[0]))
            case "parametrized_type_expression" | "where_expression" | "typed_expression" if inside:
                return self.expr(inside[0])
            case "prefixed_string_literal" if len(inside) == 2:
                if self.text(inside[0]) in {"big", "df64", "BigFloat"}:
                    return ir.Literal(self.text(inside[1]).strip('"'))
            case "string_literal":
                return ir.Text(self.text(node).strip('"'))
            case "quote_expression":
                return ir.Text(self.text(node).lstrip(":"))
            case "macrocall_expression" if inside:
                args = self.children(inside[1]) if len(inside) > 1 else []
                if self.text(inside[0]) in _PASSED and len(args) == 1:
                    return self.expr(args[0])
                return ir.Opaque(f"the macro {self.text(inside[0])}")
        return unmeant(node)

    def _tuple(self, node: Node, inside: list[Node]) -> ir.Expr:
        named = [x for x in inside if x.type in {"named_field", "named_argument", "assignment"}]
        has_semicolon = any(x.type == ";" for x in node.children)
        if named or has_semicolon:
            pairs = []
            for part in inside:
                parts = self.children(part)
                name, value = (parts[0], parts[-1]) if parts else (part, part)
                pairs.append((self.text(name), self.expr(value)))
            return ir.Fields(tuple(pairs))
        return ir.Items(self.exprs(inside))

    def _matrix(self, inside: list[Node]) -> ir.Expr:
        rows: list[list[ir.Expr]] = []
        for row in inside:
            if row.type != "matrix_row":
                return unmeant(row)
            rows.append([])
            for part in self.children(row):
                found = self._entries(part)
                rows[-1] += found[0]
                rows += found[1:]
        return ir.Rows(tuple(map(tuple, rows)))

    def _index(self, of: Node, at: Node) -> ir.Expr:
        if at.type == "matrix_expression":
            # T[1 2; 3 4]
            return self.expr(at)
        places: list[ir.Expr] = []
        for part in self.children(at):
            is_all = self.text(part) == ":"
            places.append(ir.Range() if is_all else self.expr(part))
        if not places:
            return ir.Items(())
        return ir.Index(self.expr(of), tuple(places))

    def _call(self, inside: list[Node]) -> ir.Expr:
        args: list[ir.Expr] = []
        named: list[tuple[str, ir.Expr]] = []
        given = inside[1] if len(inside) > 1 else None
        semicolon = 0
        for part in given.children if given is not None else []:
            if part.type == ";":
                semicolon = part.start_byte
        for part in self.children(given):
            parts = self.children(part)
            if part.type == "named_argument":
                named.append((self.text(parts[0]), self.expr(parts[-1])))
            elif part.type in {"keyword_parameters", "keyword_arguments"}:
                for each in parts:
                    pair = self.children(each) or [each]
                    named.append((self.text(pair[0]), self.expr(pair[-1])))
            elif semicolon and part.start_byte > semicolon and part.type == "identifier":
                # ; name: the value of that name
                named.append((self.text(part), ir.Name(self.text(part))))
            else:
                args.append(self.expr(part))
        return ir.Call(self.expr(inside[0]), tuple(args), tuple(named))


_ARGUMENT = "the argument"


def _ordered(tokens: deque[Token]) -> ir.Expr:
    """The expression that all tokens are."""
    found = _climbed(tokens)
    return ir.Opaque("an operator is missing") if tokens else found


def _climbed(tokens: deque[Token], least: int = 0) -> ir.Expr:
    """The expression that tokens are, by how tightly its operators hold."""
    if not tokens:
        return ir.Opaque("an operator without an operand")
    token = tokens.popleft()
    if token.sign in {"+", "-"}:
        value: ir.Expr = ir.Unary(token.sign, _climbed(tokens, _SIGN_LEVEL))
    elif token.sign:
        return ir.Opaque(f"the operator {token.sign} without an operand")
    else:
        value = token.operand
    while tokens:
        sign = tokens[0].sign
        level = _LEVELS.get(sign, 2)
        if level < least or not sign or tokens[0].is_prefix:
            break
        tokens.popleft()
        right = _climbed(tokens, level if sign == "^" else level + 1)
        plain = {TIMES: "*", "//": "/"}.get(sign, sign)
        value = ir.Binary(plain, value, right)
    return value


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Julia source."""
    return tables_in(text, source, NAME, lambda x: JuliaLowering(x).module(), base=1)


READER = Reader(NAME, "Julia: matrices with //, tableaus, caches of solvers", (".jl",), find)
