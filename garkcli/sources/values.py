"""The values of expressions in sources: exact numbers with their printed digits, arrays, records,
and unknown values with their reasons.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import repeat
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard

from flint import fmpq

from garkcli.errors import ExpressionError
from garkcli.exact.expression import read_decimal
from garkcli.frozen import Frozen, Mutable, field
from garkcli.sources.found import MAX_LENGTH
from garkcli.sources.scalars import ATOM, PRODUCT, Scalar, combined, negated, number, rooted

if TYPE_CHECKING:
    from garkcli.sources.ir import Expr

FEWEST_DIGITS = 6
"""Decimals with so many digits may be rounded, so their text is kept."""
MAX_BITS = 20_000
"""Most bits of the numerator and the denominator of a number."""
MAX_POWER = 200


class Unknown(Frozen):
    """An unknown value with its reason; values computed from it are unknown for the same reason.

    Attributes:
        reason: in words.
        line: of the reason.
        was_written: whether there was a written number before.
    """

    reason: str
    line: int = 0
    was_written: bool = False


class Number(Frozen, eq=False):
    """A number.

    Attributes:
        value: as printed; None for an irrational number.
        near: the nearest float, for its size only.
        written: its text if that has more information than the value.
        is_whole: whether it divides as an integer.
    """

    value: fmpq | None
    near: float
    written: Scalar | None = None
    is_whole: bool = False

    @property
    def is_given(self) -> bool:
        """Whether it was written, unlike the zeros with which C fills arrays."""
        return self is not FILL

    @cached_property
    def scalar(self) -> Scalar:
        return number(str(self.value)) if self.written is None else self.written

    @property
    def is_zero(self) -> bool:
        """Whether it is exactly 0."""
        return self.value is not None and not self.value


class Array(Mutable, eq=False):
    """Values in order; the rows for a matrix.

    Attributes:
        items: the values.
        is_growing: whether assignments behind its end extend it.
        fill: the value of entries without an assignment.
    """

    items: list[Value]
    is_growing: bool = False
    fill: Value | None = None

    @property
    def is_matrix(self) -> bool:
        """Whether all its items are arrays."""
        return bool(self.items) and all(isinstance(x, Array) for x in self.items)

    def flat(self) -> Iterator[Value]:
        """The entries row by row."""
        for x in self.items:
            if isinstance(x, Array):
                yield from x.flat()
            else:
                yield x

    def map(self, change: Callable[[Value], Value]) -> Array:
        """The array with every entry passed to ``change``."""
        items = [x.map(change) if isinstance(x, Array) else change(x) for x in self.items]
        return Array(items, self.is_growing, self.fill)


class SourceRecord(Mutable, eq=False):
    """Values by name: of a structure, of a dictionary; or a call with its arguments.

    Attributes:
        kind: the name of the call that makes it; empty for a record without a name.
        fields: the values by name.
        args: the positional values.
        line: of its construction.
        key: its key in the record around it; empty for others.
    """

    kind: str
    fields: dict[str, Value] = field(default_factory=dict)
    args: Sequence[Value] = ()
    line: int = 0
    key: str = ""


class Word(Frozen):
    """A text in quotes, or a symbol."""

    text: str


class Null(Frozen):
    """Nothing: ``NULL``, ``None``, ``nothing``."""


class Type(Frozen):
    """A type: a call of it is a conversion. Its name is that of a known function, or empty."""

    name: str = ""


class Function(Frozen, eq=False):
    """A function of one expression, with the names visible in it."""

    parameters: tuple[str, ...]
    body: Expr
    space: Space


class Form(Frozen, eq=False):
    """A polynomial in unknown values: the coefficient of each product of their names, which are
    sorted.
    """

    terms: Terms


Value: TypeAlias = Number | Unknown | Array | SourceRecord | Word | Null | Type | Function | Form
Terms: TypeAlias = Mapping[tuple[str, ...], Value]
NULL = Null()


def exact(value: fmpq, is_whole: bool = False) -> Number:
    """A rational number that is known exactly."""
    return Number(value, _near(value), is_whole=is_whole)


def _near(value: fmpq) -> float:
    try:
        return int(value.p) / int(value.q)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


ZERO = exact(fmpq(0), is_whole=True)
ONE = exact(fmpq(1), is_whole=True)
FILL = exact(fmpq(0), is_whole=True)
"""A zero that was not written."""


def integer(n: int) -> Number:
    return exact(fmpq(n), is_whole=True)


def literal(text: str, line: int, is_whole: bool = False) -> Value:
    """The exact value of a printed number."""
    plain = text.strip().lower().replace("_", "").removeprefix("+")
    if plain.startswith("-"):
        return negative(literal(plain[1:], line, is_whole), line)
    try:
        value = read_decimal(plain)
    except (ExpressionError, ValueError):
        return Unknown(f"the number {text[:20]}", line)
    digits, _, _ = plain.partition("e")
    if "." in digits and len(digits.replace(".", "").lstrip("0")) >= FEWEST_DIGITS:
        return Number(value, _near(value), number(plain))
    return exact(value, is_whole)


_OPERATIONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def computed(sign: str, x: Value, y: Value, line: int) -> Value:
    """The value of an operation on two numbers; unknown if one of them is."""
    for operand in (x, y):
        if isinstance(operand, Unknown):
            return operand
        if not isinstance(operand, Number):
            return Unknown(f"an operation on {described(operand)}", line)
    assert isinstance(x, Number)
    assert isinstance(y, Number)
    if sign in {"^", "**"}:
        return _power(x, y, line)
    operation = _OPERATIONS.get(sign)
    if operation is None:
        return Unknown(f"the operator {sign}", line)
    if sign == "/" and not y.near:
        return Unknown("a division by zero", line)
    value = None
    if x.value is not None and y.value is not None:
        value = operation(x.value, y.value)
        if x.written is None and y.written is None and not _is_long(value):
            return exact(value, x.is_whole and y.is_whole and sign != "/")
    if x.is_zero:
        return ZERO if sign in "*/" else y if sign == "+" else negative(y, line)
    if y.is_zero:
        return ZERO if sign == "*" else x
    text = combined(sign, x.scalar, y.scalar)
    return _written(value, operation(x.near, y.near), text, line)


def _written(value: fmpq | None, near: float, text: Scalar, line: int) -> Value:
    """A number with its text; unknown if it is too long."""
    if len(text.text) > MAX_LENGTH or (value is not None and _is_long(value)):
        return Unknown(f"a number of more than {MAX_LENGTH} characters", line)
    return Number(value, near, text)


def _is_long(value: fmpq) -> bool:
    return max(int(value.p).bit_length(), int(value.q).bit_length()) > MAX_BITS


def truncated(x: Value, y: Value, line: int) -> Value:
    """The quotient of integers in C."""
    if not isinstance(x, Number) or not isinstance(y, Number) or x.value is None or not y.value:
        return Unknown("a quotient of whole numbers", line)
    ratio = x.value / y.value
    return exact(fmpq(int(ratio.floor() if ratio > 0 else ratio.ceil())), is_whole=True)


def negative(x: Value, line: int) -> Value:
    """The number with the other sign."""
    if isinstance(x, Array):
        return x.map(lambda y: negative(y, line))
    if not isinstance(x, Number):
        return x if isinstance(x, Unknown) else Unknown(f"a sign before {described(x)}", line)
    text = None if x.written is None else negated(x.written)
    return Number(None if x.value is None else -x.value, -x.near, text, x.is_whole)


def real(value: Value) -> Value:
    """The number as a real one in divisions; also for arrays."""
    if isinstance(value, Array):
        return value.map(real)
    if isinstance(value, Number) and value.is_whole and value is not FILL:
        return Number(value.value, value.near, value.written)
    return value


def _power(x: Number, y: Number, line: int) -> Value:
    if y.value is None or abs(y.near) > MAX_POWER:
        return Unknown("a power that is too high, or none of rational exponent", line)
    p, q = int(y.value.p), int(y.value.q)
    base = x if q == 1 else root(x, q, line)
    if not isinstance(base, Number) or abs(p) < 2:
        power: Value = ONE if not p else base
    else:
        value = None if base.value is None else base.value ** abs(p)
        text = Scalar(f"{base.scalar.inside(ATOM)}**{abs(p)}", PRODUCT)
        power = _written(value, math.prod([base.near] * abs(p)), text, line)
        if value is not None and base.written is None and isinstance(power, Number):
            power = exact(value, base.is_whole)
    return computed("/", ONE, power, line) if p < 0 else power


def root(x: Value, index: int, line: int) -> Value:
    """A root, exactly: a rational number if it is one."""
    if not isinstance(x, Number):
        return x if isinstance(x, Unknown) else Unknown(f"a root of {described(x)}", line)
    if (x.near < 0 and index % 2 == 0) or not 1 < index <= 12:
        return Unknown("a root that is no real number", line)
    if x.value is not None and x.written is None:
        p, q = (_whole_root(abs(int(n)), index) for n in (x.value.p, x.value.q))
        if p is not None and q is not None:
            return exact(fmpq(-p if x.near < 0 else p, q))
    near = math.copysign(abs(x.near) ** (1 / index), x.near)
    return _written(None, near, rooted(x.scalar, index), line)


def _whole_root(n: int, index: int) -> int | None:
    if n.bit_length() > MAX_BITS:
        return None
    if index == 2:
        floor_root = math.isqrt(n)
        return floor_root if floor_root**2 == n else None
    near = round(n ** (1 / index)) if n.bit_length() < 1000 else 0
    return near if near**index == n else None


def described(value: Value) -> str:
    """A value in words."""
    match value:
        case Unknown(reason=reason):
            return reason
        case SourceRecord(kind=kind) if kind:
            return f"the call {kind}"
        case Array():
            return "an array"
        case Word(text=text):
            return f"the text {text[:20]!r}"
        case Null():
            return "nothing"
    return "what is no number"


def whole(value: Value | None) -> int | None:
    """An integer of moderate size; None for other values."""
    if not isinstance(value, Number) or value.value is None or value.value.q != 1:
        return None
    return int(value.value.p) if abs(value.near) < 10**6 else None


def transposed(value: Value, line: int) -> Value:
    """A matrix with its rows as columns; a row as a column."""
    if not isinstance(value, Array):
        return value
    rows = [x.items for x in value.items if isinstance(x, Array)]
    if not rows:
        return Array([Array([x]) for x in value.items])
    lengths = {len(x) for x in rows}
    if len(rows) != len(value.items) or len(lengths) != 1:
        return Unknown("a transpose of what is no matrix", line)
    if lengths == {1}:
        return Array([x[0] for x in rows])
    return Array([Array(list(x)) for x in zip(*rows, strict=True)])


def items_of(value: Value | None) -> list[Value]:
    """The items of an array; empty for other values."""
    return value.items if isinstance(value, Array) else []


def is_matrix(value: Value | None) -> TypeGuard[Array]:
    """Whether it is an array of arrays."""
    return isinstance(value, Array) and value.is_matrix


def near(*values: Value | None) -> float:
    """The approximate sum of all numbers in some values."""
    return sum(x.near for x in Array([x for x in values if x]).flat() if isinstance(x, Number))


def is_zero(value: Value | None) -> bool:
    return isinstance(value, Number) and value.is_zero


def is_written(value: Value | None) -> bool:
    """Whether it or a part of it was written in the source, unlike the zeros of new arrays."""
    if isinstance(value, Array):
        return any(map(is_written, value.flat()))
    return value is not None and not (isinstance(value, Number) and not value.is_given)


def first_unknown(value: Value) -> Unknown | None:
    """The first unknown part of a value."""
    if isinstance(value, Unknown):
        return value
    if isinstance(value, Array):
        return next(filter(None, map(first_unknown, value.items)), None)
    if isinstance(value, (Number, Null)):
        return None
    return Unknown(described(value), getattr(value, "line", 0))


MAX_LEVELS = 100
"""Deepest nesting of values."""


def size(value: Value, level: int = 0) -> int:
    """The approximate number of characters of a value when written out.

    Raises:
        RecursionError: values are nested too deep.
    """
    if level > MAX_LEVELS:
        raise RecursionError
    if isinstance(value, Array):
        return 1 + sum(map(size, value.items, repeat(level + 1)))
    if isinstance(value, SourceRecord):
        return 1 + sum(map(size, (*value.fields.values(), *value.args), repeat(level + 1)))
    if not isinstance(value, Number):
        return 1
    if value.written is not None:
        return 1 + len(value.written.text)
    assert value.value is not None
    bits = int(value.value.p).bit_length() + int(value.value.q).bit_length()
    return 2 + bits * 3 // 10


class Space(dict[str, Value]):
    """The names of a scope.

    Attributes:
        up: the scope around it, which is only read.
        calls: records made so far.
        lines: of the first assignments to names.
        returned: the value of the function; None before its return.
    """

    def __init__(self, up: Space | None = None) -> None:
        super().__init__()
        self.up = up
        self.calls: list[SourceRecord] = []
        self.lines: dict[str, int] = {}
        self.returned: Value | None = None

    def find(self, name: str) -> Value | None:
        """The value of a name, here or in a scope around."""
        space: Space | None = self
        while space is not None:
            if name in space:
                return space[name]
            space = space.up
        return None

    def fork(self) -> Space:
        """A copy with its own values."""
        other = Space(self.up)
        other.update({name: copied(value) for name, value in self.items()})
        other.calls, other.lines = list(self.calls), dict(self.lines)
        return other


def copied(value: Value) -> Value:
    """A copy with its own arrays and fields."""
    if isinstance(value, Array):
        return value.map(copied)
    if isinstance(value, SourceRecord):
        fields = {name: copied(x) for name, x in value.fields.items()}
        return SourceRecord(value.kind, fields, value.args, value.line, value.key)
    return value
