"""Python, also what the Python that runs this cannot parse."""

from __future__ import annotations

from collections.abc import Iterator

import tree_sitter_python
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.lowering import Lowering, kinds, less_one, line_of, reader, sign_of, unmeant

NAME = "python"
_OF_LISTS = {"*": "list *", "+": "list +"}
"""What signs behind a list do."""
_TARGETS = frozenset({"pattern_list", "tuple_pattern", "list_pattern"})
_PROPERTIES = frozenset({"property", "cached_property", "functools.cached_property"})


class PythonLowering(Lowering):
    """Assignments, classes, functions, lists and dictionaries of Python."""

    grammar = Language(tree_sitter_python.language())
    comments = frozenset({"comment", "line_continuation"})
    blocks = frozenset({"module", "block", "with_statement", "try_statement", "else_clause"})
    passed = frozenset({"try_statement", "match_statement"})
    expressions = kinds(
        name="identifier true false",
        number="integer float",
        list="list tuple expression_list",
        nothing="none",
        inside="parenthesized_expression",
        unary="unary_operator",
        binary="binary_operator",
    )

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        field = node.child_by_field_name
        match node.type:
            case "expression_statement":
                for part in inside:
                    if part.type in {"assignment", "augmented_assignment"}:
                        yield from self._assignment(part)
                    else:
                        yield self._done(self.expr(part), line)
            case "function_definition":
                yield self._function(node)
            case "decorated_definition":
                yield from self._decorated(inside)
            case "class_definition":
                bases = tuple(self.text(x) for x in self.children(field("superclasses")))
                inner = self.children(field("body"))
                methods = {self.text(x.child_by_field_name("name")) for x in inner}
                parts = [y for x in inner for y in self.children(x)]
                typed = [x for x in parts if x.child_by_field_name("type") is not None]
                least = sum(x.child_by_field_name("right") is None for x in typed)
                if "__init__" not in methods:
                    self.declares(self.text(field("name")), map(self.first_name, typed), least)
                made = self.block([field("body")])
                yield ir.Scope("class", self.text(field("name")), made, line, bases=bases)
            case "for_statement":
                target = field("left")
                is_name = target is not None and target.type == "identifier"
                name = self.text(target) if is_name else ""
                yield self.loop(node, name, self.expr(field("right")))
            case "import_statement" | "import_from_statement":
                for part in inside:
                    # from fractions import Fraction as F
                    alias = part.child_by_field_name("alias")
                    if alias is not None:
                        name = self.text(part.child_by_field_name("name")).rpartition(".")[2]
                        yield ir.Assign(ir.Name(self.text(alias)), ir.Name(name), line)

    def _done(self, value: ir.Expr, line: int) -> ir.Statement:
        match value:
            case ir.Call(ir.Field(of, "register_buffer"), (ir.Text(name), given, *_)):
                return ir.Assign(ir.Field(of, name), given, line)
        return ir.Do(value, line)

    def _assignment(self, node: Node) -> Iterator[ir.Statement]:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        if left is None or right is None:
            return
        while right is not None and right.type == "assignment":
            # a = b = []
            yield from self._assignment(right)
            right = right.child_by_field_name("left")
        sign = self.text(node.child_by_field_name("operator")).rstrip("=")
        is_taken_apart = left.type in _TARGETS
        target = ir.Items(self.exprs(left.named_children)) if is_taken_apart else self.expr(left)
        yield ir.Assign(target, self.expr(right), line_of(node), sign_of(sign))

    def _decorated(self, inside: list[Node]) -> Iterator[ir.Statement]:
        """A property is the value that it returns."""
        made = self.block(inside[-1:])
        is_property = any(self.text(x)[1:] in _PROPERTIES for x in inside[:-1])
        match made:
            case (ir.Scope("function", name, (*before, ir.Return(value, line))),) if is_property:
                if all(isinstance(x, ir.Do) for x in before):
                    made = (ir.Assign(ir.Name(name), value, line),)
        yield from made

    def _function(self, node: Node) -> ir.Scope:
        field = node.child_by_field_name
        given = map(self.first_name, self.children(field("parameters")))
        body = field("body")
        made = self.block([body]) if body is not None and self.may_hold_a_table(body) else ()
        parameters = tuple(filter(None, given))
        types = frozenset({"dtype"})
        return ir.Scope(
            "function", self.text(field("name")), made, line_of(node), parameters, types
        )

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        field = node.child_by_field_name
        match node.type:
            case "attribute":
                name, of = self.text(field("attribute")), self.expr(field("object"))
                return ir.Transposed(of) if name == "T" else ir.Field(of, name)
            case "list_comprehension" if len(inside) == 2 and inside[1].type == "for_in_clause":
                each_one = inside[1].child_by_field_name("left")
                if each_one is not None and each_one.type == "identifier":
                    each = ir.Lambda((self.text(each_one),), self.expr(inside[0]))
                    over = self.expr(inside[1].child_by_field_name("right"))
                    return ir.Call(ir.Name("list of each"), (each, over))
            case "dictionary":
                return ir.Fields(tuple(self._pairs(inside)))
            case "call":
                callee, given = self.expr(field("function")), self.children(field("arguments"))
                args, named = self.arguments(given)
                is_dict = callee == ir.Name("dict") and not args
                return ir.Fields(named) if is_dict else self.call(callee, args, named)
            case "subscript":
                at = tuple(self._place(x) for x in node.children_by_field_name("subscript"))
                return ir.Index(self.expr(field("value")), at)
            case "string":
                return ir.Text("".join(self.text(x) for x in inside if x.type == "string_content"))
        return unmeant(node)

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        match found := super().expression(node, inside):
            case ir.Binary(sign, ir.Items() as left, right) if sign in _OF_LISTS:
                return ir.Call(ir.Name(_OF_LISTS[sign]), (left, right))
        return found

    def _pairs(self, inside: list[Node]) -> Iterator[tuple[str, ir.Expr]]:
        for part in inside:
            key = part.child_by_field_name("key")
            if part.type == "pair" and key is not None and key.type in {"string", "integer"}:
                name = self.expr(key)
                text = name.text if isinstance(name, ir.Text | ir.Literal) else ""
                yield text, self.expr(part.child_by_field_name("value"))

    def _place(self, node: Node) -> ir.Expr:
        """An index, or a slice: its end is not in it."""
        if node.type != "slice":
            return self.expr(node)
        ends = self.ends(node)
        if len(ends) > 2 and ends[2] is not None:
            return ir.Opaque("a slice with steps")
        last = None if ends[1] is None else less_one(ends[1])
        return ir.Range(ends[0], last)


READER = reader(
    PythonLowering,
    NAME,
    "Python: NumPy arrays, lists, Fractions, scipy's RungeKutta",
    (".py", ".pyi"),
    base=0,
)
find = READER.find
