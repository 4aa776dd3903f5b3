"""Functions in sources with known values: conversions, roots, arrays of zeros, shapes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Protocol, TypeAlias

from flint import arb, fmpq, fmpz_poly

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, Unreadable
from garkcli.sources.scalars import DIGITS_OF_ROOTS, Scalar, real_root
from garkcli.sources.values import (
    FILL,
    NULL,
    ONE,
    ZERO,
    Array,
    Function,
    Number,
    SourceRecord,
    Type,
    Unknown,
    Value,
    Word,
    computed,
    copied,
    exact,
    integer,
    items_of,
    literal,
    real,
    root,
    size,
    transposed,
    whole,
)


class Machine(Protocol):
    """The reader of a source, for calls of known functions."""

    base: int
    line: int
    allowance: Allowance

    def array(self, items: Iterable[Value]) -> Array: ...

    def unknown(self, reason: str) -> Unknown: ...

    def combined(self, sign: str, x: Value, y: Value) -> Value: ...

    def applied(self, function: Function, args: Sequence[Value]) -> Value: ...


class KnownCall(Frozen):
    """A call of a known function with its evaluated arguments."""

    name: str
    expr: ir.Call
    named: Mapping[str, Value]
    evaluator: Machine

    @property
    def line(self) -> int:
        """The line of the call."""
        return self.evaluator.line

    def unknown(self, reason: str = "") -> Unknown:
        """The value if this call is not known."""
        return self.evaluator.unknown(reason or f"the call {self.name}")

    def array(self, items: Iterable[Value]) -> Array:
        """An array of its language."""
        return self.evaluator.array(items)

    def filled(self, fill: Value, *sizes: int) -> Array:
        """An array filled with one value."""
        self.evaluator.allowance.spend(2 * math.prod(max(n, 1) for n in sizes))
        row = [fill] * sizes[-1]
        return self.array(row if len(sizes) == 1 else (self.array(row) for _ in range(sizes[0])))


Known: TypeAlias = Callable[..., Value | None]
"""The value of a call with these arguments; None if another function of that name is meant."""

PI = Number(None, math.pi, written=Scalar("pi"))
"""π occurs in angles, never as a coefficient."""
CONSTANTS: Mapping[str, Value] = {
    **dict.fromkeys(("NULL", "nullptr", "nothing", "None", "missing", "PETSC_NULLPTR"), NULL),
    **{name: Word("true") for name in ("true", "True", "SUNTRUE", "PETSC_TRUE")},
    **{name: Word("false") for name in ("false", "False", "SUNFALSE", "PETSC_FALSE")},
    **{
        f"{name}{n}": root(integer(n), 2, 0)
        for n in (2, 3, 5, 6, 7, 10, 15, 21)
        for name in ("sqrt", "sqrt_", "SQRT", "SQRT_", "M_SQRT")
    },
    **dict.fromkeys(("pi", "PI", "M_PI", "π"), PI),
    "#": Number(None, math.nan, written=Scalar("x")),
}
"""Names with the same meaning in all languages; ``#`` is the variable of a polynomial."""
_CARDINALS = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve"),
)
_PARTS = (
    *("half", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"),
    *("eleventh", "twelfth"),
)
_COUNTS = {word: n for n, word in enumerate(_CARDINALS)}
_DIVISORS = {word: n for n, word in enumerate(_PARTS, start=2)} | {
    "quarter": 4,
    "halve": 2,
    "fifteenth": 15,
    "sixteenth": 16,
    "eighteenth": 18,
    "twentieth": 20,
    "twentyfourth": 24,
}
_IN_WORDS = re.compile(
    rf"(?P<count>{'|'.join(sorted(_CARDINALS, key=len, reverse=True))})?_?"
    rf"(?:(?P<part>{'|'.join(sorted(_DIVISORS, key=len, reverse=True))})s?)?",
    re.IGNORECASE,
)


def in_words(name: str) -> Value | None:
    """The number spelled by a name such as ONE_SIXTH; None for other names.

    >>> in_words("ONE_SIXTH").value, in_words("twothirds").value, in_words("thirds_of")
    (1/6, 2/3, None)
    """
    match = _IN_WORDS.fullmatch(name)
    if match is None or not (match["count"] or match["part"]):
        return None
    count = _COUNTS.get((match["count"] or "one").lower(), 1)
    return real(exact(fmpq(count, _DIVISORS.get((match["part"] or "").lower(), 1))))


MOST_IN_RANGE = 40
"""Most numbers of a range that is followed."""
MOST_PARTS, CLOSE = 120, 1e-14
"""The largest denominator of a part of a turn with a known cosine; the error of a float."""
CALLS: dict[str, Known] = {}
"""The known functions by name."""


def _known(names: str) -> Callable[[Known], Known]:
    def declared(function: Known) -> Known:
        CALLS.update(dict.fromkeys(names.split(), function))
        return function

    return declared


def result(call: KnownCall, args: list[Value]) -> Value | None:
    """The value of a call; None if no function is known for so many arguments."""
    function = CALLS.get(call.name)
    if function is None:
        return None
    code, defaults = function.__code__, function.__defaults__ or ()
    most = code.co_argcount - 1
    takes_more = bool(code.co_flags & 4)
    is_fitting = most - len(defaults) <= len(args) and (takes_more or len(args) <= most)
    return function(call, *args) if is_fitting else None


def conversion(args: Iterable[Value], line: int) -> Value:
    """The argument of a conversion; texts with a number become numbers."""
    value = next((x for x in args if not isinstance(x, Type)), NULL)
    if isinstance(value, Word):
        return _of_text(value.text, line)
    if isinstance(value, Array):
        is_text = any(isinstance(x, Word) for x in value.flat())
        return value.map(lambda x: conversion([x], line)) if is_text else value
    return real(value)


def _of_text(text: str, line: int) -> Value:
    numerator, bar, denominator = text.strip().partition("/")
    if not set(numerator + denominator) <= set("0123456789.eE+- "):
        return Word(text)
    numbers = [literal(x, line) for x in (numerator, denominator or "1")]
    return computed("/", numbers[0], numbers[1], line) if bar else numbers[0]


_TYPES = """
    convert big BigFloat BigInt Rational float Float64 Float32 Float16 Double64 Int Int128
    Int64 collect SVector SMatrix SArray MVector MMatrix Vector Matrix Array Tuple
    tuple list array asarray ImmutableMatrix float64 float32 longdouble double single
    tensor as_tensor Fraction mpf mpq mpfr fmpq fmpz QQ Decimal Float S sympify str
    int Integer SUN_RCONST RCONST PetscRealConstant sunrealtype realtype real_t
    PetscReal PetscScalar real Real dble identity parse vec fraction static_cast
    Number vector make_array sym vpa mp str2sym full num2cell cell2mat as_double
    const_cast reinterpret_cast
    deepcopy copy freeze array_from rational float128 cpp_bin_float String as
    from_f64 from_f32 from_usize from_i32 from Ratio BigDecimal BigFraction Some Ok Box valueOf
    constant to_array from_slice from_array arr1 arr2 Rational64 BigRational
    LinearAlgebra string value_type RC REAL N SA SA_F64 SA_F32 SetPrecision SetAccuracy Rationalize
    move make_shared make_unique shared_ptr unique_ptr Arc Rc RefCell Cow
    ascontiguousarray asfortranarray atleast_1d squeeze require device_put stop_gradient
"""
CONVERSIONS = frozenset(_TYPES.split())
"""Types, and functions that return their argument, a number, list or matrix."""
_OF_ONE = frozenset({"make_shared", "make_unique", "shared_ptr", "unique_ptr", "move"})
"""Functions that return a single argument, and mean something else with several."""
_METHODS = """
    copy astype tolist to clone item double float numpy
    unwrap unwrap_unchecked expect into iter into_iter collect to_vec to_owned copied cloned
    as_slice as_ref as_mut to_subset into_boxed_slice into_shared borrow squeeze contiguous detach
    eval doubleValue getReal toArray toList ToArray ToList asReadOnly AsReadOnly
"""
SAME = frozenset(_METHODS.split())
"""Methods that return the number, list or matrix itself."""


def _vector(call: KnownCall, values: Sequence[Value]) -> Value | None:
    """``vector(n, x)`` of C++: n times x, or zero."""
    count = whole(values[0]) if 0 < len(values) < 3 else None
    if count is None or not 0 <= count <= MAX_STAGES**2:
        return None
    return (
        call.filled(FILL, count)
        if len(values) == 1
        else _repeated(call, call.array(values[1:]), values[0])
    )


_QUOTIENTS = frozenset(
    (
        "Rational",
        "Fraction",
        "BigFraction",
        "Ratio",
        "Rational64",
        "BigRational",
        "fraction",
        "mpq",
        "fmpq",
        "QQ",
    )
)
"""Functions that return the quotient of two numbers."""


@_known(_TYPES)
def _converted(call: KnownCall, *args: Value) -> Value | None:
    values = [x for x in args if not isinstance(x, Type)]
    if any(x == ir.Name("undef") for x in call.expr.args):
        return _made(call, *args)
    if not values or (len(values) > 1 and call.name in _OF_ONE):
        return None
    if call.name == "vector" and (filled := _vector(call, values)) is not None:
        return filled
    if len(values) == 3 and call.name == "fraction" and isinstance(values[0], Unknown):
        # fraction(field, 1, 2)
        values = values[1:]
    if len(values) == 2 and call.name in _QUOTIENTS:
        numerator, denominator = (conversion([x], call.line) for x in values)
        return call.evaluator.combined("/", numerator, denominator)
    if len(values) > 1 and call.name in {"SVector", "SMatrix", "MVector", "Tuple", "Integer"}:
        return call.array(values)
    is_second = len(values) == 2 and call.name == "convert"
    return conversion(values[1:] if is_second else values, call.line)


_ROOTS = {
    **dict.fromkeys(("sqrt", "Sqrt", "PetscSqrtReal", "SUNRsqrt", "√", "dsqrt", "std_sqrt"), 2),
    **dict.fromkeys(("cbrt", "CubeRoot"), 3),
}
"""Functions for roots with their indices."""


@_known(" ".join([*_ROOTS, "nthroot", "real_nthroot", "root", "Surd"]))
def _root(call: KnownCall, value: Value, index: Value = NULL) -> Value | None:
    n = _ROOTS.get(call.name) or whole(index)
    if n is None:
        return call.unknown()
    if isinstance(value, Array):
        return value.map(lambda x: root(x, n, call.line))
    return root(value, n, call.line)


@_known("acos atan")
def _angle(call: KnownCall, value: Value) -> Value | None:
    """π in programs: ``acos(-1)``, ``4*atan(1)``."""
    if call.name == "acos" and whole(value) == -1:
        return PI
    is_one = call.name == "atan" and whole(value) == 1
    return computed("/", PI, integer(4), call.line) if is_one else call.unknown()


@_known("cos sin Cos Sin dcos dsin")
def _of_angle(call: KnownCall, angle: Value) -> Value | None:
    """The cosine of a rational multiple of π, half of a root of an integer polynomial."""
    if not isinstance(angle, Number) or not (angle.is_zero or "pi" in angle.scalar.text):
        return call.unknown()
    turns = Fraction(angle.near / math.tau).limit_denominator(MOST_PARTS)
    if abs(turns - angle.near / math.tau) > CLOSE:
        return call.unknown()
    if call.name.lower().endswith("sin"):
        turns = Fraction(1, 4) - turns
    polynomial = fmpz_poly.cos_minpoly(turns.denominator)
    if polynomial.degree() == 1:
        return exact(fmpq(-polynomial[0], 2))
    twice = 2 * arb.cos_pi_fmpq(fmpq(2 * turns.numerator, turns.denominator))
    text = Scalar(f"root_of({polynomial}, {twice.str(DIGITS_OF_ROOTS, radius=False)})")
    return computed("/", Number(None, float(twice), written=text), integer(2), call.line)


@_known("constructor")
def _constructed(call: KnownCall, *sizes: Value) -> Value | None:
    """An object constructed from sizes, ``Matrix A(2, 2)``, with entries assigned later; with a
    fraction it is that number, ``scalar x(0.5)``.
    """
    if len(sizes) == 1 and isinstance(sizes[0], Number) and not sizes[0].near.is_integer():
        return sizes[0]
    is_sized = 0 < len(sizes) < 3 and all(whole(x) for x in sizes)
    return call.unknown("never assigned") if is_sized else None


@_known("inv")
def _inverse(call: KnownCall, value: Value) -> Value | None:
    if isinstance(value, Array):
        return call.unknown()
    return call.evaluator.combined("/", real(ONE), value)


@_known("Root root_of")
def _root_of(call: KnownCall, polynomial: Value, which: Value) -> Value | None:
    """A root of a polynomial: by its number in Mathematica, otherwise by a decimal near it."""
    if not isinstance(polynomial, Number) or not isinstance(which, Number):
        return call.unknown()
    try:
        if call.name == "Root":
            text = real_root(polynomial.scalar, whole(which) or 0)
            return Number(None, float(text.text.rpartition(",")[2].strip(" )")), written=text)
    except Unreadable as error:
        return call.unknown(error.message)
    text = Scalar(f"root_of({polynomial.scalar.text}, {which.scalar.text})")
    return Number(None, which.near, written=text)


def _sizes(values: Iterable[Value]) -> list[int]:
    """The numbers of a shape, given as arguments or as a list; empty if one is unknown."""
    flat = list(Array([x for x in values if not isinstance(x, Type | Word)]).flat())
    counts = [whole(x) for x in flat]
    valid = [x for x in counts if x is not None and 0 <= x <= MAX_STAGES**2]
    return valid if len(valid) == len(counts) <= 2 else []


def _filled(call: KnownCall, fill: Value, args: Iterable[Value]) -> Value:
    known = [x for x in args if not isinstance(x, Type | Word)]
    if len(known) > 1 and isinstance(known[0], Unknown):
        # zeros(T, 2, 2) with unknown T
        known = known[1:]
    if len(known) > 1 and isinstance(known[-1], Unknown):
        # zeros(2, 2, context)
        known = known[:-1]
    sizes = _sizes(known[:3])
    if not sizes or max(sizes) > MAX_STAGES:
        return call.unknown(NO_SIZE)
    return call.filled(fill, *sizes)


NO_SIZE = "an array of unknown size"


_FILLS = {
    **dict.fromkeys(("zeros", "zeros_like", "Zero"), FILL),
    **dict.fromkeys(("ones", "Ones"), real(ONE)),
}
"""The entries of new arrays; arrays of other functions are empty."""


@_known(" ".join([*_FILLS, "empty", "similar"]))
def _made(call: KnownCall, *args: Value) -> Value | None:
    return _filled(call, _FILLS.get(call.name, call.unknown("never assigned")), args)


@_known("buildArray")
def _built(call: KnownCall, _: Value, count: Value, columns: Value = NULL) -> Value | None:
    """``MathArrays.buildArray(field, n, m)``; rows with -1 entries come later."""
    if whole(columns) == -1:
        return _filled(call, NULL, [count])
    return _filled(call, FILL, [x for x in (count, columns) if x is not NULL])


@_known("fill")
def _fill(call: KnownCall, value: Value, *sizes: Value) -> Value | None:
    return _filled(call, value, sizes) if sizes else None


@_known("zero one")
def _unit(call: KnownCall, *_: Value) -> Value | None:
    return ZERO if call.name == "zero" else real(ONE)


@_known("sum")
def _sum(call: KnownCall, values: Value, axis: Value = NULL) -> Value | None:
    """The sum of a list; for a matrix the sums of its rows."""
    along = whole(call.named.get("axis", call.named.get("dims", axis)))
    if not isinstance(values, Array):
        return call.unknown()
    if values.is_matrix and along == 1 + call.evaluator.base:
        return call.array(_sum(call, row) or NULL for row in values.items)
    if values.is_matrix:
        return call.unknown()
    total: Value = ZERO
    for x in values.items:
        total = call.evaluator.combined("+", total, x)
    return total


@_known("transpose permutedims adjoint")
def _transposed(call: KnownCall, value: Value, *_: Value) -> Value | None:
    return transposed(value, call.line)


@_known("flatten ravel")
def _flat(call: KnownCall, value: Value, *_: Value) -> Value | None:
    """The entries of an array by rows."""
    return call.array(value.flat()) if isinstance(value, Array) else None


@_known("reversed reverse")
def _turned(call: KnownCall, value: Value) -> Value | None:
    return call.array(value.items[::-1]) if isinstance(value, Array) else None


@_known("tril triu")
def _triangle(call: KnownCall, value: Value, above: Value = ZERO) -> Value | None:
    """The part of a matrix on one side of its diagonal, or of the diagonal ``above`` above it."""
    off, is_lower = whole(above), call.name == "tril"
    if not isinstance(value, Array) or not value.is_matrix or off is None:
        return call.unknown()
    return call.array(
        call.array(x if (j - i <= off if is_lower else j - i >= off) else ZERO for j, x in row)
        for i, row in enumerate(enumerate(items_of(x)) for x in value.items)
    )


def _without_open(shape: Sequence[Value], count: int) -> Sequence[Value]:
    """A shape with -1 replaced by the remaining size."""
    sizes = list(Array(list(shape[:2])).flat())
    known = [x for x in sizes if whole(x) != -1]
    product = math.prod(whole(x) or 0 for x in known)
    if len(sizes) - len(known) != 1 or not product:
        return sizes
    return [integer(count // product) if whole(x) == -1 else x for x in sizes]


@_known("reshape")
def _reshaped(call: KnownCall, value: Value, *shape: Value) -> Value | None:
    """The entries in another shape: by columns in Julia, MATLAB and Fortran, by rows in Python."""
    if not isinstance(value, Array):
        return value
    is_by_rows = call.evaluator.base == 0
    turned = value if is_by_rows or not value.is_matrix else transposed(value, call.line)
    flat = list((turned if isinstance(turned, Array) else value).flat())
    shape = shape or tuple(filter(None, [call.named.get("shape")]))
    sizes = _sizes(_without_open(shape, len(flat))) or _of_square(shape, len(flat))
    if not sizes or math.prod(sizes) != len(flat):
        return call.unknown()
    if len(sizes) == 1:
        return call.array(flat)
    order = call.named.get("order")
    if isinstance(order, Array):
        is_by_rows = [whole(x) for x in order.items] == [2, 1]
    rows, columns = sizes
    starts = [slice(i * columns, (i + 1) * columns) for i in range(rows)]
    return call.array(
        call.array(flat[at if is_by_rows else slice(i, None, rows)]) for i, at in enumerate(starts)
    )


def _of_square(shape: Sequence[Value], count: int) -> list[int]:
    """The sizes of a matrix with the same unknown size twice; empty for others."""
    sizes = items_of(shape[0]) if len(shape) == 1 else list(shape)
    reasons = [x.reason for x in sizes if isinstance(x, Unknown)]
    is_square = len(sizes) == len(reasons) == 2 and reasons[0] == reasons[1]
    return [math.isqrt(count)] * 2 if is_square else []


@_known("from_row_slice from_column_slice from_vec")
def _of_slice(call: KnownCall, *rest: Value) -> Value | None:
    """``DMatrix::from_row_slice(2, 2, …)``: a matrix from its entries by rows, or by columns."""
    if len(rest) > 1 and isinstance(rest[-1], Unknown):
        # its storage
        rest = rest[:-1]
    *sizes, entries = rest
    if not sizes:
        return entries
    is_by_rows = call.name == "from_row_slice"
    shaped = _reshaped(call, entries, *(sizes if is_by_rows else sizes[::-1]))
    return shaped if shaped is None or is_by_rows else transposed(shaped, call.line)


@_known("from_shape_vec")
def _of_shape(call: KnownCall, shape: Value, entries: Value) -> Value | None:
    """``Array2::from_shape_vec((2, 2), …)``: a matrix from its entries by rows, or a list."""
    return _reshaped(call, entries, shape) if isinstance(shape, Array) else entries


@_known("vcat concatenate hstack vstack")
def _stacked(call: KnownCall, *parts: Value) -> Value | None:
    """Lists behind one another, matrices below one another."""
    if len(parts) == 1 and isinstance(parts[0], Array) and call.evaluator.base == 0:
        parts = tuple(parts[0].items)
    unknown = next((x for x in parts if isinstance(x, Unknown)), None)
    if unknown is not None:
        return unknown
    return call.array(y for x in parts for y in (x.items if isinstance(x, Array) else [x]))


CALLS["list +"] = _stacked


def _repeated(call: KnownCall, values: Value, times: Value) -> Value | None:
    """Copies of a list behind one another."""
    count = whole(times)
    if not isinstance(values, Array) or count is None or count > MAX_STAGES:
        return call.unknown()
    call.evaluator.allowance.spend(size(values) * max(count, 0))
    return call.array(copied(x) for _ in range(count) for x in values.items)


CALLS["list *"] = _repeated


@_known("map")
def _mapped(call: KnownCall, function: Value, values: Value) -> Value | None:
    is_argument = isinstance(function, Unknown) and function.reason.startswith("the argument")
    if isinstance(function, Function):
        return _each(call, function, values)
    if not isinstance(function, Type) and not is_argument:
        return call.unknown()
    return conversion([values], call.line)


def _each(call: KnownCall, function: Value, values: Value) -> Value | None:
    """``[f(x) for x in …]``."""
    if not isinstance(function, Function) or not isinstance(values, Array):
        return call.unknown()
    call.evaluator.allowance.spend(size(values))
    return call.array(call.evaluator.applied(function, [x]) for x in values.items)


CALLS["list of each"] = _each


@_known("zip")
def _zipped(call: KnownCall, *lists: Value) -> Value | None:
    """Lists entry by entry, as long as the shortest one."""
    if not lists or not all(isinstance(x, Array) for x in lists):
        return call.unknown()
    call.evaluator.allowance.spend(sum(map(size, lists)))
    return call.array(call.array(x) for x in zip(*map(items_of, lists), strict=False))


@_known("range")
def _range(call: KnownCall, first: Value, last: Value = NULL, step: Value = ONE) -> Value | None:
    """``range(n)`` of Python, short ones only."""
    ends = (ZERO, first, step) if last is NULL else (first, last, step)
    a, b, by = map(whole, ends)
    if call.evaluator.base or a is None or b is None or not by or abs(b - a) > MOST_IN_RANGE:
        return call.unknown()
    call.evaluator.allowance.spend(abs(b - a))
    return call.array(map(integer, range(a, b, by)))


@_known("enumerate")
def _numbered(call: KnownCall, values: Value, first: Value = ZERO) -> Value | None:
    """Entries with their numbers, from 0 in Python and from 1 in Julia."""
    start = whole(call.named.get("start", first))
    if not isinstance(values, Array) or start is None:
        return call.unknown()
    call.evaluator.allowance.spend(size(values))
    numbers = range(start + call.evaluator.base, start + call.evaluator.base + len(values.items))
    return call.array(
        call.array((integer(i), x)) for i, x in zip(numbers, values.items, strict=True)
    )


@_known("power pow Power SUNRpowerR")
def _power(call: KnownCall, base: Value, exponent: Value) -> Value | None:
    return call.evaluator.combined("^", base, exponent)


@_known("PetscSqr SUNSQR")
def _square(call: KnownCall, value: Value) -> Value | None:
    return call.evaluator.combined("*", value, value)


@_known("length len size")
def _length(call: KnownCall, value: Value = NULL, axis: Value = NULL) -> Value | None:
    """The number of entries of a list, or of rows of a matrix; of columns for ``size(A, 2)``."""
    if call.name == "size" and whole(axis) == 1 + call.evaluator.base:
        rows = items_of(value)
        value = rows[0] if rows else NULL
    return integer(len(value.items)) if isinstance(value, Array) else call.unknown()


@_known("diag")
def _diagonal(call: KnownCall, value: Value, above: Value = ZERO) -> Value | None:
    """A matrix with the entries of a list on its diagonal, or on the diagonal ``above`` above
    it.
    """
    off = whole(above)
    if not isinstance(value, Array) or value.is_matrix or off is None or abs(off) > MAX_STAGES:
        return call.unknown()
    count = len(value.items) + abs(off)
    matrix = call.filled(ZERO, count, count)
    for i, x in enumerate(value.items):
        row = matrix.items[i + max(-off, 0)]
        assert isinstance(row, Array)
        row.items[i + max(off, 0)] = x
    return matrix


@_known("struct")
def _record(call: KnownCall, *args: Value) -> Value | None:
    """``struct('A', …)``."""
    pairs = zip(args[::2], args[1::2], strict=False)
    return SourceRecord(
        "", {key.text: x for key, x in pairs if isinstance(key, Word)}, (), call.line
    )


@_known("ARKodeButcherTable_Alloc ARKodeSPRKTable_Alloc")
def _allocated(call: KnownCall, count: Value = NULL, *_: Value) -> Value | None:
    """Arrays of zeros of SUNDIALS, ``ARKodeButcherTable_Alloc(stages, embedded)``."""
    n = whole(count)
    if n is None or not 0 < n <= MAX_STAGES:
        return call.unknown("the number of stages is not written out")
    if call.name == "ARKodeSPRKTable_Alloc":
        rows = {x: call.filled(FILL, n) for x in ("a", "ahat")}
        return SourceRecord(call.name, {**rows, "q": FILL, "stages": integer(n)}, (), call.line)
    rows = {"A": call.filled(FILL, n, n)} | {x: call.filled(FILL, n) for x in "bcd"}
    return SourceRecord(call.name, {**rows, "q": FILL, "p": FILL}, (), call.line)


@_known("ARKodeButcherTable_LoadERK ARKodeButcherTable_LoadDIRK")
def _loaded(call: KnownCall, _: Value) -> Value | None:
    """A built-in table of SUNDIALS, by its name."""
    name = call.expr.args[0]
    if not isinstance(name, ir.Name):
        return call.unknown()
    return SourceRecord(LOADED, {"base": Word(name.name)}, (), call.line)


LOADED = "ARKodeButcherTable_Load"
SLOW = "the slow method of a coupling"
"""Replaces the kind of the call that made such a table: it is no table of its own."""


@_known("MRIStepCoupling_Alloc")
def _coupling(call: KnownCall, powers: Value, stages: Value, _: Value) -> Value | None:
    """Matrices of zeros of SUNDIALS for each power of τ, with a row for the embedded value."""
    n, count, kind = whole(stages), whole(powers), call.expr.args[2]
    if n is None or count is None or not (0 < n <= MAX_STAGES and 0 < count <= MAX_STAGES):
        return call.unknown("the number of stages is not written out")
    call.evaluator.allowance.spend(2 * count * (n + 1) * n)
    fields: dict[str, Value] = {
        x: call.array(call.filled(FILL, n + 1, n) for _ in range(count)) for x in "WG"
    }
    fields |= {"c": call.filled(FILL, n), "q": FILL, "p": FILL, "stages": integer(n)}
    if isinstance(kind, ir.Name):
        fields["type"] = Word(kind.name)
    return SourceRecord(call.name, fields, (), call.line)


@_known("MRIStepCoupling_MIStoMRI")
def _of_slow(call: KnownCall, slow: Value, order: Value, embedded: Value) -> Value | None:
    """The coupling of a slow method."""
    if not isinstance(slow, SourceRecord) or not (
        {"A", "b"} <= set(slow.fields) or slow.kind == LOADED
    ):
        return call.unknown()
    fields = {key: copied(x) for key, x in slow.fields.items()}
    slow.kind = SLOW
    orders = {"q": order, "p": embedded}
    fields |= {key: x for key, x in orders.items() if whole(x) is not None}
    return SourceRecord(call.name, fields, (), call.line)
