"""Rosenbrock methods in sources: the arguments of calls, and the arrays of KPP."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import permutations

from garkcli.frozen import replace
from garkcli.sources.found import FoundTable, Misshapen, Row, Rows, Unreadable
from garkcli.sources.naming import role_of
from garkcli.sources.shaping import ZERO, Texts, is_zero, weights
from garkcli.sources.values import (
    FILL,
    ONE,
    Array,
    Number,
    Value,
    Word,
    computed,
    first_unknown,
    integer,
    is_matrix,
    is_written,
    items_of,
    near,
    whole,
)

FORMS = ("rosenbrock", "transformed", "kpp")
"""Signatures of printed methods, of stored ones, and of those packed by rows."""
_OF_KPP = {
    "a": "A",
    "c": "C",
    "m": "b",
    "e": "error",
    "alpha": "c",
    "gamma": "d",
    **dict.fromkeys(("s", "stages"), "stages"),
    **dict.fromkeys(("elo", "estimator_of_local_order"), "local_order"),
    "name": "title",
}
NEAR = 1e-9
"""Tolerance of printed row sums."""
MOST_MATRICES = 6
"""Most matrices of a scope tried in pairs."""
_WHOLE = frozenset(("A", "C", "b", "c", "d", "stages"))


def roles_of_kpp(values: Mapping[str, Value], prefix: str = "ros_") -> Mapping[str, Value] | None:
    """The roles of the arrays of KPP, ros_A and ros_Gamma, or a_ and gamma_ of a structure without
    prefix; None unless all of a method is written.
    """
    lower = {name.lower(): x for name, x in values.items()}
    own = {name: x for name, x in lower.items() if name.startswith(prefix)}
    named = {name.removeprefix(prefix).rstrip("_"): x for name, x in own.items()}
    if not {"m", "alpha", "gamma"} <= set(named):
        return None
    if "a" not in named:
        named |= _by_row_sums(values, *(named[x] for x in ("m", "alpha", "gamma")))
    roles = {role: named[name] for name, role in _OF_KPP.items() if name in named}
    stages = whole(roles.get("stages"))
    if not stages or not set(roles) >= _WHOLE:
        return None
    counts = {"A": stages * (stages - 1) // 2, "b": stages, "c": stages, "d": stages}
    counts |= {"C": counts["A"], "error": stages}
    for role, count in counts.items():
        if role in roles:
            entries = roles[role] = _entries(roles[role], count)
            if len(entries.items) < count or first_unknown(entries) is not None:
                return None
    if not isinstance(roles.get("title"), Word):
        roles.pop("title", None)
    roles["gamma"] = items_of(roles["d"])[0]
    return roles


def _by_row_sums(
    values: Mapping[str, Value], m: Value, alpha: Value, gamma: Value
) -> Mapping[str, Value]:
    """The matrices A and C with the row sums alpha and gamma, packed by rows, with any names; empty
    if there are none.
    """
    stages = len(items_of(m))
    sums = [near(x) for x in items_of(gamma)]
    packed = [x for x in map(partial(_triangle, stages=stages), values.values()) if x]
    if not (1 < stages == len(items_of(alpha)) == len(sums)):
        return {}
    for A, C in permutations(packed, 2):
        if any(near(x) for x in A) and _are_sums(A, C, alpha, sums):
            return {"a": Array([*A]), "c": Array([*C]), "s": integer(stages)}
    return {}


def roles_by_sums(values: Mapping[str, Value]) -> Mapping[str, Value] | None:
    """The roles of the arrays of a method in stored form, with any names; None if there is none.
    Its nodes α and row sums γ may be on the diagonals of A and C.
    """
    arrays = [x for x in values.values() if isinstance(x, Array) and len(x.items) > 1]
    matrices = [x for x in arrays if any(isinstance(y, Array) for y in x.items)][:MOST_MATRICES]
    vectors = [x for x in arrays if not is_matrix(x) and is_written(x)]
    for A, C in permutations(matrices, 2):
        stages = len(A.items)
        rows = [x for x in vectors if len(x.items) == stages == len(C.items)]
        low_A, low_C = (_triangle(_strict(x), stages) for x in (A, C))
        if not (rows and any(map(near, low_A)) and any(map(near, low_C))):
            continue
        for alpha, gamma in [(_diagonal(A), _diagonal(C)), *permutations(rows, 2)]:
            sums = [near(x) for x in items_of(gamma)]
            # Σ b = mᵀΓ𝟙
            m = [x for x in rows if abs(_dot(x, sums) - 1) < NEAR and x not in (alpha, gamma)]
            if m and sums[0] % 1 and _are_sums(low_A, low_C, alpha, sums):
                order = values.get("order")
                return {
                    "A": Array([*low_A]),
                    "C": Array([*low_C]),
                    "b": m[0],
                    "c": alpha,
                    "d": gamma,
                    "gamma": items_of(gamma)[0],
                    "stages": integer(stages),
                    **({"order": order} if isinstance(order, Number) else {}),
                    **({"error": _difference(*m[:2])} if len(m) > 1 else {}),
                }
    return None


CLOSE = 1e-6
"""Residuals of conditions below this are evidence for a method."""
_ERRORS = ("e", "err", "error")
FAR = 1
"""Largest sum of the differences of weights, misprints included."""
_GAMMA = re.compile(r"(?:gamma|γ|gam(?![a-z]))", re.IGNORECASE)
_GAMMAS = ("gamma", "gam", "γ", "Gamma", "GAMMA", "GAM", "g")


def roles_by_names(
    matrices: Mapping[str, Value],
    vectors: Mapping[str, Value],
    numbers: Mapping[str, Value],
    is_told: bool = False,
) -> tuple[Mapping[str, Value], str]:
    """The roles of arrays with the letters of papers, and the form of the method: a, c, γ in stored
    form, or α, γ in printed form. Empty unless they have order 2; with ``is_told``, beside a
    declared order, they may miss it by a misprint.
    """
    gamma = next((numbers[x] for x in _GAMMAS if x in numbers), None)
    A = matrices.get("a", matrices.get("alpha", matrices.get("α")))
    b = next((vectors[x] for x in ("b", "m", "w") if x in vectors), None)
    order = {x: numbers[x] for x in ("order",) if x in numbers}
    is_told &= bool(order)
    G = next((x for name, x in matrices.items() if _GAMMA.match(name)), matrices.get("g"))
    if isinstance(A, Array) and isinstance(G, Array) and isinstance(b, Array):
        # no other method has a γ beside two triangles without diagonals, of several entries
        are_triangles = all(len(x.items) > 2 and _is_strict(x) for x in (A, G))
        is_told |= isinstance(gamma, Number) and are_triangles
        roles = _as_printed(A, G, b, gamma, is_told)
        beside = _beside(vectors, roles) if roles else {}
        return ({**roles, **beside, **order}, "rosenbrock") if roles else ({}, "")
    C = matrices.get("c")
    if isinstance(A, Array) and isinstance(C, Array) and isinstance(gamma, Number):
        named = {**vectors, **({} if b is None else {"b": b})}
        roles = _as_stored(A, C, gamma, named, is_told)
        return ({**roles, **order}, "transformed") if roles else ({}, "")
    return {}, ""


def _as_printed(
    A: Array, G: Array, b: Array, gamma: Value | None, is_told: bool
) -> dict[str, Value]:
    """A method from α, Γ and b, with the diagonal of Γ separate; empty unless it has order 2, or
    ``is_told``.
    """
    stages = len(b.items)
    low_A, low_G = (_triangle(_strict(x), stages) for x in (A, G))
    own = items_of(_diagonal(G))
    own = [*own, *[FILL] * (stages - len(own))]
    if not (any(map(near, low_A)) and any(map(near, low_G))):
        return {}
    if gamma is not None and not any(map(near, own)):
        own = [gamma] * stages
    ones = [1.0] * stages
    sums = [
        _below(low_A, i, ones) + _below(low_G, i, ones) + near(x)
        for i, x in enumerate(own[:stages])
    ]
    weights = [near(x) for x in b.items]
    order_2 = sum(x * y for x, y in zip(weights, sums, strict=True)) - 0.5
    is_one = abs(sum(weights) - 1) < CLOSE and abs(order_2) < CLOSE
    if not (is_one or is_told) or not any(map(near, own)):
        return {}
    rows_A, rows_G = (_rows(x, stages) for x in (low_A, low_G))
    for i, row in enumerate(rows_G):
        row.items[i] = own[i]
    return {"A": Array([*rows_A]), "gamma": Array([*rows_G]), "b": b}


def _beside(vectors: Mapping[str, Value], roles: Mapping[str, Value]) -> Mapping[str, Value]:
    """Nodes and embedded weights beside a printed method."""
    A, b = roles["A"], roles["b"]
    assert isinstance(A, Array)
    sums = [sum(map(near, items_of(row))) for row in A.items]
    found = {"c": _completed(vectors.get("c"), sums)}
    for name, row in vectors.items():
        role = (role_of(name) or ("", ""))[1]
        if role == "embedded" and row is not b and len(items_of(row)) == len(sums):
            found.setdefault(role, row if isinstance(row, Array) and is_written(row) else None)
    return {role: row for role, row in found.items() if row is not None}


def _is_strict(matrix: Array) -> bool:
    """Whether a matrix is a triangle below its diagonal, with an entry that is not 0."""
    return any(map(near, _triangle(matrix, len(matrix.items))))


def _rows(packed: Sequence[Value], stages: int) -> list[Array]:
    """A triangle below the diagonal as a square matrix."""
    rows = [packed[i * (i - 1) // 2 : i * (i + 1) // 2] for i in range(stages)]
    return [Array([*row, *[FILL] * (stages - len(row))]) for row in rows]


def _as_stored(
    A: Array, C: Array, gamma: Number, vectors: Mapping[str, Value], is_told: bool
) -> dict[str, Value]:
    """A method from A, C and γ; without the last row of A and without weights the step is the last
    stage value plus its increment. Empty unless it has order 2, or ``is_told``.
    """
    stages = max(len(A.items), len(C.items))
    low_A, low_C = (_triangle(x, stages) for x in (A, C))
    if not (any(map(near, low_A)) and any(map(near, low_C))):
        return {}
    sums = _solved(low_C, gamma.near, [1.0] * stages)
    first = (stages - 1) * (stages - 2) // 2
    last, above = low_A[first:], low_A[first - stages + 2 : first]
    is_whole = "b" in vectors or is_written(last[-1])
    if not any(map(near, last)):
        ways = [last] if stages < 3 else [[*above, ONE], [*above, FILL]]
    else:
        # the conditions decide whether the entry is 0 or 1
        ways = [last] if is_whole else [[*last[:-1], ONE], last]
    b: Value
    fitting: list[tuple[Array, list[Value]]] = []
    for way in ways:
        low_A = [*low_A[:first], *way]
        m = vectors.get("b", Array([*way, ONE]))
        if not isinstance(m, Array) or len(m.items) != stages or abs(_dot(m, sums) - 1) > CLOSE:
            continue
        both = [_below(low_A, i, sums) + sums[i] for i in range(stages)]
        if abs(_dot(m, _solved(low_C, gamma.near, both)) - 0.5) < CLOSE:
            fitting.append((m, low_A))
    if len(fitting) > 1 and any(map(near, last)):
        return {}
    if fitting:
        b, low_A = fitting[0]
    else:
        b, low_A = vectors.get("b", FILL), _triangle(A, stages)
        rows = {len(items_of(x)) for x in (A, C, b)}
        if not is_told or rows != {stages} or first_unknown(Array([A, C, b])) is not None:
            return {}
    nodes = [_below(low_A, i, sums) for i in range(stages)]
    roles: dict[str, Value] = {"A": Array([*_rows(low_A, stages)]), "b": b, "gamma": gamma}
    roles["C"] = Array([*_rows(low_C, stages)])
    for role, name, known in (("c", "c", nodes), ("d", "d", sums)):
        row = _completed(vectors.get(name), known)
        roles |= {} if row is None else {role: row}
    error = next((vectors[x] for x in _ERRORS if x in vectors), None)
    if isinstance(error, Array) and len(error.items) == stages and is_written(error):
        # m − m̂ has the sum 0 with these, a misprint aside
        roles |= {"error": error} if abs(_dot(error, sums)) < FAR else {}
    return roles


def _solved(packed: Sequence[Value], gamma: float, right: Sequence[float]) -> list[float]:
    """Γv with the inverse Γ of I/γ − C."""
    solution: list[float] = []
    for i, x in enumerate(right):
        solution.append(gamma * (x + _below(packed, i, solution)))
    return solution


def _completed(row: Value | None, known: Sequence[float]) -> Array | None:
    """Written numbers, completed by 0 and 1; None if others are missing, or if most written ones
    differ from the known ones.
    """
    items = items_of(row)[: len(known)]
    items += [FILL] * (len(known) - len(items))
    pairs = list(zip(items, known, strict=True))
    agree = [abs(near(x) - y) < CLOSE for x, y in pairs if is_written(x)]
    if 2 * sum(agree) <= len(agree):
        return None
    completed: list[Value] = []
    for x, y in pairs:
        is_one = abs(y - 1) < NEAR
        if not is_written(x) and not is_one and abs(y) > NEAR:
            return None
        completed.append(ONE if is_one and not is_written(x) else x)
    return Array(completed)


_NAMED = {
    **dict.fromkeys(("a", "A", "alpha"), "A"),
    **dict.fromkeys(("C", "c_matrix", "c_coeffs"), "C"),
    **dict.fromkeys(("b", "m", "B", "M"), "b"),
    **dict.fromkeys(("gamma", "γ", "Gamma"), "gamma"),
    **dict.fromkeys(("c", "nodes"), "c"),
    **dict.fromkeys(("d", "gamma_stages", "gammas", "gamma_i", "gamma_sums"), "d"),
    **dict.fromkeys(("e", "E", "error"), "error"),
    **dict.fromkeys(("b_hat", "bhat", "b_low", "embedded", "btilde"), "embedded"),
    "order": "order",
}
"""The names of arguments of calls that make Rosenbrock methods."""


def roles_of_arguments(fields: Mapping[str, Value]) -> tuple[Mapping[str, Value], str]:
    """The roles of named arguments of a call, and the form of the method: stored with one γ, or
    printed; empty if a matrix is missing or unknown.
    """
    roles: dict[str, Value] = {}
    for name, value in fields.items():
        if name in _NAMED:
            roles.setdefault(_NAMED[name], value)
    is_stored = is_matrix(roles.get("C")) and isinstance(roles.get("gamma"), Number)
    required = [roles.get(x) for x in ("A", "b", "C" if is_stored else "gamma")]
    is_known = all(isinstance(x, Array) and first_unknown(x) is None for x in required)
    if not is_known or not (is_stored or is_matrix(roles.get("gamma"))):
        return {}, ""
    b, low = roles["b"], roles.get("embedded")
    if is_stored and isinstance(b, Array) and isinstance(low, Array) and "error" not in roles:
        roles |= {"error": _difference(b, low)} if len(b.items) == len(low.items) else {}
    return roles, "transformed" if is_stored else "rosenbrock"


def _difference(x: Array, y: Array) -> Array:
    return Array([computed("-", a, b, 0) for a, b in zip(x.items, y.items, strict=True)])


def _strict(matrix: Array) -> Array:
    """The entries of a matrix off its diagonal."""
    rows = [items_of(x) for x in matrix.items]
    return Array([Array([*row[:i], FILL, *row[i + 1 :]]) for i, row in enumerate(rows)])


def _diagonal(matrix: Array) -> Array:
    pairs = enumerate(map(items_of, matrix.items))
    entries = [row[i] if i < len(row) else FILL for i, row in pairs]
    return Array([x if isinstance(x, Number) else FILL for x in entries])


def _dot(x: Array, y: Sequence[float]) -> float:
    return sum(near(a) * b for a, b in zip(x.items, y, strict=True))


def _are_sums(A: Sequence[Value], C: Sequence[Value], alpha: Value, sums: Sequence[float]) -> bool:
    """Whether (I/γ - C)Γ𝟙 = 𝟙 and α𝟙 = AΓ𝟙, for triangles packed by rows."""
    return all(
        abs(sums[0] * (1 + _below(C, i, sums)) - sums[i]) < NEAR
        and abs(_below(A, i, sums) - near(x)) < NEAR
        for i, x in enumerate(items_of(alpha))
    )


def _triangle(value: Value, stages: int) -> list[Value]:
    """The entries below the diagonal, by rows, 0 if not written; empty if the value is no
    matrix.
    """
    rows = [items_of(x) for x in items_of(value)]
    if not (1 < len(rows) <= stages and any(rows)) or any(
        near(x) for i, row in enumerate(rows) for x in row[i:]
    ):
        return []
    rows += [[]] * (stages - len(rows))
    entries = [row[j] if j < len(row) else FILL for i, row in enumerate(rows) for j in range(i)]
    return [x if isinstance(x, Number) else FILL for x in entries]


def _below(packed: Sequence[Value], i: int, x: Sequence[float]) -> float:
    """The entry i of the product of a triangle below the diagonal with a vector."""
    row = packed[i * (i - 1) // 2 : i * (i + 1) // 2]
    return sum(near(a) * b for a, b in zip(row, x, strict=False))


def _entries(value: Value, count: int) -> Array:
    """The first entries of an array, which may have unused room, or a fill value behind them."""
    items = items_of(value)[:count]
    if isinstance(value, Array) and isinstance(value.fill, Number):
        items += [value.fill] * (count - len(items))
    return Array(items)


def rosenbrock_table(
    texts: Mapping[str, Texts], empty: FoundTable, form: str, roles: Mapping[str, Value]
) -> FoundTable:
    """The table of a Rosenbrock method.

    Args:
        texts: its arrays by their roles.
        empty: the table without coefficients.
        form: one of ``FORMS``.
        roles: the values, for whole numbers.

    Raises:
        Unreadable: an array is missing, or is no array.
        Misshapen: it does not fit the weights.
    """
    b = weights(_listed(texts.get("b")))
    stages = len(b)
    A = _matrix(texts.get("A"), stages, is_packed=form == "kpp")
    rows = {role: _row(texts.get(role), stages) for role in ("c", "d", "embedded", "error")}
    table = replace(empty, A=((A,),), b=(b,), c=(rows["c"],), d=rows["d"])
    if form == "rosenbrock":
        embedded = rows["embedded"]
        table = replace(table, gamma=_matrix(texts.get("gamma"), stages))
        return replace(
            table,
            embedded=None if embedded is None else (embedded,),
            dense=_dense(texts.get("dense"), whole(roles.get("dense_degree")) or 0, stages),
        )
    gamma = texts.get("gamma")
    if not isinstance(gamma, str):
        raise Unreadable("gamma is one number")
    local = whole(roles.get("local_order"))
    table = replace(
        table,
        gamma=_matrix(texts.get("C"), stages, is_packed=form == "kpp"),
        diagonal=(gamma,) * stages,
        embedded_order=None if local is None else local - 1,
    )
    error = rows["error"]
    if error is None or all(map(is_zero, error)):
        return table
    return replace(table, error=error)


def _listed(value: Texts) -> Texts:
    """A list; the number of a method with one stage in a list."""
    return [value] if isinstance(value, str) else value


def _row(value: Texts, stages: int) -> Row | None:
    return None if value is None else weights(_listed(value), stages)


def _matrix(value: Texts, stages: int, is_packed: bool = False) -> Rows:
    """A square matrix, possibly without a last column of zeros; or the entries below the diagonal,
    row by row.
    """
    if isinstance(value, str) and stages == 1:
        return ((value,),)
    if not isinstance(value, list):
        raise Unreadable("a matrix is expected")
    if is_packed:
        entries = iter(weights(value))
        rows = [[next(entries) for _ in range(i)] for i in range(stages)]
        return tuple((*row, *(ZERO,) * (stages - len(row))) for row in rows)
    if value and all(isinstance(x, str) for x in value):
        flat = weights(value)
        if len(flat) != stages * stages:
            raise Misshapen(f"{len(flat)} entries for {stages} stages")
        value = [list(flat[i : i + stages]) for i in range(0, len(flat), stages)]
    if len(value) != stages:
        raise Misshapen(f"{len(value)} rows for {stages} stages")
    return tuple(weights(row, stages) for row in value)


def _dense(value: Texts, degree: int, stages: int) -> tuple[Rows, ...] | None:
    """Dense output, one row for each stage; None without it, or if it is not completely written."""
    if not degree or value is None:
        return None
    if isinstance(value, list) and all(isinstance(x, list) for x in value):
        value = [x for row in value if isinstance(row, list) for x in row]
    flat = weights(_listed(value)) if value else ()
    if len(flat) != stages * degree:
        return None
    return (tuple(flat[i : i + degree] for i in range(0, len(flat), degree)),)
