"""Functions that sources call for constants: conversions, roots, arrays of zeros, shapes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from garkcli.frozen import Frozen
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, Unreadable
from garkcli.sources.scalars import Scalar, real_root
from garkcli.sources.values import (
    FILL,
    NULL,
    ONE,
    ZERO,
    Array,
    Function,
    Number,
    Record,
    Type,
    Unknown,
    Value,
    Word,
    computed,
    copied,
    integer,
    literal,
    real,
    root,
    size,
    transposed,
    whole,
)

if TYPE_CHECKING:
    from garkcli.sources.evaluate import Evaluator


class Call(Frozen):
    """A call of a known function, its arguments evaluated."""

    name: str
    expr: ir.Call
    args: Sequence[Value]
    named: Mapping[str, Value]
    evaluator: Evaluator

    @property
    def line(self) -> int:
        """Where it is."""
        return self.evaluator.line

    def unknown(self) -> Unknown:
        """What this call gives is not known."""
        return self.evaluator.unknown(f"the call {self.name}")


Known: TypeAlias = Callable[[Call], Value | None]
"""The value of a call; None where the function is another one of that name."""

CONSTANTS: Mapping[str, Value] = {
    **dict.fromkeys(("NULL", "nullptr", "nothing", "None", "missing", "PETSC_NULLPTR"), NULL),
    **{name: Word("true") for name in ("true", "True", "SUNTRUE", "PETSC_TRUE")},
    **{name: Word("false") for name in ("false", "False", "SUNFALSE", "PETSC_FALSE")},
    **dict.fromkeys(("ZERO",), ZERO),
    "ONE": real(ONE),
    "TWO": real(integer(2)),
    "#": Number(None, math.nan, written=Scalar("x")),
}
"""Names that mean the same everywhere; ``#`` is the variable of a polynomial."""


def conversion(args: Sequence[Value], line: int) -> Value:
    """The value that a type is called with; texts with a number in them are numbers."""
    values = [x for x in args if not isinstance(x, Type)] or [NULL]
    value = values[0]
    if isinstance(value, Word):
        return _of_text(value.text, line)
    if isinstance(value, Array):
        is_text = any(isinstance(x, Word) for x in value.flat())
        return value.map(lambda x: conversion([x], line)) if is_text else value
    return real(value)


def _of_text(text: str, line: int) -> Value:
    above, bar, below = text.strip().partition("/")
    if not set(above + below) <= set("0123456789.eE+- "):
        return Word(text)
    numbers = [literal(x, line) for x in (above, below or "1")]
    return computed("/", numbers[0], numbers[1], line) if bar else numbers[0]


def _converted(call: Call) -> Value | None:
    values = [x for x in call.args if not isinstance(x, Type)]
    if any(x == ir.Name("undef") for x in call.expr.args):
        return _filled(call, Unknown("never assigned", call.line))
    if not values:
        return None
    if call.name in {"Rational", "Fraction", "mpq", "fmpq", "QQ"} and len(values) == 2:
        numbers = [conversion([x], call.line) for x in values]
        return call.evaluator.combined("/", numbers[0], numbers[1])
    if call.name in {"SVector", "SMatrix", "MVector", "Tuple", "Integer"} and len(values) > 1:
        return call.evaluator.array(values)
    if call.name == "convert" and len(values) == 2:
        return conversion(values[1:], call.line)
    return conversion(values, call.line)


def _root(call: Call) -> Value | None:
    if not call.args:
        return None
    index = 3 if call.name in {"cbrt", "CubeRoot"} else 2
    if call.name in {"nthroot", "real_nthroot", "root", "Surd"}:
        given = whole(call.args[1]) if len(call.args) == 2 else None
        if given is None:
            return call.unknown()
        index = given
    value = call.args[0]
    if isinstance(value, Array):
        return value.map(lambda x: root(x, index, call.line))
    return root(value, index, call.line)


def _root_of(call: Call) -> Value | None:
    """A root of a polynomial: by its number in Mathematica, and else by a decimal near it."""
    if len(call.args) != 2 or not all(isinstance(x, Number) for x in call.args):
        return call.unknown()
    polynomial, which = call.args
    assert isinstance(polynomial, Number)
    assert isinstance(which, Number)
    try:
        if call.name == "Root":
            text = real_root(polynomial.scalar, whole(which) or 0)
            return Number(None, float(text.text.rpartition(",")[2].strip(" )")), written=text)
    except Unreadable as error:
        return call.evaluator.unknown(error.message)
    text = Scalar(f"root_of({polynomial.scalar.text}, {which.scalar.text})")
    return Number(None, which.near, written=text)


def _sizes(values: Sequence[Value]) -> list[int] | None:
    """The numbers of a shape, whether they are arguments or a list."""
    flat: list[Value] = []
    for x in values:
        flat += x.items if isinstance(x, Array) else [x]
    counts = [whole(x) for x in flat if isinstance(x, Number)]
    if not counts or len(counts) < len(flat):
        return None
    found = [x for x in counts if x is not None and x >= 0]
    return found if len(found) == len(counts) else None


def _filled(call: Call, fill: Value) -> Value:
    sizes = _sizes([x for x in call.args if not isinstance(x, (Type, Word))][:3])
    known = [x for x in call.args if not isinstance(x, (Type, Word))]
    if known and isinstance(known[0], Unknown) and len(known) > 1:
        # zeros(T, 2, 2), where T is not known
        sizes = _sizes(known[1:])
    if sizes is None or len(sizes) > 2 or max(sizes) > MAX_STAGES:
        return call.evaluator.unknown("an array of unknown size")
    rows, columns = sizes[0], sizes[1] if len(sizes) > 1 else 0
    array, allowance = call.evaluator.array, call.evaluator.allowance
    allowance.spend(2 * rows * max(columns, 1))
    if len(sizes) == 1:
        return array([fill] * rows)
    return array(array([fill] * columns) for _ in range(rows))


def _zeros(call: Call) -> Value | None:
    return _filled(call, FILL)


def _ones(call: Call) -> Value | None:
    return _filled(call, real(ONE))


def _fill(call: Call) -> Value | None:
    if len(call.args) < 2:
        return None
    counted = call.args[1:] if call.name == "fill" else call.args[:1]
    value = call.args[0] if call.name == "fill" else call.args[1]
    return _filled(Call(call.name, call.expr, counted, {}, call.evaluator), value)


def _empty(call: Call) -> Value | None:
    return _filled(call, call.evaluator.unknown("never assigned"))


def _zero(call: Call) -> Value | None:
    del call
    return ZERO


def _one(call: Call) -> Value | None:
    del call
    return real(ONE)


def _sum(call: Call) -> Value | None:
    values = call.args[0] if call.args else NULL
    if not isinstance(values, Array):
        return values if isinstance(values, Unknown) else None
    axis = whole(call.named.get("axis", call.named.get("dims", NULL)))
    if axis is None and len(call.args) > 1:
        axis = whole(call.args[1])
    combined = call.evaluator.combined

    def total(items: Sequence[Value]) -> Value:
        found: Value = ZERO
        for x in items:
            found = combined("+", found, x)
        return found

    if not values.is_matrix:
        return total(values.items)
    if axis == 1 + call.evaluator.base:
        return call.evaluator.array([total(x.items) for x in values.items if isinstance(x, Array)])
    return call.unknown()


def _transposed(call: Call) -> Value | None:
    return transposed(call.args[0], call.line) if call.args else None


def _reshaped(call: Call) -> Value | None:
    """The entries in another shape: by columns in Julia, MATLAB and Fortran, by rows in Python."""
    args = call.args
    if not args or not isinstance(args[0], Array):
        return args[0] if args else None
    sizes = _sizes([x for x in args[1:3] if not isinstance(x, Word)])
    flat = list(args[0].flat())
    if args[0].is_matrix and call.evaluator.base == 1:
        turned = transposed(args[0], call.line)
        flat = list(turned.flat()) if isinstance(turned, Array) else flat
    array = call.evaluator.array
    if sizes is None or len(sizes) > 2:
        return call.unknown()
    rows, columns = sizes[0], sizes[1] if len(sizes) > 1 else 1
    if rows * columns != len(flat):
        return call.unknown()
    if len(sizes) == 1:
        return array(flat)
    order = call.named.get("order")
    is_by_rows = call.evaluator.base == 0
    if isinstance(order, Array):
        is_by_rows = [whole(x) for x in order.items] == [2, 1]
    if is_by_rows:
        return array(array(flat[i * columns : (i + 1) * columns]) for i in range(rows))
    return array(array(flat[i::rows]) for i in range(rows))


def _stacked(call: Call) -> Value | None:
    """Lists behind one another, matrices below one another."""
    items: list[Value] = []
    given = call.args
    if len(given) == 1 and isinstance(given[0], Array) and call.evaluator.base == 0:
        given = given[0].items
    for x in given:
        if isinstance(x, Unknown):
            return x
        items += x.items if isinstance(x, Array) else [x]
    return call.evaluator.array(items)


def _repeated(call: Call) -> Value | None:
    """A list so many times, one behind the other."""
    values, count = call.args[0], whole(call.args[1])
    if not isinstance(values, Array) or count is None or count > MAX_STAGES:
        return call.unknown()
    call.evaluator.allowance.spend(size(values) * max(count, 0))
    return call.evaluator.array(copied(x) for _ in range(count) for x in values.items)


def _mapped(call: Call) -> Value | None:
    if len(call.args) != 2:
        return None
    function, values = call.args
    is_type = isinstance(function, Type)
    is_argument = isinstance(function, Unknown) and function.reason.startswith("the argument")
    if not is_type and not is_argument:
        return call.unknown()
    return conversion([values], call.line)


def _each(call: Call) -> Value | None:
    """``[f(x) for x in …]``."""
    function, values = call.args
    if not isinstance(function, Function) or not isinstance(values, Array):
        return call.unknown()
    call.evaluator.allowance.spend(size(values))
    return call.evaluator.array(call.evaluator.applied(function, [x]) for x in values.items)


def _power(call: Call) -> Value | None:
    if len(call.args) != 2:
        return None
    return call.evaluator.combined("^", call.args[0], call.args[1])


def _quotient(call: Call) -> Value | None:
    if len(call.args) != 2:
        return None
    return call.evaluator.combined("/", real(call.args[0]), real(call.args[1]))


def _square(call: Call) -> Value | None:
    if len(call.args) != 1:
        return None
    return call.evaluator.combined("*", call.args[0], call.args[0])


def _length(call: Call) -> Value | None:
    value = call.args[0] if call.args else NULL
    return integer(len(value.items)) if isinstance(value, Array) else call.unknown()


def _diagonal(call: Call) -> Value | None:
    """A matrix with the entries of a list on its diagonal, or on one so far above it."""
    value, above = (*call.args, ZERO)[:2] if len(call.args) in (1, 2) else (NULL, NULL)
    off = whole(above)
    if not isinstance(value, Array) or value.is_matrix or off is None or abs(off) > MAX_STAGES:
        return call.unknown()
    count = len(value.items) + abs(off)
    array = call.evaluator.array
    call.evaluator.allowance.spend(count * count)
    rows: list[list[Value]] = [[ZERO] * count for _ in range(count)]
    for i, x in enumerate(value.items):
        rows[i + max(-off, 0)][i + max(off, 0)] = x
    return array(array(row) for row in rows)


def _record(call: Call) -> Value | None:
    """``struct('A', …)``."""
    pairs = zip(call.args[::2], call.args[1::2], strict=False)
    return Record("", {key.text: x for key, x in pairs if isinstance(key, Word)}, (), call.line)


def _butcher_table(call: Call) -> Value | None:
    """``ARKodeButcherTable_Alloc(stages, embedded)``: arrays of zeros."""
    stages = whole(call.args[0]) if call.args else None
    if stages is None or not 0 < stages <= MAX_STAGES:
        return call.evaluator.unknown("the number of stages is not written out")
    array = call.evaluator.array
    call.evaluator.allowance.spend(stages * stages)
    fields: dict[str, Value] = {"A": array(array([FILL] * stages) for _ in range(stages))}
    fields |= {name: array([FILL] * stages) for name in ("b", "c", "d")}
    return Record(call.name, {**fields, "q": FILL, "p": FILL}, (), call.line)


def _symplectic_table(call: Call) -> Value | None:
    """``ARKodeSPRKTable_Alloc(stages)``: arrays of zeros."""
    stages = whole(call.args[0]) if call.args else None
    if stages is None or not 0 < stages <= MAX_STAGES:
        return call.evaluator.unknown("the number of stages is not written out")
    array = call.evaluator.array
    call.evaluator.allowance.spend(2 * stages)
    fields: dict[str, Value] = {x: array([FILL] * stages) for x in ("a", "ahat")}
    return Record(call.name, {**fields, "q": FILL, "stages": integer(stages)}, (), call.line)


_BY_FUNCTION: Mapping[Known, str] = {
    _converted: """
        convert big BigFloat BigInt Rational float Float64 Float32 Float16 Double64 Int Int128
        Int64 collect SVector SMatrix SArray MVector MMatrix Vector Matrix Array Tuple
        tuple list array asarray ImmutableMatrix float64 float32 longdouble double single
        tensor as_tensor Fraction mpf mpq mpfr fmpq fmpz QQ Decimal Float S sympify str
        int Integer SUN_RCONST RCONST PetscRealConstant sunrealtype realtype real_t
        PetscReal PetscScalar real Real dble identity parse vec fraction static_cast
        Number vector make_array sym vpa mp str2sym full num2cell cell2mat as_double
        deepcopy copy freeze array_from rational float128 cpp_bin_float String
        LinearAlgebra string value_type RC REAL N SetPrecision SetAccuracy Rationalize
    """,
    _root: "sqrt Sqrt PetscSqrtReal SUNRsqrt cbrt CubeRoot nthroot root Surd √ dsqrt std_sqrt",
    _root_of: "Root root_of",
    _zeros: "zeros zeros_like Zero",
    _ones: "ones Ones",
    _fill: "fill",
    _empty: "empty similar",
    _zero: "zero",
    _one: "one",
    _sum: "sum",
    _transposed: "transpose permutedims adjoint",
    _reshaped: "reshape",
    _stacked: "vcat concatenate hstack vstack",
    _mapped: "map",
    _power: "power pow Power SUNRpowerR",
    _quotient: "rdivide Rational",
    _square: "PetscSqr SUNSQR",
    _length: "length len size",
    _diagonal: "diag",
    _record: "struct",
    _butcher_table: "ARKodeButcherTable_Alloc",
    _symplectic_table: "ARKodeSPRKTable_Alloc",
}
CONVERSIONS = frozenset(_BY_FUNCTION[_converted].split())
"""Types, and functions that give back the number, the list or the matrix that they get."""
CALLS: Mapping[str, Known] = {
    "list *": _repeated,
    "list +": _stacked,
    "list of each": _each,
    **{name: known for known, names in _BY_FUNCTION.items() for name in names.split()},
}
"""What is known of each function."""
