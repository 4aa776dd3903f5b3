"""The common part of lowering syntax trees: each language declares the kinds of its nodes."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from importlib import import_module
from itertools import islice
from typing import TYPE_CHECKING, ClassVar

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.known import SAME
from garkcli.sources.naming import ROLES, speaks
from garkcli.sources.reading import tables_in
from garkcli.sources.signatures import SIGNATURES, other_kind
from garkcli.sources.step_words import operation_of

if TYPE_CHECKING:
    from tree_sitter import Language, Node

_NUMBER = re.compile(r"(?<![\w.])[0-9]+(?:\.[0-9]*)?")
INCLUDED = ".inc"
"""The ending of include files in several languages."""
FEWEST_NUMBERS = 5
A_PART = 400
"""Length below which any function may be part of a step."""
MOST_OF_A_STEP = 4_000
"""Length above which a function without numbers like those of a table is no step."""
_CALL = re.compile(r"(?P<name>[^\W\d]\w{0,40})\(")
_WITH_SUM = re.compile(_CALL.pattern + r"[^()]{0,200}[-+*]")
"""A call, and one with an operation in its arguments."""
_MULTIPLE_ADDED = re.compile(
    r"[\w\])]\s{0,3}\+\s{0,3}[a-zA-Z][\w.>\[\]-]{0,40}\s{0,3}\*\s{0,3}[a-zA-Z]"
)
"""The sum of a value and a product of names."""
HEAD = 100
"""Characters at the beginning of a function that may name it."""
_WORDS = re.compile(
    r"tableau|butcher|register|[abc]coefficients|\*this\)\[|(?<![A-Za-z])[^\W\d_]{1,2}_?[0-9]+(?:_?[0-9]+)?\s*(?:=|,|\))"
    r"|(?<![A-Za-z])(?:[a-z]{0,3}_)?(?:A|a|b|B|c|C|amat|rka|α|β|γ|alpha|beta|weights|nodes)\w?\w?"
    r"(?:_\w+)?\s*(?::\s*[\w.]+(?:\[[\w., ]*\])?\s*=|\[|\(|=|\{|\.=)",
    re.IGNORECASE,
)
MAX_NESTING = 60
"""Deepest nesting that is lowered."""
_KINDS = {
    "comment": "comment",
    "if_statement": "branch",
    "while_statement": "loop",
    "return_statement": "giving",
}
"""Kinds of nodes in all grammars."""
_SIGNS = {"**": "^", "//": "÷"}
TOO_DEEP = ir.Opaque("an expression that is nested too deep")


class Lowering(ABC):
    """From a syntax tree to statements.

    Args:
        text: the source.
        grammar: the module of its grammar; None for that of the class.

    Attributes:
        grammar: the module with the grammar of the language.
        kinds: the kinds of its nodes, see ``kinds``.
    """

    grammar: ClassVar[str]
    kinds: ClassVar[Mapping[str, str]]
    first: ClassVar[int] = 1
    """The place of the first value in a conditional expression; the condition is before it."""

    def __init__(self, text: str, grammar: str | None = None) -> None:
        self._data = text.encode(errors="replace")
        self._grammar = grammar or self.grammar
        self._depth = 0
        self._speaks = speaks(text)
        self._fields: dict[str, tuple[tuple[str, ...], int]] = {}

    def module(self) -> ir.Body:
        """The statements of the whole source."""
        nodes = self.parse(self._data).named_children
        waiting = list(nodes)
        while waiting:
            node = waiting.pop()
            if self.is_a("record", node):
                self.declared(node)
                waiting += self.children(part(node, "body"))
        return self.block(nodes)

    def declared(self, node: Node) -> None:  # noqa: B027 -- few languages need it
        """Remembers the fields of a record, which may be used before its declaration."""

    def parse(self, data: bytes) -> Node:
        """The syntax tree; text of other languages is in its own nodes."""
        from tree_sitter import Parser

        return Parser(_language(self._grammar)).parse(data).root_node

    def text(self, node: Node | None) -> str:
        """The text of a node in the source."""
        if node is None:
            return ""
        return self._data[node.start_byte : node.end_byte].decode(errors="replace")

    def name(self, node: Node | None) -> str:
        """The name in a node."""
        return self.text(node)

    def first_name(self, node: Node | None) -> str:
        """The first name in a node, at any depth; empty if there is none."""
        while node is not None and node.type != "identifier":
            node = next(iter(self.children(node)), None)
        return self.name(node)

    def is_a(self, kind: str, node: Node | None) -> bool:
        return node is not None and self.kinds.get(node.type) == kind

    def children(self, node: Node | None) -> list[Node]:
        """The children of a node without comments."""
        if node is None:
            return []
        return [x for x in node.named_children if not self.is_a("comment", x)]

    def block(self, nodes: Iterable[Node | None]) -> ir.Body:
        """Statements one after the other."""
        lowered: list[ir.Statement] = []
        for node in nodes:
            if node is None or self.is_a("comment", node) or self._depth >= MAX_NESTING:
                continue
            self._depth += 1
            try:
                lowered += map(_branched, map(_assigned, self.statement(node)))
            finally:
                self._depth -= 1
        return tuple(lowered)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        """The lowered form of a statement."""
        inside, line = self.children(node), line_of(node)
        match self.kinds.get(node.type):
            case "block":
                yield from self.block(inside)
            case "passed":
                yield ir.Do(unmeant(node), line)
            case "tried":
                first, *others = inside or [node]
                yield from self.block(self.children(first))
                if any(map(self.children, others)):
                    yield ir.Branch(tuple(self.block(self.children(x)) for x in others), line)
            case "loop":
                yield self.loop(node)
            case "giving":
                yield ir.Return(self.returned(inside[0] if inside else None), line)
            case "branch":
                yield self.branch(inside, line)
            case "switch":
                cases = self.children(part(node, "body") or node)
                arms = (self.case(x) for x in cases if self.is_a("case", x))
                yield ir.Branch(tuple(arm for arm in arms if arm[0].body), line)
            case "assignment":
                yield from self.assignment(node, part(node, "left"), part(node, "right"))
            case _:
                yield from self.own(node, inside, line)

    def returned(self, node: Node | None) -> ir.Expr:
        """The value of a function."""
        return self.expr(node)

    @abstractmethod
    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        """The lowered form of a statement that only this language has."""

    def assignment(
        self, node: Node, left: Node | None, right: Node | None, sign: str | None = None
    ) -> Iterator[ir.Statement]:
        """An assignment; ``a = b = 0`` gives two statements."""
        if sign is None:
            sign = sign_of(self.text(part(node, "operator")).rstrip("="))
        if right is not None and self.is_a("assignment", right):
            yield from self.block([right])
            right = self.children(right)[0]
        if left is not None and right is not None:
            yield ir.Assign(self.target(left), self.expr(right), line_of(node), sign)

    def target(self, node: Node) -> ir.Expr:
        """The target of an assignment; ``A(2, 1)`` is an entry."""
        match lowered := self.expr(node):
            case ir.Call(of, args) if args:
                return ir.Index(of, args)
        return lowered

    def conditional(self, node: Node) -> Iterator[ir.Statement]:
        """The branches of ``#if``; without ``#else`` its only one, and of ``#if 0`` the other
        one.
        """
        other = part(node, "alternative")
        condition = part(node, "condition") or part(node, "name")
        first = self.block(x for x in node.named_children if x not in (other, condition))
        second = self.block([other])
        is_off = self.text(condition) == "0"
        made = [x for x in ir.statements((*first, *second)) if not isinstance(x, ir.Branch)]
        if other is None or is_off or (first and second and all(map(_is_macro, made))):
            # a macro in several branches: the last one is the plain one
            yield from second if other or is_off else first
        else:
            yield ir.Branch((first, second), line_of(node), is_total=True)

    def loop(self, node: Node, name: str = "", over: ir.Expr | None = None) -> ir.Loop:
        """A loop with the body behind its head."""
        body = part(node, "body")
        inside = self.children(node)[1:] if body is None else [body]
        return ir.Loop(name, over or ir.Nothing(), self.block(inside), line_of(node))

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One case of a switch, with the value that selects it."""
        value = part(node, "value") or part(node, "condition")
        value = value or next((x for x in node.named_children if self.is_a("label", x)), None)
        body = self.block(x for x in node.named_children if x != value)
        title = self.title(value)
        title = f"case {title}" if title.isdigit() else title
        return (ir.Scope("entry", title, body, line_of(node)),)

    def title(self, node: Node | None) -> str:
        """The title of a case by its value."""
        return self.text(node).strip("'\"")

    def branch(self, inside: list[Node], line: int) -> ir.Branch:
        """The arms of an ``if``; the first child of each is its condition, except for ``else``."""
        ways: list[list[Node]] = [[]]
        is_total = False
        for each in inside:
            if each.type in {"elseif_clause", "elif_clause", "else_clause"}:
                ways.append(self.children(each))
                is_total = each.type == "else_clause"
            else:
                ways[-1].append(each)
        last = self.way([], ways.pop()) if is_total else None
        arms = [self.way(way[:1], way[1:]) for way in ways]
        return ir.Branch((*arms, *([] if last is None else [last])), line, is_total)

    def way(self, condition: list[Node], inside: list[Node]) -> ir.Body:
        """One arm of an ``if``."""
        del condition
        return self.block(inside)

    def may_hold_a_table(self, node: Node) -> bool:
        """Whether the text of a function has numbers and names like those of a table; a short one
        may be part of a step.
        """
        text = self.text(node)
        if len(text) < A_PART:
            return True
        is_likely = self._speaks or speaks(text[:HEAD])
        numbers = _NUMBER.finditer(text)
        fewest = 1 if is_likely else FEWEST_NUMBERS
        has_numbers = next(islice(numbers, fewest - 1, None), None) is not None
        return (has_numbers and (is_likely or bool(_WORDS.search(text)))) or _calls_again(text)

    def expr(self, node: Node | None) -> ir.Expr:
        """The lowered form of an expression; Opaque if it is nested too deep."""
        if node is None:
            return ir.Nothing()
        if self._depth >= MAX_NESTING:
            return TOO_DEEP
        self._depth += 1
        try:
            return self.expression(node, self.children(node))
        finally:
            self._depth -= 1

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        """The lowered form of an expression without the check of its depth."""
        match self.kinds.get(node.type):
            case "name":
                return ir.Name(self.name(node))
            case "number":
                return self.number(self.text(node))
            case "nothing":
                return ir.Nothing()
            case "text":
                return ir.Text(self.text(node).strip("'\""))
            case "inside" if inside:
                return self.expr(inside[0])
            case "list":
                return ir.Items(self.exprs(inside))
            case "unary" if inside:
                return ir.Unary(self.text(node.children[0]), self.expr(inside[-1]))
            case "binary":
                operator = part(node, "operator")
                sign = self.text(operator or next(x for x in node.children if not x.is_named))
                return ir.Binary(sign_of(sign), self.expr(inside[0]), self.expr(inside[-1]))
            case "field" if len(inside) > 1:
                return ir.Field(self.expr(inside[0]), self.name(inside[-1]))
            case "index" if inside:
                return ir.Index(self.expr(inside[0]), self.exprs(inside[1:]))
            case "call" if inside:
                return self.call(self.expr(inside[0]), *self.arguments(self.children(inside[-1])))
            case "range" if len(inside) == 2:
                return ir.Range(*self.exprs(inside))
            case "transposed" if inside:
                return ir.Transposed(self.expr(inside[0]))
            case "either" if len(inside) == 3:
                values = self.exprs(inside)
                return ir.Either((values[self.first], values[2]))
        return self.other(node, inside)

    def declares(self, record: str, names: Iterable[str], least: int | None = None) -> None:
        """Declares the fields of a record, in order, at least ``least`` of them given, by default
        all. Fields of a method are remembered unless calls of that name are known; ``Tableau`` is a
        name of many records.
        """
        fields = tuple(names)
        is_known = (record in SIGNATURES and record != "Tableau") or bool(other_kind(record))
        if {"A", "b"} <= {ROLES.get(x) for x in fields if x.isascii()} and not is_known:
            self._fields[record] = fields, len(fields) if least is None else least

    def made(self, record: str, args: tuple[ir.Expr, ...]) -> tuple[tuple[str, ir.Expr], ...]:
        """The fields of a record made by a call in this source; empty for other calls."""
        fields, least = self._fields.get(record, ((), 0))
        return tuple(zip(fields, args, strict=False)) if least <= len(args) <= len(fields) else ()

    def call(
        self,
        callee: ir.Expr,
        args: tuple[ir.Expr, ...],
        named: tuple[tuple[str, ir.Expr], ...] = (),
    ) -> ir.Call:
        """A call, or a record made from its fields in order."""
        fields = self.made(callee.name, args) if isinstance(callee, ir.Name) else ()
        return ir.Call(callee, () if fields else args, named or fields)

    def number(self, text: str) -> ir.Expr:
        """A number; digits alone are an integer."""
        return ir.Literal(text, is_whole=text.replace("_", "").isdigit())

    @abstractmethod
    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        """The lowered form of an expression that only this language has."""

    def ends(self, node: Node) -> list[ir.Expr | None]:
        """The ends between the colons of a slice."""
        ends: list[ir.Expr | None] = [None]
        for each in node.children:
            if each.type == ":":
                ends.append(None)
            elif each.is_named:
                ends[-1] = self.expr(each)
        return ends

    def exprs(self, nodes: Iterable[Node]) -> tuple[ir.Expr, ...]:
        """Several expressions, without comments."""
        return tuple(self.expr(x) for x in nodes if not self.is_a("comment", x))

    def arguments(
        self, nodes: Iterable[Node]
    ) -> tuple[tuple[ir.Expr, ...], tuple[tuple[str, ir.Expr], ...]]:
        """The positional and the named arguments of a call."""
        args, named = [], []
        for each in nodes:
            if each.type in {"keyword_argument", "named_argument"}:
                key, *_, value = self.children(each)
                named.append((self.name(key), self.expr(value)))
            else:
                args.append(self.expr(each))
        return tuple(args), tuple(named)


def _calls_again(text: str) -> bool:
    """Whether a short function may add multiples of the values of a function: it has such a sum,
    or calls a function several times, with sums or products.
    """
    if len(text) > MOST_OF_A_STEP:
        return False
    if _MULTIPLE_ADDED.search(text):
        return True
    counts = Counter(match["name"] for match in _CALL.finditer(text))
    return any(counts[name] > 1 for name in {x["name"] for x in _WITH_SUM.finditer(text)})


@lru_cache
def _language(grammar: str) -> Language:
    """The language of a grammar, imported on use since it may not be installed.

    Args:
        grammar: its module, with the name of its function unless that is ``language``.
    """
    from tree_sitter import Language

    module, _, function = grammar.partition(".")
    return Language(getattr(import_module(module), function or "language")())


def kinds(**nodes: str) -> Mapping[str, str]:
    """The kind of each node of a grammar, from lists of nodes for each kind.

    Statements are a ``block``, ``assignment``, ``loop`` without name and range, ``giving`` for
    returns, ``branch``, ``switch`` with ``case`` and, unless it is a field, its ``label``,
    ``record`` for declarations of records, ``passed`` for statements that change values in unknown
    ways, and ``tried`` for a block with handlers of its errors. Expressions are a ``name``,
    ``number``, ``nothing``, ``text``, ``list``, ``unary``, ``binary``, ``field``, ``index``,
    ``call``, ``range``, ``transposed``, ``either`` of two values, or ``inside`` of brackets.
    """
    return _KINDS | {node: kind for kind, text in nodes.items() for node in text.split()}


def part(node: Node | None, *fields: str) -> Node | None:
    """The descendant of a node along field names; None if it is missing."""
    for field in fields:
        node = None if node is None else node.child_by_field_name(field)
    return node


def sign_of(sign: str) -> str:
    """The common form of an operator of any language."""
    plain = sign.lstrip(".")
    return _SIGNS.get(plain, plain)


def line_of(node: Node) -> int:
    return int(node.start_point[0]) + 1


def less_one(expr: ir.Expr) -> ir.Expr:
    """An expression minus one: the last index before an excluded end."""
    return ir.Binary("-", expr, ir.Literal("1", is_whole=True))


def counted(
    lowering: Lowering, name: str, first: Node | None, condition: Node | None, update: str
) -> tuple[str, ir.Expr]:
    """The counter of ``for (i = a; i < b; i++)`` and its range; an empty name for other loops."""
    sign = lowering.text(part(condition, "operator"))
    by_one = rf"\+\+\s*{name}\b|\b{name}\s*(?:\+\+|\+=\s*1(?![\w.]))"
    is_counted = first and name.isidentifier() and sign in {"<", "<=", "!="}
    if not (is_counted and re.search(by_one, update)):
        return "", ir.Opaque("a loop")
    last = lowering.expr(part(condition, "right"))
    return name, ir.Range(lowering.expr(first), last if sign == "<=" else less_one(last))


_OPERATIONS = (
    dict.fromkeys(("add", "plus"), "+")
    | dict.fromkeys(("subtract", "sub", "minus"), "-")
    | dict.fromkeys(("multiply", "mul", "times"), "*")
    | dict.fromkeys(("divide", "div"), "/")
    | dict.fromkeys(("pow", "powi"), "^")
)
"""Methods of numbers that are operations with another number."""
_CHANGING = re.compile(
    r"(add|plus|sub|subtract|minus|mul|multiply|times|scale|div|divide)"
    r"(?:_?(?:assign|self|scalar|equals?|in_?place))+",
    re.IGNORECASE,
)
"""Methods of vectors that are operations and change their object: ``add_assign``."""
ADD_MULTIPLE = "addScaledVector"
"""``y.addScaledVector(k, h)`` is y += h k in three.js."""
_UNITS = {"getZero": "0.0", "getOne": "1.0"}
_OF_IT = {"recip": "inv", "reciprocal": "inv", "Select": "map"} | {
    x: x for x in ("sqrt", "cbrt", "cos", "sin", "len", "map", "transpose", "sum")
}
"""Methods that are functions of the number or the list."""


def with_counter(of: ir.Expr, name: str, args: tuple[ir.Expr, ...]) -> ir.Expr | None:
    """``x.map((y, i) => …)``, whose function is given the counter behind the entry; ``x.Zip(z, (y,
    w) => …)``; None for other methods.
    """
    match args:
        case (ir.Lambda((entry, counter, *_), body),) if _OF_IT.get(name) == "map":
            each = ir.Lambda((counter, entry), body)
            return ir.Call(ir.Name("map"), (each, ir.Call(ir.Field(of, "enumerate"), ())))
        case (other, ir.Lambda() as each) if name == "Zip":
            return ir.Call(ir.Name("map"), (each, of, other))
    return None


def method_called(of: ir.Expr, name: str, args: tuple[ir.Expr, ...]) -> ir.Expr | None:
    """The operation for a method of a number or list; None for other methods."""
    if name in _OPERATIONS and len(args) == 1:
        return ir.Binary(_OPERATIONS[name], of, args[0])
    if name == ADD_MULTIPLE and len(args) == 2:
        return ir.Binary("+", of, ir.Binary("*", args[1], args[0]))
    if name in {"neg", "negate"} and not args:
        return ir.Unary("-", of)
    if name in _UNITS and not args:
        return ir.Literal(_UNITS[name])
    if name in SAME and len(args) < 2:
        return of
    if name == "newInstance" and args:
        return ir.Call(ir.Name("double"), args[:1])
    if name in _OF_IT:
        return ir.Call(ir.Name(_OF_IT[name]), (*args, of) if name == "map" else (of, *args))
    return None


def is_in_c(text: str) -> bool:
    """Whether an include file is C, and not Fortran."""
    return ";" in text and "{" in text


def _branched(statement: ir.Statement) -> ir.Statement:
    """A statement; if it assigns either the value of a call or another value, a branch of both."""
    match statement:
        case ir.Assign(value=ir.Either(values), line=line):
            if sum(isinstance(x, ir.Call) for x in values) == 1:
                arms = tuple((replace(statement, value=x),) for x in values)
                return ir.Branch(arms, line, is_total=True)
    return statement


def _assigned(statement: ir.Statement) -> ir.Statement:
    """A statement; ``y += x`` for a method that changes its object."""
    match statement:
        case ir.Do(ir.Call(ir.Field(of, name), (value,), ()), line):
            if (found := _CHANGING.fullmatch(name)) and (sign := operation_of(found[1].lower())):
                return ir.Assign(of, value, line, sign)
    return statement


def done(made: ir.Expr, line: int) -> ir.Statement:
    """A call for its effect; an operation on a vector changes it: ``y.add(k.mul(h))``."""
    match made:
        case ir.Binary(sign, of, value) if _is_changed(of):
            return ir.Assign(of, value, line, sign)
    return ir.Do(made, line)


def _is_changed(of: ir.Expr) -> bool:
    return isinstance(of, ir.Name) or (isinstance(of, ir.Field) and _is_changed(of.of))


def _is_macro(made: ir.Statement) -> bool:
    return isinstance(made, ir.Assign) and isinstance(made.value, ir.Lambda | ir.Name | ir.Literal)


def unmeant(node: Node) -> ir.Opaque:
    """The Opaque expression for a node that does not affect constants."""
    return ir.Opaque(node.type.replace("_", " "))


def reader(
    lowering: type[Lowering],
    name: str,
    summary: str,
    suffixes: tuple[str, ...],
    base: int,
    is_growing: bool = False,
    has_whole_quotients: bool = False,
) -> Reader:
    """The reader of a language; see ``tables_in``."""

    def find(text: str, source: str) -> list[FoundTable]:
        def lowered(text: str) -> ir.Body:
            return lowering(text).module()

        return tables_in(text, source, name, lowered, base, is_growing, has_whole_quotients)

    return Reader(name, summary, suffixes, find, (lowering.grammar.partition(".")[0],))
