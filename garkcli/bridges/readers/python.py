"""Python: arrays, lists and Fractions by their names, subclasses of scipy's RungeKutta."""

from __future__ import annotations

import ast
import re
import warnings
from collections import ChainMap
from collections.abc import Mapping, Sequence
from itertools import islice

from garkcli.bridges.readers.python_values import Literals, as_number, called, targets_of
from garkcli.sources.allowance import Allowance
from garkcli.sources.blocks import table_of_blocks
from garkcli.sources.found import FoundTable, Reader, Row, TooLarge, Unreadable, troubled
from garkcli.sources.naming import Scope
from garkcli.sources.scalars import Value, whole
from garkcli.sources.shaping import is_zero, square, total, weights

NAME = "python"
SCIPY = frozenset({"RungeKutta"})
_TABLEAUS = frozenset({"ButcherTableau", "_ButcherTableau"})
_WITH_VALUE = (ast.Assign, ast.AnnAssign, ast.Return, ast.Expr)
_WORD = re.compile(r"\w+|[^\w\s]")
MAX_WORDS = 500_000
"""Most words and signs of a source: its syntax tree has hundreds of bytes for each."""
MAX_NESTING = 30
"""Deepest nesting of classes and functions, and of dictionaries."""


def find(text: str, source: str) -> list[FoundTable]:
    """The tables of a Python source; it is parsed, never run.

    Raises:
        TooLarge: it has too many words, or says too much.
    """
    words = _WORD.finditer(text)
    beyond = next(islice(words, MAX_WORDS, None), None)
    if beyond is not None:
        line = text.count("\n", 0, beyond.start()) + 1
        raise TooLarge(f"the source has more than {MAX_WORDS} words and signs", line)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    finder = _Finder(text, source)
    try:
        finder.body(tree.body, Scope(), None)
    except RecursionError:
        return []
    return sorted(finder.found, key=lambda x: x.line)


class _Finder:
    def __init__(self, text: str, source: str) -> None:
        self.found: list[FoundTable] = []
        self._source = source
        self._names: ChainMap[str, Value] = ChainMap({})
        self._allowance = Allowance()
        self._literals = Literals(text, self._names, self._allowance)
        self._lines: dict[str, int] = {}
        self._depth = 0

    def body(self, statements: Sequence[ast.stmt], scope: Scope, node: ast.ClassDef | None) -> None:
        """One scope: a module, a class, a function."""
        self._depth += 1
        if self._depth > MAX_NESTING:
            self._depth -= 1
            return
        self._names.maps.insert(0, {})
        self._statements(statements, scope)
        own = self._names.maps[0]
        found = self._allowance.tables(scope.tables(self._source, NAME))
        if node is not None and _is_scipy(node):
            found = [self._allowance.table(_scipy(node, own, self._source))]
        line = self._lines.get("A", 1)
        blocks = table_of_blocks(own, self._source, NAME, scope.title, line)
        if blocks is not None:
            found = [self._allowance.table(blocks)]
        self.found += found
        self._names.maps.pop(0)
        self._depth -= 1

    def _statements(self, statements: Sequence[ast.stmt], scope: Scope) -> None:
        for node in statements:
            self._allowance.line = node.lineno
            match node:
                case ast.ClassDef(name=name, body=body):
                    self.body(body, Scope(name), node)
                case ast.FunctionDef(name=name, body=body):
                    self.body(body, Scope(name), None)
                case ast.If() | ast.With() | ast.For() | ast.While():
                    self._statements(node.body, scope)
                case ast.Try(body=body):
                    self._statements(body, scope)
                case ast.Import() | ast.ImportFrom():
                    self._literals.imported(node)
                case ast.Assign() | ast.AnnAssign():
                    self._assignment(node, scope)
            if isinstance(node, _WITH_VALUE):
                self._tableaus(node, scope)

    def _assignment(self, node: ast.Assign | ast.AnnAssign, scope: Scope) -> None:
        if node.value is None:
            return
        for target in targets_of(node):
            try:
                self._assign(target, node.value, scope, node.lineno)
            except Unreadable:
                continue

    def _assign(self, target: ast.expr, expression: ast.expr, scope: Scope, line: int) -> None:
        match target, expression:
            case ast.Tuple(elts=names), ast.Tuple(elts=values):
                if len(names) == len(values):
                    for one, its in zip(names, values, strict=True):
                        self._assign(one, its, scope, line)
                return
            case ast.Subscript(value=ast.Name(id=array), slice=place), _:
                self._put(array, place, self._allowance.kept(self._literals.value(expression)))
                scope.add(array, self._names[array], line)
                return
        name = _plain_name(target)
        if not name:
            return
        value = self._allowance.kept(self._literals.value(expression))
        self._names[name] = value
        self._lines[name] = line
        scope.add(name, value, line)

    def _put(self, name: str, place: ast.expr, value: Value) -> None:
        """``A[1, 0] = …`` and ``A[2, :2] = …`` of an array that is known."""
        array = self._names.get(name)
        indices = place.elts if isinstance(place, ast.Tuple) else [place]
        for item in indices[:-1]:
            index = whole(self._literals.value(item))
            if not isinstance(array, list) or index is None:
                raise Unreadable("an entry of what is no list")
            if not 0 <= index < len(array):
                raise Unreadable("an entry that is not there")
            array = array[index]
        if not isinstance(array, list):
            raise Unreadable("an entry of what is no list")
        _set(array, indices[-1], value, self._literals)

    def _dictionaries(self, name: str, node: ast.expr, depth: int = 0) -> None:
        """Tables as ``{"A": …, "b": …}``: one, lists of them, and those under other keys."""
        if depth > MAX_NESTING:
            return
        match node:
            case ast.Dict():
                self._dictionary(name, node, depth)
            case ast.List(elts=items) | ast.Tuple(elts=items):
                for item in items:
                    self._dictionaries(name, item, depth + 1)
            case ast.Call(func=ast.Name(id="dict"), args=[]):
                self._of_keywords(name, node)

    def _dictionary(self, name: str, node: ast.Dict, depth: int) -> None:
        scope = Scope(name)
        for key, expression in zip(node.keys, node.values, strict=True):
            if not isinstance(key, ast.Constant):
                continue
            if not isinstance(key.value, str):
                continue
            try:
                value = _listed(self._literals.value(expression))
            except Unreadable:
                self._dictionaries(key.value, expression, depth + 1)
                continue
            scope.add(key.value, self._allowance.kept(value), node.lineno)
        self.found += self._allowance.tables(scope.tables(self._source, NAME))

    def _tableaus(self, node: ast.stmt, scope: Scope) -> None:
        """``ButcherTableau(c=…, b_sol=…, a_lower=…)`` of other libraries; dictionaries."""
        value = getattr(node, "value", None)
        name = scope.title
        for target in targets_of(node):
            name = _plain_name(target) or name
        if isinstance(value, ast.Call) and called(value) in _TABLEAUS:
            self._of_keywords(name, value)
        elif isinstance(value, ast.expr):
            self._dictionaries(name, value)

    def _of_keywords(self, name: str, call: ast.Call) -> None:
        inner = Scope(name)
        for keyword in call.keywords:
            try:
                found = _listed(self._literals.value(keyword.value))
            except Unreadable:
                continue
            inner.add(keyword.arg or "", self._allowance.kept(found), call.lineno)
        self.found += self._allowance.tables(inner.tables(self._source, NAME))


def _listed(value: Value) -> Value:
    """Numbers that are written as texts in lists; a text alone may be a name."""
    return as_number(value) if isinstance(value, list) else value


def _set(array: list[Value], place: ast.expr, value: Value, literals: Literals) -> None:
    if not isinstance(place, ast.Slice):
        index = whole(literals.value(place))
        if index is None or not 0 <= index < len(array):
            raise Unreadable("an entry that is not there")
        if isinstance(array[index], list) != isinstance(value, list):
            raise Unreadable("a row and a number")
        array[index] = value
        return
    if place.step is not None or not isinstance(value, list):
        raise Unreadable("a slice with steps")
    first = 0 if place.lower is None else whole(literals.value(place.lower))
    if first is None or not 0 <= first <= len(array) - len(value):
        raise Unreadable("an entry that is not there")
    if place.upper is not None:
        last = whole(literals.value(place.upper))
        if last != first + len(value):
            raise Unreadable("a slice of another length")
    array[first : first + len(value)] = value


def _plain_name(target: ast.expr) -> str:
    match target:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=ast.Name(id="self" | "cls"), attr=name):
            return name
    return ""


def _is_scipy(node: ast.ClassDef) -> bool:
    names = set()
    for base in node.bases:
        match base:
            case ast.Name(id=name) | ast.Attribute(attr=name):
                names.add(name)
    has_table = {"A", "B", "C"} <= _assigned(node)
    return bool(names & SCIPY) and has_table


def _assigned(node: ast.ClassDef) -> set[str]:
    found = set()
    for statement in node.body:
        for target in targets_of(statement):
            items = target.elts if isinstance(target, ast.Tuple) else [target]
            found |= {_plain_name(item) for item in items}
    return found


def _scipy(node: ast.ClassDef, values: Mapping[str, Value], source: str) -> FoundTable:
    """A subclass of scipy's RungeKutta: E has one entry more, that of f(t + h, y_new).

    E is b̂ − b in the classes of scipy. The other sign, which some have, changes no order.
    """
    order = whole(values.get("order"))
    embedded_order = whole(values.get("error_estimator_order"))
    line = node.lineno
    empty = FoundTable(source, line, NAME, node.name, (), (), order=order)
    try:
        b = weights(values.get("B"))
        c = weights(values.get("C"), len(b))
        A = square(values.get("A"), len(b))
        error = None
        if isinstance(values.get("E"), list):
            error = weights(values["E"])
    except Unreadable as trouble:
        return troubled(empty, trouble.message)
    stages = whole(values.get("n_stages"))
    if stages is not None and stages != len(b):
        return troubled(empty, f"n_stages is {stages}, B has {len(b)}")
    embedded: Row | None = None
    if error is not None and len(error) == len(b) + 1:
        if not is_zero(error[-1]):
            # the last stage of such a method is the first of the next step
            A = (*((*row, "0") for row in A), (*b, "0"))
            c = (*c, "1")
            b = (*b, "0")
            embedded = total(b, error)
        else:
            embedded = total(b, error[:-1])
    elif error is not None:
        return troubled(empty, f"E has {len(error)} entries, B has {len(b)}")
    return FoundTable(
        source,
        line,
        NAME,
        node.name,
        ((A,),),
        (b,),
        (c,),
        embedded=None if embedded is None else (embedded,),
        order=order,
        embedded_order=embedded_order,
    )


READER = Reader(
    NAME, "Python: NumPy arrays, lists, Fractions, scipy's RungeKutta", (".py", ".pyi"), find
)
