"""Readings of arrays: of all ways in which they are a method, those with the most evidence."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from garkcli.frozen import Frozen, replace
from garkcli.recognise.evidence import Evidence, evidence, order_of, row_sums, sums_of_rows, unit_of
from garkcli.recognise.given import LENGTH, UNIT, VALUE, DeclaredOrder, Given, Group
from garkcli.recognise.hypotheses import Parts, is_lower, parts_of
from garkcli.recognise.names import BETA, EMBEDDED, MATRIX, NODES, WEIGHTS
from garkcli.recognise.vectors import Vector, fitted, nodes_in, sums_of, vectors_of

if TYPE_CHECKING:
    from garkcli.arrays import Floats

NEAREST = 24
"""The most vectors near a matrix that are tried."""
MOST_NODES = 3
"""The most nodes, the best ones, that are tried with each weights."""
FAR = 0.2
"""Weights have a sum that is nearer to 1, one wrong number among them."""
MOST_BESIDE = 2
"""Embedded weights are in arrays with so many rows or columns."""
BESIDE = 60
"""Arrays in so many lines may be of one method."""
ELSEWHERE = 8.0
"""Bits that an array of another record costs."""
OFF = 8.0
"""Bits that a wrong sum costs."""
ONE_WRONG = 6.0
"""Bits that a wrong entry costs beside those that tell where it is."""
LAST_ROW = 3.0
CLOSE = 1e-5
"""A residual that is larger, relative to its terms, is that of a condition that fails."""
MOST_TRIED = 5_000
"""The most hypotheses that are tried for the arrays of a scope."""
WORDS = 3.0
"""Bits of words that speak of methods."""
ENOUGH_WITH_NAMES, ENOUGH = 4.0, 10.0
"""More bits make a reading."""
ENOUGH_FOR_DOUBT = 3.0
"""And so many a doubt about another one."""


class Reading(Frozen, eq=False):
    """Arrays as a method.

    Attributes:
        form: ``rk``, or one that is made a tableau first: ``2N``, ``Shu–Osher``, ``nystrom``,
            ``drift-first``, ``force-first``, ``composition``.
        rows: its numbers by their roles; A, b, c, embedded of ``rk``.
        how: they are stored, in words.
        bits: that speak for it.
        order: as far as floats tell.
        linked: bits of what links matrix and weights.
        used: the arrays.
        is_plain: whether every identity holds that is tried.
        is_embedding: whether there are embedded weights of order 1 at least.
        idle: arrays beside it with names of nodes or weights, and no role.
        names: how many roles have a name that suggests them.
        line: where its matrix is.
        group: the scope that it is of.
        declared: the order that is declared beside it.
        evidence: of its tableau, where it is given as one.
        weights: the array of b, unless that is the one of A.
        matrix: what readings have in common that differ in weights alone.
    """

    form: str
    rows: dict[str, Floats]
    how: str
    bits: float
    order: int
    linked: float
    used: tuple[Given, ...]
    line: int
    is_plain: bool = True
    idle: tuple[Given, ...] = ()
    names: int = 0
    group: Group | None = None
    declared: DeclaredOrder | None = None
    evidence: Evidence | None = None
    weights: Given | None = None
    matrix: object = None

    @property
    def is_enough(self) -> bool:
        """Whether so much speaks for it that it is read."""
        speaks = self.group is not None and self.group.speaks
        has_names = self.names > 2 or (self.names > 1 and speaks)
        return self.bits > (ENOUGH_WITH_NAMES if has_names else ENOUGH)


def rk_readings(arrays: Sequence[Given], unknown: Iterable[str] = ()) -> tuple[list[Reading], int]:
    """The ways in which arrays are Runge–Kutta methods, and how many were tried.

    Args:
        arrays: in the scope.
        unknown: the names of others in it with entries that are not known.
    """
    search = _Search(arrays, any(map(WEIGHTS.search, unknown)))
    found: list[Reading] = []
    for each in arrays:
        if search.tried < MOST_TRIED:
            found += search.with_matrix(each)
    return found, search.tried


class _Search:
    """The search among the arrays of a group."""

    def __init__(self, arrays: Sequence[Given], has_unknown_weights: bool) -> None:
        self._has_unknown_weights = has_unknown_weights
        self._vectors = [x for each in arrays for x in vectors_of(each)]
        self._sums = [x for each in arrays for x in sums_of(each)]
        self.tried = 0

    def with_matrix(self, of: Given) -> Iterator[Reading]:
        """The readings whose matrix is in an array."""
        all_near: dict[int, Sequence[Vector]] = {}
        for parts in parts_of(of):
            s = len(parts.A)
            if parts.needs_nodes and parts.c is not None:
                off, _, explained = row_sums(parts.A, parts.c)
                if (np.abs(off) > explained).any():
                    continue
            near = all_near.get(s)
            if near is None:
                near = all_near[s] = self._near(of, s)
            weights = self._weights(of, parts, near)
            for c in self._nodes(of, parts, near) if weights else ():
                for b in weights:
                    found = self._reading(of, parts, b, c)
                    if found is not None:
                        yield found

    def _near(self, of: Given, stages: int) -> Sequence[Vector]:
        """The vectors next to an array that may be those of a method."""
        lengths = range(stages - 3, stages + 9)
        near = [x for x in self._vectors if x.of is not of and len(x.numbers) in lengths]
        return sorted(near, key=lambda x: abs(x.of.line - of.line))[:NEAREST]

    def _nodes(self, of: Given, parts: Parts, near: Sequence[Vector]) -> list[Vector | None]:
        """The vectors that may be the nodes, and that there are none."""
        if parts.c is not None:
            return [Vector(of, parts.c)]
        s = len(parts.A)
        sums = [x for x in self._sums if x.of is not of and len(x.numbers) == s > 2]
        sums = [x for x in sums if abs(x.of.line - of.line) < 80 and not _is_alike(x.of, parts.A)]
        found: list[tuple[int, Vector]] = []
        if not (near or sums):
            return [None]
        row_sums_of = sums_of_rows(parts.A)
        for each in (*near, *sums):
            for c in nodes_in(each, row_sums_of[0]):
                if c.is_cut_in_front and parts.A[-1, :, VALUE].any():
                    continue
                self.tried += 1
                off, sizes, explained = row_sums(parts.A, c.numbers, sums=row_sums_of)
                wrong = int((np.abs(off) > explained).sum())
                most = 0 if s <= 2 else max(1, int((sizes > 0).sum()) // 3)
                is_named = s == 2 and wrong == 1 and not c.numbers[0, VALUE]
                is_named = is_named and NODES.search(each.of.name) is not None
                if (c.numbers[:, VALUE].any() and wrong <= most) or is_named:
                    found.append((wrong, c))
        best = sorted(found, key=lambda x: x[0])[:MOST_NODES]
        return [*(c for _, c in best), None]

    def _weights(self, of: Given, parts: Parts, near: Sequence[Vector]) -> list[Vector]:
        """The vectors that may be the weights."""
        if parts.weights:
            return [Vector(of, x) for x in parts.weights]
        s = len(parts.A)
        found: list[Vector] = []
        for each in near:
            if each.is_behind_first and parts.c is None:
                continue
            if abs(each.total - 1) > max(FAR, each.rounding):
                continue
            for b in fitted(each, s):
                if b.is_behind_zero:
                    continue
                self.tried += 1
                off = abs(b.total - 1)
                if off <= b.rounding:
                    found.append(b)
                elif off < FAR and s > 2:
                    found.append(replace(b, is_off=True))
        last = Vector(of, parts.A[-1], is_last_row=True)
        is_one = abs(last.total - 1) < 1e-6 and not self._has_others(of, last)
        is_one = is_one and not self._has_unknown_weights
        return [*found, *([last] if is_one else [])]

    def _has_others(self, of: Given, last: Vector) -> bool:
        """Whether single numbers beside those of a matrix have a name of weights, and other values
        than its last row.
        """
        own = [x for x in self._vectors if x.of.is_made and x.of.owner == of.owner]
        named = [x for x in own if WEIGHTS.search(x.of.name) or BETA.search(x.of.name)]
        named = [x for x in named if not EMBEDDED.search(x.of.name)]
        values = {*last.numbers[:, VALUE], 0.0}
        return of.is_made and any(not values.issuperset(x.numbers[:, VALUE]) for x in named)

    def _reading(self, of: Given, parts: Parts, b: Vector, c: Vector | None) -> Reading | None:
        """A matrix with weights and nodes; None if too little speaks for it."""
        beside = [x for x in (b, c) if x is not None and x.of is not of]
        versions = [x for x in beside if x.of.name == of.name and not x.is_sum]
        is_twice = c is not None and b.of is c.of is not of and b.which == c.which and not c.is_sum
        if versions or is_twice:
            return None
        self.tried += 1
        s, nodes = len(b.numbers), None if c is None else c.numbers
        if not (
            _may_have_order_two(parts.A, b, nodes) or self._may_have_order_one(of, parts, b, c)
        ):
            return None
        found = evidence(parts.A, b.numbers, nodes)
        plain = found.bits - 4 * len(found.wrong_rows)
        bits = plain
        if s > 2 and (b.is_off or len(found.wrong_rows) == 1):
            mended = _mended(parts.A, b.numbers, nodes, found, b.is_off, of.is_made)
            if b.is_off and mended < 0:
                return None
            bits = max(bits, mended)
        if bits <= 0:
            return None
        if bits == plain and found.nearly < 2:
            is_one = found.nearly == 1 and not (b.is_off or found.wrong_rows)
            has_rows = found.several >= (1 if s <= 2 else 2)
            if not (is_one and has_rows and self._may_have_order_one(of, parts, b, c)):
                return None
        if b.is_last_row and _is_like_other_rows(parts.A, found.nearly):
            return None
        if b.is_last_row and not is_lower(parts.A) and found.nearly < s:
            # the node 1 is no reason: collocation makes rows that are quadratures
            return None
        prior, names = _prior(of, parts, b, c)
        used = tuple(dict.fromkeys([of, *(x.of for x in beside if not x.is_sum)]))
        rows = {"A": parts.A, "b": b.numbers, **({} if c is None or c.is_sum else {"c": c.numbers})}
        how = "; ".join(filter(None, [parts.how, *(x.how for x in beside)]))
        if b.is_last_row:
            how = f"{how}; b is its last row" if how else "b is the last row"
        is_plain = found.is_plain and not b.is_off and not (c is not None and c.is_sum)
        return Reading(
            "rk",
            rows,
            how,
            bits + prior,
            found.order,
            found.linked,
            used,
            of.line,
            is_plain,
            names=names,
            evidence=found,
            weights=b.of if b.of is not of else None,
            matrix=(id(of), parts.how, None if c is None else (id(c.of), c.which)),
        )

    def _may_have_order_one(self, of: Given, parts: Parts, b: Vector, c: Vector | None) -> bool:
        """Whether a method of order 1 is read: there are nodes, in one record, with all names."""
        if parts.weights or c is None or b.of is of:
            return bool(parts.weights) and c is not None and not of.is_made
        are_named = MATRIX.search(of.name) and WEIGHTS.search(b.of.name)
        has_nodes = parts.c is not None or NODES.search(c.of.name)
        return b.of.owner == of.owner and bool(are_named and has_nodes)


def _may_have_order_two(A: Floats, b: Vector, c: Floats | None) -> bool:
    """Whether order 2 holds with row sums or nodes, or with one wrong weight."""
    weights = b.numbers[:, VALUE]
    for sums in (A[..., VALUE].sum(1), *([] if c is None else [c[:, VALUE]])):
        off = float(weights @ sums) - 0.5
        wide = CLOSE * (1 + float(np.abs(weights) @ np.abs(sums)))
        if abs(off) < wide:
            return True
        if b.is_off and (np.abs(off + (1 - b.total) * sums) < wide).any():
            return True
    return False


def _is_like_other_rows(A: Floats, order: int) -> bool:
    """Whether another row whose stage is at the end of the step has the order of the last one, as
    those of methods of high order do: their weights are elsewhere.
    """
    values, unit = A[..., VALUE], unit_of(A)
    at_end = np.abs(values[:-1].sum(1) - 1) < CLOSE
    others = (row for row in values[:-1][at_end] if not np.array_equal(row, values[-1]))
    return any(order_of(values, row, unit, order) >= order for row in others)


def _is_alike(other: Given, A: Floats) -> bool:
    """Whether two matrices have most rows in common, which say nothing then, or one is turned."""
    M = np.zeros(A.shape[:2])
    numbers = other.numbers[..., VALUE]
    r, k = min(len(M), len(numbers)), min(len(M), numbers.shape[1])
    M[:r, :k] = numbers[:r, :k]
    same = np.abs(M - A[..., VALUE]).max(1) < 1e-9 * (1 + np.abs(M).max(1))
    return bool(same.sum() > len(M) // 2 or np.allclose(M.T, A[..., VALUE]))


def _prior(of: Given, parts: Parts, b: Vector, c: Vector | None) -> tuple[float, int]:
    """Bits of the shape, of names, of places; and how many names there are."""
    prior = parts.prior - OFF * b.is_off - LAST_ROW * b.is_last_row
    named = [bool(MATRIX.search(of.name))]
    prior += 1.5 * named[0]
    if b.of is not of:
        named.append(bool(WEIGHTS.search(b.of.name)))
        prior += 2.0 * named[-1] - 1.5 * bool(EMBEDDED.search(b.of.name))
    if c is not None and c.is_sum:
        prior -= 3.0
    elif c is not None and c.of is not of:
        named.append(bool(NODES.search(c.of.name)))
        prior += 1.5 * named[-1]
        named += [named[0]] * b.is_last_row
    prior += 2.0 * (sum(named) == 3)
    for x in (b, c):
        if x is not None and x.of is not of:
            prior -= ELSEWHERE * (x.of.owner != of.owner)
            prior -= min(ELSEWHERE, math.log2(1 + abs(x.of.line - of.line) / 15))
    return prior, sum(named)


def _mended(
    A: Floats, b: Floats, c: Floats | None, found: Evidence, is_off: bool, is_made: bool
) -> float:
    """Bits of the best table that differs by one entry, less what it costs to name that. Where each
    entry has a name, one that is left out may be known elsewhere.
    """
    best: float | None = None
    count = int((A[..., VALUE] != 0).sum()) + 2 * len(b)
    if is_off:
        for j in range(len(b)):
            other = b.copy()
            other[j, VALUE] += 1 - b[:, VALUE].sum()
            other[j, LENGTH] = 0
            each = evidence(A, other, c)
            if each.nearly >= 2 and not each.wrong_rows:
                best = each.bits if best is None else max(best, each.bits)
    elif c is not None:
        (i,) = found.wrong_rows
        lower = is_lower(A)
        if is_made and not A[i, :i, VALUE].all():
            return -1e9
        for j in range(len(b)):
            if (lower and j > i) or (not A[i, j, VALUE] and len(b) > 8):
                continue
            matrix = A.copy()
            matrix[i, j, VALUE] += c[i, VALUE] - A[i, :, VALUE].sum()
            matrix[i, j, LENGTH] = 0
            each = evidence(matrix, b, c)
            if each.nearly >= 3 or (each.nearly >= 2 and each.several >= 4):
                best = each.bits if best is None else max(best, each.bits)
    return -1e9 if best is None else best - math.log2(count) - ONE_WRONG


def _are_longer_nodes(x: Given, matrix: Given, sums: Floats) -> bool:
    """Whether an array of a record has the name of nodes, more entries than the matrix has rows,
    and does not begin with its row sums.
    """
    row, count = x.numbers.reshape(-1, x.numbers.shape[-1]), len(sums)
    if x.owner != matrix.owner or x.is_matrix or len(row) <= count + 1:
        return False
    is_other = np.abs(row[:count, VALUE] - sums).max() > CLOSE
    return bool(is_other and NODES.search(x.name))


def with_beside(reading: Reading, group: Iterable[Given]) -> Reading:
    """A reading with embedded weights, and with the arrays that have names of its parts and no role
    in it.
    """
    A, b, c = (reading.rows.get(x) for x in "Abc")
    assert A is not None
    assert b is not None
    sums, unit = A[..., VALUE].sum(1), unit_of(A, b)
    rows, used, idle = dict(reading.rows), reading.used, []
    vectors = (
        x
        for given in group
        for x in vectors_of(given)
        # weights and embedded ones may be columns of one array
        if (given not in reading.used or (given is reading.weights and given.is_matrix))
        # a column of a matrix may have the sum 1 by chance
        and not (given.is_matrix and min(given.numbers.shape[:2]) > MOST_BESIDE)
    )
    # weights of dense output have the sum 0, too
    told_first = sorted(vectors, key=lambda x: EMBEDDED.search(x.of.name) is None)
    for each in (x for of in told_first for x in fitted(of, len(b))):
        if each.is_behind_zero or each.is_behind_first:
            continue
        v = each.numbers[:, VALUE]
        if any(x is not None and np.array_equal(v, x[:, VALUE]) for x in (b, c)):
            continue
        # numbers with names of their own take many lines
        is_far = abs(each.of.line - reading.line) > BESIDE and not each.of.is_made
        if is_far or each.of.owner != reading.used[0].owner:
            continue
        off, is_error, name = each.total - 1, abs(each.total) <= each.rounding, each.of.name
        least = 2 if each.is_fitted and not EMBEDDED.search(name) else 1
        is_low = abs(off) <= each.rounding and order_of(A[..., VALUE], v, unit, 2) >= least
        if "embedded" not in rows and "error" not in rows and (is_low or is_error) and v.any():
            rows["error" if is_error else "embedded"] = each.numbers
            used = (*used, each.of)
        elif each.is_fitted or is_low or is_error:
            continue
        elif WEIGHTS.search(name) or (each.of.is_made and EMBEDDED.search(name)):
            idle.append(each.of)
        elif c is None and not each.of.is_made and NODES.search(name):
            wide = 30 * (each.numbers[:, UNIT] + A[..., UNIT].sum(1)) + 1e-12
            idle += [each.of] if (np.abs(v - sums) > wide).any() else []
    if c is None and reading.used[0].owner:
        idle += [x for x in group if _are_longer_nodes(x, reading.used[0], sums)]
    return replace(reading, rows=rows, used=used, idle=tuple(dict.fromkeys(idle)))


def by_names(reading: Reading, others: Sequence[Reading]) -> Reading:
    """Returns the reading with the weights that names say, else the first, of readings that all
    fit and differ in weights: never by the higher order.
    """
    if reading.weights is None or reading.linked <= 6:
        return reading
    fits = [x for x in others if x.weights is not None and x.evidence and x.evidence.nearly >= 2]

    def rank(x: Reading) -> tuple[bool, bool, int]:
        assert x.weights is not None
        name = x.weights.name
        return bool(EMBEDDED.search(name)), not WEIGHTS.search(name), x.weights.line

    return min(fits, key=rank, default=reading)
