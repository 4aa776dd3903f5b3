"""The ways in which arrays are the matrix of a method, some with nodes or weights in them.

Each is declared once: from an array to what it would be. ``Parts.how`` says in words how it is
stored; nothing for a square matrix by rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from garkcli.recognise.given import VALUE, Given

if TYPE_CHECKING:
    from garkcli.arrays import Floats

MOST_STAGES = 60
CLOSE = 1e-6
WHOLE = 6.0
"""Bits against a diagonal that is elsewhere."""


class Parts(NamedTuple):
    """The rows that an array would be.

    Attributes:
        A: the matrix, shape (s, s, 4).
        c: the nodes in it.
        weights: in it, b first.
        how: it is stored, in words.
        prior: bits that speak for or against it.
        needs_nodes: whether all rows have to fit the nodes in it.
    """

    A: Floats
    c: Floats | None = None
    weights: tuple[Floats, ...] = ()
    how: str = ""
    prior: float = 0.0
    needs_nodes: bool = False


Shape: TypeAlias = "Callable[[Floats], Parts | None]"


def is_lower(M: Floats) -> bool:
    """Whether nothing is above the diagonal."""
    return len(M) > 0 and not np.triu(M[..., VALUE], 1).any()


@lru_cache(maxsize=256)
def lower_triangle(n: int, above: int = 0) -> tuple[Any, Any]:
    """The indices of rows and columns up to a diagonal, row by row."""
    return np.tril_indices(n, above)


def padded(M: Floats, n: int) -> Floats:
    """A square matrix with zeros where M has nothing."""
    found = np.zeros((n, n, M.shape[-1]))
    found[: min(len(M), n), : min(M.shape[1], n)] = M[:n, :n]
    return found


def _below(M: Floats, stages: int) -> Floats:
    """The matrix of a method whose second row is the first one of M."""
    found = np.zeros((stages, stages, M.shape[-1]))
    columns = min(M.shape[1], stages)
    found[1:, :columns] = M[: stages - 1, :columns]
    return found


def _with_first(c: Floats) -> Floats:
    return np.concatenate([np.zeros((1, c.shape[-1])), c])


def _has_diagonal(M: Floats) -> bool:
    return bool(np.diagonal(M[..., VALUE]).any())


def _whole(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    return Parts(M) if r == k else None


def _without_last_columns(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if not (k == r - 1 or 1 < k < r):
        return None
    return Parts(padded(M, r), how="columns of zeros are left out", prior=-1)


def _without_first_row(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if r != k or not is_lower(M) or not _has_diagonal(M):
        return None
    return Parts(_below(M, r + 1), how="the first row of zeros is left out")


def _weights_below(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if r != k or not is_lower(M) or not _has_diagonal(M):
        return None
    how = "rows 2 to s, and the weights below them"
    return Parts(_below(M[:-1], r), None, (M[-1],), how)


def _rows_from_second(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if k != r + 1:
        return None
    return Parts(_below(M, k), how="the first row of zeros is left out")


def _nodes_left(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    return Parts(M[:, 1:], M[:, 0], how="the first column has the nodes") if k == r + 1 else None


def _nodes_left_from_second(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if k != r + 1 or not is_lower(M[:, 1:]) or not M[0, :, VALUE].any():
        return None
    how = "the first column has the nodes, the first row of zeros is left out"
    return Parts(_below(M[:, 1:], r + 1), _with_first(M[:, 0]), how=how)


def _nodes_left_short(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if k != r or r < 3 or not is_lower(M[:, 1:]):
        return None
    how = "the first column has the nodes, the last one of zeros is left out"
    return Parts(padded(M[:, 1:], r), M[:, 0], how=how, needs_nodes=True)


def _weights_below_diagonal(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if r != k or r < 3 or not (is_lower(M) and _has_diagonal(M[:-1])) or M[:, -1, VALUE].any():
        return None
    return Parts(M[:-1, :-1], None, (M[-1, :-1],), "the weights are the last row")


def _weights_below_from_second(M: Floats) -> Parts | None:
    r, k = M.shape[:2]
    if r != k + 1 or k < 2 or not is_lower(M[:-1]) or not _has_diagonal(M[:-1]):
        return None
    how = "rows 2 to s, and the weights below them"
    return Parts(_below(M[:-1], r), None, (padded(M[-1:], r)[0],), how)


def _weights_last(M: Floats, count: int) -> Parts | None:
    r, k = M.shape[:2]
    if r != k + count or k < 2:
        return None
    how = "the weights are the last row" if count == 1 else "two rows of weights are the last ones"
    return Parts(M[:-count], None, tuple(M[-count:]), how)


def _bordered(M: Floats, count: int) -> Parts | None:
    r, k = M.shape[:2]
    if r != k - 1 + count or k < 3 - (count > 1):
        return None
    how = "a tableau with its nodes and weights in one matrix"
    return Parts(M[:-count, 1:], M[:-count, 0], tuple(M[-count:, 1:]), how)


MATRICES: tuple[Shape, ...] = (
    _whole,
    _without_last_columns,
    _without_first_row,
    _weights_below,
    _rows_from_second,
    _nodes_left,
    _nodes_left_from_second,
    _nodes_left_short,
    _weights_below_diagonal,
    _weights_below_from_second,
    partial(_weights_last, count=1),
    partial(_weights_last, count=2),
    partial(_bordered, count=1),
    partial(_bordered, count=2),
)
"""Hypotheses on matrices."""


def _flat(row: Floats) -> Parts | None:
    s = math.isqrt(len(row))
    if s * s != len(row) or s < 2:
        return None
    A = row.reshape(s, s, -1)
    if s == 2 and abs(row[:, VALUE].sum() - 1) < CLOSE and not is_lower(A):
        # four weights: with b = (1/2, 1/2) that is order 2, whatever they are
        return None
    return Parts(A, how="row by row")


def _flat_bordered(row: Floats, count: int) -> Parts | None:
    """``[c A; q b; p b̂]`` row by row."""
    s = next((s for s in range(2, MOST_STAGES) if (s + 1) * (s + count) >= len(row)), 0)
    found = None
    if s and (s + 1) * (s + count) == len(row):
        found = _bordered(row.reshape(s + count, s + 1, -1), count)
    if found is None or found.c is None or not _are_sums(found.A, found.c):
        return None
    how = f"{found.how}, row by row"
    return found._replace(weights=found.weights[:1], how=how, needs_nodes=True)


def _are_sums(A: Floats, c: Floats) -> bool:
    """Whether the nodes, not all 0, are the row sums; of three or more one may differ."""
    off = A[..., VALUE].sum(1) - c[:, VALUE]
    return int((np.abs(off) > CLOSE).sum()) <= (len(c) > 2) and bool(c[:, VALUE].any())


def _flat_columns(row: Floats) -> Parts | None:
    found = _flat(row)
    if found is None:
        return None
    return Parts(found.A.transpose(1, 0, 2), how="column by column", prior=-2)


def _packed(row: Floats, diagonal: int, by: str) -> Parts | None:
    s = (math.isqrt(1 + 8 * len(row)) + 1 - 2 * diagonal) // 2
    if s * (s - 1 + 2 * diagonal) != 2 * len(row) or s < 2 + (by == "columns" and not diagonal):
        return None
    A = np.zeros((s, s, row.shape[-1]))
    if by == "rows":
        A[lower_triangle(s, diagonal - 1)] = row
        return Parts(A, how="the triangle row by row")
    j, i = lower_triangle(s, diagonal - 1)
    by_columns = np.lexsort((j, i))
    A[j[by_columns], i[by_columns]] = row
    return Parts(A, how="the triangle column by column", prior=-2)


ROWS: tuple[Shape, ...] = (
    partial(_packed, diagonal=0, by="rows"),
    partial(_packed, diagonal=0, by="columns"),
    partial(_packed, diagonal=1, by="rows"),
    partial(_packed, diagonal=1, by="columns"),
    _flat,
    _flat_columns,
    partial(_flat_bordered, count=1),
    partial(_flat_bordered, count=2),
)
"""Hypotheses on all numbers in one row."""


@lru_cache(maxsize=256)
def parts_of(given: Given) -> tuple[Parts, ...]:
    """Every way in which an array is the matrix of a method, each matrix once."""
    return tuple(_each_once(given))


def _each_once(given: Given) -> Iterator[Parts]:
    seen: set[object] = set()
    for parts in _all_parts(given):
        A = parts.A[..., VALUE]
        if not A.any() or not (len(A) > 1 or parts.weights):
            continue
        beside = (parts.c, *parts.weights)
        key = A.tobytes(), tuple(None if x is None else x[:, VALUE].tobytes() for x in beside)
        if key not in seen:
            seen.add(key)
            yield parts


def _all_parts(given: Given) -> Iterator[Parts]:
    numbers = given.numbers
    if not given.is_matrix:
        yield from filter(None, (shape(numbers) for shape in ROWS))
        return
    if max(numbers.shape[:2]) > MOST_STAGES or numbers.size < 8:
        return
    yield from filter(None, (shape(numbers) for shape in MATRICES))
    if is_lower(numbers) and numbers.shape[0] == numbers.shape[1]:
        for entry in given.beside:
            made = list(_with_diagonal(numbers, np.array(entry)))
            if not given.is_made and _has_diagonal(numbers):
                # rows from the second one on, without their own diagonal
                made += _with_diagonal(_below(numbers, len(numbers) + 1), np.array(entry))
            # an array that is written out has its diagonal, as a rule
            yield from (x._replace(prior=-WHOLE * (not given.is_made)) for x in made)
    if len({*map(len, given.rows)}) == 1:
        turned = numbers.transpose(1, 0, 2)
        for parts in filter(None, (shape(turned) for shape in MATRICES)):
            how = "columns are stages" + (f": {parts.how}" if parts.how else "")
            yield parts._replace(how=how, prior=parts.prior - 2)


def _with_diagonal(M: Floats, entry: Floats) -> Iterator[Parts]:
    """A lower matrix with a number where its diagonal has none: everywhere, from the second row on,
    also as all of that row, or without the last row, which has the weights.
    """
    how = "the diagonal is a number of its own"
    for first in (0, 1):
        A = M.copy()
        missing = [i for i in range(first, len(A)) if not A[i, i, VALUE]]
        A[missing, missing] = entry
        yield Parts(A, how=how)
        if first and not A[1, 0, VALUE]:
            A = A.copy()
            A[1, 0] = entry
            yield Parts(A, how=how)
        if not M[:, -1, VALUE].any():
            yield Parts(A[:-1, :-1], None, (M[-1, :-1],), f"{how}; the weights are the last row")
