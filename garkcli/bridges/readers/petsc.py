"""PETSc: the methods that a source registers with TSRKRegister and its like."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import chain

from garkcli.bridges.readers.allowance import Allowance
from garkcli.bridges.readers.c_source import Block, Call, CSource
from garkcli.bridges.readers.found import (
    MAX_STAGES,
    FoundTable,
    Grid,
    Reader,
    Row,
    Rows,
    Unreadable,
    troubled,
)
from garkcli.bridges.readers.scalars import Scalar, Value, combined, whole
from garkcli.bridges.readers.shaping import is_zero, square, symplectic, weights

NAME = "petsc"


def find(text: str, source: str) -> list[FoundTable]:
    """The methods that a source registers."""

    def ended(block: Block) -> None:
        del block

    allowance = Allowance()
    calls = CSource(text, frozenset(REGISTERS), ended, allowance).calls()
    return allowance.tables(_registered(call, source) for call in calls)


def _registered(call: Call, source: str) -> FoundTable:
    name = call.arguments[0] if call.arguments else None
    title = name if isinstance(name, str) else call.label or call.title
    line = call.line
    order = whole(call.arguments[1]) if len(call.arguments) > 1 else None
    empty = FoundTable(source, line, NAME, title, (), (), order=order)
    count, read = REGISTERS[call.name]
    if len(call.arguments) not in count:
        expected = max(count)
        return troubled(empty, f"{call.name} takes {expected} arguments")
    try:
        return read(empty, call.arguments)
    except Unreadable as error:
        return troubled(empty, f"{call.name}: {error.message}")


def _stages(value: Value) -> int:
    return _checked(whole(value))


def _checked(stages: int | None) -> int:
    if stages is None or not 0 < stages <= MAX_STAGES:
        raise Unreadable("the number of stages is not written out")
    return stages


def _rk(empty: FoundTable, values: tuple[Value, ...]) -> FoundTable:
    """``TSRKRegister(name, order, s, A, b, c, bembed, p, binterp)``: no b is the last row of A."""
    stages = _stages(values[2])
    A = square(_addressed(values[3]), stages)
    b = _weights_or(values[4], A[-1], stages)
    c = _nodes(values[5], A, stages)
    embedded = _optional(values[6], stages)
    return _table(empty, ((A,),), (b,), (c,), embedded)


def _dirk(empty: FoundTable, values: tuple[Value, ...]) -> FoundTable:
    """``TSDIRKRegister(name, order, s, At, bt, ct, bembedt, pinterp, binterpt)``."""
    return _rk(empty, values)


def _arkimex(empty: FoundTable, values: tuple[Value, ...]) -> FoundTable:
    """``TSARKIMEXRegister(name, order, s, At, bt, ct, A, b, c, bembedt, bembed, …)``.

    The implicit table is first; no bt is the last row of At, no b is bt.
    """
    stages = _stages(values[2])
    implicit = square(values[3], stages)
    b_implicit = _weights_or(values[4], implicit[-1], stages)
    c_implicit = _nodes(values[5], implicit, stages)
    explicit = square(values[6], stages)
    b_explicit = _weights_or(values[7], b_implicit, stages)
    c_explicit = _nodes(values[8], explicit, stages)
    of_implicit = _optional(values[9], stages)
    of_explicit = _optional(values[10], stages)
    embedded: Rows | None = None
    if of_implicit is not None:
        embedded = (of_explicit or of_implicit, of_implicit)
    b = (b_explicit, b_implicit)
    row = (explicit, implicit)
    if all(map(is_zero, (*b_explicit, *chain.from_iterable(explicit)))):
        # nothing is explicit: the way to register an implicit method
        return _table(empty, ((implicit,),), (b_implicit,), (c_implicit,), of_implicit)
    grid: Grid = (row,)
    c: tuple[Row, ...] = (c_explicit,)
    if values[8] is None and values[5] is not None:
        c = (c_implicit,)
    elif c_implicit != c_explicit and values[5] is not None:
        # each part is evaluated at its own times
        grid = (row, row)
        c = (c_explicit, c_implicit)
    return FoundTable(
        empty.source, empty.line, NAME, empty.name, grid, b, c, embedded=embedded, order=empty.order
    )


def _symplectic(empty: FoundTable, values: tuple[Value, ...]) -> FoundTable:
    """``TSBasicSymplecticRegister(name, order, s, c, d)``: q += c_i h v(p), p += d_i h f(q)."""
    stages = whole(values[2])
    if stages is None and isinstance(values[3], list):
        # sizeof(c) / sizeof(c[0])
        stages = len(values[3])
    stages = _checked(stages)
    drifts = weights(values[3], stages)
    kicks = weights(values[4], stages)
    return symplectic(empty, drifts, kicks, is_force_first=False)


def _addressed(value: Value) -> Value:
    if value is None:
        raise Unreadable("the matrix is not written out")
    return value


def _table(
    empty: FoundTable,
    grid: tuple[tuple[Rows | None, ...], ...],
    b: Rows,
    c: tuple[Row | None, ...],
    embedded: Row | None,
) -> FoundTable:
    return FoundTable(
        empty.source,
        empty.line,
        NAME,
        empty.name,
        grid,
        b,
        c,
        embedded=None if embedded is None else (embedded,),
        order=empty.order,
    )


def _weights_or(value: Value, otherwise: Row, stages: int) -> Row:
    return otherwise if value is None else weights(value, stages)


def _optional(value: Value, stages: int) -> Row | None:
    return None if value is None else weights(value, stages)


def _nodes(value: Value, A: Rows, stages: int) -> Row:
    """The nodes; none are the row sums, as PETSc has it."""
    if value is not None:
        return weights(value, stages)
    return tuple(_sum(row) for row in A)


def _sum(row: Row) -> str:
    total: Value = None
    for text in row:
        if not text.strip("-0. "):
            continue
        term = Scalar(text, 0)
        total = term if total is None else combined("+", total, term)
    return total.text if isinstance(total, Scalar) else "0"


_Read = Callable[[FoundTable, tuple[Value, ...]], FoundTable]
REGISTERS: Mapping[str, tuple[frozenset[int], _Read]] = {
    "TSRKRegister": (frozenset({9}), _rk),
    "TSDIRKRegister": (frozenset({9}), _dirk),
    "TSARKIMEXRegister": (frozenset({14}), _arkimex),
    "TSBasicSymplecticRegister": (frozenset({5}), _symplectic),
}
"""What registers methods: with how many arguments, and what they are."""
READER = Reader(
    NAME,
    "PETSc: TSRKRegister, TSARKIMEXRegister, TSDIRKRegister",
    (".c", ".h", ".cc", ".cpp", ".cxx", ".hpp", ".cu"),
    find,
)
