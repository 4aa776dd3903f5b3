"""Matrices of sources made square: flat, packed, ragged, or without the first row."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TypeAlias

from garkcli.frozen import replace
from garkcli.sources.found import MAX_STAGES, FoundTable, Misshapen, Row, Rows, Unreadable

Texts: TypeAlias = "str | list[Texts] | None"
"""Numbers as texts, in lists; None for an intended gap."""
ZERO = "0"


def row_of(value: Texts) -> Row:
    """A list of numbers.

    Raises:
        Unreadable: it is no list of numbers.
    """
    row = tuple(x for x in value if isinstance(x, str)) if isinstance(value, list) else ()
    if not isinstance(value, list) or len(row) != len(value):
        raise Unreadable("a list of numbers is expected")
    return row


def rows_of(value: Texts) -> Rows:
    """A list of lists of numbers.

    Raises:
        Unreadable: it is no such list.
    """
    if not isinstance(value, list):
        raise Unreadable("a matrix is expected")
    return tuple(map(row_of, value))


def is_row(value: Texts) -> bool:
    """Whether it is a nonempty list of numbers."""
    return isinstance(value, list) and bool(value) and all(isinstance(x, str) for x in value)


def weights(value: Texts, stages: int = 0) -> Row:
    """A row of numbers, also from a matrix with one row or one column.

    Args:
        value: as read.
        stages: the number of entries, if known; missing ones are zero.

    Raises:
        Unreadable: it is no such row.
    """
    if isinstance(value, list) and value and not is_row(value):
        columns = [row for row in value if isinstance(row, list)]
        if len(columns) == 1 and len(value) == 1:
            value = columns[0]
        elif len(columns) == len(value) and all(len(x) == 1 for x in columns):
            value = [column[0] for column in columns]
    row = row_of(value)
    if len(row) > MAX_STAGES:
        raise Unreadable(f"more than {MAX_STAGES} stages")
    if stages and len(row) > stages:
        raise Misshapen(f"{len(row)} numbers for {stages} stages")
    return row + (ZERO,) * (stages - len(row))


def square(value: Texts, stages: int) -> Rows:
    """The matrix of a method.

    Args:
        value: its rows, full or up to the diagonal, all or from the second one on; or all entries
            in one row, perhaps of a triangle only.
        stages: s.

    Returns:
        Shape (s, s).

    Raises:
        Unreadable: it has no such shape.

    >>> square([["1"], ["1", "1"]], 3)
    (('0', '0', '0'), ('1', '0', '0'), ('1', '1', '0'))
    """
    if not stages:
        raise Unreadable("there are no weights")
    if is_row(value):
        return _of_flat(row_of(value), stages) if stages > 1 else (weights(value, 1),)
    if isinstance(value, list) and len(value) > stages:
        raise Misshapen(f"{len(value)} rows for {stages} stages")
    return _padded(rows_of(value), stages)


def _padded(rows: Sequence[Row], stages: int) -> Rows:
    lengths = [len(row) for row in rows]
    if max(lengths, default=0) > stages:
        raise Misshapen(f"rows of {max(lengths)} for {stages} stages")
    if len(rows) == stages - 1 and (
        lengths in ([*range(1, stages)], [*range(2, stages + 1)])
        or (set(lengths) < {stages, stages - 1} and _has_subdiagonal(rows))
    ):
        # from the second row on
        rows = [(), *rows]
    if len(rows) < stages:
        raise Misshapen(f"{len(rows)} rows for {stages} stages")
    return tuple(row + (ZERO,) * (stages - len(row)) for row in rows)


def _has_subdiagonal(rows: Sequence[Row]) -> bool:
    """Whether each row ends no later than in an explicit method from its second stage on."""
    ends = [max((j for j, x in enumerate(row) if not is_zero(x)), default=-1) for row in rows]
    return ends[0] == 0 and all(end <= i for i, end in enumerate(ends))


def _of_flat(entries: Row, stages: int) -> Rows:
    """All entries in one row: of the square, of a triangle with or without its diagonal, or of the
    square below the first row.
    """
    less = stages - 1
    for lengths in ([stages] * stages, range(1, stages + 1), range(stages), [less] * less):
        if sum(lengths) == len(entries):
            ends = list(accumulate(lengths))
            return _padded([entries[y - x : y] for x, y in zip(lengths, ends, strict=True)], stages)
    raise Misshapen(f"{len(entries)} entries for {stages} stages")


def changed(sign: str, row: Row, error: Row) -> Row:
    """The embedded weights from the weights and their error: ``b - e`` or ``b + e``."""
    return tuple(x if is_zero(y) else f"{x} {sign} ({y})" for x, y in zip(row, error, strict=True))


def is_zero(text: str) -> bool:
    """Whether a text is a literal zero.

    >>> is_zero("0"), is_zero("-0.0"), is_zero("0.10")
    (True, True, False)
    """
    return not text.strip("-0. ")


def symplectic(empty: FoundTable, drifts: Row, kicks: Row, is_force_first: bool) -> FoundTable:
    """The partitioned method with alternating kicks of momenta and drifts of positions.

    Args:
        empty: the table without coefficients.
        drifts: the weights of the velocities.
        kicks: the weights of the forces.
        is_force_first: whether each kick comes before its drift, or after it.
    """
    stages = range(len(drifts))

    def lower(row: Row, is_behind: bool) -> Rows:
        return tuple(row[: i + is_behind] + (ZERO,) * (len(row) - i - is_behind) for i in stages)

    return replace(
        empty,
        A=((None, lower(kicks, is_force_first)), (lower(drifts, not is_force_first), None)),
        b=(drifts, kicks),
        c=(None, None),
        parts=("q", "p"),
        structure="separable",
    )
