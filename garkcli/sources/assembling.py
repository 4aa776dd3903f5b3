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
    is_written,
    items_of,
    near,
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
    entries = list(matrix.flat()) if isinstance(matrix, Array) else []
    unknown = [x for x in entries if isinstance(x, Unknown)]
    is_written = any(x.was_written for x in unknown) or any(
        isinstance(x, Number) and x.is_given for x in entries
    )
    is_only_made = not is_written and (unknown or len(items_of(matrix)) > 1)
    if not isinstance(matrix, Array) or not others or is_only_made:
        raise NoTable


_COEFFICIENTS = ("b", "c", "delta")
"""Arrays that a matrix, or what stands for it, has beside it."""


def _is_unread(roles: Roles) -> bool:
    """Whether it is for an entry that is not known that a table cannot be read."""
    return any(first_unknown(roles[x]) is not None for x in ("A", "b") if x in roles)


def _has_weights(roles: Roles) -> bool:
    """Whether b has the sum 1, which is that of weights."""
    b = roles.get("b")
    return len(items_of(b)) > 1 and abs(near(b) - 1) < _SAME


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
    if any(x <= set(roles) for x in _WHOLE):
        return True
    return "b" not in roles and all(_is_matrix(roles.get(x)) for x in ("A", "c"))


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
        drifts, kicks = (_row(roles, role, _stages(roles)) for role in ("drifts", "kicks"))
        return symplectic(empty, drifts, kicks, is_force_first=form == "force-first")
    if any(isinstance(x, Array) for row in items_of(roles.get("A")) for x in items_of(row)):
        return _of_blocks(roles, empty)
    return _single(meant, roles, empty)


MAX_COLOURS = 60
"""Most vector fields of a table."""


def _of_blocks(roles: Roles, empty: FoundTable) -> FoundTable:
    """The method whose blocks are ``A[l][m]``, weights ``b[l]`` and nodes ``c[l]``."""
    rows = [items_of(row) or [row] for row in items_of(roles.get("A"))]
    if max(len(rows), *map(len, rows)) > MAX_COLOURS:
        raise Unreadable(f"more than {MAX_COLOURS} vector fields")
    blocks = [[plain(_block(x)) for x in row] for row in rows]
    b, c, embedded = (_row_each(plain(roles.get(x))) for x in ("b", "c", "embedded"))
    if b is None:
        raise Unreadable("weights are expected")
    dense = plain(roles.get("dense"))
    return assembled(
        replace(
            empty,
            is_sure=True,
            A=tuple(tuple(None if x is None else rows_of(x) for x in row) for row in blocks),
            b=b,
            c=(None,) * len(rows) if c is None else c,
            embedded=embedded,
            dense=tuple(map(rows_of, dense)) if isinstance(dense, list) and dense else None,
        )
    )


def _block(value: Value) -> Value:
    """A block of one row or one entry, which MATLAB has as a list or a number, as a matrix; one
    without entries is none.
    """
    if isinstance(value, Number):
        return Array([Array([value])]) if value.is_given else Null()
    if not isinstance(value, Array) or value.is_matrix:
        return value
    return Array([value]) if value.items else Null()


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


def _stages(roles: Roles) -> int:
    # sizeof(c) / sizeof(c[0])
    stages = whole(roles.get("stages"))
    stages = len(items_of(roles.get("drifts"))) if stages is None else stages
    if not 0 < stages <= MAX_STAGES:
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
        A = _square(roles, "A", len(b))
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
    rows = items_of(roles.get("b"))
    if len(rows) != 2 or any(len(items_of(x)) < 2 for x in rows):
        return roles
    return {**roles, "b": rows[0], "embedded": rows[1]}


def _without_further_stages(roles: Roles) -> Roles:
    """The stages that have weights, where A is a triangle in one row and has further stages: those
    of dense output. The nodes are the row sums.
    """
    A, b, c = (items_of(roles.get(x)) for x in ("A", "b", "c"))
    stages = (1 + isqrt(1 + 8 * len(A))) // 2
    nodes = c[1 - stages :]
    if 2 * len(A) != stages * (stages - 1) or len(nodes) != stages - 1 or not 1 < len(b) < stages:
        return roles
    has_diagonal = len(b) == len(c) and abs(near(*c[:1])) < _SAME
    if has_diagonal or any(isinstance(x, Array) for x in (*A, *b, *c)):
        return roles
    rows = [A[i * (i - 1) // 2 : i * (i + 1) // 2] for i in range(stages)]
    pairs = zip(rows[1:], nodes, strict=True)
    if sum(abs(near(*row) - near(node)) > _SAME for row, node in pairs) > 1:
        return roles
    return {
        **roles,
        "A": Array([Array(x) for x in rows[: len(b)]]),
        "c": Array(nodes[: len(b) - 1]),
    }


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
    if _is_matrix(A) and len(items_of(A)) == 1 and "c" not in roles:
        # {{a2, a3, …}}
        A = items_of(A)[0]
    if "gamma1" in roles:
        names = ("gamma1", "gamma2", "gamma3", "delta", "A")
        rows = [_given(roles, x) or () for x in names]
        rows[2] = rows[2] or (ZERO,) * len(rows[-1])
        return "3S*", of_three_registers(*rows)
    if "b" not in roles and _is_matrix(roles.get("c")) and _is_matrix(A):
        alpha, beta = (rows_of(plain(roles[x])) for x in ("c", "A"))
        return "Shu–Osher", of_shu_osher(alpha, beta)
    if form not in {"rk", "lists"}:
        return form, low_storage(
            form, [_row(roles, x) for x in roles if x in _DIAGONALS], _row(roles, "b")
        )
    if not isinstance(A, Array) or _is_matrix(A) or not isinstance(roles.get("b"), Array):
        return None
    row, b = plain(A), _row(roles, "b")
    if not is_row(row) or not _is_pair_of_rows(row_of(row), len(b)):
        return None
    return recognised(row_of(row), b, _row(roles, "c") if "c" in roles else None)


_DIAGONALS = ("A", "A_2", "A_3", "A_4")


def _is_pair_of_rows(row: Row, stages: int) -> bool:
    """Whether a row has a number per stage, and is no matrix that is written out flat."""
    if stages == 3 and len(row) == 3:
        return is_zero(row[0])
    return stages > 2 - (len(row) == stages) and len(row) in (stages - 1, stages)


def _nystrom(roles: Roles, empty: FoundTable) -> FoundTable:
    """Ā, b̄, b and c as the pair (q, p) with linear velocities."""
    b_q, b = _row(roles, "b_q"), _row(roles, "b")
    stages = len(b)
    A = _square(roles, "A_q", stages)
    c = _nodes(roles, A)
    if c is None:
        raise Unreadable("the nodes of a Nyström method are not written out")
    made = of_nystrom(A, b_q, c)
    units = [tuple("1" if i == j else ZERO for j in range(stages)) for i in range(stages)]
    embedded = None
    if all(len(items_of(roles.get(x))) == stages for x in ("error_q", "error")):
        low = of_nystrom(A, changed("-", b_q, _row(roles, "error_q")), c).b
        embedded = (low, changed("-", b, _row(roles, "error")))
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


def _square(roles: Roles, role: str, stages: int) -> Rows:
    """A matrix; of one whose rows are assigned one by one, those that nobody wrote are empty."""
    value = roles.get(role)
    rows = items_of(value)
    if any(isinstance(x, Array) for x in rows):
        value = Array([x if isinstance(x, Array) or is_written(x) else Array([]) for x in rows])
    return square(plain(value), stages)


def _row(roles: Roles, role: str, stages: int = 0) -> Row:
    return weights(plain(roles.get(role)), stages)


def _given(roles: Roles, role: str, stages: int = 0) -> Row | None:
    value = roles.get(role)
    return None if value is None or isinstance(value, Null) else _row(roles, role, stages)


def _weights_of(roles: Roles, meant: Meant, stages: int) -> Row:
    has_default = meant.signature is not None and meant.signature.has_default_weights
    row = _given(roles, "b", stages if has_default or meant.maker else 0)
    if row is None and has_default:
        return _square(roles, "A", stages)[-1]
    return _row(roles, "b") if row is None else row


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
    total = near(given)
    is_error = abs(total) < 0.05 or (role == "error" and meant.is_assembled)
    off = total if role == "error" else total - 1
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
    stages = 0 if "stages" in roles else len(items_of(roles.get("b2")))
    stages = stages or _stages(roles)
    implicit, explicit = (square(plain(roles.get(x)), stages) for x in ("A2", "A"))
    b_implicit = _given(roles, "b2", stages) or implicit[-1]
    b_explicit = _given(roles, "b", stages) or b_implicit
    c_implicit, c_explicit = _given(roles, "c2", stages), _given(roles, "c", stages)
    of_implicit = _given_low(roles, "2", b_implicit)
    of_explicit = _given_low(roles, "", b_explicit)
    if all(is_zero(x) for row in (*explicit, b_explicit) for x in row):
        # nothing is explicit: the way to register an implicit method
        own = None if of_implicit is None else (of_implicit,)
        return replace(empty, A=((implicit,),), b=(b_implicit,), c=(c_implicit,), embedded=own)
    embedded = None if of_implicit is None else (of_explicit or of_implicit, of_implicit)
    found = replace(empty, b=(b_explicit, b_implicit), embedded=embedded)
    row, c = (explicit, implicit), (c_explicit, c_implicit)
    if c == (None, None):
        sums = [[near(*items_of(x)) for x in items_of(roles[role])] for role in ("A", "A2")]
        is_shared = all(abs(x - y) <= _SAME for x, y in zip(*sums, strict=False))
    else:
        # or each part is evaluated at its own times
        is_shared = None in c or c_implicit == c_explicit
    if is_shared:
        return replace(found, A=(row,), c=(c_explicit or c_implicit,))
    return replace(found, A=(row, row), c=c)


def _given_low(roles: Roles, part: str, b: Row) -> Row | None:
    """The embedded weights of a part, or what they are with b an error of."""
    error = roles.get(f"error{part}")
    if isinstance(error, Array) and error.items:
        return changed("-", b, weights(plain(error), len(b)))
    return _given(roles, f"embedded{part}", len(b))


_SAME = 1e-9
"""Sums that differ by less are the same."""


def _listed(roles: Roles, empty: FoundTable) -> FoundTable:
    """``AdditiveRungeKuttaMethod([A1, A2, …], [b1, b2, …], [c1, c2, …])``."""
    matrices, rows, nodes = (plain(roles.get(role)) for role in ("A", "b", "c"))
    if not isinstance(matrices, list) or not isinstance(rows, list):
        raise Unreadable("lists of matrices and of weights are expected")
    blocks = tuple(rows_of(x) for x in matrices)
    c = tuple(weights(x) for x in nodes) if isinstance(nodes, list) and nodes else (None,)
    are_shared = len(set(c)) == 1
    A, b = (blocks,) * (1 if are_shared else len(blocks)), tuple(weights(x) for x in rows)
    return assembled(replace(empty, A=A, b=b, c=c[:1] if are_shared else c))
