"""Arrays that are a method in another form than its tableau: registers, convex combinations, kicks
and drifts, second-order equations.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from garkcli.recognise.compositions import composition
from garkcli.recognise.evidence import (
    COARSEST,
    MOST,
    ROUNDING,
    agreement,
    conditions,
    order_of,
    row_sums,
    unit_of,
)
from garkcli.recognise.given import ALL, LENGTH, UNIT, VALUE, Given
from garkcli.recognise.hypotheses import is_lower, lower_triangle, padded, parts_of
from garkcli.recognise.names import ALPHA, BETA, EMBEDDED, MATRIX, NODES, WEIGHTS
from garkcli.recognise.readings import Reading
from garkcli.recognise.vectors import Vector, fitted, nodes_in

if TYPE_CHECKING:
    from garkcli.arrays import Floats

MOST_STAGES = 60
MOST_ARRAYS = 40
"""The most arrays of a group that are tried in pairs."""
LEAST = 3
"""Two columns of one array are drifts and kicks of that order: order 2 is one sum."""
MOST_ROWS, MOST_ALIKE = 5, 6
"""The most rows of a matrix, and arrays of one length, that are tried together."""
HIGHEST = 4
"""Orders of derived tableaus that are tried."""
QUADRATURE = 8


def other_readings(arrays: Sequence[Given]) -> tuple[list[Reading], int]:
    """The ways in which arrays are methods of other forms, and how many were tried."""
    rows = [x for x in arrays if not x.is_matrix and 1 < len(x.rows[0]) <= MOST_STAGES]
    rows = rows[:MOST_ARRAYS]
    matrices = [x for x in arrays if x.is_matrix and 1 < len(x.rows) <= MOST_STAGES][:MOST_ARRAYS]
    tables = [each for x in matrices for each in _rows_of(x)]
    tried = [
        *(each for x, y in permutations(rows, 2) for each in _of_two_rows(x, y, rows)),
        *(_shu_osher(x, y, rows) for of in (matrices, rows) for x, y in permutations(of, 2)),
        *(each for x, y in permutations(rows, 2) for each in _of_three_rows(x, y, rows)),
        *(each for x in arrays[:MOST_ARRAYS] for each in _nystrom(x, rows)),
        *(each for x in rows for each in composition(x)),
    ]
    # few arrays have rows that fit, whatever they are tried as
    pairs = ((x, y, of) for of in tables for x, y in permutations(of, 2))
    more = [x for pair in pairs for x in _of_two_rows(*pair) if x and x.order >= LEAST]
    more += filter(None, map(_of_registers_of_ketcheson, (*_alike(rows), *tables)))
    return [*more, *(x for x in tried if x is not None)], len(tried) + len(more)


def _rows_of(x: Given) -> Iterator[list[Given]]:
    """The few rows or columns of a matrix, as arrays of their own."""
    r, k = x.numbers.shape[:2]
    if len({*map(len, x.rows)}) > 1 or (r == k and r != 3) or min(r, k) > MOST_ROWS:
        return
    for rows in (x.rows if r <= k else (), zip(*x.rows, strict=True) if k <= r else ()):
        found = [Given(f"{x.name}.{i}", x.line, (row,)) for i, row in enumerate(rows)]
        if found:
            yield found


def _alike(rows: Sequence[Given]) -> Iterator[list[Given]]:
    """Rows of the same record that have the same length, four or five of them."""
    of: dict[object, list[Given]] = {}
    for x in rows:
        of.setdefault((x.owner, len(x.rows[0])), []).append(x)
    yield from (x for x in of.values() if 4 <= len(x) <= MOST_ALIKE)


def _names(*named: bool) -> tuple[int, float]:
    """Returns how many flags are true, and their bits."""
    count = sum(map(bool, named))
    return count, 1.5 * count + 2 * (count == 3)


def _head(name: str) -> str:
    """A name without a short ending: ``as_``, ``alpha_v``."""
    head, _, tail = name.rpartition("_")
    return head if head and len(tail) < 2 else name


def _of_two_rows(x: Given, y: Given, rows: Sequence[Given]) -> Iterator[Reading | None]:
    """The schemes of two rows: 2N registers; kicks and drifts."""
    if not (x.fractions and y.fractions):
        return
    a, b = x.numbers, y.numbers
    if len(a) == len(b) - 1:
        a = np.concatenate([np.zeros((1, 4)), a])
    if len(a) != len(b):
        return
    if not a[0, VALUE] and len(b) > 2:
        wide = ROUNDING + 12 * unit_of(a, b) * len(b)
        is_one = abs(b[:, VALUE].sum() - 1) <= wide
        is_both = abs(b[:, VALUE].sum() + a[:, VALUE].sum() - 1) <= wide and a[:, VALUE].any()
        more = (*(_REGISTERS[2:] if is_one else ()), *((_WRAY,) if is_both else ()))
        for form in (*_REGISTERS[:2], *more):
            yield _registers(form, x, a, y, b, rows)
    if len(x.rows[0]) == len(b):
        for form in ("drift-first", "force-first"):
            yield _splitting(form, x, y)


def _registers(
    form: str, x: Given, a: Floats, y: Given, b: Floats, rows: Sequence[Given]
) -> Reading | None:
    """A form with two registers."""
    A, weights = _of_registers(form, a[:, VALUE], b[:, VALUE])
    unit = unit_of(a, b)
    bits, order = _of_conditions(A, weights, unit, [*a[:, LENGTH], *b[:, LENGTH]])
    if order < 2:
        return None
    best, wrong, nodes = _nodes(A, unit, [z for z in rows if z not in (x, y)])
    for z in rows:
        is_low = z not in (x, y) and len(z.rows[0]) == len(b) and EMBEDDED.search(z.name)
        if is_low and order_of(A, z.numbers[:, VALUE], unit, 2):
            low = {"embedded": z.numbers}
            break
    else:
        low = {}
    named = MATRIX.search(x.name), WEIGHTS.search(y.name), nodes and NODES.search(nodes.of.name)
    told = {"A": x.numbers, "b": y.numbers, **low, **({"c": nodes.numbers} if nodes else {})}
    used = (x, y, *([nodes.of] if nodes else []))
    names, by_names = _names(*map(bool, named))
    bits = bits + best - 2 + _places(*used)
    linked, bits = bits - 2, bits + by_names
    how = f"the form {form}"
    idle = [
        z for z in rows if z not in used and z.owner == x.owner and len(z.rows[0]) == len(x.rows[0])
    ]
    idle = [z for z in idle if nodes is None and NODES.search(z.name) and not z.name[-1].isdigit()]
    return Reading(
        form, told, how, bits, order, linked, used, x.line, not wrong, tuple(idle), names
    )


def _nodes(A: Floats, unit: float, rows: Iterable[Given]) -> tuple[float, int, Vector | None]:
    """The nodes that fit most rows of a tableau that was derived: bits, how many are wrong."""
    best, wrong, nodes = 0.0, 0, None
    sums = A.sum(1)
    for c in (c for x in rows for c in nodes_in(Vector(x, x.numbers), sums)):
        off = np.abs(sums - c.numbers[:, VALUE])
        is_met = off <= 1e-12 + 30 * (unit * len(A) + c.numbers[:, UNIT])
        met = float(np.minimum(c.numbers[is_met, LENGTH], MOST).sum())
        if (~is_met).sum() <= len(A) // 3 and met > best and not c.is_incomplete:
            best, wrong, nodes = met, int((~is_met).sum()), c
    return best, wrong, nodes


_REGISTERS = ("2N", "2N with -A", "van der Houwen", "2C")
"""Forms of two rows, as ``garkcli.constructions.registers`` has them; b of the last two has the sum
1.
"""
_WRAY = "Wray"
"""y ← y + h (b f(y) + a f of the stage before): the sum of both rows is 1."""


def _of_registers(form: str, a: Floats, b: Floats) -> tuple[Floats, Floats]:
    s = len(b)
    if form == _WRAY:
        both = b + np.append(a[1:], 0)
        A = np.tril(np.tile(both, (s, 1)), -1)
        A[range(1, s), range(s - 1)] = b[:-1]
        return A, both
    A, d, y = np.tril(np.tile(b, (s, 1)), -1), np.zeros(s), np.zeros(s)
    if form not in _REGISTERS[:2]:
        below = a[1:] + b[:-1] if form == "2C" else a[1:]
        A[range(1, s), range(s - 1)] = below
        return A, b
    for i, x in enumerate(a if form == "2N" else -a):
        A[i] = y
        d = x * d
        d[i] += 1
        y = y + b[i] * d
    return A, y


def _of_registers_of_ketcheson(rows: Sequence[Given]) -> Reading | None:
    """Ketcheson's registers: γ₁, γ₂, δ and β, perhaps γ₃, of which every stage begins at y. With
    names of their own they may be in any order.
    """
    most, order, used = 0.0, 0, tuple[Given, ...]()
    unit = unit_of(*(x.numbers for x in rows))
    lengths = [n for x in rows for n in x.numbers[:, LENGTH]]
    for each in (*permutations(rows, 4), *permutations(rows, 5)):
        made = _of_sums([x.numbers[:, VALUE] for x in each], unit)
        bits, reached = (0.0, 0) if made is None else _of_conditions(*made, unit, lengths)
        if reached >= 2 and bits > most:
            most, order, used = bits, reached, each
    if not used:
        return None
    names = ("gamma1", "gamma2", "delta", "A", "gamma3")[: len(used)]
    told = dict(zip(names, (x.numbers for x in used), strict=True))
    how = "the form 3S*" + (" without its third register" if len(used) == 4 else "")
    count, by_names = _names(*(bool(re.search("gam|del|bet", x.name, re.I)) for x in used[:3]))
    line = used[0].line
    return Reading("3S*", told, how, most + by_names, order, most, used, line, names=count)


def _of_sums(rows: Sequence[Floats], unit: float) -> tuple[Floats, Floats] | None:
    """The tableau of two registers, or three; None if a stage does not begin at y."""
    gamma1, gamma2, delta, beta, *third = rows
    gamma3 = third[0] if third else np.zeros_like(beta)
    tolerance = 1e-12 + 100 * unit
    if abs(gamma1[0] + gamma2[0] * delta[0] + gamma3[0] - 1) > tolerance:
        return None
    s = len(beta)
    first, second = np.zeros(s + 1), np.zeros(s + 1)
    first[s] = 1
    stages = []
    for i in range(s):
        second = second + delta[i] * first
        stages.append(first[:s].copy())
        first = gamma1[i] * first + gamma2[i] * second
        first[s] += gamma3[i]
        first[i] += beta[i]
        if abs(first[s] - 1) > tolerance:
            return None
    return np.array(stages), first[:s]


def _of_conditions(A: Floats, b: Floats, unit: float, lengths: list[float]) -> tuple[float, int]:
    """The bits of the order conditions of a tableau that was derived, and its order."""
    left = sorted(lengths, reverse=True)
    bits, order = 0.0, 0
    if not np.isfinite(A).all() or np.abs(A).max(initial=0) > 1e6:
        return 0.0, 0
    for q, (residuals, sizes) in enumerate(conditions(A, b), start=1):
        explained = (100 * unit * len(b) + 1e-13) * np.maximum(1, sizes)
        is_met = (np.abs(residuals) <= explained).all() and explained.max() <= COARSEST
        if q > HIGHEST or not is_met:
            break
        for x, size, tolerance in zip(residuals, sizes, explained, strict=True):
            bits += min(agreement(x, size, tolerance), left.pop(0) if left else 0.0)
        order = q
    return bits, order


def _splitting(form: str, drifts: Given, kicks: Given) -> Reading | None:
    """Drifts and kicks in turns."""
    a, b = drifts.numbers[:, VALUE], kicks.numbers[:, VALUE]
    tolerance = ROUNDING + 12 * unit_of(drifts.numbers, kicks.numbers) * len(b)
    if any(abs(z.sum() - 1) >= tolerance or np.abs(z).max() > 1e3 for z in (a, b)):
        return None
    if (a == b).all() or np.count_nonzero(a) + np.count_nonzero(b) <= 2:
        return None
    ends_a, ends_b = np.cumsum(a), np.cumsum(b)
    begins_a, begins_b = ends_a - a, ends_b - b
    C, D = (ends_a, begins_b) if form == "drift-first" else (begins_a, ends_b)
    left = sorted([*drifts.numbers[:, LENGTH], *kicks.numbers[:, LENGTH]], reverse=True)
    bits, order = left.pop(0) + left.pop(0), 1
    for q in (2, 3, 4):
        # b·C = 1/2 is the same condition as a·D = 1/2
        pairs = [(b, C), *([] if q == 2 else [(a, D)])]
        residuals = [float(x @ y ** (q - 1)) - 1 / q for x, y in pairs]
        if any(abs(z) > 5 * tolerance for z in residuals):
            break
        order = q
        bits += sum(
            min(left.pop(0) if left else 0.0, agreement(z, 1, tolerance)) for z in residuals
        )
    if order < 2:
        return None
    told = {"drifts": drifts.numbers, "kicks": kicks.numbers}
    how = "drifts and kicks in turns"
    return Reading(
        form,
        told,
        how,
        bits - 2 + _places(drifts, kicks),
        order,
        bits,
        (drifts, kicks),
        drifts.line,
    )


def _shu_osher(x: Given, y: Given, rows: Sequence[Given]) -> Reading | None:
    """Convex combinations: α with row sums 1, and β. In a row of single numbers that has no α the
    value before it is meant.
    """
    alpha = x.numbers if x.is_matrix else _triangle(x.numbers)
    if alpha is None or (not x.is_made and not _are_ones(alpha)):
        return None
    beta = y.numbers if y.is_matrix else _triangle(y.numbers)
    if beta is None:
        return None
    n = len(alpha)
    if x.is_made and y.is_made:
        n = max(n, len(beta))
        alpha, beta = padded(alpha, n), padded(beta, n)
        for i in range(1, n):
            if not alpha[i, :, VALUE].any():
                alpha[i, i - 1] = ALL
    return _combination(alpha, beta, (x, y), rows)


def _of_three_rows(x: Given, y: Given, rows: Sequence[Given]) -> Iterator[Reading | None]:
    """Convex combinations of the value before the step and the one before: in each stage their
    coefficients have the sum 1, and that of f is in a third row.
    """
    a, b = x.numbers, y.numbers
    n = len(a)
    if n != len(b) or n < 2 or x.owner != y.owner:
        return
    if np.abs(a[:, VALUE] + b[:, VALUE] - 1).max() > 1e-10 + 12 * unit_of(a, b):
        return
    alpha = np.zeros((n, n, a.shape[-1]))
    alpha[:, 0] = a
    alpha[range(n), range(n)] = b
    alpha[0, 0] = ALL
    for z in rows:
        if z not in (x, y) and z.owner == x.owner and len(z.numbers) == n:
            beta = np.zeros_like(alpha)
            beta[range(n), range(n)] = z.numbers
            yield _combination(alpha, beta, (x, y, z), [w for w in rows if w is not z])


def _combination(
    alpha: Floats, beta: Floats, arrays: tuple[Given, ...], rows: Sequence[Given]
) -> Reading | None:
    """The method of α and β, which are in some arrays; nodes are in others."""
    x, y, n = arrays[0], arrays[-1], len(alpha)
    if len(beta) != n or not y.fractions or max(alpha.shape[1], beta.shape[1]) > n:
        return None
    if not (is_lower(alpha) and is_lower(beta)):
        return None
    sums = alpha[..., VALUE].sum(1)
    first = int(not sums[0])
    explained = 1e-10 + 12 * alpha[..., UNIT].sum(1).max()
    if n - first < 2 or np.abs(sums[first:] - 1).max() > explained:
        return None
    alpha, beta = alpha[first:], beta[first:]
    A, b = _of_combinations(alpha[..., VALUE], beta[..., VALUE])
    lengths, unit = [*alpha[..., LENGTH].ravel(), *beta[..., LENGTH].ravel()], unit_of(alpha, beta)
    bits, order = _of_conditions(A, b, unit, lengths)
    if order < 1 + x.is_made:
        return None
    several = np.count_nonzero(alpha[..., VALUE], axis=1) > 1
    linked = bits
    bits += float(np.minimum(30, alpha[several][..., LENGTH].max(1, initial=0)).sum())
    best, wrong, nodes = _nodes(A, unit, rows)
    told = {"alpha": alpha, "beta": beta, **({"nodes": nodes.numbers} if nodes else {})}
    used = (*arrays, *([nodes.of] if nodes else []))
    how = "the form of Shu and Osher"
    named = nodes is not None and NODES.search(nodes.of.name)
    names, by_names = _names(
        bool(MATRIX.search(_head(x.name)) or ALPHA.search(x.name)),
        bool(WEIGHTS.search(_head(y.name)) or BETA.search(y.name)),
        bool(named),
    )
    bits += best + by_names + _places(*used) - 2
    return Reading(
        "Shu–Osher", told, how, bits, order, linked, used, x.line, not wrong, names=names
    )


def _are_ones(alpha: Floats) -> bool:
    """Whether the rows have the sum 1, all but the first one."""
    sums = alpha[1:, :, VALUE].sum(1)
    return bool((np.abs(sums - 1) <= 1e-10 + 12 * alpha[..., UNIT].sum(1).max()).all())


def _triangle(row: Floats) -> Floats | None:
    """A lower triangle, its diagonal in it, that is stored row by row."""
    n = (math.isqrt(1 + 8 * len(row)) - 1) // 2
    if n < 2 or n * (n + 1) != 2 * len(row):
        return None
    found = np.zeros((n, n, row.shape[-1]))
    found[lower_triangle(n)] = row
    return found


def _of_combinations(alpha: Floats, beta: Floats) -> tuple[Floats, Floats]:
    s = len(alpha)
    Y = np.zeros((s + 1, s))
    for i in range(s):
        for j in range(min(i + 1, alpha.shape[1])):
            Y[i + 1] += alpha[i, j] * Y[j]
        for j in range(min(i + 1, beta.shape[1])):
            Y[i + 1, j] += beta[i, j]
    return Y[:s], Y[s]


def _nystrom(x: Given, rows: Sequence[Given]) -> Iterator[Reading | None]:
    """Ā with row sums c²/2, weights b of velocities, and b̄ of positions."""
    for parts in parts_of(x):
        A = parts.A
        if parts.c is not None or parts.weights or len(A) < 2 or not x.fractions:
            continue
        whole = [z for w in rows if w is not x for z in fitted(Vector(w, w.numbers), len(A))]
        for c in whole:
            yield None
            off, sizes, explained = row_sums(A, c.numbers, power=2)
            if not c.numbers[:, VALUE].any() or (np.abs(off) > explained + 1e-14).any():
                continue
            lengths = np.maximum(A[..., LENGTH].max(1), c.numbers[:, LENGTH])
            row_bits = float(np.minimum(40, lengths[sizes > 0]).sum())
            for b in whole:
                if b.of is not c.of and abs(b.total - 1) <= b.rounding:
                    yield _with_velocities(x, A, b, c, whole, row_bits, parts.how)


def _with_velocities(
    x: Given, A: Floats, b: Vector, c: Vector, rows: Sequence[Vector], row_bits: float, stored: str
) -> Reading | None:
    weights, nodes = b.numbers[:, VALUE], c.numbers[:, VALUE]
    lengths = sorted(b.numbers[:, LENGTH], reverse=True)
    tolerance = 1e-12 + 30 * (b.numbers[:, UNIT].sum() + c.numbers[:, UNIT].max())
    linked, order = float(lengths.pop(0)), 1
    for q in range(2, QUADRATURE):
        if abs(weights @ nodes ** (q - 1) - 1 / q) > tolerance:
            break
        linked, order = linked + (float(lengths.pop(0)) if lengths else 0.0), q
    if order < 2:
        return None
    best, of_q = 0.0, None
    for each in rows:
        if each.of in (b.of, c.of) or abs(each.total - 0.5) >= 1e-12 + each.rounding:
            continue
        wide = 1e-12 + 30 * unit_of(b.numbers, each.numbers)
        is_usual = np.abs(weights * (1 - nodes) - each.numbers[:, VALUE]).max() < wide
        found = each.numbers[:, LENGTH]
        bits = float(found.sum() if is_usual else found.max())
        best, of_q = (bits, each) if bits > best else (best, of_q)
    used = tuple(dict.fromkeys([x, b.of, c.of, *([of_q.of] if of_q else [])]))
    told = {"A_q": A, "b": b.numbers, "c": c.numbers, **({"b_q": of_q.numbers} if of_q else {})}
    how = "; ".join(filter(None, ["for second-order equations", stored]))
    names, _ = _names(bool(WEIGHTS.search(b.of.name)), bool(NODES.search(c.of.name)), True)
    bits = row_bits + linked + best - 1 + _places(*used)
    linked += row_bits
    return Reading("nystrom", told, how, bits, order, linked, used, x.line, names=names)


def of_velocities(reading: Reading, arrays: Iterable[Given]) -> Iterator[Given]:
    """The matrices beside a Nyström method that velocities at its stages are made with."""
    c = reading.rows.get("c")
    if reading.form != "nystrom" or c is None:
        return
    for x in arrays:
        if x.is_matrix and x not in reading.used and x.numbers.shape[:2] == (len(c), len(c)):
            off, _, explained = row_sums(x.numbers, c)
            if (np.abs(off) <= explained + 1e-12).all():
                yield x


def _places(first: Given, *others: Given) -> float:
    """Bits against arrays of several records."""
    return -8.0 * sum(x.owner != first.owner for x in others)
