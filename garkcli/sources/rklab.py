"""Block matrices [c A; q b; p d] of RKLab: a table, its orders and its embedded weights in one."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.sources.found import MAX_STAGES
from garkcli.sources.values import Array, Number, Value, whole

NEAR = 0.01
"""Sums that differ by less are meant to be the same."""
FAR = 0.5
"""Weights have a sum that is nearer to 1, misprints included."""


def block_roles(value: Value) -> Mapping[str, Value] | None:
    """The roles of the parts of a block matrix; None where it is none.

    q, which has the row of the weights to itself, is a whole number; 0 says nothing.
    """
    if not isinstance(value, Array) or not value.is_matrix:
        return None
    rows = [x.items for x in value.items if isinstance(x, Array)]
    lengths = {len(row) for row in rows}
    if len(lengths) != 1:
        return None
    stages = lengths.pop() - 1
    if not 0 < stages <= MAX_STAGES or len(rows) - stages not in (1, 2):
        return None
    entries = [x for row in rows for x in row]
    order = whole(rows[stages][0])
    if order is None or order < 0 or not all(isinstance(x, Number) for x in entries):
        return None
    near = [[x.near for x in row if isinstance(x, Number)] for row in rows]
    agreeing = sum(abs(sum(row[1:]) - row[0]) < NEAR for row in near[:stages])
    if abs(sum(near[stages][1:]) - 1) > FAR or agreeing < (stages / 2 if order else stages):
        # a matrix like any other
        return None
    roles: dict[str, Value] = {
        "A": Array([Array(row[1:]) for row in rows[:stages]]),
        "b": Array(rows[stages][1:]),
        "c": Array([row[0] for row in rows[:stages]]),
    }
    if order:
        roles["order"] = rows[stages][0]
    if len(rows) == stages + 2:
        if whole(rows[-1][0]) is None:
            return None
        is_empty = not whole(rows[-1][0]) and all(_is_zero(x) for x in rows[-1][1:])
        if not is_empty:
            roles |= {"embedded_order": rows[-1][0], "embedded": Array(rows[-1][1:])}
    return roles


def _is_zero(value: Value) -> bool:
    return isinstance(value, Number) and value.is_zero
