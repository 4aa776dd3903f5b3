"""From values with their roles to a table: shapes, embedded weights, two parts, several colours."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from garkcli.frozen import Frozen, field, replace
from garkcli.sources.found import MAX_STAGES, FoundTable, Misshapen, Row, Rows, Unreadable, troubled
from garkcli.sources.known import conversion
from garkcli.sources.shaping import Texts, changed, is_zero, rows_of, square, symplectic, weights
from garkcli.sources.signatures import Signature
from garkcli.sources.values import (
    Array,
    Null,
    Number,
    Unknown,
    Value,
    Word,
    described,
    first_unknown,
    whole,
)

Roles: TypeAlias = dict[str, Value]
"""What is known of a table, by role: A, b, c, embedded, error, dense, order, …"""


class NoTable(Exception):
    """These arrays are no table, whatever they are called."""


class Meant(Frozen):
    """What may be a table.

    Attributes:
        name: what it is called.
        line: where it begins.
        roles: its values.
        maker: the call that makes it; empty where names alone speak for it.
        signature: of that call, where it is known.
        is_sure: whether the source says that this is a method.
        is_counted: whether the number of arguments is known.
        arguments: how many there are.
        bases: of the class that it is in.
        notes: what people should know of how it was read.
        is_assembled: whether it was put together from single numbers.
    """

    name: str
    line: int
    roles: Roles
    maker: str
    signature: Signature | None
    is_sure: bool = False
    is_counted: bool = False
    arguments: int = 0
    bases: Sequence[str] = ()
    notes: Sequence[str] = field(default_factory=tuple)
    is_assembled: bool = False


def plain(value: Value | None) -> Texts:
    """A value as texts.

    Raises:
        Unreadable: something in it is not known.
    """
    match value:
        case None | Null():
            return None
        case Number():
            return value.scalar.text
        case Word(text=text):
            return text
        case Array(items=items):
            return [plain(conversion([x], 0) if isinstance(x, Word) else x) for x in items]
        case Unknown(reason=reason, line=line):
            raise Unreadable(f"{reason}, line {line}, is not known")
    raise Unreadable(f"{described(value)} is not known")


def table_of(meant: Meant, source: str, format: str) -> FoundTable:
    """The table, or what keeps it from being read.

    Raises:
        NoTable: it is none.
    """
    signature = meant.signature
    roles = meant.roles
    title = roles.get("title")
    empty = FoundTable(
        source,
        meant.line,
        signature.format or format if signature else format,
        title.text if isinstance(title, Word) else meant.name,
        (),
        (),
        order=whole(roles.get("order")) or None,
        embedded_order=whole(roles.get("embedded_order")) or None,
        flags=_flags(roles),
        is_sure=meant.is_sure,
        notes=tuple(meant.notes),
        is_assembled=meant.is_assembled,
    )
    if signature and signature.counts and meant.arguments not in signature.counts:
        counts = " or ".join(map(str, signature.counts))
        return troubled(empty, f"{meant.maker} takes {counts} arguments", is_misshapen=True)
    if not signature and not meant.is_sure:
        _refuse_uses(roles)
    try:
        table = _told(roles, _built(meant, roles, empty))
        return replace(table, is_sure=True) if signature and signature.is_guess else table
    except Unreadable as error:
        if meant.is_sure or meant.is_assembled:
            return troubled(empty, error.message, isinstance(error, Misshapen))
        if _is_unread(roles):
            return troubled(replace(empty, is_sure=True), error.message)
        trouble = f"arrays called A and b do not fit together: {error.message}"
        return replace(troubled(empty, trouble), is_sure=False)


def _refuse_uses(roles: Roles) -> None:
    """Refuse arrays that other code has made: nothing of them is written here."""
    matrix = roles.get("A")
    written = [x for x in (matrix, roles.get("b")) if isinstance(x, Array)]
    if len(written) < 2:
        raise NoTable
    assert isinstance(matrix, Array)
    numbers = sum(_is_number(x) for x in matrix.flat())
    unknown = sum(isinstance(x, Unknown) for x in matrix.flat())
    if unknown and not numbers:
        raise NoTable


def _is_number(value: Value) -> bool:
    """Whether a number is written there, or was before it was changed."""
    if isinstance(value, Unknown):
        return value.was_written
    return isinstance(value, Number) and value.is_given


def _is_unread(roles: Roles) -> bool:
    """Whether it is for an entry that is not known that a table cannot be read."""
    return any(first_unknown(roles[x]) is not None for x in ("A", "b") if x in roles)


def _flags(roles: Roles) -> dict[str, bool]:
    fsal = roles.get("fsal")
    if isinstance(fsal, Word) and fsal.text in {"true", "false"}:
        return {"fsal": fsal.text == "true"}
    return {}


def _told(roles: Roles, table: FoundTable) -> FoundTable:
    """The table with what data say besides: what colours drive, the rounding."""
    told = {key: x.text for key in _WORDS if isinstance(x := roles.get(key), Word)}
    linear = roles.get("linear")
    numbers = map(whole, linear.items) if isinstance(linear, Array) else ()
    return replace(
        table,
        tolerance=told.get("tolerance", table.tolerance),
        parts=tuple(told["parts"].split()) if "parts" in told else table.parts,
        structure=told.get("structure", table.structure).replace("general", ""),
        linear=tuple(x for x in numbers if x is not None),
    )


_WORDS = ("tolerance", "parts", "structure")


def _built(meant: Meant, roles: Roles, empty: FoundTable) -> FoundTable:
    form = meant.signature.form if meant.signature else "rk"
    if form == "ark":
        return _two_parts(roles, empty)
    if form == "lists":
        return _listed(roles, empty)
    if form != "rk":
        stages = _stages(roles)
        drifts = weights(plain(roles.get("drifts")), stages)
        kicks = weights(plain(roles.get("kicks")), stages)
        return symplectic(empty, drifts, kicks, is_force_first=form == "force-first")
    if _is_grid(roles.get("A")):
        return _of_blocks(roles, empty)
    return _single(meant, roles, empty)


MAX_COLOURS = 60
"""Most vector fields of a table."""


def _of_blocks(roles: Roles, empty: FoundTable) -> FoundTable:
    """The method whose blocks are ``A[l][m]``, weights ``b[l]`` and nodes ``c[l]``."""
    blocks = plain(_block_rows(roles.get("A")))
    rows = [x for x in blocks if isinstance(x, list)] if isinstance(blocks, list) else []
    if max(len(rows), *map(len, rows)) > MAX_COLOURS:
        raise Unreadable(f"more than {MAX_COLOURS} vector fields")
    grid = tuple(tuple(None if x is None else rows_of(x) for x in row) for row in rows)
    b, c, embedded = (_row_each(plain(roles.get(x))) for x in ("b", "c", "embedded"))
    if b is None:
        raise Unreadable("weights are expected")
    dense = plain(roles.get("dense"))
    return assembled(
        replace(
            empty,
            is_sure=True,
            A=grid,
            b=b,
            c=(None,) * len(grid) if c is None else c,
            embedded=embedded,
            dense=tuple(map(rows_of, dense)) if isinstance(dense, list) and dense else None,
        )
    )


def _row_each(value: Texts) -> Rows | None:
    """A row for each vector field, or the one that all share."""
    if not isinstance(value, list) or not value:
        return None
    is_each = all(isinstance(x, list) for x in value)
    return tuple(map(weights, value)) if is_each else (weights(value),)


def assembled(table: FoundTable) -> FoundTable:
    """The same with shared stages as one row of blocks, and one row of weights for each colour."""
    colours = len(table.A[0])
    b, c, embedded = table.b, table.c, table.embedded
    are_alike = all(row == table.A[0] for row in table.A) and len(set(c)) == 1
    return replace(
        table,
        A=table.A[:1] if are_alike else table.A,
        b=b * colours if len(b) == 1 else b,
        c=c[:1] if are_alike else c,
        embedded=embedded * colours if embedded and len(embedded) == 1 else embedded,
    )


def _is_grid(value: Value | None) -> bool:
    """Whether it is a list of lists of blocks."""
    if not isinstance(value, Array) or not value.is_matrix:
        return False
    items = [x for row in value.items if isinstance(row, Array) for x in row.items]
    return any(isinstance(x, Array) for x in items)


def _block_rows(value: Value | None) -> Value | None:
    """Blocks of one row or one entry, which MATLAB has as lists and numbers, as matrices; one
    without entries is none.
    """
    if not isinstance(value, Array):
        return value

    def block(x: Value) -> Value:
        if isinstance(x, Number):
            return x if x.is_given else Null()
        if isinstance(x, Array):
            if not x.items:
                return Null()
            return x if x.is_matrix else Array([x])
        return x

    def entry(x: Value) -> Value:
        if isinstance(x, Number) and x.is_given:
            return Array([Array([x])])
        return block(x)

    rows = [x.items if isinstance(x, Array) else [x] for x in value.items]
    return Array([Array([entry(x) for x in row]) for row in rows])


def _stages(roles: Roles) -> int:
    stages = whole(roles.get("stages"))
    if stages is None:
        drifts = roles.get("drifts")
        if isinstance(drifts, Array):
            # sizeof(c) / sizeof(c[0])
            stages = len(drifts.items)
    if stages is None or not 0 < stages <= MAX_STAGES:
        raise Unreadable("the number of stages is not written out")
    return stages


def _single(meant: Meant, roles: Roles, empty: FoundTable) -> FoundTable:
    """A table of one colour."""
    stages = 0
    if meant.signature and "stages" in meant.signature.roles:
        stages = _stages(roles)
    elif whole(roles.get("stages")) and meant.is_sure:
        stages = whole(roles.get("stages")) or 0
    b = _weights_of(roles, meant, stages)
    if stages and len(b) != stages:
        raise Misshapen(f"n_stages is {stages}, B has {len(b)}")
    A = square(plain(_with_rows(roles.get("A"))), len(b))
    c = _nodes(roles, len(b))
    A, b, c, embedded = _embedded(roles, A, b, c, meant)
    return replace(
        empty,
        A=((A,),),
        b=(b,),
        c=(c,),
        embedded=None if embedded is None else (embedded,),
        dense=_dense(roles, len(b)),
    )


def _with_rows(value: Value | None) -> Value | None:
    """A matrix whose rows are assigned one by one: those that nobody wrote are empty."""
    if not isinstance(value, Array) or not any(isinstance(x, Array) for x in value.items):
        return value
    rows = [x if isinstance(x, Array) or _is_written(x) else Array([]) for x in value.items]
    return Array(rows, value.base)


def _is_written(value: Value) -> bool:
    return not isinstance(value, Number) or value.is_given


def _weights_of(roles: Roles, meant: Meant, stages: int) -> Row:
    given = roles.get("b")
    has_default = meant.signature is not None and meant.signature.has_default_weights
    if has_default and (given is None or isinstance(given, Null)):
        return square(plain(roles.get("A")), stages)[-1]
    return weights(plain(given), stages if has_default or meant.maker else 0)


def _nodes(roles: Roles, stages: int) -> Row | None:
    given = roles.get("c")
    if not isinstance(given, Array) or first_unknown(given) is not None:
        return None
    row = weights(plain(given))
    if len(row) == stages - 1:
        # c2 … cs, as some codes have it
        return ("0", *row)
    if len(row) != stages:
        raise Misshapen(f"{len(row)} nodes for {stages} stages")
    return row


def _near(value: Value) -> float:
    return (
        sum(x.near for x in value.flat() if isinstance(x, Number))
        if isinstance(value, Array)
        else 0
    )


def _embedded(
    roles: Roles, A: Rows, b: Row, c: Row | None, meant: Meant
) -> tuple[Rows, Row, Row | None, Row | None]:
    """Embedded weights, or what they are with b an error of; one weight more is that of f at the
    end of the step.
    """
    none = A, b, c, None
    role = next((x for x in ("embedded", "error") if isinstance(roles.get(x), Array)), "")
    if not role or first_unknown(roles[role]) is not None:
        return none
    given = roles[role]
    row = weights(plain(given))
    if len(row) < len(b) and meant.maker:
        row = weights(plain(given), len(b))
    is_error = role == "error" or abs(_near(given)) < 0.05
    if len(row) == len(b) + 1:
        if is_zero(row[-1]):
            row = row[:-1]
        else:
            A = (*((*x, "0") for x in A), (*b, "0"))
            c = None if c is None else (*c, "1")
            b = (*b, "0")
    if len(row) != len(b):
        if meant.is_sure:
            raise Misshapen(f"{role} has {len(row)} entries, b has {len(b)}")
        return none
    if is_error and all(map(is_zero, row)):
        return A, b, c, None
    if not is_error:
        return A, b, c, row
    # E is b̂ − b in the classes of SciPy; the other sign, which others have, changes no order
    sign = "+" if any("RungeKutta" in x for x in meant.bases) else "-"
    return A, b, c, changed(sign, b, row)


def _dense(roles: Roles, stages: int) -> tuple[Rows, ...] | None:
    """A row of coefficients for each stage, where that is what it is."""
    value = roles.get("dense")
    if not isinstance(value, Array) or len(value.items) != stages or not value.is_matrix:
        return None
    if first_unknown(value) is not None:
        return None
    return (rows_of(plain(value)),)


def _two_parts(roles: Roles, empty: FoundTable) -> FoundTable:
    """``TSARKIMEXRegister(name, order, s, At, bt, ct, A, b, c, bembedt, bembed, …)``.

    The implicit table is first; no bt is the last row of At, no b is bt.
    """
    stages = _stages(roles)
    implicit = square(plain(roles.get("A2")), stages)
    b_implicit = _given(roles, "b2", stages) or implicit[-1]
    explicit = square(plain(roles.get("A")), stages)
    b_explicit = _given(roles, "b", stages) or b_implicit
    c_implicit, c_explicit = _given(roles, "c2", stages), _given(roles, "c", stages)
    of_implicit, of_explicit = _given(roles, "embedded2", stages), _given(roles, "embedded", stages)
    embedded = None if of_implicit is None else (of_explicit or of_implicit, of_implicit)
    if all(is_zero(x) for row in (*explicit, b_explicit) for x in row):
        # nothing is explicit: the way to register an implicit method
        own = None if of_implicit is None else (of_implicit,)
        return replace(empty, A=((implicit,),), b=(b_implicit,), c=(c_implicit,), embedded=own)
    row = (explicit, implicit)
    shared = replace(
        empty, A=(row,), b=(b_explicit, b_implicit), c=(c_explicit,), embedded=embedded
    )
    if c_explicit is None:
        return replace(shared, c=(c_implicit,))
    if c_implicit is not None and c_implicit != c_explicit:
        # each part is evaluated at its own times
        return replace(shared, A=(row, row), c=(c_explicit, c_implicit))
    return shared


def _given(roles: Roles, role: str, stages: int) -> Row | None:
    value = roles.get(role)
    return None if value is None or isinstance(value, Null) else weights(plain(value), stages)


def _listed(roles: Roles, empty: FoundTable) -> FoundTable:
    """``AdditiveRungeKuttaMethod([A1, A2, …], [b1, b2, …], [c1, c2, …])``."""
    matrices, rows, nodes = (plain(roles.get(role)) for role in ("A", "b", "c"))
    if not isinstance(matrices, list) or not isinstance(rows, list):
        raise Unreadable("lists of matrices and of weights are expected")
    blocks = tuple(rows_of(x) for x in matrices)
    b = tuple(weights(x) for x in rows)
    c = None
    if isinstance(nodes, list) and nodes:
        each = tuple(weights(x) for x in nodes)
        if len(set(each)) > 1:
            return replace(empty, A=(blocks,) * len(blocks), b=b, c=each)
        c = each[0]
    return assembled(replace(empty, A=(blocks,), b=b, c=(c,)))
