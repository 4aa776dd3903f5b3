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
from garkcli.sources.lowering import MAX_NESTING, TOO_DEEP, Lowering, kinds, reader, unmeant

NAME = "julia"
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
    {
        *("function_definition", "struct_definition", "assignment", "if_statement"),
        *("compound_assignment_expression", *_BLOCKS),
    }
)
_SKIPPED = frozenset({"using_statement", "import_statement", "export_statement"})
_TYPED = frozenset({"where_expression", "typed_expression"})
_GENERAL = frozenset({"Type", "Val", "Number", "Real", "Integer", "Int", "Bool", "Union", "Any"})
"""Types that say nothing of what a function belongs to."""
_BY_COLUMNS = frozenset({"SMatrix", "MMatrix"})
"""Types with their numbers of rows and columns, which take entries by columns."""
_TYPE = re.compile(r"T[0-9]?")
"""Arguments that are types, by their names."""
_FIELDS = frozenset({"identifier", "typed_expression"})
_ARGUMENT = ir.Name("the argument")


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


class JuliaLowering(Lowering):
    """Functions, assignments, matrices and records of Julia."""

    grammar = Language(tree_sitter_julia.language())
    comments = frozenset({"comment", "line_comment", "block_comment"})
    blocks = _BLOCKS
    passed = frozenset({"try_statement"})
    expressions = kinds(
        name="boolean_literal identifier",
        number="integer_literal",
        text="string_literal",
        inside="parametrized_type_expression where_expression typed_expression",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "function_definition" if inside:
                yield self._function(inside[0], inside[1:], line)
            case "macrocall_expression":
                yield from self._macro(node, inside, line)
            case "struct_definition":
                made = [y for x in inside for y in (self.children(x) if x.type == "block" else [x])]
                makers = [x for x in made if x.type == "function_definition"]
                values = [x for x in made if x.type == "assignment"]
                name = self.first_name(inside[0])
                if not makers:
                    fields = [x for x in made if x.type in _FIELDS or x in values]
                    self.declares(name, map(self.first_name, fields))
                yield from self.block(makers)
                values = [x for x in values if self.children(x)[0].type in _FIELDS]
                if values:
                    yield ir.Scope("class", name, self.block(values), line)
            case "assignment" if len(inside) > 2:
                yield from self._assignment(inside[0], inside[-1], line)
            case "compound_assignment_expression":
                sign = self.text(inside[1]).rstrip("=")
                yield ir.Assign(self.expr(inside[0]), self.expr(inside[-1]), line, sign)
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
        """A macro before a definition is passed over."""
        name, args = self._macro_parts(inside)
        if args and name == "@unpack":
            first = self.children(args[0])
            for part in (self.children(first[0]) if first else []) or first[:1]:
                yield ir.Assign(ir.Name(self.text(part)), _ARGUMENT, line)
        elif args and args[-1].type in _DEFINITIONS:
            yield from self.block(args[-1:])
        else:
            yield ir.Do(self.expr(node), line)

    def _macro_parts(self, inside: list[Node]) -> tuple[str, list[Node]]:
        """The name of a macro, without that of its module, and what it is given."""
        name = next((self.text(x) for x in inside if x.type == "macro_identifier"), "")
        return name, [] if inside[-1].type == "macro_identifier" else self.children(inside[-1])

    def _assignment(self, left: Node, right: Node, line: int) -> Iterator[ir.Statement]:
        head = left
        while head.type in _TYPED and head.named_children:
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
        while head.type in _TYPED:
            parts = self.children(head)
            if head.type == "where_expression":
                types |= {x for part in parts[1:] for x in self._type_names(part)}
            head = parts[0]
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
                # the last value is what the function gives
                statements = (*statements[:-1], ir.Return(value, last))
        return ir.Scope("function", name, statements, line, parameters, frozenset(types), of=of)

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
        text, known = self.text(given), self.first_name(given)
        if given.type == "unary_typed_expression":
            return ""
        if "Type" in text or _TYPE.fullmatch(text):
            types.add(known)
            return ""
        return known

    def _type_names(self, node: Node) -> list[str]:
        if node.type == "identifier":
            return [self.text(node)]
        inside = self.children(node)[: 1 if node.type == "binary_expression" else None]
        return [x for part in inside for x in self._type_names(part)]

    # arithmetic

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        if node.type in {"binary_expression", "juxtaposition_expression"} or self._is_signed(node):
            return _ordered(deque(self._tokens(node)))
        return super().expression(node, inside)

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
        return [Token("", node.start_byte, node.end_byte, super().expression(node, inside))]

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

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "float_literal":
                return ir.Literal(self.text(node).lower().replace("f0", "").replace("f", "e"))
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
        places = tuple(
            ir.Range() if self.text(part) == ":" else self.expr(part) for part in self.children(at)
        )
        return ir.Index(self.expr(of), places) if places else ir.Items(())

    def _call(self, inside: list[Node]) -> ir.Expr:
        given = inside[1] if len(inside) > 1 else None
        parts = self.children(given)
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
    """Whether a call changes its arguments, or a statement is not known."""
    match value:
        case ir.Call(ir.Name(name) | ir.Field(name=name)):
            return name.endswith("!")
    return isinstance(value, ir.Opaque)


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


READER = reader(
    JuliaLowering, NAME, "Julia: matrices with //, tableaus, caches of solvers", (".jl",), base=1
)
find = READER.find
