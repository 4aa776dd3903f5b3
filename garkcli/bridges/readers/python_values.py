"""Literals of Python as values: a white list of syntax, read from the tree and never evaluated."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from itertools import chain

from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, Unreadable
from garkcli.sources.scalars import Scalar, Value, negated, number, of_text, power, rooted, whole

MAX_DEPTH = 60
"""Deepest nesting of expressions."""
_SAME = frozenset(
    {
        *("array", "asarray", "Matrix", "float64", "float32", "longdouble"),
        *("tensor", "float", "mpf", "Decimal", "Float", "S", "sympify", "str"),
        *("tuple", "list", "int", "Integer", "as_tensor", "mpfr", "fmpz"),
        *("ImmutableMatrix", "freeze", "astype", "copy", "array_from"),
    }
)
_FRACTIONS = frozenset({"Fraction", "Rational", "fmpq", "mpq", "QQ", "R"})
_ROOTS = {"sqrt": 2, "cbrt": 3}
_SIGNS: Mapping[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}


class Literals:
    """Reads values from the syntax tree of one source.

    Args:
        text: the source, for digits that a float would lose.
        names: what names stand for.
        allowance: of the source.
    """

    def __init__(self, text: str, names: Mapping[str, Value], allowance: Allowance) -> None:
        self._lines = text.encode().split(b"\n")
        self._aliases: dict[str, str] = {}
        self.names = names
        self._allowance = allowance
        self._depth = 0

    def imported(self, node: ast.Import | ast.ImportFrom) -> None:
        """Note what a module calls what it imports: ``from fractions import Fraction as F``."""
        for alias in node.names:
            if alias.asname:
                self._aliases[alias.asname] = alias.name.rpartition(".")[2]

    def value(self, node: ast.expr) -> Value:
        """The value of an expression.

        Raises:
            Unreadable: it has something in it that is not on the white list.
        """
        self._depth += 1
        try:
            if self._depth > MAX_DEPTH:
                raise Unreadable(f"nested more than {MAX_DEPTH} deep")
            return self._value(node)
        finally:
            self._depth -= 1

    def _value(self, node: ast.expr) -> Value:
        match node:
            case ast.Constant():
                return self._constant(node)
            case ast.List(elts=items) | ast.Tuple(elts=items):
                return [self.value(item) for item in items]
            case ast.Name() | ast.Attribute(value=ast.Name(id="self")):
                return self._allowance.copied(self._known(node))
            case ast.Attribute(attr="T", value=inner):
                return self._allowance.transposed(self.value(inner))
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return negated(self.value(operand))
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.value(operand)
            case ast.BinOp():
                return self._operation(node)
            case ast.Call():
                return self._call(node)
            case ast.Subscript(value=inner, slice=index):
                indices = [index]
                while isinstance(inner, ast.Subscript):
                    indices.insert(0, inner.slice)
                    inner = inner.value
                return self._allowance.copied(self._entry(self._known(inner), indices))
        raise Unreadable("this is no literal")

    def _known(self, node: ast.expr) -> Value:
        """What a name stands for, the list itself; the value of any other expression."""
        match node:
            case ast.Name(id=name) | ast.Attribute(value=ast.Name(id="self"), attr=name):
                if name not in self.names:
                    raise Unreadable(f"{name} has no value that is known")
                return self.names[name]
        return self.value(node)

    def _constant(self, node: ast.Constant) -> Value:
        value = node.value
        if value is None or isinstance(value, str):
            return value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise Unreadable("this is no real number")
        text = self._source(node).replace("_", "").lower()
        if text.startswith("."):
            text = f"0{text}"
        return number(text)

    def _source(self, node: ast.Constant) -> str:
        """The digits as they are written; offsets of the tree count bytes."""
        if node.end_lineno != node.lineno:
            raise Unreadable("a number in two lines")
        line = self._lines[node.lineno - 1]
        return line[node.col_offset : node.end_col_offset].decode()

    def _operation(self, node: ast.BinOp) -> Value:
        left = self.value(node.left)
        right = self.value(node.right)
        if isinstance(node.op, ast.Pow):
            return power(left, right)
        sign = _SIGNS.get(type(node.op))
        if sign is None:
            raise Unreadable("this is no operation of coefficients")
        if sign == "*" and isinstance(left, list):
            return self._repeated(left, right)
        return self._allowance.combined(sign, left, right)

    def _repeated(self, items: list[Value], times: Value) -> Value:
        """``[0] * 3``, a list three times; that of an array is another matter, and refused."""
        count = whole(times)
        is_plain = len(items) == 1 and isinstance(items[0], Scalar)
        if not is_plain or count is None or not 0 <= count <= MAX_STAGES:
            return self._allowance.combined("*", items, times)
        return self._allowance.kept(items * count)

    def _call(self, node: ast.Call) -> Value:
        name = called(node)
        name = self._aliases.get(name, name)
        if isinstance(node.func, ast.Attribute) and not node.args:
            return self._of_method(node.func)
        if not node.args:
            raise Unreadable(f"the function {name} is not known")
        first = self.value(node.args[0])
        if name in _FRACTIONS and len(node.args) == 2:
            return self._allowance.combined("/", first, self.value(node.args[1]))
        if name in _ROOTS:
            return rooted(as_number(first), _ROOTS[name])
        if name == "zeros":
            return self._allowance.zeros(_sizes(first))
        if name in _SAME or name in _FRACTIONS:
            return as_number(first)
        raise Unreadable(f"the function {name} is not known")

    def _of_method(self, function: ast.Attribute) -> Value:
        if function.attr == "transpose":
            return self._allowance.transposed(self.value(function.value))
        if function.attr in _SAME:
            return self.value(function.value)
        raise Unreadable(f"the method {function.attr} is not known")

    def _entry(self, value: Value, indices: Sequence[ast.expr]) -> Value:
        for item in chain.from_iterable(
            x.elts if isinstance(x, ast.Tuple) else [x] for x in indices
        ):
            place = whole(self.value(item))
            if not isinstance(value, list) or place is None:
                raise Unreadable("an entry of what is no list")
            if not -len(value) <= place < len(value):
                raise Unreadable("an entry that is not there")
            value = value[place]
        return value


def called(node: ast.Call) -> str:
    """The last word of what is called: ``array`` of ``np.array``."""
    match node.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ""


def as_number(value: Value) -> Value:
    """A text in quotes as the number that it is."""
    if isinstance(value, str):
        return of_text(value)
    if isinstance(value, list):
        return [as_number(x) for x in value]
    return value


def _sizes(shape: Value) -> list[int]:
    """``3``, ``(3, 3)``."""
    sizes = [whole(shape)]
    if isinstance(shape, list):
        sizes = [whole(x) for x in shape]
    found = [size for size in sizes if size is not None]
    if len(found) < len(sizes):
        raise Unreadable("a shape that is not written out")
    return found


def targets_of(node: ast.stmt) -> Sequence[ast.expr]:
    """What an assignment assigns to."""
    match node:
        case ast.Assign(targets=targets):
            return targets
        case ast.AnnAssign(target=target, value=value) if value is not None:
            return [target]
    return ()
