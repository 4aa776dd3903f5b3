"""From values with their roles to a table: shapes, embedded weights, two parts, several colours."""

from __future__ import annotations

from collections.abc import Sequence
from math import isqrt
from typing import TypeAlias

from garkcli.frozen import Frozen, field, replace
from garkcli.sources.found import MAX_STAGES, FoundTable, Misshapen, Row, Rows, Unreadable, troubled
from garkcli.sources.known import conversion
from garkcli.sources.registers import (
    Converted,
    low_storage,
    of_nystrom,
    of_shu_osher,
    of_three_registers,
    recognised,
)
from garkcli.sources.shaping import (
    ZERO,
    Texts,
    changed,
    is_row,
    is_zero,
    row_of,
    rows_of,
    square,
    symplectic,
    weights,
)
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


FAR = 1
"""Embedded weights have a sum that is nearer to 1, and their differences one nearer to 0, misprints
included.
"""


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
            raise Unreadable(f"{reason}, line {line}, is not known" if line else reason)
    raise Unreadable(f"{described(value)} is not known")


def table_of(meant: Meant, source: str, format: str) -> FoundTable:
    """The table, or what keeps it from being read.

    Raises:
        NoTable: it is none.
    """
    signature = meant.signature
    roles = meant.roles
    title = roles.get("title")
    order, embedded_order = _orders(roles)
    empty = FoundTable(
        source,
        meant.line,
        signature.format or format if signature else format,
        title.text if isinstance(title, Word) else meant.name,
        (),
        (),
        order=order,
        embedded_order=embedded_order,
        flags=_flags(roles),
        is_sure=meant.is_sure,
        notes=tuple(meant.notes),
        is_assembled=meant.is_assembled,
    )
    if signature and signature.counts and meant.arguments not in signature.counts:
        counts = " or ".join(map(str, signature.counts))
        return troubled(empty, f"{meant.maker} takes {counts} arguments", is_misshapen=True)
    if not (signature or meant.is_sure or meant.is_assembled):
        _refuse_uses(roles)
    try:
        table = _told(roles, _built(meant, roles, empty))
        return replace(table, is_sure=True) if signature and signature.is_guess else table
    except Unreadable as error:
        if meant.is_sure or meant.is_assembled:
            sure = replace(empty, is_sure=True)
            return troubled(sure, error.message, isinstance(error, Misshapen))
        if _is_unread(roles) or (_has_weights(roles) and not isinstance(error, Misshapen)):
            return troubled(replace(empty, is_sure=True), error.message)
        trouble = f"arrays called A and b do not fit together: {error.message}"
        return replace(troubled(empty, trouble), is_sure=False)


def _refuse_uses(roles: Roles) -> None:
    """Refuse arrays that other code has made: nothing of them is written here."""
    matrix = roles.get("A", roles.get("A_q"))
    others = [x for x in _COEFFICIENTS if isinstance(roles.get(x), Array)]
    if not isinstance(matrix, Array) or not others:
        raise NoTable
    numbers = sum(_is_number(x) for x in matrix.flat())
    unknown = sum(isinstance(x, Unknown) for x in matrix.flat())
    if unknown and not numbers:
        raise NoTable


_COEFFICIENTS = ("b", "c", "delta")
"""Arrays that a matrix, or what stands for it, has beside it."""


def _is_number(value: Value) -> bool:
    """Whether a number is written there, or was before it was changed."""
    if isinstance(value, Unknown):
        return value.was_written
    return isinstance(value, Number) and value.is_given


def _is_unread(roles: Roles) -> bool:
    """Whether it is for an entry that is not known that a table cannot be read."""
    return any(first_unknown(roles[x]) is not None for x in ("A", "b") if x in roles)


def _has_weights(roles: Roles) -> bool:
    """Whether b has the sum 1, which is that of weights."""
    b = roles.get("b")
    is_list = isinstance(b, Array) and len(b.items) > 1
    return is_list and abs(_near(roles["b"]) - 1) < _SAME


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


def is_complete(roles: Roles) -> bool:
    """Whether these values may be all of a table."""
    given = set(roles)
    if any(x <= given for x in _WHOLE):
        return True
    return "b" not in given and all(_is_matrix(roles.get(x)) for x in ("A", "c"))


_WHOLE = (
    *({"A", "b"}, {"A", "A2"}, {"drifts"}, {"A_q", "b_q", "b"}),
    {"A", "delta", "gamma1", "gamma2"},
)


def _is_matrix(value: Value | None) -> bool:
    return isinstance(value, Array) and value.is_matrix


def _built(meant: Meant, roles: Roles, empty: FoundTable) -> FoundTable:
    form = meant.signature.form if meant.signature else "rk"
    if form == "ark":
        return _two_parts(roles, empty)
    if form == "lists":
        return _listed(roles, empty)
    if {"A_q", "b_q"} <= set(roles):
        return _nystrom(roles, empty)
    if form.endswith("-first"):
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
    roles = _without_further_stages(_with_ends(_with_both_rows(roles)))
    if meant.signature and "stages" in meant.signature.roles:
        stages = _stages(roles)
    elif whole(roles.get("stages")) and meant.is_sure:
        stages = whole(roles.get("stages")) or 0
    found = _of_registers(meant, roles)
    if found is None:
        b = _weights_of(roles, meant, stages)
        if stages and len(b) != stages:
            raise Misshapen(f"n_stages is {stages}, B has {len(b)}")
        A = square(plain(_with_rows(roles.get("A"))), len(b))
    else:
        form, made = found
        A, b = made.A, made.b
        note = f"the coefficients are those of the form {form}"
        is_sure = bool(meant.signature) or "c" in roles
        empty = replace(
            empty,
            notes=(*empty.notes, note),
            is_assembled=not is_sure,
            is_sure=True,
            units=made.units,
        )
        if form == "Shu–Osher":
            roles = {**roles, "c": roles.get("nodes", Null())}
    c = _nodes(roles, A)
    A, b, c, embedded, turned = _embedded(roles, A, b, c, meant)
    return replace(
        empty,
        A=((A,),),
        b=(b,),
        c=(c,),
        embedded=None if embedded is None else (embedded,),
        turned=None if turned is None else (turned,),
        dense=_dense(roles, len(b)),
    )


def _with_both_rows(roles: Roles) -> Roles:
    """Weights and embedded weights apart, where they are the rows of one matrix."""
    rows = roles.get("b")
    if not isinstance(rows, Array) or not rows.is_matrix or len(rows.items) != 2:
        return roles
    if any(isinstance(x, Array) and len(x.items) < 2 for x in rows.items):
        return roles
    return {**roles, "b": rows.items[0], "embedded": rows.items[1]}


def _without_further_stages(roles: Roles) -> Roles:
    """The stages that have weights, where A is a triangle in one row and has further stages: those
    of dense output. The nodes are the row sums.
    """
    given = [roles.get(x) for x in ("A", "b", "c")]
    A, b, c = (x.items if isinstance(x, Array) and not x.is_matrix else [] for x in given)
    stages = (1 + isqrt(1 + 8 * len(A))) // 2
    nodes = c[1 - stages :]
    if 2 * len(A) != stages * (stages - 1) or len(nodes) != stages - 1 or not 1 < len(b) < stages:
        return roles
    if len(b) == len(c) and abs(_near(Array(c[:1]))) < _SAME:
        # A has its diagonal
        return roles
    rows = [Array(A[i * (i - 1) // 2 : i * (i + 1) // 2]) for i in range(stages)]
    pairs = zip(rows[1:], nodes, strict=True)
    if sum(abs(_near(row) - _near(Array([node]))) > _SAME for row, node in pairs) > 1:
        return roles
    return {**roles, "A": Array([*rows[: len(b)]]), "c": Array(nodes[: len(b) - 1])}


def _orders(roles: Roles) -> tuple[int | None, int | None]:
    """The declared orders; a pair of them, or the lower and the higher one, are those of weights
    and embedded weights that are rows of one matrix.
    """
    order, embedded = roles.get("order"), roles.get("embedded_order")
    if isinstance(order, Array) and len(order.items) in (1, 2):
        order, embedded = (*order.items, embedded)[:2]
    if order is None and embedded is None and _with_both_rows(roles) is not roles:
        order, embedded = roles.get("lower_order"), roles.get("higher_order")
    return whole(order) or None, whole(embedded) or None


def _with_ends(roles: Roles) -> Roles:
    """The rows whole, where their first or last number is apart."""
    found = dict(roles)
    for role in ("A", "b", "embedded"):
        row = found.get(role)
        ends = [found.pop(f"{role}_{x}", None) for x in ("first", "last")]
        if isinstance(row, Array) and ends != [None, None]:
            parts = ([ends[0]], row.items, [ends[1]])
            found[role] = Array([x for part in parts for x in part if x is not None])
    return found


def _of_registers(meant: Meant, roles: Roles) -> tuple[str, Converted] | None:
    """The form of low-storage and Shu–Osher coefficients, and what they are; None of others."""
    form = meant.signature.form if meant.signature else "rk"
    A = roles.get("A")
    if isinstance(A, Array) and A.is_matrix and len(A.items) == 1 and "c" not in roles:
        # {{a2, a3, …}}
        A = A.items[0]
    if "gamma1" in roles:
        names = ("gamma1", "gamma2", "gamma3", "delta", "A")
        rows = [weights(plain(roles[x])) if x in roles else () for x in names]
        rows[2] = rows[2] or (ZERO,) * len(rows[-1])
        return "3S*", of_three_registers(*rows)
    if "b" not in roles and _is_matrix(roles.get("c")) and _is_matrix(A):
        alpha, beta = (rows_of(plain(roles[x])) for x in ("c", "A"))
        return "Shu–Osher", of_shu_osher(alpha, beta)
    if form not in {"rk", "lists"}:
        rows = [weights(plain(x)) for role, x in roles.items() if role in _DIAGONALS]
        return form, low_storage(form, rows, weights(plain(roles.get("b"))))
    if not isinstance(A, Array) or _is_matrix(A) or not isinstance(roles.get("b"), Array):
        return None
    row, b = plain(A), weights(plain(roles["b"]))
    if not is_row(row) or not _is_pair_of_rows(row_of(row), len(b)):
        return None
    c = roles.get("c")
    return recognised(row_of(row), b, weights(plain(c)) if c is not None else None)


_DIAGONALS = ("A", "A_2", "A_3", "A_4")


def _is_pair_of_rows(row: Row, stages: int) -> bool:
    """Whether a row has a number per stage, and is no matrix that is written out flat."""
    if stages == 3 and len(row) == 3:
        return is_zero(row[0])
    return stages > 2 - (len(row) == stages) and len(row) in (stages - 1, stages)


def _nystrom(roles: Roles, empty: FoundTable) -> FoundTable:
    """Ā, b̄, b and c as the pair (q, p) with linear velocities."""
    b_q, b = (weights(plain(roles[x])) for x in ("b_q", "b"))
    stages = len(b)
    c = _nodes(roles, square(plain(_with_rows(roles["A_q"])), stages))
    if c is None:
        raise Unreadable("the nodes of a Nyström method are not written out")
    A = square(plain(_with_rows(roles["A_q"])), stages)
    made = of_nystrom(A, b_q, c)
    units = [tuple("1" if i == j else ZERO for j in range(stages)) for i in range(stages)]
    embedded = None
    errors = [roles.get(x) for x in ("error_q", "error")]
    if all(isinstance(x, Array) and len(x.items) == stages for x in errors):
        of_error = [weights(plain(x)) for x in errors]
        low = of_nystrom(A, changed("-", b_q, of_error[0]), c).b
        embedded = (low, changed("-", b, of_error[1]))
    return replace(
        empty,
        A=((None, ((ZERO,) * stages, *units)), (made.A, None)),
        b=(made.b, b),
        c=(None, None),
        embedded=embedded,
        parts=("q", "p"),
        structure="nystrom",
        units=made.units,
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


def _nodes(roles: Roles, A: Rows) -> Row | None:
    stages = len(A)
    given = roles.get("c")
    if not isinstance(given, Array) or first_unknown(given) is not None:
        return None
    row = weights(plain(given))
    if len(row) == stages - 1:
        # c2 … cs, as some codes have it
        return ("0", *row)
    if len(row) != stages:
        raise Misshapen(f"{len(row)} nodes for {stages} stages")
    is_from_the_second = is_zero(row[-1]) and not is_zero(row[0])
    if is_from_the_second and all(map(is_zero, A[0])) and not all(map(is_zero, A[-1])):
        # c2 … cs, and a number that nothing uses
        return ("0", *row[:-1])
    return row


def _near(value: Value) -> float:
    return (
        sum(x.near for x in value.flat() if isinstance(x, Number))
        if isinstance(value, Array)
        else 0
    )


def _embedded(
    roles: Roles, A: Rows, b: Row, c: Row | None, meant: Meant
) -> tuple[Rows, Row, Row | None, Row | None, Row | None]:
    """Embedded weights, or what they are with b an error of, by either sign; one weight more is
    that of f at the end of the step.
    """
    none = A, b, c, None, None
    role = next((x for x in ("embedded", "error") if isinstance(roles.get(x), Array)), "")
    if not role or first_unknown(roles[role]) is not None:
        return none
    given = roles[role]
    row = weights(plain(given))
    if len(row) < len(b) and meant.maker:
        row = weights(plain(given), len(b))
    near = _near(given)
    is_error = abs(near) < 0.05 or (role == "error" and meant.is_assembled)
    off = near if role == "error" else near - 1
    if not (meant.is_sure or is_error) and abs(off) > FAR:
        # an array of that name which is something else
        return none
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
        return A, b, c, None, None
    if not is_error:
        return A, b, c, row, None
    low, high = changed("-", b, row), changed("+", b, row)
    if any("RungeKutta" in x for x in meant.bases):
        # E is b̂ − b in the classes of SciPy
        return A, b, c, high, None
    return A, b, c, low, high


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
    given = roles.get("b2")
    of_weights = isinstance(given, Array) and "stages" not in roles
    stages = len(given.items) if of_weights and isinstance(given, Array) else _stages(roles)
    implicit = square(plain(roles.get("A2")), stages)
    b_implicit = _given(roles, "b2", stages) or implicit[-1]
    explicit = square(plain(roles.get("A")), stages)
    b_explicit = _given(roles, "b", stages) or b_implicit
    c_implicit, c_explicit = _given(roles, "c2", stages), _given(roles, "c", stages)
    of_implicit = _given_low(roles, "2", b_implicit)
    of_explicit = _given_low(roles, "", b_explicit)
    embedded = None if of_implicit is None else (of_explicit or of_implicit, of_implicit)
    if all(is_zero(x) for row in (*explicit, b_explicit) for x in row):
        # nothing is explicit: the way to register an implicit method
        own = None if of_implicit is None else (of_implicit,)
        return replace(empty, A=((implicit,),), b=(b_implicit,), c=(c_implicit,), embedded=own)
    row = (explicit, implicit)
    shared = replace(
        empty, A=(row,), b=(b_explicit, b_implicit), c=(c_explicit,), embedded=embedded
    )
    if c_explicit is None and c_implicit is None and _have_other_sums(roles["A"], roles["A2"]):
        return replace(shared, A=(row, row), c=(None, None))
    if c_explicit is None:
        return replace(shared, c=(c_implicit,))
    if c_implicit is not None and c_implicit != c_explicit:
        # each part is evaluated at its own times
        return replace(shared, A=(row, row), c=(c_explicit, c_implicit))
    return shared


def _given_low(roles: Roles, part: str, b: Row) -> Row | None:
    """The embedded weights of a part, or what they are with b an error of."""
    error = roles.get(f"error{part}")
    if isinstance(error, Array) and error.items:
        return changed("-", b, weights(plain(error), len(b)))
    return _given(roles, f"embedded{part}", len(b))


def _have_other_sums(first: Value, second: Value) -> bool:
    """Whether the rows of two matrices have different sums, which are their nodes."""
    if not isinstance(first, Array) or not isinstance(second, Array):
        return False
    pairs = zip(map(_near, first.items), map(_near, second.items), strict=False)
    return any(abs(x - y) > _SAME for x, y in pairs)


_SAME = 1e-9
"""Sums that differ by less are the same."""


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
