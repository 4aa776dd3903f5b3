"""Matrices from rows whose items may be rows and blocks themselves: [c A; q b]."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.sources.scalars import Scalar, Value


def joined(rows: list[list[Value]], has_semicolons: bool) -> Value:
    """The matrix of rows, whose items may be rows and blocks themselves."""
    if rows and not rows[-1]:
        rows = rows[:-1]
    has_lists = any(isinstance(x, list) for row in rows for x in row)
    if len(rows) == 1 and not has_lists:
        return list(rows[0])
    if not has_lists:
        return [list(row) for row in rows]
    if len(rows) == 1 and not has_semicolons:
        return _side_by_side(rows[0])
    blocks: list[Value] = []
    for row in rows:
        beside = _side_by_side(row)
        if isinstance(beside, list) and any(isinstance(x, list) for x in beside):
            blocks += beside
        else:
            blocks.append(beside)
    return blocks


def _side_by_side(items: list[Value]) -> Value:
    """Columns and blocks beside each other; a list of lists stays as it is."""
    if all(isinstance(x, Scalar) for x in items):
        return list(items)
    has_matrix = any(isinstance(x, list) and any(isinstance(y, list) for y in x) for x in items)
    lists = [x for x in items if isinstance(x, list)]
    if has_matrix and len(lists) == len(items):
        heights = {len(x) for x in lists}
        if len(heights) == 1:
            return _beside(lists)
    if len(lists) == len(items):
        return list(items)
    # a row: [q, b]
    row: list[Value] = []
    for item in items:
        row += item if isinstance(item, list) else [item]
    return row


def _beside(blocks: Sequence[list[Value]]) -> Value:
    joined: list[Value] = []
    for parts in zip(*blocks, strict=True):
        row: list[Value] = []
        for part in parts:
            row += part if isinstance(part, list) else [part]
        joined.append(row)
    return joined
