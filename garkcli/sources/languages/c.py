"""C and C++."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

import tree_sitter_c
import tree_sitter_cpp
from tree_sitter import Language, Node

from garkcli.sources import ir
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.lowering import Lowering, kinds, less_one, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "c"
PETSC = "petsc"
SUFFIXES = (".c", ".h", ".def", ".cc", ".cpp", ".cxx", ".hpp", ".hh", ".cu")
C = Language(tree_sitter_c.language())
CPP = Language(tree_sitter_cpp.language())
_NAMES = frozenset(
    {
        *("identifier", "field_identifier", "qualified_identifier", "destructor_name"),
        *("operator_name", "type_identifier", "template_function"),
    }
)
_SKIPPED = frozenset({"preproc_include", "using_declaration", "break_statement", "preproc_call"})
_WHOLE_TYPES = re.compile(r"\b(?:int|long|short|unsigned|size_t|auto|bool|PetscInt|u?int\d+_t)\b")
_NUMBER = re.compile(r"(?P<digits>[0-9']*\.?[0-9']*(?:[eE][-+]?[0-9]+)?)(?P<suffix>[a-zA-Z_]\w*)?")
_DECLARED = frozenset({"array_declarator", "identifier", "field_identifier"})
_CASTS = frozenset({"static_cast", "reinterpret_cast", "const_cast", "as"})
_DEVICE = re.compile(rb"__(?:constant|device|shared|host|global)__")
"""Where CUDA keeps what is declared: no part of the grammar."""


class CLowering(Lowering):
    """Declarations, assignments, calls, branches and loops of C and C++."""

    grammar = CPP
    blocks = frozenset(
        {
            *("translation_unit", "compound_statement", "declaration_list", "labeled_statement"),
            *("linkage_specification", "namespace_definition", "template_declaration", "ERROR"),
            *("attributed_statement", "else_clause", "field_declaration_list", "preproc_else"),
            "enumerator_list",
        }
    )
    unfollowed = frozenset({"while_statement", "do_statement", "for_range_loop"})
    expressions = kinds(
        name="identifier field_identifier type_identifier this true false",
        number="number_literal",
        nothing="null nullptr",
        text="string_literal",
        inside="parenthesized_expression template_function dependent_name",
        unary="unary_expression",
        binary="binary_expression",
    )

    def __init__(self, text: str, language: Language) -> None:
        super().__init__(text, language)
        self._data = _DEVICE.sub(lambda x: b" " * len(x[0]), self._data)

    def own(self, node: Node, inside: list[Node], line: int) -> Iterator[ir.Statement]:
        field = node.child_by_field_name
        match node.type:
            case "preproc_ifdef" | "preproc_if" | "preproc_elif":
                yield from self._conditional(node)
            case "preproc_def" | "preproc_function_def":
                yield from self._definition(node)
            case "function_definition":
                yield self._function(node)
            case "class_specifier" | "struct_specifier" if (body := field("body")) is not None:
                given = [
                    y for x in inside if x.type == "base_class_clause" for y in self.children(x)
                ]
                bases = tuple(self.text(x) for x in given)
                self._declares(self.text(field("name")), body)
                made = self.block(body.named_children)
                yield ir.Scope("class", self.text(field("name")), made, line, bases=bases)
            case "type_definition" if (body := _body_of(field("type"))) is not None:
                self._declares(self.text(field("declarator")), body)
            case "enum_specifier":
                for each in self.children(field("body")):
                    value = each.child_by_field_name("value")
                    if value is not None:
                        name = ir.Name(self.text(each.child_by_field_name("name")))
                        yield ir.Assign(name, self.expr(value), line_of(each))
            case "declaration" | "field_declaration":
                yield from self._declaration(node)
            case "assignment_expression":
                yield from self._assignment(node)
            case "switch_statement":
                cases = [x for x in self.children(field("body")) if x.type == "case_statement"]
                arms = tuple(arm for arm in map(self._case, cases) if arm[0].body)
                yield ir.Branch(arms, line)
            case "for_statement":
                yield self.loop(node, *self._counted(node))
            case "call_expression":
                yield from self._call(node)
            case "expression_statement":
                yield from self.block(inside[:1])
            case "comma_expression" | "binary_expression":
                yield from self._listed(self._parts(node), line)
            case kind if kind not in _SKIPPED and kind.endswith("expression"):
                yield ir.Do(self.expr(node), line)

    def _declares(self, record: str, body: Node) -> None:
        """The fields of a structure that no function makes."""
        if all(x.type != "function_definition" for x in body.named_children):
            inside = [x for part in self.children(body) for x, _ in _declarators(part)]
            self.declares(record, (self._declared(x)[0] for x in inside))

    def _case(self, node: Node) -> tuple[ir.Scope]:
        value = node.child_by_field_name("value")
        inside = self.block(x for x in node.named_children if x != value)
        return (ir.Scope("entry", self.text(value), inside, line_of(node)),)

    def _conditional(self, node: Node) -> Iterator[ir.Statement]:
        """``#if``: both ways; one that has no other is taken, of ``#if 0`` the other."""
        other = node.child_by_field_name("alternative")
        condition = node.child_by_field_name("condition") or node.child_by_field_name("name")
        first = self.block(x for x in node.named_children if x not in (other, condition))
        second = self.block([other])
        is_off = self.text(condition) == "0"
        if other is None or is_off or (_defines(first) and _defines(second)):
            # a macro in several ways: the last one is the plain one
            yield from second if other or is_off else first
        else:
            yield ir.Branch((first, second), line_of(node), is_total=True)

    def _definition(self, node: Node) -> Iterator[ir.Statement]:
        value = self._fragment(self.text(node.child_by_field_name("value")))
        if value is None:
            return
        if node.type == "preproc_function_def":
            given = self.children(node.child_by_field_name("parameters"))
            value = ir.Lambda(tuple(map(self.text, given)), value)
        yield ir.Assign(ir.Name(self.text(node.child_by_field_name("name"))), value, line_of(node))

    def _fragment(self, text: str) -> ir.Expr | None:
        """The expression that a macro stands for; None where it is none."""
        plain = text.split("//")[0].split("/*")[0].replace("\\\n", " ").strip()
        # in GARK_REAL_C(x) x##L the suffix of a number is made
        plain = re.sub(r"\s*##\s*\w+", "", plain)
        inner = CLowering(f"double x = {plain};", self._language)
        tree = inner.parse(inner._data)
        if plain and not tree.has_error:
            match inner.block(tree.named_children):
                case (ir.Assign(value=value),):
                    return value
        return None

    def _function(self, node: Node) -> ir.Scope:
        declarator = node.child_by_field_name("declarator")
        name, _ = self._declared(declarator)
        while declarator is not None and declarator.type != "function_declarator":
            declarator = declarator.child_by_field_name("declarator")
        given = () if declarator is None else declarator.child_by_field_name("parameters")
        inside = [x.child_by_field_name("declarator") for x in self.children(given or None)]
        parameters = tuple(self._declared(x)[0] for x in inside if x is not None)
        body = node.child_by_field_name("body")
        statements = tuple(y for x in self.children(node) for y in self._initialisers(x))
        if body is not None and self.may_hold_a_table(body):
            statements += self.block(body.named_children)
        return ir.Scope("function", name, statements, line_of(node), parameters)

    def _initialisers(self, node: Node) -> Iterator[ir.Statement]:
        """The bases and members that a constructor makes: ``Base(s, a, b, c)``."""
        for given in self.children(node) if node.type == "field_initializer_list" else ():
            inside = self.children(given)
            if len(inside) > 1:
                name = ir.Name(self.text(inside[0]).partition("<")[0])
                yield ir.Do(ir.Call(name, self.exprs(inside[1].named_children)), line_of(given))

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        kind = node.child_by_field_name("type")
        is_real = not _WHOLE_TYPES.search(self.text(kind))
        if kind is not None and kind.type.endswith("_specifier"):
            yield from self.block([kind])
        sizes = self._array_sizes(kind)
        for each, default in _declarators(node):
            value = None if default is None else self.expr(default)
            inner: Node | None = each
            if each.type == "init_declarator":
                inner, given = map(each.child_by_field_name, ("declarator", "value"))
                value = self.expr(given)
                if given is not None and given.type == "argument_list":
                    # T x(args)
                    value = ir.Call(ir.Name("constructor"), self.exprs(given.named_children))
            elif each.type not in _DECLARED and default is None:
                continue
            name, extents = self._declared(inner)
            extents = (*extents, *sizes)
            if value is None and not extents:
                continue
            if value is not None:
                value = self._with_fields(value, kind, line_of(each), bool(extents))
            if sizes and value is not None:
                value = _without_braces(value, len(extents))
            yield ir.Assign(ir.Name(name), value, line_of(each), extents=extents, is_real=is_real)

    def _with_fields(
        self, value: ir.Expr, kind: Node | None, line: int, is_array: bool = False
    ) -> ir.Expr:
        """A list of what is in a structure, by its fields, or an array of such lists."""
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
            kind = kind.child_by_field_name("name") or kind.child_by_field_name("type")
        if kind is None or kind.type != "template_type":
            return ()
        args = self.children(kind.child_by_field_name("arguments"))
        if self.text(kind.child_by_field_name("name")) not in {"array", "Array"} or len(args) != 2:
            return ()
        return (self.expr(args[1]), *self._array_sizes(args[0]))

    def _declared(self, node: Node | None) -> tuple[str, tuple[ir.Expr | None, ...]]:
        """The name and the extents that a declarator declares."""
        extents: list[ir.Expr | None] = []
        while node is not None and node.type not in _NAMES:
            if node.type == "array_declarator":
                size = node.child_by_field_name("size")
                extents.insert(0, None if size is None else self.expr(size))
            node = (
                next(iter(node.named_children), None)
                if (inside := node.child_by_field_name("declarator")) is None
                else inside
            )
        return self.text(node), tuple(extents)

    def _assignment(self, node: Node) -> Iterator[ir.Statement]:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = self.text(node.child_by_field_name("operator")).rstrip("=")
        while right is not None and right.type == "assignment_expression":
            # a = b = 0
            yield from self.block([right])
            right = right.child_by_field_name("left")
        yield ir.Assign(_target(self.expr(left)), self.expr(right), line_of(node), sign)

    def _parts(self, node: Node) -> list[Node]:
        """What is between the commas."""
        if node.type != "comma_expression":
            return [node]
        return [y for x in self.children(node) for y in self._parts(x)]

    def _listed(self, parts: list[Node], line: int) -> Iterator[ir.Statement]:
        """Statements with commas between, and ``A << 0, 1;`` of Eigen."""
        first = self.expr(parts[0])
        match first:
            case ir.Binary("<<", target, value):
                more = self.exprs(parts[1:])
                given = ir.Items((value, *more)) if more else ir.Rows(((value,),))
                yield ir.Assign(_target(target), given, line)
            case _ if len(parts) > 1:
                yield from self.block(parts)
            case _:
                yield ir.Do(first, line)

    def _counted(self, node: Node) -> tuple[str, ir.Expr]:
        """What ``for (i = a; i < b; i++)`` counts; an empty name for other loops."""
        start, condition, update = map(
            node.child_by_field_name, ("initializer", "condition", "update")
        )
        if start is not None and start.type == "declaration":
            start = start.child_by_field_name("declarator")
        if start is not None and condition is not None:
            named = start.child_by_field_name("declarator") or start.child_by_field_name("left")
            first = start.child_by_field_name("value") or start.child_by_field_name("right")
            sign = self.text(condition.child_by_field_name("operator"))
            if named and first and sign in {"<", "<="} and "++" in self.text(update):
                last = self.expr(condition.child_by_field_name("right"))
                last = less_one(last) if sign == "<" else last
                return self._declared(named)[0], ir.Range(self.expr(first), last)
        return "", ir.Opaque("a loop")

    def _call(self, node: Node) -> Iterator[ir.Statement]:
        args = self.children(node.child_by_field_name("arguments"))
        bodies = [x for x in args if x.type in {"compound_statement", "initializer_list", "ERROR"}]
        called = self.text(node.child_by_field_name("function"))
        if args and bodies and called.isupper():
            # ARK_BUTCHER_TABLE(NAME, {…}): an entry of a list of macros
            inside = self.block(x for body in bodies for x in body.named_children)
            yield ir.Scope("entry", self.text(args[0]), inside, line_of(node))
        elif called in {"PetscCall", "CHKERRQ", "PetscCallVoid"} and len(args) == 1:
            yield from self.block(args)
        else:
            yield ir.Do(self.expr(node), line_of(node))

    def other(self, node: Node, inside: list[Node]) -> ir.Expr:
        field = node.child_by_field_name
        match node.type:
            case "qualified_identifier" | "primitive_type":
                return ir.Name(self.text(node).partition("<")[0])
            case "new_expression":
                return ir.Opaque("never assigned")
            case "pointer_expression":
                # &A[0][0] is the array
                of = field("argument")
                while of is not None and of.type == "subscript_expression":
                    of = of.child_by_field_name("argument")
                return self.expr(of)
            case "cast_expression":
                name, value = self.text(field("type")).partition(" ")[0], self.expr(field("value"))
                return value if _WHOLE_TYPES.search(name) else ir.Call(ir.Name("double"), (value,))
            case "compound_literal_expression" if inside:
                return self._with_fields(self.expr(inside[-1]), field("type"), line_of(node))
            case "initializer_list":
                if all(x.type != "initializer_pair" for x in inside):
                    return ir.Items(self.exprs(inside))
                pairs = [x.named_children for x in inside if x.named_children]
                return ir.Fields(
                    tuple((self.text(x[0]).lstrip("."), self.expr(x[-1])) for x in pairs)
                )
            case "call_expression":
                return self._called(
                    field("function"), self.exprs(self.children(field("arguments")))
                )
            case "field_expression":
                name = self.text(field("field")).partition("<")[0]
                return ir.Field(self.expr(field("argument")), name)
            case "subscript_expression":
                index = field("index") or field("indices")
                if index is not None and index.type == "subscript_argument_list":
                    index = next(iter(self.children(index)), None)
                return ir.Index(self.expr(field("argument")), (self.expr(index),))
            case "template_method" | "template_type" if inside:
                return ir.Name(self.text(inside[0]))
        return unmeant(node)

    def number(self, text: str) -> ir.Expr:
        if text.startswith("-"):
            return ir.Unary("-", self.number(text[1:]))
        found = _NUMBER.fullmatch(text)
        if not found or not found["digits"]:
            return ir.Opaque(f"the number {text[:20]}")
        digits = found["digits"].replace("'", "")
        is_whole = digits.isdigit() and (found["suffix"] or "").lower() not in {"f", "q"}
        return ir.Literal(digits, is_whole)

    def _called(self, callee: Node | None, args: tuple[ir.Expr, ...]) -> ir.Expr:
        if callee is not None and callee.type == "template_function":
            name = self.text(callee.child_by_field_name("name"))
            is_cast = name in _CASTS and len(args) == 1
            return ir.Call(ir.Name("double" if is_cast else name), args)
        return ir.Call(self.expr(callee), args)


def _target(expr: ir.Expr) -> ir.Expr:
    """What is assigned to: ``A(1, 0)`` is an entry, and Eigen's ``A.row(1)`` a row."""
    match expr:
        case ir.Call(ir.Field(of=of, name="row"), (i,)):
            return ir.Index(of, (i, ir.Range()))
        case ir.Call(ir.Field(of=of, name="col"), (i,)):
            return ir.Index(of, (ir.Range(), i))
        case ir.Call(ir.Field(of=of, name="coeffRef"), (_, *_) as args) | ir.Call(
            of, (_, *_) as args
        ):
            return ir.Index(of, args)
    return expr


def _body_of(node: Node | None) -> Node | None:
    return None if node is None else node.child_by_field_name("body")


def _declarators(node: Node) -> list[tuple[Node, Node | None]]:
    """What a declaration declares, each with the value that members have."""
    found: list[tuple[Node, Node | None]] = []
    for i, child in enumerate(node.children):
        match node.field_name_for_child(i):
            case "declarator":
                found.append((child, None))
            case "default_value" if found:
                found[-1] = found[-1][0], child
    return found


def _without_braces(value: ir.Expr, depth: int) -> ir.Expr:
    """Nested lists without the second pair of braces that ``std::array`` may have."""
    if not isinstance(value, ir.Items):
        return value
    if len(value.items) == 1 and _depth(value) > depth:
        return _without_braces(value.items[0], depth)
    return ir.Items(tuple(_without_braces(x, depth - 1) for x in value.items))


def _depth(value: ir.Expr) -> int:
    if not isinstance(value, ir.Items):
        return 0
    return 1 + max(map(_depth, value.items), default=0)


def _defines(arm: ir.Body) -> bool:
    """Whether an arm is definitions of macros, and nothing else."""
    names = (ir.Lambda, ir.Name, ir.Literal)
    if len(arm) == 1 and isinstance(arm[0], ir.Branch):
        return all(map(_defines, arm[0].arms))
    return bool(arm) and all(isinstance(x, ir.Assign) and isinstance(x.value, names) for x in arm)


@lru_cache(maxsize=1)
def _tables(text: str, source: str) -> Sequence[FoundTable]:
    """Those of both formats, which are read at once."""
    language = C if source.endswith((".c", ".def")) else CPP

    def lowered(text: str) -> ir.Body:
        return CLowering(text, language).module()

    return tables_in(text, source, NAME, lowered, base=0, has_whole_quotients=True)


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a C or C++ source, but for those that are registered with PETSc."""
    return [x for x in _tables(text, source) if x.format == NAME]


def find_registered(text: str, source: str) -> list[FoundTable]:
    """The tables that are registered with PETSc."""
    return [x for x in _tables(text, source) if x.format == PETSC]


READER = Reader(NAME, "C, C++: SUNDIALS tables, structures, arrays, classes", SUFFIXES, find)
REGISTERED = Reader(
    PETSC, "PETSc: TSRKRegister, TSARKIMEXRegister, TSDIRKRegister", SUFFIXES, find_registered
)
