"""Tables from values with their roles: shapes, embedded weights, two parts, several colours."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from garkcli.frozen import Frozen, replace
from garkcli.sources.couplings import FORM as COUPLING
from garkcli.sources.couplings import coupling_table
from garkcli.sources.found import MAX_STAGES, FoundTable, Misshapen, Row, Rows, Unreadable, troubled
from garkcli.sources.known import conversion
from garkcli.sources.linear_stages import FORMS as ROSENBROCK
from garkcli.sources.linear_stages import rosenbrock_table
from garkcli.sources.registers import ConvertedScheme, converted
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
from garkcli.sources.signatures import NAMED, SIGNATURES, Signature
from garkcli.sources.values import (
    FILL,
    Array,
    Null,
    Number,
    Unknown,
    Value,
    Word,
    described,
    first_unknown,
    integer,
    is_matrix,
    is_written,
    items_of,
    near,
    whole,
)
from garkcli.sources.values import is_zero as is_nought

Roles: TypeAlias = dict[str, Value]
"""The values of a table by role: A, b, c, embedded, error, dense, order, …"""


CLOSE = 0.01
"""Largest distance from 1 of row sums of combinations."""
SMALL = 0.05
"""Largest distance from 0 of the sum of differences of weights, misprints included."""
FAR = 1
"""Largest distance from 1 of the sum of embedded weights, and from 0 of the sum of their
differences, misprints included.
"""


class NoTable(Exception):
    """These arrays are no table, in spite of their names."""


class Meant(Frozen):
    """A candidate for a table.

    Attributes:
        table: without coefficients yet.
        roles: its values by role.
        signature: of the call that makes it; ``NAMED`` if only its names are evidence.
        maker: the call or other construct that makes it; empty for names.
        bases: of the class around it.
    """

    table: FoundTable
    roles: Roles
    signature: Signature = NAMED
    maker: str = ""
    bases: Sequence[str] = ()


def plain(value: Value | None) -> Texts:
    """A value as texts.

    Raises:
        Unreadable: a part of it is unknown.
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


def table_of(meant: Meant) -> FoundTable:
    """The table, or a table with the reason why it cannot be read.

    Raises:
        NoTable: the candidate is no table.
    """
    signature, roles, place = meant.signature, meant.roles, meant.table
    title = roles.get("title")
    name = title.text if isinstance(title, Word) else place.name
    order, low = _orders(roles)
    format = signature.format or place.format
    empty = replace(place, format=format, name=name, order=order, embedded_order=low)
    is_sure = place.is_sure or place.is_assembled
    if signature is NAMED and not is_sure:
        _refuse_uses(roles)
    try:
        table = _with_data(roles, _built(meant, roles, empty))
        if not is_sure and not 0 < (order or 1) <= 2 * table.stages:
            # no method has this order, so it is of something else
            table = replace(table, order=None)
        return replace(table, is_sure=True) if signature.is_guess else table
    except Unreadable as error:
        is_misshapen, trouble = isinstance(error, Misshapen), error.message
        is_likely = bool(meant.maker) or may_be_coefficients(roles)
        is_close = not is_misshapen or (is_likely and signature is NAMED)
        is_unread = is_likely and _is_unread(roles)
        if not (is_sure or is_unread or (is_close and _has_weights(roles))):
            trouble = f"arrays called A and b do not fit together: {trouble}"
            return replace(troubled(empty, trouble), is_sure=False)
        return troubled(empty, trouble, place.is_sure and is_misshapen)


def _refuse_uses(roles: Roles) -> None:
    """Raises NoTable for arrays that other code has made: the source contains none of their
    numbers.
    """
    matrix = roles.get("A", roles.get("A_q"))
    others = [x for x in ("b", "c", "delta") if isinstance(roles.get(x), Array)]
    entries = list(matrix.flat()) if isinstance(matrix, Array) else []
    unknown = [x.was_written for x in entries if isinstance(x, Unknown)]
    given_flags = [x.is_given for x in entries if isinstance(x, Number)]
    is_only_made = not any(unknown + given_flags) and (unknown or len(items_of(matrix)) > 1)
    if not isinstance(matrix, Array) or not others or is_only_made:
        raise NoTable


def _is_unread(roles: Roles) -> bool:
    """Whether an unknown entry keeps a table from being read."""
    return any(first_unknown(roles[x]) is not None for x in ("A", "b") if x in roles)


def may_be_coefficients(roles: Roles) -> bool:
    """Whether arrays called A and b are more than linear algebra: there are nodes, or fractions."""
    A, b, c = (items_of(roles.get(x)) for x in "Abc")
    numbers = Array([x for x in roles.values() if isinstance(x, Array)]).flat()
    fractions = sum(isinstance(x, Number) and (x.value is None or x.value.q != 1) for x in numbers)
    return len(A) == len(b) == len(c) or fractions > 1


def _has_weights(roles: Roles) -> bool:
    """Whether b has the sum 1, as weights have."""
    b = roles.get("b")
    return len(items_of(b)) > 1 and abs(near(b) - 1) < _SAME


def _with_data(roles: Roles, table: FoundTable) -> FoundTable:
    """The table with further data: the parts that colours drive, the rounding."""
    words = {role: x.text for role, x in roles.items() if isinstance(x, Word)}
    return replace(
        table,
        tolerance=words.get("tolerance", table.tolerance),
        parts=tuple(words["parts"].split()) if "parts" in words else table.parts,
        structure=words.get("structure", table.structure).replace("general", ""),
        linear=tuple(n for x in items_of(roles.get("linear")) if (n := whole(x)) is not None),
        flags={"fsal": words["fsal"] == "true"} if words.get("fsal") in {"true", "false"} else {},
    )


def is_complete(roles: Roles) -> bool:
    """Whether these values may be all of a table."""
    if any(x <= set(roles) for x in _WHOLE) or len(roles.keys() & {"A", "A1", "A2"}) > 1:
        return True
    return "b" not in roles and all(is_matrix(roles.get(x)) for x in ("A", "c"))


_WHOLE = ({"A", "b"}, {"drifts"}, {"A_q", "b_q", "b"}, {"A", "delta", "gamma1", "gamma2"})


def _built(meant: Meant, roles: Roles, empty: FoundTable) -> FoundTable:
    form = meant.signature.form
    if form in ROSENBROCK:
        role_names = ("A", "b", "c", "d", "embedded", "error", "gamma", "C", "dense")
        texts = {role: plain(roles.get(role)) for role in role_names}
        return rosenbrock_table(texts, empty, form, roles)
    if form == COUPLING:
        texts = {role: plain(roles.get(role)) for role in ("c", "omega", "gamma")}
        return coupling_table(texts, empty, roles)
    base = roles.get("base")
    if form == "slow" and isinstance(base, Word):
        return replace(empty, base=base.text, is_slow=True, c=())
    if form == "slow":
        has_estimate = empty.embedded_order is not None
        with_estimate = (
            roles if has_estimate else {x: y for x, y in roles.items() if x != "embedded"}
        )
        return replace(_single(replace(meant, signature=NAMED), with_estimate, empty), is_slow=True)
    A = items_of(roles.get("A"))
    if form == "ark":
        return _two_parts(meant, roles, empty)
    if {"A_q", "b_q"} <= set(roles):
        return _nystrom(roles, empty)
    if form.endswith("-first"):
        drifts, kicks = (_row(roles, role, _stages(roles)) for role in ("drifts", "kicks"))
        return symplectic(empty, drifts, kicks, is_force_first=form == "force-first")
    if form == "lists":
        # [A1, A2, …]
        return _of_blocks({**roles, "A": Array([Array(A)] * len(A))}, empty)
    if any(isinstance(x, Array) for row in A for x in items_of(row)):
        return _of_blocks(roles, empty)
    return _single(meant, roles, empty)


MAX_COLOURS = 60
"""Most vector fields of a table."""


def _of_blocks(roles: Roles, empty: FoundTable) -> FoundTable:
    """The method with blocks ``A[l][m]``, weights ``b[l]`` and nodes ``c[l]``; blocks in equal rows
    share their stages, and a single row of weights is for all.
    """
    rows = [items_of(row) or [row] for row in items_of(roles.get("A"))]
    colours = max(map(len, rows), default=0)
    if not 0 < max(colours, len(rows)) <= MAX_COLOURS:
        raise Unreadable(f"more than {MAX_COLOURS} vector fields" if rows else "no matrices")
    if len(rows) not in (1, colours) or any(len(row) != colours for row in rows):
        raise Unreadable("the blocks make no square")
    blocks = [[plain(_block(x)) for x in row] for row in rows]
    A = tuple(tuple(None if x is None else rows_of(x) for x in row) for row in blocks)
    b, c, embedded = (_row_each(plain(roles.get(x)), colours) for x in ("b", "c", "embedded"))
    if b is None:
        raise Unreadable("weights are expected")
    dense = plain(roles.get("dense"))
    are_alike = len(set(A)) == 1 and len(set(c or "-")) == 1
    return replace(
        empty,
        A=A[:1] if are_alike else A,
        b=b,
        c=(c or (None,) * len(A))[: 1 if are_alike else None],
        embedded=embedded,
        dense=tuple(map(rows_of, dense)) if isinstance(dense, list) and dense else None,
    )


def _block(value: Value) -> Value:
    """A block of one row or one entry, a list or a number in MATLAB, as a matrix; Null for one
    without entries.
    """
    if isinstance(value, Number):
        return Array([Array([value])]) if value.is_given else Null()
    if not isinstance(value, Array) or value.is_matrix:
        return value
    return Array([value]) if value.items else Null()


def _row_each(value: Texts, colours: int) -> Rows | None:
    """A row for each vector field, or the single row for all."""
    if not isinstance(value, list) or not value:
        return None
    is_each = all(isinstance(x, list) for x in value)
    rows = tuple(map(weights, value)) if is_each else (weights(value),)
    if len(rows) not in (1, colours):
        raise Unreadable(f"{len(rows)} rows of numbers for {colours} vector fields")
    return rows * colours if len(rows) == 1 else rows


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
    roles = _with_ends(_with_both_rows(roles))
    if "stages" in meant.signature.roles:
        stages = _stages(roles)
    elif empty.is_sure:
        stages = whole(roles.get("stages")) or 0
    registers = _of_registers(meant, roles)
    if registers is None:
        own_weights = _row_if_any(roles, "b", stages if meant.maker else 0)
        if own_weights is None and meant.signature.has_default_weights:
            own_weights = _square(roles, "A", stages)[-1]
        b = _row(roles, "b") if own_weights is None else own_weights
        roles = _without_later_stages(roles)
        if stages and len(b) != stages:
            raise Misshapen(f"n_stages is {stages}, B has {len(b)}")
        if meant.maker and _has_weights(roles):
            roles = {**roles, "A": _without_zeros(roles.get("A"), len(b))}
        A = _square(roles, "A", len(b))
    else:
        form, converted_form = registers
        A, b = converted_form.A, converted_form.b
        note = f"the coefficients are those of the form {form}"
        is_guess = meant.signature is NAMED and "c" not in roles
        is_told = {"notes": (*empty.notes, note), "is_assembled": is_guess, "is_sure": True}
        empty = replace(empty, **is_told, units=converted_form.units)
        if form == "Shu–Osher":
            roles = {**roles, "c": roles.get("nodes", Null())}
    notes = (*empty.notes, *not_read(roles))
    table = replace(empty, A=((A,),), b=(b,), c=(_nodes(roles, A),), notes=notes)
    table = _with_embedded(table, roles, meant)
    dense, degree = items_of(roles.get("dense")), whole(roles.get("dense_degree"))
    if degree and len(dense) == table.stages * degree:
        dense = [Array(dense[i : i + degree]) for i in range(0, len(dense), degree)]
    rows = Array(dense)
    if len(dense) != table.stages or not rows.is_matrix or first_unknown(rows):
        return table
    return replace(table, dense=(rows_of(plain(rows)),))


NEAR_ENTRIES = 1e-12
"""Entries that differ by less are equal."""
BESIDE = {"c": "nodes are", "embedded": "embedded weights are", "error": "error weights are"}
"""Arrays that a table may lack."""


def not_read(roles: Roles) -> tuple[str, ...]:
    """Notes on the arrays beside a matrix and its weights that are written but unknown."""
    unknown = {role: first_unknown(roles[role]) for role in BESIDE if role in roles}
    return tuple(
        f"{BESIDE[role]} not read: {x.reason}"
        for role, x in unknown.items()
        if x and x.reason != "never assigned" and not x.reason.startswith("the argument")
    )


def _without_later_stages(roles: Roles) -> Roles:
    """Leaves out the stages of dense output, which those of the step do not use: the first of them
    begins where the step ends, so its row has the weights, or the others are a method.
    """
    rows, b, c = ([*items_of(roles.get(x))] for x in ("A", "b", "c"))
    low = max(len(items_of(roles.get(x))) for x in ("embedded", "error"))
    if not max(1, low - 1) < len(b) < len(rows) == len(c):
        return roles
    end = [*items_of(rows[len(b)])][: len(b)]
    if not all(isinstance(x, Number) for x in (*b, *end)):
        return roles
    own = [[*items_of(row)] for row in rows[: len(b)]]
    differences = [abs(near(x) - near(y)) for x, y in zip(b, end, strict=False)]
    begins_at_end = len(end) == len(b) and max(differences) <= NEAR_ENTRIES
    sums = [*(sum(map(near, row)) - near(x) for row, x in zip(own, c, strict=False))]
    is_method = max(map(abs, [*sums, sum(map(near, b)) - 1])) <= NEAR_ENTRIES
    if not (begins_at_end or is_method):
        return roles
    if not all(isinstance(x, Null) or is_nought(x) for row in own for x in row[len(b) :]):
        return roles
    leading = [Array(row[: len(b)]) for row in own]
    return {**roles, "A": Array([*leading]), "c": Array(c[: len(b)])}


def _with_both_rows(roles: Roles) -> Roles:
    """Separates weights and embedded weights if they are the rows of one matrix."""
    rows = items_of(roles.get("b"))
    if len(rows) != 2 or any(len(items_of(x)) < 2 for x in rows):
        return roles
    return {**roles, "b": rows[0], "embedded": rows[1]}


def _orders(roles: Roles) -> tuple[int | None, int | None]:
    """The declared orders; a pair of them, or the lower and the higher one, belong to weights and
    embedded weights that are rows of one matrix.
    """
    order, embedded = roles.get("order"), roles.get("embedded_order")
    if order is None and whole(roles.get("order1")) == whole(roles.get("order2")):
        order = roles.get("order1")
    if isinstance(order, Array) and len(order.items) in (1, 2):
        order, embedded = (*order.items, embedded)[:2]
    if order is None and embedded is None and _with_both_rows(roles) is not roles:
        order, embedded = roles.get("lower_order"), roles.get("higher_order")
    return whole(order) or None, whole(embedded) or None


def _with_ends(roles: Roles) -> Roles:
    """The rows completed if their first or last numbers are separate."""
    completed = dict(roles)
    for role in ("A", "b", "embedded"):
        first, last = ([roles[x]] if (x := f"{role}_{end}") in roles else [] for end in _ENDS)
        if first or last:
            completed[role] = Array([*first, *items_of(roles.get(role)), *last])
    return completed


_ENDS = ("first", "last")


def _of_registers(meant: Meant, roles: Roles) -> tuple[str, ConvertedScheme] | None:
    """The form of low-storage and Shu–Osher coefficients, and the converted method; None for
    others.
    """
    form = meant.signature.form
    A, b, c = map(roles.get, "Abc")
    if "gamma1" in roles:
        rows = [_row_if_any(roles, x) or () for x in ("gamma1", "gamma2", "gamma3", "delta", "A")]
        rows[2] = rows[2] or (ZERO,) * len(rows[-1])
        return "3S*", converted("3S*", *rows)
    if b is None and is_matrix(c) and is_matrix(A):
        if not _are_combinations(c):
            raise NoTable
        return "Shu–Osher", converted("Shu–Osher", rows_of(plain(c)), rows_of(plain(A)))
    if form != "rk":
        diagonals = [_row(roles, x) for x in roles if x in {"A", "A_2", "A_3", "A_4"}]
        return form, converted(form, *diagonals, _row(roles, "b"))
    if is_matrix(A) and len(items_of(A)) == 1 and c is None:
        # {{a2, a3, …}}
        A = items_of(A)[0]
    if not isinstance(A, Array) or is_matrix(A) or not isinstance(b, Array):
        return None
    row, b_row = plain(A), weights(plain(b))
    if is_row(row) and _is_pair_of_rows(row_of(row), len(b_row)):
        # numbers of registers without a statement of their form
        raise NoTable
    return None


def _are_combinations(alpha: Value | None) -> bool:
    """Whether most nonzero rows have the sum 1."""
    sums = [near(*items_of(row)) for row in items_of(alpha) if any(near(x) for x in items_of(row))]
    return 2 * sum(abs(x - 1) < CLOSE for x in sums) > len(sums)


def _is_pair_of_rows(row: Row, stages: int) -> bool:
    """Whether a row has one number per stage, and is no flattened matrix."""
    if stages == 3 and len(row) == 3:
        return is_zero(row[0])
    return stages > 2 - (len(row) == stages) and len(row) in (stages - 1, stages)


def _nystrom(roles: Roles, empty: FoundTable) -> FoundTable:
    """Ā, b̄, b and c as the pair (q, p) with linear velocities."""
    b_q, b = _row(roles, "b_q"), _row(roles, "b")
    stages = len(b)
    if len(b_q) != stages:
        raise Misshapen(f"{len(b_q)} weights of positions, {stages} of velocities")
    A = _square(roles, "A_q", stages)
    c = _nodes(roles, A)
    if c is None:
        raise Unreadable("the nodes of a Nyström method are not written out")
    of_positions = converted("Nyström", A, b_q, c)
    units = [tuple("1" if i == j else ZERO for j in range(stages)) for i in range(stages)]
    embedded = None
    if all(len(items_of(roles.get(x))) == stages for x in ("error_q", "error")):
        low = converted("Nyström", A, changed("-", b_q, _row(roles, "error_q")), c).b
        embedded = (low, changed("-", b, _row(roles, "error")))
    return replace(
        empty,
        A=((None, ((ZERO,) * stages, *units)), (of_positions.A, None)),
        b=(of_positions.b, b),
        c=(None, None),
        embedded=embedded,
        parts=("q", "p"),
        structure="nystrom",
        units=of_positions.units,
    )


def _square(roles: Roles, role: str, stages: int) -> Rows:
    """A matrix; if its rows are assigned one by one, those never written are empty."""
    value = roles.get(role)
    rows = items_of(value)
    if any(isinstance(x, Array) for x in rows):
        value = Array([x if isinstance(x, Array) or is_written(x) else Array([]) for x in rows])
    return square(plain(value), stages)


def _without_zeros(value: Value | None, stages: int) -> Value:
    """The matrix of a structure of fixed size without the zeros behind its stages."""
    rows = [x.items for x in items_of(value) if isinstance(x, Array)]
    behind = [x for i, row in enumerate(rows) for x in row[stages * (i < stages) :]]
    if value is None or len(rows) < len(items_of(value)) or not all(map(is_nought, behind)):
        return value or Null()
    return Array([Array(row[:stages]) for row in rows[:stages]]) if behind else value


def _row(roles: Roles, role: str, stages: int = 0) -> Row:
    return weights(plain(roles.get(role)), stages)


def _row_if_any(roles: Roles, role: str, stages: int = 0) -> Row | None:
    value = roles.get(role)
    return None if value is None or isinstance(value, Null) else _row(roles, role, stages)


def _nodes(roles: Roles, A: Rows) -> Row | None:
    stages = len(A)
    nodes = roles.get("c")
    if not isinstance(nodes, Array) or first_unknown(nodes) is not None:
        return None
    row = weights(plain(nodes))
    if len(row) == stages - 1:
        # c2 … cs, as in some codes
        return ("0", *row)
    if len(row) != stages:
        raise Misshapen(f"{len(row)} nodes for {stages} stages")
    is_from_the_second = is_zero(row[-1]) and not is_zero(row[0])
    if is_from_the_second and all(map(is_zero, A[0])) and not all(map(is_zero, A[-1])):
        # c2 … cs, and an unused number
        return ("0", *row[:-1])
    return row


def _with_embedded(table: FoundTable, roles: Roles, meant: Meant) -> FoundTable:
    """The table with embedded weights, from an array of weights or of an error with either sign; a
    further weight is for f at the end of the step.
    """
    given = [x for x in ("embedded", "error") if isinstance(roles.get(x), Array)]
    # an error called d may be that of the dense output
    are_two = len(given) > 1 and _is_difference(roles["embedded"])
    role = given[-1 if are_two else 0] if given else ""
    if not role or first_unknown(roles[role]) is not None:
        return table
    ((A,),), (b,), (c,) = table.A, table.b, table.c
    assert A is not None
    row = weights(plain(roles[role]))
    if meant.maker:
        row += (ZERO,) * (len(b) - len(row))
    total = near(roles[role])
    # numbers e1, e2, … with the sum 1 are weights
    is_of_numbers = role == "error" and meant.table.is_assembled and abs(total - 1) > SMALL
    is_error = _is_difference(roles[role]) or is_of_numbers
    off = total if role == "error" else total - 1
    if not (meant.table.is_sure or meant.table.is_assembled or is_error) and abs(off) > FAR:
        # another array with that name
        return _without(table, role, f"the sum is {total:.3g}")
    if len(row) == len(b) + 1 and is_zero(row[-1]):
        row = row[:-1]
    elif len(row) == len(b) + 1:
        A, b = (*((*x, ZERO) for x in A), (*b, ZERO)), (*b, ZERO)
        table = replace(table, A=((A,),), b=(b,), c=(None if c is None else (*c, "1"),))
    if len(row) != len(b):
        if meant.table.is_sure:
            raise Misshapen(f"{role} has {len(row)} entries, b has {len(b)}")
        return _without(table, role, f"{len(row)} entries for {len(b)} stages")
    if role == "error" and not (is_error or abs(off - 1) < SMALL):
        # of weights with a wrong sum it is still the difference, if b̂ has the sum 1
        is_error = any(abs(near(roles.get("b")) + x - 1) < SMALL for x in (total, -total))
        if not (is_error or meant.table.is_sure or "error" in meant.signature.roles):
            return _without(table, role, f"the sum is {total:.3g}")
    if not is_error:
        return replace(table, embedded=(row,))
    if all(map(is_zero, row)):
        return table
    low, high = changed("-", b, row), changed("+", b, row)
    if any("RungeKutta" in x for x in meant.bases):
        # E is b̂ − b in the classes of SciPy
        return replace(table, embedded=(high,))
    if "error" in meant.signature.roles:
        # and b − b̂ in NDSolve and torchdiffeq
        return replace(table, embedded=(low,))
    return replace(table, embedded=(low,), turned=(high,))


def _is_difference(row: Value) -> bool:
    """Whether a row has the sum 0 of differences of weights, a misprint aside."""
    return abs(near(row)) < SMALL


def _without(table: FoundTable, role: str, why: str) -> FoundTable:
    """The table with a note on an array that is not read."""
    return replace(table, notes=(*table.notes, f"{BESIDE[role]} not read: {why}"))


def _two_parts(meant: Meant, roles: Roles, empty: FoundTable) -> FoundTable:
    """An explicit part, 1, and an implicit one, 2; an array without a part in its name is for both,
    or for the one that lacks it. Missing weights are the last row of the matrix; those of PETSc's
    explicit part are the implicit ones.
    """
    if "A2" not in roles and "embedded" in roles:
        # the hat marks the explicit part
        roles = {**roles, "b1": roles["embedded"]}
        del roles["embedded"]
    of: Roles = {
        f"{role}{part}": x
        for role in ("A", "b", "c", "embedded", "error")
        for part in "12"
        if (x := roles.get(f"{role}{part}", roles.get(role))) and not isinstance(x, Null)
    }
    counts = [len(items_of(of.get(f"b{part}", of.get(f"A{part}")))) for part in "12"]
    stages = _stages({"stages": integer(max(counts)), **roles})
    if counts == [stages, stages - 1]:
        # only the explicit part has the first stage
        of["A2"] = Array([Array([]), *(Array([FILL, *items_of(x)]) for x in items_of(of["A2"]))])
    if isinstance(of.get("A1"), Array) and not items_of(of["A1"]):
        of["A1"] = Array([Array([])] * stages)
    firsts: Roles = {"A1": Array([]), "b2": FILL, "c1": FILL, "c2": FILL}
    of |= {
        role: Array([first, *items_of(of[role])])
        for role, first in firsts.items()
        if len(items_of(of.get(role))) == stages - 1 > 0
    }
    A2, A1 = (square(plain(of.get(x)), stages) for x in ("A2", "A1"))
    is_bare = all(is_zero(row[i]) for i, row in enumerate(A2)) and not all(map(is_zero, A2[-1]))
    if is_bare and meant.maker not in SIGNATURES:
        raise Unreadable("the implicit part has no diagonal")
    b2 = _row_if_any(of, "b2", stages) or A2[-1]
    b1 = _row_if_any(of, "b1", stages) or (b2 if meant.signature.has_default_weights else A1[-1])
    low1, low2 = (_given_low(of, part, b) for part, b in (("1", b1), ("2", b2)))
    c1, c2 = (_row_if_any(of, x, stages) for x in ("c1", "c2"))
    if all(is_zero(x) for row in (*A1, b1) for x in row):
        # no explicit part: this is how implicit methods are registered
        return replace(empty, A=((A2,),), b=(b2,), c=(c2,), embedded=low2 and (low2,))
    sums = [[near(*items_of(x)) for x in items_of(of[role])] for role in ("A1", "A2")]
    are_same = all(abs(x - y) <= _SAME for x, y in zip(*sums, strict=False))
    # each part may be evaluated at its own times
    is_shared = c1 == c2 if c1 and c2 else bool(c1 or c2) or are_same
    rows = 1 if is_shared else 2
    return replace(
        empty,
        A=((A1, A2),) * rows,
        b=(b1, b2),
        c=(c1 or c2,) if is_shared else (c1, c2),
        embedded=low2 and (low1 or low2, low2),
    )


def _given_low(roles: Roles, part: str, b: Row) -> Row | None:
    """The embedded weights of a part, or those from b and an error."""
    error = roles.get(f"error{part}")
    if isinstance(error, Array) and error.items:
        return changed("-", b, weights(plain(error), len(b)))
    return _row_if_any(roles, f"embedded{part}", len(b))


_SAME = 1e-9
"""Sums that differ by less are equal."""
