"""Tables whose coefficients have names of their own: a21, c2, b1, btilde1."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from garkcli.frozen import Mutable, field
from garkcli.sources.found import MAX_STAGES
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
_DIAGONALS = ("γ", "gamma", "gam", "d")
_EMBEDDED = ("bhat", "b̂", "bh", "ch", "bembed", "bstar", "bt", "btilde", "e")
_DIFFERENCES = frozenset({"btilde"})
_SURELY = _DIFFERENCES | {"bhat", "b̂", "bembed"}
"""Names that are no others' than those of embedded weights, and of their differences."""
NEAR = 1e-4
"""Numbers that differ by less are meant to be the same."""
FEWEST_COEFFICIENTS = 8
"""So many numbers with names of coefficients are reported where they make no table."""
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
    stem = _matrix_stem(entries)
    if stem is None:
        return None
    matrix = entries[stem]
    for other in set(entries) & set(rows) - {stem}:
        # c10, c11 … behind c9
        rows[other] |= {10 * i + j: x for (i, j), x in entries[other].items() if i > 0}
    if stem in {"a", "A"} and {"C", "gamma", "γ"} & set(entries):
        return Scalars(kind="Rosenbrock")
    found = Scalars()
    matrix = _without_last_rows(matrix, found)
    unknown = next((x for x in matrix.values() if isinstance(x, Unknown)), None)
    written = sum(isinstance(x, Number) for x in matrix.values())
    if unknown is not None and ("argument" in unknown.reason or 2 * written < len(matrix)):
        # a table is used, and none is made
        return None
    weight, node = {"b": ("c", "a"), "α": ("β", "c")}.get(stem, ("b", "c"))
    if {"w", "d"} <= set(rows) and not {weight, node} & set(rows):
        weight, node = "w", "d"
    low = 0 if min(j for _, j in matrix) == 0 else 1
    given = {i: x for i, x in rows.get(weight, {}).items() if not isinstance(x, Unknown)}
    stages = max(i for i, _ in matrix) - low + 1
    first = 0 if given and min(given) == 0 else 1
    if given:
        stages = max(stages, max(given) - first + 1)
    told = len(matrix) + len(given) + len(rows.get(node, ()))
    if not 2 <= stages <= MAX_STAGES or told < 4:
        return None
    if unknown is not None:
        return _unread(found, unknown)
    A = _filled(matrix, stages, low)
    nodes: _Row = {i: x for i, x in rows.get(node, {}).items() if isinstance(x, Number)}
    fitted = _fitted(A, nodes, values, found)
    if fitted is None:
        if len(nodes) > 1:
            return _unread(found, Unknown("rows and nodes that do not fit together"))
        fitted = A, None
    A, c = fitted
    found.roles["A"] = Array([Array(list(row)) for row in A])
    if c is not None:
        found.roles["c"] = Array(list(c))
    if given and _is_about(given.values(), 1):
        found.roles["b"] = Array([given.get(i + first, ZERO) for i in range(stages)])
    elif not given and nodes and _is_about(A[-1], 1):
        found.roles["b"] = Array(list(A[-1]))
        found.notes.append("no weights are written out: they are the last row of A")
    elif not given and nodes and _is_about(A[-1][:-1], 1) and not is_zero(A[-1][-1]):
        found.roles["b"] = Array(list(A[-1][:-1]))
        found.roles["A"] = Array([Array(row[:-1]) for row in A[:-1]])
        found.roles["c"] = Array(list(c[:-1] if c else ()))
        stages -= 1
        found.notes.append("no weights are written out: they are the last row, which is no stage")
    elif len(nodes) + len(matrix) > 4:
        return _unread(found, Unknown("no weights with the sum 1"))
    else:
        return None
    _with_embedded(found, rows, stages, low)
    return found


def are_coefficients(values: Mapping[str, Value]) -> bool:
    """Whether many numbers have names like those of coefficients, whatever their roles are."""
    families = [list(of[x].values()) for of in _families(values) for x in of if x in _LETTERS]
    numbers = [[x for x in family if isinstance(x, Number)] for family in families]
    written = [family for family in numbers if len(family) > 1]
    fractions = sum(not x.is_whole for family in written for x in family)
    return len(written) > 1 and fractions >= FEWEST_COEFFICIENTS


def _of_shu_osher(alpha: _Entries, beta: _Entries, nodes: _Row) -> Scalars | None:
    """The form of Shu and Osher, whose rows of α have the sum 1: α30, α32, β32 of the third stage
    value. A row without an α is that of the value before it.
    """
    count = max(i for i, _ in (*alpha, *beta))
    if any(i <= j for i, j in (*alpha, *beta)) or not 2 <= count <= MAX_STAGES:
        return None
    numbers = range(1, count + 1)
    alpha = {(i, i - 1): ONE for i in numbers if not any(i == x for x, _ in alpha)} | alpha
    if {i for i, _ in beta} != set(numbers):
        return None
    matrices = [
        Array([Array([of.get((i, j), ZERO) for j in range(count)]) for i in numbers])
        for of in (alpha, beta)
    ]
    rows = [x.items for x in matrices[0].items if isinstance(x, Array)]
    if not all(_is_about(row, 1) for row in rows):
        return None
    roles: dict[str, Value] = dict(zip("cA", matrices, strict=True))
    given = [x for i in range(1, count) if (x := nodes.get(i)) is not None]
    if len(given) == count - 1:
        roles["nodes"] = Array([ZERO, *given])
    return Scalars(roles)


def _without_last_rows(matrix: _Entries, found: Scalars) -> _Entries:
    """The matrix without its last rows, where these are what another function gives: further stages
    for dense output.
    """
    other = [
        i
        for (i, _), x in matrix.items()
        if isinstance(x, Unknown) and x.reason.startswith("a part of the call")
    ]
    if not other:
        return matrix
    kept = {at: x for at, x in matrix.items() if at[0] < min(other)}
    if any(isinstance(x, Unknown) for x in kept.values()) or len(kept) < 3:
        return matrix
    found.notes.append(f"further stages are given by another function: from {min(other)} on")
    return kept


def _unread(found: Scalars, unknown: Unknown) -> Scalars:
    found.roles = {"A": Array([unknown]), "b": Array([unknown])}
    return found


def _families(values: Mapping[str, Value]) -> tuple[dict[str, _Entries], dict[str, _Row]]:
    """Numbers by the letters of their names: those with two indices, those with one."""
    entries: dict[str, _Entries] = {}
    rows: dict[str, _Row] = {}
    for name, value in values.items():
        found = _NAME.fullmatch(name)
        if found is None or not isinstance(value, (Number, Unknown)):
            continue
        stem, i, j = found["stem"], found["i"], found["j"]
        if j:
            entries.setdefault(stem, {})[int(i), int(j)] = value
        elif len(i) == 1 or (len(i) == 2 and (i[0] in "01" and stem not in _TWO_INDICES)):
            rows.setdefault(stem, {})[int(i)] = value
        elif len(i) == 2:
            entries.setdefault(stem, {})[int(i[0]), int(i[1])] = value
        else:
            cut = 2
            entries.setdefault(stem, {})[int(i[:cut]), int(i[cut:])] = value
    return entries, rows


def _matrix_stem(entries: Mapping[str, _Entries]) -> str | None:
    below = [x for x in _MATRICES if x in entries and all(i >= j for i, j in entries[x])]
    # a beside α: the latter say how a stage begins
    return max(below, key=lambda x: (x != "α", len(entries[x])), default=None)


def _filled(matrix: _Entries, stages: int, low: int) -> list[list[Value]]:
    numbers = range(low, stages + low)
    return [[matrix.get((i, j), ZERO) for j in numbers] for i in numbers]


_Fitted = tuple[list[list[Value]], Sequence[Value] | None]


def _fitted(
    A: list[list[Value]], nodes: _Row, values: Mapping[str, Value], found: Scalars
) -> _Fitted | None:
    """The matrix whose row sums are the nodes, as it is or with a diagonal, and the nodes."""
    stages = len(A)
    gamma = next((x for name in _DIAGONALS if isinstance(x := values.get(name), Number)), None)
    ways: list[tuple[str, list[list[Value]]]] = [("", A)]
    has_diagonal = any(not is_zero(A[i][i]) for i in range(stages))
    if gamma is not None and has_diagonal and is_zero(A[-1][-1]):
        whole = [*A[:-1], [*A[-1][:-1], gamma]]
        if _is_about(whole[-1], 1):
            ways.insert(0, ("the last entry of the diagonal is a number of its own", whole))
    if gamma is not None and not has_diagonal:
        told = "the diagonal is a number of its own"
        full, lower = A, A
        for i in range(stages):
            full = _with(full, i, i, gamma)
            lower = _with(lower, i, i, gamma) if i else lower
        is_free = is_zero(A[1][0])
        # the second row of a method with an explicit first stage begins with γ
        ways += [(told, full)] * (not is_free and not _is_about([A[1][0]], gamma.near))
        ways += [(told, _with(lower, 1, 0, gamma))] * is_free
        ways += [(told, lower), (told, full)]
    fitting: list[tuple[int, str, list[list[Value]], list[Value]]] = []
    for note, matrix in ways:
        for shift in (1, 0, 2):
            given = [nodes.get(i + shift) for i in range(stages)]
            if given[1] is not None and not note and all(map(is_zero, matrix[1])):
                ways.append(
                    ("the only entry of the second row is its node", _with(A, 1, 0, given[1]))
                )
            count = sum(x is not None for x in given)
            if not count or count < min(len(nodes), 2):
                continue
            pairs = list(zip(given, matrix, strict=True))
            off = [i for i, (x, row) in enumerate(pairs) if x and not _is_about(row, near(x))]
            if not off or (count > FEWEST_NODES and _may_be_wrong(matrix, off)):
                nodes_ = [_sum(row) if x is None else x for x, row in pairs]
                fitting.append((len(off), note, matrix, nodes_))
    if not fitting:
        return None
    _, note, matrix, nodes_ = min(fitting, key=lambda x: x[0])
    if note:
        found.notes.append(note)
    return matrix, nodes_


FEWEST_NODES = 4
"""So many nodes are the row sums where one other is not, and may be wrong."""


def _may_be_wrong(A: Sequence[Sequence[Value]], off: Sequence[int]) -> bool:
    """Whether one node alone is no row sum, and no entry of its row is left out."""
    return len(off) == 1 and not any(map(is_zero, A[off[0]][: off[0]]))


def _with(A: list[list[Value]], i: int, j: int, value: Value) -> list[list[Value]]:
    """The matrix with another entry."""
    return [*A[:i], [*A[i][:j], value, *A[i][j + 1 :]], *A[i + 1 :]]


def _with_embedded(found: Scalars, rows: Mapping[str, _Row], stages: int, low: int) -> None:
    for stem in _EMBEDDED:
        row = rows.get(stem)
        if not row or any(isinstance(x, Unknown) for x in row.values()):
            continue
        first = 0 if min(row) == 0 and low == 0 else 1
        count = max(stages, max(row) - first + 1)
        is_error, is_weights = (_is_about(row.values(), total) for total in (0, 1))
        if stem in _SURELY and not (is_error or is_weights) and len(row) + 1 >= stages:
            # the sum is wrong, which is for an audit to say
            is_error = stem in _DIFFERENCES
            is_weights = not is_error
        if (is_error or is_weights) and count <= stages + 1:
            entries: list[Value] = [row.get(i + first, ZERO) for i in range(count)]
            found.roles["error" if is_error else "embedded"] = Array(entries)
            return


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
