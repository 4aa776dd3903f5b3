"""What expressions of sources are: exact numbers with the digits they were printed with, arrays,
records, and what is unknown with the reason.
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
    from garkcli.sources.evaluate import Space
    from garkcli.sources.ir import Expr

FEWEST_DIGITS = 6
"""A decimal of so many digits may be rounded: its text is kept."""
MAX_BITS = 20_000
"""Of the numerator and the denominator of a number."""
MAX_POWER = 200


class Unknown(Frozen):
    """An unknown value, and why: all that is computed from it is unknown for the same reason.

    Attributes:
        reason: why.
        line: where.
        was_written: whether a number was written there before.
    """

    reason: str
    line: int = 0
    was_written: bool = False


class Number(Frozen, eq=False):
    """A number.

    Attributes:
        value: as it is printed; None for an irrational one.
        near: the float next to it, for sizes alone.
        written: its text where that says more than the value.
        is_whole: whether dividing it by a whole number gives a whole number.
    """

    value: fmpq | None
    near: float
    written: Scalar | None = None
    is_whole: bool = False

    @property
    def is_given(self) -> bool:
        """Whether it was written; what C fills an array with was not."""
        return self is not FILL

    @cached_property
    def scalar(self) -> Scalar:
        """The text of a coefficient."""
        return number(str(self.value)) if self.written is None else self.written

    @property
    def is_zero(self) -> bool:
        """Whether it is exactly 0."""
        return self.value is not None and not self.value


class Array(Mutable, eq=False):
    """Values in order; those of a matrix are its rows.

    Attributes:
        items: the values.
        is_growing: whether what is assigned behind its end makes it longer.
        fill: the value of entries that nobody assigned before.
    """

    items: list[Value]
    is_growing: bool = False
    fill: Value | None = None

    @property
    def is_matrix(self) -> bool:
        """Whether all of it are arrays."""
        return bool(self.items) and all(isinstance(x, Array) for x in self.items)

    def flat(self) -> Iterator[Value]:
        """What is in it, row by row."""
        for x in self.items:
            if isinstance(x, Array):
                yield from x.flat()
            else:
                yield x

    def map(self, change: Callable[[Value], Value]) -> Array:
        """The same with other entries."""
        items = [x.map(change) if isinstance(x, Array) else change(x) for x in self.items]
        return Array(items, self.is_growing, self.fill)


class Record(Mutable, eq=False):
    """Values by name: of a structure, of a dictionary; or a call with its arguments.

    Attributes:
        kind: what makes it; empty for a record without a name.
        fields: the values by name.
        args: those by place.
        line: where it is made.
        key: what it is called in the record that it is in; empty for others.
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
    """A type: to call it is to convert. Its name is that of a known function, or empty."""

    name: str = ""


class Function(Frozen, eq=False):
    """A function of one expression, with the names that it sees."""

    parameters: tuple[str, ...]
    body: Expr
    space: Space


class Form(Frozen, eq=False):
    """A polynomial in unknown values, by their names: what is before each product of names, these
    in order.
    """

    terms: Terms


Value: TypeAlias = Number | Unknown | Array | Record | Word | Null | Type | Function | Form
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
"""A zero that nobody wrote."""


def integer(n: int) -> Number:
    """A whole number."""
    return exact(fmpq(n), is_whole=True)


def literal(text: str, line: int, is_whole: bool = False) -> Value:
    """The number that is printed, exactly as it is printed."""
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
    """The value of two numbers with a sign between them; unknown where one of them is."""
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
    """A number with its text."""
    if len(text.text) > MAX_LENGTH or (value is not None and _is_long(value)):
        return Unknown(f"a number of more than {MAX_LENGTH} characters", line)
    return Number(value, near, text)


def _is_long(value: fmpq) -> bool:
    return max(int(value.p).bit_length(), int(value.q).bit_length()) > MAX_BITS


def truncated(x: Value, y: Value, line: int) -> Value:
    """The quotient of whole numbers as C has it."""
    if not isinstance(x, Number) or not isinstance(y, Number) or x.value is None or not y.value:
        return Unknown("a quotient of whole numbers", line)
    found = x.value / y.value
    return exact(fmpq(int(found.floor() if found > 0 else found.ceil())), is_whole=True)


def negative(x: Value, line: int) -> Value:
    """The number with the other sign."""
    if isinstance(x, Array):
        return x.map(lambda y: negative(y, line))
    if not isinstance(x, Number):
        return x if isinstance(x, Unknown) else Unknown(f"a sign before {described(x)}", line)
    text = None if x.written is None else negated(x.written)
    return Number(None if x.value is None else -x.value, -x.near, text, x.is_whole)


def real(value: Value) -> Value:
    """A number that divides as real ones do; an array of such."""
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
        found: Value = ONE if not p else base
    else:
        value = None if base.value is None else base.value ** abs(p)
        text = Scalar(f"{base.scalar.inside(ATOM)}**{abs(p)}", PRODUCT)
        found = _written(value, math.prod([base.near] * abs(p)), text, line)
        if value is not None and base.written is None and isinstance(found, Number):
            found = exact(value, base.is_whole)
    return computed("/", ONE, found, line) if p < 0 else found


def root(x: Value, index: int, line: int) -> Value:
    """A root, exactly: a rational number where it is one."""
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
        found = math.isqrt(n)
        return found if found**2 == n else None
    near = round(n ** (1 / index)) if n.bit_length() < 1000 else 0
    return near if near**index == n else None


def described(value: Value) -> str:
    """What a value is, in words."""
    match value:
        case Unknown(reason=reason):
            return reason
        case Record(kind=kind) if kind:
            return f"the call {kind}"
        case Array():
            return "an array"
        case Word(text=text):
            return f"the text {text[:20]!r}"
        case Null():
            return "nothing"
    return "what is no number"


def whole(value: Value | None) -> int | None:
    """A whole number of moderate size; None for anything else."""
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
    """What is in an array; nothing in other values."""
    return value.items if isinstance(value, Array) else []


def is_matrix(value: Value | None) -> TypeGuard[Array]:
    """Whether it is an array of arrays."""
    return isinstance(value, Array) and value.is_matrix


def near(*values: Value | None) -> float:
    """About the sum of all numbers in some values."""
    return sum(x.near for x in Array([x for x in values if x]).flat() if isinstance(x, Number))


def is_zero(value: Value | None) -> bool:
    """Whether it is the number 0."""
    return isinstance(value, Number) and value.is_zero


def is_written(value: Value | None) -> bool:
    """Whether somebody wrote it, or a part of it: it is more than the zeros of an array."""
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
    """About how many characters a value has when it is written out.

    Raises:
        RecursionError: values are nested too deep.
    """
    if level > MAX_LEVELS:
        raise RecursionError
    if isinstance(value, Array):
        return 1 + sum(map(size, value.items, repeat(level + 1)))
    if isinstance(value, Record):
        return 1 + sum(map(size, (*value.fields.values(), *value.args), repeat(level + 1)))
    if not isinstance(value, Number):
        return 1
    if value.written is not None:
        return 1 + len(value.written.text)
    assert value.value is not None
    bits = int(value.value.p).bit_length() + int(value.value.q).bit_length()
    return 2 + bits * 3 // 10


def copied(value: Value) -> Value:
    """The same with arrays and fields of its own."""
    if isinstance(value, Array):
        return value.map(copied)
    if isinstance(value, Record):
        fields = {name: copied(x) for name, x in value.fields.items()}
        return Record(value.kind, fields, value.args, value.line, value.key)
    return value
