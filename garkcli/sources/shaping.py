"""Matrices as sources store them, made square: flat, packed, ragged, without the first row."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TypeAlias

from garkcli.frozen import replace
from garkcli.sources.found import MAX_STAGES, FoundTable, Misshapen, Row, Rows, Unreadable

Texts: TypeAlias = "str | list[Texts] | None"
"""Numbers as texts, in lists; nothing where nothing is meant to be."""
ZERO = "0"


def row_of(value: Texts) -> Row:
    """A list of numbers.

    Raises:
        Unreadable: it is none.
    """
    row = tuple(x for x in value if isinstance(x, str)) if isinstance(value, list) else ()
    if not isinstance(value, list) or len(row) != len(value):
        raise Unreadable("a list of numbers is expected")
    return row


def rows_of(value: Texts) -> Rows:
    """A list of lists of numbers.

    Raises:
        Unreadable: it is none.
    """
    if not isinstance(value, list):
        raise Unreadable("a matrix is expected")
    return tuple(map(row_of, value))


def is_row(value: Texts) -> bool:
    """Whether it is a list of numbers that is not empty."""
    return isinstance(value, list) and bool(value) and all(isinstance(x, str) for x in value)


def weights(value: Texts, stages: int = 0) -> Row:
    """A row of numbers, also one that is in a matrix of one row or of one column.

    Args:
        value: as it was read.
        stages: how many numbers it has, where that is known; missing ones are zero.

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
        value: its rows, full or up to the diagonal, all of them or from the second one on; or all
            entries in one row, those of a triangle too.
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
    """Whether each row ends where that of an explicit method from its second stage on ends."""
    ends = [max((j for j, x in enumerate(row) if not is_zero(x)), default=-1) for row in rows]
    return ends[0] == 0 and all(end <= i for i, end in enumerate(ends))


def _of_flat(entries: Row, stages: int) -> Rows:
    """All entries in one row: of the square, of a triangle with its diagonal, of one without, of
    the square below the first row.
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
    """Whether a text is a zero that is written as such.

    >>> is_zero("0"), is_zero("-0.0"), is_zero("0.10")
    (True, True, False)
    """
    return not text.strip("-0. ")


def symplectic(empty: FoundTable, drifts: Row, kicks: Row, is_force_first: bool) -> FoundTable:
    """The partitioned method of kicks of the momenta and drifts of the positions in turns.

    Args:
        empty: what else is known of it.
        drifts: the weights of the velocities.
        kicks: those of the forces.
        is_force_first: whether each kick is followed by its drift, or the other way round.
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
