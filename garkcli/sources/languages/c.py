"""C and C++."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from garkcli.frozen import replace
from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import (
    INCLUDED,
    Lowering,
    counted,
    is_in_c,
    kinds,
    line_of,
    part,
    unmeant,
)
from garkcli.sources.naming import ROLES
from garkcli.sources.reading import tables_in

if TYPE_CHECKING:
    from tree_sitter import Node

NAME = "c"
PETSC = "petsc"
SUFFIXES = (".c", ".C", ".h", ".def", ".cc", ".cpp", ".cxx", ".hpp", ".hh", ".cu", ".cuh", INCLUDED)
C = "tree_sitter_c"
CPP = "tree_sitter_cpp"
_NAMES = frozenset(
    {
        *("identifier", "field_identifier", "qualified_identifier", "destructor_name"),
        *("operator_name", "type_identifier", "template_function"),
    }
)
_WHOLE_TYPES = re.compile(r"\b(?:int|long|short|unsigned|size_t|auto|bool|PetscInt|u?int\d+_t)\b")
MAX_TITLE = 40
_NUMBER = re.compile(r"(?P<digits>[0-9']*\.?[0-9']*(?:[eE][-+]?[0-9]+)?)(?P<suffix>[a-zA-Z_]\w*)?")
_LIST = re.compile(r"\bvector\s*<")
_DECLARED = frozenset({"array_declarator", "identifier", "field_identifier"})
_VALUES = frozenset({"number_literal", "unary_expression", "binary_expression"})
"""Nodes of the numbers in a list of coefficients."""
_DEVICE = re.compile(rb"__(?:constant|device|shared|host|global)__")
"""Memory spaces of CUDA declarations, which the grammar does not know."""
_ASIDE = re.compile(
    rb"""//[^\n]*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|/\*(?P<closed>.*?\*/)?""", re.DOTALL
)
"""Comments and texts, one after the other."""


MOST_MACROS = 5
"""Deepest macros within macros that are put in."""
MOST_SPELLED = 10_000
"""Longest expression with its macros put in, in characters."""
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_PRECISION = re.compile(r"(?<=[0-9.])[fFlLqQ]\b|\s+")
_ENDS = frozenset(
    {"begin", "end", "cbegin", "cend", "std::begin", "std::end", "std::cbegin", "std::cend"}
)
"""Iterators of an array."""


def _is_made_of(args: list[Node], name: str) -> bool:
    """Whether a type of a library is made of a list: ``arma::mat({{0, 0}, {1, 0}})``."""
    is_type = "::" in name or name[:1].isupper()
    return is_type and [x.type for x in args] == ["initializer_list"]


class CLowering(Lowering):
    """Declarations, assignments, calls, branches and loops of C and C++."""

    grammar = CPP
    kinds = kinds(
        block="translation_unit compound_statement declaration_list labeled_statement ERROR"
        " linkage_specification namespace_definition template_declaration attributed_statement"
        " else_clause field_declaration_list preproc_else enumerator_list field_initializer_list",
        assignment="assignment_expression",
        loop="do_statement",
        switch="switch_statement",
        case="case_statement",
        tried="try_statement",
        name="identifier field_identifier type_identifier this true false qualified_identifier"
        " primitive_type template_method template_type",
        number="number_literal",
        nothing="null nullptr",
        text="string_literal",
        inside="parenthesized_expression template_function dependent_name subscript_argument_list",
        unary="unary_expression",
        binary="binary_expression",
        field="field_expression",
        index="subscript_expression",
        either="conditional_expression",
    )

    def __init__(self, text: str, grammar: str) -> None:
        super().__init__(text, grammar)
        self._data = _without_open_comment(_DEVICE.sub(lambda x: b" " * len(x[0]), self._data))
        self._types_in_use: dict[str, bool] = {}
        self._types_given: frozenset[str] = frozenset()  # of the templates around
        self._reals: set[str] = set()  # parameters that are real numbers
        self._gives: Node | None = None  # the return type of the function around
        self._code = b""  # without comments and texts, made on use
        self._macros: dict[str, str] = {}  # the texts of macros, empty for several ones
        self._loose: set[str] = set()  # the macros of several terms or factors

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        """A statement; braces behind a macro, ``DEFINE(3, 2) {…}``, are a separate scope."""
        made = _macro_before(node)
        if node.type == "template_declaration":
            around = self._types_given
            self._types_given = around | self._types(part(node, "parameters"))
            yield from super().statement(node)
            self._types_given = around
        elif made is None:
            yield from super().statement(node)
        else:
            title = re.sub(r"\s+", " ", self.text(made))[:MAX_TITLE]
            yield ir.Scope("entry", title, self.block(self.children(node)), line_of(node))

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        match node.type:
            case "preproc_ifdef" | "preproc_if" | "preproc_elif":
                yield from self.conditional(node)
            case "preproc_def" | "preproc_function_def":
                yield from self._definition(node)
            case "function_definition":
                yield self._function(node)
            case "class_specifier" | "struct_specifier" if body := part(node, "body"):
                name = self.text(part(node, "name"))
                given = (x for x in inside if x.type == "base_class_clause")
                bases = tuple(self.text(y) for x in given for y in self.children(x))
                self._declares(name, body)
                types = self._types(part(node.parent, "parameters"))
                yield ir.Scope("class", name, self.block([body]), line, types=types, bases=bases)
            case "type_definition" if body := part(node, "type", "body"):
                self._declares(self.text(part(node, "declarator")), body)
            case "enum_specifier":
                for each in self.children(part(node, "body")):
                    if value := part(each, "value"):
                        target = ir.Name(self.text(part(each, "name")))
                        yield ir.Assign(target, self.expr(value), line_of(each))
            case "alias_declaration":
                # using rk4 = tableau<list<0.5, 0.5>, …>
                made = self._instance(part(node, "type"))
                if made is not None:
                    yield ir.Assign(ir.Name(self.text(part(node, "name"))), made, line)
            case "declaration" | "field_declaration":
                yield from self._declaration(node)
            case "for_statement":
                yield self.loop(node, *self._counted(node))
            case "for_range_loop":
                name = self._declared(part(node, "declarator"))[0]
                yield self.loop(node, name, self.expr(part(node, "right")))
            case "call_expression":
                yield from self._call(node)
            case "expression_statement":
                yield from self.block(inside[:1])
            case "field_initializer" if len(inside) > 1 and inside[1].type == "initializer_list":
                made = _within_braces(self.expr(inside[1]))
                yield ir.Assign(ir.Name(self.name(inside[0])), made, line, is_real=True)
            case "field_initializer" if len(inside) > 1:
                # Base(s, a, b, c) of a constructor
                args = self.exprs(inside[1].named_children)
                yield ir.Do(ir.Call(ir.Name(self.name(inside[0])), args), line)
                if len(args) == 1:
                    # or a member of it
                    yield ir.Assign(ir.Name(self.name(inside[0])), args[0], line)
            case "comma_expression" | "binary_expression":
                first, *more = self._parts(node)
                to, value = part(first, "left"), part(first, "right")
                if to and value and more and self._fills(first, more):
                    numbers = ir.Items(self.exprs([value, *more]))
                    yield ir.Assign(self.target(to), numbers, line)
                    return
                match self.expr(first):
                    case ir.Binary("<<", left, right):
                        # A << 0, 1; of Eigen
                        row = (right, *self.exprs(more))
                        rows = ir.Items(row) if more else ir.Rows((row,))
                        yield ir.Assign(_target(left), rows, line)
                    case _ if more:
                        yield from self.block([first, *more])
                    case done:
                        yield ir.Do(done, line)
            case kind if kind.endswith("expression"):
                yield ir.Do(self.expr(node), line)

    def _declares(self, record: str, body: Node) -> None:
        """Declares the fields of a structure without functions."""
        if all(x.type != "function_definition" for x in body.named_children):
            inside = (x for each in self.children(body) for x, _ in _declarators(each))
            self.declares(record, (self._declared(x)[0] for x in inside))

    def _definition(self, node: Node) -> Iterator[ir.Statement]:
        name, text = self.text(part(node, "name")), self._plain(node)
        value = self._fragment(text)
        if value is not None:
            if given := part(node, "parameters"):
                value = ir.Lambda(tuple(map(self.text, self.children(given))), value)
            elif isinstance(value, ir.Binary):
                self._loose.add(name)
            old = self._macros.get(name, text)
            # in branches, or defined anew; 1.0f/3 is 1.0/3
            are_equal = _PRECISION.sub("", old) == _PRECISION.sub("", text)
            self._macros[name] = text if are_equal else ""
            yield ir.Assign(ir.Name(name), value, line_of(node))

    def _plain(self, node: Node) -> str:
        """The text of a macro without comments."""
        text = self.text(part(node, "value"))
        plain = text.split("//")[0].split("/*")[0].replace("\\\n", " ").strip()
        # x##L in GARK_REAL_C(x) appends the suffix of a number
        return re.sub(r"\s*##\s*\w+", "", plain)

    def _spelled(self, node: Node) -> ir.Expr | None:
        """An expression with its macros put in as text, as the preprocessor does: 2*X is 2*1-y if
        X is 1-y; None without such macros. A macro with several texts has no value.
        """
        text = before = self.text(node)
        for _ in range(MOST_MACROS):
            names = [x for x in _IDENTIFIER.findall(text) if x in self._loose]
            if not all(self._macros[x] for x in names):
                return ir.Opaque("a macro with several values")
            if not names or len(text) + sum(len(self._macros[x]) for x in names) > MOST_SPELLED:
                break
            text = _IDENTIFIER.sub(self._replaced, text)
        return None if text == before else self._fragment(text)

    def _replaced(self, name: re.Match[str]) -> str:
        return self._macros[name[0]] if name[0] in self._loose else name[0]

    def _fragment(self, plain: str) -> ir.Expr | None:
        """The expression of a macro; None if it has none."""
        inner = CLowering(f"double x = {plain};", self._grammar)
        inner._types_given, inner._reals = self._types_given, self._reals
        tree = inner.parse(inner._data)
        if plain and not tree.has_error:
            match inner.block(tree.named_children):
                case (ir.Assign(value=value),):
                    return value
        return None

    def _function(self, node: Node) -> ir.Scope:
        head = declarator = part(node, "declarator")
        while head is not None and head.type != "function_declarator":
            head = part(head, "declarator")
        parameter_nodes = (
            x for x in self.children(part(head, "parameters")) if part(x, "declarator")
        )
        made = self.block(x for x in self.children(node) if x.type == "field_initializer_list")
        body = part(node, "body")
        around, self._gives = self._gives, part(node, "type")
        made += self.block([body]) if body and self.may_hold_a_table(node) else ()
        self._gives = around
        parameters = tuple(self._declared(x)[0] for x in parameter_nodes)
        name, types = self._declared(declarator)[0], self._types(part(node.parent, "parameters"))
        # a method without arguments is a property
        is_property = node.parent and node.parent.type == "field_declaration_list"
        gives = name if is_property and not parameters and self._gives_a_value(node) else ""
        return ir.Scope("function", name, made, line_of(node), parameters, types, gives=gives)

    def _gives_a_value(self, node: Node) -> bool:
        return self.text(part(node, "type")) not in {"", "void"}

    def returned(self, node: Node | None) -> ir.Expr:
        """The value of a function; ``return {c, A, b};`` makes the structure that it returns."""
        return self._with_fields(self.expr(node), self._gives, line_of(node) if node else 0)

    def _types(self, parameters: Node | None) -> frozenset[str]:
        """The type parameters of a template."""
        parameter_nodes = self.children(parameters)
        kinds = {"type_parameter_declaration", "optional_type_parameter_declaration"}
        named = (y for x in parameter_nodes if x.type in kinds for y in self.children(x)[:1])
        return frozenset(map(self.text, named))

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        kind = part(node, "type")
        is_real = not _WHOLE_TYPES.search(self.text(kind))
        if kind is not None and kind.type.endswith("_specifier"):
            yield from self.block([kind])
        sizes = self._array_sizes(kind)
        for each, default in _declarators(node):
            initialiser = part(each, "value") or default
            name, extents = self._declared(each)
            extents = (*extents, *sizes)
            if initialiser is None and (copied := self._copied(each)):
                yield ir.Assign(ir.Name(name), ir.Name(copied), line_of(each))
                continue
            if initialiser is None and (not extents or each.type not in _DECLARED):
                continue
            value = None if initialiser is None else self.expr(initialiser)
            is_lambda = initialiser is not None and initialiser.type == "lambda_expression"
            if initialiser and is_lambda and isinstance(value, ir.Opaque):
                yield self._local_function(name, initialiser)
                continue
            if (
                initialiser
                and initialiser.type == "argument_list"
                and _LIST.search(self.text(kind))
            ):
                # std::vector<double> b(3)
                value = ir.Call(ir.Name("vector"), self.exprs(initialiser.named_children))
            elif isinstance(value, ir.Call) and kind and kind.type == "primitive_type":
                # double x(0.5)
                is_made = value.callee == ir.Name("constructor") and len(value.args) == 1
                value = value.args[0] if is_made else value
            if value is not None:
                value = self._with_fields(value, kind, line_of(each), bool(extents))
            if sizes and value is not None:
                value = _without_braces(value, len(extents))
            elif not extents and value is not None and kind and kind.type != "primitive_type":
                value = _within_braces(value)
            yield ir.Assign(ir.Name(name), value, line_of(each), extents=extents, is_real=is_real)

    def _copied(self, declarator: Node) -> str:
        """The name in ``T x(y);`` of a function, which looks like a declaration of another one."""
        given = self.children(part(declarator, "parameters"))
        is_local = declarator.parent and declarator.parent.parent
        if len(given) != 1 or not is_local or is_local.type != "compound_statement":
            return ""
        is_name = not part(given[0], "declarator") and len(given[0].children) == 1
        return self.text(given[0]) if is_name and self.text(given[0]) != "void" else ""

    def _with_fields(
        self, value: ir.Expr, kind: Node | None, line: int, is_array: bool = False
    ) -> ir.Expr:
        """A list of the members of a structure, by its fields, or an array of such lists."""
        name = self.text(kind).rpartition(" ")[2].partition("<")[0]
        if not isinstance(value, ir.Items) or name not in self._fields:
            return value
        if is_array:
            return ir.Items(tuple(self._with_fields(x, kind, line) for x in value.items))
        fields = self.made(name, value.items)
        return ir.Fields(fields, line) if fields else value

    def _array_sizes(self, kind: Node | None) -> tuple[ir.Expr, ...]:
        """The extents of ``std::array<double, 3>``, and of arrays in it."""
        while kind is not None and kind.type in {"qualified_identifier", "type_descriptor"}:
            kind = part(kind, "name") or part(kind, "type")
        args = self.children(part(kind, "arguments"))
        if self.text(part(kind, "name")) not in {"array", "Array"} or len(args) != 2:
            return ()
        return (self.expr(args[1]), *self._array_sizes(args[0]))

    def _instance(self, kind: Node | None) -> ir.Expr | None:
        """A template with numbers as a list, or with such lists as a call; None for another
        type.
        """
        while kind is not None and kind.type in {"qualified_identifier", "type_descriptor"}:
            kind = part(kind, "name") or part(kind, "type")
        if kind is None or kind.type != "template_type":
            return None
        arguments = self.children(part(kind, "arguments"))
        lists = [x for each in arguments if (x := self._instance(each)) is not None]
        if lists:
            return ir.Call(ir.Name(self.name(kind)), tuple(lists))
        numbers = [x for x in arguments if x.type != "type_descriptor"]
        return ir.Items(self.exprs(numbers)) if len(numbers) > 1 else None

    def _declared(self, node: Node | None) -> tuple[str, tuple[ir.Expr | None, ...]]:
        """The name and the extents in a declarator."""
        extents: list[ir.Expr | None] = []
        while node is not None and node.type not in _NAMES:
            if node.type == "array_declarator":
                size = part(node, "size")
                extents.insert(0, size and self.expr(size))
            node = part(node, "declarator") or next(iter(node.named_children), None)
        name = self.text(node)
        if node is not None and node.type == "template_function":
            # nodes<heun<T>>, a template with a type as argument, belongs to that type
            of = next(iter(self.children(part(node, "arguments"))), None)
            name = f"{self.name(of)}::{self.name(part(node, 'name'))}"
        return name, tuple(extents)

    def case(self, node: Node) -> tuple[ir.Scope]:
        """One case of a switch; s is 2 in ``case 2`` of ``switch (s)``, unless it is an order."""
        (made,) = super().case(node)
        around = node.parent.parent if node.parent is not None else None
        condition = part(around, "condition")
        both = self.expr(part(condition, "value") or condition), self.expr(part(node, "value"))
        match both:
            case ir.Name(name) as of, ir.Literal() as value if "order" not in ROLES.get(name, ""):
                made = replace(made, body=(ir.Assign(of, value, made.line), *made.body))
        return (made,)

    def target(self, node: Node) -> ir.Expr:
        """The target of an assignment: ``A(1, 0)`` is an entry, and Eigen's ``A.row(1)`` a row."""
        return _target(self.expr(node))

    def _parts(self, node: Node) -> list[Node]:
        """The operands between commas."""
        if node.type != "comma_expression":
            return [node]
        return [y for x in self.children(node) for y in self._parts(x)]

    def _fills(self, first: Node, more: Sequence[Node]) -> bool:
        """Whether an empty array gets its numbers: ``a += 0, 1;`` of Boost."""
        is_sum = self.text(part(first, "operator")) == "+="
        return is_sum and all(x.type in _VALUES for x in more)

    def _counted(self, node: Node) -> tuple[str, ir.Expr]:
        """The counter of ``for (i = a; i < b; i++)`` and its range; an empty name for other
        loops.
        """
        start, condition = part(node, "initializer"), part(node, "condition")
        start = part(start, "declarator") or start
        name = self._declared(part(start, "declarator") or part(start, "left"))[0]
        first = part(start, "value") or part(start, "right")
        return counted(self, name, first, condition, self.text(part(node, "update")))

    def _call(self, node: Node) -> Iterator[ir.Statement]:
        args = self.children(part(node, "arguments"))
        bodies = [x for x in args if x.type in {"compound_statement", "initializer_list", "ERROR"}]
        called = self.text(part(node, "function"))
        if args and bodies and called.isupper():
            # ARK_BUTCHER_TABLE(NAME, {…}): an entry of a list of macros
            inside = self.block(x for body in bodies for x in body.named_children)
            yield ir.Scope("entry", self.text(args[0]), inside, line_of(node))
        elif called == "strcpy" and len(args) == 2:
            yield ir.Assign(self.target(args[0]), self.expr(args[1]), line_of(node))
        elif called.endswith("vector_set") and len(args) == 3:
            # of GSL
            entry = ir.Index(self.expr(args[0]), (self.expr(args[1]),))
            yield ir.Assign(entry, self.expr(args[2]), line_of(node))
        elif called in {"PetscCall", "CHKERRQ", "PetscCallVoid"} and len(args) == 1:
            yield from self.block(args)
        else:
            yield ir.Do(self.expr(node), line_of(node))

    def name(self, node: Node | None) -> str:
        """A name without the arguments of a template."""
        return self.text(node).partition("<")[0]

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        match node.type:
            case "new_expression":
                return ir.Opaque("never assigned")
            case "pointer_expression":
                of = part(node, "argument")
                match self.expr(of):
                    case ir.Binary("+", array, i) if self.text(node).startswith("*"):
                        return ir.Index(array, (i,))
                # &A[0][0] is the array
                while self.is_a("index", of):
                    of = part(of, "argument")
                return self.expr(of)
            case "user_defined_literal" if inside:
                # 2_r is a number that the program makes from 2
                return ir.Call(ir.Name("double"), (self.expr(inside[0]),))
            case "cast_expression":
                return self._cast(part(node, "type"), self.expr(part(node, "value")))
            case "compound_literal_expression" if inside:
                return self._with_fields(self.expr(inside[-1]), inside[0], line_of(node))
            case "initializer_list":
                pairs = [x.named_children for x in inside if x.type == "initializer_pair"]
                if not pairs:
                    return ir.Items(self.exprs(inside))
                return ir.Fields(
                    tuple((self.text(x[0]).lstrip("."), self.expr(x[-1])) for x in pairs)
                )
            case "argument_list" if len(inside) == 2 and _is_copy(*map(self.text, inside)):
                # T x(y.begin(), y.end())
                return self.expr(inside[0])
            case "argument_list":
                # T x(args)
                return ir.Call(ir.Name("constructor"), self.exprs(inside))
            case "call_expression" if inside:
                args = self.exprs(inside[-1].named_children)
                if len(args) == 1 and self._is_type(inside[0]):
                    # (real)(-0.5): the grammar knows no types
                    return self._cast(self.children(inside[0])[0], args[0])
                callee = self.expr(inside[0])
                match callee:
                    case ir.Name(name) if name in self._types_given and len(args) == 1:
                        return self._cast(inside[0], args[0])
                    case ir.Name(name) if _is_made_of(inside[-1].named_children, name):
                        return args[0]
                    case ir.Field(name="finished") if not args:
                        return self._finished(self.children(inside[0])[0])
                    case ir.Field(array, "at") if len(args) == 1:
                        # A.at(1).at(0)
                        return ir.Index(array, args)
                    case ir.Field(array, name) if name in _ENDS and not args:
                        return array
                    case ir.Name(name) if name in _ENDS and len(args) == 1:
                        return args[0]
                match callee:
                    case ir.Name(name) if name.endswith("vector_get") and len(args) == 2:
                        return ir.Index(args[0], args[1:])
                return ir.Call(callee, args)
            case "lambda_expression":
                return self._lambda(node)
        return unmeant(node)

    def expression(self, node: Node, inside: list[Node]) -> ir.Expr:
        is_operation = self.is_a("binary", node) or self.is_a("unary", node)
        if is_operation and self._loose and (spelled := self._spelled(node)) is not None:
            return spelled
        match lowered := super().expression(node, inside):
            case ir.Binary("+" | "-" as sign, _, right) if self._is_type(inside[0]):
                # (real)-0.5
                return self._cast(self.children(inside[0])[0], ir.Unary(sign, right))
            case ir.Name(name) if name in self._reals:
                return ir.Call(ir.Name("double"), (lowered,))
        return lowered

    def _finished(self, node: Node) -> ir.Expr:
        """``(Matrix() << 0, 1).finished()`` of Eigen."""
        first, *more = self._parts(self.children(node)[0] if self.is_a("inside", node) else node)
        match self.expr(first):
            case ir.Binary("<<", _, right):
                return ir.Items((right, *self.exprs(more)))
        return unmeant(node)

    def _lambda(self, node: Node) -> ir.Expr:
        """``[](double x, double y) { return x / y; }``."""
        parameter_nodes = self.children(part(node, "declarator", "parameters"))
        parameters = tuple(self._declared(part(x, "declarator"))[0] for x in parameter_nodes)
        are_whole = [_WHOLE_TYPES.search(self.text(part(x, "type"))) for x in parameter_nodes]
        around, self._reals = (
            self._reals,
            {name for name, is_whole in zip(parameters, are_whole, strict=True) if not is_whole},
        )
        body = self.block([part(node, "body")])
        self._reals = around
        match body:
            case (ir.Return(value),):
                return ir.Lambda(parameters, value)
        return unmeant(node)

    def _local_function(self, name: str, node: Node) -> ir.Scope:
        """A lambda of several statements with its name."""
        parameters = (
            self._declared(each)[0]
            for x in self.children(part(node, "declarator", "parameters"))
            if (each := part(x, "declarator"))
        )
        body = self.block([part(node, "body")])
        return ir.Scope("function", name, body, line_of(node), tuple(parameters))

    def _is_type(self, node: Node) -> bool:
        """Whether a name in parentheses is a type of declared variables."""
        inside = self.children(node) if node.type == "parenthesized_expression" else []
        if len(inside) != 1 or not self.is_a("name", inside[0]):
            return False
        name = self.text(inside[0])
        if not self._code:
            self._code = _ASIDE.sub(b" ", self._data)
        if name not in self._types_in_use:
            declared = rf"\b{re.escape(name)}\s[\s*]{{0,9}}[A-Za-z_]\w*\s{{0,9}}[=;,\[)]"
            self._types_in_use[name] = re.search(declared.encode(), self._code) is not None
        return self._types_in_use[name]

    def _cast(self, kind: Node | None, value: ir.Expr) -> ir.Expr:
        """A number converted to another type."""
        is_whole = _WHOLE_TYPES.search(self.text(kind).partition(" ")[0])
        return value if is_whole else ir.Call(ir.Name("double"), (value,))

    def number(self, text: str) -> ir.Expr:
        if text[:1] in {"-", "+"}:
            return ir.Unary(text[0], self.number(text[1:]))
        match = _NUMBER.fullmatch(text)
        if not match or not match["digits"]:
            return ir.Opaque(f"the number {text[:20]}")
        digits = match["digits"].replace("'", "")
        is_whole = digits.isdigit() and (match["suffix"] or "").lower() not in {"f", "q"}
        return ir.Literal(digits, is_whole)


def _macro_before(node: Node) -> Node | None:
    """The call of a macro whose body is a block outside of functions; None for other blocks."""
    if node.type != "compound_statement" or node.parent is None:
        return None
    before = node.prev_named_sibling
    is_outside = node.parent.type in {"translation_unit", "declaration_list"}
    if not is_outside or before is None or before.type != "expression_statement":
        return None
    call = next(iter(before.named_children), None)
    name = part(call, "function")
    is_macro = name is not None and name.text is not None and name.text.isupper()
    return call if is_macro else None


def _without_open_comment(data: bytes) -> bytes:
    """The source before a comment that never ends: on its rest the grammar takes cubic time."""
    for match in _ASIDE.finditer(data):
        if match[0].startswith(b"/*") and match["closed"] is None:
            return data[: match.start()]
    return data


def _is_copy(first: str, last: str) -> bool:
    """Whether two texts are the ends of one array."""
    head, _, end = first.rpartition("begin")
    return end == "()" and last == f"{head}end()"


def _target(expr: ir.Expr) -> ir.Expr:
    match expr:
        case ir.Call(ir.Field(of=of, name="row"), (i,)):
            return ir.Index(of, (i, ir.Range()))
        case ir.Call(ir.Field(of=of, name="col"), (i,)):
            return ir.Index(of, (ir.Range(), i))
        case ir.Call(ir.Name(name), (ir.Name() as of, _, *_) as args) if name.isupper():
            # ENTRY(A, 1, 0): a macro for an entry
            return ir.Index(of, args[1:])
        case ir.Call(ir.Field(of=of, name="coeffRef"), (_, *_) as args) | ir.Call(
            of, (_, *_) as args
        ):
            return ir.Index(of, args)
    return expr


def _declarators(node: Node) -> list[tuple[Node, Node | None]]:
    """The declarators of a declaration, with default values of members."""
    declarators: list[tuple[Node, Node | None]] = []
    for i, child in enumerate(node.children):
        match node.field_name_for_child(i):
            case "declarator":
                declarators.append((child, None))
            case "default_value" if declarators:
                declarators[-1] = declarators[-1][0], child
    return declarators


def _without_braces(value: ir.Expr, depth: int) -> ir.Expr:
    """Nested lists without the second pair of braces that ``std::array`` allows."""
    if not isinstance(value, ir.Items):
        return value
    if len(value.items) == 1 and _depth(value) > depth:
        return _without_braces(value.items[0], depth)
    return ir.Items(tuple(_without_braces(x, depth - 1) for x in value.items))


def _within_braces(value: ir.Expr) -> ir.Expr:
    """The list in the braces of a class with an array: ``Vector<3> b{{{1, 4, 1}}}``."""
    while isinstance(value, ir.Items) and len(value.items) == 1 and _depth(value) > 1:
        value = value.items[0]
    return value


def _depth(value: ir.Expr) -> int:
    if not isinstance(value, ir.Items):
        return 0
    return 1 + max(map(_depth, value.items), default=0)


@lru_cache(maxsize=1)
def _tables(text: str, source: str) -> Sequence[FoundTable]:
    """The tables of both formats, which are read together."""
    if source.endswith(INCLUDED) and not is_in_c(text):
        return []
    grammar = C if source.endswith((".c", ".def")) else CPP

    def lowered(text: str) -> ir.Body:
        return CLowering(text, grammar).module()

    return tables_in(text, source, NAME, lowered, base=0, has_whole_quotients=True)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a C or C++ source that are not registered with PETSc."""
    return [x for x in _tables(text, source) if x.format == NAME]


def find_registered(text: str, source: str) -> list[FoundTable]:
    """The tables that are registered with PETSc."""
    return [x for x in _tables(text, source) if x.format == PETSC]


READER = Reader(
    NAME, "C, C++: SUNDIALS tables, structures, arrays, classes", SUFFIXES, find, (C, CPP)
)
REGISTERED = Reader(
    PETSC,
    "PETSc: TSRKRegister, TSARKIMEXRegister, TSDIRKRegister",
    SUFFIXES,
    find_registered,
    (C, CPP),
)
