"""Python, including versions that the running one cannot parse."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.elementwise import ITEM
from garkcli.sources.found import FoundTable
from garkcli.sources.known import CALLS, CONVERSIONS
from garkcli.sources.lowering import Lowering, kinds, less_one, line_of, part, reader, unmeant

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "python"
_OF_LISTS = {"*": "list *", "+": "list +"}
"""The functions of operators after a list."""
_PROPERTIES = frozenset({"property", "cached_property", "functools.cached_property"})


_NOT_ZERO = re.compile(r"\s*!=\s*0(?:\.0*)?$")
_FACTOR = re.compile(r"[\w.]+(?:\[[^\[\]]*\])*")


class PythonLowering(Lowering):
    """Assignments, classes, functions, lists and dictionaries of Python."""

    grammar = "tree_sitter_python"
    first = 0
    kinds = kinds(
        comment="line_continuation",
        block="module block with_statement else_clause",
        tried="try_statement",
        passed="match_statement",
        assignment="assignment augmented_assignment",
        name="identifier true false",
        number="integer float",
        list="list tuple expression_list pattern_list tuple_pattern list_pattern",
        nothing="none",
        inside="parenthesized_expression",
        unary="unary_operator",
        binary="binary_operator",
        index="subscript",
        call="call",
        either="conditional_expression",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "function_definition":
                yield self._function(node)
            case "decorated_definition":
                yield from self._decorated(inside)
            case "class_definition":
                name, body = self.text(part(node, "name")), part(node, "body")
                bases = tuple(map(self.text, self.children(part(node, "superclasses"))))
                inner = self.children(body)
                if "__init__" not in {self.text(part(x, "name")) for x in inner}:
                    typed = [y for x in inner for y in self.children(x) if part(y, "type")]
                    least = sum(part(x, "right") is None for x in typed)
                    self.declares(name, map(self.first_name, typed), least)
                yield ir.Scope("class", name, self.block([body]), line, bases=bases)
            case "for_statement":
                target, over = part(node, "left"), self.expr(part(node, "right"))
                loop = self.loop(node, self.text(target) if self.is_a("name", target) else "", over)
                if target is not None and self.is_a("list", target):
                    first = ir.Assign(self.expr(target), ir.Name(ITEM), line)
                    loop = replace(loop, name=ITEM, body=(first, *loop.body))
                yield loop
            case "import_statement" | "import_from_statement":
                for each in inside:
                    # from fractions import Fraction as F
                    if alias := part(each, "alias"):
                        name = self.text(part(each, "name")).rpartition(".")[2]
                        yield ir.Assign(ir.Name(self.text(alias)), _imported(name), line)
            case "expression_statement":
                for each in inside:
                    if self.is_a("assignment", each):
                        yield from self.block([each])
                    else:
                        yield self._done(self.expr(each), line)

    def _done(self, value: ir.Expr, line: int) -> ir.Statement:
        match value:
            case ir.Call(ir.Field(of, "register_buffer"), (ir.Text(name), given, *_)):
                return ir.Assign(ir.Field(of, name), given, line)
        return ir.Do(value, line)

    def _decorated(self, inside: list[Node]) -> Iterator[ir.Statement]:
        """A decorated definition; a property is the value that it returns."""
        made = self.block(inside[-1:])
        is_property = any(self.text(x)[1:] in _PROPERTIES for x in inside[:-1])
        match made:
            case (ir.Scope("function", name, (*before, ir.Return(value, line))),) if is_property:
                if all(isinstance(x, ir.Do) for x in before):
                    made = (ir.Assign(ir.Name(name), value, line),)
        yield from made

    def _function(self, node: Node) -> ir.Scope:
        name, body = self.text(part(node, "name")), part(node, "body")
        given = map(self.first_name, self.children(part(node, "parameters")))
        made = self.block([body]) if body and self.may_hold_a_table(node) else ()
        parameters, types = tuple(filter(None, given)), frozenset({"dtype"})
        gives = name if not {*parameters} - {"self", "cls"} and name[0] != "_" else ""
        return ir.Scope("function", name, made, line_of(node), parameters, types, gives=gives)

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "attribute":
                name, of = self.text(part(node, "attribute")), self.expr(part(node, "object"))
                return ir.Transposed(of) if name == "T" else ir.Field(of, name)
            case "list_comprehension" | "generator_expression" if len(inside) == 2 or (
                len(inside) == 3 and self._is_of_zeros(inside)
            ):
                target, over = part(inside[1], "left"), self.expr(part(inside[1], "right"))
                names = [target] if self.is_a("name", target) else self.children(target)
                if names and all(self.is_a("name", x) for x in names):
                    each = ir.Lambda(tuple(map(self.text, names)), self.expr(inside[0]))
                    return ir.Call(ir.Name("list of each"), (each, over))
            case "lambda":
                given = self.children(part(node, "parameters"))
                parameters = tuple(map(self.first_name, given))
                return ir.Lambda(parameters, self.expr(part(node, "body")))
            case "dictionary":
                pairs = tuple(self._pairs(inside))
                if pairs and [x for x, _ in pairs] == [*map(str, range(len(inside)))]:
                    # rows by their numbers
                    return ir.Items(tuple(x for _, x in pairs))
                return ir.Fields(pairs)
            case "slice":
                first, last, *step = [*self.ends(node), None][:3]
                if any(step):
                    return ir.Opaque("a slice with steps")
                return ir.Range(first, None if last is None else less_one(last))
            case "string":
                return ir.Text("".join(self.text(x) for x in inside if x.type == "string_content"))
        return unmeant(node)

    def _is_of_zeros(self, inside: list[Node]) -> bool:
        """Whether a comprehension leaves out only products with zero, ``a*k for … if a != 0``, so
        that the sum is that of all.
        """
        element, condition = self.text(inside[0]), self.text(inside[2]).removeprefix("if ")
        factor = _NOT_ZERO.sub("", condition)
        call = inside[0].parent
        while call is not None and call.type != "call":
            call = call.parent
        is_sum = self.text(part(call, "function")).rpartition(".")[2] == "sum"
        factors = re.split(r"\s*\*\s*", element)
        return is_sum and factor in factors and all(map(_FACTOR.fullmatch, factors))

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        if node.type == "call" and inside[-1].type == "generator_expression":
            # list(x for x in …)
            return ir.Call(self.expr(inside[0]), self.exprs(inside[1:]))
        match lowered := super().expression(node, inside):
            case ir.Binary(sign, ir.Items() as left, right) if sign in _OF_LISTS:
                return ir.Call(ir.Name(_OF_LISTS[sign]), (left, right))
            case ir.Call(ir.Name("dict"), (), named):
                return ir.Fields(named)
            case ir.Call(ir.Name("field") | ir.Field(name="field"), (), named):
                # of a dataclass
                for name, value in named:
                    if name == "default":
                        return value
                    if name == "default_factory" and isinstance(value, ir.Lambda):
                        return value.body
            case ir.Index(ir.Field(name="r_"), at):
                return ir.Items(at)
        return lowered

    def _pairs(self, inside: list[Node]) -> Iterator[tuple[str, ir.Expr]]:
        for each in inside:
            match self.expr(part(each, "key")):
                case ir.Text(key) | ir.Literal(key):
                    yield key, self.expr(part(each, "value"))


def _imported(name: str) -> ir.Expr:
    """The expression of an imported name: a function of one argument, or the name itself."""
    if name in CALLS and name not in CONVERSIONS:
        return ir.Lambda(("x",), ir.Call(ir.Name(name), (ir.Name("x"),)))
    return ir.Name(name)


_TYPED = re.compile(r"^([ \t]*)(?:c|cp)def[ \t]+(.*)$|^([ \t]*)DEF[ \t]+(?=\w)", re.MULTILINE)
"""Declarations of Cython: a class, a function, a name with its value."""
_WORD = re.compile(r"\w+")
_ARRAY = re.compile(r"(\w+)[ \t]*((?:\[\w+\])+)[ \t]*$")


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Python source, or of Cython without its types."""
    return _READER.find(_TYPED.sub(_plain, text) if source.endswith(_CYTHON) else text, source)


def _plain(found: re.Match[str]) -> str:
    """A line of Cython in Python; ``pass`` for a name without a value."""
    indent, rest = found[1] or found[3] or "", found[2]
    if rest is None or rest.startswith("class"):
        return indent + (rest or "")
    head, equals, value = rest.partition("=")
    before, bracket, _ = rest.partition("(")
    if bracket and len(before) < len(head):
        name = (_WORD.findall(before) or ["_"])[-1]
        return f"{indent}def {name}():" if rest.rstrip().endswith(":") else f"{indent}pass"
    array = _ARRAY.search(head)
    name = array[1] if array else (_WORD.findall(head) or ["_"])[-1]
    if array and not equals:
        sizes = ", ".join(_WORD.findall(array[2]))
        return f"{indent}{name} = zeros({sizes})"
    return f"{indent}{name} = {value}" if equals else f"{indent}pass"


_CYTHON = (".pyx", ".pxd", ".pxi")
_READER = reader(
    PythonLowering,
    NAME,
    "Python: NumPy arrays, lists, Fractions, scipy's RungeKutta",
    (".py", ".pyi", *_CYTHON),
    base=0,
)
READER = replace(_READER, find=find)
