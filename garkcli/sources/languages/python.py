"""Python, also what the Python that runs this cannot parse."""

from __future__ import annotations

from collections.abc import Iterator

import tree_sitter_python
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import Lowering, less_one, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "python"
PYTHON = Language(tree_sitter_python.language())
_BLOCKS = frozenset(
    {"module", "block", "with_statement", "try_statement", "else_clause", "decorated_definition"}
)
_OF_LISTS = {"*": "list *", "+": "list +"}
"""What signs behind a list do."""
_SIGNS = {"**": "^", "//": "÷"}


class PythonLowering(Lowering):
    """Assignments, classes, functions, lists and dictionaries of Python."""

    comments = frozenset({"comment", "line_continuation"})

    def __init__(self, text: str) -> None:
        super().__init__(text, PYTHON)

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        line = line_of(node)
        field = node.child_by_field_name
        match node.type:
            case "expression_statement":
                for part in self.children(node):
                    if part.type in {"assignment", "augmented_assignment"}:
                        yield from self._assignment(part)
                    else:
                        yield ir.Do(self.expr(part), line)
            case "function_definition":
                yield self._function(node)
            case "class_definition":
                bases = self.children(field("superclasses"))
                inside = self.block([field("body")])
                names = tuple(self.text(x) for x in bases)
                yield ir.Scope("class", self.text(field("name")), inside, line, bases=names)
            case "return_statement":
                given = self.children(node)
                yield ir.Return(self.expr(given[0] if given else None), line)
            case "if_statement":
                yield self._if(node)
            case "for_statement":
                target = field("left")
                is_name = target is not None and target.type == "identifier"
                name = self.text(target) if is_name else ""
                yield ir.Loop(name, self.expr(field("right")), self.block([field("body")]), line)
            case "while_statement":
                yield ir.Loop("", ir.Nothing(), self.block([field("body")]), line)
            case "import_statement" | "import_from_statement":
                yield from self._imported(node)
            case "match_statement":
                yield self.passed_over(node)
            case kind if kind in _BLOCKS:
                if kind == "try_statement":
                    yield self.passed_over(node)
                yield from self.block(self.children(node))

    def _imported(self, node: Node) -> Iterator[ir.Statement]:
        """``from fractions import Fraction as F``."""
        for part in self.children(node):
            alias = part.child_by_field_name("alias")
            if alias is not None:
                name = self.text(part.child_by_field_name("name")).rpartition(".")[2]
                yield ir.Assign(ir.Name(self.text(alias)), ir.Name(name), line_of(node))

    def _assignment(self, node: Node) -> Iterator[ir.Statement]:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        if left is None or right is None:
            return
        while right is not None and right.type == "assignment":
            # a = b = []
            yield from self._assignment(right)
            right = right.child_by_field_name("left")
        sign = self.text(node.child_by_field_name("operator")).rstrip("=")
        yield ir.Assign(self._target(left), self.expr(right), line_of(node), _SIGNS.get(sign, sign))

    def _target(self, node: Node) -> ir.Expr:
        if node.type in {"pattern_list", "tuple_pattern", "list_pattern"}:
            return ir.Items(self.exprs(node.named_children))
        return self.expr(node)

    def _function(self, node: Node) -> ir.Scope:
        parameters = []
        for given in self.children(node.child_by_field_name("parameters")):
            name: Node | None = given
            while name is not None and name.type != "identifier":
                name = next(iter(self.children(name)), None)
            if name is not None:
                parameters.append((self.text(name), None))
        body = node.child_by_field_name("body")
        inside: ir.Body = ()
        if body is not None and self.may_hold_a_table(body):
            inside = self.block([body])
        name_ = self.text(node.child_by_field_name("name"))
        types = frozenset({"dtype"})
        return ir.Scope("function", name_, inside, line_of(node), tuple(parameters), types)

    def _if(self, node: Node) -> ir.Statement:
        conditions = [self.expr(node.child_by_field_name("condition"))]
        arms = [self.block([node.child_by_field_name("consequence")])]
        is_total = False
        for part in node.children_by_field_name("alternative"):
            if part.type == "elif_clause":
                conditions.append(self.expr(part.child_by_field_name("condition")))
                arms.append(self.block([part.child_by_field_name("consequence")]))
            else:
                arms.append(self.block([part.child_by_field_name("body")]))
                is_total = True
        return ir.Branch(tuple(conditions), tuple(arms), line_of(node), is_total)

    def expression(self, node: Node) -> ir.Expr:
        field = node.child_by_field_name
        inside = self.children(node)
        match node.type:
            case "integer":
                return ir.Literal(self.text(node), is_whole=True)
            case "float":
                return ir.Literal(self.text(node))
            case "identifier" | "true" | "false":
                return ir.Name(self.text(node))
            case "none":
                return ir.Nothing()
            case "attribute":
                name = self.text(field("attribute"))
                of = self.expr(field("object"))
                return ir.Transposed(of) if name == "T" else ir.Field(of, name)
            case "binary_operator":
                sign = self.text(field("operator"))
                left, right = self.expr(field("left")), self.expr(field("right"))
                if isinstance(left, ir.Items) and sign in _OF_LISTS:
                    return ir.Call(ir.Name(_OF_LISTS[sign]), (left, right))
                return ir.Binary(_SIGNS.get(sign, sign), left, right)
            case "unary_operator":
                return ir.Unary(self.text(field("operator")), self.expr(field("argument")))
            case "parenthesized_expression" if inside:
                return self.expr(inside[0])
            case "list_comprehension" if len(inside) == 2 and inside[1].type == "for_in_clause":
                each_one = inside[1].child_by_field_name("left")
                if each_one is not None and each_one.type == "identifier":
                    each = ir.Lambda((self.text(each_one),), self.expr(inside[0]))
                    over = self.expr(inside[1].child_by_field_name("right"))
                    return ir.Call(ir.Name("list of each"), (each, over))
            case "list" | "tuple" | "expression_list":
                return ir.Items(self.exprs(inside))
            case "dictionary":
                return self._dictionary(inside)
            case "call":
                return self._call(node)
            case "subscript":
                at = [self._place(x) for x in node.children_by_field_name("subscript")]
                return ir.Index(self.expr(field("value")), tuple(at))
            case "string":
                return ir.Text("".join(self.text(x) for x in inside if x.type == "string_content"))
            case "conditional_expression":
                return ir.Opaque("a conditional expression")
        return unmeant(node)

    def _dictionary(self, inside: list[Node]) -> ir.Expr:
        pairs = []
        for part in inside:
            key = part.child_by_field_name("key")
            if part.type == "pair" and key is not None and key.type in {"string", "integer"}:
                name = self.expr(key)
                text = name.text if isinstance(name, ir.Text) else self.text(key)
                pairs.append((text, self.expr(part.child_by_field_name("value"))))
        return ir.Fields(tuple(pairs))

    def _call(self, node: Node) -> ir.Expr:
        args: list[ir.Expr] = []
        named: list[tuple[str, ir.Expr]] = []
        for part in self.children(node.child_by_field_name("arguments")):
            if part.type == "keyword_argument":
                name = self.text(part.child_by_field_name("name"))
                named.append((name, self.expr(part.child_by_field_name("value"))))
            else:
                args.append(self.expr(part))
        callee = self.expr(node.child_by_field_name("function"))
        if callee == ir.Name("dict") and not args:
            return ir.Fields(tuple(named))
        return ir.Call(callee, tuple(args), tuple(named))

    def _place(self, node: Node) -> ir.Expr:
        """An index, or a slice: its end is not in it."""
        if node.type != "slice":
            return self.expr(node)
        ends = self.ends(node)
        if len(ends) > 2 and ends[2] is not None:
            return ir.Opaque("a slice with steps")
        last = None if ends[1] is None else less_one(ends[1])
        return ir.Range(ends[0], last)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Python source."""
    return tables_in(text, source, NAME, lambda x: PythonLowering(x).module(), base=0)


READER = Reader(
    NAME, "Python: NumPy arrays, lists, Fractions, scipy's RungeKutta", (".py", ".pyi"), find
)
