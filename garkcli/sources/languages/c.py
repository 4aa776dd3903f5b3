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
from garkcli.sources.lowering import Lowering, less_one, line_of, unmeant
from garkcli.sources.reading import tables_in

NAME = "c"
PETSC = "petsc"
SUFFIXES = (".c", ".h", ".def", ".cc", ".cpp", ".cxx", ".hpp", ".hh", ".cu")
C = Language(tree_sitter_c.language())
CPP = Language(tree_sitter_cpp.language())
_NAMES = frozenset(
    [
        "identifier",
        "field_identifier",
        "qualified_identifier",
        "destructor_name",
        "operator_name",
        "type_identifier",
        "template_function",
    ]
)
_BLOCKS = frozenset(
    [
        "translation_unit",
        "compound_statement",
        "declaration_list",
        "linkage_specification",
        "namespace_definition",
        "template_declaration",
        "labeled_statement",
        "attributed_statement",
        "else_clause",
        "field_declaration_list",
        "ERROR",
        "preproc_else",
        "enumerator_list",
    ]
)
_SKIPPED = frozenset({"preproc_include", "using_declaration", "break_statement", "preproc_call"})
_WHOLE_TYPES = re.compile(r"\b(?:int|long|short|unsigned|size_t|auto|bool|PetscInt|u?int\d+_t)\b")
_NUMBER = re.compile(r"(?P<digits>[0-9']*\.?[0-9']*(?:[eE][-+]?[0-9]+)?)(?P<suffix>[a-zA-Z_]\w*)?")
_DECLARED = frozenset({"array_declarator", "identifier", "field_identifier"})
_CASTS = frozenset({"static_cast", "reinterpret_cast", "const_cast"})


class CLowering(Lowering):
    """Declarations, assignments, calls, branches and loops of C and C++."""

    def __init__(self, text: str, language: Language) -> None:
        super().__init__(text, language)
        self._statements = {
            "preproc_ifdef": self._conditional,
            "preproc_if": self._conditional,
            "preproc_elif": self._conditional,
            "preproc_def": self._definition,
            "preproc_function_def": self._definition,
            "function_definition": self._function,
            "class_specifier": self._class,
            "struct_specifier": self._class,
            "enum_specifier": self._enumeration,
            "declaration": self._declaration,
            "field_declaration": self._declaration,
            "assignment_expression": self._assignment,
            "if_statement": self._if,
            "switch_statement": self._switch,
            "for_statement": self._for,
            "call_expression": self._call,
        }

    def statement(self, node: Node) -> Iterator[ir.Statement]:
        kind = node.type
        if kind in self._statements:
            yield from self._statements[kind](node)
        elif kind in _BLOCKS:
            yield from self.block(node.named_children)
        elif kind == "expression_statement":
            yield from self.block(node.named_children[:1])
        elif kind == "return_statement":
            inside = self.children(node)
            yield ir.Return(self.expr(inside[0] if inside else None), line_of(node))
        elif kind in {"while_statement", "do_statement", "for_range_loop"}:
            body = self.block([node.child_by_field_name("body")])
            yield ir.Loop("", ir.Nothing(), body, line_of(node))
        elif kind not in _SKIPPED and kind.endswith("expression"):
            yield ir.Do(self.expr(node), line_of(node))

    def _conditional(self, node: Node) -> Iterator[ir.Statement]:
        """``#if``: both ways; a part that has no other way is taken."""
        other = node.child_by_field_name("alternative")
        condition = node.child_by_field_name("condition") or node.child_by_field_name("name")
        inside = [x for x in node.named_children if x not in (other, condition)]
        if other is None:
            yield from self.block(inside)
            return
        arms = (self.block(inside), self.block([other]))
        if all(_defines(arm) for arm in arms):
            # a macro in several ways: the last one is the plain one
            yield from arms[1]
            return
        yield ir.Branch((ir.Opaque("the preprocessor"),), arms, line_of(node), is_total=True)

    def _definition(self, node: Node) -> Iterator[ir.Statement]:
        value = self._fragment(self.text(node.child_by_field_name("value")))
        if value is None:
            return
        name = ir.Name(self.text(node.child_by_field_name("name")))
        if node.type == "preproc_function_def":
            given = self.children(node.child_by_field_name("parameters"))
            value = ir.Lambda(tuple(self.text(x) for x in given), value)
        yield ir.Assign(name, value, line_of(node))

    def _fragment(self, text: str) -> ir.Expr | None:
        """The expression that a macro stands for; None where it is none."""
        plain = text.split("//")[0].split("/*")[0].replace("\\\n", " ").strip()
        # in GARK_REAL_C(x) x##L the suffix of a number is made
        plain = re.sub(r"\s*##\s*\w+", "", plain)
        if not plain:
            return None
        data = f"double x = {plain};".encode()
        tree = self.parse(data)
        if tree.has_error:
            return None
        inner = CLowering("", self._language)
        inner._data = data
        statements = inner.block(tree.named_children)
        match statements:
            case (ir.Assign(value=value),):
                return value
        return None

    def _function(self, node: Node) -> Iterator[ir.Statement]:
        declarator = node.child_by_field_name("declarator")
        name, _ = self._declared(declarator)
        while declarator is not None and declarator.type != "function_declarator":
            declarator = declarator.child_by_field_name("declarator")
        parameters = []
        if declarator is not None:
            for given in self.children(declarator.child_by_field_name("parameters")):
                inside = given.child_by_field_name("declarator")
                if inside is not None:
                    parameters.append((self._declared(inside)[0], None))
        made = [x for part in self.children(node) for x in self._initialisers(part)]
        body = node.child_by_field_name("body")
        statements = tuple(made)
        if body is not None and self.may_hold_a_table(body):
            statements += self.block(body.named_children)
        yield ir.Scope("function", name, statements, line_of(node), tuple(parameters))

    def _initialisers(self, node: Node) -> Iterator[ir.Statement]:
        """The bases and members that a constructor makes: ``Base(s, a, b, c)``."""
        if node.type != "field_initializer_list":
            return
        for given in self.children(node):
            inside = self.children(given)
            if len(inside) > 1:
                name = ir.Name(self.text(inside[0]).partition("<")[0])
                yield ir.Do(ir.Call(name, self.exprs(inside[1].named_children)), line_of(given))

    def _class(self, node: Node) -> Iterator[ir.Statement]:
        body = node.child_by_field_name("body")
        if body is None:
            return
        name = self.text(node.child_by_field_name("name"))
        bases = [
            self.text(x)
            for part in node.children
            if part.type == "base_class_clause"
            for x in self.children(part)
        ]
        inside = self.block(body.named_children)
        yield ir.Scope("class", name, inside, line_of(node), bases=tuple(bases))

    def _enumeration(self, node: Node) -> Iterator[ir.Statement]:
        for each in self.children(node.child_by_field_name("body")):
            value = each.child_by_field_name("value")
            if value is not None:
                name = ir.Name(self.text(each.child_by_field_name("name")))
                yield ir.Assign(name, self.expr(value), line_of(each))

    def _declaration(self, node: Node) -> Iterator[ir.Statement]:
        kind = node.child_by_field_name("type")
        is_real = not _WHOLE_TYPES.search(self.text(kind))
        if kind is not None and kind.type.endswith("_specifier"):
            yield from self.block([kind])
        sizes = self._array_sizes(kind)
        for each, default in _declarators(node):
            value: ir.Expr | None = None if default is None else self.expr(default)
            inner: Node | None = each
            if each.type == "init_declarator":
                inner = each.child_by_field_name("declarator")
                value = self._initial(each.child_by_field_name("value"))
            elif each.type not in _DECLARED and default is None:
                continue
            name, extents = self._declared(inner)
            extents = (*extents, *sizes)
            if value is None and not extents:
                continue
            if sizes and value is not None:
                value = _without_braces(value, len(extents))
            yield ir.Assign(ir.Name(name), value, line_of(each), extents=extents, is_real=is_real)

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

    def _initial(self, node: Node | None) -> ir.Expr:
        """``T x(args)`` and ``T x{args}``: a call of the type, or a list."""
        if node is not None and node.type == "argument_list":
            return ir.Call(ir.Name("constructor"), self.exprs(node.named_children))
        return self.expr(node)

    def _declared(self, node: Node | None) -> tuple[str, tuple[ir.Expr | None, ...]]:
        """The name and the extents that a declarator declares."""
        extents: list[ir.Expr | None] = []
        while node is not None and node.type not in _NAMES:
            if node.type == "array_declarator":
                size = node.child_by_field_name("size")
                extents.insert(0, None if size is None else self.expr(size))
            inside = node.named_children
            node = node.child_by_field_name("declarator") or (inside[0] if inside else None)
        return self.text(node), tuple(extents)

    def _assignment(self, node: Node) -> Iterator[ir.Statement]:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = self.text(node.child_by_field_name("operator")).rstrip("=")
        while right is not None and right.type == "assignment_expression":
            # a = b = 0
            yield from self.block([right])
            right = right.child_by_field_name("left")
        target = self.expr(left)
        if isinstance(target, ir.Call) and target.args:
            # A(1, 0) = 0.5
            target = ir.Index(target.callee, target.args)
        yield ir.Assign(target, self.expr(right), line_of(node), sign)

    def _if(self, node: Node) -> Iterator[ir.Statement]:
        then = self.block([node.child_by_field_name("consequence")])
        other = node.child_by_field_name("alternative")
        condition = self.expr(node.child_by_field_name("condition"))
        arms = (then,) if other is None else (then, self.block([other]))
        yield ir.Branch((condition,), arms, line_of(node), is_total=other is not None)

    def _switch(self, node: Node) -> Iterator[ir.Statement]:
        arms = []
        for case in self.children(node.child_by_field_name("body")):
            if case.type != "case_statement":
                continue
            value = case.child_by_field_name("value")
            inside = self.block(x for x in case.named_children if x != value)
            if inside:
                arms.append((ir.Scope("entry", self.text(value), inside, line_of(case)),))
        yield ir.Branch((), tuple(arms), line_of(node))

    def _for(self, node: Node) -> Iterator[ir.Statement]:
        body = self.block([node.child_by_field_name("body")])
        name, over = self._counted(node)
        yield ir.Loop(name, over, body, line_of(node))

    def _counted(self, node: Node) -> tuple[str, ir.Expr]:
        """What ``for (i = a; i < b; i++)`` counts; an empty name for other loops."""
        none = "", ir.Opaque("a loop")
        start = node.child_by_field_name("initializer")
        condition = node.child_by_field_name("condition")
        if start is None or condition is None:
            return none
        if start.type == "declaration":
            start = start.child_by_field_name("declarator")
        if start is None:
            return none
        named = start.child_by_field_name("declarator") or start.child_by_field_name("left")
        first = start.child_by_field_name("value") or start.child_by_field_name("right")
        sign = self.text(condition.child_by_field_name("operator"))
        update = self.text(node.child_by_field_name("update"))
        if named is None or first is None or sign not in {"<", "<="} or "++" not in update:
            return none
        last = self.expr(condition.child_by_field_name("right"))
        if sign == "<":
            last = less_one(last)
        return self._declared(named)[0], ir.Range(self.expr(first), last)

    def _call(self, node: Node) -> Iterator[ir.Statement]:
        args = self.children(node.child_by_field_name("arguments"))
        bodies = [x for x in args if x.type in {"compound_statement", "initializer_list", "ERROR"}]
        called = self.text(node.child_by_field_name("function"))
        if args and bodies and called.isupper():
            # ARK_BUTCHER_TABLE(NAME, {…}): an entry of a list of macros
            inside = self.block(x for body in bodies for x in body.named_children)
            yield ir.Scope("entry", self.text(args[0]), inside, line_of(node))
            return
        if called in {"PetscCall", "CHKERRQ", "PetscCallVoid"} and len(args) == 1:
            yield from self.block(args)
            return
        yield ir.Do(self.expr(node), line_of(node))

    def expression(self, node: Node) -> ir.Expr:
        kind = node.type
        field = node.child_by_field_name
        inside = self.children(node)
        match kind:
            case "number_literal":
                return self._number(node)
            case "identifier" | "field_identifier" | "type_identifier" | "this" | "true" | "false":
                return ir.Name(self.text(node))
            case "qualified_identifier" | "primitive_type":
                return ir.Name(self.text(node).partition("<")[0])
            case "new_expression":
                return ir.Opaque("never assigned")
            case "null" | "nullptr":
                return ir.Nothing()
            case "parenthesized_expression" if inside:
                return self.expr(inside[0])
            case "binary_expression":
                sign = self.text(field("operator"))
                return ir.Binary(sign, self.expr(field("left")), self.expr(field("right")))
            case "unary_expression":
                return ir.Unary(self.text(field("operator")), self.expr(field("argument")))
            case "pointer_expression":
                return self._address(field("argument"))
            case "cast_expression":
                cast = ir.Name(self.text(field("type")).partition(" ")[0])
                value = self.expr(field("value"))
                is_whole = bool(_WHOLE_TYPES.search(cast.name))
                return value if is_whole else ir.Call(ir.Name("double"), (value,))
            case "compound_literal_expression" if inside:
                return self.expr(inside[-1])
            case "initializer_list":
                return self._initialiser(inside)
            case "call_expression":
                return self._called(node)
            case "field_expression":
                name = self.text(field("field")).partition("<")[0]
                return ir.Field(self.expr(field("argument")), name)
            case "subscript_expression":
                index = field("index") or field("indices")
                if index is not None and index.type == "subscript_argument_list":
                    index = next(iter(self.children(index)), None)
                return ir.Index(self.expr(field("argument")), (self.expr(index),))
            case "string_literal":
                return ir.Text(self.text(node).strip('"'))
            case "template_function" | "dependent_name" if inside:
                return self.expr(inside[0])
            case "template_method" | "template_type" if inside:
                return ir.Name(self.text(inside[0]))
        return unmeant(node)

    def _number(self, node: Node) -> ir.Expr:
        if self.text(node).startswith("-"):
            return ir.Unary("-", self._plain_number(self.text(node)[1:]))
        return self._plain_number(self.text(node))

    def _plain_number(self, printed: str) -> ir.Expr:
        found = _NUMBER.fullmatch(printed)
        if not found or not found["digits"]:
            return ir.Opaque(f"the number {printed[:20]}")
        text = found["digits"].replace("'", "")
        is_whole = text.isdigit() and (found["suffix"] or "").lower() not in {"f", "q"}
        return ir.Literal(text, is_whole)

    def _address(self, node: Node | None) -> ir.Expr:
        """``&A[0][0]`` is the array."""
        while node is not None and node.type == "subscript_expression":
            node = node.child_by_field_name("argument")
        return self.expr(node)

    def _initialiser(self, inside: list[Node]) -> ir.Expr:
        if any(x.type == "initializer_pair" for x in inside):
            pairs = [
                (x.named_children[0], x.named_children[-1]) for x in inside if x.named_children
            ]
            return ir.Fields(
                tuple((self.text(name).lstrip("."), self.expr(value)) for name, value in pairs)
            )
        return ir.Items(self.exprs(inside))

    def _called(self, node: Node) -> ir.Expr:
        callee = node.child_by_field_name("function")
        args = self.exprs(self.children(node.child_by_field_name("arguments")))
        if callee is not None and callee.type == "template_function":
            name = self.text(callee.child_by_field_name("name"))
            if name in _CASTS and len(args) == 1:
                return ir.Call(ir.Name("double"), args)
            return ir.Call(ir.Name(name), args)
        return ir.Call(self.expr(callee), args)


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
