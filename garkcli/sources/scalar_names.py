"""Tables whose coefficients have names of their own: a21, c2, b1, btilde1."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from garkcli.frozen import Mutable, field
from garkcli.sources.found import MAX_STAGES
from garkcli.sources.naming import role_of
from garkcli.sources.values import (
    ONE,
    ZERO,
    Array,
    Number,
    Unknown,
    Value,
    computed,
    exact,
    is_zero,
    near,
)

_NAME = re.compile(r"(?P<stem>[^\W\d_]+[̂̃]?)_?(?P<i>\d{1,4})(?:_(?P<j>\d{1,2}))?")
_MATRICES = ("a", "A", "aa", "b", "α")
_SHU_OSHER = (("α", "β"), ("alpha", "beta"))
_TWO_INDICES = {*_MATRICES, *(x for pair in _SHU_OSHER for x in pair)}
_LETTERS = {*_TWO_INDICES, *"cdewγ", "gamma", "bhat", "b̂", "bh", "bt", "btilde"}
ARRAYS = {
    x: f"{x}[]" for x in ("A", "A1", "b", "c", "c1", "embedded", "error", "A_q", "b_q", "delta")
}
"""Roles of arrays of coefficients, with what tells these from single ones."""
_DIAGONALS = ("γ", "gamma", "gam", "d")
_EMBEDDED = ("bhat", "b̂", "bh", "ch", "bembed", "bstar", "bt", "btilde", "e", "dc")
_SURELY = {"bhat": "embedded", "b̂": "embedded", "bembed": "embedded", "btilde": "error"}
"""Names that are no others' than those of embedded weights, and of their differences."""
NEAR = 1e-4
"""Numbers that differ by less are meant to be the same."""
FEWEST_NODES = 4
"""So many nodes are the row sums where one other is not, and may be wrong."""
_Entries = dict[tuple[int, int], Value]
_Row = dict[int, Value]


class Scalars(Mutable):
    """What names alone say of a table.

    Attributes:
        roles: its values.
        notes: how they were put together.
        kind: of another method.
    """

    roles: dict[str, Value] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    kind: str = ""


def scalar_roles(values: Mapping[str, Value]) -> Scalars | None:
    """The table that numbers make by their names; None where they make none.

    The family with the most entries below the diagonal is the matrix. It is taken only where all
    nodes that are given are its row sums, with a diagonal that may be a number of its own.
    """
    entries, rows = _families(values)
    for alpha, beta in _SHU_OSHER:
        if alpha in entries and beta in entries:
            return _of_shu_osher(entries[alpha], entries[beta], rows.get("c", {}))
    below = [x for x in _MATRICES if x in entries and all(i >= j for i, j in entries[x])]
    if not below:
        return None
    # a beside α: the latter say how a stage begins
    stem = max(below, key=lambda x: (x != "α", len(entries[x])))
    if stem in {"a", "A"} and {"C", "gamma", "γ"} & set(entries):
        return Scalars(kind="Rosenbrock")
    for other in set(entries) & set(rows) - {stem}:
        # c10, c11 … behind c9
        rows[other] |= {10 * i + j: x for (i, j), x in entries[other].items() if i > 0}
    found = Scalars()
    matrix = _without_last_rows(entries[stem], found)
    unknown = next((x for x in matrix.values() if isinstance(x, Unknown)), None)
    written = sum(isinstance(x, Number) for x in matrix.values())
    if unknown is not None and ("argument" in unknown.reason or 2 * written < len(matrix)):
        # a table is used, and none is made
        return None
    weight, node = {"b": ("c", "a"), "α": ("β", "c")}.get(stem, ("b", "c"))
    if stem == "A" and "B" in rows:
        weight, node = "B", "C"
    if {"w", "d"} <= set(rows) and not {weight, node} & set(rows):
        weight, node = "w", "d"
    given: _Row = {i: x for i, x in rows.get(weight, {}).items() if not isinstance(x, Unknown)}
    low = min(1, min(j for _, j in matrix))
    first = min(1, *given, 1)
    stages = max(max(i for i, _ in matrix) - low, max(given, default=0) - first) + 1
    told = len(matrix) + len(given) + len(rows.get(node, ()))
    if not 2 <= stages <= MAX_STAGES or told < 4:
        return None
    if unknown is not None:
        return _unread(unknown)
    nodes: _Row = {i: x for i, x in rows.get(node, {}).items() if isinstance(x, Number)}
    gamma = next((x for name in _DIAGONALS if isinstance(x := values.get(name), Number)), None)
    fitted = _fitted(matrix, range(low, stages + low), nodes, gamma)
    if fitted is None and len(nodes) > 1:
        return _unread(Unknown("rows and nodes that do not fit together"))
    note, matrix, c = fitted or ("", matrix, [])
    found.notes += [note] * bool(note)
    A = _filled(matrix, range(low, stages + low))
    found.roles = _embedded(rows, stages, low)
    is_told = bool(nodes) or "error" in found.roles
    if given and _is_about(given.values(), 1):
        b = [given.get(i + first, ZERO) for i in range(stages)]
    elif not given and is_told and _is_about(A[-1], 1):
        b = A[-1]
        found.notes.append("no weights are written out: they are the last row of A")
    elif not given and is_told and _is_about(A[-1][:-1], 1) and not is_zero(A[-1][-1]):
        b, A, c, stages = A[-1][:-1], [row[:-1] for row in A[:-1]], c[:-1], stages - 1
        found.notes.append("no weights are written out: they are the last row, which is no stage")
    else:
        told = len(nodes) + len(matrix)
        return _unread(Unknown("no weights with the sum 1")) if told > 4 else None
    found.roles |= {"A": Array(list(map(Array, A))), "b": Array(b)}
    if c:
        found.roles["c"] = Array(c)
    return found


def family_of(name: str) -> str:
    """The letter or the role of what has a name like those of coefficients; empty for others."""
    plain = name.rpartition("::")[2].lstrip("_")
    found = _NAME.fullmatch(plain)
    if found is not None and found["stem"] in _LETTERS:
        return found["stem"]
    return ARRAYS.get((role_of(plain) or ("", ""))[1], "")


def _of_shu_osher(alpha: _Entries, beta: _Entries, nodes: _Row) -> Scalars | None:
    """The form of Shu and Osher, whose rows of α have the sum 1: α30, α32, β32 of the third stage
    value. A row without an α is that of the value before it.
    """
    count = max(i for i, _ in (*alpha, *beta))
    numbers, columns = range(1, count + 1), range(count)
    if any(i <= j for i, j in (*alpha, *beta)) or not 2 <= count <= MAX_STAGES:
        return None
    alpha = {(i, i - 1): ONE for i in numbers if not any(i == x for x, _ in alpha)} | alpha
    rows = _filled(alpha, numbers, columns)
    if {i for i, _ in beta} != set(numbers) or not all(_is_about(row, 1) for row in rows):
        return None
    matrices = (rows, _filled(beta, numbers, columns))
    roles: dict[str, Value] = {
        x: Array(list(map(Array, y))) for x, y in zip("cA", matrices, strict=True)
    }
    if all(i in nodes for i in columns[1:]):
        roles["nodes"] = Array([ZERO, *(nodes[i] for i in columns[1:])])
    return Scalars(roles)


def _without_last_rows(matrix: _Entries, found: Scalars) -> _Entries:
    """The matrix without its last rows, where these are what another function gives: further stages
    for dense output.
    """
    unknown = [(i, x.reason) for (i, _), x in matrix.items() if isinstance(x, Unknown)]
    other = min((i for i, why in unknown if why.startswith("a part of the call")), default=0)
    kept = {at: x for at, x in matrix.items() if at[0] < other}
    if len(kept) < 3 or any(i < other for i, _ in unknown):
        return matrix
    found.notes.append(f"further stages are given by another function: from {other} on")
    return kept


def _unread(unknown: Unknown) -> Scalars:
    return Scalars({"A": Array([unknown]), "b": Array([unknown])})


def _families(values: Mapping[str, Value]) -> tuple[dict[str, _Entries], dict[str, _Row]]:
    """Numbers by the letters of their names: those with two indices, those with one."""
    entries: dict[str, _Entries] = {}
    rows: dict[str, _Row] = {}
    for name, value in values.items():
        found = _NAME.fullmatch(name)
        if found is None or not isinstance(value, (Number, Unknown)):
            continue
        stem, i, j = found["stem"], found["i"], found["j"]
        is_tenth = len(i) == 2 and i[0] in "01" and stem not in _TWO_INDICES
        if not j and (len(i) == 1 or is_tenth):
            rows.setdefault(stem, {})[int(i)] = value
            continue
        if not j:
            cut = 1 + (len(i) > 2)
            i, j = i[:cut], i[cut:]
        entries.setdefault(stem, {})[int(i), int(j)] = value
    return entries, rows


def _filled(
    matrix: _Entries, numbers: Sequence[int], columns: Sequence[int] = ()
) -> list[list[Value]]:
    return [[matrix.get((i, j), ZERO) for j in columns or numbers] for i in numbers]


def _fitted(
    matrix: _Entries, numbers: Sequence[int], nodes: _Row, gamma: Number | None
) -> tuple[str, _Entries, list[Value]] | None:
    """The matrix whose row sums are the nodes, as it is or with a diagonal, and the nodes; with a
    note of what was done.
    """
    fitting: list[tuple[int, str, _Entries, list[Value]]] = []
    for note, way in _ways(matrix, numbers, nodes, gamma):
        rows = _filled(way, numbers)
        for shift in (1, 0, 2):
            given = [nodes.get(i + shift) for i in range(len(numbers))]
            count = sum(x is not None for x in given)
            if not count or count < min(len(nodes), 2):
                continue
            pairs = list(zip(given, rows, strict=True))
            off = [i for i, (x, row) in enumerate(pairs) if x and not _is_about(row, near(x))]
            # one node alone may be wrong where no entry of its row is left out
            is_misprint = len(off) == 1 and not any(map(is_zero, rows[off[0]][: off[0]]))
            if not off or (count > FEWEST_NODES and is_misprint):
                c = [_sum(row) if x is None else x for x, row in pairs]
                fitting.append((len(off), note, way, c))
    return min(fitting, key=lambda x: x[0])[1:] if fitting else None


def _ways(
    matrix: _Entries, numbers: Sequence[int], nodes: _Row, gamma: Number | None
) -> Iterator[tuple[str, _Entries]]:
    """The matrix as it is and with what may have been left out, with notes."""
    first, second, last = numbers[0], numbers[1], numbers[-1]
    has_diagonal = any(not is_zero(matrix.get((i, i), ZERO)) for i in numbers)
    if gamma is not None and has_diagonal and is_zero(matrix.get((last, last), ZERO)):
        whole = {**matrix, (last, last): gamma}
        if _is_about([whole.get((last, j), ZERO) for j in numbers], 1):
            yield "the last entry of the diagonal is a number of its own", whole
    yield "", matrix
    if gamma is not None and not has_diagonal:
        note = "the diagonal is a number of its own"
        lower = {**matrix, **{(i, i): gamma for i in numbers[1:]}}
        full = {**lower, (first, first): gamma}
        entry = matrix.get((second, first), ZERO)
        # the second row of a method with an explicit first stage begins with γ
        if is_zero(entry):
            yield note, {**lower, (second, first): gamma}
        elif not _is_about([entry], gamma.near):
            yield note, full
        yield note, lower
        yield note, full
    if all(is_zero(matrix.get((second, j), ZERO)) for j in numbers):
        for node in (nodes[i] for i in (2, 1, 3) if i in nodes):
            yield "the only entry of the second row is its node", {**matrix, (second, first): node}


def _embedded(rows: Mapping[str, _Row], stages: int, low: int) -> dict[str, Value]:
    """The embedded weights or their differences, by their sums."""
    for stem in _EMBEDDED:
        row = rows.get(stem)
        if not row or any(isinstance(x, Unknown) for x in row.values()):
            continue
        first = max(min(1, *row), low)
        count = max(stages, max(row) - first + 1)
        sums = {"error": 0, "embedded": 1}
        role = next((x for x in sums if _is_about(row.values(), sums[x])), "")
        if len(row) + 1 >= stages:
            # a sum that is wrong is for an audit to say
            role = role or _SURELY.get(stem, "")
        if role and count <= stages + 1:
            return {role: Array([row.get(i + first, ZERO) for i in range(count)])}
    return {}


def _is_about(row: Iterable[Value], total: float) -> bool:
    """Whether numbers have about this sum."""
    found = list(row)
    return all(isinstance(x, Number) for x in found) and abs(near(*found) - total) < NEAR


def _sum(row: Sequence[Value]) -> Value:
    """A sum that stands for a node, with all its digits."""
    found: Value = ZERO
    for x in row:
        found = computed("+", found, x, 0)
    return exact(found.value) if isinstance(found, Number) and found.value is not None else found
